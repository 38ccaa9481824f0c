//! The split mesh with its adjacency: every child's twin by arithmetic.
//!
//! Needed for every level but the last. Gather only: each output is written
//! once, by whoever owns its place, from the parent's arrays.

use super::corner_split::{Child, CornerSplit, leads_edge};
use crate::base::{Context, NONE, Result};
use crate::mesh::Mesh;

/// Steps around a vertex that are cheaper than a search in the list of hubs.
const SHORT_FAN: u32 = 16;

/// Arrays of a level that are re-used for the next but one.
#[derive(Debug, Default)]
pub(crate) struct Recycled {
    pub(crate) vert: Vec<u32>,
    pub(crate) twin: Vec<u32>,
    pub(crate) start: Vec<u32>,
    pub(crate) edge: Vec<u32>,
    pub(crate) vertex_face: Vec<u32>,
}

impl Recycled {
    /// Takes a mesh apart, keeping its memory.
    pub(crate) fn absorb(&mut self, mesh: Mesh) {
        self.vert = mesh.vert;
        self.twin = mesh.twin;
        self.start = mesh.start;
    }

    /// Bytes held.
    pub(crate) fn bytes(&self) -> u64 {
        let lists = [&self.vert, &self.twin, &self.start, &self.edge, &self.vertex_face];
        4 * lists.iter().map(|list| list.capacity() as u64).sum::<u64>()
    }
}

/// An array of exactly `len` entries in re-used memory; entries keep whatever
/// they held, since every one of them is about to be written.
fn sized(mut list: Vec<u32>, len: usize) -> Vec<u32> {
    if list.capacity() < len {
        // Zeroed pages straight from the system, and no copy of the old entries.
        return vec![0; len];
    }
    list.resize(len, 0);
    list
}

impl CornerSplit<'_> {
    /// The split mesh.
    pub(crate) fn mesh(
        &self,
        context: &Context,
        anchored: bool,
        memory: &mut Recycled,
    ) -> Result<Mesh> {
        let mut vert = sized(std::mem::take(&mut memory.vert), self.counts.corners as usize);
        self.write_faces(context, &mut vert)?;
        let edge = sized(std::mem::take(&mut memory.edge), self.parent.corners());
        let vertex_face = sized(std::mem::take(&mut memory.vertex_face), self.parent.vertices());
        let links = Links::new(self, context, edge, vertex_face)?;
        let mut twin = sized(std::mem::take(&mut memory.twin), self.counts.corners as usize);
        links.write_twins(context, &mut twin)?;
        let mut start = sized(std::mem::take(&mut memory.start), self.counts.vertices as usize);
        links.write_starts(context, &mut start)?;
        let (rim, special) = (links.rim(), self.special());
        (memory.edge, memory.vertex_face) = (links.edge, links.vertex_face);
        Ok(Mesh {
            layout: self.child_layout(),
            vert,
            twin,
            start,
            rim,
            special,
            corner_tags: Vec::new(),
            anchored,
            face_source: None,
        })
    }

    /// The children that are not interior vertices of valence 4.
    fn special(&self) -> Vec<u32> {
        let parent = self.parent;
        let mut special = Vec::new();
        for &v in &parent.special {
            let keeps_rim = parent.on_rim(v) && !self.lays_anchor();
            if keeps_rim || (!parent.on_rim(v) && parent.fan(v).take(3).count() == 2) {
                special.extend(parent.fan(v));
            }
        }
        special.sort_unstable();
        special.extend(self.added_vertices());
        special
    }
}

/// Where the children of an edge and of a vertex begin.
struct Links<'a, 'b> {
    split: &'b CornerSplit<'a>,
    /// The edge's number, at its first corner; other entries mean nothing.
    edge: Vec<u32>,
    /// The first corner of the vertex face, or [`NONE`].
    vertex_face: Vec<u32>,
    /// Place in the fan of the corners of long fans, sorted by corner.
    hubs: Vec<(u32, u32)>,
}

impl<'a, 'b> Links<'a, 'b> {
    fn new(
        split: &'b CornerSplit<'a>,
        context: &Context,
        mut edge: Vec<u32>,
        mut vertex_face: Vec<u32>,
    ) -> Result<Self> {
        number_edges(split, context, &mut edge)?;
        place_vertex_faces(split, context, &mut vertex_face)?;
        let parent = split.parent;
        let long = |v: &u32| parent.fan(*v).nth(SHORT_FAN as usize).is_some();
        let mut hubs: Vec<(u32, u32)> = Vec::new();
        for v in parent.special.iter().copied().filter(long) {
            hubs.extend(parent.fan(v).zip(0..));
        }
        hubs.sort_unstable();
        Ok(Self { split, edge, vertex_face, hubs })
    }

    /// The child of a corner in the child of its face.
    #[inline]
    fn in_face(&self, corner: u32) -> u32 {
        let blocks = &self.split.blocks;
        let shift =
            if corner < blocks.vertex_faces { 0 } else { blocks.quads - blocks.vertex_faces };
        corner + shift
    }

    /// The inner corner of a corner in the quad of its edge.
    #[inline]
    fn inner(&self, corner: u32, twin: u32) -> u32 {
        let (first, side) = if twin < corner { (twin, 2) } else { (corner, 0) };
        self.split.blocks.edges + 4 * self.edge[first as usize] + side
    }

    /// The outer corner of a corner in the quad of its edge.
    #[inline]
    fn outer(&self, corner: u32) -> u32 {
        self.inner(corner, self.split.parent.twin[corner as usize]) + 1
    }

    /// The corner of a corner in the face of its vertex, which has one.
    #[inline]
    fn in_vertex_face(&self, corner: u32) -> u32 {
        let parent = self.split.parent;
        let v = parent.vert[corner as usize];
        let base = self.vertex_face[v as usize];
        let start = parent.start[v as usize];
        if corner == start {
            return base + u32::from(self.is_framed(v));
        }
        if base >= self.split.blocks.vertex_quads && parent.ccw(corner) == start {
            return base + 3;
        }
        base + self.fan_place(corner, start) + u32::from(self.is_framed(v))
    }

    #[inline]
    fn is_framed(&self, vertex: u32) -> bool {
        self.split.lays_anchor()
            && !self.split.parent.is_closed()
            && self.split.parent.on_rim(vertex)
    }

    /// The place of a corner in its fan, by steps back to the start.
    fn fan_place(&self, corner: u32, start: u32) -> u32 {
        let mut at = corner;
        for place in 0..SHORT_FAN {
            if at == start {
                return place;
            }
            at = self.split.parent.cw(at);
        }
        let hub = self.hubs.binary_search_by_key(&corner, |&(c, _)| c);
        self.hubs[hub.expect("long fans are listed")].1
    }

    fn write_twins(&self, context: &Context, out: &mut [u32]) -> Result<()> {
        let blocks = self.split.blocks;
        let cut = |out, len: u32| <[u32]>::split_at_mut(out, len as usize);
        let (faces, out) = cut(out, blocks.vertex_faces);
        let (vertex_faces, out) = cut(out, blocks.quads - blocks.vertex_faces);
        let (quads, out) = cut(out, blocks.edges - blocks.quads);
        let (edges, out) = cut(out, blocks.rim_edges - blocks.edges);
        let (rim_edges, vertex_quads) = cut(out, blocks.vertex_quads - blocks.rim_edges);
        self.write_face_twins(context, faces, 0)?;
        self.write_irregular_vertex_twins(vertex_faces);
        self.write_face_twins(context, quads, blocks.vertex_faces)?;
        self.write_edge_twins(context, edges)?;
        self.write_rim_twins(rim_edges);
        self.write_vertex_twins(context, vertex_quads)
    }

    fn write_face_twins(&self, context: &Context, out: &mut [u32], first: u32) -> Result<()> {
        let closes_rim = self.split.lays_anchor();
        context.fill(out, 1, |start, part| {
            for (corner, slot) in (first + start as u32..).zip(part) {
                let twin = self.split.parent.twin[corner as usize];
                let open = twin == NONE && !closes_rim;
                *slot = if open { NONE } else { self.inner(corner, twin) };
            }
        })
    }

    fn write_edge_twins(&self, context: &Context, mut out: &mut [u32]) -> Result<()> {
        let parent = self.split.parent;
        let mut parts = Vec::with_capacity(self.split.edge_chunks.len());
        for chunk in &self.split.edge_chunks {
            let (part, rest) = out.split_at_mut(4 * chunk.edges.len());
            parts.push((chunk.corners.clone(), part));
            out = rest;
        }
        context.for_each(parts, |(corners, part)| {
            let (quads, _) = part.as_chunks_mut::<4>();
            let mut quads = quads.iter_mut();
            for c in corners.start as u32..corners.end as u32 {
                let twin = parent.twin[c as usize];
                if leads_edge(c, twin)
                    && let Some(quad) = quads.next()
                {
                    let (at_start, at_end) = (parent.next(twin), parent.next(c));
                    *quad = [
                        self.in_face(c),
                        self.across_outer(at_start),
                        self.in_face(twin),
                        self.across_outer(at_end),
                    ];
                }
            }
        })
    }

    /// The twin of an edge quad's outer corner, given the next corner around
    /// its vertex, clockwise.
    #[inline]
    fn across_outer(&self, clockwise: u32) -> u32 {
        let parent = self.split.parent;
        let v = parent.vert[clockwise as usize];
        if self.vertex_face[v as usize] != NONE {
            self.in_vertex_face(clockwise)
        } else if !parent.is_closed() && parent.on_rim(v) {
            NONE
        } else {
            // Valence 2: the quads of the two edges meet.
            self.outer(clockwise)
        }
    }

    fn write_rim_twins(&self, out: &mut [u32]) {
        let parent = self.split.parent;
        let (quads, _) = out.as_chunks_mut::<4>();
        for (quad, &c) in quads.iter_mut().zip(&parent.rim) {
            let vertex_face = self.vertex_face[parent.vert[c as usize] as usize];
            *quad = [self.in_face(c), vertex_face, NONE, self.in_vertex_face(parent.next(c))];
        }
    }

    fn write_irregular_vertex_twins(&self, mut out: &mut [u32]) {
        for &(v, size) in &self.split.irregular {
            let (face, rest) = out.split_at_mut(size as usize);
            self.write_fan_twins(v, face);
            out = rest;
        }
    }

    fn write_vertex_twins(&self, context: &Context, out: &mut [u32]) -> Result<()> {
        let mut parts = Vec::new();
        let mut rest = out;
        for range in context.chunks(self.split.parent.vertices()) {
            let (start, end) = (range.start as u32, range.end as u32);
            let skipped = self.split.skipped_before(end) - self.split.skipped_before(start);
            let (part, later) = rest.split_at_mut(4 * (end - start - skipped) as usize);
            parts.push((start, part));
            rest = later;
        }
        context.for_each(parts, |(first, part)| {
            let (quads, _) = part.as_chunks_mut::<4>();
            let skip = self.split.skipped_before(first) as usize;
            let mut skipped = self.split.without_quad[skip..].iter().copied().peekable();
            let mut v = first;
            for quad in quads {
                while skipped.next_if_eq(&v).is_some() {
                    v += 1;
                }
                self.write_fan_twins(v, quad);
                v += 1;
            }
        })
    }

    /// The twins of a vertex face: the outer corner of the next corner's edge.
    fn write_fan_twins(&self, vertex: u32, out: &mut [u32]) {
        let parent = self.split.parent;
        let fan = parent.fan(vertex);
        if !self.is_framed(vertex) {
            let Some((last, head)) = out.split_last_mut() else { return };
            for (slot, corner) in head.iter_mut().zip(fan.skip(1)) {
                *slot = self.outer(corner);
            }
            *last = self.outer(parent.start[vertex as usize]);
            return;
        }
        out.fill(NONE);
        let mut incoming = NONE;
        let mut faces = 0;
        for (slot, corner) in out.iter_mut().zip(fan) {
            *slot = self.outer(corner);
            incoming = parent.prev(corner);
            faces += 1;
        }
        out[faces] = self.inner(incoming, NONE) + 3;
    }

    fn write_starts(&self, context: &Context, out: &mut [u32]) -> Result<()> {
        let parent = self.split.parent;
        let keeps_rim = !parent.is_closed() && !self.split.lays_anchor();
        let (corners, added) = out.split_at_mut(parent.corners());
        context.fill(corners, 1, |first, part| {
            for (c, slot) in (first as u32..).zip(part) {
                let v = parent.vert[c as usize];
                let own = self.in_face(c);
                *slot = if keeps_rim && parent.on_rim(v) {
                    if parent.twin[c as usize] == NONE { own } else { self.outer(c) }
                } else if self.vertex_face[v as usize] < own {
                    self.in_vertex_face(c)
                } else {
                    own
                };
            }
        })?;
        for (slot, vertex) in added.iter_mut().zip(self.split.added_vertices()) {
            *slot = match self.split.child(vertex) {
                Child::Corner(_) | Child::Isolated(_) => NONE,
                Child::Beta { corner, at_end: false } => self.inner(corner, NONE) + 2,
                Child::Beta { corner, at_end: true } => {
                    let end = parent.vert[parent.next(corner) as usize];
                    self.rim_corner(end)
                }
                Child::Kappa(v) => self.rim_corner(v) + 1,
            };
        }
        Ok(())
    }

    /// The corner of the incoming β in the face of a framed vertex.
    fn rim_corner(&self, vertex: u32) -> u32 {
        let faces = self.split.parent.fan(vertex).count() as u32;
        self.vertex_face[vertex as usize] + faces + 1
    }

    /// The child corners on the boundary, ascending.
    fn rim(&self) -> Vec<u32> {
        let parent = self.split.parent;
        let mut rim = Vec::with_capacity(self.split.counts.boundary_edges as usize);
        for &c in &parent.rim {
            let v = parent.vert[c as usize];
            if self.split.lays_anchor() {
                rim.push(self.inner(c, NONE) + 2);
                rim.push(self.rim_corner(v));
                rim.extend(self.split.kappa(v).map(|_| self.rim_corner(v) + 1));
            } else {
                rim.push(self.in_face(c));
                rim.extend(parent.fan(v).skip(1).map(|c| self.outer(c)));
            }
        }
        rim.sort_unstable();
        rim
    }
}

/// Numbers the edges at their first corners: interior ones in corner order,
/// then the boundary.
fn number_edges(split: &CornerSplit, context: &Context, edge: &mut [u32]) -> Result<()> {
    let parent = split.parent;
    let mut parts = Vec::with_capacity(split.edge_chunks.len());
    let mut rest = &mut *edge;
    for chunk in &split.edge_chunks {
        let (part, later) = rest.split_at_mut(chunk.corners.len());
        parts.push((chunk, part));
        rest = later;
    }
    context.for_each(parts, |(chunk, part)| {
        let mut number = chunk.edges.start;
        let twins = &parent.twin[chunk.corners.clone()];
        for ((c, slot), &twin) in (chunk.corners.start as u32..).zip(part).zip(twins) {
            *slot = number;
            number += u32::from(leads_edge(c, twin));
        }
    })?;
    for (number, &c) in (parent.interior_edges() as u32..).zip(&parent.rim) {
        edge[c as usize] = number;
    }
    Ok(())
}

/// The first corner of every vertex face: quads by rank, the rest from the list.
fn place_vertex_faces(split: &CornerSplit, context: &Context, out: &mut [u32]) -> Result<()> {
    context.fill(out, 1, |first, part| {
        let skip = split.skipped_before(first as u32);
        let mut skipped = split.without_quad[skip as usize..].iter().copied().peekable();
        let mut base = split.blocks.vertex_quads + 4 * (first as u32 - skip);
        for (v, slot) in (first as u32..).zip(part) {
            *slot = if skipped.next_if_eq(&v).is_some() {
                NONE
            } else {
                base += 4;
                base - 4
            };
        }
    })?;
    let mut base = split.blocks.vertex_faces;
    for &(v, size) in &split.irregular {
        out[v as usize] = base;
        base += size;
    }
    Ok(())
}
