//! The masks of the families, by their formulas, in exact arithmetic.

use num_traits::{One, Zero, pow};

use super::super::laurent::Laurent;
use super::super::mask::{Mask, check_length, out_of_range};
use super::super::rational::{Rational, ratio};
use crate::base::Result;

/// The largest degree, size or number of points of a family.
const LARGEST: i64 = 64;

/// A parameter that counts something.
fn count(value: &Rational, name: &str, least: i64) -> Result<usize> {
    let whole = value.is_integer().then(|| i64::try_from(value.to_integer()).ok()).flatten();
    let fits = whole.filter(|n| (least..=LARGEST).contains(n));
    let complaint =
        || out_of_range(format!("{name} = {value} is no integer in {least}..={LARGEST}"));
    fits.map(|n| n as usize).ok_or_else(complaint)
}

fn centred(arity: usize, symbol: &Laurent) -> Result<Mask> {
    Mask::centred(arity, symbol.coefficients().to_vec())
}

/// The mask −w, 0, ½ + w, 1, … of the interpolating binary rule on the odd points: weights of
/// t+1, t+2, … (those of t, t−1, … are the same).
fn interpolating(half: &[Rational]) -> Result<Mask> {
    let mut coefficients = Vec::new();
    for w in half.iter().rev() {
        coefficients.extend([w.clone(), Rational::zero()]);
    }
    *coefficients.last_mut().ok_or_else(|| out_of_range("no weights".to_owned()))? =
        Rational::one();
    for (i, w) in half.iter().enumerate() {
        let between = (i > 0).then(Rational::zero);
        coefficients.extend(between.into_iter().chain([w.clone()]));
    }
    Mask::new(2, 1 - 2 * half.len() as i64, coefficients)
}

/// σ^(d+1)/m^d (Lane and Riesenfeld 1980).
pub(super) fn b_spline(p: &[Rational]) -> Result<Mask> {
    let degree = count(&p[0], "degree", 1)?;
    let arity = count(&p[1], "arity", 2)?;
    check_length((degree + 1) * (arity - 1) + 1)?;
    let scale = pow(ratio(1, arity as i64), degree);
    centred(arity, &Laurent::sigma(arity).power(degree + 1).scaled(&scale))
}

pub(super) fn chaikin(_: &[Rational]) -> Result<Mask> {
    b_spline(&[ratio(2, 1), ratio(2, 1)])
}

pub(super) fn de_rham(_: &[Rational]) -> Result<Mask> {
    corner_cutting(&[ratio(1, 3), ratio(1, 3)])
}

/// Every edge is cut at α from its start and β from its end: [α, 1 − β, 1 − α, β].
pub(super) fn corner_cutting(p: &[Rational]) -> Result<Mask> {
    let (a, b, one) = (&p[0], &p[1], Rational::one());
    Mask::new(2, -2, vec![a.clone(), &one - b, &one - a, b.clone()])
}

/// [−w, 0, ½ + w, 1, ½ + w, 0, −w].
pub(super) fn four_point(p: &[Rational]) -> Result<Mask> {
    interpolating(&[ratio(1, 2) + &p[0], -&p[0]])
}

/// [θ, 0, −(1/16 + 3θ), 0, 9/16 + 2θ, 1, …].
pub(super) fn weissman(p: &[Rational]) -> Result<Mask> {
    let t = &p[0];
    interpolating(&[ratio(9, 16) + t * ratio(2, 1), -(ratio(1, 16) + t * ratio(3, 1)), t.clone()])
}

/// [−5w, −7w, ¼ + 3w, ¾ + 9w, …].
pub(super) fn dyn_floater_hormann(p: &[Rational]) -> Result<Mask> {
    let w = |k: i64| &p[0] * ratio(k, 1);
    let half = [w(-5), w(-7), ratio(1, 4) + w(3), ratio(3, 4) + w(9)];
    Mask::centred(2, half.iter().chain(half.iter().rev()).cloned().collect())
}

/// [w, ¼ + w, ¾ − 2w, ¾ − 2w, ¼ + w, w].
pub(super) fn three_point(p: &[Rational]) -> Result<Mask> {
    let w = &p[0];
    let half = [w.clone(), ratio(1, 4) + w, ratio(3, 4) - w * ratio(2, 1)];
    Mask::new(2, -3, half.iter().chain(half.iter().rev()).cloned().collect())
}

pub(super) fn hassan_dodgson_approximating(_: &[Rational]) -> Result<Mask> {
    b_spline(&[ratio(3, 1), ratio(3, 1)])
}

/// p₃ₜ₊₁ = b pₜ₋₁ + (⅔ − 2b) pₜ + (b + ⅓) pₜ₊₁.
pub(super) fn hassan_dodgson_interpolating(p: &[Rational]) -> Result<Mask> {
    let b = &p[0];
    let outer = [b.clone(), Rational::zero(), b + ratio(1, 3), ratio(2, 3) - b * ratio(2, 1)];
    symmetric_about_one(3, &outer)
}

/// a₀ = −1/18 − μ/6, a₁ = 13/18 + μ/2, a₂ = 7/18 − μ/2, a₃ = −1/18 + μ/6 of t−1 … t+2 on
/// point 3t + 1.
pub(super) fn ternary_four_point(p: &[Rational]) -> Result<Mask> {
    let mu = &p[0];
    let (sixth, half) = (mu * ratio(1, 6), mu * ratio(1, 2));
    let outer = [
        ratio(-1, 18) + &sixth,
        ratio(-1, 18) - &sixth,
        Rational::zero(),
        ratio(7, 18) - &half,
        ratio(13, 18) + &half,
    ];
    symmetric_about_one(3, &outer)
}

fn symmetric_about_one(arity: usize, outer: &[Rational]) -> Result<Mask> {
    let right = outer.iter().rev().cloned();
    let all = outer.iter().cloned().chain([Rational::one()]).chain(right);
    Mask::new(arity, -(outer.len() as i64), all.collect())
}

/// (1+z)^k/2^(k−1) · (−k + (2k+8)z − kz²)/8.
pub(super) fn hormann_sabin(p: &[Rational]) -> Result<Mask> {
    let k = count(&p[0], "k", 1)?;
    let i = k as i64;
    let kernel = Laurent::from_integers(0, &[-i, 2 * i + 8, -i], 8);
    let spline = Laurent::sigma(2).power(k).scaled(&pow(ratio(1, 2), k - 1));
    centred(2, &(&spline * &kernel))
}

/// n over k for a rational n.
fn binomial(n: &Rational, k: usize) -> Rational {
    (0..k as i64).map(|i| (n - ratio(i, 1)) / ratio(i + 1, 1)).product()
}

/// Σ_(j ≤ l) C(top, j) δʲ σ^(l−j), σ = (1+z)²/4z, δ = −(1−z)²/4z.
fn pseudo_spline_sum(top: &Rational, l: usize) -> Laurent {
    let sigma = Laurent::from_integers(-1, &[1, 2, 1], 4);
    let delta = Laurent::from_integers(-1, &[-1, 2, -1], 4);
    let term = |j: usize| (&delta.power(j) * &sigma.power(l - j)).scaled(&binomial(top, j));
    (0..=l).map(term).fold(Laurent::new(0, Vec::new()), |sum, term| &sum + &term)
}

fn pseudo_spline(p: &[Rational], extra: &Rational, split: &Laurent) -> Result<Mask> {
    let m = count(&p[0], "m", 1)?;
    let l = count(&p[1], "l", 0)?;
    if l >= m {
        return Err(out_of_range(format!("l = {l} is not below m = {m}")));
    }
    let sigma = Laurent::from_integers(-1, &[1, 2, 1], 4);
    let top = ratio((m + l) as i64, 1) + extra;
    centred(2, &(&(split * &sigma.power(m)) * &pseudo_spline_sum(&top, l)))
}

/// 2 σ^m Σ_(j ≤ l) C(m+l, j) δʲ σ^(l−j).
pub(super) fn primal_pseudo_spline(p: &[Rational]) -> Result<Mask> {
    pseudo_spline(p, &Rational::zero(), &Laurent::from_integers(0, &[2], 1))
}

/// (1+z) σ^m Σ_(j ≤ l) C(m+½+l, j) δʲ σ^(l−j).
pub(super) fn dual_pseudo_spline(p: &[Rational]) -> Result<Mask> {
    pseudo_spline(p, &ratio(1, 2), &Laurent::sigma(2))
}

/// (1+z)^(2m−3) [w, 2^(4−2m) − 2w, w].
pub(super) fn m_point(p: &[Rational]) -> Result<Mask> {
    let m = count(&p[0], "m", 2)?;
    let w = &p[1];
    let middle = pow(ratio(1, 4), m - 2) - w * ratio(2, 1);
    let kernel = Laurent::new(0, vec![w.clone(), middle, w.clone()]);
    let symbol = &Laurent::sigma(2).power(2 * m - 3) * &kernel;
    let all = symbol.coefficients().len();
    // With w = 0 two coefficients are missing, one at either end.
    Mask::new(2, -(all as i64 / 2), symbol.coefficients().to_vec())
}

/// Lagrange's weights of integer nodes at `x`.
fn lagrange(nodes: std::ops::RangeInclusive<i64>, x: &Rational) -> Vec<Rational> {
    let weight = |i: i64| {
        let others = nodes.clone().filter(move |&j| j != i);
        others.map(|j| (x - ratio(j, 1)) / ratio(i - j, 1)).product()
    };
    nodes.clone().map(weight).collect()
}

/// The mask whose new point m·t + e is the value at t + (e − shift)/m of the polynomial
/// through the old points around.
fn interpolation(
    arity: usize,
    nodes: &std::ops::RangeInclusive<i64>,
    residues: impl Iterator<Item = (i64, Rational)>,
) -> Result<Mask> {
    let m = arity as i64;
    let count = nodes.clone().count() * arity;
    check_length(count)?;
    // Point m·t + e takes a_(e − m·j) of point t + j.
    let lowest = -m * nodes.end() - m;
    let mut coefficients = vec![Rational::zero(); count + 2 * arity];
    for (e, x) in residues {
        for (j, weight) in nodes.clone().zip(lagrange(nodes.clone(), &x)) {
            coefficients[(e - m * j - lowest) as usize] = weight;
        }
    }
    let symbol = Laurent::new(lowest, coefficients);
    Mask::new(arity, symbol.lowest(), symbol.coefficients().to_vec())
}

/// 2n points, arity m, interpolating (Deslauriers and Dubuc 1989).
pub(super) fn deslauriers_dubuc(p: &[Rational]) -> Result<Mask> {
    let n = count(&p[0], "n", 1)? as i64;
    let arity = count(&p[1], "arity", 2)?;
    let at = |e: i64| (e, ratio(e, arity as i64));
    interpolation(arity, &(1 - n..=n), (0..arity as i64).map(at))
}

/// 2b + 4 points at t = e/n.
pub(super) fn even_point_interpolating(p: &[Rational]) -> Result<Mask> {
    let points = ratio(count(&p[0], "b", 0)? as i64 + 2, 1);
    deslauriers_dubuc(&[points, p[1].clone()])
}

/// 2b + 4 points at t = (2e + 1)/(2n).
pub(super) fn even_point_approximating(p: &[Rational]) -> Result<Mask> {
    let b = count(&p[0], "b", 0)? as i64;
    let arity = count(&p[1], "arity", 2)?;
    let at = |e: i64| (e, ratio(2 * e + 1, 2 * arity as i64));
    interpolation(arity, &(-(b + 1)..=b + 2), (0..arity as i64).map(at))
}

/// 2n + 1 points, odd arity, interpolating.
pub(super) fn odd_point(p: &[Rational]) -> Result<Mask> {
    let n = count(&p[0], "n", 1)? as i64;
    let arity = count(&p[1], "arity", 3)?;
    if arity.is_multiple_of(2) {
        return Err(out_of_range(format!("arity {arity} is not odd")));
    }
    let half = arity as i64 / 2;
    let at = |e: i64| (e, ratio(e, arity as i64));
    interpolation(arity, &(-n..=n), (-half..=half).map(at))
}
