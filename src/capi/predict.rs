//! Predictions: what a level will cost, before anything is built.

use super::guard::call;
use super::status::{Fault, Result, carvel_status};
use super::versioned::{check, init_function, initial, versioned, write};
use super::{carvel_counts, carvel_error, carvel_mesh, carvel_scheme};
use crate::base::MOST_THREADS;
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

versioned! {
    pub struct carvel_seconds {
        pub struct_size: u32,
        pub level: u32,
        pub steps: f64,
        pub last: f64,
        pub memory: f64,
        pub total: f64,
    }
}

/// Values per vertex and bytes per value.
fn record(width: u32, value_size: u32) -> Result<(u64, u64)> {
    if !(1..=WIDEST).contains(&(width as usize)) {
        return Err(Fault::out_of_range(format!("width {width} is not within 1 and {WIDEST}")));
    }
    if ![4, 8].contains(&value_size) {
        return Err(Fault::out_of_range(format!("value_size {value_size} is not 4 or 8")));
    }
    Ok((u64::from(width), u64::from(value_size)))
}

impl carvel_bytes {
    fn of(plan: &Prediction, level: u32, width: u32, value_size: u32) -> Result<Self> {
        let (width, size) = record(width, value_size)?;
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

impl carvel_seconds {
    fn of(plan: &Prediction, level: u32, record: (u64, u64), threads: u32) -> Result<Self> {
        if !(1..=MOST_THREADS).contains(&(threads as usize)) {
            return Err(Fault::out_of_range(format!(
                "threads {threads} is not within 1 and {MOST_THREADS}"
            )));
        }
        let seconds = plan.seconds(record.0, record.1, threads as usize);
        let (steps, last, memory) = (seconds.steps, seconds.last, seconds.memory);
        Ok(Self { level, steps, last, memory, total: seconds.total(), ..initial() })
    }
}

init_function!(carvel_bytes_init, carvel_bytes);
init_function!(carvel_seconds_init, carvel_seconds);

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

#[unsafe(no_mangle)]
pub unsafe extern "C" fn carvel_predict_seconds(
    mesh: *const carvel_mesh,
    scheme: *const carvel_scheme,
    level: u32,
    width: u32,
    value_size: u32,
    threads: u32,
    seconds: *mut carvel_seconds,
    error: *mut carvel_error,
) -> carvel_status {
    // SAFETY: the header's contract.
    unsafe {
        call(error, |call| {
            let (mesh, scheme) = (call.object(mesh)?, call.object(scheme)?);
            check(seconds)?;
            let plan = Prediction::new(&mesh.mesh, scheme, level)?;
            let record = record(width, value_size)?;
            write(seconds, &carvel_seconds::of(&plan, level, record, threads)?)
        })
    }
}
