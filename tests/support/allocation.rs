//! How much memory the calling thread asks for, counted on the way.
//!
//! A test binary that measures declares
//! `#[global_allocator] static COUNTER: Counter = Counter;`.

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

thread_local! {
    static BYTES: Cell<usize> = const { Cell::new(0) };
}

/// The system's allocator with a counter per thread.
pub struct Counter;

fn count(bytes: usize) {
    // A thread at its end has no counter any more and needs none.
    let _ = BYTES.try_with(|sum| sum.set(sum.get().saturating_add(bytes)));
}

// SAFETY: every call goes to the system's allocator with the caller's own
// arguments; counting neither allocates nor unwinds.
unsafe impl GlobalAlloc for Counter {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        count(layout.size());
        // SAFETY: the caller keeps the contract, which is the same.
        unsafe { System.alloc(layout) }
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        count(layout.size());
        // SAFETY: as above.
        unsafe { System.alloc_zeroed(layout) }
    }

    unsafe fn realloc(&self, at: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        count(size.saturating_sub(layout.size()));
        // SAFETY: as above.
        unsafe { System.realloc(at, layout, size) }
    }

    unsafe fn dealloc(&self, at: *mut u8, layout: Layout) {
        // SAFETY: as above.
        unsafe { System.dealloc(at, layout) }
    }
}

/// Bytes that a call asks for on this thread, freed or not.
pub fn bytes_of<R>(call: impl FnOnce() -> R) -> (R, usize) {
    let before = BYTES.with(Cell::get);
    let result = call();
    (result, BYTES.with(Cell::get) - before)
}
