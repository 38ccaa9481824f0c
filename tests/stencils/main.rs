//! Stencil tables as matrices: every operation against sums written out, on small random
//! tables whose weights and values are such that all arithmetic is exact.
//!
//! That tables do what refinement does is told by `tests/cases/stencils.rs`.

#![allow(clippy::float_cmp, reason = "what is exact is compared exactly")]

mod files;
mod operators;
mod refused;
mod regular;
mod tables;
mod threads;
