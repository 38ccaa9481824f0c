//! The faces of the split mesh, written in order.

use super::corner_split::CornerSplit;
use crate::base::{Context, Result};
use crate::mesh::QuadWalker;

impl CornerSplit<'_> {
    /// Writes the size of every child face.
    pub(crate) fn write_sizes(&self, out: &mut [u32]) {
        let layout = &self.parent.layout;
        let (head, quads) = out.split_at_mut(self.counts.irregular_faces as usize);
        let kept = head.len() - self.irregular.len();
        for (f, size) in (0..).zip(&mut head[..kept]) {
            *size = layout.face(f).len() as u32;
        }
        for (size, irregular) in head[kept..].iter_mut().zip(&self.irregular) {
            *size = irregular.1;
        }
        quads.fill(4);
    }

    /// Writes the concatenated vertices of all child faces.
    ///
    /// `out` holds `counts.corners` entries. One pass over the parent's faces;
    /// each quad costs a gather or two close by.
    pub(crate) fn write_faces(&self, context: &Context, out: &mut [u32]) -> Result<()> {
        let (irregular, quads) = out.split_at_mut(self.quads as usize);
        for (slot, corner) in irregular[..self.vertex_faces as usize].iter_mut().zip(0..) {
            *slot = corner;
        }
        let mut rest = &mut irregular[self.vertex_faces as usize..];
        for &(v, size) in &self.irregular {
            let (face, later) = rest.split_at_mut(size as usize);
            self.write_vertex_face(v, face);
            rest = later;
        }
        let mut parts = Vec::with_capacity(self.chunks.len());
        let mut rest = quads.as_chunks_mut::<4>().0;
        for chunk in &self.chunks {
            let (part, later) = rest.split_at_mut(chunk.quads.len());
            parts.push((chunk.corners.clone(), part));
            rest = later;
        }
        context.for_each(parts, |(corners, out)| {
            let mut out = Quads { out, place: 0 };
            if corners.start < self.vertex_faces {
                corners.for_each(|c| self.write_corner_quads(c, &mut out));
                return;
            }
            let walker = QuadWalker::new(self.parent);
            for c in corners.step_by(4) {
                out.push([c, c + 1, c + 2, c + 3], true);
                if !self.write_regular_quads(walker, c, &mut out) {
                    (c..c + 4).for_each(|c| self.write_corner_quads(c, &mut out));
                }
            }
        })
    }

    /// The quads of the vertex that a corner starts and of the edge it leads.
    #[cold]
    #[inline(never)]
    fn write_corner_quads(&self, corner: u32, out: &mut Quads) {
        let parent = self.parent;
        if self.starts_quad(corner) {
            let mut quad = [0; 4];
            self.write_vertex_face(parent.vert[corner as usize], &mut quad);
            out.push(quad, true);
        }
        if self.leads_quad(corner) {
            let twin = parent.twin[corner as usize];
            let across = match twin {
                crate::base::NONE => [self.beta(corner, false), self.beta(corner, true)],
                _ => [parent.next(twin), twin],
            };
            out.push([parent.next(corner), corner, across[0], across[1]], true);
        }
    }

    /// The same for all corners of a regular quad; false if it is none.
    #[inline(always)]
    fn write_regular_quads(&self, walker: QuadWalker, corner: u32, out: &mut Quads) -> bool {
        let Some(ring) = walker.ring(corner) else { return false };
        let vertices = walker.vertices(corner);
        for i in 0..4 {
            let (c, next) = (corner + i as u32, corner + (i as u32 + 1) % 4);
            let (twin, around) = (ring.across[i], ring.across[(i + 3) % 4]);
            let across = walker.turn(twin, 1);
            // Written whether they count or not: which corner starts and leads
            // is hard to foresee, and a store costs less than a wrong guess.
            let starts = self.parent.start[vertices[i] as usize] == c;
            out.push([c, around, ring.beyond[i], across], starts);
            out.push([next, c, across, twin], c < twin);
        }
        true
    }

    /// The face of a vertex: its fan, framed by β and κ on a boundary.
    fn write_vertex_face(&self, vertex: u32, out: &mut [u32]) {
        for (slot, child) in out.iter_mut().zip(self.vertex_face(vertex)) {
            *slot = child;
        }
    }

    /// The child vertices of a vertex face in order.
    pub(super) fn vertex_face(&self, vertex: u32) -> impl Iterator<Item = u32> + '_ {
        let frame = self.frame(vertex);
        let fan = self.parent.fan(vertex);
        frame
            .map(|f| f[0])
            .into_iter()
            .chain(fan)
            .chain(frame.map(|f| f[1]))
            .chain(self.kappa(vertex))
    }

    /// β on the outgoing and on the incoming boundary edge of a boundary vertex.
    pub(super) fn frame(&self, vertex: u32) -> Option<[u32; 2]> {
        if !self.lays_anchor() || !self.parent.on_rim(vertex) {
            return None;
        }
        let out = self.parent.start[vertex as usize];
        let last = self.parent.fan(vertex).last().expect("a boundary vertex has faces");
        Some([self.beta(out, false), self.beta(self.parent.prev(last), true)])
    }
}

/// Quads being written one after the other.
pub(super) struct Quads<'o> {
    pub(super) out: &'o mut [[u32; 4]],
    pub(super) place: usize,
}

impl Quads<'_> {
    /// Writes a quad; it stays only if it counts.
    #[inline(always)]
    pub(super) fn push(&mut self, quad: [u32; 4], counts: bool) {
        if let Some(slot) = self.out.get_mut(self.place) {
            *slot = quad;
            self.place += usize::from(counts);
        }
    }
}
