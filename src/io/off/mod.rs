//! Geomview's object file format, in text: `[ST][C][N]OFF`.
//!
//! No well-kept crate reads it. Four-dimensional (`4OFF`, `nOFF`) and binary
//! files are refused. Face colours are noted and dropped.

mod header;
mod read;
mod write;

pub(super) use read::read;
pub(super) use write::write;
