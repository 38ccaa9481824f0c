//! The split mesh with its adjacency: every child's twin by arithmetic.
//!
//! Needed for every level but the last. Gather only: each output is written
//! once, by whoever owns its place, from the parent's arrays.

use super::corner_split::{Child, CornerSplit};
use super::faces::Quads;
use crate::base::{Context, NONE, Result};
use crate::mesh::{Mesh, QuadWalker, VertexSet};

/// Steps around a vertex that are cheaper than a search in the list of hubs.
const SHORT_FAN: u32 = 16;

/// Arrays of a level that are used again in the next call.
#[derive(Debug, Default)]
pub(crate) struct Recycled {
    vert: Vec<u32>,
    twin: Vec<u32>,
    start: Vec<u32>,
    place: Vec<u32>,
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
        let lists = [&self.vert, &self.twin, &self.start, &self.place];
        4 * lists.iter().map(|list| list.capacity() as u64).sum::<u64>()
    }
}

/// An array of exactly `len` entries in re-used memory; entries keep whatever
/// they held, since every one of them is about to be written.
fn sized(list: &mut Vec<u32>, len: usize) -> Vec<u32> {
    let mut list = std::mem::take(list);
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
        let mut vert = sized(&mut memory.vert, self.counts.corners as usize);
        self.write_faces(context, &mut vert)?;
        let links = Links::new(self, context, sized(&mut memory.place, self.parent.corners()))?;
        let mut twin = sized(&mut memory.twin, self.counts.corners as usize);
        let mut start = sized(&mut memory.start, self.counts.vertices as usize);
        links.write(context, &mut twin, &mut start)?;
        let (rim, special) = (links.rim(), self.special());
        memory.place = links.place;
        Ok(Mesh {
            layout: self.child_layout(),
            vert,
            twin,
            start,
            rim,
            special_set: VertexSet::new(self.counts.vertices as usize, &special),
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

/// Where the children of a corner are.
struct Links<'a, 'b> {
    split: &'b CornerSplit<'a>,
    /// How many child quads precede those of each corner.
    place: Vec<u32>,
    /// The first corner of each irregular vertex face, by vertex.
    irregular: Vec<(u32, u32)>,
    /// Place in the fan of the corners of long fans, sorted by corner.
    hubs: Vec<(u32, u32)>,
}

impl<'a, 'b> Links<'a, 'b> {
    fn new(split: &'b CornerSplit<'a>, context: &Context, mut place: Vec<u32>) -> Result<Self> {
        number_quads(split, context, &mut place)?;
        let mut base = split.vertex_faces;
        let irregular = split.irregular.iter().map(|&(v, size)| {
            base += size;
            (v, base - size)
        });
        let irregular = irregular.collect();
        let parent = split.parent;
        let long = |v: &u32| parent.fan(*v).nth(SHORT_FAN as usize).is_some();
        let mut hubs: Vec<(u32, u32)> = Vec::new();
        for v in parent.special.iter().copied().filter(long) {
            hubs.extend(parent.fan(v).zip(0..));
        }
        hubs.sort_unstable();
        Ok(Self { split, place, irregular, hubs })
    }

    /// The first corner of the child quad with a number.
    #[inline(always)]
    fn quad(&self, number: u32) -> u32 {
        self.split.quads + 4 * number
    }

    /// The child of a corner in the child of its face.
    #[inline(always)]
    fn in_face(&self, corner: u32) -> u32 {
        let first = self.split.vertex_faces;
        if corner < first {
            return corner;
        }
        let side = (corner - first) & 3;
        // The face's child stands right before those of its first corner.
        self.quad(self.place[(corner - side) as usize] - 1) + side
    }

    /// The first corner of the quad of an edge, given the corner that leads it.
    #[inline(always)]
    fn edge_quad(&self, leader: u32, starts: bool) -> u32 {
        self.quad(self.place[leader as usize] + u32::from(starts))
    }

    /// The inner corner of a corner in the quad of its edge.
    fn inner(&self, corner: u32) -> u32 {
        let twin = self.split.parent.twin[corner as usize];
        if twin < corner {
            self.edge_quad(twin, self.split.starts_quad(twin)) + 2
        } else {
            self.edge_quad(corner, self.split.starts_quad(corner))
        }
    }

    /// The outer corner of a corner in the quad of its edge.
    fn outer(&self, corner: u32) -> u32 {
        self.inner(corner) + 1
    }

    /// The first corner of the face of a vertex, or [`NONE`].
    fn vertex_face(&self, vertex: u32) -> u32 {
        let start = self.split.parent.start[vertex as usize];
        if start != NONE && self.split.has_quad(vertex) {
            return self.quad(self.place[start as usize]);
        }
        let listed = self.irregular.binary_search_by_key(&vertex, |&(v, _)| v);
        listed.map_or(NONE, |i| self.irregular[i].1)
    }

    /// The corner of a corner in the face of its vertex, or [`NONE`].
    fn in_vertex_face(&self, corner: u32) -> u32 {
        let v = self.split.parent.vert[corner as usize];
        match self.vertex_face(v) {
            NONE => NONE,
            base => base + self.fan_place(corner) + u32::from(self.is_framed(v)),
        }
    }

    fn is_framed(&self, vertex: u32) -> bool {
        self.split.lays_anchor() && self.split.parent.on_rim(vertex)
    }

    /// The place of a corner in its fan, by steps back to the start.
    fn fan_place(&self, corner: u32) -> u32 {
        let parent = self.split.parent;
        let start = parent.start[parent.vert[corner as usize] as usize];
        let mut at = corner;
        for place in 0..SHORT_FAN {
            if at == start {
                return place;
            }
            at = parent.cw(at);
        }
        let hub = self.hubs.binary_search_by_key(&corner, |&(c, _)| c);
        self.hubs[hub.expect("long fans are listed")].1
    }

    /// Writes the twins of all child corners and the fan starts of all children.
    fn write(&self, context: &Context, twins: &mut [u32], starts: &mut [u32]) -> Result<()> {
        let split = self.split;
        let first = split.vertex_faces;
        let (irregular, quads) = twins.split_at_mut(split.quads as usize);
        let (faces, mut vertex_faces) = irregular.split_at_mut(first as usize);
        for (slot, corner) in faces.iter_mut().zip(0..) {
            *slot = self.across_face(corner);
        }
        for &(v, size) in &split.irregular {
            let (face, rest) = vertex_faces.split_at_mut(size as usize);
            self.write_fan_twins(v, face);
            vertex_faces = rest;
        }
        let (mut starts, added) = starts.split_at_mut(split.parent.corners());
        let mut quads = quads.as_chunks_mut::<4>().0;
        let mut parts = Vec::with_capacity(split.chunks.len());
        for chunk in &split.chunks {
            let (out, later) = quads.split_at_mut(chunk.quads.len());
            let (start, rest) = starts.split_at_mut(chunk.corners.len());
            parts.push((chunk.corners.clone(), out, start));
            (quads, starts) = (later, rest);
        }
        context.for_each(parts, |(corners, out, starts)| {
            let mut out = Quads { out, place: 0 };
            if corners.start < first {
                for (c, start) in corners.zip(starts) {
                    *start = self.write_corner_twins(c, &mut out);
                }
                return;
            }
            let walker = QuadWalker::new(split.parent);
            for (c, starts) in corners.step_by(4).zip(starts.as_chunks_mut::<4>().0) {
                if !self.write_regular_twins(walker, c, &mut out, starts) {
                    out.push(std::array::from_fn(|i| self.across_face(c + i as u32)), true);
                    *starts =
                        std::array::from_fn(|i| self.write_corner_twins(c + i as u32, &mut out));
                }
            }
        })?;
        for (slot, vertex) in added.iter_mut().zip(split.added_vertices()) {
            *slot = self.added_start(vertex);
        }
        Ok(())
    }

    /// The twins of all children of a regular quad, and the fan starts of its
    /// corners; false if it is no regular quad.
    #[inline(always)]
    fn write_regular_twins(
        &self,
        walker: QuadWalker,
        corner: u32,
        out: &mut Quads,
        starts: &mut [u32; 4],
    ) -> bool {
        let Some(ring) = walker.ring(corner) else { return false };
        let start = walker.vertices(corner).map(|v| self.split.parent.start[v as usize]);
        let own = |i: usize| corner + i as u32;
        // The inner corner of each edge; its quad stands with the leader.
        let inner: [u32; 4] = std::array::from_fn(|i| {
            let twin = ring.across[i];
            if twin < own(i) {
                // The twin starts at the next vertex.
                self.edge_quad(twin, start[(i + 1) % 4] == twin) + 2
            } else {
                self.edge_quad(own(i), start[i] == own(i))
            }
        });
        // The corner of each corner in the face of its vertex, and the one before.
        let vertex: [[u32; 2]; 4] = std::array::from_fn(|i| {
            let around = ring.across[(i + 3) % 4];
            let place = if own(i) == start[i] {
                0
            } else if around == start[i] {
                3
            } else if walker.turn(ring.across[i], 1) == start[i] {
                1
            } else {
                2
            };
            let base = self.quad(self.place[start[i] as usize]);
            [base + place, base + (place + 3) % 4]
        });
        let face = self.quad(self.place[corner as usize] - 1);
        out.push(inner, true);
        for i in 0..4 {
            let (c, twin, before) = (own(i), ring.across[i], inner[(i + 3) % 4]);
            if start[i] == c {
                // The outer corners of the three other edges around the vertex:
                // those of the edge before belong to its other side.
                let beyond = self.outer_of(walker, ring.beyond[i]);
                let clockwise = self.outer_of(walker, walker.turn(twin, 1));
                out.push([(before ^ 2) + 1, beyond, clockwise, inner[i] + 1], true);
            }
            if c < twin {
                let across = self.in_face(twin);
                out.push([face + i as u32, vertex[i][1], across, vertex[(i + 1) % 4][0]], true);
            }
            starts[i] = (face + i as u32).min(before).min(vertex[i][0]).min(inner[i] + 1);
        }
        true
    }

    /// The outer corner of a corner at a vertex that is interior of valence 4.
    #[inline(always)]
    fn outer_of(&self, walker: QuadWalker, corner: u32) -> u32 {
        let parent = self.split.parent;
        let twin = parent.twin[corner as usize];
        let (leader, side) = if twin < corner { (twin, 3) } else { (corner, 1) };
        let start = parent.start[walker.mesh.vert[leader as usize] as usize];
        let starts = start == leader && self.split.has_quad(parent.vert[leader as usize]);
        self.edge_quad(leader, starts) + side
    }

    /// The twins of the quads near any corner; returns the fan start of its child.
    #[cold]
    #[inline(never)]
    fn write_corner_twins(&self, corner: u32, out: &mut Quads) -> u32 {
        let parent = self.split.parent;
        let v = parent.vert[corner as usize];
        if self.split.starts_quad(corner) {
            let mut quad = [0; 4];
            self.write_fan_twins(v, &mut quad);
            out.push(quad, true);
        }
        if self.split.leads_quad(corner) {
            out.push(self.edge_twins(corner), true);
        }
        self.child_start(corner)
    }

    /// The twin of a corner in the child of its face.
    fn across_face(&self, corner: u32) -> u32 {
        let open = self.split.parent.twin[corner as usize] == NONE && !self.split.lays_anchor();
        if open { NONE } else { self.inner(corner) }
    }

    /// The twins of the quad of the edge that a corner leads.
    fn edge_twins(&self, corner: u32) -> [u32; 4] {
        let parent = self.split.parent;
        let (own, next) = (self.in_face(corner), parent.next(corner));
        match parent.twin[corner as usize] {
            NONE => {
                let vertex_face = self.vertex_face(parent.vert[corner as usize]);
                [own, vertex_face, NONE, self.in_vertex_face(next)]
            }
            twin => [
                own,
                self.across_outer(parent.next(twin)),
                self.in_face(twin),
                self.across_outer(next),
            ],
        }
    }

    /// The twin of an outer corner, given the next corner around its vertex,
    /// clockwise.
    fn across_outer(&self, clockwise: u32) -> u32 {
        let parent = self.split.parent;
        let twin = self.in_vertex_face(clockwise);
        if twin == NONE && !parent.on_rim(parent.vert[clockwise as usize]) {
            // Valence 2: the quads of the two edges meet.
            return self.outer(clockwise);
        }
        twin
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
        out[faces] = self.inner(incoming) + 3;
    }

    /// The start of the fan of a corner's child: its smallest corner, or the one
    /// that leaves along the boundary.
    fn child_start(&self, corner: u32) -> u32 {
        let parent = self.split.parent;
        let own = self.in_face(corner);
        if parent.on_rim(parent.vert[corner as usize]) && !self.split.lays_anchor() {
            let open = parent.twin[corner as usize] == NONE;
            return if open { own } else { self.outer(corner) };
        }
        let before = self.inner(parent.prev(corner));
        own.min(before).min(self.in_vertex_face(corner)).min(self.outer(corner))
    }

    /// The start of the fan of a child that is no corner of the parent.
    fn added_start(&self, vertex: u32) -> u32 {
        let parent = self.split.parent;
        match self.split.child(vertex) {
            Child::Corner(_) | Child::Isolated(_) => NONE,
            Child::Beta { corner, at_end: false } => self.inner(corner) + 2,
            Child::Beta { corner, at_end: true } => {
                self.rim_corner(parent.vert[parent.next(corner) as usize])
            }
            Child::Kappa(v) => self.rim_corner(v) + 1,
        }
    }

    /// The corner of the incoming β in the face of a framed vertex.
    fn rim_corner(&self, vertex: u32) -> u32 {
        let faces = self.split.parent.fan(vertex).count() as u32;
        self.vertex_face(vertex) + faces + 1
    }

    /// The child corners on the boundary, ascending.
    fn rim(&self) -> Vec<u32> {
        let parent = self.split.parent;
        let mut rim = Vec::with_capacity(self.split.counts.boundary_edges as usize);
        for &c in &parent.rim {
            let v = parent.vert[c as usize];
            if self.split.lays_anchor() {
                rim.push(self.inner(c) + 2);
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

/// Counts the child quads before each corner's own.
fn number_quads(split: &CornerSplit, context: &Context, place: &mut [u32]) -> Result<()> {
    let mut parts = Vec::with_capacity(split.chunks.len());
    let mut rest = place;
    for chunk in &split.chunks {
        let (part, later) = rest.split_at_mut(chunk.corners.len());
        parts.push((chunk, part));
        rest = later;
    }
    context.for_each(parts, |(chunk, part)| {
        let mut number = chunk.quads.start;
        let first = split.vertex_faces;
        for (c, slot) in chunk.corners.clone().zip(part) {
            number += u32::from(c >= first && (c - first).is_multiple_of(4));
            *slot = number;
            number += u32::from(split.starts_quad(c)) + u32::from(split.leads_quad(c));
        }
    })
}
