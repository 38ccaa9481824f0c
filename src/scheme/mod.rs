//! Schemes: a split and the weights that go with it, written once.
//!
//! A scheme gives one row of (vertex, weight) for every new vertex and hands it
//! to a [`RowSink`]. Whoever needs the weights (refinement, stencil tables,
//! exact tests) consumes these rows; nobody writes a weight a second time.

mod averaging;
mod corner;
mod mirror;
mod presets;
mod regular;
mod rows;

#[cfg(feature = "capi")]
pub(crate) use averaging::MOST_PASSES;
pub use averaging::{Boundary, Scheme};
pub use corner::CornerRule;
pub(crate) use corner::CornerWeights;
pub(crate) use regular::Taps;
pub use rows::{RowSink, SchemeRows};
