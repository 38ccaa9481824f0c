//! The faces of the split mesh, written in order.

use super::corner_split::CornerSplit;
use crate::base::{Context, NONE, Result};
use crate::mesh::QuadWalker;
use crate::mesh::near::{LEADS, LEADS_ALL, LEADS_NONE, LEADS_OUTER, STARTS};

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
        let first = self.vertex_faces;
        context.for_each(parts, |(corners, out)| {
            let mut out = Quads { out, place: 0 };
            if corners.end <= first {
                for c in corners {
                    self.write_vertex_quad(c, &mut out);
                    self.write_edge_quad(c, &mut out);
                }
                return;
            }
            let walker = QuadWalker::new(self.parent);
            let near = &self.near.quads[(corners.start - first) as usize / 4..];
            for (c, &near) in corners.step_by(4).zip(near) {
                out.push([c, c + 1, c + 2, c + 3], true);
                if !write_regular_quads(walker, c, near, &mut out) {
                    (c..c + 4).for_each(|c| self.write_vertex_quad(c, &mut out));
                    (c..c + 4).for_each(|c| self.write_edge_quad(c, &mut out));
                }
            }
        })
    }

    /// The quad of the vertex whose fan starts at a corner, if it does.
    #[cold]
    #[inline(never)]
    fn write_vertex_quad(&self, corner: u32, out: &mut Quads) {
        if self.starts_quad(corner) {
            let mut quad = [0; 4];
            self.write_vertex_face(self.parent.vert[corner as usize], &mut quad);
            out.push(quad, true);
        }
    }

    /// The quad of the edge that a corner leads, if it does.
    #[cold]
    #[inline(never)]
    fn write_edge_quad(&self, corner: u32, out: &mut Quads) {
        if self.leads_quad(corner) {
            let across = match self.parent.twin[corner as usize] {
                NONE => [self.beta(corner, false), self.beta(corner, true)],
                twin => [self.parent.next(twin), twin],
            };
            out.push([self.parent.next(corner), corner, across[0], across[1]], true);
        }
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

/// The quads near a regular quad, but for its own child; false if it is none.
#[inline(always)]
fn write_regular_quads(walker: QuadWalker, corner: u32, near: u8, out: &mut Quads) -> bool {
    let own = |i: usize| corner + (i as u32 & 3);
    let edge = |i: usize, twin: u32| [own(i + 1), own(i), walker.turn(twin, 1), twin];
    if near == LEADS_NONE {
        return true;
    }
    if near == LEADS_OUTER {
        let twins = walker.twins(corner);
        if !walker.holds(twins[1]) || !walker.holds(twins[3]) {
            return false;
        }
        out.push(edge(1, twins[1]), true);
        out.push(edge(3, twins[3]), true);
        return true;
    }
    let Some(ring) = walker.ring(corner) else { return false };
    let vertex = |i: usize| {
        let across = walker.turn(ring.across[i], 1);
        [own(i), ring.across[(i + 3) % 4], ring.beyond[i], across]
    };
    if near == LEADS_ALL {
        (0..4).for_each(|i| out.push(vertex(i), true));
        (0..4).for_each(|i| out.push(edge(i, ring.across[i]), true));
    } else {
        // Written whether they count or not: which corners lead is hard to
        // foresee, and a store costs less than a wrong guess.
        (0..4).for_each(|i| out.push(vertex(i), near & (STARTS << i) != 0));
        (0..4).for_each(|i| out.push(edge(i, ring.across[i]), near & (LEADS << i) != 0));
    }
    true
}

/// Quads being written one after the other.
struct Quads<'o> {
    out: &'o mut [[u32; 4]],
    place: usize,
}

impl Quads<'_> {
    /// Writes a quad; it stays only if it counts.
    #[inline(always)]
    fn push(&mut self, quad: [u32; 4], counts: bool) {
        if let Some(slot) = self.out.get_mut(self.place) {
            *slot = quad;
            self.place += usize::from(counts);
        }
    }
}
