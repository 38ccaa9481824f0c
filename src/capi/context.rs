//! `carvel_context`: threads, memory ceiling, progress, cancellation.

use super::carvel_error;
use super::guard::{call, outside};
use super::object::{destroy_function, look, object};
use super::status::carvel_status;
use super::versioned::{init_function, read, versioned};
use crate::base::Context;
use std::ffi::c_void;

object!(carvel_context, Context);

pub type carvel_progress = Option<unsafe extern "C" fn(done: f64, user_data: *mut c_void) -> i32>;

versioned! {
    pub struct carvel_context_desc {
        pub struct_size: u32,
        pub thread_count: u32,
        pub memory_ceiling: u64,
        pub progress: carvel_progress,
        pub user_data: *mut c_void,
    }
}

/// The caller's callback with its data.
struct Callback {
    function: unsafe extern "C" fn(f64, *mut c_void) -> i32,
    user_data: *mut c_void,
}

// SAFETY: the data is only handed back; the header asks for a function that may
// be called from the threads that make calls.
unsafe impl Send for Callback {}
// SAFETY: as above.
unsafe impl Sync for Callback {}

impl Callback {
    /// True to go on.
    fn call(&self, done: f64) -> bool {
        // SAFETY: the header asks for a function that can be called so and returns.
        outside(|| unsafe { (self.function)(done, self.user_data) == 0 })
    }
}

fn context(desc: &carvel_context_desc) -> crate::Result<Context> {
    let mut builder = Context::builder().threads(desc.thread_count as usize);
    if desc.memory_ceiling > 0 {
        builder = builder.memory_ceiling(desc.memory_ceiling);
    }
    if let Some(function) = desc.progress {
        let callback = Callback { function, user_data: desc.user_data };
        builder = builder.progress(move |done| callback.call(done));
    }
    builder.build()
}

init_function!(carvel_context_desc_init, carvel_context_desc);

#[unsafe(no_mangle)]
pub unsafe extern "C" fn carvel_context_create(
    desc: *const carvel_context_desc,
    out: *mut *mut carvel_context,
    error: *mut carvel_error,
) -> carvel_status {
    // SAFETY: the header's contract.
    unsafe { call(error, |call| call.create(out, |_| Ok(context(&read(desc)?)?))) }
}

destroy_function!(carvel_context_destroy, carvel_context);

#[unsafe(no_mangle)]
pub unsafe extern "C" fn carvel_context_thread_count(context: *const carvel_context) -> u32 {
    // SAFETY: the header's contract.
    unsafe { look(context) }.map_or(1, |handle| handle.value.threads() as u32)
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn carvel_context_cancel(context: *mut carvel_context) {
    // SAFETY: the header's contract. Nothing is allocated or locked here, so that
    // a signal handler may call it.
    if let Some(handle) = unsafe { look(context) } {
        handle.value.cancel();
    }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn carvel_context_reset(context: *mut carvel_context) {
    // SAFETY: the header's contract.
    if let Some(handle) = unsafe { look(context) } {
        handle.value.reset();
    }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn carvel_context_is_cancelled(context: *const carvel_context) -> i32 {
    // SAFETY: the header's contract.
    i32::from(unsafe { look(context) }.is_some_and(|handle| handle.value.is_cancelled()))
}
