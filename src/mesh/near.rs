//! Which corner of an edge, and of a vertex, its child stands near.
//!
//! A split gives every interior edge and every vertex a face. That face stands,
//! in the child mesh, near one of the corners concerned: the one that *leads*
//! the edge, the one that *starts* the fan. For a mesh from outside the smaller
//! corner leads. In a split mesh the child of a face leads all its interior edges, the
//! quad of an edge those to the vertex faces, and every fan of a corner's child
//! starts in the child of the face; so whole faces are alike and their children
//! are laid out without looking at a single corner.

use super::Mesh;
use crate::base::{NONE, Result, memory};

/// For each quad: bit i if corner i leads an interior edge, bit 4 + i if it
/// starts the fan of an interior vertex of valence 4. For each irregular corner:
/// bits 0 and 4.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub(crate) struct Near {
    pub(crate) irregular: Vec<u8>,
    pub(crate) quads: Vec<u8>,
}

/// A quad whose corners all lead and start: the child of a regular quad.
pub(crate) const LEADS_ALL: u8 = 0xff;
/// A quad that leads with every second corner: the quad of an edge.
pub(crate) const LEADS_OUTER: u8 = 0b1010;
/// A quad that leads nothing: the quad of a vertex.
pub(crate) const LEADS_NONE: u8 = 0;
/// The bit of a corner that leads.
pub(crate) const LEADS: u8 = 1;
/// The bit of a corner that starts a fan.
pub(crate) const STARTS: u8 = 1 << 4;

impl Near {
    /// Smaller corners lead.
    pub(crate) fn of(mesh: &Mesh) -> Result<Self> {
        let first = mesh.layout.first_quad_corner();
        let corner = |c: u32| {
            let twin = mesh.twin[c as usize];
            let v = mesh.vert[c as usize];
            let leads = c < twin && twin != NONE;
            let starts = mesh.start[v as usize] == c && !mesh.special_set.contains(v);
            (u8::from(leads) * LEADS) | (u8::from(starts) * STARTS)
        };
        let quads = (first..mesh.layout.corners()).step_by(4);
        let quad = |c| (0..4).map(|i| corner(c + i) << i).fold(0, |a, b| a | b);
        let irregular = memory::collect((0..first).map(corner))?;
        Ok(Self { irregular, quads: memory::collect(quads.map(quad))? })
    }

    /// Bytes held.
    pub(crate) fn bytes(&self) -> u64 {
        (self.irregular.capacity() + self.quads.capacity()) as u64
    }

    /// A copy.
    pub(crate) fn try_clone(&self) -> Result<Self> {
        let irregular = memory::copied(&self.irregular)?;
        Ok(Self { irregular, quads: memory::copied(&self.quads)? })
    }

    /// The bits of a corner, at places 0 and 4; quads begin at `first`.
    #[inline(always)]
    pub(crate) fn corner(&self, first: u32, corner: u32) -> u8 {
        let bits = match corner.checked_sub(first) {
            None => self.irregular[corner as usize],
            Some(local) => self.quads[local as usize / 4] >> (local & 3),
        };
        bits & (LEADS | STARTS)
    }

    /// Sets bits of a corner.
    pub(crate) fn set(&mut self, first: u32, corner: u32, bits: u8) {
        match corner.checked_sub(first) {
            None => self.irregular[corner as usize] |= bits,
            Some(local) => self.quads[local as usize / 4] |= bits << (local & 3),
        }
    }
}
