//! Where the children of a split come from.

use super::corner_split::{Child, CornerSplit, leads_edge};
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
    /// A vertex: a corner of the boundary, or an isolated vertex.
    Vertex(u32),
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
}

impl FaceOrigin {
    /// A face of the parent that the child lies on or touches: the face itself,
    /// that of the edge's first corner, or that of the first corner around the
    /// vertex. Per-face data is inherited along it.
    pub fn representative(self, parent: &Mesh) -> u32 {
        match self {
            Self::Face(face) => face,
            Self::Edge(corner) => parent.layout.face_of(corner),
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
        let parent = self.parent;
        let layout = &parent.layout;
        let kept = if layout.side() == 4 { layout.irregular_faces() } else { layout.faces() };
        let leads = move |&c: &u32| leads_edge(c, parent.twin[c as usize]);
        let rim = if self.lays_anchor() { &parent.rim[..] } else { &[] };
        let edges = (0..layout.corners()).filter(leads).chain(rim.iter().copied());
        let irregular = self.irregular.iter().map(|&(v, _)| v);
        let mut skipped = self.without_quad.iter().copied().peekable();
        let quads = (0..parent.start.len() as u32).filter(move |v| skipped.next_if_eq(v).is_none());
        (0..kept)
            .map(FaceOrigin::Face)
            .chain(irregular.map(FaceOrigin::Vertex))
            .chain((kept..layout.faces()).map(FaceOrigin::Face))
            .chain(edges.map(FaceOrigin::Edge))
            .chain(quads.map(FaceOrigin::Vertex))
    }
}
