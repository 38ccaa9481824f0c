//! What a scheme makes of waves: shrinking and artifacts.
//!
//! Control points on a wave e^(iωj) have the limit Σₙ φ̂(ω + 2πn) e^(i(ω + 2πn)x): the wave times a
//! *gain* φ̂(ω), and ripples between the control points, the *artifacts* (Sabin and Barthe,
//! *Artifacts in recursive subdivision surfaces*, 2003; Augsdörfer, Dodgson and Sabin, *Artifact
//! analysis on B-splines, box-splines and other surfaces defined by quadrilateral polyhedra*, CAGD
//! 28, 2011). So a regular n-gon shrinks to a closed curve about a circle of |φ̂(2π/n)| times its
//! circumradius. φ̂(ω) is the infinite product of a(e^(−iω/mᵏ))/m.

use std::f64::consts::TAU;

use crate::base::{Error, ErrorKind, Result};
use crate::curve::Mask;
use crate::curve::rational::to_f64;

/// Factors of the infinite product: the rest is 1 to rounding.
const FACTORS: u32 = 64;
/// Ripples on either side that are summed.
const RIPPLES: i32 = 64;

/// What becomes of a wave of some control points per period.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Response {
    /// |φ̂(ω)|, the amplitude of the wave in the limit; 1 for data that are kept.
    pub gain: f64,
    /// 1 − gain: the part of the radius that a regular polygon loses. Negative if it grows.
    pub shrink: f64,
    /// The root of the summed squares of the ripples' amplitudes, relative to the gain; infinite
    /// where they are there and the wave is not.
    pub artifact: f64,
}

impl Response {
    /// The response to a wave of `points` control points per period.
    ///
    /// Accurate to about 1e-12; ripples beyond the 64th on either side are left out.
    ///
    /// # Errors
    /// [`ErrorKind::ParameterOutOfRange`] for less than 2 points or what is not finite;
    /// [`ErrorKind::Overflow`] for amplitudes beyond the range of doubles, as masks with
    /// coefficients of hundreds of digits have.
    pub fn of(mask: &Mask, points: f64) -> Result<Self> {
        if !(points.is_finite() && points >= 2.0) {
            let message = format!("{points} points per period: at least 2 are needed");
            return Err(Error::new(ErrorKind::ParameterOutOfRange, message));
        }
        let symbol = FrequencyResponse::new(mask);
        let omega = TAU / points;
        let gain = symbol.limit(omega);
        let ripple = |n: i32| symbol.limit(omega + TAU * f64::from(n)).powi(2);
        let ripples: f64 = (1..=RIPPLES).map(|n| ripple(n) + ripple(-n)).sum();
        if !(gain.is_finite() && ripples.is_finite()) {
            let message = "the amplitude of a wave is beyond the range of doubles";
            return Err(Error::new(ErrorKind::Overflow, message));
        }
        let artifact = if ripples == 0.0 { 0.0 } else { ripples.sqrt() / gain };
        Ok(Self { gain, shrink: 1.0 - gain, artifact })
    }
}

/// A mask as a filter, in double precision.
#[derive(Debug, Clone)]
pub struct FrequencyResponse {
    arity: f64,
    lowest: f64,
    coefficients: Vec<f64>,
}

impl FrequencyResponse {
    /// The filter of a mask.
    pub fn new(mask: &Mask) -> Self {
        let coefficients = mask.coefficients().iter().map(to_f64).collect();
        Self { arity: mask.arity() as f64, lowest: mask.offset() as f64, coefficients }
    }

    /// |φ̂(ω)|: what is left of a wave of ω radians per control point in the limit. Costs 64
    /// times as much as [`FrequencyResponse::mask`].
    pub fn limit(&self, omega: f64) -> f64 {
        let factor = |k: u32| self.mask(omega / libm::pow(self.arity, f64::from(k)));
        (1..=FACTORS).map(factor).product()
    }

    /// |a(e^(−iω))|/m, by which a step multiplies a wave of ω radians per new point; 1 at ω = 0.
    /// Costs two cosines for each coefficient.
    pub fn mask(&self, omega: f64) -> f64 {
        let (mut re, mut im) = (0.0, 0.0);
        for (k, c) in self.coefficients.iter().enumerate() {
            let angle = omega * (self.lowest + k as f64);
            re += c * libm::cos(angle);
            im += c * libm::sin(angle);
        }
        libm::hypot(re, im) / self.arity
    }
}
