//! The splits that keep the old vertices: every n-gon into n quads, or every
//! triangle into four.
//!
//! # Numbering
//! Child vertices: the old vertices under their old numbers, then one for each edge
//! (edges by their first corner), then, in a quad split, one for each face.
//!
//! Quad split: child face `c` is the quad of parent corner `c`, with the vertices
//! (vertex, edge of c, face, edge before c). Triangle split: child face `4f + i` is the
//! triangle at corner `i` of face `f`, with the vertices (vertex, edge of the corner, edge
//! before it); child `4f + 3` is the one in the middle, whose corner `i` lies on the
//! edge before corner `i`.
//!
//! So an old edge with the sides `c` and `t` becomes two, and their child corners follow
//! by arithmetic: `start_half(c)` leads from the old vertex of `c` to the middle and has the
//! twin `end_half(t)`, `end_half(c)` leads on from the middle.

use super::counts::Counts;
use super::creasing::Arounds;
use super::edges::EdgeNumbers;
use crate::base::{Context, Error, ErrorKind, NONE, Result};
use crate::mesh::Mesh;

/// What the faces become.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Pieces {
    /// A quad for every corner.
    Quads,
    /// Four triangles for every triangle.
    Triangles,
}

impl Pieces {
    /// The sides of a child face.
    #[inline(always)]
    pub(crate) fn sides(self) -> u32 {
        match self {
            Self::Quads => 4,
            Self::Triangles => 3,
        }
    }

    /// The faces around a regular vertex.
    #[inline(always)]
    pub(crate) fn valence(self) -> usize {
        match self {
            Self::Quads => 4,
            Self::Triangles => 6,
        }
    }

    /// The child corner from the old vertex of a corner to the middle of its edge.
    #[inline(always)]
    pub(crate) fn start_half(self, corner: u32) -> u32 {
        match self {
            Self::Quads => 4 * corner,
            Self::Triangles => 3 * corner + 3 * (corner / 3),
        }
    }

    /// The child corner from the middle of an edge to its end, the vertex of the next
    /// corner.
    #[inline(always)]
    pub(crate) fn end_half(self, next: u32) -> u32 {
        self.start_half(next) + self.sides() - 1
    }
}

/// The children of a quad from its vertices, those on its edges and that in its middle.
#[inline(always)]
pub(super) fn family_of_quad(v: [u32; 4], e: [u32; 4], m: u32) -> [[u32; 4]; 4] {
    [[v[0], e[0], m, e[3]], [v[1], e[1], m, e[0]], [v[2], e[2], m, e[1]], [v[3], e[3], m, e[2]]]
}

/// The children of a triangle from its vertices and those on its edges.
#[inline(always)]
pub(super) fn family_of_triangle(v: [u32; 3], e: [u32; 3]) -> [[u32; 3]; 4] {
    [[v[0], e[0], e[2]], [v[1], e[1], e[0]], [v[2], e[2], e[1]], [e[2], e[0], e[1]]]
}

/// A child vertex by what it comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum PrimalChild {
    /// An old vertex.
    Vertex(u32),
    /// An edge, by number.
    Edge(u32),
    /// A face.
    Face(u32),
}

/// A quad or triangle split of a mesh: sizes and numbering of the children.
#[derive(Debug)]
pub(crate) struct PrimalSplit<'a> {
    pub(super) parent: &'a Mesh,
    pub(super) pieces: Pieces,
    pub(crate) counts: Counts,
    pub(crate) edges: EdgeNumbers,
    /// The sharp edges around the vertices that have some.
    pub(crate) arounds: Arounds,
}

impl<'a> PrimalSplit<'a> {
    /// Plans a split; `memory` is used for the numbers of the edges.
    ///
    /// # Errors
    /// [`ErrorKind::TooLarge`] if the children do not fit the index type,
    /// [`ErrorKind::Unsupported`] for a triangle split of other faces.
    pub(crate) fn new(
        context: &Context,
        parent: &'a Mesh,
        pieces: Pieces,
        memory: &mut EdgeNumbers,
    ) -> Result<Self> {
        let edges = EdgeNumbers::new(context, parent, memory)?;
        Ok(Self { edges, ..Self::by_corners(parent, pieces)? })
    }

    /// The split without numbers of edges, which rows that are asked for by corners and old
    /// vertices do without.
    ///
    /// # Errors
    /// As [`PrimalSplit::new`].
    pub(crate) fn by_corners(parent: &'a Mesh, pieces: Pieces) -> Result<Self> {
        let counts = Self::split_counts(&Counts::sizes_of(parent), pieces)
            .ok_or_else(|| Error::new(ErrorKind::TooLarge, "the split exceeds 64-bit sizes"))?;
        counts.check_index_type()?;
        let arounds = Arounds::new(parent)?;
        Ok(Self { parent, pieces, counts, edges: EdgeNumbers::default(), arounds })
    }

    /// The counts of the split mesh, `None` past 64 bits.
    pub(crate) fn split_counts(counts: &Counts, pieces: Pieces) -> Option<Counts> {
        match pieces {
            Pieces::Quads => counts.quads(),
            Pieces::Triangles => counts.triangles(),
        }
    }

    pub(crate) fn parent(&self) -> &'a Mesh {
        self.parent
    }

    pub(crate) fn pieces(&self) -> Pieces {
        self.pieces
    }

    /// Gives the memory of the edge numbers back.
    pub(crate) fn recycle(self) -> EdgeNumbers {
        self.edges
    }

    /// The child vertex on the outgoing edge of a corner.
    #[inline(always)]
    pub(crate) fn edge_vertex(&self, corner: u32) -> u32 {
        self.first_edge_vertex() + self.edges.of_corner[corner as usize]
    }

    /// The first child vertex on an edge.
    #[inline(always)]
    pub(crate) fn first_edge_vertex(&self) -> u32 {
        self.parent.vertices() as u32
    }

    /// The first child vertex in a face.
    #[inline(always)]
    pub(crate) fn first_face_vertex(&self) -> u32 {
        self.first_edge_vertex() + self.edges.count()
    }

    /// The child vertex in a face.
    #[inline(always)]
    pub(crate) fn face_vertex(&self, face: u32) -> u32 {
        self.first_face_vertex() + face
    }

    /// What a child vertex comes from.
    pub(crate) fn child(&self, vertex: u32) -> PrimalChild {
        if let Some(face) = vertex.checked_sub(self.first_face_vertex()) {
            PrimalChild::Face(face)
        } else if let Some(edge) = vertex.checked_sub(self.first_edge_vertex()) {
            PrimalChild::Edge(edge)
        } else {
            PrimalChild::Vertex(vertex)
        }
    }

    /// Writes the size of every child face.
    pub(crate) fn write_sizes(&self, out: &mut [u32]) {
        out.fill(match self.pieces {
            Pieces::Quads => 4,
            Pieces::Triangles => 3,
        });
    }

    /// Writes the concatenated vertices of all child faces, in order, reading in order.
    pub(crate) fn write_faces(&self, context: &Context, out: &mut [u32]) -> Result<()> {
        match self.pieces {
            Pieces::Quads => self.write_quads(context, out),
            Pieces::Triangles => self.write_triangles(context, out),
        }
    }

    fn write_quads(&self, context: &Context, out: &mut [u32]) -> Result<()> {
        let layout = &self.parent.layout;
        let first = layout.first_quad_corner();
        let middle = |c: u32| self.face_vertex(layout.face_of(c));
        let (irregular, quads) = out.as_chunks_mut::<4>().0.split_at_mut(first as usize);
        for (c, quad) in (0..).zip(irregular) {
            let before = self.edge_vertex(layout.prev(c));
            *quad = [self.parent.vert[c as usize], self.edge_vertex(c), middle(c), before];
        }
        let verts = self.parent.vert[first as usize..].as_chunks::<4>().0;
        let edges = self.edges.of_corner[first as usize..].as_chunks::<4>().0;
        let (on_edge, in_face) =
            (self.first_edge_vertex(), self.face_vertex(layout.irregular_faces()));
        context.fill(quads, 4, |start, part| {
            let parents = verts[start..].iter().zip(&edges[start..]);
            let faces = (start as u32..).zip(parents);
            for ((face, (v, e)), out) in faces.zip(part.as_chunks_mut::<4>().0) {
                *out = family_of_quad(*v, e.map(|e| on_edge + e), in_face + face);
            }
        })
    }

    fn write_triangles(&self, context: &Context, out: &mut [u32]) -> Result<()> {
        let verts = self.parent.vert.as_chunks::<3>().0;
        let edges = self.edges.of_corner.as_chunks::<3>().0;
        let on_edge = self.first_edge_vertex();
        let out = out.as_chunks_mut::<3>().0;
        context.fill(out, 4, |start, part| {
            let parents = verts[start..].iter().zip(&edges[start..]);
            for ((v, e), out) in parents.zip(part.as_chunks_mut::<4>().0) {
                *out = family_of_triangle(*v, e.map(|e| on_edge + e));
            }
        })
    }

    /// The child corner from the old vertex of a corner to the middle of its edge.
    #[inline(always)]
    pub(super) fn start_half(&self, corner: u32) -> u32 {
        self.pieces.start_half(corner)
    }

    /// The child corner from the middle of a corner's edge to its end.
    #[inline(always)]
    pub(super) fn end_half(&self, corner: u32) -> u32 {
        self.pieces.end_half(self.parent.next(corner))
    }

    /// The twin of the start half of a corner.
    #[inline(always)]
    pub(super) fn across_start(&self, corner: u32) -> u32 {
        match self.parent.twin[corner as usize] {
            NONE => NONE,
            twin => self.end_half(twin),
        }
    }

    /// The twin of the end half of a corner.
    #[inline(always)]
    pub(super) fn across_end(&self, corner: u32) -> u32 {
        match self.parent.twin[corner as usize] {
            NONE => NONE,
            twin => self.start_half(twin),
        }
    }
}
