#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

pub mod base;
pub mod hierarchy;
#[cfg(feature = "io")]
pub mod io;
pub mod mesh;
pub mod refine;
pub mod scheme;

pub use base::{Context, Element, Error, ErrorKind, Fraction, Result};
pub use hierarchy::{Attribute, Hierarchy, Output, Prediction, Refined, Refiner, Task};
pub use mesh::Mesh;
pub use scheme::{Boundary, CornerRule, Scheme};
