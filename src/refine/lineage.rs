//! Where the children of a split come from.

use super::corner_split::{Child, CornerSplit};
use super::primal_split::{Pieces, PrimalSplit};
use crate::mesh::Mesh;

/// The parent element of a refined vertex. Corners and faces are numbered in
/// the parent [`Mesh`]'s own order.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum VertexOrigin {
    /// The corner of a face.
    Corner(u32),
    /// A point on the boundary edge of a corner, near its start or its end.
    EdgeEnd {
        /// The corner whose outgoing edge it is.
        corner: u32,
        /// False near the corner's vertex, true near the next one's.
        at_end: bool,
    },
    /// A vertex: in a dual step a corner of the boundary or an isolated one.
    Vertex(u32),
    /// An edge, by its first corner.
    Edge(u32),
    /// A face.
    Face(u32),
}

/// The parent element of a refined face.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum FaceOrigin {
    /// A face.
    Face(u32),
    /// An edge, by its first corner.
    Edge(u32),
    /// A vertex.
    Vertex(u32),
    /// The corner of a face, from which a primal step makes a face of its own.
    Corner(u32),
}

impl FaceOrigin {
    /// A face of the parent that the child lies on or touches: the face itself,
    /// that of the edge's first corner, or that of the first corner around the
    /// vertex. Per-face data is inherited along it.
    pub fn representative(self, parent: &Mesh) -> u32 {
        match self {
            Self::Face(face) => face,
            Self::Edge(corner) | Self::Corner(corner) => parent.layout.face_of(corner),
            Self::Vertex(v) => parent.layout.face_of(parent.start[v as usize]),
        }
    }
}

impl CornerSplit<'_> {
    /// The origin of a child vertex.
    pub(crate) fn vertex_origin(&self, vertex: u32) -> VertexOrigin {
        match self.child(vertex) {
            Child::Corner(c) => VertexOrigin::Corner(c),
            Child::Beta { corner, at_end } => VertexOrigin::EdgeEnd { corner, at_end },
            Child::Kappa(v) | Child::Isolated(v) => VertexOrigin::Vertex(v),
        }
    }

    /// The origins of all child faces, in order.
    pub(crate) fn face_origins(&self) -> impl Iterator<Item = FaceOrigin> + '_ {
        let layout = &self.parent.layout;
        let irregular = self.irregular.iter().map(|&(v, _)| FaceOrigin::Vertex(v));
        let first = self.vertex_faces;
        let kept = if first == 0 { 0 } else { layout.face_of(first - 1) + 1 };
        let vertex = move |c: u32| {
            self.starts_quad(c).then(|| FaceOrigin::Vertex(self.parent.vert[c as usize]))
        };
        let edge = move |c: u32| self.leads_quad(c).then_some(FaceOrigin::Edge(c));
        let corners = (0..first).flat_map(move |c| vertex(c).into_iter().chain(edge(c)));
        let quads = (first..layout.corners()).step_by(4).flat_map(move |c| {
            let face = FaceOrigin::Face(layout.face_of(c));
            let vertices = (c..c + 4).filter_map(vertex);
            std::iter::once(face).chain(vertices).chain((c..c + 4).filter_map(edge))
        });
        (0..kept).map(FaceOrigin::Face).chain(irregular).chain(corners).chain(quads)
    }
}

impl PrimalSplit<'_> {
    /// The origins of all child vertices, in order.
    pub(crate) fn vertex_origins(&self) -> impl Iterator<Item = VertexOrigin> + '_ {
        let layout = &self.parent.layout;
        let vertices = (0..self.parent.vertices() as u32).map(VertexOrigin::Vertex);
        let first = |&c: &u32| self.parent.is_first_of_edge(c);
        let edges = (0..layout.corners()).filter(first).map(VertexOrigin::Edge);
        let faces = if self.pieces == Pieces::Quads { layout.faces() } else { 0 };
        vertices.chain(edges).chain((0..faces).map(VertexOrigin::Face))
    }

    /// The origins of all child faces, in order.
    pub(crate) fn face_origins(&self) -> impl Iterator<Item = FaceOrigin> + '_ {
        let corners = (0..self.parent.layout.corners()).map(FaceOrigin::Corner);
        let middle = |origin| match (self.pieces, origin) {
            (Pieces::Triangles, FaceOrigin::Corner(c)) if c % 3 == 2 => {
                Some(FaceOrigin::Face(c / 3))
            }
            _ => None,
        };
        corners.flat_map(move |corner| std::iter::once(corner).chain(middle(corner)))
    }
}
