//! One table after another, as one table.

use super::{Accumulator, StencilTable, assemble};
use crate::base::{Context, Error, ErrorKind, Result, Scalar};

impl<T: Scalar> StencilTable<T> {
    /// The table that does what this one and then `next` do: rows of `next` on columns of
    /// this. Sums are made in double precision and rounded once. A few nanoseconds for
    /// each pair of entries that meet.
    ///
    /// # Errors
    /// [`ErrorKind::LengthMismatch`] unless `next` has a column for each row of this,
    /// [`ErrorKind::Overflow`] if a weight leaves the range of the number type,
    /// [`ErrorKind::TooLarge`], [`ErrorKind::MemoryCeiling`],
    /// [`ErrorKind::OutOfResources`], [`ErrorKind::Cancelled`].
    pub fn compose(&self, context: &Context, next: &Self) -> Result<Self> {
        if next.columns() != self.rows() {
            let message =
                format!("a table of {} columns after {} rows", next.columns(), self.rows());
            return Err(Error::new(ErrorKind::LengthMismatch, message));
        }
        let (rows, columns) = (next.rows(), self.columns());
        let state = || Accumulator::new(columns);
        assemble(context, rows, columns, state, |sum: &mut Accumulator<T>, row, out| {
            let (indices, weights) = next.row(row);
            for (&i, w) in indices.iter().zip(weights) {
                sum.add(self.row(i as usize), w.to_f64());
            }
            let (indices, weights) = sum.take()?;
            if weights.iter().all(|w| w.is_finite()) {
                return out.copy((indices, weights));
            }
            let message = format!("a weight of row {row} leaves the range of the number type");
            Err(Error::new(ErrorKind::Overflow, message))
        })
    }
}
