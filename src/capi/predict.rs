//! Predictions: what a level will cost, before anything is built.

use super::guard::call;
use super::status::{Fault, Result, carvel_status};
use super::versioned::{check, init_function, initial, versioned, write};
use super::{carvel_counts, carvel_error, carvel_mesh, carvel_scheme};
use crate::hierarchy::{Prediction, WIDEST};

versioned! {
    pub struct carvel_bytes {
        pub struct_size: u32,
        pub level: u32,
        pub topology: u64,
        pub scratch: u64,
        pub output: u64,
    }
}

impl carvel_bytes {
    fn of(plan: &Prediction, level: u32, width: u32, value_size: u32) -> Result<Self> {
        if !(1..=WIDEST).contains(&(width as usize)) {
            return Err(Fault::out_of_range(format!("width {width} is not within 1 and {WIDEST}")));
        }
        if ![4, 8].contains(&value_size) {
            return Err(Fault::out_of_range(format!("value_size {value_size} is not 4 or 8")));
        }
        let (width, size) = (u64::from(width), u64::from(value_size));
        let scratch = if level == 0 { 0 } else { plan.scratch_bytes(width, size) };
        Ok(Self {
            level,
            topology: plan.topology_bytes(),
            scratch,
            output: plan.output_bytes(width, size),
            ..initial()
        })
    }
}

init_function!(carvel_bytes_init, carvel_bytes);

#[unsafe(no_mangle)]
pub unsafe extern "C" fn carvel_predict_counts(
    mesh: *const carvel_mesh,
    scheme: *const carvel_scheme,
    level: u32,
    counts: *mut carvel_counts,
    error: *mut carvel_error,
) -> carvel_status {
    // SAFETY: the header's contract.
    unsafe {
        call(error, |call| {
            let (mesh, scheme) = (call.object(mesh)?, call.object(scheme)?);
            check(counts)?;
            let plan = Prediction::new(&mesh.mesh, scheme, level)?;
            write(counts, &carvel_counts::of_level(plan.last(), level))
        })
    }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn carvel_predict_bytes(
    mesh: *const carvel_mesh,
    scheme: *const carvel_scheme,
    level: u32,
    width: u32,
    value_size: u32,
    bytes: *mut carvel_bytes,
    error: *mut carvel_error,
) -> carvel_status {
    // SAFETY: the header's contract.
    unsafe {
        call(error, |call| {
            let (mesh, scheme) = (call.object(mesh)?, call.object(scheme)?);
            check(bytes)?;
            let plan = Prediction::new(&mesh.mesh, scheme, level)?;
            write(bytes, &carvel_bytes::of(&plan, level, width, value_size)?)
        })
    }
}
