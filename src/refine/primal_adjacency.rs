//! The mesh that a quad or triangle split leaves: every twin by arithmetic.

use super::adjacency::{Recycled, sized};
use super::creasing::{Creasing, vertices_left};
use super::primal_split::{Pieces, PrimalSplit};
use crate::base::{Context, NONE, Result, memory};
use crate::mesh::{Joints, Layout, Mesh, Sharpness, VertexSet, turn_in_quad};

impl PrimalSplit<'_> {
    /// The split mesh. `holes` are faces of the parent whose children are holes.
    pub(crate) fn mesh(
        &self,
        context: &Context,
        creasing: Creasing,
        holes: &[u32],
        recycled: &mut Recycled,
    ) -> Result<Mesh> {
        let corners = self.counts.corners as usize;
        let mut vert = sized(&mut recycled.vert, corners)?;
        self.write_faces(context, &mut vert)?;
        let mut twin = sized(&mut recycled.twin, corners)?;
        self.write_twins(context, &mut twin)?;
        let mut start = sized(&mut recycled.start, self.counts.vertices as usize)?;
        self.write_starts(context, &mut start)?;
        let special = self.special()?;
        let side = match self.pieces {
            Pieces::Quads => 4,
            Pieces::Triangles => 3,
        };
        Ok(Mesh {
            layout: Layout::new(std::iter::empty(), side, self.counts.faces as u32)?,
            vert,
            twin,
            rim: self.halves(self.parent.rim.iter().copied())?,
            special_set: VertexSet::new(start.len(), &special)?,
            special,
            start,
            near: None,
            sharpness: Sharpness {
                edges: self.sharp_edges(creasing)?,
                vertices: vertices_left(&self.parent.sharpness.vertices)?,
            },
            joints: self.joints()?,
            holes: self.children_of(holes)?,
            runs: self.runs()?,
            corner_tags: memory::copied(&self.parent.corner_tags)?,
            anchored: false,
            refined: false,
            face_source: None,
        })
    }

    fn write_twins(&self, context: &Context, out: &mut [u32]) -> Result<()> {
        let layout = &self.parent.layout;
        match self.pieces {
            Pieces::Quads if layout.side() == 4 && layout.irregular_corners() == 0 => {
                self.write_twins_of_quads(context, out)
            }
            Pieces::Quads => context.fill(out, 4, |start, part| {
                for (c, out) in (start as u32..).zip(part.as_chunks_mut::<4>().0) {
                    let before = layout.prev(c);
                    let inside = [4 * layout.next(c) + 2, 4 * before + 1];
                    *out = [self.across_start(c), inside[0], inside[1], self.across_end(before)];
                }
            }),
            Pieces::Triangles => context.fill(out, 12, |start, part| {
                for (face, out) in (start as u32..).zip(part.as_chunks_mut::<12>().0) {
                    let (old, new) = (3 * face, 12 * face);
                    for i in 0..3 {
                        let c = old + i;
                        let at = 3 * i as usize;
                        out[at] = self.across_start(c);
                        out[at + 1] = new + 9 + i;
                        out[at + 2] = self.across_end(old + (i + 2) % 3);
                        out[9 + i as usize] = new + 3 * i + 1;
                    }
                }
            }),
        }
    }

    /// The same for a parent of quads only, face by face.
    fn write_twins_of_quads(&self, context: &Context, out: &mut [u32]) -> Result<()> {
        let parents = self.parent.twin.as_chunks::<4>().0;
        let or_none = |twin: u32, child: u32| if twin == NONE { NONE } else { child };
        context.fill(out, 16, |face, part| {
            let faces = (4 * face as u32..).step_by(4).zip(&parents[face..]);
            for ((c, twins), out) in faces.zip(part.as_chunks_mut::<16>().0) {
                // Without a twin the product is thrown away: it may wrap.
                let fours = |corner: u32| corner.wrapping_mul(4);
                let near = twins.map(|t| or_none(t, fours(turn_in_quad(0, t, 1)) | 3));
                let far = twins.map(|t| or_none(t, fours(t)));
                for i in 0..4 {
                    let (next, before) = ((i + 1) % 4, (i + 3) % 4);
                    out[4 * i] = near[i];
                    out[4 * i + 1] = 4 * (c + next as u32) + 2;
                    out[4 * i + 2] = 4 * (c + before as u32) + 1;
                    out[4 * i + 3] = far[before];
                }
            }
        })
    }

    /// The fan of an old vertex starts where it did, that of an edge's vertex where
    /// the first corner's edge leads on, that of a face's at its first corner.
    fn write_starts(&self, context: &Context, out: &mut [u32]) -> Result<()> {
        let parent = self.parent;
        let (old, rest) = out.split_at_mut(parent.vertices());
        let (edges, faces) = rest.split_at_mut(self.edges.count() as usize);
        context.fill(old, 1, |start, part| {
            for (slot, &corner) in part.iter_mut().zip(&parent.start[start..]) {
                *slot = if corner == NONE { NONE } else { self.start_half(corner) };
            }
        })?;
        context.fill(edges, 1, |start, part| {
            for (slot, &c) in part.iter_mut().zip(&self.edges.first[start..]) {
                *slot = self.end_half(c);
            }
        })?;
        context.fill(faces, 1, |start, part| {
            for (slot, face) in part.iter_mut().zip(start as u32..) {
                *slot = 4 * parent.layout.face(face).start + 2;
            }
        })
    }

    /// The children that are not interior vertices of valence 4.
    fn special(&self) -> Result<Vec<u32>> {
        let parent = self.parent;
        let mut special = memory::copied(&parent.special)?;
        let edges = self.first_edge_vertex()..self.first_face_vertex();
        if self.pieces == Pieces::Triangles {
            memory::extend(&mut special, edges)?;
            return Ok(special);
        }
        let on_rim = parent.rim.iter().map(|&c| self.edge_vertex(c));
        memory::extend(&mut special, on_rim)?;
        special.sort_unstable();
        special.dedup();
        let layout = &parent.layout;
        let odd = if layout.side() == 4 { layout.irregular_faces() } else { layout.faces() };
        memory::extend(&mut special, (0..odd).map(|f| self.face_vertex(f)))?;
        Ok(special)
    }

    /// The old vertices keep their runs; those on edges and in faces follow the faces.
    fn runs(&self) -> Result<Vec<u32>> {
        let added = [self.first_edge_vertex(), self.first_face_vertex()];
        memory::collect(self.parent.runs.iter().copied().chain(added))
    }

    /// Both halves of the outgoing edges of some corners, ascending.
    fn halves(&self, corners: impl Iterator<Item = u32>) -> Result<Vec<u32>> {
        let mut halves =
            memory::collect(corners.flat_map(|c| [self.start_half(c), self.end_half(c)]))?;
        halves.sort_unstable();
        Ok(halves)
    }

    /// The sharp edges of the children: both halves of each, as sharp as the creasing
    /// method leaves them at either end.
    fn sharp_edges(&self, creasing: Creasing) -> Result<Vec<(u32, f32)>> {
        let mut sharp = Vec::new();
        for &(c, sharpness) in &self.parent.sharpness.edges {
            let halves = [
                (self.start_half(c).min(self.across_start(c)), c),
                (self.end_half(c).min(self.across_end(c)), self.parent.next(c)),
            ];
            for (half, end) in halves {
                let vertex = self.parent.vert[end as usize];
                let left = creasing.edge(sharpness, self.arounds.at(vertex));
                memory::extend(&mut sharp, (left > 0.0).then_some((half, left)))?;
            }
        }
        sharp.sort_unstable_by_key(|&(c, _)| c);
        Ok(sharp)
    }

    /// The sides of one edge make two groups of halves; the vertex in the middle has
    /// as many fans as there were sides.
    fn joints(&self) -> Result<Joints> {
        let parent = self.parent;
        let mut groups = Vec::new();
        for &(c, leader) in &parent.joints.sides {
            let along = parent.vert[c as usize] == parent.vert[leader as usize];
            let halves = [(self.start_half(c), along), (self.end_half(c), !along)];
            memory::extend(&mut groups, halves.map(|(half, first)| ((leader, first), half)))?;
        }
        groups.sort_unstable();
        let groups = groups.chunk_by(|a, b| a.0 == b.0);
        let groups = groups.map(|group| memory::collect(group.iter().map(|&(_, half)| half)));
        let groups = memory::collect(groups)?.into_iter().collect::<Result<Vec<_>>>()?;
        let others = parent.joints.sides.iter().filter(|(c, leader)| c != leader);
        let on_edges = others.map(|&(c, _)| (self.edge_vertex(c), self.end_half(c)));
        let old = parent.joints.fans.iter().map(|&(v, c)| (v, self.start_half(c)));
        let mut fans = memory::collect(old.chain(on_edges))?;
        fans.sort_unstable();
        Ok(Joints { sides: Joints::of_groups(groups.iter().map(Vec::as_slice))?, fans })
    }

    /// The children of some faces, ascending as they are.
    fn children_of(&self, faces: &[u32]) -> Result<Vec<u32>> {
        let children = |&face: &u32| match self.pieces {
            Pieces::Quads => self.parent.layout.face(face),
            Pieces::Triangles => 4 * face..4 * face + 4,
        };
        memory::collect(faces.iter().flat_map(children))
    }
}
