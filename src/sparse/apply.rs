//! Tables applied to values.
//!
//! Up to four lanes of every record go through a table at a time: they are copied together
//! first, so that a row reads whole vector registers from memory without gaps.

use super::kernel::{Few, Four, Sum, row_sum};
use super::records::{check_widths, span};
use super::{Dependents, Records, RecordsMut, StencilTable};
use crate::base::simd::{InnerLoop, with_widest};
use crate::base::{Context, Result, Scalar, memory};
use std::ops::Range;

/// Which rows, and what becomes of what was there.
#[derive(Clone, Copy)]
struct Work<'w> {
    /// Ascending; all if absent.
    rows: Option<&'w [u32]>,
    add: bool,
}

impl<T: Scalar> StencilTable<T> {
    /// Computes all new values: one record of `out` per row from one of `values` per column.
    ///
    /// Weights are rounded to the values' number type; products are added in the order of
    /// the entries, never fused. A copy of the values passes through scratch memory.
    ///
    /// # Errors
    /// [`crate::ErrorKind::LengthMismatch`] if records are missing or left over,
    /// [`crate::ErrorKind::ParameterOutOfRange`] for a width or stride or for widths that
    /// differ, [`crate::ErrorKind::OutOfResources`], [`crate::ErrorKind::Cancelled`].
    pub fn apply<V: Scalar>(
        &self,
        context: &Context,
        values: Records<V>,
        out: RecordsMut<V>,
    ) -> Result<()> {
        self.run(context, Work { rows: None, add: false }, values, out)
    }

    /// Adds all new values to what `out` holds.
    ///
    /// # Errors
    /// As [`StencilTable::apply`].
    pub fn apply_add<V: Scalar>(
        &self,
        context: &Context,
        values: Records<V>,
        out: RecordsMut<V>,
    ) -> Result<()> {
        self.run(context, Work { rows: None, add: true }, values, out)
    }

    /// Computes again what depends on the columns `changed`, in any order, and leaves the
    /// rest of `out` as it is; `dependents` are this table's own. The same bits as
    /// [`StencilTable::apply`]. Costs the rows concerned and a copy of the values.
    ///
    /// # Errors
    /// As [`StencilTable::apply`]; [`crate::ErrorKind::IndexOutOfRange`] for a column,
    /// [`crate::ErrorKind::LengthMismatch`] for the dependents of a table of another size.
    pub fn update<V: Scalar>(
        &self,
        context: &Context,
        dependents: &Dependents,
        changed: &[u32],
        values: Records<V>,
        out: RecordsMut<V>,
    ) -> Result<()> {
        dependents.check(self)?;
        let rows = dependents.of(changed)?;
        self.run(context, Work { rows: Some(&rows), add: false }, values, out)
    }

    /// Adds up, for every column, what its weights make of the rows' values: the
    /// transpose applied, for gradients. `values` has one record per row, `out` one per
    /// column. The same bits at any number of threads, and as
    /// [`StencilTable::transpose`] applied; with several threads it makes that first.
    ///
    /// # Errors
    /// As [`StencilTable::apply`].
    pub fn apply_transpose<V: Scalar>(
        &self,
        context: &Context,
        values: Records<V>,
        out: RecordsMut<V>,
    ) -> Result<()> {
        check_records(&values, &out, [self.rows(), self.columns()])?;
        self.transpose(context)?.apply(context, values, out)
    }

    fn run<V: Scalar>(
        &self,
        context: &Context,
        work: Work,
        values: Records<V>,
        mut out: RecordsMut<V>,
    ) -> Result<()> {
        check_records(&values, &out, [self.columns(), self.rows()])?;
        for first in (0..out.width).step_by(4) {
            let out = &mut out;
            match out.width - first {
                1 => self.lanes::<V, Few<V, 1>, 1>(context, work, values, first, out)?,
                2 => self.lanes::<V, Few<V, 2>, 2>(context, work, values, first, out)?,
                3 => self.lanes::<V, Four<V>, 3>(context, work, values, first, out)?,
                _ => self.lanes::<V, Four<V>, 4>(context, work, values, first, out)?,
            }
        }
        Ok(())
    }

    /// The lanes `first..first + N` of every record.
    fn lanes<V: Scalar, S: Sum<V, N>, const N: usize>(
        &self,
        context: &Context,
        work: Work,
        values: Records<V>,
        first: usize,
        out: &mut RecordsMut<V>,
    ) -> Result<()> {
        let mut packed = memory::reserved(self.columns())?;
        let records = values.values.chunks(values.stride).take(self.columns());
        packed.extend(records.map(|record| S::load(at::<V, N>(record, first))));
        let (stride, packed, zero) = (out.stride, &packed[..], [V::default(); N]);
        let slot = |record: &mut [V], sum: [V; N]| {
            let Some(lanes) = record[first..].first_chunk_mut::<N>() else { return };
            *lanes = if work.add { std::array::from_fn(|i| lanes[i] + sum[i]) } else { sum };
        };
        let Some(rows) = work.rows else {
            let len = span(out.width, stride, self.rows()).unwrap_or_default();
            return context.fill_records(&mut out.values[..len], stride, |start, part| {
                let rows = start..(start + part.len().div_ceil(stride)).min(self.rows());
                let slots = part.chunks_mut(stride);
                with_widest(Sums { table: self, rows, zero, values: packed, slots, write: slot });
            });
        };
        let len = context.chunk_len(rows.len());
        let (mut rest, mut done, mut parts) = (&mut *out.values, 0, Vec::new());
        for rows in rows.chunks(len) {
            let end = rows[rows.len() - 1] as usize + 1;
            let at = (end - done).saturating_mul(stride).min(rest.len());
            let (part, later) = rest.split_at_mut(at);
            parts.push((rows, done, part));
            (rest, done) = (later, end);
        }
        context.for_each(parts, |(rows, first, part)| {
            for &row in rows {
                let row = row as usize;
                let record = &mut part[(row - first) * stride..];
                let slots = std::iter::once(record);
                let rows = row..row + 1;
                Sums { table: self, rows, zero, values: packed, slots, write: slot }.run();
            }
        })
    }
}

/// The sums of some rows, each handed over with a slot.
struct Sums<'t, T, V, S, I, F, const N: usize> {
    table: &'t StencilTable<T>,
    rows: Range<usize>,
    /// What the sums begin with.
    zero: [V; N],
    values: &'t [S],
    slots: I,
    write: F,
}

impl<T, V, S, I, F, const N: usize> InnerLoop for Sums<'_, T, V, S, I, F, N>
where
    T: Scalar,
    V: Scalar,
    S: Sum<V, N>,
    I: Iterator,
    F: Fn(I::Item, [V; N]),
{
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let offsets = &self.table.offsets()[self.rows.start..=self.rows.end];
        for (ends, slot) in offsets.windows(2).zip(self.slots) {
            let entries = ends[0] as usize..ends[1] as usize;
            let row = (&self.table.indices()[entries.clone()], &self.table.weights()[entries]);
            (self.write)(slot, row_sum(row.0, row.1, self.zero, self.values));
        }
    }
}

/// Refuses records that are not as many, or not as wide, as they should be.
fn check_records<V>(
    values: &Records<V>,
    out: &RecordsMut<V>,
    [read, written]: [usize; 2],
) -> Result<()> {
    values.check(read)?;
    out.check(written)?;
    check_widths(values.width, out.width)
}

/// Some lanes of a record.
#[inline(always)]
fn at<V: Scalar, const N: usize>(record: &[V], first: usize) -> [V; N] {
    let mut lanes = [V::default(); N];
    lanes.copy_from_slice(&record[first..first + N]);
    lanes
}
