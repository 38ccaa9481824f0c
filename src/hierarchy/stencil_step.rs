//! The rows of one step on the ring of a face.

use super::Interpolation;
use super::stencil_patterns::{lost, padded};
use super::stencil_ring::Ring;
use crate::base::{Result, Scalar, memory};
use crate::mesh::Mesh;
use crate::refine::{Pieces, PrimalSplit};
use crate::scheme::{PointSink, PrimalRows, Scheme, SmoothMasks};
use crate::sparse::{PlacedRows, PlacedWriter};

/// The vertices that the split makes of a face and of the edges and faces at its vertices.
pub(super) struct StepRows<'a> {
    rows: PrimalRows<'a, f64>,
    split: &'a PrimalSplit<'a>,
    ring: &'a Ring,
    terms: Terms,
    sums: [f64; 256],
    /// The vertices on edges, in the order of the ring's.
    on_edges: Vec<u32>,
    /// Rows that were made already: the child and where it stands.
    made: Vec<(u32, usize)>,
}

/// A child vertex by what it comes from: an edge is named by a corner.
enum Child {
    Vertex(u32),
    Edge(u32),
    Face(u32),
}

impl<'a> StepRows<'a> {
    pub(super) fn new(
        scheme: &'a Scheme,
        split: &'a PrimalSplit<'a>,
        interpolation: Interpolation,
        ring: &'a Ring,
    ) -> Self {
        let masks = match interpolation {
            Interpolation::Vertex => SmoothMasks::new(scheme),
            Interpolation::Varying => SmoothMasks::linear(),
        };
        Self {
            rows: PrimalRows::with_masks(scheme, split, masks),
            split,
            ring,
            terms: Terms::default(),
            sums: [0.0; 256],
            on_edges: Vec::new(),
            made: Vec::new(),
        }
    }

    /// The rows of all slots of the face after one step.
    pub(super) fn first<T: Scalar>(&mut self) -> Result<PlacedRows<T>> {
        let mesh = self.split.parent();
        let corners = mesh.layout.face_around(self.ring.edges[0]);
        let vertices = self.ring.vertices[..corners.len()].iter().map(|&v| Child::Vertex(v));
        let face = match self.split.pieces() {
            Pieces::Quads => Some(Child::Face(mesh.layout.face_of(corners.start))),
            Pieces::Triangles => None,
        };
        let places = self.ring.vertices.len();
        let mut rows = PlacedWriter::new(2 * corners.len() + 1, places)?;
        for child in vertices.chain(corners.map(Child::Edge)).chain(face) {
            self.make(&child)?;
            rows.push(&self.sums[..places]);
        }
        Ok(rows.finish())
    }

    /// Finds out how the child mesh calls the vertices on edges.
    pub(super) fn name_children(&mut self, child: &Mesh) -> Result<()> {
        let middle = |&c: &u32| child.vert[self.split.pieces().start_half(c) as usize + 1];
        self.on_edges.clear();
        memory::extend(&mut self.on_edges, self.ring.edges.iter().map(middle))
    }

    /// Adds the row of a vertex of the child mesh, with all its zeros.
    pub(super) fn add_row(&mut self, vertex: u32, dense: &mut Vec<f64>) -> Result<()> {
        let len = padded(self.ring.vertices.len());
        memory::grow(dense, len)?;
        let known = self.made.iter().find(|made| made.0 == vertex);
        if let Some(&(_, start)) = known {
            dense.extend_from_within(start..start + len);
        } else {
            memory::extend(&mut self.made, [(vertex, dense.len())])?;
            self.make(&self.child(vertex)?)?;
            dense.extend_from_slice(&self.sums[..len]);
        }
        Ok(())
    }

    fn child(&self, vertex: u32) -> Result<Child> {
        let mesh = self.split.parent();
        let on_edge = mesh.vertices() as u32;
        let in_face = on_edge + mesh.edges() as u32;
        if vertex < on_edge {
            return Ok(Child::Vertex(vertex));
        }
        if vertex >= in_face {
            return Ok(Child::Face(vertex - in_face));
        }
        let place = self.on_edges.iter().position(|&v| v == vertex).ok_or_else(lost)?;
        Ok(Child::Edge(self.ring.edges[place]))
    }

    /// Leaves a row in the sums. It does not depend on where the mesh begins to go around
    /// a vertex: old vertices come once each, and those of faces are added after them, the
    /// smallest shares first.
    fn make(&mut self, child: &Child) -> Result<()> {
        let (mesh, terms) = (self.split.parent(), &mut self.terms);
        self.sums[..self.ring.vertices.len()].fill(0.0);
        terms.vertices.clear();
        terms.faces.clear();
        match *child {
            Child::Vertex(v) => self.rows.vertex_row(v, terms),
            Child::Edge(corner) => self.rows.edge_row(corner, terms),
            Child::Face(face) => terms.face(face, 1.0),
        }
        for term in &mut terms.faces {
            term.1 /= mesh.layout.face(term.0).len() as f64;
        }
        terms.faces.sort_unstable_by(|a, b| a.1.total_cmp(&b.1));
        let of_faces = terms.faces.iter().flat_map(|&(face, share)| {
            mesh.face_vertices(face as usize).iter().map(move |&v| (v, share))
        });
        for (vertex, weight) in terms.vertices.iter().copied().chain(of_faces) {
            let place = self.ring.vertices.iter().position(|&v| v == vertex);
            self.sums[place.ok_or_else(lost)? & 255] += weight;
        }
        Ok(())
    }
}

/// The terms of a row as they come.
#[derive(Default)]
struct Terms {
    vertices: Vec<(u32, f64)>,
    faces: Vec<(u32, f64)>,
}

impl PointSink<f64> for Terms {
    fn vertex(&mut self, vertex: u32, weight: f64) {
        self.vertices.push((vertex, weight));
    }

    fn face(&mut self, face: u32, weight: f64) {
        self.faces.push((face, weight));
    }
}
