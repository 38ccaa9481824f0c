//! Stanford PLY: text, and binary in either byte order.
//!
//! A parser of our own, because `ply-rs-bw` 4.0.1 runs out of memory on a
//! 60-byte header that claims 4·10⁹ elements without properties, takes 1.8 s
//! and 0.9 GB for a million faces, and offers no progress while it reads.
//!
//! `comment` and `obj_info` lines are comments.

mod header;
mod number_type;
mod read;
mod values;
mod vertex;
mod write;

pub(super) use read::read;
pub(super) use write::write;
