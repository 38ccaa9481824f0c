//! How sharpness is used up, as in OpenSubdiv: in single precision, step by step.

use crate::base::{NONE, Result, memory};
use crate::mesh::Mesh;
use crate::mesh::sharpness::INFINITE;

/// What a step leaves of the sharpness of an edge.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
#[non_exhaustive]
pub enum Creasing {
    /// One less.
    #[default]
    Uniform,
    /// One less than three quarters of its own and one quarter of the mean of the other
    /// semi-sharp edges at that end: sharpness varies smoothly along a crease.
    Chaikin,
}

impl Creasing {
    /// The sharpness of the half of an edge, given all edges around that end.
    pub(crate) fn edge(self, sharpness: f32, around: Around) -> f32 {
        let smooth = sharpness <= 0.0 || sharpness >= INFINITE;
        if self == Self::Uniform || around.count < 2 || smooth {
            return decrement(sharpness);
        }
        let others = (around.sum - sharpness) / (around.count - 1) as f32;
        ((0.75 * sharpness + 0.25 * others) - 1.0).max(0.0)
    }
}

/// What is left of sharp vertices, whatever the method for edges is.
pub(super) fn vertices_left(sharp: &[(u32, f32)]) -> Result<Vec<(u32, f32)>> {
    let left = sharp.iter().map(|&(v, sharpness)| (v, decrement(sharpness)));
    memory::collect(left.filter(|&(_, sharpness)| sharpness > 0.0))
}

/// One less, but never below 0, and infinity stays.
pub(crate) fn decrement(sharpness: f32) -> f32 {
    if sharpness >= INFINITE { INFINITE } else { (sharpness - 1.0).max(0.0) }
}

/// What lies around the vertices with a sharp edge, each looked at once.
#[derive(Debug, Default)]
pub(crate) struct Arounds(Vec<(u32, Around)>);

impl Arounds {
    pub(super) fn new(mesh: &Mesh) -> Result<Self> {
        let corners = mesh.sharpness.edges.iter().flat_map(|&(c, _)| [c, mesh.next(c)]);
        let mut vertices = memory::collect(corners.map(|c| mesh.vert[c as usize]))?;
        vertices.sort_unstable();
        vertices.dedup();
        memory::collect(vertices.into_iter().map(|v| (v, Around::of(mesh, v)))).map(Self)
    }

    /// What lies around a vertex; nothing, if no sharp edge is listed there.
    pub(crate) fn at(&self, vertex: u32) -> Around {
        let found = self.0.binary_search_by_key(&vertex, |&(v, _)| v);
        found.map_or(Around::default(), |i| self.0[i].1)
    }
}

/// The semi-sharp edges around a vertex.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Around {
    sum: f32,
    count: u32,
}

impl Around {
    /// Looks around a vertex.
    pub(crate) fn of(mesh: &Mesh, vertex: u32) -> Self {
        let mut around = Self::default();
        mesh.each_edge_at(vertex, |_, sharpness| around.add(sharpness));
        around
    }

    /// Counts an edge, unless it is smooth or infinitely sharp.
    pub(crate) fn add(&mut self, sharpness: f32) {
        if sharpness > 0.0 && sharpness < INFINITE {
            self.sum += sharpness;
            self.count += 1;
        }
    }
}

impl Mesh {
    /// The sharpness of the outgoing edge of a corner: infinite on a boundary and where
    /// the mesh is not manifold.
    pub(crate) fn edge_sharpness(&self, corner: u32) -> f32 {
        match self.twin[corner as usize] {
            NONE => INFINITE,
            _ if self.sharpness.edges.is_empty() => 0.0,
            twin => self.sharpness.edge(corner.min(twin)),
        }
    }

    /// Calls `each` with a corner at the far end and the sharpness of every edge at a
    /// vertex, once for each edge.
    pub(crate) fn each_edge_at(&self, vertex: u32, mut each: impl FnMut(u32, f32)) {
        for corner in self.fans(vertex) {
            if self.twin[corner as usize] != NONE || self.is_first_of_edge(corner) {
                each(self.next(corner), self.edge_sharpness(corner));
            }
            // The last edge of an open fan leaves from no corner here.
            let before = self.prev(corner);
            if self.twin[before as usize] == NONE && self.is_first_of_edge(before) {
                each(before, INFINITE);
            }
        }
    }
}
