//! The rows of the primal schemes: Catmull–Clark, Loop and linear refinement.
//!
//! A row may speak of the new vertices in faces, which come first and have rows of their
//! own; who wants control vertices only takes [`PrimalRows::split_row`].

use super::crease_rules::{Rule, Surroundings};
use super::{Boundary, Method, RowSink, Scheme, SmoothMasks};
use crate::base::{NONE, Weight};
use crate::mesh::Mesh;
use crate::mesh::sharpness::INFINITE;
use crate::refine::{Pieces, PrimalChild, PrimalSplit};

/// Receives a row on old vertices and on the new vertices of faces.
pub(crate) trait PointSink<W> {
    /// Adds `weight` times an old vertex.
    fn vertex(&mut self, vertex: u32, weight: W);
    /// Adds `weight` times the new vertex of a face.
    fn face(&mut self, face: u32, weight: W);
}

/// The rows of one primal step on one mesh, in a number type of choice.
///
/// Scratch memory is inside: one per thread.
#[derive(Debug)]
pub(crate) struct PrimalRows<'a, W> {
    pub(super) split: &'a PrimalSplit<'a>,
    pub(super) scheme: &'a Scheme,
    masks: SmoothMasks<W>,
    around: Surroundings,
    /// What stands at each corner: its vertex, or its value in a face-varying channel.
    pub(super) names: &'a [u32],
}

impl<'a, W: Weight> PrimalRows<'a, W> {
    /// The scheme's rows.
    pub(crate) fn new(scheme: &'a Scheme, split: &'a PrimalSplit<'a>) -> Self {
        Self::with_masks(scheme, split, SmoothMasks::new(scheme))
    }

    /// Rows with other smooth rules than the scheme's own.
    pub(crate) fn with_masks(
        scheme: &'a Scheme,
        split: &'a PrimalSplit<'a>,
        masks: SmoothMasks<W>,
    ) -> Self {
        let around = Surroundings::default();
        let names = &split.parent().vert[..];
        Self { split, scheme, masks, around, names }
    }

    /// The same rows on the values at the corners, where these match the vertices.
    pub(crate) fn with_names(mut self, names: &'a [u32]) -> Self {
        self.names = names;
        self
    }

    /// The row of a child vertex on the parent's vertices.
    pub(crate) fn split_row(&mut self, vertex: u32, sink: &mut impl RowSink<W>) {
        let parent = self.split.parent();
        let mut expanded = Expanded { parent, sink };
        match self.split.child(vertex) {
            PrimalChild::Vertex(v) => self.vertex_row(v, &mut expanded),
            PrimalChild::Edge(edge) => {
                self.edge_row(self.split.edges.first[edge as usize], &mut expanded);
            }
            PrimalChild::Face(face) => expanded.face(face, W::ratio(1, 1)),
        }
    }

    /// The row of the new vertex on the edge whose first corner is given.
    pub(crate) fn edge_row(&self, corner: u32, sink: &mut impl PointSink<W>) {
        let parent = self.split.parent();
        let sharpness =
            if self.scheme.creases() { parent.edge_sharpness(corner) } else { INFINITE };
        let ends = [corner, parent.next(corner)];
        if self.masks.is_linear()
            || parent.twin[corner as usize] == NONE
            || (sharpness > 0.0 && self.stays_sharp(sharpness, ends))
        {
            return self.midpoint_row(corner, sink);
        }
        let half = W::ratio(1, 2);
        let mask = self.masks.edge(self.triangles_beside(corner));
        // As in OpenSubdiv the sharpness itself is the weight of the midpoint, beyond 1
        // as well where Chaikin creasing ends a sharper edge.
        let crease = W::from_sharpness(sharpness);
        let smooth = W::ratio(1, 1) - crease.clone();
        for v in ends.map(|c| self.names[c as usize]) {
            sink.vertex(v, crease.clone() * half.clone() + smooth.clone() * mask.end.clone());
        }
        for side in [corner, parent.twin[corner as usize]] {
            let weight = smooth.clone() * mask.beside.clone();
            match self.split.pieces() {
                Pieces::Quads => sink.face(parent.layout.face_of(side), weight),
                Pieces::Triangles => sink.vertex(self.names[parent.prev(side) as usize], weight),
            }
        }
    }

    /// The row of the middle of a corner's edge.
    pub(crate) fn midpoint_row(&self, corner: u32, sink: &mut impl PointSink<W>) {
        for c in [corner, self.split.parent().next(corner)] {
            sink.vertex(self.names[c as usize], W::ratio(1, 2));
        }
    }

    /// True if both halves of an edge, given by corners at its ends, are still sharp.
    fn stays_sharp(&self, sharpness: f32, ends: [u32; 2]) -> bool {
        let (parent, creasing) = (self.split.parent(), self.scheme.creasing());
        let around = |c: u32| self.split.arounds.at(parent.vert[c as usize]);
        ends.iter().all(|&c| creasing.edge(sharpness, around(c)) > 0.0)
    }

    fn triangles_beside(&self, corner: u32) -> usize {
        if !self.masks.minds_triangles() {
            return 0;
        }
        let layout = &self.split.parent().layout;
        let sides = [corner, self.split.parent().twin[corner as usize]];
        sides.iter().filter(|&&c| layout.face(layout.face_of(c)).len() == 3).count()
    }

    /// The row of an old vertex.
    pub(crate) fn vertex_row(&mut self, vertex: u32, sink: &mut impl PointSink<W>) {
        let parent = self.split.parent();
        let one = || W::ratio(1, 1);
        let start = parent.start[vertex as usize];
        if start == NONE {
            return sink.vertex(vertex, one());
        }
        let own = self.names[start as usize];
        if self.masks.is_linear() {
            return sink.vertex(own, one());
        }
        let sharpness = self.vertex_sharpness(vertex);
        let mut around = std::mem::take(&mut self.around);
        around.look(parent, vertex, sharpness, self.scheme.creasing());
        let (before, after) = (around.rule(), around.rule_left());
        if before == after || before.is_smooth() {
            self.ruled_row(before, (vertex, own), &around, false, &one(), sink);
        } else {
            let weight = W::from_sharpness(around.weight());
            self.ruled_row(before, (vertex, own), &around, false, &weight, sink);
            self.ruled_row(after, (vertex, own), &around, true, &(one() - weight), sink);
        }
        self.around = around;
    }

    /// The sharpness of a vertex with what the boundary mode adds.
    fn vertex_sharpness(&self, vertex: u32) -> f32 {
        self.scheme.vertex_sharpness(self.split.parent(), vertex)
    }

    /// A rule's row times a factor; `left` asks for the edges that stay sharp.
    fn ruled_row(
        &mut self,
        rule: Rule,
        (vertex, own): (u32, u32),
        around: &Surroundings,
        left: bool,
        factor: &W,
        sink: &mut impl PointSink<W>,
    ) {
        match rule {
            Rule::Corner => sink.vertex(own, factor.clone()),
            Rule::Crease => {
                sink.vertex(own, factor.clone() * W::ratio(3, 4));
                for spoke in &around.spokes {
                    let sharpness = if left { spoke.left } else { spoke.sharpness };
                    if sharpness > 0.0 {
                        sink.vertex(
                            self.names[spoke.far as usize],
                            factor.clone() * W::ratio(1, 8),
                        );
                    }
                }
            }
            Rule::Smooth | Rule::Dart => self.smooth_row((vertex, own), factor, sink),
        }
    }

    fn smooth_row(&mut self, (vertex, own): (u32, u32), factor: &W, sink: &mut impl PointSink<W>) {
        let parent = self.split.parent();
        let mask = self.masks.vertex(parent.fan(vertex).count());
        sink.vertex(own, factor.clone() * mask.own);
        for corner in parent.fan(vertex) {
            let near = self.names[parent.next(corner) as usize];
            sink.vertex(near, factor.clone() * mask.near.clone());
            if self.split.pieces() == Pieces::Quads {
                sink.face(parent.layout.face_of(corner), factor.clone() * mask.face.clone());
            }
        }
    }
}

impl Scheme {
    /// The sharpness of a vertex with what the boundary mode adds.
    pub(crate) fn vertex_sharpness(&self, mesh: &Mesh, vertex: u32) -> f32 {
        let single = self.boundary() == Boundary::EdgeAndCorner
            && mesh.on_rim(vertex)
            && mesh.fans(vertex).nth(1).is_none();
        if single || mesh.corner_tags.binary_search(&vertex).is_ok() {
            INFINITE
        } else {
            mesh.sharpness.vertex(vertex)
        }
    }

    /// The vertices of a mesh that may not follow the smooth rule, unsorted.
    pub(crate) fn ruled_vertices<'m>(&self, mesh: &'m Mesh) -> impl Iterator<Item = u32> + 'm {
        let heeds = self.method() != Method::Primal;
        let sharp = mesh.sharpness.edges.iter().map(|&(c, _)| c);
        let edges = mesh.rim.iter().copied().chain(sharp.filter(move |_| heeds));
        let ends = edges.flat_map(|c| [c, mesh.next(c)]).map(|c| mesh.vert[c as usize]);
        let vertices = mesh.sharpness.vertices.iter().map(|&(v, _)| v);
        let several = mesh.joints.fans.iter().map(|&(v, _)| v);
        ends.chain(vertices).chain(several)
    }
}

/// Writes the new vertices of faces out as means.
struct Expanded<'a, S> {
    parent: &'a Mesh,
    sink: &'a mut S,
}

impl<W: Weight, S: RowSink<W>> PointSink<W> for Expanded<'_, S> {
    fn vertex(&mut self, vertex: u32, weight: W) {
        self.sink.add(vertex, weight);
    }

    fn face(&mut self, face: u32, weight: W) {
        let corners = self.parent.layout.face(face);
        let share = weight * W::ratio(1, corners.len() as i64);
        for corner in corners {
            self.sink.add(self.parent.vert[corner as usize], share.clone());
        }
    }
}
