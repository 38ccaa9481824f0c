//! The values of one primal step: new vertices of faces, then of edges, then old ones.
//!
//! The bulk follows smooth rules and goes through kernels that do not look at creases or
//! boundaries; what those change is a short list and is written again by rows.

use super::kernel::Value;
use super::primal_kernel::{EdgeKernel, VertexKernel, face_values};
use super::step::{Interpolation, Scratch, Sum, accumulate};
use crate::base::{Context, NONE, Result, Scalar, memory};
use crate::mesh::{Mesh, VertexSet};
use crate::refine::PrimalSplit;
use crate::scheme::{ChannelLevel, ChannelRules, SplitValue};
use crate::scheme::{PointSink, PrimalRows, Scheme, SmoothMasks};

/// Vertices of a tile: with their faces they stay in a second-level cache.
const TILE: usize = 4096;

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
    /// For face-varying values: `split` is then that of their channel.
    channel: Option<ChannelStep<'a>>,
}

/// What a step of face-varying values needs beside the split of their channel.
struct ChannelStep<'a> {
    /// The split of the mesh itself, whose rules hold away from seams.
    shape: &'a PrimalSplit<'a>,
    rules: ChannelRules<'a>,
    /// The split values before the step, and in the same order their rules after it.
    split: &'a [SplitValue],
    left: &'a [SplitValue],
    /// Values and their places in these lists, by value.
    places: Vec<(u32, u32)>,
}

impl ChannelStep<'_> {
    /// The row of a value with a rule of its own.
    fn value_row(
        &self,
        channel: &Mesh,
        value: u32,
        rows: &mut PrimalRows<f64>,
        sink: &mut impl PointSink<f64>,
    ) {
        let mesh = self.shape.parent();
        let Ok(at) = self.places.binary_search_by_key(&value, |&(value, _)| value) else {
            let start = channel.start[value as usize];
            return rows.vertex_row(mesh.vert[start as usize], sink);
        };
        let at = self.places[at].1 as usize;
        let vertex = self.split[at].0;
        let first = self.split.partition_point(|value| value.0 < vertex);
        let end = self.split.partition_point(|value| value.0 <= vertex);
        let value = (self.split[at], self.left[at].2);
        self.rules.row(mesh, channel, value, &self.split[first..end], sink);
    }
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
        Ok(Self { split, scheme, masks, ruled_edges, ruled, ruled_vertices, passes, channel: None })
    }

    /// The step of face-varying values: `split` is that of their channel at `level`,
    /// `shape` that of the mesh, `left` the rules after the step.
    pub(super) fn channel(
        rules: ChannelRules<'a>,
        shape: &'a PrimalSplit<'a>,
        level: &'a ChannelLevel,
        split: &'a PrimalSplit<'a>,
        left: &'a [SplitValue],
    ) -> Result<Self> {
        let (scheme, mesh, channel) = (rules.scheme(), shape.parent(), split.parent());
        let mut places = memory::collect(level.split.iter().zip(0..).map(|(v, at)| (v.1, at)))?;
        places.sort_unstable();
        let linear = rules.is_linear();
        let masks = if linear { SmoothMasks::linear() } else { SmoothMasks::new(scheme) };
        let (mut ruled_vertices, mut ruled_edges) = (Vec::new(), Vec::new());
        if !linear {
            let values = |v: u32| mesh.fans(v).map(|c| channel.vert[c as usize]);
            memory::extend(&mut ruled_vertices, scheme.ruled_vertices(mesh).flat_map(values))?;
            memory::extend(&mut ruled_vertices, level.split.iter().map(|value| value.1))?;
            ruled_vertices.sort_unstable();
            ruled_vertices.dedup();
            let on_rim = channel.rim.iter().copied().filter(|&c| channel.is_first_of_edge(c));
            memory::extend(&mut ruled_edges, on_rim)?;
            memory::extend(&mut ruled_edges, mesh.sharpness.edges.iter().map(|&(c, _)| c))?;
        }
        let ruled = VertexSet::new(channel.vertices(), &ruled_vertices)?;
        let channel = Some(ChannelStep { shape, rules, split: &level.split, left, places });
        Ok(Self { split, scheme, masks, ruled_edges, ruled, ruled_vertices, passes: 0, channel })
    }

    /// The number of child vertices.
    pub(super) fn children(&self) -> usize {
        self.split.counts.vertices as usize
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
        for pass in 0..self.passes {
            let values = &*from;
            context.fill(to, 1, |start, part| {
                let mut rows = self.rows();
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
        let shape = self.channel.as_ref().map_or(self.split, |channel| channel.shape);
        let rows = PrimalRows::with_masks(self.scheme, shape, self.masks.clone());
        rows.with_names(&self.split.parent().vert)
    }

    /// The row of an old vertex that may not follow the smooth rule.
    fn vertex_row(&self, vertex: u32, rows: &mut PrimalRows<f64>, sink: &mut impl PointSink<f64>) {
        match &self.channel {
            None => rows.vertex_row(vertex, sink),
            Some(channel) => channel.value_row(self.split.parent(), vertex, rows, sink),
        }
    }

    /// The row of the new vertex on the edge whose first corner is given.
    fn edge_row(&self, corner: u32, rows: &PrimalRows<f64>, sink: &mut impl PointSink<f64>) {
        // Along a seam both sides are refined by themselves.
        if self.channel.is_some() && self.split.parent().twin[corner as usize] == NONE {
            rows.midpoint_row(corner, sink);
        } else {
            rows.edge_row(corner, sink);
        }
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
        let tiles = tiles(context, old, &self.split.parent().runs)?;
        context.for_each(tiles, |tile| {
            let mut kernel = VertexKernel::new(self.split, &self.masks, values, faces);
            for (first, part) in tile {
                kernel.run(first, part, &self.ruled);
            }
        })?;
        let (mut rows, mut sum) = (self.rows(), Points::new(values, faces));
        for &v in &self.ruled_vertices {
            old[v as usize] = sum.of(|sink| self.vertex_row(v, &mut rows, sink));
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
        context.fill(out, 1, |start, part| {
            let corners = &self.split.edges.first[start..start + part.len()];
            if kernel.run(corners, part) {
                return;
            }
            let (rows, mut sum) = (self.rows(), Points::new(values, faces));
            for (slot, &c) in part.iter_mut().zip(corners) {
                *slot = sum.of(|sink| self.edge_row(c, &rows, sink));
            }
        })?;
        let (rows, mut sum) = (self.rows(), Points::new(values, faces));
        for &c in &self.ruled_edges {
            let edge = self.split.edges.of_corner[c as usize];
            out[edge as usize] = sum.of(|sink| self.edge_row(c, &rows, sink));
        }
        Ok(())
    }
}

/// Pieces of an array, each with the place of its first entry.
type Tile<'o, V> = Vec<(u32, &'o mut [V])>;

/// Cuts an array whose runs all follow the order of the faces into tiles that hold the same
/// part of every run: what belongs to some faces is computed together, while they are in
/// the cache, and not once for each run.
fn tiles<'o, V>(context: &Context, out: &'o mut [V], runs: &[u32]) -> Result<Vec<Tile<'o, V>>> {
    let count = context.chunks(out.len()).len().max(out.len() / TILE).max(1);
    let mut tiles = memory::reserved(count)?;
    tiles.resize_with(count, Vec::new);
    let ends = runs.iter().map(|&v| v as usize).chain([out.len()]);
    let (mut rest, mut start) = (out, 0);
    for end in ends {
        let (mut run, later) = rest.split_at_mut(end - start);
        let len = run.len();
        for (i, tile) in tiles.iter_mut().enumerate() {
            let (from, to) = (len * i / count, len * (i + 1) / count);
            let (part, others) = run.split_at_mut(to - from);
            memory::extend(tile, (!part.is_empty()).then_some(((start + from) as u32, part)))?;
            run = others;
        }
        (rest, start) = (later, end);
    }
    Ok(tiles)
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
