//! Spectral radii: estimated in doubles, bounded from below exactly.

use num_bigint::BigInt;
use num_traits::{One, Signed, Zero, pow};

use crate::base::{Context, Result};
use crate::curve::Rational;
use crate::curve::rational::over_common;

/// A square matrix of doubles, row by row.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Dense {
    pub size: usize,
    pub entries: Vec<f64>,
}

impl Dense {
    pub fn product(&self, other: &Self) -> Self {
        let n = self.size;
        let mut entries = vec![0.0; n * n];
        for (out, row) in entries.chunks_exact_mut(n).zip(self.entries.chunks_exact(n)) {
            for (a, other) in row.iter().zip(other.entries.chunks_exact(n)) {
                out.iter_mut().zip(other).for_each(|(sum, b)| *sum += a * b);
            }
        }
        Self { size: n, entries }
    }

    pub fn times(&self, vector: &[f64]) -> Vec<f64> {
        let rows = self.entries.chunks_exact(self.size);
        rows.map(|row| row.iter().zip(vector).map(|(a, x)| a * x).sum()).collect()
    }

    /// The largest absolute row sum.
    pub fn norm(&self) -> f64 {
        let rows = self.entries.chunks_exact(self.size);
        rows.map(|row| row.iter().copied().map(f64::abs).sum()).fold(0.0, f64::max)
    }

    pub fn scaled(&self, factor: f64) -> Self {
        let entries = self.entries.iter().map(|a| a * factor).collect();
        Self { size: self.size, entries }
    }
}

/// An estimate of the spectral radius and a high power of the matrix, scaled to norm 1,
/// whose columns span the directions that grow most.
///
/// By repeated squaring, ‖P^(2ᵏ)‖^(1/2ᵏ); gives up, with `None`, once that bound from above
/// is below `least`.
pub(super) fn radius(matrix: &Dense, least: f64) -> Option<(f64, Dense)> {
    const SQUARINGS: i32 = 46;
    let (mut power, mut log) = (matrix.clone(), 0.0);
    for k in 0..=SQUARINGS {
        let norm = power.norm();
        if norm == 0.0 {
            return None;
        }
        power = power.scaled(1.0 / norm);
        log += libm::log(norm) / libm::exp2(f64::from(k));
        if libm::exp(log) < least {
            return None;
        }
        if k < SQUARINGS {
            power = power.product(&power);
        }
    }
    Some((libm::exp(log), power))
}

/// A square matrix of integers over a common denominator.
#[derive(Debug, Clone)]
pub(super) struct Exact {
    pub rows: Vec<Vec<BigInt>>,
    pub denominator: BigInt,
}

impl Exact {
    pub fn new(rows: &[Vec<Rational>]) -> Self {
        let (whole, denominator) = over_common(rows.iter().flatten());
        let rows = whole.chunks(rows.len().max(1)).map(<[BigInt]>::to_vec).collect();
        Self { rows, denominator }
    }

    pub fn product(&self, other: &Self) -> Self {
        let rows = multiply(&self.rows, &other.rows);
        Self { rows, denominator: &self.denominator * &other.denominator }
    }

    /// det(x − A) by ascending powers of x (Faddeev and LeVerrier).
    pub fn characteristic(&self) -> Vec<Rational> {
        let n = self.rows.len();
        let mut coefficients = vec![BigInt::one()];
        let mut product = vec![vec![BigInt::zero(); n]; n];
        for k in 1..=n {
            let last = coefficients[k - 1].clone();
            product.iter_mut().enumerate().for_each(|(i, row)| row[i] += &last);
            product = multiply(&self.rows, &product);
            let trace: BigInt = product.iter().enumerate().map(|(i, row)| &row[i]).sum();
            coefficients.push(-trace / BigInt::from(k));
        }
        let over = |(k, c): (usize, BigInt)| Rational::new(c, pow(self.denominator.clone(), k));
        let falling: Vec<Rational> = coefficients.into_iter().enumerate().map(over).collect();
        falling.into_iter().rev().collect()
    }
}

fn multiply(a: &[Vec<BigInt>], b: &[Vec<BigInt>]) -> Vec<Vec<BigInt>> {
    let n = b.first().map_or(0, Vec::len);
    let row = |row: &Vec<BigInt>| {
        let mut out = vec![BigInt::zero(); n];
        for (x, other) in row.iter().zip(b).filter(|(x, _)| !x.is_zero()) {
            out.iter_mut().zip(other).for_each(|(sum, y)| *sum += x * y);
        }
        out
    };
    a.iter().map(row).collect()
}

/// The most bits of all coefficients together that the search for roots goes on with.
const MOST_BITS: u64 = 1 << 18;

/// True if some root of a polynomial, given by ascending powers, the highest with the factor 1,
/// is proved to have absolute value `radius` or more. Exact, and decided unless coefficients become
/// very long.
///
/// A polynomial that is not positive at `radius`, or at −`radius` has not the sign that it has far
/// out, has a real root beyond. Otherwise Schur and Cohn (1917–1922).
///
/// # Errors
/// [`crate::ErrorKind::Cancelled`].
pub(super) fn has_root_beyond(
    context: &Context,
    polynomial: &[Rational],
    radius: &Rational,
) -> Result<bool> {
    if radius.is_zero() {
        return Ok(polynomial.len() > 1);
    }
    let powers = std::iter::successors(Some(Rational::one()), |power| Some(power * radius));
    let mut rest: Vec<_> = polynomial.iter().zip(powers).map(|(c, power)| c * power).collect();
    let there: Rational = rest.iter().sum();
    let alternating = |(k, c): (usize, &Rational)| if k % 2 == 0 { c.clone() } else { -c };
    let opposite: Rational = rest.iter().rev().enumerate().map(alternating).sum();
    if !there.is_positive() || !opposite.is_positive() {
        return Ok(rest.len() > 1);
    }
    while rest.len() > 1 {
        context.check_cancelled()?;
        let last = rest[rest.len() - 1].clone();
        for c in &mut rest {
            *c /= &last;
        }
        let first = rest[0].clone();
        if first.abs() >= Rational::one() {
            return Ok(true);
        }
        let n = rest.len() - 1;
        rest = (1..=n).map(|k| &rest[k] - &first * &rest[n - k]).collect();
        let bits: u64 = rest.iter().map(|c| c.numer().bits() + c.denom().bits()).sum();
        if bits > MOST_BITS {
            return Ok(false);
        }
    }
    Ok(false)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::curve::rational::ratio;

    #[test]
    fn roots_beyond_a_circle_are_seen() {
        // x² + 1/4: ±i/2.
        let polynomial = [ratio(1, 4), ratio(0, 1), ratio(1, 1)];
        let beyond = |polynomial: &[Rational], p: i64, q: i64| {
            has_root_beyond(&Context::serial(), polynomial, &ratio(p, q)).unwrap()
        };
        assert!(beyond(&polynomial, 1, 2));
        assert!(beyond(&polynomial, 499, 1000));
        assert!(!beyond(&polynomial, 501, 1000));
        // (x − 1/2)(x − 2), and its image.
        for sign in [1, -1] {
            let polynomial = [ratio(1, 1), ratio(-5 * sign, 2), ratio(1, 1)];
            assert!(beyond(&polynomial, 2, 1) && beyond(&polynomial, 1, 1));
            assert!(!beyond(&polynomial, 201, 100));
            // Both roots are beyond, where signs say nothing.
            assert!(beyond(&polynomial, 1, 4));
        }
        // (x − 1)³, and a number, which has no roots.
        let triple = [ratio(-1, 1), ratio(3, 1), ratio(-3, 1), ratio(1, 1)];
        assert!(beyond(&triple, 1, 1) && !beyond(&triple, 1001, 1000));
        assert!(!beyond(&[ratio(1, 1)], 1, 1));
        assert!(beyond(&polynomial, 0, 1) && !beyond(&[ratio(1, 1)], 0, 1));
    }

    #[test]
    fn a_characteristic_polynomial() {
        let rows = [vec![ratio(1, 2), ratio(1, 3)], vec![ratio(1, 1), ratio(-1, 4)]];
        let expected = [ratio(-11, 24), ratio(-1, 4), ratio(1, 1)];
        assert_eq!(Exact::new(&rows).characteristic(), expected);
    }

    #[test]
    fn radii_of_turning_and_growing_matrices() {
        let turn = Dense { size: 2, entries: vec![0.0, -0.5, 0.5, 0.0] };
        assert!((radius(&turn, 0.0).unwrap().0 - 0.5).abs() < 1e-12);
        let shear = Dense { size: 2, entries: vec![0.25, 1.0, 0.0, 0.25] };
        assert!((radius(&shear, 0.0).unwrap().0 - 0.25).abs() < 1e-10);
        assert!(radius(&shear, 0.3).is_none());
    }
}
