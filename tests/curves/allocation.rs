//! The system refuses memory: each large allocation in turn.

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;
use std::ptr::null_mut;

use carvel::curve::{Ends, Grid, GridMask, Polygon, Tension};
use carvel::{Context, Error, ErrorKind};

use crate::support::named;

/// Allocations that grow with the input are larger, those for a mask or a message smaller.
const LARGE: usize = 16 << 10;

thread_local! {
    /// Large allocations of this thread until one is refused; −1: none is.
    static LEFT: Cell<i64> = const { Cell::new(-1) };
}

struct Refusing;

fn is_refused(bytes: usize) -> bool {
    if bytes < LARGE {
        return false;
    }
    let left = LEFT.get();
    LEFT.set((left - 1).max(-1));
    left == 0
}

// SAFETY: every call is refused or handed to the system allocator unchanged.
unsafe impl GlobalAlloc for Refusing {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        // SAFETY: the caller's promises are those that `System` asks for.
        if is_refused(layout.size()) { null_mut() } else { unsafe { System.alloc(layout) } }
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        // SAFETY: as above.
        if is_refused(layout.size()) { null_mut() } else { unsafe { System.alloc_zeroed(layout) } }
    }

    unsafe fn realloc(&self, ptr: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        // SAFETY: as above.
        if is_refused(size) { null_mut() } else { unsafe { System.realloc(ptr, layout, size) } }
    }

    unsafe fn dealloc(&self, ptr: *mut u8, layout: Layout) {
        // SAFETY: as above.
        unsafe { System.dealloc(ptr, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Refusing = Refusing;

/// Refuses the first, the second, … large allocation until all succeed; an allocation that
/// does not answer ends the process.
fn refuse_each<R>(what: &str, work: impl Fn() -> Result<R, Error>) {
    for n in 0..100 {
        LEFT.set(n);
        let result = work();
        LEFT.set(-1);
        match result {
            Ok(_) if n > 0 => return,
            Ok(_) => panic!("{what}: nothing large was asked for"),
            Err(error) => assert_eq!(error.kind(), ErrorKind::OutOfResources, "{what}: {error}"),
        }
    }
    panic!("{what}: too many allocations");
}

#[test]
fn refused_memory_is_an_error() {
    let context = Context::serial();
    let (primal, dual) = (named("four-point"), named("chaikin"));
    for ends in [Ends::Closed, Ends::Dropped, Ends::Kept] {
        let polygon = Polygon::new(vec![0.5; 6000], 2, ends);
        refuse_each("refine", || polygon.refine(&context, &dual, 2));
        refuse_each("copy", || polygon.refine(&context, &dual, 0));
        refuse_each("limit", || polygon.limit(&context, &dual, 0));
        let tension = Tension::FourPoint(0.5);
        refuse_each("tension", || polygon.refine_with_tension(&context, tension, 2));
        let edges = 3000 - usize::from(ends != Ends::Closed);
        let ones = vec![1.0; edges];
        refuse_each("local", || polygon.refine_with_local_tension(&context, &ones, 2));
        refuse_each("non-uniform", || polygon.refine_non_uniform(&context, &ones, 2));
        let grid = Grid { points: vec![0.5; 9000], columns: 3000, width: 1, ends: [ends; 2] };
        if ends != Ends::Dropped {
            refuse_each("grid", || grid.refine(&context, [&primal, &dual], 2));
        }
    }
    let line = Polygon::new((0..6000).map(f64::from).collect(), 1, Ends::Closed);
    refuse_each("parameters", || line.parameters(0.5));
    let grid = Grid { points: vec![0.5; 9000], columns: 90, width: 1, ends: [Ends::Closed; 2] };
    let both = GridMask::tensor(&primal, &dual).expect("a mask");
    refuse_each("bivariate", || grid.refine_by(&context, &both, 2));
}
