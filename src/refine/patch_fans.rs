//! The faces around the extraordinary vertices of a mesh without boundary.

use super::Pieces;
use crate::base::{Context, NONE, Result, memory};
use crate::mesh::{Mesh, VertexSet};
use std::ops::Range;

/// The fans of all extraordinary vertices, one after the other: a slot for each corner.
#[derive(Debug)]
pub(crate) struct PatchFans {
    vertices: Vec<u32>,
    set: VertexSet,
    /// The first slot of each vertex, and their number at the end.
    start: Vec<u32>,
    /// The corner of each slot, and which vertex it belongs to.
    corners: Vec<u32>,
    owners: Vec<u32>,
    /// Corners and their slots, ascending.
    slots: Vec<(u32, u32)>,
}

impl PatchFans {
    /// The fans of a mesh, noticing a cancel.
    pub(crate) fn new(context: &Context, mesh: &Mesh, pieces: Pieces) -> Result<Self> {
        let vertices = match pieces {
            Pieces::Quads => {
                let used = |&v: &u32| mesh.start[v as usize] != NONE;
                memory::collect(mesh.special.iter().copied().filter(used))?
            }
            Pieces::Triangles => {
                let odd = |&v: &u32| mesh.start[v as usize] != NONE && !has_valence(mesh, v, 6);
                memory::collect((0..mesh.vertices() as u32).filter(odd))?
            }
        };
        let (mut start, mut corners, mut owners) = (memory::collect([0])?, Vec::new(), Vec::new());
        for (owner, &v) in (0_u32..).zip(&vertices) {
            if owner.is_multiple_of(1 << 16) {
                context.check_cancelled()?;
            }
            memory::extend(&mut corners, mesh.fan(v))?;
            let added = corners.len() - owners.len();
            memory::extend(&mut owners, std::iter::repeat_n(owner, added))?;
            memory::extend(&mut start, [corners.len() as u32])?;
        }
        context.check_cancelled()?;
        let mut slots = memory::collect(corners.iter().copied().zip(0..))?;
        slots.sort_unstable();
        context.check_cancelled()?;
        let set = VertexSet::new(mesh.vertices(), &vertices)?;
        Ok(Self { vertices, set, start, corners, owners, slots })
    }

    /// No fans: linear steps treat all vertices alike.
    pub(crate) fn none() -> Self {
        let start = Vec::new();
        let (vertices, set, corners) = (Vec::new(), VertexSet::default(), Vec::new());
        Self { vertices, set, start, corners, owners: Vec::new(), slots: Vec::new() }
    }

    /// The extraordinary vertices.
    pub(crate) fn vertices(&self) -> &[u32] {
        &self.vertices
    }

    /// True for an extraordinary vertex.
    #[inline(always)]
    pub(crate) fn contains(&self, vertex: u32) -> bool {
        self.set.contains(vertex)
    }

    /// The corner of every slot.
    pub(crate) fn corners(&self) -> &[u32] {
        &self.corners
    }

    /// The slots of a vertex, by its place among the extraordinary ones.
    pub(crate) fn slots_of(&self, vertex: usize) -> Range<usize> {
        self.start[vertex] as usize..self.start[vertex + 1] as usize
    }

    /// The place of a slot's vertex among the extraordinary ones.
    pub(crate) fn owner(&self, slot: usize) -> usize {
        self.owners[slot] as usize
    }

    /// The slot that lies `by` places counter-clockwise of one, once around or more.
    pub(crate) fn turn(&self, slot: usize, by: usize) -> usize {
        let slots = self.slots_of(self.owner(slot));
        let (first, n) = (slots.start, slots.len());
        first + (slot - first + by) % n
    }

    /// The slot that lies next, clockwise.
    pub(crate) fn back(&self, slot: usize) -> usize {
        let slots = self.slots_of(self.owner(slot));
        if slot == slots.start { slots.end - 1 } else { slot - 1 }
    }

    /// The slot of a corner at an extraordinary vertex.
    ///
    /// # Panics
    /// If the corner is at another one.
    pub(crate) fn slot(&self, corner: u32) -> usize {
        let at = self.slots.binary_search_by_key(&corner, |&(corner, _)| corner);
        self.slots[at.expect("the corner of an extraordinary vertex")].1 as usize
    }
}

fn has_valence(mesh: &Mesh, vertex: u32, n: usize) -> bool {
    mesh.fan(vertex).take(n + 1).count() == n
}
