//! The corner split: one new vertex per corner (Doo–Sabin connectivity).
//!
//! # Numbering
//! Child vertices, in this order:
//! * corner `c` of the parent becomes vertex `c`;
//! * if an anchor row is laid, boundary edge `b` (its place in [`Mesh`]'s `rim`)
//!   from `a` to `b′` adds β near `a` and β near `b′`, 2 per edge;
//! * then one κ per corner vertex of the boundary, by vertex;
//! * isolated vertices, by vertex.
//!
//! Child faces, in this order, those of another size than 4 first:
//!
//! | block | one per | corners |
//! |---|---|---|
//! | irregular faces | irregular parent face | its corners, same cycle |
//! | irregular vertex faces | vertex whose face is no quad | its fan |
//! | quads | quad of the parent | its corners, same cycle |
//! | edge quads | edge, by its first corner; boundary edges last | below |
//! | vertex quads | remaining vertex with a face | its fan |
//!
//! The quad of an edge with first corner `c` and twin `g` is (next c, c, next g,
//! g); its corners 0 and 1 are called inner and outer corner of `c`, 2 and 3
//! those of `g`. The inner corner's twin is the corner `c` of the child of the
//! face, the outer corner's twin lies in the vertex face. That of a boundary
//! edge is (next c, c, β near a, β near b′). A vertex face holds the fan of its
//! vertex from its start; on the boundary of an anchoring split it is framed: β
//! of the outgoing boundary edge, the fan, β of the incoming one, κ if there is
//! one.
//!
//! So every child's place follows from its parent's number, the number of its
//! edge, and a running total of vertex-face sizes.

use super::counts::{Counts, irregular_rim_faces};
use crate::base::{Context, Error, ErrorKind, NONE, Result};
use crate::mesh::{Layout, Mesh};
use std::ops::Range;

/// Whether and where a split lays an anchor row.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Anchor {
    /// No added points: the rule `none`, and every step on an anchored mesh.
    Keep,
    /// β on every boundary edge, κ at the given boundary vertices (ascending).
    Lay {
        /// The corner vertices of the boundary.
        kappas: Vec<u32>,
    },
}

impl Anchor {
    /// The size of the face of a boundary vertex, 0 if it gets none.
    pub(crate) fn rim_face_size(&self, mesh: &Mesh, vertex: u32) -> u32 {
        match self {
            Self::Keep => 0,
            Self::Lay { kappas } => {
                let kappa = u32::from(kappas.binary_search(&vertex).is_ok());
                mesh.fan(vertex).count() as u32 + 2 + kappa
            }
        }
    }

    /// The counts of the split mesh, `None` past 64 bits.
    pub(crate) fn split_counts(&self, mesh: &Mesh) -> Option<Counts> {
        let counts = Counts::of(mesh);
        match self {
            Self::Keep => counts.plain(),
            Self::Lay { kappas } => {
                counts.anchoring(kappas.len() as u64, irregular_rim_faces(mesh, self))
            }
        }
    }
}

/// A child vertex by what it comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Child {
    /// A corner of the parent.
    Corner(u32),
    /// β on the boundary edge of a rim corner, near its start or its end.
    Beta { corner: u32, at_end: bool },
    /// κ at a boundary vertex.
    Kappa(u32),
    /// An isolated vertex.
    Isolated(u32),
}

/// A corner split of a mesh: sizes and numbering of the children.
#[derive(Debug)]
pub(crate) struct CornerSplit<'a> {
    pub(super) parent: &'a Mesh,
    pub(super) anchor: Anchor,
    pub(crate) counts: Counts,
    /// Vertices with a face that is no quad and the size of that face, ascending.
    pub(super) irregular: Vec<(u32, u32)>,
    /// Vertices without a vertex quad, ascending.
    pub(super) without_quad: Vec<u32>,
    pub(super) isolated: Vec<u32>,
    pub(super) blocks: Blocks,
    /// Interior edges before each chunk of parent corners; see `edge_chunks`.
    pub(super) edge_chunks: Vec<EdgeChunk>,
}

/// First child corner of each block.
#[derive(Debug, Clone, Copy)]
pub(super) struct Blocks {
    /// Corners of irregular parent faces keep their numbers: block one is 0..this.
    pub(super) vertex_faces: u32,
    pub(super) quads: u32,
    pub(super) edges: u32,
    pub(super) rim_edges: u32,
    pub(super) vertex_quads: u32,
}

/// A run of parent corners and the edges whose first corner is in it.
#[derive(Debug, Clone)]
pub(super) struct EdgeChunk {
    pub(super) corners: Range<usize>,
    pub(super) edges: Range<u32>,
}

impl<'a> CornerSplit<'a> {
    /// Plans a split.
    ///
    /// # Errors
    /// [`ErrorKind::TooLarge`] if the children do not fit the index type.
    pub(crate) fn new(context: &Context, parent: &'a Mesh, anchor: Anchor) -> Result<Self> {
        let counts = anchor
            .split_counts(parent)
            .ok_or_else(|| Error::new(ErrorKind::TooLarge, "the split exceeds 64-bit sizes"))?;
        counts.check_index_type()?;
        let (irregular, without_quad) = vertex_faces(parent, &anchor);
        let isolated = parent.special.iter().copied();
        let isolated = isolated.filter(|&v| parent.start[v as usize] == NONE).collect();
        let edge_chunks = edge_chunks(context, parent)?;
        let blocks = Blocks::new(parent, &irregular, &anchor);
        Ok(Self { parent, anchor, counts, irregular, without_quad, isolated, blocks, edge_chunks })
    }

    pub(crate) fn parent(&self) -> &'a Mesh {
        self.parent
    }

    /// True if boundary edges get β points and quads.
    pub(crate) fn lays_anchor(&self) -> bool {
        matches!(self.anchor, Anchor::Lay { .. })
    }

    pub(super) fn kappas(&self) -> &[u32] {
        match &self.anchor {
            Anchor::Keep => &[],
            Anchor::Lay { kappas } => kappas,
        }
    }

    /// The child vertices that are not corners of the parent.
    pub(crate) fn added_vertices(&self) -> Range<u32> {
        self.parent.layout.corners()..self.counts.vertices as u32
    }

    /// What a child vertex comes from.
    pub(crate) fn child(&self, vertex: u32) -> Child {
        let Some(added) = vertex.checked_sub(self.parent.layout.corners()) else {
            return Child::Corner(vertex);
        };
        let betas = if self.lays_anchor() { 2 * self.parent.rim.len() as u32 } else { 0 };
        let Some(later) = added.checked_sub(betas) else {
            let corner = self.parent.rim[added as usize / 2];
            return Child::Beta { corner, at_end: added % 2 == 1 };
        };
        match self.kappas().get(later as usize) {
            Some(&vertex) => Child::Kappa(vertex),
            None => Child::Isolated(self.isolated[later as usize - self.kappas().len()]),
        }
    }

    /// β on the boundary edge of a rim corner.
    pub(super) fn beta(&self, rim_corner: u32, at_end: bool) -> u32 {
        let place = self.parent.rim.binary_search(&rim_corner).expect("a boundary corner");
        self.parent.layout.corners() + 2 * place as u32 + u32::from(at_end)
    }

    /// κ at a boundary vertex, if it has one.
    pub(super) fn kappa(&self, vertex: u32) -> Option<u32> {
        let place = self.kappas().binary_search(&vertex).ok()?;
        Some(self.parent.layout.corners() + (2 * self.parent.rim.len() + place) as u32)
    }

    /// The layout of the child mesh.
    pub(super) fn child_layout(&self) -> Layout {
        let layout = &self.parent.layout;
        let kept = if layout.side() == 4 { layout.irregular_faces() } else { layout.faces() };
        let faces = (0..kept).map(|f| layout.face(f).len() as u32);
        let vertices = self.irregular.iter().map(|&(_, size)| size);
        let quads = self.counts.faces - self.counts.irregular_faces;
        Layout::new(faces.chain(vertices), 4, quads as u32)
    }

    /// The number of vertices below `vertex` that have no vertex quad.
    pub(super) fn skipped_before(&self, vertex: u32) -> u32 {
        self.without_quad.partition_point(|&v| v < vertex) as u32
    }
}

impl Blocks {
    fn new(parent: &Mesh, irregular: &[(u32, u32)], anchor: &Anchor) -> Self {
        let vertex_faces = parent.layout.first_quad_corner();
        let quads = vertex_faces + irregular.iter().map(|&(_, size)| size).sum::<u32>();
        let edges = quads + (parent.layout.corners() - vertex_faces);
        let rim_edges = edges + 4 * parent.interior_edges() as u32;
        let laid = if *anchor == Anchor::Keep { 0 } else { 4 * parent.rim.len() as u32 };
        Self { vertex_faces, quads, edges, rim_edges, vertex_quads: rim_edges + laid }
    }
}

/// The irregular vertex faces with their sizes, and the vertices without a quad.
fn vertex_faces(parent: &Mesh, anchor: &Anchor) -> (Vec<(u32, u32)>, Vec<u32>) {
    let mut irregular = Vec::new();
    let mut without_quad = Vec::new();
    for &v in &parent.special {
        let size = match parent.on_rim(v) {
            true => anchor.rim_face_size(parent, v),
            false => parent.fan(v).count() as u32,
        };
        if size != 4 {
            without_quad.push(v);
        }
        if size >= 3 && size != 4 {
            irregular.push((v, size));
        }
    }
    (irregular, without_quad)
}

/// Cuts the parent's corners into chunks and counts the interior edges whose
/// first corner lies in each.
fn edge_chunks(context: &Context, parent: &Mesh) -> Result<Vec<EdgeChunk>> {
    let chunks = context.chunks(parent.corners());
    let counts = context.map(chunks.clone(), |range| {
        let first = range.start as u32;
        let twins = &parent.twin[range];
        (first..).zip(twins).map(|(c, &twin)| u32::from(leads_edge(c, twin))).sum::<u32>()
    })?;
    let mut edges = 0;
    Ok(chunks
        .into_iter()
        .zip(counts)
        .map(|(corners, n)| {
            edges += n;
            EdgeChunk { corners, edges: edges - n..edges }
        })
        .collect())
}

/// True if `corner` is the first corner of an interior edge.
#[inline]
pub(super) fn leads_edge(corner: u32, twin: u32) -> bool {
    // NONE is the largest index, so one comparison would let boundaries pass.
    corner < twin && twin != NONE
}
