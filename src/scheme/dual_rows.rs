//! The rows of the dual averaging family: split rows and pass rows.

use super::mirror::cycle_row;
use super::{Boundary, CornerWeights, RowSink, Scheme, TunedWeights};
use crate::base::{Fraction, NONE, Weight};
use crate::refine::{BoundaryNeighbours, Child, CornerSplit, Cycle, IsolatedFace, Neighbourhood};

/// The rows of one dual step on one mesh, in a number type of choice.
///
/// Scratch memory is inside: one per thread.
#[derive(Debug)]
pub(crate) struct DualRows<'a, W> {
    split: &'a CornerSplit<'a>,
    /// The split mesh is anchored: faces are seen with their mirror images.
    anchored: bool,
    corner: CornerWeights<W>,
    passes: Vec<Pass<W>>,
    /// What some vertices have instead of all that.
    tuned: Option<TunedWeights<W>>,
    cycle: Cycle,
}

/// One smoothing pass.
#[derive(Debug)]
struct Pass<W> {
    corner: CornerWeights<W>,
    /// a = (1−t)/2.
    spread: W,
}

impl<'a, W: Weight> DualRows<'a, W> {
    pub(crate) fn new(scheme: &Scheme, split: &'a CornerSplit<'a>) -> Self {
        let rule = scheme.rule();
        let pass = |&t: &Fraction| Pass {
            corner: CornerWeights::new(rule, t),
            spread: W::ratio(1, 2) * (W::ratio(1, 1) - W::from_fraction(t)),
        };
        Self {
            split,
            anchored: scheme.boundary() != Boundary::None,
            corner: CornerWeights::new(rule, Fraction::HALF),
            passes: scheme.passes().iter().map(pass).collect(),
            tuned: scheme.tunes(split.parent()).then(TunedWeights::new),
            cycle: Cycle::new(),
        }
    }

    /// The row of a child vertex that the tuned rule is for, on the parent's vertices: instead
    /// of split and pass. False, and nothing sent, for all others.
    pub(crate) fn tuned_row(&mut self, vertex: u32, sink: &mut impl RowSink<W>) -> bool {
        let mirrored = self.mirrors_faces();
        let (Some(tuned), Child::Corner(corner)) = (&mut self.tuned, self.split.child(vertex))
        else {
            return false;
        };
        let Some(around) = IsolatedFace::around(self.split.parent(), corner, mirrored) else {
            return false;
        };
        let Some(rows) = tuned.of(around.sides()) else { return false };
        let vertices = around.vertices(self.split.parent());
        for (v, weight) in vertices.zip(&rows[around.child]) {
            sink.add(v, weight.clone());
        }
        true
    }

    /// The row of a child vertex after the split, on the parent's vertices.
    pub(crate) fn split_row(&mut self, vertex: u32, sink: &mut impl RowSink<W>) {
        let parent = self.split.parent();
        let vert = |corner: u32| parent.corner_vertices()[corner as usize];
        match self.split.child(vertex) {
            Child::Corner(c) => self.corner_row(c, sink),
            Child::Kappa(v) | Child::Isolated(v) => sink.add(v, W::ratio(1, 1)),
            Child::Beta { corner, at_end } => {
                let (start, end) = (vert(corner), vert(parent.next(corner)));
                let (near, far) = if at_end { (end, start) } else { (start, end) };
                sink.add(near, W::ratio(3, 4));
                sink.add(far, W::ratio(1, 4));
            }
        }
    }

    fn corner_row(&mut self, corner: u32, sink: &mut impl RowSink<W>) {
        let parent = self.split.parent();
        let vert = |corner: u32| parent.corner_vertices()[corner as usize];
        let own = vert(corner);
        if self.mirrors_faces() && parent.on_rim(own) {
            // The anchor row is refined along itself only.
            return self.rim_row(corner, sink);
        }
        let mut cycle = std::mem::replace(&mut self.cycle, Cycle::new());
        self.split.parent_face(corner, self.mirrors_faces(), &mut cycle);
        cycle_row(&cycle, &mut self.corner, &W::ratio(1, 1), sink);
        self.cycle = cycle;
    }

    /// True if the parent is anchored and open, so that its boundary faces are
    /// completed by mirror images.
    fn mirrors_faces(&self) -> bool {
        self.anchored && !self.split.lays_anchor() && !self.split.parent().is_closed()
    }

    /// The split row of a corner at a boundary vertex of an anchored mesh.
    fn rim_row(&self, corner: u32, sink: &mut impl RowSink<W>) {
        let parent = self.split.parent();
        let vert = |corner: u32| parent.corner_vertices()[corner as usize];
        if self.split.is_corner_of_rim(corner) {
            return sink.add(vert(corner), W::ratio(1, 1));
        }
        let outgoing = parent.corner_twins()[corner as usize] == NONE;
        let other = if outgoing { parent.next(corner) } else { parent.prev(corner) };
        let far = if self.split.is_corner_of_rim(other) { (1, 2) } else { (1, 4) };
        sink.add(vert(corner), W::ratio(1, 1) - W::ratio(far.0, far.1));
        sink.add(vert(other), W::ratio(far.0, far.1));
    }

    /// The row of a child vertex in a pass, on the child vertices.
    pub(crate) fn pass_row(&mut self, pass: usize, vertex: u32, sink: &mut impl RowSink<W>) {
        match self.split.neighbourhood(vertex, self.anchored) {
            Neighbourhood::Fixed => sink.add(vertex, W::ratio(1, 1)),
            Neighbourhood::Boundary(along) => self.boundary_row(pass, vertex, along, sink),
            Neighbourhood::Interior(corner) => {
                let share = W::ratio(1, self.split.faces_around(corner));
                let weights = &mut self.passes[pass].corner;
                self.split.each_face(corner, self.anchored, &mut self.cycle, |cycle| {
                    cycle_row(cycle, weights, &share, sink);
                });
            }
        }
    }

    /// The univariate filter along the boundary, with the odd extension
    /// 2p − x beyond a corner p of an anchored boundary.
    fn boundary_row(
        &self,
        pass: usize,
        vertex: u32,
        along: BoundaryNeighbours,
        sink: &mut impl RowSink<W>,
    ) {
        let spread = &self.passes[pass].spread;
        let half = W::ratio(1, 2) * spread.clone();
        let mut own = W::ratio(1, 1) - spread.clone();
        for (neighbour, is_corner) in along.vertices.into_iter().zip(along.are_corners) {
            if is_corner && self.anchored {
                own = own - half.clone();
                sink.add(neighbour, spread.clone());
            } else {
                sink.add(neighbour, half.clone());
            }
        }
        sink.add(vertex, own);
    }
}
