//! Curves and the exact analysis of schemes, against masks and properties that were computed
//! independently (`curve_schemes.json`), formulas, and the mesh side of this library.

#![allow(clippy::float_cmp, reason = "what is exact is compared exactly")]

mod allocation;
mod catalogue;
mod factors;
mod grids;
mod limits;
mod paper;
mod radii;
mod ranges;
mod refinement;
#[expect(dead_code, reason = "shared with the kernel's tests, which use all of it")]
#[path = "../kernel/support/rng.rs"]
mod rng;
mod schemes;
mod shapes;
mod support;
