//! Handles: what is behind C's opaque pointers.
//!
//! | C type | owned by the caller | shared between calls |
//! |---|---|---|
//! | `carvel_error` | box, one thread at a time | – |
//! | `carvel_context` | box | by reference |
//! | `carvel_scheme` | box | by reference; a hierarchy clones it |
//! | `carvel_mesh` | box around a counted reference | hierarchies and channels hold others |
//! | `carvel_channel` | box | by reference |
//! | `carvel_refiner` | box around a lock | one call at a time |
//! | `carvel_hierarchy` | box | by reference |
//! | `carvel_stencils` | box | by reference; what it makes when first asked is kept |
//! | `carvel_surface` | box around a counted reference | searches hold others |
//! | `carvel_search` | box | by reference |
//! | `carvel_tessellation` | box | by reference |
//! | `carvel_mask`, `carvel_grid_mask` | box | by reference |

use super::status::{
    CARVEL_STATUS_MISALIGNED, CARVEL_STATUS_POISONED, Fault, Result, carvel_status,
};
use std::sync::atomic::{AtomicBool, Ordering};

/// An object in the caller's hands.
pub(super) struct Handle<T> {
    pub(super) poisoned: AtomicBool,
    pub(super) value: T,
}

/// A C type and what it stands for.
pub(super) trait Object {
    type Inner: Send + Sync;
    const NAME: &'static str;
}

/// Defines an opaque C type.
macro_rules! object {
    ($name:ident, $inner:ty) => {
        #[repr(C)]
        pub struct $name {
            _private: [u8; 0],
        }

        impl $crate::capi::object::Object for $name {
            type Inner = $inner;
            const NAME: &'static str = stringify!($name);
        }
    };
}
pub(super) use object;

/// Defines the function that takes an object back.
macro_rules! destroy_function {
    ($name:ident, $object:ty) => {
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $name(object: *mut $object) {
            // SAFETY: the header's contract.
            unsafe { $crate::capi::object::destroy(object) }
        }
    };
}
pub(super) use destroy_function;

/// Hands a new object over to the caller.
pub(super) fn hand_over<C: Object>(value: C::Inner) -> *mut C {
    Box::into_raw(Box::new(Handle { poisoned: AtomicBool::new(false), value })).cast()
}

/// Borrows an object, whatever state it is in.
///
/// # Safety
/// The pointer is NULL, or was made by [`hand_over`] for the same type and not
/// been taken back.
pub(super) unsafe fn look<'a, C: Object>(object: *const C) -> Option<&'a Handle<C::Inner>> {
    let handle = object.cast::<Handle<C::Inner>>();
    // SAFETY: by the contract it is a handle of this type if it is not NULL; one
    // that is misaligned cannot be and is not followed.
    if handle.is_aligned() { unsafe { handle.as_ref() } } else { None }
}

/// Borrows an object that a call needs.
///
/// # Safety
/// As [`look`].
pub(super) unsafe fn borrow<'a, C: Object>(object: *const C) -> Result<&'a Handle<C::Inner>> {
    if object.is_null() {
        return Err(Fault::null(C::NAME));
    }
    // SAFETY: the caller's contract.
    let Some(handle) = (unsafe { look(object) }) else {
        return Err(fault::<C>(CARVEL_STATUS_MISALIGNED, "is misaligned"));
    };
    if handle.poisoned.load(Ordering::Relaxed) {
        return Err(poisoned::<C>());
    }
    Ok(handle)
}

/// The answer of an object after a defect.
pub(super) fn poisoned<C: Object>() -> Fault {
    fault::<C>(
        CARVEL_STATUS_POISONED,
        "was left unusable by a defect of the library, caught in an earlier call",
    )
}

fn fault<C: Object>(status: carvel_status, what: &str) -> Fault {
    Fault::new(status, format!("{} {what}", C::NAME))
}

/// Takes an object back and destroys it.
///
/// # Safety
/// As [`look`], and nothing uses the object any more.
pub(super) unsafe fn destroy<C: Object>(object: *mut C) {
    let handle = object.cast::<Handle<C::Inner>>();
    if handle.is_null() || !handle.is_aligned() {
        return;
    }
    // A destructor that panics has nobody to tell; the memory is given up.
    let _ = super::guard::quietly(|| {
        // SAFETY: the caller's contract: made by `hand_over`, and not used again.
        drop(unsafe { Box::from_raw(handle) });
    });
}
