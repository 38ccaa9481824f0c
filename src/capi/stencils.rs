//! `carvel_stencils`: rows of weights, kept to be applied every frame.

use super::buffer::{Span, Target, check_overlap, check_pointer, input};
use super::guard::call;
use super::object::{destroy_function, object};
use super::status::{Fault, Result, carvel_status};
use super::values::{ConstValues, Values, interpolation};
use super::versioned::{init_function, initial, read, versioned, write};
use super::{carvel_context, carvel_error, carvel_hierarchy};
use crate::base::{Context, Error, ErrorKind, Scalar};
use crate::hierarchy::{Hierarchy, StencilTask};
use crate::limit::Limits;
use crate::sparse::{Dependents, Records, RecordsMut, StencilTable, StoredTable};
use std::ffi::{CStr, c_char};
use std::fs::File;
use std::path::PathBuf;
use std::sync::OnceLock;

object!(carvel_stencils, Stencils);

pub const CARVEL_PRECISION_F32: i32 = 0;
pub const CARVEL_PRECISION_F64: i32 = 1;

versioned! {
    pub struct carvel_stencils_desc {
        pub struct_size: u32,
        pub from_level: u32,
        pub level: u32,
        pub interpolation: i32,
        pub precision: i32,
        pub reserved: u32,
        pub vertices: *const u32,
        pub vertex_count: u64,
    }
}

versioned! {
    pub struct carvel_stencil_counts {
        pub struct_size: u32,
        pub precision: i32,
        pub rows: u64,
        pub columns: u64,
        pub entries: u64,
        pub bytes: u64,
    }
}

/// A table, and what is made of it when it is asked for first.
pub(super) struct Stencils {
    table: StoredTable,
    transpose: OnceLock<StoredTable>,
    dependents: OnceLock<Dependents>,
}

/// Calls a generic expression for a table of either number type.
macro_rules! each_precision {
    ($stored:expr, $table:ident => $body:expr) => {
        match $stored {
            StoredTable::F32($table) => $body,
            StoredTable::F64($table) => $body,
        }
    };
}

/// What to do with values.
#[derive(Clone, Copy)]
enum Verb<'a> {
    Apply,
    Add,
    Transpose,
    Update(&'a [u32]),
}

impl From<StoredTable> for Stencils {
    fn from(table: StoredTable) -> Self {
        Self { table, transpose: OnceLock::new(), dependents: OnceLock::new() }
    }
}

impl Stencils {
    fn of(context: &Context, hierarchy: &Hierarchy, desc: &carvel_stencils_desc) -> Result<Self> {
        if desc.reserved != 0 {
            return Err(Fault::out_of_range("reserved is set"));
        }
        // SAFETY: the caller of `carvel_stencils_create` keeps the header's contract.
        let vertices = unsafe { input(desc.vertices, desc.vertex_count, "vertices")? };
        let all = desc.vertices.is_null();
        let task = StencilTask {
            from: desc.from_level,
            to: desc.level,
            interpolation: interpolation(desc.interpolation)?,
            vertices: (!all).then_some(vertices),
        };
        let table = match desc.precision {
            CARVEL_PRECISION_F32 => StoredTable::F32(hierarchy.stencils(context, &task)?),
            CARVEL_PRECISION_F64 => StoredTable::F64(hierarchy.stencils(context, &task)?),
            other => return Err(Fault::out_of_range(format!("there is no precision {other}"))),
        };
        Ok(table.into())
    }

    /// Limit positions and tangents of a level on its own vertices.
    fn limits(
        context: &Context,
        hierarchy: &Hierarchy,
        level: u32,
        precision: i32,
    ) -> Result<Self> {
        let (mesh, scheme) = (hierarchy.shared_mesh(level)?, hierarchy.scheme());
        let table = match precision {
            CARVEL_PRECISION_F32 => {
                StoredTable::F32(Limits::new(context, &mesh, scheme)?.stacked()?)
            }
            CARVEL_PRECISION_F64 => {
                StoredTable::F64(Limits::new(context, &mesh, scheme)?.stacked()?)
            }
            other => return Err(Fault::out_of_range(format!("there is no precision {other}"))),
        };
        Ok(table.into())
    }

    /// One after another, in the number type of both.
    fn product(context: &Context, first: &Self, then: &Self) -> Result<Self> {
        let table = match (&first.table, &then.table) {
            (StoredTable::F32(a), StoredTable::F32(b)) => StoredTable::F32(a.compose(context, b)?),
            (StoredTable::F64(a), StoredTable::F64(b)) => StoredTable::F64(a.compose(context, b)?),
            _ => return Err(Fault::out_of_range("tables of different precisions")),
        };
        Ok(table.into())
    }

    fn counts(&self) -> carvel_stencil_counts {
        let precision = match self.table {
            StoredTable::F32(_) => CARVEL_PRECISION_F32,
            StoredTable::F64(_) => CARVEL_PRECISION_F64,
        };
        let mut bytes = self.dependents.get().map_or(0, Dependents::bytes);
        if let Some(turned) = self.transpose.get() {
            bytes += each_precision!(turned, table => table.bytes());
        }
        each_precision!(&self.table, table => carvel_stencil_counts {
            precision,
            rows: table.rows() as u64,
            columns: table.columns() as u64,
            entries: table.entries() as u64,
            bytes: bytes + table.bytes(),
            ..initial()
        })
    }

    fn turned(&self, context: &Context) -> Result<StoredTable> {
        Ok(match &self.table {
            StoredTable::F32(table) => StoredTable::F32(table.transpose(context)?),
            StoredTable::F64(table) => StoredTable::F64(table.transpose(context)?),
        })
    }

    /// The transpose, which is kept.
    fn transpose(&self, context: &Context) -> Result<&StoredTable> {
        if let Some(turned) = self.transpose.get() {
            return Ok(turned);
        }
        // Two threads may both make it; they make the same.
        let turned = self.turned(context)?;
        Ok(self.transpose.get_or_init(|| turned))
    }

    fn dependents(&self, context: &Context) -> Result<&Dependents> {
        if let Some(dependents) = self.dependents.get() {
            return Ok(dependents);
        }
        let made = each_precision!(&self.table, table => table.dependents(context)?);
        Ok(self.dependents.get_or_init(|| made))
    }

    fn run<V: Scalar>(
        &self,
        context: &Context,
        verb: Verb,
        values: Records<V>,
        out: RecordsMut<V>,
    ) -> Result<()> {
        let stored =
            if matches!(verb, Verb::Transpose) { self.transpose(context)? } else { &self.table };
        each_precision!(stored, table => match verb {
            Verb::Apply | Verb::Transpose => table.apply(context, values, out)?,
            Verb::Add => table.apply_add(context, values, out)?,
            Verb::Update(changed) => {
                table.update(context, self.dependents(context)?, changed, values, out)?;
            }
        });
        Ok(())
    }
}

/// # Safety
/// The header's contract.
unsafe fn run<V: Scalar>(
    (stencils, context): (*const carvel_stencils, *const carvel_context),
    verb: impl FnOnce() -> Result<Verb<'static>>,
    (values, out): (*const ConstValues<V>, *const Values<V>),
    error: *mut carvel_error,
) -> carvel_status {
    // SAFETY: the caller's contract.
    unsafe {
        call(error, |call| {
            let stencils = call.object(stencils)?;
            let context = call.context(context)?;
            let verb = verb()?;
            check_pointer(values, "values")?;
            check_pointer(out, "out")?;
            let counts = stencils.counts();
            let (read, written) = match verb {
                Verb::Transpose => (counts.rows, counts.columns),
                _ => (counts.columns, counts.rows),
            };
            let from = values.read().check(read, "values".into())?;
            let to = out.read().check(written, from.width, "out".into())?;
            let mut spans = vec![from.read_span().hull(), to.write_span().hull()];
            if let Verb::Update(changed) = verb {
                spans.push(Span::of(changed.as_ptr(), size_of_val(changed), false, "changed"));
            }
            check_overlap(&spans)?;
            stencils.run(&context, verb, from.strided()?, to.strided()?)
        })
    }
}

/// # Safety
/// The header's contract.
unsafe fn csr<V: Scalar>(
    stencils: *const carvel_stencils,
    (offsets, offset_capacity): (*mut u64, u64),
    (indices, weights, capacity): (*mut u32, *mut V, u64),
    error: *mut carvel_error,
) -> carvel_status {
    // SAFETY: the caller's contract.
    unsafe {
        call(error, |call| {
            let stencils = call.object(stencils)?;
            let counts = stencils.counts();
            let offsets = Target::new((offsets, offset_capacity), counts.rows + 1, "offsets");
            let indices = Target::new((indices, capacity), counts.entries, "indices");
            let weights = Target::new((weights, capacity), counts.entries, "weights");
            check_overlap(&[offsets.span()?, indices.span()?, weights.span()?])?;
            let (offsets, indices, weights) = (offsets.slice(), indices.slice(), weights.slice());
            each_precision!(&stencils.table, table => fill(table, offsets, indices, weights));
            Ok(())
        })
    }
}

/// Copies a table into arrays of its size.
fn fill<T: Scalar, V: Scalar>(
    table: &StencilTable<T>,
    offsets: &mut [u64],
    indices: &mut [u32],
    weights: &mut [V],
) {
    for (slot, &offset) in offsets.iter_mut().zip(table.offsets()) {
        *slot = u64::from(offset);
    }
    indices.copy_from_slice(table.indices());
    for (slot, weight) in weights.iter_mut().zip(table.weights()) {
        *slot = V::from_f64(weight.to_f64());
    }
}

/// A path in UTF-8; on Unix any bytes.
///
/// # Safety
/// NULL, or a string that ends with a zero byte.
unsafe fn path(text: *const c_char) -> Result<PathBuf> {
    check_pointer(text, "path")?;
    // SAFETY: the caller's contract.
    let text = unsafe { CStr::from_ptr(text) };
    #[cfg(unix)]
    let path = {
        use std::os::unix::ffi::OsStrExt;
        std::ffi::OsStr::from_bytes(text.to_bytes()).into()
    };
    #[cfg(not(unix))]
    let path = text.to_str().map_err(|_| Fault::out_of_range("the path is no UTF-8"))?.into();
    Ok(path)
}

/// Adds the path to what went wrong with its file.
fn at_path(path: &std::path::Path) -> impl Fn(Error) -> Error + '_ {
    move |error| error.in_context(path.display())
}

init_function!(carvel_stencils_desc_init, carvel_stencils_desc);
init_function!(carvel_stencil_counts_init, carvel_stencil_counts);

#[unsafe(no_mangle)]
pub unsafe extern "C" fn carvel_stencils_create(
    context: *const carvel_context,
    hierarchy: *const carvel_hierarchy,
    desc: *const carvel_stencils_desc,
    out: *mut *mut carvel_stencils,
    error: *mut carvel_error,
) -> carvel_status {
    // SAFETY: the header's contract.
    unsafe {
        call(error, |call| {
            call.create(out, |call| {
                let (context, hierarchy) = (call.context(context)?, call.object(hierarchy)?);
                Stencils::of(&context, hierarchy, &read(desc)?)
            })
        })
    }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn carvel_stencils_create_limits(
    context: *const carvel_context,
    hierarchy: *const carvel_hierarchy,
    level: u32,
    precision: i32,
    out: *mut *mut carvel_stencils,
    error: *mut carvel_error,
) -> carvel_status {
    // SAFETY: the header's contract.
    unsafe {
        call(error, |call| {
            call.create(out, |call| {
                let (context, hierarchy) = (call.context(context)?, call.object(hierarchy)?);
                Stencils::limits(&context, hierarchy, level, precision)
            })
        })
    }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn carvel_stencils_product(
    context: *const carvel_context,
    first: *const carvel_stencils,
    then: *const carvel_stencils,
    out: *mut *mut carvel_stencils,
    error: *mut carvel_error,
) -> carvel_status {
    // SAFETY: the header's contract.
    unsafe {
        call(error, |call| {
            call.create(out, |call| {
                let context = call.context(context)?;
                Stencils::product(&context, call.object(first)?, call.object(then)?)
            })
        })
    }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn carvel_stencils_transpose(
    context: *const carvel_context,
    stencils: *const carvel_stencils,
    out: *mut *mut carvel_stencils,
    error: *mut carvel_error,
) -> carvel_status {
    // SAFETY: the header's contract.
    unsafe {
        call(error, |call| {
            call.create(out, |call| {
                let context = call.context(context)?;
                Ok(call.object(stencils)?.turned(&context)?.into())
            })
        })
    }
}

destroy_function!(carvel_stencils_destroy, carvel_stencils);

#[unsafe(no_mangle)]
pub unsafe extern "C" fn carvel_stencils_counts(
    stencils: *const carvel_stencils,
    counts: *mut carvel_stencil_counts,
    error: *mut carvel_error,
) -> carvel_status {
    // SAFETY: the header's contract.
    unsafe { call(error, |call| write(counts, &call.object(stencils)?.counts())) }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn carvel_stencils_save(
    stencils: *const carvel_stencils,
    path_text: *const c_char,
    error: *mut carvel_error,
) -> carvel_status {
    // SAFETY: the header's contract.
    unsafe {
        call(error, |call| {
            let (stencils, path) = (call.object(stencils)?, path(path_text)?);
            let file = File::create(&path).map_err(|e| Error::io(path.display(), e))?;
            each_precision!(&stencils.table, table => table.write(file).map_err(at_path(&path))?);
            Ok(())
        })
    }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn carvel_stencils_load(
    path_text: *const c_char,
    out: *mut *mut carvel_stencils,
    error: *mut carvel_error,
) -> carvel_status {
    // SAFETY: the header's contract.
    unsafe {
        call(error, |call| {
            call.create(out, |_| {
                let path = path(path_text)?;
                let file = File::open(&path).map_err(|e| Error::io(path.display(), e))?;
                if file.metadata().is_ok_and(|meta| meta.is_dir()) {
                    let message = format!("{}: a directory", path.display());
                    return Err(Error::new(ErrorKind::Io, message).into());
                }
                let input = std::io::BufReader::new(file);
                Ok(StoredTable::read(input).map_err(at_path(&path))?.into())
            })
        })
    }
}

/// The functions that exist for each number type.
macro_rules! twins {
    ($number:ty, $csr:ident, $update:ident, $($verb:ident => $apply:ident,)*) => {
        $(
            #[unsafe(no_mangle)]
            pub unsafe extern "C" fn $apply(
                stencils: *const carvel_stencils,
                context: *const carvel_context,
                values: *const ConstValues<$number>,
                out: *const Values<$number>,
                error: *mut carvel_error,
            ) -> carvel_status {
                // SAFETY: the header's contract.
                unsafe { run((stencils, context), || Ok(Verb::$verb), (values, out), error) }
            }
        )*

        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $update(
            stencils: *const carvel_stencils,
            context: *const carvel_context,
            changed: *const u32,
            changed_count: u64,
            values: *const ConstValues<$number>,
            out: *const Values<$number>,
            error: *mut carvel_error,
        ) -> carvel_status {
            // SAFETY: the header's contract; the list lives as long as the call.
            let verb = || Ok(Verb::Update(unsafe { input(changed, changed_count, "changed")? }));
            // SAFETY: the header's contract.
            unsafe { run((stencils, context), verb, (values, out), error) }
        }

        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $csr(
            stencils: *const carvel_stencils,
            offsets: *mut u64,
            offset_capacity: u64,
            indices: *mut u32,
            weights: *mut $number,
            capacity: u64,
            error: *mut carvel_error,
        ) -> carvel_status {
            let (offsets, entries) = ((offsets, offset_capacity), (indices, weights, capacity));
            // SAFETY: the header's contract.
            unsafe { csr(stencils, offsets, entries, error) }
        }
    };
}

twins!(
    f32,
    carvel_stencils_csr_f32,
    carvel_stencils_update_f32,
    Apply => carvel_stencils_apply_f32,
    Add => carvel_stencils_apply_add_f32,
    Transpose => carvel_stencils_apply_transpose_f32,
);
twins!(
    f64,
    carvel_stencils_csr_f64,
    carvel_stencils_update_f64,
    Apply => carvel_stencils_apply_f64,
    Add => carvel_stencils_apply_add_f64,
    Transpose => carvel_stencils_apply_transpose_f64,
);
