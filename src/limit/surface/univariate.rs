//! The basis of a tensor product along one axis: values and derivatives on one interval.
//!
//! The points p₀ … pₙ₋₁ that a mask of n + 1 coefficients takes for an interval, x in [0, 1]
//! there, become for either half those of M₀ or M₁, (M_ε)ⱼᵢ = a_{j+ε+n−1−2i}. The binary digits
//! of x name the matrices of a product whose last factor, where no digits are left, is the
//! limit at the interval's start. Derivatives are those of the difference schemes,
//! 2a(z)/(1 + z) on differences of points (Dyn, Gregory and Levin 1991): each factor has
//! rows of sum 1, so that no rounding error grows. B-splines have a recurrence instead
//! (de Boor 1972, uniform knots).

use super::digits::Digits;
use crate::base::simd::Number;
use crate::base::{Error, ErrorKind, Result};
use crate::scheme::{Method, Scheme};

/// Derivatives that are evaluated.
pub(super) const ORDERS: usize = 3;
/// Steps after which a scheme has to have shown that it is smooth.
const STEPS: u32 = 8;
/// Sums of coefficients that are rounding errors.
pub(super) const ROUNDING: f64 = 1e-12;

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

    /// Weights of the points of an interval at x in [0, 1], for the position and then for as many
    /// derivatives as `taps` has room for: `orders` times as many as there are points.
    pub(super) fn taps(&self, x: f64, orders: usize, taps: &mut [f64]) {
        let n = taps.len() / orders;
        match self {
            // Loops of a known length are unrolled.
            Self::Spline(2) => spline(2, x, &mut taps[..3 * orders]),
            Self::Spline(3) => {
                let cubic = cubic::<f64, ORDERS>(x);
                taps.copy_from_slice(&cubic.as_flattened()[..4 * orders]);
            }
            Self::Spline(4) => spline(4, x, &mut taps[..5 * orders]),
            Self::Spline(degree) => spline(*degree, x, taps),
            Self::Mask(of) => {
                for (digits, taps) in of.iter().zip(taps.chunks_exact_mut(n)) {
                    let (differences, _) = taps.split_at_mut(digits.points());
                    digits.taps(x, differences);
                }
            }
        }
        if matches!(self, Self::Spline(3)) {
            return;
        }
        for (order, taps) in taps.chunks_exact_mut(n).enumerate() {
            for len in n - order.min(n)..n {
                differences(&mut taps[..=len]);
            }
        }
    }
}

/// Makes weights of differences weights of the points, one more.
#[inline(always)]
fn differences(taps: &mut [f64]) {
    let last = taps.len() - 1;
    taps[last] = 0.0;
    for i in (0..taps.len()).rev() {
        let before = if i > 0 { taps[i - 1] } else { 0.0 };
        taps[i] = before - taps[i];
    }
}

/// The uniform cubic B-splines on [0, 1] and their derivatives, of which there are fewer than
/// `ORDERS`. Each is a short polynomial in the distance from the end that it vanishes at or
/// is next to, so that what is zero there is so exactly, and both ends mirror each other.
#[inline(always)]
pub(super) fn cubic<N: Number, const ORDERS: usize>(x: N) -> [[N; 4]; ORDERS] {
    let zero = N::all(0.0);
    let y = N::all(1.0) - x;
    let [xx, yy] = [x * x, y * y];
    let mut taps = [[zero; 4]; ORDERS];
    for order in 0..ORDERS {
        taps[order] = match order {
            0 => [
                yy * y * (1.0 / 6.0),
                xx * (x * 0.5 + -1.0) + 2.0 / 3.0,
                yy * (y * 0.5 + -1.0) + 2.0 / 3.0,
                xx * x * (1.0 / 6.0),
            ],
            1 => [yy * -0.5, x * (x * 1.5 + -2.0), y * (y * -1.5 + 2.0), xx * 0.5],
            _ => [y, x * 3.0 + -2.0, y * 3.0 + -2.0, x],
        };
    }
    taps
}

/// The uniform B-splines of a degree on [0, 1], and those of lower degrees, each in its own
/// `degree` + 1 places.
#[inline(always)]
fn spline(degree: usize, x: f64, taps: &mut [f64]) {
    let n = degree + 1;
    let orders = taps.len() / n;
    taps[0] = 1.0;
    for k in 1..=degree {
        if degree + 1 - k < orders {
            for j in 0..k {
                taps[(degree + 1 - k) * n + j] = taps[j];
            }
        }
        taps[k] = 0.0;
        let order = k as f64;
        for j in (0..=k).rev() {
            let before = if j > 0 { taps[j - 1] } else { 0.0 };
            let at = j as f64;
            taps[j] = ((x + order - at) * before + (at + 1.0 - x) * taps[j]) / order;
        }
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
