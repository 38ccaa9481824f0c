//! Exact linear equations, small ones.

use num_traits::Zero;

use super::rational::Rational;
use crate::base::{Context, Result};

/// The one solution of some equations, at least as many as unknowns; each row holds the
/// coefficients and, last, the right-hand side. `None` if there are none or several.
///
/// Gaussian elimination over the rationals, O(n³) operations on numbers that grow with n.
///
/// # Errors
/// [`crate::ErrorKind::Cancelled`].
pub(crate) fn solve(
    context: &Context,
    mut rows: Vec<Vec<Rational>>,
) -> Result<Option<Vec<Rational>>> {
    let unknowns = rows.first().map_or(0, |row| row.len().saturating_sub(1));
    for column in 0..unknowns {
        context.check_cancelled()?;
        let found = (column..rows.len()).find(|&r| !rows[r][column].is_zero());
        let Some(pivot) = found else { return Ok(None) };
        rows.swap(column, pivot);
        let inverse = rows[column][column].recip();
        rows[column].iter_mut().for_each(|value| *value *= &inverse);
        let chosen = rows[column].clone();
        let others = rows.iter_mut().enumerate().filter(|(r, _)| *r != column);
        for (_, row) in others.filter(|(_, row)| !row[column].is_zero()) {
            eliminate(row, &chosen, column);
        }
    }
    let consistent = rows[unknowns..].iter().all(|row| row[unknowns].is_zero());
    let solution = || rows[..unknowns].iter().map(|row| row[unknowns].clone()).collect();
    Ok(consistent.then(solution))
}

fn eliminate(row: &mut [Rational], chosen: &[Rational], column: usize) {
    let factor = row[column].clone();
    for (value, other) in row.iter_mut().zip(chosen).skip(column) {
        if !other.is_zero() {
            *value -= &factor * other;
        }
    }
}
