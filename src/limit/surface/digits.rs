//! Values of a refinable function between integers, by the binary digits of the place.

use super::univariate::ROUNDING;
use crate::base::{Error, ErrorKind, Result};
use crate::scheme::MOST_PASSES;

/// Digits of a number that are looked at: a change in the next moves nothing.
const DIGITS: u32 = 60;
/// Points of the widest mask.
const MOST_POINTS: usize = 2 * MOST_PASSES + 4;
/// Rounds of a power iteration.
const ROUNDS: usize = 2000;

/// A mask as the matrices of the two halves of an interval, and of the parts that some digits
/// after each other name.
#[derive(Debug, Clone)]
pub(super) struct Digits {
    points: usize,
    /// Digits that are looked up together; a divisor of [`DIGITS`].
    together: u32,
    /// For all numbers of so many digits the product of their matrices, by rows.
    products: Vec<f64>,
    /// The limit at the start of the interval.
    start: Vec<f64>,
}

impl Digits {
    pub(super) fn new(mask: &[f64]) -> Result<Self> {
        let n = mask.len() - 1;
        let half = |half: usize| {
            let entry = |j: usize, i: usize| {
                (j + half + n - 1).checked_sub(2 * i).and_then(|at| mask.get(at)).copied()
            };
            let row = |j: usize| (0..n).map(move |i| entry(j, i).unwrap_or(0.0));
            (0..n).flat_map(row).collect::<Vec<f64>>()
        };
        let halves = [half(0), half(1)];
        let start = limit(n, &halves[0])?;
        // Large tables would take longer to read than they save.
        let together = match n {
            0..=8 => 6,
            9..=16 => 4,
            _ => 1,
        };
        let mut products = Vec::new();
        for number in 0_u32..1 << together {
            // The last digit's matrix comes first.
            let mut product = halves[(number & 1) as usize].clone();
            for digit in 1..together {
                let matrix = &halves[(number >> digit & 1) as usize];
                product = product.chunks_exact(n).flat_map(|row| times(row, matrix)).collect();
            }
            products.extend(product);
        }
        Ok(Self { points: n, together, products, start })
    }

    /// How many points have weights.
    pub(super) fn points(&self) -> usize {
        self.points
    }

    /// Weights of as many points at x in [0, 1].
    pub(super) fn taps(&self, x: f64, taps: &mut [f64]) {
        match self.points {
            // Loops of a known length are unrolled.
            4 => self.walk::<4>(4, x, taps),
            5 => self.walk::<5>(5, x, taps),
            n => self.walk::<MOST_POINTS>(n, x, taps),
        }
    }

    /// The same for `n` points, at most `N`.
    #[inline(always)]
    fn walk<const N: usize>(&self, n: usize, x: f64, taps: &mut [f64]) {
        const ALL: u64 = (1 << DIGITS) - 1;
        let taps = &mut taps[..n];
        taps.copy_from_slice(&self.start);
        // Exact but for digits beyond; 1 is 0.111…
        let mut digits = ((x * (ALL + 1) as f64) as u64).min(ALL);
        let mut left = DIGITS;
        if digits == 0 {
            return;
        }
        // Zeros at the end change nothing: they keep the start of an interval.
        let zeros = digits.trailing_zeros() / self.together * self.together;
        (digits, left) = (digits >> zeros, left - zeros);
        while left > 0 {
            let number = (digits & ((1 << self.together) - 1)) as usize;
            let matrix = &self.products[number * n * n..][..n * n];
            let mut row = [0.0; N];
            for (factor, entries) in taps.iter().zip(matrix.chunks_exact(n)) {
                row.iter_mut().zip(entries).for_each(|(sum, x)| *sum += factor * x);
            }
            taps.copy_from_slice(&row[..n]);
            (digits, left) = (digits >> self.together, left - self.together);
        }
    }
}

/// A row vector times a square matrix.
fn times(row: &[f64], matrix: &[f64]) -> Vec<f64> {
    let mut product = vec![0.0; row.len()];
    for (factor, entries) in row.iter().zip(matrix.chunks_exact(row.len())) {
        product.iter_mut().zip(entries).for_each(|(sum, x)| *sum += factor * x);
    }
    product
}

/// The row vector of sum 1 that the matrix of a first half keeps.
fn limit(n: usize, half: &[f64]) -> Result<Vec<f64>> {
    let mut row = vec![1.0 / n as f64; n];
    for _ in 0..ROUNDS {
        row = times(&row, half);
        let sum: f64 = row.iter().sum();
        for weight in &mut row {
            *weight /= sum;
        }
    }
    let next = times(&row, half);
    let moved = row.iter().zip(&next).fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()));
    if moved.is_nan() || moved > ROUNDING {
        let message = "points of the scheme do not converge on regular grids";
        return Err(Error::new(ErrorKind::Unsupported, message));
    }
    Ok(row)
}
