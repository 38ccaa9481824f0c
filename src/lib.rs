//! **carvel** is a subdivision-surface kernel: a control mesh of any topology
//! goes in, a smooth surface comes out.

pub mod base;
#[cfg(feature = "io")]
pub mod io;

pub use base::{Context, Element, Error, ErrorKind, Fraction, Result};
