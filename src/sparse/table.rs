//! The table itself: rows in compressed form.

use crate::base::{Context, Error, ErrorKind, NONE, Result, Scalar, memory};
use std::ops::Range;

/// A sparse matrix by rows: row i says how new value i is made of old values.
///
/// Entries of a row stand in a fixed order and are summed in it, so that the same table
/// gives the same bits with any number of threads. 4 bytes per row, 4 and a weight per
/// entry.
///
/// # Example
/// The middle and the end of a segment:
/// ```
/// use carvel::{Context, Records, RecordsMut, StencilTable};
/// let table = StencilTable::new(2, &[0, 2, 3], vec![0, 1, 1], vec![0.5, 0.5, 1.0])?;
/// let (values, mut out) = ([0.0, 0.0, 4.0, 2.0], [0.0; 4]);
/// let context = Context::serial();
/// table.apply(&context, Records::packed(&values, 2), RecordsMut::packed(&mut out, 2))?;
/// assert_eq!(out, [2.0, 1.0, 4.0, 2.0]);
/// # Ok::<(), carvel::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct StencilTable<T> {
    columns: u32,
    /// Where each row's entries begin, and where the last one's end.
    offsets: Vec<u32>,
    indices: Vec<u32>,
    weights: Vec<T>,
}

impl<T: Scalar> StencilTable<T> {
    /// A table of rows given in compressed form: the entries of row i are
    /// `offsets[i]..offsets[i + 1]`. A column may come more than once in a row.
    ///
    /// # Errors
    /// [`ErrorKind::LengthMismatch`] if the lengths or offsets do not go together,
    /// [`ErrorKind::IndexOutOfRange`] for an index that is not below `columns`,
    /// [`ErrorKind::NotFinite`] for a weight, [`ErrorKind::TooLarge`] for 2³² − 1 rows,
    /// columns or entries and more, [`ErrorKind::OutOfResources`].
    pub fn new(
        columns: usize,
        offsets: &[u64],
        indices: Vec<u32>,
        weights: Vec<T>,
    ) -> Result<Self> {
        let rows = offsets.len().saturating_sub(1);
        check_size("columns", columns)?;
        check_size("rows", rows)?;
        check_size("entries", indices.len())?;
        let ends = [offsets.first().copied(), offsets.last().copied()];
        let full = indices.len() == weights.len() && ends == [Some(0), Some(indices.len() as u64)];
        if !full || !offsets.is_sorted() {
            return Err(Error::new(
                ErrorKind::LengthMismatch,
                format!(
                    "offsets must ascend from 0 to the number of entries: {} indices, {} weights",
                    indices.len(),
                    weights.len()
                ),
            ));
        }
        let offsets = memory::collect(offsets.iter().map(|&offset| offset as u32))?;
        let table = Self { columns: columns as u32, offsets, indices, weights };
        table.check_entries()?;
        Ok(table)
    }

    /// The table that changes nothing.
    pub(crate) fn identity(columns: usize) -> Result<Self> {
        check_size("columns", columns)?;
        let n = columns as u32;
        Ok(Self {
            columns: n,
            offsets: memory::collect(0..=n)?,
            indices: memory::collect(0..n)?,
            weights: memory::filled(T::from_f64(1.0), columns)?,
        })
    }

    /// A table whose parts are known to go together.
    pub(super) fn from_parts(
        columns: u32,
        offsets: Vec<u32>,
        indices: Vec<u32>,
        weights: Vec<T>,
    ) -> Self {
        Self { columns, offsets, indices, weights }
    }

    pub(super) fn check_entries(&self) -> Result<()> {
        if let Some(at) = self.indices.iter().position(|&i| i >= self.columns) {
            let message =
                format!("entry {at} names column {} of {}", self.indices[at], self.columns);
            return Err(Error::new(ErrorKind::IndexOutOfRange, message));
        }
        if let Some(at) = self.weights.iter().position(|w| !w.is_finite()) {
            let message = format!("the weight of entry {at} is {:?}", self.weights[at]);
            return Err(Error::new(ErrorKind::NotFinite, message));
        }
        Ok(())
    }

    /// The number of rows: of new values.
    pub fn rows(&self) -> usize {
        self.offsets.len() - 1
    }

    /// The number of columns: of old values.
    pub fn columns(&self) -> usize {
        self.columns as usize
    }

    /// The number of weights.
    pub fn entries(&self) -> usize {
        self.indices.len()
    }

    /// Where the entries of each row begin; one more than rows, the last being the number
    /// of entries.
    pub fn offsets(&self) -> &[u32] {
        &self.offsets
    }

    /// The column of every entry, row after row.
    pub fn indices(&self) -> &[u32] {
        &self.indices
    }

    /// The weight of every entry, row after row.
    pub fn weights(&self) -> &[T] {
        &self.weights
    }

    /// The columns and weights of a row.
    ///
    /// # Panics
    /// If `row` is not below [`StencilTable::rows`].
    pub fn row(&self, row: usize) -> (&[u32], &[T]) {
        let range = self.entries_of(row..row + 1);
        (&self.indices[range.clone()], &self.weights[range])
    }

    /// The entries of some rows.
    pub(crate) fn entries_of(&self, rows: Range<usize>) -> Range<usize> {
        self.offsets[rows.start] as usize..self.offsets[rows.end] as usize
    }

    /// Bytes held.
    pub fn bytes(&self) -> u64 {
        let indices = self.offsets.capacity() + self.indices.capacity();
        4 * indices as u64 + T::BYTES * self.weights.capacity() as u64
    }

    /// The table of some of the rows, in the order asked for; a row may be asked for more
    /// than once. Linear in the entries copied.
    ///
    /// # Errors
    /// [`ErrorKind::IndexOutOfRange`] for a row that does not exist,
    /// [`ErrorKind::TooLarge`], [`ErrorKind::MemoryCeiling`],
    /// [`ErrorKind::OutOfResources`], [`ErrorKind::Cancelled`].
    pub fn select(&self, context: &Context, rows: &[u32]) -> Result<Self> {
        self.check_rows(rows)?;
        super::assemble(
            context,
            rows.len(),
            self.columns(),
            || Ok(()),
            |(), at, out| out.copy(self.row(rows[at] as usize)),
        )
    }

    /// Refuses a list that names a row which does not exist.
    pub(super) fn check_rows(&self, rows: &[u32]) -> Result<()> {
        let strange = rows.iter().find(|&&row| row as usize >= self.rows());
        strange.map_or(Ok(()), |row| {
            let message = format!("row {row} of {}", self.rows());
            Err(Error::new(ErrorKind::IndexOutOfRange, message))
        })
    }
}

/// Refuses a number of rows, columns or entries that indices cannot count.
pub(super) fn check_size(what: &str, n: usize) -> Result<()> {
    if n < NONE as usize {
        return Ok(());
    }
    let message = format!("{n} {what} of a stencil table do not fit 32-bit indices");
    Err(Error::new(ErrorKind::TooLarge, message))
}
