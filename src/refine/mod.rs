//! Splits: the topology of a refined mesh from its parent's, by arithmetic.
//!
//! No positions here. A split numbers the children and says which parent
//! element each comes from; it never hashes, sorts or searches the bulk.

pub(crate) mod adjacency;
mod corner_split;
mod counts;
mod creasing;
mod edges;
mod faces;
mod isolated_face;
mod lineage;
mod neighbourhood;
mod patch_fans;
mod patch_grid;
mod patch_tables;
mod patches;
mod primal_adjacency;
mod primal_split;
mod split;
mod tile_tables;
mod tiles;

pub use corner_split::Anchor;
pub(crate) use corner_split::{Child, CornerSplit};
pub use counts::Counts;
pub use creasing::Creasing;
pub(crate) use creasing::{Around, decrement};
pub(crate) use edges::EdgeNumbers;
pub(crate) use isolated_face::IsolatedFace;
pub use lineage::{FaceOrigin, VertexOrigin};
pub(crate) use neighbourhood::{BoundaryNeighbours, Cycle, Neighbourhood, Side};
pub(crate) use patch_fans::PatchFans;
pub(crate) use patch_grid::{DEEPEST, PatchArray, Place, patch_array, within};
pub(crate) use patches::Patches;
pub(crate) use primal_split::{Pieces, PrimalChild, PrimalSplit};
pub(crate) use split::{Carried, Split};
pub(crate) use tile_tables::{
    CELL, DEEPEST_TILE, Stand, TILE_ORIGIN, TILE_ROW, TileKind, array_index,
};
pub(crate) use tiles::Tiles;
