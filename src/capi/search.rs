//! `carvel_search`: closest points of a limit surface, and where rays meet it.

use super::buffer::{Span, Target, check_overlap, check_pointer, input};
use super::guard::{Call, call};
use super::object::{destroy_function, object};
use super::status::{Result, carvel_status};
use super::values::ConstValues;
use super::{carvel_context, carvel_error, carvel_sample, carvel_surface};
use crate::base::{Context, NONE, Scalar, memory};
use crate::limit::{Closest, Hit, Ray, Search, Surface};
use std::sync::Arc;

object!(carvel_search, Search);

#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct carvel_closest {
    pub sample: carvel_sample,
    pub point: [f64; 3],
    pub distance: f64,
}

pub type carvel_ray = Ray;

#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct carvel_hit {
    pub sample: carvel_sample,
    pub point: [f64; 3],
    pub t: f64,
}

/// Where nothing was found.
const NOWHERE: carvel_sample = carvel_sample { face: NONE, sector: 0, u: 0.0, v: 0.0 };

impl From<Option<Closest>> for carvel_closest {
    fn from(found: Option<Closest>) -> Self {
        match found {
            Some(Closest { sample, point, distance }) => Self { sample, point, distance },
            None => Self { sample: NOWHERE, point: [0.0; 3], distance: f64::INFINITY },
        }
    }
}

impl From<Option<Hit>> for carvel_hit {
    fn from(found: Option<Hit>) -> Self {
        match found {
            Some(Hit { sample, point, t }) => Self { sample, point, t },
            None => Self { sample: NOWHERE, point: [0.0; 3], t: f64::INFINITY },
        }
    }
}

/// # Safety
/// The header's contract.
unsafe fn search<T: Scalar>(
    context: &Context,
    surface: &Arc<Surface>,
    positions: ConstValues<T>,
) -> Result<Search> {
    let from = positions.check_positions(surface.columns() as u64, "positions".into())?;
    context.check_memory(from.copy_bytes::<T>())?;
    // SAFETY: the caller's contract.
    let positions = unsafe { from.read()? };
    Ok(Search::new(context, surface, positions.values())?)
}

/// Runs queries, and writes a result for each.
///
/// # Safety
/// The header's contract.
unsafe fn run<Q, F: Copy, R: Copy + From<Option<F>>>(
    call: &mut Call,
    (search, context): (*const carvel_search, *const carvel_context),
    (queries, count, name): (*const Q, u64, &'static str),
    out: *mut R,
    work: impl FnOnce(&Search, &Context, &[Q], &mut [Option<F>]) -> crate::base::Result<()>,
) -> Result<()> {
    // SAFETY: the caller's contract.
    unsafe {
        let (search, context) = (call.object(search)?, call.context(context)?);
        let queries = input(queries, count, name)?;
        let out = Target::new((out, count), count, "out");
        let read = Span::of(queries.as_ptr(), size_of_val(queries), false, name);
        check_overlap(&[read, out.span()?])?;
        context.check_memory(count.saturating_mul(size_of::<Option<F>>() as u64))?;
        let mut found = memory::filled(None, queries.len())?;
        work(search, &context, queries, &mut found)?;
        for (slot, found) in out.slice().iter_mut().zip(found) {
            *slot = found.into();
        }
        Ok(())
    }
}

/// The function that exists for each number type.
macro_rules! twins {
    ($number:ty, $create:ident) => {
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $create(
            context: *const carvel_context,
            surface: *const carvel_surface,
            positions: *const ConstValues<$number>,
            out: *mut *mut carvel_search,
            error: *mut carvel_error,
        ) -> carvel_status {
            // SAFETY: the header's contract.
            unsafe {
                call(error, |call| {
                    call.create(out, |call| {
                        let (context, surface) = (call.context(context)?, call.object(surface)?);
                        check_pointer(positions, "positions")?;
                        search(&context, surface, positions.read())
                    })
                })
            }
        }
    };
}

twins!(f32, carvel_search_create_f32);
twins!(f64, carvel_search_create_f64);

destroy_function!(carvel_search_destroy, carvel_search);

#[unsafe(no_mangle)]
pub unsafe extern "C" fn carvel_search_closest(
    search: *const carvel_search,
    context: *const carvel_context,
    points: *const f64,
    point_count: u64,
    reach: f64,
    out: *mut carvel_closest,
    error: *mut carvel_error,
) -> carvel_status {
    // SAFETY: the header's contract.
    unsafe {
        call(error, |call| {
            let points = (points.cast::<[f64; 3]>(), point_count, "points");
            run(call, (search, context), points, out, |search, context, points, found| {
                search.closest(context, points, reach, found)
            })
        })
    }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn carvel_search_intersect(
    search: *const carvel_search,
    context: *const carvel_context,
    rays: *const carvel_ray,
    ray_count: u64,
    out: *mut carvel_hit,
    error: *mut carvel_error,
) -> carvel_status {
    // SAFETY: the header's contract.
    unsafe {
        call(error, |call| {
            let rays = (rays, ray_count, "rays");
            run(call, (search, context), rays, out, |search, context, rays, found| {
                search.intersect(context, rays, found)
            })
        })
    }
}
