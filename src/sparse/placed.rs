//! Rows on a short list of columns that is yet to come.

use super::StencilTable;
use super::table::check_size;
use crate::base::{Context, Result, Scalar, memory};
use std::ops::Range;

/// Columns that rows name by places.
pub(crate) type Columns = [u32; 256];

/// Rows on places in a list of up to 255 columns. With a list they become rows of a
/// table, and with other lists others.
pub(crate) struct PlacedRows<T> {
    /// Where the entries of each row begin, and where the last one's end.
    offsets: Vec<u32>,
    places: Vec<u8>,
    weights: Vec<T>,
}

impl<T: Scalar> PlacedRows<T> {
    /// No rows.
    pub(crate) fn none() -> Self {
        Self { offsets: vec![0], places: Vec::new(), weights: Vec::new() }
    }

    /// Some of the rows, in the order asked for.
    pub(crate) fn select(&self, rows: &[Range<u32>]) -> Result<Self> {
        let wide = |range: &Range<u32>| range.start as usize..range.end as usize;
        let count = rows.iter().map(ExactSizeIterator::len).sum::<usize>();
        let entries = rows.iter().map(|range| self.entries(wide(range)).len()).sum();
        let mut selected = Self {
            offsets: memory::reserved(count + 1)?,
            places: memory::reserved(entries)?,
            weights: memory::reserved(entries)?,
        };
        selected.offsets.push(0);
        for range in rows {
            let (entries, before) = (self.entries(wide(range)), selected.places.len());
            let ends = &self.offsets[range.start as usize + 1..=range.end as usize];
            let shift = (before as u32).wrapping_sub(entries.start as u32);
            selected.offsets.extend(ends.iter().map(|&end| end.wrapping_add(shift)));
            selected.places.extend_from_slice(&self.places[entries.clone()]);
            selected.weights.extend_from_slice(&self.weights[entries]);
        }
        Ok(selected)
    }

    /// The entries of some rows.
    pub(crate) fn entries(&self, rows: Range<usize>) -> Range<usize> {
        self.offsets[rows.start] as usize..self.offsets[rows.end] as usize
    }

    /// Bytes in use.
    pub(crate) fn bytes(&self) -> u64 {
        4 * self.offsets.len() as u64 + (1 + T::BYTES) * self.places.len() as u64
    }

    /// The places and weights of a row.
    pub(crate) fn row(&self, row: usize) -> (&[u8], &[T]) {
        let range = self.entries(row..row + 1);
        (&self.places[range.clone()], &self.weights[range])
    }
}

/// Rows on places that are being made.
pub(crate) struct PlacedWriter<T> {
    rows: PlacedRows<T>,
    /// The number of entries so far: there is room behind them.
    len: usize,
}

impl<T: Scalar> PlacedWriter<T> {
    /// Room for a number of rows of up to 255 places.
    pub(crate) fn new(rows: usize, places: usize) -> Result<Self> {
        let mut offsets = memory::reserved(rows + 1)?;
        offsets.push(0);
        let room = rows * places + 256;
        let (places, weights) = (memory::zeroed(room)?, memory::zeroed(room)?);
        Ok(Self { rows: PlacedRows { offsets, places, weights }, len: 0 })
    }

    /// One more row, without weights that are zero once rounded.
    #[inline(always)]
    pub(crate) fn push(&mut self, weights: &[f64]) {
        let places = self.rows.places[self.len..].first_chunk_mut::<256>();
        let kept = self.rows.weights[self.len..].first_chunk_mut::<256>();
        let mut n = 0_u8;
        if let (Some(places), Some(kept)) = (places, kept) {
            // What does not stay is written over by what comes behind.
            for (place, &weight) in (0..=u8::MAX).zip(weights) {
                let (at, weight) = (usize::from(n), T::from_f64(weight));
                (places[at], kept[at]) = (place, weight);
                n = n.wrapping_add(u8::from(weight != T::default()));
            }
        }
        self.len += usize::from(n);
        self.rows.offsets.push(self.len as u32);
    }

    /// The rows.
    pub(crate) fn finish(mut self) -> PlacedRows<T> {
        let PlacedRows { places, weights, .. } = &mut self.rows;
        places.truncate(self.len);
        weights.truncate(self.len);
        // Most of the room was for rows without zeros.
        *places = memory::fitted(std::mem::take(places));
        *weights = memory::fitted(std::mem::take(weights));
        self.rows
    }
}

/// A part of a table that is being filled, row after row.
pub(crate) struct Filling<'o, T> {
    /// The number of entries before.
    first: u32,
    ends: &'o mut [u32],
    indices: &'o mut [u32],
    weights: &'o mut [T],
}

impl<T: Scalar> Filling<'_, T> {
    /// Rows of a pattern on their columns.
    #[inline(always)]
    pub(crate) fn place(&mut self, rows: &PlacedRows<T>, range: Range<usize>, columns: &Columns) {
        let entries = rows.entries(range.clone());
        self.put_ends(&rows.offsets[range.start + 1..=range.end], entries.start as u32);
        let places = &rows.places[entries.clone()];
        let out = self.indices.split_off_mut(..places.len()).unwrap_or_default();
        for (index, &place) in out.iter_mut().zip(places) {
            *index = columns[usize::from(place)];
        }
        self.weights
            .split_off_mut(..places.len())
            .unwrap_or_default()
            .copy_from_slice(&rows.weights[entries]);
    }

    /// A single row of a pattern.
    pub(crate) fn place_one(&mut self, rows: &PlacedRows<T>, row: usize, columns: &[u32]) {
        let (places, weights) = rows.row(row);
        self.put_ends(&[places.len() as u32], 0);
        let out = self.indices.split_off_mut(..places.len()).unwrap_or_default();
        for (index, &place) in out.iter_mut().zip(places) {
            *index = columns[usize::from(place)];
        }
        self.weights.split_off_mut(..places.len()).unwrap_or_default().copy_from_slice(weights);
    }

    /// Rows of a table as they are.
    pub(crate) fn copy(&mut self, table: &StencilTable<T>, range: Range<usize>) {
        let entries = table.entries_of(range.clone());
        let ends = &table.offsets()[range.start + 1..=range.end];
        self.put_ends(ends, entries.start as u32);
        self.indices
            .split_off_mut(..entries.len())
            .unwrap_or_default()
            .copy_from_slice(&table.indices()[entries.clone()]);
        self.weights
            .split_off_mut(..entries.len())
            .unwrap_or_default()
            .copy_from_slice(&table.weights()[entries]);
    }

    /// Where rows end that began at `start` elsewhere.
    #[inline]
    fn put_ends(&mut self, ends: &[u32], start: u32) {
        let shift = self.first.wrapping_sub(start);
        for (out, &end) in
            self.ends.split_off_mut(..ends.len()).unwrap_or_default().iter_mut().zip(ends)
        {
            *out = end.wrapping_add(shift);
        }
        self.first = ends.last().map_or(self.first, |&end| end.wrapping_add(shift));
    }
}

/// A table whose parts are known by their rows and entries; `fill` writes them all, in any
/// order, each on one thread.
pub(crate) fn filled<T: Scalar>(
    context: &Context,
    columns: usize,
    parts: &[(usize, usize)],
    fill: impl Fn(usize, &mut Filling<T>) + Sync + Send,
) -> Result<StencilTable<T>> {
    let rows = parts.iter().map(|part| part.0).sum::<usize>();
    let entries = parts.iter().map(|part| part.1).sum::<usize>();
    check_size("columns", columns)?;
    check_size("rows", rows)?;
    check_size("entries", entries)?;
    context.check_memory(4 * rows as u64 + (4 + T::BYTES) * entries as u64)?;
    let mut offsets = memory::zeroed_exact(rows + 1)?;
    let mut indices = memory::zeroed_exact(entries)?;
    let mut weights = memory::zeroed_exact(entries)?;
    let mut jobs = memory::reserved(parts.len())?;
    let (mut ends, mut rest) = (&mut offsets[1..], (&mut indices[..], &mut weights[..]));
    let mut first = 0;
    for (part, &(rows, entries)) in parts.iter().enumerate() {
        let ends = ends.split_off_mut(..rows).unwrap_or_default();
        let (indices, weights) = (
            rest.0.split_off_mut(..entries).unwrap_or_default(),
            rest.1.split_off_mut(..entries).unwrap_or_default(),
        );
        jobs.push((part, Filling { first, ends, indices, weights }));
        first += entries as u32;
    }
    context.for_each(jobs, |(part, mut filling)| fill(part, &mut filling))?;
    Ok(StencilTable::from_parts(columns as u32, offsets, indices, weights))
}
