//! All that is known about a scheme, computed.

use num_traits::{One, pow};

use super::contractivity::{Contractivity, MOST_WORK, within};
use super::joint_radius::{Certificate, JointRadius};
use super::reproduction::Degrees;
use super::sum_rules::Smoothing;
use crate::base::{Context, Result};
use crate::curve::rational::{ratio, to_f64};
use crate::curve::{Laurent, Mask, Parametrisation, Rational};

/// How far an analysis goes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Effort {
    /// The largest power L that a proof by contractivity may take.
    pub longest_power: u32,
}

impl Default for Effort {
    fn default() -> Self {
        Self { longest_power: 12 }
    }
}

/// Bounds on the Hölder exponent of the limit: for every α below the exponent the limit is
/// C^α, for none above it if the shifts of φ are stable.
#[derive(Debug, Clone, PartialEq)]
pub struct Holder {
    /// Not above the exponent. Negative for schemes that do not converge.
    pub low: f64,
    /// Not below the exponent.
    pub high: f64,
    /// The radius that the exponent is −log_m of.
    pub radius: JointRadius,
}

/// The analysis of a mask.
#[derive(Debug, Clone, PartialEq)]
pub struct Analysis {
    /// The shift τ = a′(1)/m.
    pub tau: Rational,
    /// Primal, dual or other.
    pub parametrisation: Parametrisation,
    /// True if the mask reads the same from both ends.
    pub is_symmetric: bool,
    /// True if old points are kept.
    pub is_interpolating: bool,
    /// The width of the support of the limit function.
    pub support: Rational,
    /// The factors σ of the symbol and what is left.
    pub smoothing: Smoothing,
    /// The largest k for which C^k is proved, by contractivity or by the Hölder exponent;
    /// `None` if the scheme is not shown to converge.
    pub continuity: Option<usize>,
    /// The proof by contractivity of the largest k that has one.
    pub contractivity: Option<Contractivity>,
    /// Bounds on the Hölder exponent.
    pub holder: Holder,
    /// Degrees of polynomials that are generated and reproduced.
    pub degrees: Degrees,
}

impl Analysis {
    /// Analyses a mask. Milliseconds for usual masks, seconds for long ones; reports
    /// progress to the context and can be cancelled.
    ///
    /// # Errors
    /// [`crate::ErrorKind::Cancelled`].
    pub fn of(context: &Context, mask: &Mask, effort: Effort) -> Result<Self> {
        let smoothing = Smoothing::of(mask);
        let holder = Holder::of(context, mask, &smoothing)?;
        let contractivity = best_contractivity(context, mask, &smoothing, &holder, effort)?;
        let by_holder = below(holder.low).filter(|k| *k < smoothing.factors);
        let by_norm = contractivity.as_ref().map(|proof| proof.continuity);
        let length = mask.coefficients().len() as i64;
        Ok(Self {
            tau: mask.tau(),
            parametrisation: mask.parametrisation(),
            is_symmetric: mask.is_symmetric(),
            is_interpolating: mask.is_interpolating(),
            support: ratio(length - 1, mask.arity() as i64 - 1),
            continuity: by_holder.max(by_norm),
            smoothing,
            contractivity,
            holder,
            degrees: Degrees::of(mask),
        })
    }
}

impl Holder {
    /// Bounds for a mask whose smoothing factors are known.
    ///
    /// # Errors
    /// [`crate::ErrorKind::Cancelled`].
    pub fn of(context: &Context, mask: &Mask, smoothing: &Smoothing) -> Result<Self> {
        let m = mask.arity();
        let shift = surplus(m, &smoothing.kernel);
        if shift > 0 {
            return Self::beyond_doubles(context, m, &smoothing.kernel, shift);
        }
        let radius = JointRadius::of(context, m, &smoothing.kernel)?;
        if let Some(exponent) = radius.exact.as_ref().and_then(|exact| exact_exponent(m, exact)) {
            return Ok(Self { low: exponent, high: exponent, radius });
        }
        // Logarithms are good to a unit or two; this is outwards by more.
        let (low, high) = (exponent(m, radius.high), exponent(m, radius.low));
        let apart = 1e-14 * (1.0 + low.abs());
        Ok(Self { low: low - apart, high: high + apart, radius })
    }

    /// The same for a kernel that doubles are too small for: ρ(mˢK) = mˢρ(K), and the exponent
    /// of mˢK is that of K less s.
    fn beyond_doubles(context: &Context, m: usize, kernel: &Laurent, shift: usize) -> Result<Self> {
        let scale = pow(ratio(m as i64, 1), shift);
        let small = JointRadius::of(context, m, &kernel.scaled(&scale.recip()))?;
        let apart = 1e-14 * (1.0 + shift as f64);
        let bound = |radius: f64, away: f64| exponent(m, radius) - shift as f64 + away;
        let (low, high) = (bound(small.high, -apart), bound(small.low, apart));
        Ok(Self { low, high, radius: small.scaled(&scale) })
    }
}

/// s for a kernel that is to be divided by mˢ, so that doubles hold what is made of it; 0 for
/// all but the most unusual.
fn surplus(m: usize, kernel: &Laurent) -> usize {
    /// Far below the largest double: norms, sums of coefficients, fit as well.
    const MOST_BITS: u64 = 512;
    let bits = |c: &Rational| c.numer().bits().saturating_sub(c.denom().bits());
    let most = kernel.coefficients().iter().map(bits).max().unwrap_or(0);
    most.saturating_sub(MOST_BITS).div_ceil(u64::from(m.ilog2())) as usize
}

/// Of the radius 1 it is 0, which has no sign.
fn exponent(arity: usize, radius: f64) -> f64 {
    -libm::log(radius) / libm::log(arity as f64) + 0.0
}

/// n if the radius is m⁻ⁿ.
fn exact_exponent(arity: usize, radius: &Rational) -> Option<f64> {
    let near = exponent(arity, to_f64(radius)).round();
    let fits = (0.0..=1024.0).contains(&near);
    let power = fits.then(|| pow(ratio(arity as i64, 1), near as usize))?;
    (power * radius).is_one().then_some(near)
}

/// The largest integer k < exponent, if there is one that is not negative.
fn below(exponent: f64) -> Option<usize> {
    (exponent > 0.0).then(|| (exponent.ceil() - 1.0) as usize)
}

fn best_contractivity(
    context: &Context,
    mask: &Mask,
    smoothing: &Smoothing,
    holder: &Holder,
    effort: Effort,
) -> Result<Option<Contractivity>> {
    // Powers of b = m^k·a/σ^(k+1) contract some time exactly if k is below the exponent.
    let Some(most) = below(holder.high) else { return Ok(None) };
    let most = most.min(smoothing.factors.saturating_sub(1));
    // All orders together take no more than some times what one may.
    let work = MOST_WORK.min(4 * MOST_WORK / (most as u64 + 1));
    for k in (0..=most).rev() {
        if let Some(proof) = within(context, mask, k, effort.longest_power, work)? {
            return Ok(Some(proof));
        }
    }
    Ok(None)
}

impl Certificate {
    /// One or two words for a report.
    pub fn name(self) -> &'static str {
        match self {
            Self::Norm => "norm",
            Self::Polytope(_) => "invariant polytope",
            Self::PowerNorm => "norms of powers",
        }
    }
}
