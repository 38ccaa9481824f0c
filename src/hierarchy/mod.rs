//! From a control mesh, a scheme and data to any level.
//!
//! This is where positions enter: they are checked for NaN and infinities on
//! the way in and for overflow on the way out.

mod channels;
mod columns;
mod cost;
mod crease_angle;
mod creases_left;
mod dual_step;
mod kernel;
mod levels;
mod patch_fan_values;
mod patch_kernel;
mod patch_step;
mod predict;
mod primal_kernel;
mod primal_step;
mod refiner;
mod regular_rule;
mod stencil_block;
mod stencil_build;
mod stencil_copies;
mod stencil_patterns;
mod stencil_ring;
mod stencil_rows;
mod stencil_runs;
mod stencil_sorts;
mod stencil_step;
mod stencils;
mod step;
mod tile_centres;
mod tile_kernel;
mod tile_rings;
mod tile_smoothing;
mod tile_step;
mod values;

#[cfg(feature = "capi")]
pub(crate) use channels::channel_bytes;
pub use channels::{ChannelOutput, FaceVarying, RefinedChannel};
pub use cost::Seconds;
pub use crease_angle::creases_by_angle;
pub use creases_left::creases_left;
pub use levels::Hierarchy;
pub use predict::Prediction;
pub use refiner::{Attribute, Output, Refined, Refiner, Task};
pub use stencils::StencilTask;
pub use step::Interpolation;
#[cfg(feature = "capi")]
pub(crate) use values::WIDEST;
