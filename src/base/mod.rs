//! What every layer stands on: errors, exact numbers, scalars, tags, execution.

mod context;
mod error;
mod fraction;
pub(crate) mod memory;
mod pages;
mod scalar;
pub(crate) mod simd;
mod tags;

#[cfg(feature = "capi")]
pub(crate) use context::MOST_THREADS;
pub use context::{CancelFlag, Context, ContextBuilder};
pub use error::{Element, Error, ErrorKind, Result};
pub use fraction::Fraction;
pub use scalar::{Scalar, Summand, Weight};
pub use tags::{Crease, SharpVertex};

/// The index that stands for "none": no twin, no source, no vertex.
pub const NONE: u32 = u32::MAX;
