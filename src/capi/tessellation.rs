//! `carvel_tessellation`: triangles on a limit surface.

use super::buffer::{Span, Target, check_overlap, check_pointer};
use super::guard::call;
use super::object::{destroy_function, object};
use super::status::{Fault, Result, carvel_status};
use super::values::{ConstValues, Values};
use super::versioned::{init_function, initial, read, versioned, write};
use super::{carvel_context, carvel_error, carvel_sample, carvel_surface};
use crate::base::{Context, Error, ErrorKind, Scalar};
use crate::limit::{Fineness, Screen, Surface, TessellateOptions, Tessellation, tessellate};

object!(carvel_tessellation, Tessellation);

pub const CARVEL_FINENESS_CHORD: i32 = 0;
pub const CARVEL_FINENESS_PIXELS: i32 = 1;

versioned! {
    pub struct carvel_tessellation_desc {
        pub struct_size: u32,
        pub fineness: i32,
        pub tolerance: f64,
        pub max_levels: u32,
        pub partial: u32,
        pub max_triangles: u64,
        pub matrix: [f64; 16],
        pub viewport: [f64; 2],
    }
}

versioned! {
    pub struct carvel_triangle_counts {
        pub struct_size: u32,
        pub reserved: u32,
        pub vertices: u64,
        pub triangles: u64,
        pub places: u64,
        pub measure: f64,
        pub coarse: u64,
        pub missing: u64,
    }
}

init_function!(carvel_tessellation_desc_init, carvel_tessellation_desc);
init_function!(carvel_triangle_counts_init, carvel_triangle_counts);

/// Coordinates of a point.
const WIDTH: usize = 3;

impl carvel_tessellation_desc {
    fn options(&self) -> Result<TessellateOptions> {
        let [x, y, z, w] = [0, 1, 2, 3].map(|i| [0, 1, 2, 3].map(|j| self.matrix[4 * i + j]));
        let screen = Screen { matrix: [x, y, z, w], viewport: self.viewport };
        let options = TessellateOptions::new(match self.fineness {
            CARVEL_FINENESS_CHORD => Fineness::Chord(self.tolerance),
            CARVEL_FINENESS_PIXELS => Fineness::Pixels(self.tolerance, screen),
            other => return Err(Fault::out_of_range(format!("there is no fineness {other}"))),
        });
        let or = |given: u64, default: u64| if given == 0 { default } else { given };
        Ok(TessellateOptions {
            levels: or(self.max_levels.into(), options.levels.into()) as u32,
            triangles: or(self.max_triangles, options.triangles),
            partial: match self.partial {
                0 | 1 => self.partial == 1,
                other => {
                    return Err(Fault::out_of_range(format!("partial is {other}, not 0 or 1")));
                }
            },
            ..options
        })
    }
}

impl From<&Tessellation> for carvel_triangle_counts {
    fn from(made: &Tessellation) -> Self {
        Self {
            vertices: made.positions.len() as u64,
            triangles: made.triangles.len() as u64,
            places: made.places.len() as u64,
            measure: made.measure,
            coarse: made.coarse,
            missing: made.missing,
            ..initial()
        }
    }
}

/// # Safety
/// The header's contract.
unsafe fn create<T: Scalar>(
    (context, surface): (*const carvel_context, *const carvel_surface),
    positions: *const ConstValues<T>,
    desc: *const carvel_tessellation_desc,
    out: *mut *mut carvel_tessellation,
    error: *mut carvel_error,
) -> carvel_status {
    // SAFETY: the caller's contract.
    unsafe {
        call(error, |call| {
            call.create(out, |call| {
                let (context, surface) = (call.context(context)?, call.object(surface)?);
                check_pointer(positions, "positions")?;
                let options = read(desc)?.options()?;
                cut(&context, surface, positions.read(), &options)
            })
        })
    }
}

/// # Safety
/// The header's contract.
unsafe fn cut<T: Scalar>(
    context: &Context,
    surface: &Surface,
    positions: ConstValues<T>,
    options: &TessellateOptions,
) -> Result<Tessellation> {
    let from = positions.check_positions(surface.columns() as u64, "positions".into())?;
    context.check_memory(from.copy_bytes::<T>())?;
    // SAFETY: the caller's contract.
    let positions = unsafe { from.read()? };
    Ok(tessellate(context, surface, positions.values(), options)?)
}

/// A list, and the buffer that takes it if there is one.
struct List<'a, T> {
    to: Target<T>,
    from: &'a [T],
}

impl<'a, T: Copy> List<'a, T> {
    fn new((data, capacity): (*mut T, u64), from: &'a [T], name: &'static str) -> Self {
        let from = if data.is_null() { &[] } else { from };
        Self { to: Target::new((data, capacity), from.len() as u64, name), from }
    }

    fn span(&self) -> Result<Span> {
        self.to.span()
    }

    /// # Safety
    /// As [`Target::slice`].
    unsafe fn copy(&self) {
        // SAFETY: the caller's contract.
        unsafe { self.to.slice() }.copy_from_slice(self.from);
    }
}

/// Copies points into the caller's records.
///
/// # Safety
/// The header's contract.
unsafe fn points<T: Scalar>(
    tessellation: *const carvel_tessellation,
    points: impl Fn(&Tessellation) -> &[[f64; WIDTH]],
    out: *const Values<T>,
    error: *mut carvel_error,
) -> carvel_status {
    // SAFETY: the caller's contract.
    unsafe {
        call(error, |call| {
            let points = points(call.object(tessellation)?);
            check_pointer(out, "out")?;
            let to = out.read().check(points.len() as u64, WIDTH, "out".into())?;
            let all = points.as_flattened();
            // All that there is is finite in double precision.
            if let Some(at) = all.iter().position(|&x| !T::from_f64(x).is_finite()) {
                let message = format!("point {} does not fit the number type", at / WIDTH);
                return Err(Error::new(ErrorKind::NotFinite, message).into());
            }
            let mut to = to.sink()?;
            for (slot, &x) in to.values().iter_mut().zip(all) {
                *slot = T::from_f64(x);
            }
            to.finish();
            Ok(())
        })
    }
}

/// The functions that exist for each number type.
macro_rules! twins {
    ($number:ty, $create:ident, $positions:ident, $normals:ident) => {
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $create(
            context: *const carvel_context,
            surface: *const carvel_surface,
            positions: *const ConstValues<$number>,
            desc: *const carvel_tessellation_desc,
            out: *mut *mut carvel_tessellation,
            error: *mut carvel_error,
        ) -> carvel_status {
            // SAFETY: the header's contract.
            unsafe { create((context, surface), positions, desc, out, error) }
        }

        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $positions(
            tessellation: *const carvel_tessellation,
            out: *const Values<$number>,
            error: *mut carvel_error,
        ) -> carvel_status {
            // SAFETY: the header's contract.
            unsafe { points(tessellation, |made| &made.positions, out, error) }
        }

        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $normals(
            tessellation: *const carvel_tessellation,
            out: *const Values<$number>,
            error: *mut carvel_error,
        ) -> carvel_status {
            // SAFETY: the header's contract.
            unsafe { points(tessellation, |made| &made.normals, out, error) }
        }
    };
}

twins!(
    f32,
    carvel_tessellation_create_f32,
    carvel_tessellation_positions_f32,
    carvel_tessellation_normals_f32
);
twins!(
    f64,
    carvel_tessellation_create_f64,
    carvel_tessellation_positions_f64,
    carvel_tessellation_normals_f64
);

destroy_function!(carvel_tessellation_destroy, carvel_tessellation);

#[unsafe(no_mangle)]
pub unsafe extern "C" fn carvel_tessellation_counts(
    tessellation: *const carvel_tessellation,
    counts: *mut carvel_triangle_counts,
    error: *mut carvel_error,
) -> carvel_status {
    // SAFETY: the header's contract.
    unsafe {
        call(error, |call| {
            let made = call.object(tessellation)?;
            write(counts, &made.into())
        })
    }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn carvel_tessellation_triangles(
    tessellation: *const carvel_tessellation,
    vertices: *mut u32,
    places: *mut u32,
    faces: *mut u32,
    capacity: u64,
    error: *mut carvel_error,
) -> carvel_status {
    // SAFETY: the header's contract.
    unsafe {
        call(error, |call| {
            let made = call.object(tessellation)?;
            let room = |each| capacity.saturating_mul(each);
            let lists = [
                List::new((vertices, room(3)), made.triangles.as_flattened(), "vertices"),
                List::new((places, room(3)), made.triangle_places.as_flattened(), "places"),
                List::new((faces, capacity), &made.faces, "faces"),
            ];
            let spans = lists.each_ref().map(List::span);
            check_overlap(&spans.into_iter().collect::<Result<Vec<_>>>()?)?;
            for list in lists {
                list.copy();
            }
            Ok(())
        })
    }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn carvel_tessellation_places(
    tessellation: *const carvel_tessellation,
    samples: *mut carvel_sample,
    vertices: *mut u32,
    capacity: u64,
    error: *mut carvel_error,
) -> carvel_status {
    // SAFETY: the header's contract.
    unsafe {
        call(error, |call| {
            let made = call.object(tessellation)?;
            let samples = List::new((samples, capacity), &made.places, "samples");
            let vertices = List::new((vertices, capacity), &made.place_vertices, "vertices");
            check_overlap(&[samples.span()?, vertices.span()?])?;
            samples.copy();
            vertices.copy();
            Ok(())
        })
    }
}
