//! Topology: a polygon soup in, a validated orientable 2-manifold out.
//!
//! No positions here. A mesh is three arrays and a few short lists:
//!
//! | stored | per | meaning |
//! |---|---|---|
//! | layout | irregular face | first corner; regular faces are closed-form |
//! | `vert` | corner | its vertex |
//! | `twin` | corner | the corner across its outgoing edge, or [`NONE`] |
//! | `start` | vertex | first corner of its fan, or [`NONE`] if isolated |
//! | `rim` | – | the corners whose outgoing edge is a boundary edge |
//! | `special` | – | the vertices that are not interior of valence 4, as list and set |
//! | `near` | face | which corners lead their edge and start a fan; only corner splits ask |
//! | `sharpness` | – | the sharp interior edges and vertices |
//! | `joints` | – | edges and fans of a mesh that is not manifold |
//! | `holes` | – | the faces that are holes |
//! | `runs` | – | where runs of vertices begin that follow the order of the faces |
//!
//! The fan of a boundary vertex starts at the corner whose outgoing edge is the
//! boundary edge; that of an interior vertex at its smallest corner, or, in a
//! split mesh, at the child of the corner that the vertex comes from.
//! [`Mesh::validate`] checks the table, and that each edge has one leader.

mod anchor;
mod build;
mod channel;
mod cut;
mod defect;
mod joints;
mod layout;
pub(crate) mod near;
mod order;
mod pairing;
mod ring;
pub(crate) mod sharpness;
mod survey;
mod validate;

pub use build::{BuildOptions, Built, NonManifold, build};
pub use channel::{Channel, FaceVaryingMode};
#[cfg(feature = "capi")]
pub(crate) use defect::summary;
pub use defect::{Defect, Defects};
pub(crate) use joints::Joints;
pub(crate) use layout::{Layout, next_in_triangle, prev_in_triangle, turn_in_quad};
pub(crate) use near::Near;
pub(crate) use ring::{QuadWalker, VertexSet};
pub(crate) use sharpness::{INFINITE, Sharpness};
pub use survey::Survey;

use crate::base::{Crease, Error, NONE, Result, SharpVertex};
use std::ops::Range;

/// The topology of an orientable 2-manifold polygon mesh, closed or with
/// boundary, of any number of components.
///
/// Faces whose size is not the regular one (4, or 3 if all are triangles) come
/// first; within that rule the caller's order is kept, unless a large mesh comes
/// in no order at all: then its faces are put in breadth-first order. Either way
/// [`Mesh::face_source`] leads back. Vertices keep their numbers.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Mesh {
    pub(crate) layout: Layout,
    pub(crate) vert: Vec<u32>,
    pub(crate) twin: Vec<u32>,
    pub(crate) start: Vec<u32>,
    pub(crate) rim: Vec<u32>,
    pub(crate) special: Vec<u32>,
    pub(crate) special_set: VertexSet,
    pub(crate) near: Option<Near>,
    pub(crate) sharpness: Sharpness,
    pub(crate) joints: Joints,
    pub(crate) holes: Vec<u32>,
    /// Where runs of vertices begin, beside 0, that follow the order of the faces.
    pub(crate) runs: Vec<u32>,
    pub(crate) corner_tags: Vec<u32>,
    pub(crate) anchored: bool,
    /// A corner split has made it, or its caller marked it anchored: no control mesh.
    pub(crate) refined: bool,
    /// Input face of each face, where the order was changed.
    pub(crate) face_source: Option<Vec<u32>>,
}

impl Mesh {
    /// Builds a mesh from faces given as sizes and concatenated vertex indices,
    /// refusing whatever is not an orientable 2-manifold.
    ///
    /// For repairs, tags and the list of all defects see [`build`].
    ///
    /// # Errors
    /// The first of the mesh's [`Defects`], naming its elements.
    ///
    /// # Example
    /// ```
    /// let mesh = carvel::Mesh::from_polygons(5, &[4, 3], &[0, 1, 2, 3, 2, 1, 4])?;
    /// assert_eq!((mesh.faces(), mesh.edges(), mesh.boundary_edges()), (2, 6, 5));
    /// # Ok::<(), carvel::Error>(())
    /// ```
    pub fn from_polygons(vertices: usize, sizes: &[u32], indices: &[u32]) -> Result<Self> {
        let context = crate::base::Context::serial();
        build(&context, vertices, sizes, indices, &BuildOptions::default())
            .map(|built| built.mesh)
            .map_err(Error::from)
    }

    /// The number of vertices, isolated ones included.
    pub fn vertices(&self) -> usize {
        self.start.len()
    }

    /// The number of faces.
    pub fn faces(&self) -> usize {
        self.layout.faces() as usize
    }

    /// The number of corners: the sum of the face sizes.
    pub fn corners(&self) -> usize {
        self.vert.len()
    }

    /// The number of edges.
    pub fn edges(&self) -> usize {
        self.interior_edges() + self.boundary_edges() + self.joints.edges()
    }

    /// The number of edges with one face only.
    pub fn boundary_edges(&self) -> usize {
        self.rim.len() - self.joints.sides.len()
    }

    pub(crate) fn interior_edges(&self) -> usize {
        (self.corners() - self.rim.len()) / 2
    }

    /// True if the mesh has no boundary edge.
    pub fn is_closed(&self) -> bool {
        self.rim.is_empty()
    }

    /// True if a dual scheme's anchor row lies along the boundary already.
    pub fn is_anchored(&self) -> bool {
        self.anchored
    }

    /// The corners of a face, a contiguous range.
    ///
    /// # Panics
    /// If `face` is not below [`Mesh::faces`].
    pub fn face_corners(&self, face: usize) -> Range<usize> {
        assert!(face < self.faces(), "face {face} of {}", self.faces());
        let range = self.layout.face(face as u32);
        range.start as usize..range.end as usize
    }

    /// The vertices of a face, counter-clockwise.
    ///
    /// # Panics
    /// If `face` is not below [`Mesh::faces`].
    pub fn face_vertices(&self, face: usize) -> &[u32] {
        &self.vert[self.face_corners(face)]
    }

    /// The vertex of every corner: the concatenated face-vertex array.
    pub fn corner_vertices(&self) -> &[u32] {
        &self.vert
    }

    /// The corner across each corner's outgoing edge, [`NONE`] on a boundary.
    pub fn corner_twins(&self) -> &[u32] {
        &self.twin
    }

    /// The two vertices of every edge; edges are numbered by their first corner.
    pub fn edge_vertices(&self) -> impl Iterator<Item = [u32; 2]> + '_ {
        let first = |&c: &u32| self.is_first_of_edge(c);
        let ends = |c| [self.vert[c as usize], self.vert[self.next(c) as usize]];
        (0..self.layout.corners()).filter(first).map(ends)
    }

    /// Writes the number of every corner's outgoing edge.
    ///
    /// # Panics
    /// If `out` has another length than [`Mesh::corners`].
    pub fn write_corner_edges(&self, out: &mut [u32]) {
        assert_eq!(out.len(), self.corners(), "one entry for each corner");
        let mut edges = 0;
        for c in 0..self.layout.corners() {
            out[c as usize] = if self.is_first_of_edge(c) {
                edges += 1;
                edges - 1
            } else {
                out[self.first_of_edge(c) as usize]
            };
        }
    }

    /// True for the smallest corner of an edge.
    #[inline(always)]
    pub(crate) fn is_first_of_edge(&self, corner: u32) -> bool {
        let twin = self.twin[corner as usize];
        corner < twin && (twin != NONE || self.leads_joint(corner))
    }

    /// True unless another side of a non-manifold edge comes before this one.
    #[inline(always)]
    fn leads_joint(&self, corner: u32) -> bool {
        self.joints.sides.is_empty() || self.joints.leader(corner).is_none_or(|l| l == corner)
    }

    /// The smallest corner of the outgoing edge of a corner.
    pub(crate) fn first_of_edge(&self, corner: u32) -> u32 {
        match self.twin[corner as usize] {
            NONE => self.joints.leader(corner).unwrap_or(corner),
            twin => corner.min(twin),
        }
    }

    /// The size of every face, in order.
    pub fn face_sizes(&self) -> impl ExactSizeIterator<Item = u32> + '_ {
        (0..self.layout.faces() as usize).map(|f| self.layout.face(f as u32).len() as u32)
    }

    /// The number of faces, at the front, whose size is not the regular one.
    pub fn irregular_faces(&self) -> usize {
        self.layout.irregular_faces() as usize
    }

    /// The face of the caller's soup that became this face.
    ///
    /// # Panics
    /// If `face` is not below [`Mesh::faces`].
    pub fn face_source(&self, face: usize) -> usize {
        assert!(face < self.faces(), "face {face} of {}", self.faces());
        self.face_source.as_ref().map_or(face, |source| source[face] as usize)
    }

    /// The sharp edges that are not on the boundary, by their vertices.
    pub fn creases(&self) -> impl ExactSizeIterator<Item = Crease> + '_ {
        self.sharpness.edges.iter().map(|&(c, sharpness)| {
            let vertices = [self.vert[c as usize], self.vert[self.next(c) as usize]];
            Crease { vertices, sharpness }
        })
    }

    /// The sharp vertices, ascending.
    pub fn sharp_vertices(&self) -> impl ExactSizeIterator<Item = SharpVertex> + '_ {
        let tag = |&(vertex, sharpness): &(u32, f32)| SharpVertex { vertex, sharpness };
        self.sharpness.vertices.iter().map(tag)
    }

    /// The faces tagged as holes, ascending.
    pub fn holes(&self) -> &[u32] {
        &self.holes
    }

    /// True if every edge has at most two faces, which agree in orientation, and the
    /// faces around every vertex form one fan; false only under policy `sharpen`.
    pub fn is_manifold(&self) -> bool {
        self.joints.is_empty()
    }

    /// Tagged corner vertices of the boundary, ascending.
    pub fn corner_tags(&self) -> &[u32] {
        &self.corner_tags
    }

    /// The number of faces around a vertex.
    ///
    /// # Panics
    /// If `vertex` is not below [`Mesh::vertices`].
    pub fn valence(&self, vertex: usize) -> usize {
        self.fans(vertex as u32).count()
    }

    /// True if the vertex lies on a boundary, or on an edge that is not manifold.
    ///
    /// # Panics
    /// If `vertex` is not below [`Mesh::vertices`].
    pub fn is_boundary_vertex(&self, vertex: usize) -> bool {
        self.on_rim(vertex as u32)
    }

    /// The boundary vertices with a single face, ascending.
    pub(crate) fn single_face_vertices(&self) -> impl Iterator<Item = u32> + '_ {
        let single = |v: u32| self.on_rim(v) && self.ccw(self.start[v as usize]) == NONE;
        self.special.iter().copied().filter(move |&v| single(v))
    }

    /// Bytes held by the topology.
    pub fn bytes(&self) -> u64 {
        let lists = [&self.vert, &self.twin, &self.start, &self.rim, &self.special];
        let lists: usize = lists.iter().map(|list| list.capacity()).sum();
        let source = self.face_source.as_ref().map_or(0, Vec::capacity);
        self.layout.bytes()
            + self.special_set.bytes()
            + self.near.as_ref().map_or(0, Near::bytes)
            + self.sharpness.bytes()
            + self.joints.bytes()
            + 4 * self.holes.capacity() as u64
            + 4 * (lists + self.corner_tags.capacity() + source) as u64
    }

    #[inline(always)]
    pub(crate) fn next(&self, corner: u32) -> u32 {
        self.layout.next(corner)
    }

    #[inline(always)]
    pub(crate) fn prev(&self, corner: u32) -> u32 {
        self.layout.prev(corner)
    }

    /// The next corner around the vertex, counter-clockwise, or [`NONE`].
    #[inline(always)]
    pub(crate) fn ccw(&self, corner: u32) -> u32 {
        self.twin[self.prev(corner) as usize]
    }

    /// The next corner around the vertex, clockwise, or [`NONE`].
    #[inline(always)]
    pub(crate) fn cw(&self, corner: u32) -> u32 {
        match self.twin[corner as usize] {
            NONE => NONE,
            twin => self.next(twin),
        }
    }

    /// True if the vertex lies on the boundary (isolated ones do not).
    #[inline]
    pub(crate) fn on_rim(&self, vertex: u32) -> bool {
        let start = self.start[vertex as usize];
        start != NONE && self.twin[start as usize] == NONE
    }

    /// The corners of a vertex, counter-clockwise from the start of its fan; of the
    /// first one, where it has several.
    pub(crate) fn fan(&self, vertex: u32) -> impl Iterator<Item = u32> + '_ {
        self.fan_from(self.start[vertex as usize])
    }

    /// The corners of a vertex, fan after fan.
    pub(crate) fn fans(&self, vertex: u32) -> impl Iterator<Item = u32> + '_ {
        let further = self.joints.further_fans(vertex);
        self.fan(vertex).chain(further.flat_map(|start| self.fan_from(start)))
    }

    /// The corners of the fan that starts at a corner.
    pub(crate) fn fan_from(&self, start: u32) -> impl Iterator<Item = u32> + '_ {
        let some = |corner: u32| (corner != NONE).then_some(corner);
        std::iter::successors(some(start), move |&corner| {
            some(self.ccw(corner)).filter(|&next| next != start)
        })
    }
}
