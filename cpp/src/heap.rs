//! How the C library's heap, which both sides allocate from, treats large arrays; and its clock.

use crate::bridge::ffi;

/// Large arrays come from pages that nobody has touched, and are given back when freed.
///
/// This is the state of a fresh process. Without it the C library raises its threshold
/// for such arrays each time one is freed, and the second call of a program is served
/// from memory that the first one touched.
pub fn fresh() {
    ffi::heap_fresh();
}

/// Freed memory stays with the process and is handed out again, already touched.
pub fn keep() {
    ffi::heap_keep();
}

/// Gives free memory back to the system.
pub fn trim() {
    ffi::heap_trim();
}

/// Processor time of this process in seconds, page faults included: other programs on
/// a shared machine do not count.
pub fn cpu_seconds() -> f64 {
    ffi::cpu_seconds()
}
