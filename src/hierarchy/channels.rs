//! Face-varying values on their way through the levels.

use super::columns::{Column, Place};
use super::predict::Prediction;
use super::primal_step::PrimalStep;
use super::step::Step;
use super::values::{check, check_overflow, lanes};
use crate::base::{Context, Error, ErrorKind, Result, Scalar, memory};
use crate::mesh::{Channel, Mesh};
use crate::refine::adjacency::Recycled;
use crate::refine::{Carried, Creasing, EdgeNumbers, PrimalSplit, Split};
use crate::scheme::{ChannelLevel, ChannelRules, Scheme};
use std::borrow::Cow;

/// Face-varying values: a channel and what it names.
#[derive(Debug, Clone, Copy)]
pub struct FaceVarying<'a, T> {
    /// Which value each corner takes.
    pub channel: &'a Channel,
    /// The values, `width` numbers each.
    pub values: &'a [T],
    /// Numbers per value, at least 1.
    pub width: usize,
}

/// Where refined face-varying values go; sizes by [`Prediction::of_channel`].
#[derive(Debug)]
pub struct ChannelOutput<'a, T> {
    /// The value of every corner of the last level.
    pub indices: &'a mut [u32],
    /// The values of the last level.
    pub values: &'a mut [T],
}

/// Refined face-varying values.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct RefinedChannel<T> {
    /// The value of every corner.
    pub indices: Vec<u32>,
    /// The values.
    pub values: Vec<T>,
}

impl<T> RefinedChannel<T> {
    /// Its arrays to be written.
    pub(super) fn output(&mut self) -> ChannelOutput<'_, T> {
        ChannelOutput { indices: &mut self.indices, values: &mut self.values }
    }
}

impl<T: Scalar> FaceVarying<'_, T> {
    /// Checks everything that can be checked before work starts; predicts the sizes.
    pub(super) fn plan(&self, mesh: &Mesh, scheme: &Scheme, levels: u32) -> Result<Prediction> {
        self.channel.check_mesh(mesh)?;
        super::values::check_length(
            "face-varying values",
            self.values.len(),
            self.width,
            self.channel.values,
        )?;
        if levels > 0 {
            ChannelRules::new(scheme, self.channel.mode).check()?;
        }
        let plan = Prediction::of_channel(self.channel, scheme, levels)?;
        plan.check_index_type()?;
        Ok(plan)
    }

    /// Scratch memory of a refinement, with the records that it copies: one for each pair
    /// of vertex and value.
    pub(super) fn scratch_bytes(&self, plan: &Prediction) -> u64 {
        channel_bytes(self.channel, plan, self.width as u64, T::BYTES)
    }

    /// Checks that all values are finite; returns the largest magnitude.
    pub(super) fn check_values(&self, context: &Context) -> Result<f64> {
        check(context, "face-varying values", self.values, self.width, self.channel.values)
    }

    /// Level 0: the values as they are.
    pub(super) fn copy(&self, out: &mut ChannelOutput<T>) {
        out.values.copy_from_slice(self.values);
        for (corner, slot) in out.indices.iter_mut().enumerate() {
            *slot = self.channel.taken(corner);
        }
    }
}

/// Scratch memory of the refinement of a channel with values of some width.
pub(crate) fn channel_bytes(channel: &Channel, plan: &Prediction, width: u64, size: u64) -> u64 {
    let record = width.saturating_mul(size);
    let copied = (channel.source.len() as u64).saturating_mul(record);
    plan.refiner_bytes(width, size, false).saturating_add(copied)
}

impl<T: Scalar> ChannelOutput<'_, T> {
    /// Checks the lengths.
    pub(super) fn check(&self, plan: &Prediction, width: usize) -> Result<()> {
        let last = plan.last();
        let values = last.vertices.saturating_mul(width as u64);
        let lengths =
            [("indices", self.indices.len(), last.corners), ("values", self.values.len(), values)];
        let wrong = lengths.into_iter().find(|(_, len, expected)| *len as u64 != *expected);
        wrong.map_or(Ok(()), |(what, len, expected)| {
            let message =
                format!("face-varying {what}: the output has {len} entries, {expected} are needed");
            Err(Error::new(ErrorKind::LengthMismatch, message))
        })
    }
}

/// A channel in the middle of a refinement.
pub(super) struct ChannelRun<'a, T> {
    rules: ChannelRules<'a>,
    width: usize,
    level: ChannelLevel<'a>,
    /// The caller's values, one record for each pair of vertex and value.
    input: Vec<T>,
    columns: Vec<(Column<T>, Place)>,
    edges: EdgeNumbers,
}

impl<'a, T: Scalar> ChannelRun<'a, T> {
    pub(super) fn new(scheme: &'a Scheme, mesh: &Mesh, data: &FaceVarying<'a, T>) -> Result<Self> {
        let rules = ChannelRules::new(scheme, data.channel.mode);
        let width = data.width;
        let mut input = memory::reserved(data.channel.source.len().saturating_mul(width))?;
        for &value in &data.channel.source {
            let first = value as usize * width;
            input.extend_from_slice(&data.values[first..first + width]);
        }
        let place = |(first, n)| (Column::new(n), Place { attribute: 0, width, first });
        Ok(Self {
            rules,
            width,
            level: ChannelLevel::control(rules, mesh, data.channel)?,
            input,
            columns: lanes(width).map(place).collect(),
            edges: EdgeNumbers::default(),
        })
    }

    /// One level that is not the last; `watch` looks for values out of range.
    pub(super) fn step(
        &mut self,
        context: &Context,
        shape: &PrimalSplit,
        level: usize,
        watch: bool,
    ) -> Result<()> {
        let pieces = shape.pieces();
        let split = PrimalSplit::new(context, &self.level.mesh, pieces, &mut self.edges)?;
        let left = self.rules.next(shape, &self.level, &split)?;
        let step =
            Step::channel(PrimalStep::channel(self.rules, shape, &self.level, &split, &left)?);
        for (column, place) in &mut self.columns {
            let values = column.step(context, &step, level, *place, &self.input)?;
            if watch {
                check_overflow(context, values, level + 1)?;
            }
        }
        drop(step);
        let split = Split::Primal(split);
        let carried = Carried { anchored: false, creasing: Creasing::Uniform, holes: &[] };
        let mesh = split.mesh(context, carried, &mut Recycled::default())?;
        split.recycle(&mut self.edges);
        self.level = ChannelLevel { mesh: Cow::Owned(mesh), split: left };
        Ok(())
    }

    /// The last level, into the caller's arrays.
    pub(super) fn finish(
        &mut self,
        context: &Context,
        shape: &PrimalSplit,
        level: usize,
        watch: bool,
        out: &mut ChannelOutput<T>,
    ) -> Result<()> {
        let pieces = shape.pieces();
        let split = PrimalSplit::new(context, &self.level.mesh, pieces, &mut self.edges)?;
        split.write_faces(context, out.indices)?;
        let left = self.rules.next(shape, &self.level, &split)?;
        let step =
            Step::channel(PrimalStep::channel(self.rules, shape, &self.level, &split, &left)?);
        debug_assert_eq!(out.values.len(), step.children() * self.width);
        for (column, place) in &mut self.columns {
            column.finish(context, &step, level, *place, &self.input, out.values)?;
        }
        if watch { check_overflow(context, out.values, level + 1) } else { Ok(()) }
    }
}
