//! Wavefront OBJ.
//!
//! A parser of our own, because `tobj` drops isolated vertices, renumbers per
//! group, splits shared vertices at every `g`, has no line numbers and accepts
//! NaN.

mod corner;
mod read;
mod tag;
mod vertex;
mod write;

pub(super) use read::read;
pub(super) use write::write;
