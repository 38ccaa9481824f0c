//! Splits: the topology of a refined mesh from its parent's, by arithmetic.
//!
//! No positions here. A split numbers the children and says which parent
//! element each comes from; it never hashes, sorts or searches the bulk.

pub(crate) mod adjacency;
mod corner_split;
mod counts;
mod faces;
mod lineage;
mod neighbourhood;

pub use corner_split::Anchor;
pub(crate) use corner_split::{Child, CornerSplit};
pub use counts::Counts;
pub use lineage::{FaceOrigin, VertexOrigin};
pub(crate) use neighbourhood::{BoundaryNeighbours, Cycle, Neighbourhood, Side};
