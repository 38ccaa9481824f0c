//! Stencil tables: new values as weighted sums of old ones, kept to be applied again.
//!
//! A table is a sparse matrix by rows. A host that moves the control points of one
//! topology every frame builds it once and applies it as often as it likes, to positions,
//! colours or whatever else hangs on vertices; its transpose carries gradients back. For
//! a topology that is refined once, [`crate::Refiner`] is many times cheaper.
//!
//! This layer is linear algebra: it knows no meshes, and values that are NaN or infinite
//! go through it as arithmetic has it.

mod accumulate;
mod apply;
mod assemble;
mod file;
mod kernel;
mod placed;
mod product;
mod records;
mod table;
mod transpose;

pub(crate) use accumulate::Accumulator;
pub(crate) use assemble::{RowWriter, assemble};
pub use file::{StoredScalar, StoredTable};
pub(crate) use placed::{Columns, Filling, PlacedRows, PlacedWriter, filled};
pub use records::{Records, RecordsMut};
pub use table::StencilTable;
pub use transpose::Dependents;
