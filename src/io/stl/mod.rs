//! Stereolithography: loose triangles, text or binary.
//!
//! Own code, because `stl_io` needs a seekable stream, goes by the word `solid`
//! alone, names no line and rounds text to single precision.
//!
//! Vertices with the same coordinates become one, numbered as they first occur
//! (zeros of either sign are the same). Writing cuts polygons into fans around
//! their first corner and computes the facet normals.

mod ascii;
mod binary;
mod read;
mod weld;
mod write;

pub(super) use read::read;
pub(super) use write::write;
