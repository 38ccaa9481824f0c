//! Sums of sparse rows.

use crate::base::{Result, Scalar, memory};

/// A row in the making: multiples of other rows are added to a dense array, then its
/// entries are collected in the order in which they were met first.
///
/// Nothing is asked entry by entry: whether a column was met before would be a branch that
/// nobody can foresee. The rows added are walked a second time instead, and each column is
/// taken where it is met first and found zero after that.
pub(crate) struct Accumulator<'t, T> {
    dense: Vec<f64>,
    added: Vec<&'t [u32]>,
    indices: Vec<u32>,
    weights: Vec<T>,
}

impl<'t, T: Scalar> Accumulator<'t, T> {
    /// An empty row on a number of columns.
    pub(crate) fn new(columns: usize) -> Result<Self> {
        let dense = memory::zeroed(columns)?;
        Ok(Self { dense, added: Vec::new(), indices: Vec::new(), weights: Vec::new() })
    }

    /// Adds a multiple of a row.
    #[inline]
    pub(crate) fn add<S: Scalar>(&mut self, (indices, weights): (&'t [u32], &[S]), factor: f64) {
        for (&i, &w) in indices.iter().zip(weights) {
            let slot = &mut self.dense[i as usize];
            *slot += factor * w.to_f64();
        }
        self.added.push(indices);
    }

    /// Takes the row, rounded once, without weights that are zero; the next one is empty.
    pub(crate) fn take(&mut self) -> Result<(&[u32], &[T])> {
        let most = self.added.iter().map(|row| row.len()).sum::<usize>() + 1;
        if self.indices.len() < most {
            memory::resize(&mut self.indices, most.next_power_of_two())?;
            memory::resize(&mut self.weights, most.next_power_of_two())?;
        }
        let (indices, weights) = (&mut self.indices[..most], &mut self.weights[..most]);
        let mut n = 0;
        for row in self.added.drain(..) {
            for &i in row {
                let weight = T::from_f64(std::mem::take(&mut self.dense[i as usize]));
                (indices[n], weights[n]) = (i, weight);
                n += usize::from(weight != T::default());
            }
        }
        Ok((&self.indices[..n], &self.weights[..n]))
    }
}
