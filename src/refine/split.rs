//! Any split, for those who only want to know what the children are.

use super::adjacency::Recycled;
use super::corner_split::CornerSplit;
use super::counts::Counts;
use super::creasing::Creasing;
use super::edges::EdgeNumbers;
use super::lineage::{FaceOrigin, VertexOrigin};
use super::primal_split::PrimalSplit;
use crate::base::{Context, Result, memory};
use crate::mesh::Mesh;

/// A planned split of a mesh.
#[derive(Debug)]
pub(crate) enum Split<'a> {
    /// A vertex for every corner.
    Corner(CornerSplit<'a>),
    /// The old vertices and one for every edge, for quads one for every face.
    Primal(PrimalSplit<'a>),
}

/// What a split mesh carries beside its faces.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Carried<'a> {
    /// The dual split leaves an anchor row.
    pub(crate) anchored: bool,
    /// How sharpness is used up.
    pub(crate) creasing: Creasing,
    /// Faces of the parent whose children are holes.
    pub(crate) holes: &'a [u32],
}

impl<'a> Split<'a> {
    pub(crate) fn parent(&self) -> &'a Mesh {
        match self {
            Self::Corner(split) => split.parent(),
            Self::Primal(split) => split.parent(),
        }
    }

    /// The split, as often as asked, if it is a primal one: channels come with no other.
    pub(crate) fn primal(&self) -> impl Iterator<Item = &PrimalSplit<'a>> {
        let split = match self {
            Self::Corner(_) => None,
            Self::Primal(split) => Some(split),
        };
        split.into_iter().cycle()
    }

    /// The sizes of the split mesh.
    pub(crate) fn counts(&self) -> &Counts {
        match self {
            Self::Corner(split) => &split.counts,
            Self::Primal(split) => &split.counts,
        }
    }

    /// Writes the size of every child face.
    pub(crate) fn write_sizes(&self, out: &mut [u32]) {
        match self {
            Self::Corner(split) => split.write_sizes(out),
            Self::Primal(split) => split.write_sizes(out),
        }
    }

    /// Writes the concatenated vertices of all child faces.
    pub(crate) fn write_faces(&self, context: &Context, out: &mut [u32]) -> Result<()> {
        match self {
            Self::Corner(split) => split.write_faces(context, out),
            Self::Primal(split) => split.write_faces(context, out),
        }
    }

    /// The split mesh.
    pub(crate) fn mesh(
        &self,
        context: &Context,
        carried: Carried,
        recycled: &mut Recycled,
    ) -> Result<Mesh> {
        match self {
            Self::Corner(split) => split.mesh(context, carried.anchored, recycled),
            Self::Primal(split) => split.mesh(context, carried.creasing, carried.holes, recycled),
        }
    }

    /// The origins of all child vertices, in order.
    pub(crate) fn vertex_origins(&self) -> Result<Vec<VertexOrigin>> {
        match self {
            Self::Corner(split) => {
                memory::collect((0..split.counts.vertices as u32).map(|v| split.vertex_origin(v)))
            }
            Self::Primal(split) => memory::collect(split.vertex_origins()),
        }
    }

    /// Calls `each` with the place and the origin of every child face, in order.
    pub(crate) fn each_face_origin(&self, mut each: impl FnMut(usize, FaceOrigin)) {
        match self {
            Self::Corner(split) => split.face_origins().enumerate().for_each(|(i, o)| each(i, o)),
            Self::Primal(split) => split.face_origins().enumerate().for_each(|(i, o)| each(i, o)),
        }
    }

    /// Gives memory back that the next call may use.
    pub(crate) fn recycle(self, memory: &mut EdgeNumbers) {
        if let Self::Primal(split) = self {
            *memory = split.recycle();
        }
    }
}
