//! `carvel_surface`: the limit surface at any point.

use super::buffer::{Span, check_overlap, check_pointer, input};
use super::guard::call;
use super::object::{destroy_function, object};
use super::status::{Fault, Result, carvel_status};
use super::stencils::{CARVEL_PRECISION_F32, CARVEL_PRECISION_F64};
use super::values::{ConstValues, Values};
use super::{
    carvel_channel, carvel_context, carvel_error, carvel_mesh, carvel_scheme, carvel_stencils,
};
use crate::base::{Context, Scalar};
use crate::limit::{Derivatives, Sample, Surface};
use crate::sparse::StoredTable;
use std::sync::Arc;

object!(carvel_surface, Arc<Surface>);

pub type carvel_sample = Sample;

pub const CARVEL_DERIVATIVES_NONE: i32 = 0;
pub const CARVEL_DERIVATIVES_FIRST: i32 = 1;
pub const CARVEL_DERIVATIVES_SECOND: i32 = 2;

fn derivatives(which: i32) -> Result<Derivatives> {
    match which {
        CARVEL_DERIVATIVES_NONE => Ok(Derivatives::None),
        CARVEL_DERIVATIVES_FIRST => Ok(Derivatives::First),
        CARVEL_DERIVATIVES_SECOND => Ok(Derivatives::Second),
        other => Err(Fault::out_of_range(format!("there are no derivatives {other}"))),
    }
}

/// # Safety
/// The header's contract.
unsafe fn evaluate<T: Scalar>(
    (surface, context): (*const carvel_surface, *const carvel_context),
    (samples, count): (*const carvel_sample, u64),
    which: i32,
    (values, out): (*const ConstValues<T>, *const Values<T>),
    error: *mut carvel_error,
) -> carvel_status {
    // SAFETY: the caller's contract.
    unsafe {
        call(error, |call| {
            let (surface, context) = (call.object(surface)?, call.context(context)?);
            let which = derivatives(which)?;
            let samples = input(samples, count, "samples")?;
            check_pointer(values, "values")?;
            check_pointer(out, "out")?;
            evaluate_values(surface, &context, samples, which, (values.read(), out.read()))
        })
    }
}

/// # Safety
/// The header's contract.
unsafe fn evaluate_values<T: Scalar>(
    surface: &Surface,
    context: &Context,
    samples: &[Sample],
    which: Derivatives,
    (values, out): (ConstValues<T>, Values<T>),
) -> Result<()> {
    let from = values.check(surface.columns() as u64, "values".into())?;
    // No array of samples is so long that this could overflow.
    let records = samples.len() as u64 * which.records() as u64;
    let to = out.check(records, from.width, "out".into())?;
    let read = Span::of(samples.as_ptr(), size_of_val(samples), false, "samples");
    check_overlap(&[read, from.read_span(), to.write_span()])?;
    context.check_memory(from.copy_bytes::<T>().saturating_add(out.copy_bytes(records)))?;
    // SAFETY: the caller's contract; overlap has been checked.
    let (from, width, mut to) = unsafe { (from.read()?, from.width, to.sink()?) };
    surface.evaluate(context, samples, from.values(), width, which, to.values())?;
    // SAFETY: as above.
    unsafe { to.finish() };
    Ok(())
}

fn table(
    surface: &Surface,
    context: &Context,
    samples: &[Sample],
    which: Derivatives,
    precision: i32,
) -> Result<StoredTable> {
    Ok(match precision {
        CARVEL_PRECISION_F32 => StoredTable::F32(surface.stencils(context, samples, which)?),
        CARVEL_PRECISION_F64 => StoredTable::F64(surface.stencils(context, samples, which)?),
        other => return Err(Fault::out_of_range(format!("there is no precision {other}"))),
    })
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn carvel_surface_create(
    context: *const carvel_context,
    mesh: *const carvel_mesh,
    scheme: *const carvel_scheme,
    out: *mut *mut carvel_surface,
    error: *mut carvel_error,
) -> carvel_status {
    // SAFETY: the header's contract.
    unsafe {
        call(error, |call| {
            call.create(out, |call| {
                let context = call.context(context)?;
                let (mesh, scheme) = (call.object(mesh)?, call.object(scheme)?);
                Ok(Arc::new(Surface::new(&context, &Arc::clone(&mesh.mesh), scheme)?))
            })
        })
    }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn carvel_surface_create_channel(
    context: *const carvel_context,
    channel: *const carvel_channel,
    scheme: *const carvel_scheme,
    out: *mut *mut carvel_surface,
    error: *mut carvel_error,
) -> carvel_status {
    // SAFETY: the header's contract.
    unsafe {
        call(error, |call| {
            call.create(out, |call| {
                let context = call.context(context)?;
                let (bound, scheme) = (call.object(channel)?, call.object(scheme)?);
                let surface = Surface::of_channel(&context, &bound.mesh, &bound.channel, scheme)?;
                Ok(Arc::new(surface))
            })
        })
    }
}

destroy_function!(carvel_surface_destroy, carvel_surface);

#[unsafe(no_mangle)]
pub unsafe extern "C" fn carvel_surface_sectors(
    surface: *const carvel_surface,
    face: u32,
    sectors: *mut u32,
    error: *mut carvel_error,
) -> carvel_status {
    // SAFETY: the header's contract.
    unsafe {
        call(error, |call| {
            let surface = call.object(surface)?;
            check_pointer(sectors, "sectors")?;
            let faces = surface.mesh().faces();
            if face as usize >= faces {
                return Err(Fault::out_of_range(format!("face {face} of {faces}")));
            }
            sectors.write(surface.sectors(face as usize) as u32);
            Ok(())
        })
    }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn carvel_surface_stencils(
    context: *const carvel_context,
    surface: *const carvel_surface,
    samples: *const carvel_sample,
    sample_count: u64,
    which: i32,
    precision: i32,
    out: *mut *mut carvel_stencils,
    error: *mut carvel_error,
) -> carvel_status {
    // SAFETY: the header's contract.
    unsafe {
        call(error, |call| {
            call.create(out, |call| {
                let (context, surface) = (call.context(context)?, call.object(surface)?);
                let which = derivatives(which)?;
                let samples = input(samples, sample_count, "samples")?;
                Ok(table(surface, &context, samples, which, precision)?.into())
            })
        })
    }
}

/// The function that exists for each number type.
macro_rules! twins {
    ($number:ty, $evaluate:ident) => {
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $evaluate(
            surface: *const carvel_surface,
            context: *const carvel_context,
            samples: *const carvel_sample,
            sample_count: u64,
            which: i32,
            values: *const ConstValues<$number>,
            out: *const Values<$number>,
            error: *mut carvel_error,
        ) -> carvel_status {
            let (on, samples) = ((surface, context), (samples, sample_count));
            // SAFETY: the header's contract.
            unsafe { evaluate(on, samples, which, (values, out), error) }
        }
    };
}

twins!(f32, carvel_surface_evaluate_f32);
twins!(f64, carvel_surface_evaluate_f64);
