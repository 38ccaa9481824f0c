//! The basis of a tensor product along one axis: values and derivatives on one interval.
//!
//! The points p₀ … pₙ₋₁ that a mask of n + 1 coefficients takes for an interval, x in [0, 1]
//! there, become for either half those of M₀ or M₁, (M_ε)ⱼᵢ = a_{j+ε+n−1−2i}. The binary digits
//! of x name the matrices of a product whose last factor, where no digits are left, is the
//! limit at the interval's start. Derivatives are those of the difference schemes,
//! 2a(z)/(1 + z) on differences of points (Dyn, Gregory and Levin 1991): each factor has
//! rows of sum 1, so that no rounding error grows. B-splines have a recurrence instead
//! (de Boor 1972, uniform knots).

use crate::base::{Error, ErrorKind, Result};
use crate::scheme::{Method, Scheme};

/// Derivatives that are evaluated.
pub(super) const ORDERS: usize = 3;
/// Digits of a number that are looked at: a change in the next moves nothing.
const DIGITS: usize = 60;
/// Steps after which a scheme has to have shown that it is smooth.
const STEPS: u32 = 8;
/// Rounds of a power iteration.
const ROUNDS: usize = 2000;
/// Sums of coefficients that are rounding errors.
const ROUNDING: f64 = 1e-12;

/// A scheme along one axis of a regular grid.
#[derive(Debug, Clone)]
pub(super) enum Univariate {
    /// B-splines of a degree.
    Spline(usize),
    /// Any mask: itself, then its difference schemes as far as they converge.
    Mask(Vec<Digits>),
}

impl Univariate {
    /// The scheme's mask; for Loop, which has none, nothing.
    ///
    /// # Errors
    /// [`ErrorKind::Unsupported`] if points do not converge.
    pub(super) fn new(scheme: &Scheme) -> Result<Option<Self>> {
        let start: &[f64] = match scheme.method() {
            Method::Loop => return Ok(None),
            Method::CatmullClark => return Ok(Some(Self::Spline(3))),
            Method::Dual => &[0.25, 0.75, 0.75, 0.25],
            Method::Primal => &[0.5, 1.0, 0.5],
        };
        let passes = scheme.passes();
        if passes.iter().all(|t| t.numerator() == 0) {
            return Ok(Some(Self::Spline(start.len() - 2 + 2 * passes.len())));
        }
        let mut mask = start.to_vec();
        for t in passes {
            let a = (1.0 - t.to_f64()) / 2.0;
            mask = product(&mask, &[a / 2.0, 1.0 - a, a / 2.0]);
        }
        let mut orders = Vec::new();
        while orders.len() < ORDERS {
            let Some(quotient) = quotient(&mask) else { break };
            if !is_contractive(&quotient) {
                break;
            }
            orders.push(Digits::new(&mask)?);
            mask = quotient.iter().map(|b| 2.0 * b).collect();
        }
        if orders.is_empty() {
            let message = "points of the scheme are not known to converge on regular grids";
            return Err(Error::new(ErrorKind::Unsupported, message));
        }
        Ok(Some(Self::Mask(orders)))
    }

    /// Orders of derivatives that exist: 0 if only the position does. B-splines have those of
    /// their polynomials, from either side of a knot.
    pub(super) fn derivatives(&self) -> usize {
        match self {
            Self::Spline(_) => ORDERS - 1,
            Self::Mask(orders) => orders.len() - 1,
        }
    }

    /// Weights of the points of an interval for a derivative at x in [0, 1].
    pub(super) fn taps(&self, x: f64, order: usize, taps: &mut Vec<f64>) {
        taps.clear();
        match self {
            Self::Spline(degree) if *degree < order => {
                taps.resize(degree + 1, 0.0);
                return;
            }
            Self::Spline(degree) => spline(x, degree - order, taps),
            Self::Mask(orders) => orders[order].taps(x, taps),
        }
        for _ in 0..order {
            // Weights of differences become weights of points.
            taps.push(0.0);
            for i in (0..taps.len()).rev() {
                let before = if i > 0 { taps[i - 1] } else { 0.0 };
                taps[i] = before - taps[i];
            }
        }
    }
}

/// The uniform B-splines of a degree on [0, 1].
fn spline(x: f64, degree: usize, taps: &mut Vec<f64>) {
    taps.push(1.0);
    for k in 1..=degree {
        taps.push(0.0);
        let order = k as f64;
        for j in (0..=k).rev() {
            let before = if j > 0 { taps[j - 1] } else { 0.0 };
            let at = j as f64;
            taps[j] = ((x + order - at) * before + (at + 1.0 - x) * taps[j]) / order;
        }
    }
}

/// A mask as the matrices of the two halves of an interval.
#[derive(Debug, Clone)]
pub(super) struct Digits {
    points: usize,
    /// By rows.
    halves: [Vec<f64>; 2],
    /// The limit at the start of the interval.
    start: Vec<f64>,
}

impl Digits {
    fn new(mask: &[f64]) -> Result<Self> {
        let n = mask.len() - 1;
        let half = |half: usize| {
            let entry = |j: usize, i: usize| {
                (j + half + n - 1).checked_sub(2 * i).and_then(|at| mask.get(at)).copied()
            };
            let row = |j: usize| (0..n).map(move |i| entry(j, i).unwrap_or(0.0));
            (0..n).flat_map(row).collect::<Vec<f64>>()
        };
        let mut digits = Self { points: n, halves: [half(0), half(1)], start: Vec::new() };
        let mut row = vec![1.0 / n as f64; n];
        for _ in 0..ROUNDS {
            row = digits.times(&row, 0);
            let sum: f64 = row.iter().sum();
            for weight in &mut row {
                *weight /= sum;
            }
        }
        let next = digits.times(&row, 0);
        let moved = row.iter().zip(&next).fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()));
        if moved.is_nan() || moved > ROUNDING {
            let message = "points of the scheme do not converge on regular grids";
            return Err(Error::new(ErrorKind::Unsupported, message));
        }
        digits.start = row;
        Ok(digits)
    }

    /// A row vector times the matrix of a half.
    fn times(&self, row: &[f64], half: usize) -> Vec<f64> {
        let mut product = vec![0.0; self.points];
        for (factor, entries) in row.iter().zip(self.halves[half].chunks(self.points)) {
            product.iter_mut().zip(entries).for_each(|(sum, entry)| *sum += factor * entry);
        }
        product
    }

    fn taps(&self, mut x: f64, taps: &mut Vec<f64>) {
        let (mut digits, mut count) = ([0; DIGITS], 0);
        while x > 0.0 && count < DIGITS {
            x *= 2.0;
            if x >= 1.0 {
                digits[count] = 1;
                x -= 1.0;
            }
            count += 1;
        }
        let mut row = self.start.clone();
        for &digit in digits[..count].iter().rev() {
            row = self.times(&row, digit);
        }
        taps.extend(row);
    }
}

/// The product of two polynomials.
fn product(a: &[f64], b: &[f64]) -> Vec<f64> {
    let mut product = vec![0.0; a.len() + b.len() - 1];
    for (i, x) in a.iter().enumerate() {
        for (j, y) in b.iter().enumerate() {
            product[i + j] += x * y;
        }
    }
    product
}

/// A polynomial over 1 + z, if it divides it.
fn quotient(mask: &[f64]) -> Option<Vec<f64>> {
    let mut quotient = Vec::new();
    let mut before = 0.0;
    for &a in mask {
        before = a - before;
        quotient.push(before);
    }
    let rest = quotient.pop()?;
    (rest.abs() <= ROUNDING && !quotient.is_empty()).then_some(quotient)
}

/// True if some power of a scheme for differences makes them smaller.
fn is_contractive(mask: &[f64]) -> bool {
    let mut power = mask.to_vec();
    (1..=STEPS).any(|steps| {
        let arity = 1 << steps;
        let sum = |first: usize| power.iter().skip(first).step_by(arity).map(|b| b.abs()).sum();
        let norm = (0..arity).map(sum).fold(0.0, f64::max);
        // The next power: b(z) times this one of z².
        let mut spread = vec![0.0; 2 * power.len() - 1];
        power.iter().enumerate().for_each(|(i, &b)| spread[2 * i] = b);
        power = product(mask, &spread);
        norm < 1.0
    })
}
