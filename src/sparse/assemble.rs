//! Rows written straight into growing arrays, by as many threads as there are.

use super::StencilTable;
use super::table::check_size;
use crate::base::{Context, Result, Scalar, memory};

/// Rows that a thread makes before they are put behind those made earlier: with their
/// entries they stay in a second-level cache.
const PIECE: usize = 4096;

/// Receives the rows of a part of a table, one after the other.
#[derive(Debug)]
pub(crate) struct RowWriter<T> {
    ends: Vec<u32>,
    indices: Vec<u32>,
    weights: Vec<T>,
}

impl<T: Scalar> RowWriter<T> {
    /// The next row: as many weights as columns.
    #[inline]
    pub(crate) fn row(
        &mut self,
        indices: impl ExactSizeIterator<Item = u32>,
        weights: impl ExactSizeIterator<Item = T>,
    ) -> Result<()> {
        memory::grow(&mut self.indices, indices.len())?;
        memory::grow(&mut self.weights, weights.len())?;
        self.indices.extend(indices);
        self.weights.extend(weights);
        self.end()
    }

    /// The next row from slices of the same length.
    pub(crate) fn copy(&mut self, (indices, weights): (&[u32], &[T])) -> Result<()> {
        memory::grow(&mut self.indices, indices.len())?;
        memory::grow(&mut self.weights, weights.len())?;
        self.indices.extend_from_slice(indices);
        self.weights.extend_from_slice(weights);
        self.end()
    }

    fn end(&mut self) -> Result<()> {
        check_size("entries", self.indices.len())?;
        memory::extend(&mut self.ends, [self.indices.len() as u32])
    }

    fn clear(&mut self) {
        self.ends.clear();
        self.indices.clear();
        self.weights.clear();
    }
}

/// A table of `rows` rows: `row` gets what `state` made for its thread, the number of the
/// row and where it goes. The order of the entries is `row`'s, at any number of threads.
pub(crate) fn assemble<T: Scalar, S: Send>(
    context: &Context,
    rows: usize,
    columns: usize,
    state: impl Fn() -> Result<S>,
    row: impl Fn(&mut S, usize, &mut RowWriter<T>) -> Result<()> + Sync + Send,
) -> Result<StencilTable<T>> {
    check_size("rows", rows)?;
    check_size("columns", columns)?;
    let piece = context.chunk_len(rows).min(PIECE);
    let mut workers = Vec::new();
    for _ in 0..context.threads().min(rows.div_ceil(piece)) {
        let writer = RowWriter { ends: Vec::new(), indices: Vec::new(), weights: Vec::new() };
        workers.push((state()?, writer));
    }
    let mut table = Growing::new(rows)?;
    let mut first = 0;
    while first < rows {
        let starts = (first..rows).step_by(piece);
        let jobs: Vec<_> = workers
            .iter_mut()
            .zip(starts)
            .map(|(worker, start)| (worker, start..(start + piece).min(rows)))
            .collect();
        first = jobs.last().map_or(rows, |(_, range)| range.end);
        let made = context.map(jobs, |((state, writer), mut range)| {
            writer.clear();
            range.try_for_each(|i| row(state, i, writer))
        })?;
        made.into_iter().collect::<Result<()>>()?;
        for (_, writer) in &workers {
            table.append(context, writer)?;
        }
        for (_, writer) in &mut workers {
            writer.clear();
        }
    }
    Ok(table.finish(columns as u32))
}

/// A table that rows are put behind.
struct Growing<T> {
    rows: usize,
    offsets: Vec<u32>,
    indices: Vec<u32>,
    weights: Vec<T>,
}

impl<T: Scalar> Growing<T> {
    fn new(rows: usize) -> Result<Self> {
        let mut offsets = memory::reserved(rows + 1)?;
        offsets.push(0);
        Ok(Self { rows, offsets, indices: Vec::new(), weights: Vec::new() })
    }

    fn append(&mut self, context: &Context, part: &RowWriter<T>) -> Result<()> {
        let before = self.indices.len();
        let len = before + part.indices.len();
        check_size("entries", len)?;
        if len > self.indices.capacity() {
            self.reserve(context, len, part.ends.len())?;
        }
        self.offsets.extend(part.ends.iter().map(|&end| before as u32 + end));
        self.indices.extend_from_slice(&part.indices);
        self.weights.extend_from_slice(&part.weights);
        Ok(())
    }

    /// Makes room for at least `len` entries: for all that are to come if the other rows
    /// are like those so far.
    fn reserve(&mut self, context: &Context, len: usize, new: usize) -> Result<()> {
        let so_far = (self.offsets.len() - 1 + new).max(1);
        let all = (len as u128 * self.rows as u128 / so_far as u128) as usize;
        let expected = if self.indices.is_empty() { all } else { all + all / 16 };
        let expected = expected.max(len + len / 4);
        context.check_memory(4 * self.rows as u64 + (4 + T::BYTES) * len as u64)?;
        let more = expected - self.indices.len();
        memory::grow(&mut self.indices, more)?;
        memory::grow(&mut self.weights, more)
    }

    fn finish(self, columns: u32) -> StencilTable<T> {
        let (indices, weights) = (memory::fitted(self.indices), memory::fitted(self.weights));
        StencilTable::from_parts(columns, self.offsets, indices, weights)
    }
}
