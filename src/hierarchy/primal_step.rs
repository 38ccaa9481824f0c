//! The values of one primal step: new vertices of faces, then of edges, then old ones.
//!
//! The bulk follows smooth rules and goes through kernels that do not look at creases or
//! boundaries; what those change is a short list and is written again by rows.

use super::kernel::Value;
use super::primal_kernel::{EdgeKernel, VertexKernel, face_values};
use super::step::{Interpolation, Scratch, Sum, accumulate};
use crate::base::{Context, Result, Scalar, memory};
use crate::mesh::VertexSet;
use crate::refine::PrimalSplit;
use crate::scheme::{PointSink, PrimalRows, Scheme, SmoothMasks};

/// One primal step of a scheme on one mesh, ready to be applied to values.
pub(super) struct PrimalStep<'a> {
    split: &'a PrimalSplit<'a>,
    scheme: &'a Scheme,
    masks: SmoothMasks<f64>,
    /// First corners of the edges that may not follow the smooth rule.
    ruled_edges: Vec<u32>,
    /// The old vertices that may not, as a set and as an ascending list.
    ruled: VertexSet,
    ruled_vertices: Vec<u32>,
    passes: usize,
}

impl<'a> PrimalStep<'a> {
    pub(super) fn new(
        scheme: &'a Scheme,
        split: &'a PrimalSplit<'a>,
        interpolation: Interpolation,
    ) -> Result<Self> {
        let parent = split.parent();
        let varying = interpolation == Interpolation::Varying;
        let masks = if varying { SmoothMasks::linear() } else { SmoothMasks::new(scheme) };
        let (mut ruled_vertices, mut ruled_edges) = (Vec::new(), Vec::new());
        if !masks.is_linear() {
            memory::extend(&mut ruled_vertices, scheme.ruled_vertices(parent))?;
            ruled_vertices.sort_unstable();
            ruled_vertices.dedup();
            let on_rim = parent.rim.iter().copied().filter(|&c| parent.is_first_of_edge(c));
            memory::extend(&mut ruled_edges, on_rim)?;
            memory::extend(&mut ruled_edges, parent.sharpness.edges.iter().map(|&(c, _)| c))?;
        }
        let ruled = VertexSet::new(parent.vertices(), &ruled_vertices)?;
        let passes = if varying { 0 } else { scheme.passes().len() };
        Ok(Self { split, scheme, masks, ruled_edges, ruled, ruled_vertices, passes })
    }

    /// The values of all child vertices.
    pub(super) fn apply<T: Scalar, const W: usize>(
        &self,
        context: &Context,
        values: &[Value<T, W>],
        out: &mut [Value<T, W>],
        scratch: &mut Scratch<T, W>,
    ) -> Result<()> {
        if self.passes == 0 {
            return self.split_values(context, values, out);
        }
        memory::resize(&mut scratch.stage, out.len())?;
        // Stages alternate between the two arrays so that the last is `out`.
        let (mut from, mut to) = if self.passes.is_multiple_of(2) {
            (out, &mut scratch.stage[..])
        } else {
            (&mut scratch.stage[..], out)
        };
        self.split_values(context, values, from)?;
        let first_corners = self.split.first_corners()?;
        for pass in 0..self.passes {
            let values = &*from;
            context.fill(to, 1, |start, part| {
                let mut rows = self.rows().with_first_corners(&first_corners);
                let mut sum = Sum::new(values);
                for (v, slot) in (start as u32..).zip(part) {
                    *slot = sum.of(|sink| rows.pass_row(pass, v, sink));
                }
            })?;
            std::mem::swap(&mut from, &mut to);
        }
        Ok(())
    }

    fn rows(&self) -> PrimalRows<'_, f64> {
        PrimalRows::by_element(self.scheme, self.split, self.masks.clone())
    }

    /// The split alone.
    fn split_values<T: Scalar, const W: usize>(
        &self,
        context: &Context,
        values: &[Value<T, W>],
        out: &mut [Value<T, W>],
    ) -> Result<()> {
        let (old, rest) = out.split_at_mut(values.len());
        let (edges, faces) = rest.split_at_mut(self.split.edges.count() as usize);
        context
            .fill(faces, 1, |first, part| face_values(self.split, values, first as u32, part))?;
        let faces = &*faces;
        self.edge_values(context, values, faces, edges)?;
        if self.masks.is_linear() {
            old.copy_from_slice(values);
            return Ok(());
        }
        let kernel = VertexKernel::new(self.split, values, faces);
        context.fill(old, 1, |start, part| {
            let mut masks = self.masks.clone();
            for (v, slot) in (start as u32..).zip(part) {
                if !self.ruled.contains(v) {
                    *slot = kernel.value(v, &mut masks);
                }
            }
        })?;
        let (mut rows, mut sum) = (self.rows(), Points::new(values, faces));
        for &v in &self.ruled_vertices {
            old[v as usize] = sum.of(|sink| rows.vertex_row(v, sink));
        }
        Ok(())
    }

    fn edge_values<T: Scalar, const W: usize>(
        &self,
        context: &Context,
        values: &[Value<T, W>],
        faces: &[Value<T, W>],
        out: &mut [Value<T, W>],
    ) -> Result<()> {
        let kernel = EdgeKernel::new(self.split, &self.masks, values, faces);
        let chunks = &self.split.edges.chunks;
        let mut parts = memory::reserved(chunks.len())?;
        let mut rest = &mut *out;
        for chunk in chunks {
            let (part, later) = rest.split_at_mut(chunk.edges.len());
            parts.push((chunk.corners.clone(), part));
            rest = later;
        }
        context.for_each(parts, |(corners, part)| {
            if !kernel.run(corners.clone(), part) {
                let (rows, mut sum) = (self.rows(), Points::new(values, faces));
                let first = |&c: &u32| self.split.parent().is_first_of_edge(c);
                for (slot, c) in part.iter_mut().zip(corners.filter(first)) {
                    *slot = sum.of(|sink| rows.edge_row(c, sink));
                }
            }
        })?;
        let (rows, mut sum) = (self.rows(), Points::new(values, faces));
        for &c in &self.ruled_edges {
            let edge = self.split.edges.of_corner[c as usize];
            out[edge as usize] = sum.of(|sink| rows.edge_row(c, sink));
        }
        Ok(())
    }
}

/// A row on old vertices and new vertices of faces, applied to stored values.
struct Points<'v, T, const W: usize> {
    values: &'v [Value<T, W>],
    faces: &'v [Value<T, W>],
    total: Value<T, W>,
}

impl<'v, T: Scalar, const W: usize> Points<'v, T, W> {
    fn new(values: &'v [Value<T, W>], faces: &'v [Value<T, W>]) -> Self {
        Self { values, faces, total: [T::default(); W] }
    }

    fn of(&mut self, emit: impl FnOnce(&mut Self)) -> Value<T, W> {
        self.total = [T::default(); W];
        emit(self);
        self.total
    }
}

impl<T: Scalar, const W: usize> PointSink<f64> for Points<'_, T, W> {
    fn vertex(&mut self, vertex: u32, weight: f64) {
        accumulate(&mut self.total, T::from_f64(weight), &self.values[vertex as usize]);
    }

    fn face(&mut self, face: u32, weight: f64) {
        accumulate(&mut self.total, T::from_f64(weight), &self.faces[face as usize]);
    }
}
