//! The faces of the split mesh, block by block, written in order.

use super::corner_split::{CornerSplit, leads_edge};
use crate::base::{Context, NONE, Result};
use crate::mesh::Mesh;

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
    /// `out` holds `counts.corners` entries. Costs one pass over the parent's
    /// twins and one gather per vertex.
    pub(crate) fn write_faces(&self, context: &Context, out: &mut [u32]) -> Result<()> {
        let blocks = self.blocks;
        let cut = |out, len: u32| <[u32]>::split_at_mut(out, len as usize);
        let (faces, out) = cut(out, blocks.vertex_faces);
        let (vertex_faces, out) = cut(out, blocks.quads - blocks.vertex_faces);
        let (quads, out) = cut(out, blocks.edges - blocks.quads);
        let (edges, out) = cut(out, blocks.rim_edges - blocks.edges);
        let (rim_edges, vertex_quads) = cut(out, blocks.vertex_quads - blocks.rim_edges);
        // A child of a face has the parent's corners as vertices.
        write_run(context, faces, 0)?;
        write_run(context, quads, blocks.vertex_faces)?;
        self.write_irregular_vertex_faces(vertex_faces);
        self.write_edge_quads(context, edges)?;
        self.write_rim_quads(context, rim_edges)?;
        self.write_vertex_quads(context, vertex_quads)
    }

    fn write_irregular_vertex_faces(&self, mut out: &mut [u32]) {
        for &(v, size) in &self.irregular {
            let (face, rest) = out.split_at_mut(size as usize);
            self.write_vertex_face(v, face);
            out = rest;
        }
    }

    fn write_edge_quads(&self, context: &Context, mut out: &mut [u32]) -> Result<()> {
        let parent = self.parent;
        let mut parts = Vec::with_capacity(self.edge_chunks.len());
        for chunk in &self.edge_chunks {
            let (part, rest) = out.split_at_mut(4 * chunk.edges.len());
            parts.push((chunk.corners.clone(), part));
            out = rest;
        }
        context.for_each(parts, |(corners, part)| {
            let (quads, _) = part.as_chunks_mut::<4>();
            let mut place = 0;
            let twins = &parent.twin[corners.clone()];
            for (c, &twin) in (corners.start as u32..).zip(twins) {
                // Written whether it counts or not: which corner leads its edge
                // is hard to foresee, and a store costs less than a wrong guess.
                let Some(quad) = quads.get_mut(place) else { break };
                let across = if twin == NONE { NONE } else { parent.next(twin) };
                *quad = [parent.next(c), c, across, twin];
                place += usize::from(leads_edge(c, twin));
            }
        })
    }

    fn write_rim_quads(&self, context: &Context, out: &mut [u32]) -> Result<()> {
        let (parent, beta) = (self.parent, self.parent.layout.corners());
        context.fill(out, 4, |first, part| {
            let (quads, _) = part.as_chunks_mut::<4>();
            for (b, quad) in (first..).zip(quads) {
                let c = parent.rim[b];
                *quad = [parent.next(c), c, beta + 2 * b as u32, beta + 2 * b as u32 + 1];
            }
        })
    }

    fn write_vertex_quads(&self, context: &Context, mut out: &mut [u32]) -> Result<()> {
        let mut parts = Vec::new();
        for range in context.chunks(self.parent.vertices()) {
            let (start, end) = (range.start as u32, range.end as u32);
            let skipped = self.skipped_before(end) - self.skipped_before(start);
            let (part, rest) = out.split_at_mut(4 * (end - start - skipped) as usize);
            parts.push((start, part));
            out = rest;
        }
        context.for_each(parts, |(first, part)| {
            let (quads, _) = part.as_chunks_mut::<4>();
            let skip = self.skipped_before(first) as usize;
            let mut skipped = self.without_quad[skip..].iter().copied().peekable();
            let mut v = first;
            for quad in quads {
                while skipped.next_if_eq(&v).is_some() {
                    v += 1;
                }
                if !write_regular_fan(self.parent, v, quad) {
                    self.write_vertex_face(v, quad);
                }
                v += 1;
            }
        })
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

fn write_run(context: &Context, out: &mut [u32], first: u32) -> Result<()> {
    context.fill(out, 1, |start, part| {
        for (value, slot) in (first + start as u32..).zip(part) {
            *slot = value;
        }
    })
}

/// Writes the fan of an interior vertex of valence 4; false on a boundary.
#[inline]
fn write_regular_fan(parent: &Mesh, vertex: u32, out: &mut [u32; 4]) -> bool {
    let start = parent.start[vertex as usize];
    let clockwise = parent.twin[start as usize];
    if clockwise == NONE {
        return false;
    }
    // Both ways from the start, so that only the opposite corner is a second
    // dependent load.
    let second = parent.ccw(start);
    *out = [start, second, parent.ccw(second), parent.next(clockwise)];
    true
}
