//! The border: every call that can fail passes through here.
//!
//! A panic is a defect of this library. It is caught, it prints nothing, the call
//! answers `CARVEL_STATUS_PANIC`, and the objects that were lent to it answer
//! `CARVEL_STATUS_POISONED` from then on, for nobody knows what state it left.

use super::context::carvel_context;
use super::error::{carvel_error, fill};
use super::object::{Object, borrow, hand_over};
use super::status::{
    CARVEL_STATUS_MISALIGNED, CARVEL_STATUS_OK, CARVEL_STATUS_PANIC, Fault, Result, carvel_status,
};
use crate::base::Context;
use std::any::Any;
use std::cell::Cell;
use std::ops::Deref;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Once;
use std::sync::atomic::{AtomicBool, Ordering};

/// The most objects that a call is given, but for channels.
const FEW: usize = 4;

/// The objects lent to a call, by their poison flags.
#[derive(Default)]
pub(super) struct Call<'a> {
    lent: [Option<&'a AtomicBool>; FEW],
    more: Vec<&'a AtomicBool>,
}

/// A context: the caller's, or for NULL one that is the calling thread alone.
pub(super) enum Lent<'a> {
    Shared(&'a Context),
    Own(Context),
}

impl Deref for Lent<'_> {
    type Target = Context;

    fn deref(&self) -> &Context {
        match self {
            Self::Shared(context) => context,
            Self::Own(context) => context,
        }
    }
}

impl<'a> Call<'a> {
    /// Borrows an object for the call.
    ///
    /// # Safety
    /// The pointer is NULL, or an object of its type that lives until the call
    /// ends.
    pub(super) unsafe fn object<C: Object>(&mut self, object: *const C) -> Result<&'a C::Inner>
    where
        C::Inner: 'a,
    {
        // SAFETY: the caller's contract.
        let handle = unsafe { borrow(object)? };
        match self.lent.iter_mut().find(|slot| slot.is_none()) {
            Some(free) => *free = Some(&handle.poisoned),
            None => self.more.push(&handle.poisoned),
        }
        Ok(&handle.value)
    }

    /// Borrows the context of a call.
    ///
    /// # Safety
    /// As [`Call::object`].
    pub(super) unsafe fn context(&mut self, context: *const carvel_context) -> Result<Lent<'a>> {
        if context.is_null() {
            return Ok(Lent::Own(Context::serial()));
        }
        // SAFETY: the caller's contract.
        unsafe { self.object(context) }.map(Lent::Shared)
    }

    /// Runs a call that makes an object; on failure `out` becomes NULL.
    ///
    /// # Safety
    /// `out` is NULL or can be written.
    pub(super) unsafe fn create<C: Object>(
        &mut self,
        out: *mut *mut C,
        make: impl FnOnce(&mut Self) -> Result<C::Inner>,
    ) -> Result<()> {
        super::buffer::check_pointer(out, "out")?;
        // SAFETY: checked for NULL and alignment; the rest is the caller's contract.
        unsafe { out.write(std::ptr::null_mut()) };
        let object = hand_over(make(self)?);
        // SAFETY: as above.
        unsafe { out.write(object) };
        Ok(())
    }
}

/// Runs the body of a call and reports what came of it. An `error` that is
/// misaligned is answered before anything else happens.
///
/// # Safety
/// `error` is NULL or an error that no other thread uses now.
pub(super) unsafe fn call<'a>(
    error: *mut carvel_error,
    body: impl FnOnce(&mut Call<'a>) -> Result<()>,
) -> carvel_status {
    if !error.cast::<usize>().is_aligned() {
        return CARVEL_STATUS_MISALIGNED;
    }
    let mut call = Call::default();
    let outcome = quietly(|| body(&mut call)).unwrap_or_else(|panic| {
        for poisoned in call.lent.iter().flatten().chain(&call.more) {
            poisoned.store(true, Ordering::Relaxed);
        }
        Err(Fault::new(
            CARVEL_STATUS_PANIC,
            format!("defect in carvel, please report it: {}", reason(panic.as_ref())),
        ))
    });
    let status = outcome.as_ref().err().map_or(CARVEL_STATUS_OK, |fault| fault.status);
    // SAFETY: the caller's contract.
    unsafe { fill(error, outcome.err()) };
    status
}

thread_local! {
    /// True while a thread is inside a call.
    static INSIDE: Cell<bool> = const { Cell::new(false) };
}

/// Runs work whose panics are caught and print nothing.
pub(super) fn quietly<R>(work: impl FnOnce() -> R) -> Result<R, Box<dyn Any + Send>> {
    silence_own_panics();
    let before = INSIDE.replace(true);
    let outcome = catch_unwind(AssertUnwindSafe(work));
    INSIDE.set(before);
    outcome
}

/// Runs the caller's own code in the middle of a call: its panics are not ours.
pub(super) fn outside<R>(work: impl FnOnce() -> R) -> R {
    let before = INSIDE.replace(false);
    let result = work();
    INSIDE.set(before);
    result
}

/// Makes the panic hook say nothing about threads that are inside a call or
/// belong to a context; everybody else's panics go where they went before.
fn silence_own_panics() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        let before = std::panic::take_hook();
        std::panic::set_hook(Box::new(move |info| {
            let thread = std::thread::current();
            let own = thread.name().is_some_and(|name| name.starts_with("carvel-"));
            if !own && !INSIDE.get() {
                before(info);
            }
        }));
    });
}

fn reason(panic: &(dyn Any + Send)) -> &str {
    let text = panic.downcast_ref::<&str>().copied();
    text.or_else(|| panic.downcast_ref::<String>().map(String::as_str)).unwrap_or("no reason given")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::capi::{
        CARVEL_STATUS_POISONED, carvel_error_create, carvel_error_destroy, carvel_error_message,
        carvel_refiner, carvel_refiner_bytes, carvel_refiner_create, carvel_refiner_destroy,
    };
    use std::ffi::CStr;
    use std::process::Command;
    use std::ptr::{from_mut, null_mut};

    /// A call with a refiner that runs into a defect.
    fn defect(refiner: *mut carvel_refiner, error: *mut carvel_error) -> carvel_status {
        // SAFETY: both objects live, and belong to this thread.
        unsafe {
            call(error, |call| {
                call.object(refiner.cast_const())?;
                panic!("planted {}", 7);
            })
        }
    }

    #[test]
    fn a_panic_is_answered_and_poisons_what_it_was_lent() {
        let (mut refiner, mut error) = (null_mut(), null_mut());
        // SAFETY: valid pointers to write to, and objects that live until the end.
        unsafe {
            assert_eq!(carvel_error_create(from_mut(&mut error)), CARVEL_STATUS_OK);
            assert_eq!(carvel_refiner_create(from_mut(&mut refiner), error), CARVEL_STATUS_OK);
            assert_eq!(defect(refiner, error), CARVEL_STATUS_PANIC);
            let text = CStr::from_ptr(carvel_error_message(error)).to_str().unwrap();
            assert!(text.contains("planted 7"), "{text}");
            assert_eq!(defect(refiner, error), CARVEL_STATUS_POISONED);
            let text = CStr::from_ptr(carvel_error_message(error)).to_str().unwrap();
            assert!(text.starts_with("carvel_refiner was left unusable"), "{text}");
            assert_eq!(carvel_refiner_bytes(refiner), 0);
            carvel_refiner_destroy(refiner);
            carvel_error_destroy(error);
        }
    }

    /// Run by the test below, in a process of its own.
    #[test]
    #[ignore = "prints what its parent looks for"]
    fn two_panics() {
        assert_eq!(defect(null_mut(), null_mut()), super::super::CARVEL_STATUS_NULL_POINTER);
        assert!(quietly(|| panic!("a quiet one")).is_err());
        let pool = Context::builder().threads(2).build().unwrap();
        let work = |i: u32| assert_ne!(i, 1, "a quiet worker");
        assert!(quietly(|| pool.for_each(vec![0, 1, 2], work)).is_err());
        assert!(catch_unwind(|| panic!("a loud one")).is_err());
    }

    #[test]
    fn own_panics_print_nothing_and_others_as_before() {
        let this = std::env::current_exe().unwrap();
        let run = Command::new(this)
            .args(["capi::guard::tests::two_panics", "--exact", "--ignored", "--nocapture"])
            .output()
            .unwrap();
        let text = String::from_utf8_lossy(&run.stderr);
        assert!(run.status.success(), "{text}");
        assert!(text.contains("a loud one") && !text.contains("a quiet"), "{text}");
    }
}
