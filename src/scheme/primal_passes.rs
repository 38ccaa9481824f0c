//! The smoothing passes of the averaging family after a quad split.
//!
//! All faces around a child vertex are quads, and which they are follows from the parent;
//! on the boundary the univariate filter takes the neighbours as they are.

use super::{CornerWeights, PrimalRows, RowSink};
use crate::base::{Fraction, NONE, Weight};
use crate::refine::PrimalChild;

impl<W: Weight> PrimalRows<'_, W> {
    /// The row of a child vertex in a pass, on the child vertices.
    pub(crate) fn pass_row(&mut self, pass: usize, vertex: u32, sink: &mut impl RowSink<W>) {
        let parent = self.split.parent();
        match self.split.child(vertex) {
            PrimalChild::Vertex(v) => {
                let start = parent.start[v as usize];
                if start == NONE {
                    sink.add(vertex, W::ratio(1, 1));
                } else if parent.twin[start as usize] == NONE {
                    self.boundary_vertex(pass, v, sink);
                } else {
                    let share = W::ratio(1, parent.fan(v).count() as i64);
                    for corner in parent.fan(v) {
                        self.quad(pass, corner, 0, &share, sink);
                    }
                }
            }
            PrimalChild::Edge(edge) => {
                let corner = self.split.edges.first[edge as usize];
                match parent.twin[corner as usize] {
                    NONE => {
                        let ends = [corner, parent.next(corner)].map(|c| parent.vert[c as usize]);
                        self.filter(pass, vertex, ends, sink);
                    }
                    twin => {
                        let share = W::ratio(1, 4);
                        for side in [corner, twin] {
                            self.quad(pass, side, 1, &share, sink);
                            self.quad(pass, parent.next(side), 3, &share, sink);
                        }
                    }
                }
            }
            PrimalChild::Face(face) => {
                let corners = parent.layout.face(face);
                let share = W::ratio(1, corners.len() as i64);
                for corner in corners {
                    self.quad(pass, corner, 2, &share, sink);
                }
            }
        }
    }

    /// C_t of the quad at a corner of the parent, seen from one of its places.
    fn quad(&self, pass: usize, corner: u32, place: usize, share: &W, sink: &mut impl RowSink<W>) {
        let (split, parent) = (self.split, self.split.parent());
        let quad = [
            parent.vert[corner as usize],
            split.edge_vertex(corner),
            split.face_vertex(parent.layout.face_of(corner)),
            split.edge_vertex(parent.prev(corner)),
        ];
        let mut weights = CornerWeights::<W>::new(self.scheme.rule(), self.scheme.passes()[pass]);
        for (i, weight) in weights.of(quad.len()).iter().enumerate() {
            sink.add(quad[(place + i) % quad.len()], share.clone() * weight.clone());
        }
    }

    /// A vertex of a single face stays.
    fn boundary_vertex(&self, pass: usize, vertex: u32, sink: &mut impl RowSink<W>) {
        let parent = self.split.parent();
        let start = parent.start[vertex as usize];
        let last = parent.fan(vertex).last().unwrap_or(start);
        if last == start {
            return sink.add(vertex, W::ratio(1, 1));
        }
        let neighbours = [start, parent.prev(last)].map(|c| self.split.edge_vertex(c));
        self.filter(pass, vertex, neighbours, sink);
    }

    /// (a/2, 1−a, a/2) with a = (1−t)/2.
    fn filter(&self, pass: usize, vertex: u32, beside: [u32; 2], sink: &mut impl RowSink<W>) {
        let t: Fraction = self.scheme.passes()[pass];
        let spread = W::ratio(1, 2) * (W::ratio(1, 1) - W::from_fraction(t));
        sink.add(vertex, W::ratio(1, 1) - spread.clone());
        for neighbour in beside {
            sink.add(neighbour, W::ratio(1, 2) * spread.clone());
        }
    }
}
