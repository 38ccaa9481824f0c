//! The split mesh with its adjacency: every child's twin by arithmetic.
//!
//! Needed for every level but the last. Gather only: each output is written
//! once, by whoever owns its place, from the parent's arrays.

use super::corner_split::{Child, CornerSplit};
use crate::base::{Context, NONE, Result, memory};
use crate::mesh::near::{LEADS, LEADS_ALL, LEADS_NONE, LEADS_OUTER, STARTS};
use crate::mesh::{Joints, Mesh, Near, QuadWalker, Sharpness, VertexSet};
use bytemuck::Zeroable;

/// Steps around a vertex that are cheaper than a search in the list of hubs.
const SHORT_FAN: u32 = 16;

/// Arrays of a level that are used again in the next call.
#[derive(Debug, Default)]
pub(crate) struct Recycled {
    pub(super) vert: Vec<u32>,
    pub(super) twin: Vec<u32>,
    pub(super) start: Vec<u32>,
    place: Vec<u32>,
    near: Vec<u8>,
}

impl Recycled {
    /// Takes a mesh apart, keeping its memory.
    pub(crate) fn absorb(&mut self, mesh: Mesh) {
        self.vert = mesh.vert;
        self.twin = mesh.twin;
        self.start = mesh.start;
        if let Some(near) = mesh.near {
            self.near = near.quads;
        }
    }

    /// Bytes held.
    pub(crate) fn bytes(&self) -> u64 {
        let lists = [&self.vert, &self.twin, &self.start, &self.place];
        let words: usize = lists.iter().map(|list| list.capacity()).sum();
        (4 * words + self.near.capacity()) as u64
    }
}

/// An array of exactly `len` entries in re-used memory; entries keep whatever
/// they held, since every one of them is about to be written.
pub(super) fn sized<T: Copy + Zeroable>(list: &mut Vec<T>, len: usize) -> Result<Vec<T>> {
    let mut list = std::mem::take(list);
    memory::resize(&mut list, len)?;
    Ok(list)
}

impl CornerSplit<'_> {
    /// The split mesh.
    pub(crate) fn mesh(
        &self,
        context: &Context,
        anchored: bool,
        recycled: &mut Recycled,
    ) -> Result<Mesh> {
        let corners = self.counts.corners as usize;
        let quads = (self.counts.faces - self.counts.irregular_faces) as usize;
        let mut vert = sized(&mut recycled.vert, corners)?;
        self.write_faces(context, &mut vert)?;
        let places = self.near.irregular.len() + self.near.quads.len();
        let links = Links::new(self, context, sized(&mut recycled.place, places)?)?;
        let mut child = Mesh {
            layout: self.child_layout()?,
            vert,
            twin: sized(&mut recycled.twin, corners)?,
            start: sized(&mut recycled.start, self.counts.vertices as usize)?,
            rim: Vec::new(),
            special: self.special()?,
            special_set: VertexSet::default(),
            near: None,
            sharpness: Sharpness::default(),
            joints: Joints::default(),
            holes: Vec::new(),
            runs: Vec::new(),
            corner_tags: Vec::new(),
            anchored,
            refined: true,
            face_source: None,
        };
        child.special_set = VertexSet::new(child.start.len(), &child.special)?;
        let mut near = Near {
            irregular: memory::zeroed(self.quads as usize)?,
            quads: sized(&mut recycled.near, quads)?,
        };
        links.write(context, &mut child, &mut near)?;
        child.near = Some(near);
        child.rim = links.rim()?;
        recycled.place = links.place;
        Ok(child)
    }

    /// The children that are not interior vertices of valence 4.
    fn special(&self) -> Result<Vec<u32>> {
        let parent = self.parent;
        let mut special = Vec::new();
        for &v in &parent.special {
            let keeps_rim = parent.on_rim(v) && !self.lays_anchor();
            if keeps_rim || (!parent.on_rim(v) && parent.fan(v).take(3).count() == 2) {
                memory::extend(&mut special, parent.fan(v))?;
            }
        }
        special.sort_unstable();
        memory::extend(&mut special, self.added_vertices())?;
        Ok(special)
    }
}

/// Where the children of a corner are.
struct Links<'a, 'b> {
    split: &'b CornerSplit<'a>,
    /// How many child quads precede those of each irregular corner, then how
    /// many precede each quad's.
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
        let irregular = memory::collect(irregular)?;
        let parent = split.parent;
        let long = |v: &u32| parent.fan(*v).nth(SHORT_FAN as usize).is_some();
        let mut hubs: Vec<(u32, u32)> = Vec::new();
        for v in parent.special.iter().copied().filter(long) {
            memory::extend(&mut hubs, parent.fan(v).zip(0..))?;
        }
        hubs.sort_unstable();
        Ok(Self { split, place, irregular, hubs })
    }

    /// The first corner of the child quad with a number.
    #[inline(always)]
    fn quad(&self, number: u32) -> u32 {
        self.split.quads + 4 * number
    }

    /// How many child quads precede those of a quad, given its number.
    #[inline(always)]
    fn before(&self, quad: u32) -> u32 {
        self.place[(self.split.vertex_faces + quad) as usize]
    }

    /// The child of a corner in the child of its face.
    #[inline(always)]
    fn in_face(&self, corner: u32) -> u32 {
        match corner.checked_sub(self.split.vertex_faces) {
            None => corner,
            Some(local) => self.quad(self.before(local / 4)) + (local & 3),
        }
    }

    /// The first corner of the quad of an edge, given the corner that leads it.
    #[inline(always)]
    fn edge_quad(&self, leader: u32) -> u32 {
        let near = &self.split.near;
        let Some(local) = leader.checked_sub(self.split.vertex_faces) else {
            let starts = near.irregular[leader as usize] & STARTS != 0;
            return self.quad(self.place[leader as usize] + u32::from(starts));
        };
        let bits = near.quads[local as usize / 4];
        let below = bits & ((LEADS << (local & 3)) - LEADS);
        self.quad(self.before(local / 4) + 1 + count(bits >> 4) + count(below))
    }

    /// The first corner of the quad of a vertex, given the start of its fan.
    #[inline(always)]
    fn vertex_quad(&self, start: u32) -> u32 {
        let Some(local) = start.checked_sub(self.split.vertex_faces) else {
            return self.quad(self.place[start as usize]);
        };
        let bits = self.split.near.quads[local as usize / 4];
        let below = (bits >> 4) & ((1 << (local & 3)) - 1);
        self.quad(self.before(local / 4) + 1 + count(below))
    }

    /// The inner corner of a corner in the quad of its edge.
    #[inline(always)]
    fn inner(&self, corner: u32) -> u32 {
        if self.split.near.corner(self.split.vertex_faces, corner) & LEADS != 0 {
            self.edge_quad(corner)
        } else {
            self.edge_quad(self.split.parent.twin[corner as usize]) + 2
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
            return self.vertex_quad(start);
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

    /// Writes twins, fan starts and near bits of the child.
    fn write(&self, context: &Context, child: &mut Mesh, near: &mut Near) -> Result<()> {
        let split = self.split;
        let first = split.vertex_faces;
        self.write_irregular(child, near);
        let mut twins = child.twin[split.quads as usize..].as_chunks_mut::<4>().0;
        let mut near = &mut near.quads[..];
        let (mut starts, added) = child.start.split_at_mut(split.parent.corners());
        let special = &child.special_set;
        let mut parts = Vec::with_capacity(split.chunks.len());
        for chunk in &split.chunks {
            let (twin, more_twins) = twins.split_at_mut(chunk.quads.len());
            let (bits, more_near) = near.split_at_mut(chunk.quads.len());
            let (start, more_starts) = starts.split_at_mut(chunk.corners.len());
            parts.push((chunk.corners.clone(), Part { twins: twin, near: bits, place: 0 }, start));
            (twins, near, starts) = (more_twins, more_near, more_starts);
        }
        context.for_each(parts, |(corners, mut out, starts)| {
            if corners.end <= first {
                for (c, start) in corners.zip(starts) {
                    *start = self.child_start(c);
                    self.push_vertex(c, &mut out);
                    self.push_edge(c, &mut out);
                }
                return;
            }
            let walker = QuadWalker::new(split.parent);
            let near = &split.near.quads[(corners.start - first) as usize / 4..];
            let quads = near.iter().zip(starts.as_chunks_mut::<4>().0);
            for (c, (&near, starts)) in corners.step_by(4).zip(quads) {
                if !self.write_regular(walker, c, near, &mut out, starts) {
                    self.write_quad(c, special, &mut out, starts);
                }
            }
        })?;
        for (slot, vertex) in added.iter_mut().zip(split.added_vertices()) {
            *slot = self.added_start(vertex);
        }
        Ok(())
    }

    /// The children that are no quads.
    fn write_irregular(&self, child: &mut Mesh, near: &mut Near) {
        let first = self.split.vertex_faces;
        for c in 0..first {
            child.twin[c as usize] = self.across_face(c);
            near.irregular[c as usize] = self.face_bits(c, &child.special_set);
        }
        let mut out = &mut child.twin[first as usize..];
        for &(v, size) in &self.split.irregular {
            let (face, rest) = out.split_at_mut(size as usize);
            self.write_fan_twins(v, face);
            out = rest;
        }
    }

    /// The near bits of a corner in the child of its face: it leads the edge if
    /// that is interior, and its child's fan starts there.
    fn face_bits(&self, corner: u32, special: &VertexSet) -> u8 {
        let leads = self.across_face(corner) != NONE;
        (u8::from(leads) * LEADS) | (u8::from(!special.contains(corner)) * STARTS)
    }

    /// All children near any quad, corner by corner.
    #[cold]
    #[inline(never)]
    fn write_quad(&self, corner: u32, special: &VertexSet, out: &mut Part, starts: &mut [u32; 4]) {
        let own: [u32; 4] = std::array::from_fn(|i| corner + i as u32);
        let bits = own.map(|c| self.face_bits(c, special));
        let bits = (0..4).fold(0, |sum, i| sum | (bits[i] << i));
        out.push(own.map(|c| self.across_face(c)), bits);
        for c in own {
            self.push_vertex(c, out);
        }
        for c in own {
            self.push_edge(c, out);
        }
        *starts = own.map(|c| self.child_start(c));
    }

    /// All children near a regular quad; false if it is none.
    #[inline(always)]
    fn write_regular(
        &self,
        walker: QuadWalker,
        corner: u32,
        near: u8,
        out: &mut Part,
        starts: &mut [u32; 4],
    ) -> bool {
        let Some(ring) = walker.ring(corner) else { return false };
        let start = walker.vertices(corner).map(|v| self.split.parent.start[v as usize]);
        let own = |i: usize| corner + i as u32;
        let leads = |i: usize| near & (LEADS << i) != 0;
        let face = self.quad(self.before((corner - self.split.vertex_faces) / 4));
        // The first quads of the vertices and of the edges here.
        let (vertices, edges) = (face + 4, face + 4 + 4 * count(near >> 4));
        let below = |bits: u8, i: usize| 4 * count(bits & ((1 << i) - 1));
        let inner: [u32; 4] = std::array::from_fn(|i| {
            if leads(i) { edges + below(near & 15, i) } else { self.edge_quad(ring.across[i]) + 2 }
        });
        out.push(inner, LEADS_ALL);
        // The first corner of the face of each vertex, and the corner's place.
        let base: [u32; 4] = std::array::from_fn(|i| {
            if start[i] == own(i) {
                vertices + below(near >> 4, i)
            } else {
                self.vertex_quad(start[i])
            }
        });
        let place = |i: usize| {
            if start[i] == own(i) {
                0
            } else if start[i] == ring.across[(i + 3) % 4] {
                3
            } else {
                2 - u32::from(start[i] == walker.turn(ring.across[i], 1))
            }
        };
        for i in (0..4).filter(|&i| near & (STARTS << i) != 0) {
            // The outer corners of the edges around the vertex; the twin of the
            // corner before has the other half of its quad.
            let before = (i + 3) % 4;
            let around = if leads(before) { inner[before] + 3 } else { inner[before] - 1 };
            let beyond = self.inner(ring.beyond[i]) + 1;
            let clockwise = self.inner(walker.turn(ring.across[i], 1)) + 1;
            out.push([around, beyond, clockwise, inner[i] + 1], LEADS_NONE);
        }
        for i in (0..4).filter(|&i| leads(i)) {
            let next = (i + 1) % 4;
            let before = base[i] + (place(i) + 3) % 4;
            let across = self.in_face(ring.across[i]);
            let twins = [face + i as u32, before, across, base[next] + place(next)];
            out.push(twins, LEADS_OUTER);
        }
        *starts = std::array::from_fn(|i| face + i as u32);
        true
    }

    /// The quad of the vertex whose fan starts at a corner, if it does.
    fn push_vertex(&self, corner: u32, out: &mut Part) {
        if self.split.starts_quad(corner) {
            let mut twins = [0; 4];
            self.write_fan_twins(self.split.parent.vert[corner as usize], &mut twins);
            out.push(twins, LEADS_NONE);
        }
    }

    /// The quad of the edge that a corner leads, if it does.
    fn push_edge(&self, corner: u32, out: &mut Part) {
        if !self.split.leads_quad(corner) {
            return;
        }
        let (own, twins) = (self.edge_quad(corner), self.edge_twins(corner));
        // The outer corners lead to the vertex faces. At a vertex of valence 2
        // two of them meet and the smaller one leads.
        let leads = |i: u32| {
            let twin = twins[i as usize];
            twin != NONE && (own + i < twin || !self.is_outer(corner, i, twin))
        };
        let bits = (u8::from(leads(1)) << 1) | (u8::from(leads(3)) << 3);
        out.push(twins, bits);
    }

    /// True if the twin of an edge quad's corner 1 or 3 is an outer corner too:
    /// the vertex is interior of valence 2.
    fn is_outer(&self, corner: u32, side: u32, twin: u32) -> bool {
        let parent = self.split.parent;
        let at = if side == 1 { corner } else { parent.next(corner) };
        let v = parent.vert[at as usize];
        twin != NONE && self.vertex_face(v) == NONE && !parent.on_rim(v)
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

    /// The start of the fan of a corner's child: in the child of the face, or
    /// where the boundary begins.
    fn child_start(&self, corner: u32) -> u32 {
        let parent = self.split.parent;
        let own = self.in_face(corner);
        if parent.on_rim(parent.vert[corner as usize]) && !self.split.lays_anchor() {
            let open = parent.twin[corner as usize] == NONE;
            return if open { own } else { self.outer(corner) };
        }
        own
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
    fn rim(&self) -> Result<Vec<u32>> {
        let parent = self.split.parent;
        let mut rim = memory::reserved(self.split.counts.boundary_edges as usize)?;
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
        Ok(rim)
    }
}

/// Twins and near bits being written one quad after the other.
struct Part<'o> {
    twins: &'o mut [[u32; 4]],
    near: &'o mut [u8],
    place: usize,
}

impl Part<'_> {
    #[inline(always)]
    fn push(&mut self, twins: [u32; 4], near: u8) {
        if let (Some(slot), Some(bits)) =
            (self.twins.get_mut(self.place), self.near.get_mut(self.place))
        {
            (*slot, *bits) = (twins, near);
            self.place += 1;
        }
    }
}

/// The number of bits of four.
#[inline(always)]
fn count(bits: u8) -> u32 {
    const COUNTS: u64 = 0x4332_3221_3221_2110;
    ((COUNTS >> (4 * u32::from(bits & 15))) & 15) as u32
}

/// Counts the child quads before each irregular corner's own and each quad's.
fn number_quads(split: &CornerSplit, context: &Context, place: &mut [u32]) -> Result<()> {
    let first = split.vertex_faces;
    let (irregular, quads) = place.split_at_mut(first as usize);
    let mut number = 0;
    for (slot, bits) in irregular.iter_mut().zip(&split.near.irregular) {
        *slot = number;
        number += bits.count_ones();
    }
    let mut parts = Vec::with_capacity(split.chunks.len());
    let mut rest = quads;
    for chunk in split.chunks.iter().filter(|chunk| chunk.corners.start >= first) {
        let (part, later) = rest.split_at_mut(chunk.corners.len() / 4);
        parts.push((chunk, part));
        rest = later;
    }
    context.for_each(parts, |(chunk, part)| {
        let mut number = chunk.quads.start;
        let near = &split.near.quads[(chunk.corners.start - first) as usize / 4..];
        for (slot, bits) in part.iter_mut().zip(near) {
            *slot = number;
            number += 1 + count(bits & 15) + count(bits >> 4);
        }
    })
}
