//! The values of one dual step: rows applied where they are needed, kernels elsewhere.

use super::kernel::{
    QuadWeights, Value, corner_grid, grid_children, narrow, quad_corners, star, touches_rim,
    vertex_grid, widen,
};
use super::regular_rule::RegularRule;
use super::step::{Scratch, Sum, accumulate};
use crate::base::{Context, Result, Scalar, memory};
use crate::mesh::QuadWalker;
use crate::refine::CornerSplit;
use crate::scheme::{DualRows, RowSink, Scheme, Taps};

/// One dual step of a scheme on one mesh, ready to be applied to values.
pub(super) struct DualStep<'a> {
    split: &'a CornerSplit<'a>,
    scheme: &'a Scheme,
    quads: QuadWalker<'a>,
    /// Quads on the boundary are completed by mirror images.
    mirrors: bool,
}

impl<'a> DualStep<'a> {
    pub(super) fn new(scheme: &'a Scheme, split: &'a CornerSplit<'a>) -> Self {
        let parent = split.parent();
        let mirrors = scheme.anchors() && !split.lays_anchor() && !parent.is_closed();
        Self { split, scheme, quads: QuadWalker::new(parent), mirrors }
    }

    /// The values of all child vertices.
    ///
    /// `values` has one entry per parent vertex, `out` one per child vertex.
    pub(super) fn apply<T: Scalar, const W: usize>(
        &self,
        context: &Context,
        values: &[Value<T, W>],
        out: &mut [Value<T, W>],
        scratch: &mut Scratch<T, W>,
    ) -> Result<()> {
        let passes = self.scheme.passes().len();
        if passes == 0 {
            return self.split_values(context, values, out);
        }
        let first_quad = self.split.parent().layout.first_quad_corner() as usize;
        memory::resize(&mut scratch.irregular, first_quad)?;
        context.fill(&mut scratch.irregular, 1, |start, part| {
            let mut rows = DualRows::new(self.scheme, self.split);
            let mut sum = Sum::new(values);
            for (v, slot) in (start as u32..).zip(part) {
                *slot = sum.of(|sink| rows.split_row(v, sink));
            }
        })?;
        if passes == 1 {
            return self.fused(context, values, &scratch.irregular, out);
        }
        memory::resize(&mut scratch.stage, out.len())?;
        // Stages alternate between the two arrays so that the last is `out`.
        let (mut from, mut to) = if passes.is_multiple_of(2) {
            (&mut *scratch.stage, out)
        } else {
            (out, &mut *scratch.stage)
        };
        self.fused(context, values, &scratch.irregular, from)?;
        for pass in 1..passes {
            self.smooth(context, pass, from, to)?;
            std::mem::swap(&mut from, &mut to);
        }
        Ok(())
    }

    /// The split alone.
    fn split_values<T: Scalar, const W: usize>(
        &self,
        context: &Context,
        values: &[Value<T, W>],
        out: &mut [Value<T, W>],
    ) -> Result<()> {
        let weights = QuadWeights::new(self.scheme);
        let quad = |corner: u32| {
            let corners = self.quads.vertices(corner).map(|v| &values[v as usize]);
            (!self.mirrors || !touches_rim(self.quads, corner))
                .then(|| quad_corners(weights, corners))
        };
        self.every_child(
            context,
            out,
            || (DualRows::new(self.scheme, self.split), Sum::new(values)),
            quad,
            |(rows, sum), v| sum.of(|sink| rows.split_row(v, sink)),
        )
    }

    /// The split and the first pass in one go: by the regular rule at all regular vertices, so
    /// that it does not matter what their quads are like elsewhere.
    fn fused<T: Scalar, const W: usize>(
        &self,
        context: &Context,
        values: &[Value<T, W>],
        irregular: &[Value<T, W>],
        out: &mut [Value<T, W>],
    ) -> Result<()> {
        let rule = rule(self.scheme.fused_taps());
        self.every_child(
            context,
            out,
            || (DualRows::new(self.scheme, self.split), SplitSum::new(self, values, irregular)),
            |corner| {
                let grid = vertex_grid(self.quads, corner, self.mirrors)?;
                Some(grid_children(rule, &grid, values))
            },
            |(rows, sum), v| match star(self.quads, v, self.mirrors) {
                Some(star) => {
                    let around = star.map(|row| row.map(|v| widen(&values[v as usize])));
                    narrow::<T, W>(rule.around_vertex(around)[0])
                }
                None => tuned(rows, &mut sum.points, v)
                    .unwrap_or_else(|| sum.of(|sink| rows.pass_row(0, v, sink))),
            },
        )
    }

    /// A further pass on the split mesh.
    fn smooth<T: Scalar, const W: usize>(
        &self,
        context: &Context,
        pass: usize,
        values: &[Value<T, W>],
        out: &mut [Value<T, W>],
    ) -> Result<()> {
        let rule = rule(self.scheme.pass_taps(pass));
        self.every_child(
            context,
            out,
            || (DualRows::new(self.scheme, self.split), Sum::new(values)),
            |corner| corner_grid(self.quads, corner).map(|grid| grid_children(rule, &grid, values)),
            |(rows, sum), v| sum.of(|sink| rows.pass_row(pass, v, sink)),
        )
    }

    /// Fills all children: four at a time where `quad` can, by `row` elsewhere.
    fn every_child<T: Scalar, const W: usize, R>(
        &self,
        context: &Context,
        out: &mut [Value<T, W>],
        state: impl Fn() -> R + Sync + Send,
        quad: impl Fn(u32) -> Option<[Value<T, W>; 4]> + Sync + Send,
        row: impl Fn(&mut R, u32) -> Value<T, W> + Sync + Send,
    ) -> Result<()> {
        let layout = &self.split.parent().layout;
        let (first, corners) = (layout.first_quad_corner(), layout.corners());
        let (irregular, rest) = out.split_at_mut(first as usize);
        let (quads, added) = rest.split_at_mut((corners - first) as usize);
        let by_row = |first: u32, part: &mut [Value<T, W>]| {
            let mut state = state();
            for (v, slot) in (first..).zip(part) {
                *slot = row(&mut state, v);
            }
        };
        context.fill(irregular, 1, |start, part| by_row(start as u32, part))?;
        context.fill(quads, 4, |start, part| {
            let mut lazy = None;
            let (faces, _) = part.as_chunks_mut::<4>();
            for (face, children) in (start as u32..).zip(faces) {
                let corner = first + 4 * face;
                *children = quad(corner).unwrap_or_else(|| {
                    let state = lazy.get_or_insert_with(&state);
                    std::array::from_fn(|i| row(state, corner + i as u32))
                });
            }
        })?;
        context.fill(added, 1, |start, part| by_row(corners + start as u32, part))
    }
}

/// The value of a child vertex that has a row of its own.
fn tuned<T: Scalar, const W: usize>(
    rows: &mut DualRows<f64>,
    sum: &mut Sum<T, W>,
    vertex: u32,
) -> Option<Value<T, W>> {
    let mut sent = false;
    let value = sum.of(|sink| sent = rows.tuned_row(vertex, sink));
    sent.then_some(value)
}

/// The rule of a pass that exists, in the working precision.
fn rule<T: Scalar>(taps: Option<Taps<f64>>) -> RegularRule<T> {
    RegularRule::new(taps.expect("the pass exists"))
}

/// A row on split points, which are computed when asked for: those of quads
/// cost four terms, those of irregular faces are stored.
struct SplitSum<'v, T, const W: usize> {
    quads: QuadWalker<'v>,
    mirrors: bool,
    weights: QuadWeights<T>,
    irregular: &'v [Value<T, W>],
    rows: DualRows<'v, f64>,
    points: Sum<'v, T, W>,
    total: Value<T, W>,
}

impl<'v, T: Scalar, const W: usize> SplitSum<'v, T, W> {
    fn new(step: &DualStep<'v>, values: &'v [Value<T, W>], irregular: &'v [Value<T, W>]) -> Self {
        Self {
            quads: step.quads,
            mirrors: step.mirrors,
            weights: QuadWeights::new(step.scheme),
            irregular,
            rows: DualRows::new(step.scheme, step.split),
            points: Sum::new(values),
            total: [T::default(); W],
        }
    }

    fn of(&mut self, emit: impl FnOnce(&mut Self)) -> Value<T, W> {
        self.total = [T::default(); W];
        emit(self);
        self.total
    }

    /// The split point of a child vertex.
    fn split_point(&mut self, vertex: u32) -> Value<T, W> {
        if let Some(stored) = self.irregular.get(vertex as usize) {
            return *stored;
        }
        let face = self.quads.face_start(vertex);
        if vertex < self.quads.mesh.layout.corners()
            && !(self.mirrors && touches_rim(self.quads, face))
        {
            let corners = self.quads.vertices(face).map(|v| &self.points.values[v as usize]);
            return quad_corners(self.weights, corners)[(vertex - face) as usize];
        }
        let rows = &mut self.rows;
        self.points.of(|sink| rows.split_row(vertex, sink))
    }
}

impl<T: Scalar, const W: usize> RowSink<f64> for SplitSum<'_, T, W> {
    fn add(&mut self, vertex: u32, weight: f64) {
        let point = self.split_point(vertex);
        accumulate(&mut self.total, T::from_f64(weight), &point);
    }
}
