//! The regular neighbourhood of a quad: four interior vertices of valence 4.
//!
//! Whether a quad has one is found out while walking around it, which costs less
//! than keeping lists of the quads that have none.

use super::{Mesh, turn_in_quad};
use crate::base::{Result, memory};

/// A set of vertices, one bit each.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub(crate) struct VertexSet(Vec<u64>);

impl VertexSet {
    /// The set of the listed vertices, empty without memory if there are none.
    pub(crate) fn new(vertices: usize, members: &[u32]) -> Result<Self> {
        let words = if members.is_empty() { 0 } else { vertices.div_ceil(64) };
        let mut set = memory::zeroed(words)?;
        for &v in members {
            set[v as usize / 64] |= 1 << (v % 64);
        }
        Ok(Self(set))
    }

    #[inline(always)]
    pub(crate) fn contains(&self, vertex: u32) -> bool {
        self.0.get(vertex as usize / 64).is_some_and(|word| (word >> (vertex % 64)) & 1 == 1)
    }

    /// Bytes held.
    pub(crate) fn bytes(&self) -> u64 {
        8 * self.0.capacity() as u64
    }
}

/// The corners around a quad whose vertices are interior of valence 4 and whose
/// neighbours are quads.
#[derive(Debug, Clone, Copy)]
pub(crate) struct QuadRing {
    /// The twins of its corners.
    pub(crate) across: [u32; 4],
    /// The corner opposite each of its corners around the vertex.
    pub(crate) beyond: [u32; 4],
}

/// Walks around quads.
#[derive(Debug, Clone, Copy)]
pub(crate) struct QuadWalker<'a> {
    pub(crate) mesh: &'a Mesh,
    first: u32,
    count: u32,
    /// Some vertices are special.
    special: bool,
}

impl<'a> QuadWalker<'a> {
    pub(crate) fn new(mesh: &'a Mesh) -> Self {
        let first = mesh.layout.first_quad_corner();
        let special = !mesh.special.is_empty();
        Self { mesh, first, count: mesh.layout.corners() - first, special }
    }

    /// True if the corner belongs to a quad.
    #[inline(always)]
    pub(crate) fn holds(self, corner: u32) -> bool {
        // NONE and irregular corners both fail this one comparison.
        corner.wrapping_sub(self.first) < self.count
    }

    /// The corner `by` places further around its quad.
    #[inline(always)]
    pub(crate) fn turn(self, corner: u32, by: u32) -> u32 {
        turn_in_quad(self.first, corner, by)
    }

    /// The first corner of the quad that a corner belongs to.
    #[inline(always)]
    pub(crate) fn face_start(self, corner: u32) -> u32 {
        self.first + ((corner - self.first) & !3)
    }

    /// The vertices of the quad that starts at `corner`.
    #[inline(always)]
    pub(crate) fn vertices(self, corner: u32) -> [u32; 4] {
        four(&self.mesh.vert, corner)
    }

    /// The twins of the quad that starts at `corner`.
    #[inline(always)]
    pub(crate) fn twins(self, corner: u32) -> [u32; 4] {
        four(&self.mesh.twin, corner)
    }

    /// The ring of the quad that starts at `corner`, if it is regular.
    #[inline(always)]
    pub(crate) fn ring(self, corner: u32) -> Option<QuadRing> {
        let across = self.twins(corner);
        let special = |&v: &u32| self.mesh.special_set.contains(v);
        if !across.iter().all(|&t| self.holds(t))
            || (self.special && self.vertices(corner).iter().any(special))
        {
            return None;
        }
        let around = |i: usize| self.mesh.twin[self.turn(across[(i + 3) % 4], 3) as usize];
        let beyond: [u32; 4] = std::array::from_fn(around);
        beyond.iter().all(|&c| self.holds(c)).then_some(QuadRing { across, beyond })
    }
}

#[inline(always)]
fn four(list: &[u32], corner: u32) -> [u32; 4] {
    let c = corner as usize;
    list[c..c + 4].try_into().expect("four corners")
}
