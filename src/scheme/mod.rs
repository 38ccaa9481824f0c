//! Schemes: a split and the weights that go with it, written once.
//!
//! A scheme gives one row of (vertex, weight) for every new vertex and hands it
//! to a [`RowSink`]. Whoever needs the weights (refinement, stencil tables,
//! exact tests) consumes these rows; nobody writes a weight a second time.

mod averaging;
mod choice;
mod composed_rows;
mod corner;
mod crease_rules;
mod dual_rows;
mod face_varying;
mod mirror;
mod presets;
mod primal_passes;
mod primal_rows;
mod regular;
mod rows;
mod scheme_options;
mod smooth;
mod tuned;
mod tuned_numbers;

pub(crate) use averaging::MOST_PASSES;
pub(crate) use choice::Method;
pub use choice::{Scheme, SplitKind};
pub(crate) use composed_rows::{ComposedRow, ComposedRows};
pub use corner::CornerRule;
pub(crate) use corner::CornerWeights;
pub(crate) use dual_rows::DualRows;
pub(crate) use face_varying::{ChannelLevel, ChannelRules, SplitValue};
pub(crate) use primal_rows::{PointSink, PrimalRows};
pub(crate) use regular::Taps;
pub use rows::RowSink;
pub(crate) use rows::SchemeRows;
pub use scheme_options::{Boundary, Extraordinary, LoopWeights, TriangleRule};
pub(crate) use smooth::{SmoothMasks, VertexMask};
pub(crate) use tuned::TunedWeights;

pub use crate::refine::Creasing;
