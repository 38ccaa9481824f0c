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
//! Child faces that are no quads come first: the children of irregular parent
//! faces, in order, then the irregular vertex faces, by vertex. The quads follow,
//! near their parents. For each irregular parent face, at each of its corners in
//! order: the quad of the vertex whose fan starts there, the quad of the edge
//! that the corner leads. Then for each quad of the parent: its own child, the
//! quads of the vertices whose fans start at its corners, the quads of the edges
//! that its corners lead. Which corner leads an edge is explained in
//! `mesh/near.rs`; a boundary edge, where it gets a quad, is led by its corner.
//!
//! * The child of a face has the parent's corners as vertices, same cycle.
//! * The quad of an edge led by `c` with twin `g` is (next c, c, next g, g); its
//!   corners 0 and 1 are called inner and outer corner of `c`, 2 and 3 those of
//!   `g`. The inner corner's twin is the corner of `c` in the child of the face,
//!   the outer corner's twin lies in the vertex face. The quad of a boundary
//!   edge is (next c, c, β near a, β near b′).
//! * A vertex face holds the fan of its vertex from its start; on the boundary
//!   of an anchoring split it is framed: β of the outgoing boundary edge, the
//!   fan, β of the incoming one, κ if there is one.
//!
//! So every child's place follows from its parent's corner and one running
//! total per level; in a split mesh, whose faces are of three kinds only, the
//! child of a face has nine children near it, the quad of an edge three, the
//! quad of a vertex one. Children next to each other on the surface stay next to each
//! other in memory at every depth: ordering all face children before all edge
//! quads and those before all vertex quads made a deep refinement two to three
//! times slower, each level tripling the places that are read at once.

use super::counts::{Counts, irregular_rim_faces};
use crate::base::{Context, Error, ErrorKind, NONE, Result, memory};
use crate::mesh::near::{LEADS, STARTS};
use crate::mesh::{Layout, Mesh, Near};
use std::borrow::Cow;
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
    /// First child corner of the irregular vertex faces, and of the quads.
    pub(super) vertex_faces: u32,
    pub(super) quads: u32,
    pub(super) chunks: Vec<FaceChunk>,
    /// Which child quads stand near each corner.
    pub(super) near: Cow<'a, Near>,
}

/// A run of parent faces and the child quads that stand near them.
#[derive(Debug, Clone)]
pub(super) struct FaceChunk {
    pub(super) corners: Range<u32>,
    pub(super) quads: Range<u32>,
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
        let (irregular, without_quad) = vertex_faces(parent, &anchor)?;
        let isolated = parent.special.iter().copied();
        let isolated = memory::collect(isolated.filter(|&v| parent.start[v as usize] == NONE))?;
        let vertex_faces = parent.layout.first_quad_corner();
        let quads = vertex_faces + irregular.iter().map(|&(_, size)| size).sum::<u32>();
        let mut split = Self {
            parent,
            anchor,
            counts,
            irregular,
            without_quad,
            isolated,
            vertex_faces,
            quads,
            chunks: Vec::new(),
            near: match &parent.near {
                Some(near) => Cow::Borrowed(near),
                None => Cow::Owned(Near::of(parent)?),
            },
        };
        split.frame_near()?;
        split.chunks = split.cut(context)?;
        Ok(split)
    }

    /// Cuts the parent's faces into chunks, irregular ones and quads apart, and
    /// counts the child quads of each.
    fn cut(&self, context: &Context) -> Result<Vec<FaceChunk>> {
        let first = self.vertex_faces;
        let corners = self.parent.layout.corners();
        let all = (self.counts.faces - self.counts.irregular_faces) as u32;
        let Near { irregular, quads } = &*self.near;
        if context.threads() == 1 {
            // One thread needs no counts of the quads, which are most of all.
            let before = quads_near(irregular);
            let irregular = FaceChunk { corners: 0..first, quads: 0..before };
            return Ok(vec![irregular, FaceChunk { corners: first..corners, quads: before..all }]);
        }
        let irregular_chunks = context.chunks(irregular.len());
        let mut counts =
            context.map(irregular_chunks.clone(), |range| quads_near(&irregular[range]))?;
        let quad_chunks = context.chunks(quads.len());
        counts
            .extend(context.map(quad_chunks.clone(), |range| {
                range.len() as u32 + quads_near(&quads[range])
            })?);
        let mut place = 0;
        let irregular = irregular_chunks.into_iter().map(|r| r.start as u32..r.end as u32);
        let quads = quad_chunks.into_iter();
        let quads = quads.map(|r| first + 4 * r.start as u32..first + 4 * r.end as u32);
        let chunks = irregular.chain(quads).zip(counts).map(|(corners, n)| {
            place += n;
            FaceChunk { corners, quads: place - n..place }
        });
        Ok(chunks.collect())
    }

    /// Adds the quads of boundary edges and boundary vertices.
    fn frame_near(&mut self) -> Result<()> {
        if !self.lays_anchor() || self.parent.is_closed() {
            return Ok(());
        }
        let mut near = self.near.try_clone()?;
        let first = self.vertex_faces;
        for &c in &self.parent.rim {
            // The fan of a boundary vertex starts at its rim corner.
            let v = self.parent.vert[c as usize];
            let quad = self.without_quad.binary_search(&v).is_err();
            near.set(first, c, LEADS | if quad { STARTS } else { 0 });
        }
        self.near = Cow::Owned(near);
        Ok(())
    }

    /// True if the fan of a vertex that gets a quad starts at the corner.
    pub(super) fn starts_quad(&self, corner: u32) -> bool {
        self.near.corner(self.vertex_faces, corner) & STARTS != 0
    }

    /// True if the corner leads an edge that gets a quad.
    pub(super) fn leads_quad(&self, corner: u32) -> bool {
        self.near.corner(self.vertex_faces, corner) & LEADS != 0
    }

    /// True if the vertex gets a quad.
    pub(super) fn has_quad(&self, vertex: u32) -> bool {
        !self.parent.special_set.contains(vertex)
            || self.without_quad.binary_search(&vertex).is_err()
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
    pub(super) fn child_layout(&self) -> Result<Layout> {
        let layout = &self.parent.layout;
        let kept = if layout.side() == 4 { layout.irregular_faces() } else { layout.faces() };
        let faces = (0..kept).map(|f| layout.face(f).len() as u32);
        let vertices = self.irregular.iter().map(|&(_, size)| size);
        let quads = self.counts.faces - self.counts.irregular_faces;
        Layout::new(faces.chain(vertices), 4, quads as u32)
    }
}

/// Vertices with the sizes of their faces, and vertices alone.
type VertexFaces = (Vec<(u32, u32)>, Vec<u32>);

/// The irregular vertex faces with their sizes, and the vertices without a quad.
fn vertex_faces(parent: &Mesh, anchor: &Anchor) -> Result<VertexFaces> {
    let mut irregular = Vec::new();
    let mut without_quad = Vec::new();
    for &v in &parent.special {
        let size = if parent.on_rim(v) {
            anchor.rim_face_size(parent, v)
        } else {
            parent.fan(v).count() as u32
        };
        if size != 4 {
            memory::extend(&mut without_quad, [v])?;
        }
        if size >= 3 && size != 4 {
            memory::extend(&mut irregular, [(v, size)])?;
        }
    }
    Ok((irregular, without_quad))
}

/// The number of child quads of edges and vertices near some corners.
fn quads_near(bits: &[u8]) -> u32 {
    bits.iter().map(|bits| bits.count_ones()).sum()
}
