#![doc = include_str!("../README.md")]
#![deny(unsafe_code)]

#[cfg(feature = "analysis")]
pub mod analysis;
pub mod base;
#[cfg(feature = "capi")]
pub mod capi;
#[cfg(feature = "curve")]
pub mod curve;
pub mod hierarchy;
#[cfg(feature = "io")]
pub mod io;
pub mod limit;
pub mod mesh;
pub mod refine;
pub mod scheme;
pub mod sparse;

pub use base::{Context, Crease, Element, Error, ErrorKind, Fraction, Result, SharpVertex};
pub use hierarchy::{Attribute, ChannelOutput, FaceVarying, Hierarchy, Interpolation, Output};
pub use hierarchy::{Prediction, Refined, RefinedChannel, Refiner, StencilTask, Task};
pub use mesh::{Channel, FaceVaryingMode, Mesh};
pub use scheme::{
    Boundary, CornerRule, Creasing, Extraordinary, LoopWeights, Scheme, SplitKind, TriangleRule,
};
pub use sparse::{Records, RecordsMut, StencilTable, StoredTable};
