//! Values of any width on their way through the levels, up to four lanes at a time.

use super::kernel::Value;
use super::step::{Scratch, Step};
use super::values::{gather, scatter};
use crate::base::memory::resize;
use crate::base::{Context, Result, Scalar};

/// Up to four lanes of one attribute, with the memory of every level.
#[derive(Debug)]
pub(super) enum Column<T> {
    One(Lanes<T, 1>),
    Two(Lanes<T, 2>),
    Three(Lanes<T, 3>),
    Four(Lanes<T, 4>),
}

/// Which lanes of which records.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Place {
    /// Index of the attribute; 0 are the positions.
    pub(super) attribute: usize,
    /// Values per record.
    pub(super) width: usize,
    /// First lane.
    pub(super) first: usize,
}

/// The lanes' values at every level but the last.
#[derive(Debug)]
pub(super) struct Lanes<T, const W: usize> {
    levels: Vec<Vec<Value<T, W>>>,
    last: Vec<Value<T, W>>,
    scratch: Scratch<T, W>,
}

impl<T, const W: usize> Default for Lanes<T, W> {
    fn default() -> Self {
        Self { levels: Vec::new(), last: Vec::new(), scratch: Scratch::default() }
    }
}

/// Calls a generic expression for the lanes of a column, whatever their number.
macro_rules! each_width {
    ($column:expr, $lanes:ident => $body:expr) => {
        match $column {
            Column::One($lanes) => $body,
            Column::Two($lanes) => $body,
            Column::Three($lanes) => $body,
            Column::Four($lanes) => $body,
        }
    };
}

impl<T: Scalar> Column<T> {
    /// An empty column of 1 to 4 lanes.
    pub(super) fn new(lanes: usize) -> Self {
        match lanes {
            1 => Self::One(Lanes::default()),
            2 => Self::Two(Lanes::default()),
            3 => Self::Three(Lanes::default()),
            _ => Self::Four(Lanes::default()),
        }
    }

    /// The number of lanes.
    pub(super) fn lanes(&self) -> usize {
        match self {
            Self::One(_) => 1,
            Self::Two(_) => 2,
            Self::Three(_) => 3,
            Self::Four(_) => 4,
        }
    }

    /// Bytes held.
    pub(super) fn bytes(&self) -> u64 {
        each_width!(self, lanes => lanes.bytes())
    }

    /// Computes the values of level `level + 1`, which is not the last.
    pub(super) fn step(
        &mut self,
        context: &Context,
        step: &Step,
        level: usize,
        place: Place,
        input: &[T],
    ) -> Result<&[T]> {
        each_width!(self, lanes => lanes.step(context, step, level, place, input))
    }

    /// Computes the values of the last level into the caller's records.
    pub(super) fn finish(
        &mut self,
        context: &Context,
        step: &Step,
        level: usize,
        place: Place,
        input: &[T],
        out: &mut [T],
    ) -> Result<()> {
        each_width!(self, lanes => lanes.finish(context, step, level, place, input, out))
    }
}

impl<T: Scalar, const W: usize> Lanes<T, W> {
    fn bytes(&self) -> u64 {
        let values: usize = self.levels.iter().map(Vec::capacity).sum();
        let values = values + self.last.capacity();
        (values * size_of::<Value<T, W>>()) as u64 + self.scratch.bytes()
    }

    fn step(
        &mut self,
        context: &Context,
        step: &Step,
        level: usize,
        place: Place,
        input: &[T],
    ) -> Result<&[T]> {
        self.prepare(level, place, input)?;
        if self.levels.len() < level + 2 {
            self.levels.resize_with(level + 2, Vec::new);
        }
        let (from, to) = self.levels.split_at_mut(level + 1);
        let to = &mut to[0];
        resize(to, step.children())?;
        step.apply(context, source(&from[level], level, place, input), to, &mut self.scratch)?;
        Ok(to.as_flattened())
    }

    fn finish(
        &mut self,
        context: &Context,
        step: &Step,
        level: usize,
        place: Place,
        input: &[T],
        out: &mut [T],
    ) -> Result<()> {
        self.prepare(level, place, input)?;
        let values = source(&self.levels[level], level, place, input);
        if place.width == W {
            let (out, _) = out.as_chunks_mut();
            return step.apply(context, values, out, &mut self.scratch);
        }
        resize(&mut self.last, step.children())?;
        step.apply(context, values, &mut self.last, &mut self.scratch)?;
        scatter(&self.last, place.width, place.first, out);
        Ok(())
    }

    /// Lanes of wider records are copied together once, at level 0.
    fn prepare(&mut self, level: usize, place: Place, input: &[T]) -> Result<()> {
        if self.levels.is_empty() {
            self.levels.push(Vec::new());
        }
        if level == 0 && place.width != W {
            resize(&mut self.levels[0], input.len() / place.width)?;
            gather(input, place.width, place.first, &mut self.levels[0]);
        }
        Ok(())
    }
}

/// The values of a level: those kept, or the caller's own records at level 0.
fn source<'v, T, const W: usize>(
    kept: &'v [Value<T, W>],
    level: usize,
    place: Place,
    input: &'v [T],
) -> &'v [Value<T, W>] {
    if level == 0 && place.width == W { input.as_chunks().0 } else { kept }
}
