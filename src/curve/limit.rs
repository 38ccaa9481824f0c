//! The limit function, its derivatives and limit stencils, exactly.
//!
//! The limit of control points p is f(x) = Σⱼ pⱼ φ(x − j), where φ = Σₖ aₖ φ(m · − k) is the
//! limit of a single 1 and pⱼ stands at j. At a rational x the values φ(x + j) are those of an
//! eigenvector: x ↦ m·x mod 1 comes back to where it was, and on the way values go into values
//! by matrices of coefficients (Dyn and Levin, *Subdivision schemes in geometric modelling*,
//! 2002, section 2.3). Derivatives are differences of the same of another mask: if a = σ·c,
//! then φ′ = ψ − ψ(· − 1), ψ the limit of m·c.

use num_traits::{One, Zero};

use super::ends::Extent;
use super::laurent::Laurent;
use super::linear;
use super::mask::{Mask, out_of_range};
use super::rational::{Rational, over_common, ratio};
use super::refine::{Polygon, check_overflow, check_points, check_total};
use super::rules::Rules;
use super::step::apply;
use super::{Coordinate, Ends};
use crate::base::{Context, Error, ErrorKind, Result};

/// The most places that x ↦ m·x mod 1 may visit.
const LONGEST_ORBIT: usize = 256;
/// The most values of a sampled function.
const MOST_VALUES: usize = 1 << 20;

/// Weights of control points on one value of the limit, or of a derivative.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LimitStencil {
    /// The index of the first control point.
    pub first: i64,
    /// The weights of it and those after it; neither the first nor the last is 0.
    pub weights: Vec<Rational>,
}

/// The stencil of the `derivative`-th derivative (0: the value) of the limit at parameter
/// `x`, where control point j stands at j; derivatives are by that parameter.
///
/// Right for schemes that are C^`derivative`; for others the eigenvector may exist all the
/// same. Exact; a fraction of a millisecond for usual masks and x with a small denominator.
///
/// # Errors
/// [`ErrorKind::Unsupported`] if the mask has fewer than `derivative + 1` smoothing factors
/// or the equations have no single solution, so that there is no such limit;
/// [`ErrorKind::TooLarge`] if m·x mod 1 takes more than 256 values; [`ErrorKind::Cancelled`].
pub fn limit_stencil(
    context: &Context,
    mask: &Mask,
    x: &Rational,
    derivative: usize,
) -> Result<LimitStencil> {
    let (smooth, psi) = derived(mask, derivative)?;
    let whole = x.floor();
    let values = values_at(context, mask.arity(), &psi, &(x - &whole))?;
    // f(x) = Σ pⱼ φ(x − j) and φ^(r) = Δʳ ψ, so weights are those of Δʳ at mirrored places.
    let weights = &smooth * &values;
    let shift = whole.to_integer();
    let shift = i64::try_from(shift).map_err(|_| out_of_range(format!("{x} is too far off")))?;
    let mirrored = weights.mirrored().shifted(shift);
    Ok(LimitStencil { first: mirrored.lowest(), weights: mirrored.coefficients().to_vec() })
}

/// The differences (1 − z)^r and the mask mʳ·a/σʳ whose limit they are taken of.
fn derived(mask: &Mask, derivative: usize) -> Result<(Laurent, Laurent)> {
    let sigma = Laurent::sigma(mask.arity());
    let (rest, times) = mask.symbol().stripped_of(&sigma, derivative);
    if times < derivative || rest.divided_by(&sigma).is_none() {
        let message = format!("derivative {derivative} needs {} smoothing factors", derivative + 1);
        return Err(Error::new(ErrorKind::Unsupported, message));
    }
    let scale = num_traits::pow(ratio(mask.arity() as i64, 1), derivative);
    let difference = Laurent::from_integers(0, &[1, -1], 1);
    Ok((difference.power(derivative), rest.scaled(&scale)))
}

/// Σ φ(x + j) zʲ for x in [0, 1).
fn values_at(context: &Context, arity: usize, symbol: &Laurent, x: &Rational) -> Result<Laurent> {
    let m = ratio(arity as i64, 1);
    let mut orbit = vec![x.clone()];
    let start = loop {
        let scaled = orbit[orbit.len() - 1].clone() * &m;
        let next = &scaled - scaled.floor();
        if let Some(start) = orbit.iter().position(|place| *place == next) {
            break start;
        }
        if orbit.len() == LONGEST_ORBIT {
            let message = format!("{arity}·x mod 1 takes more than {LONGEST_ORBIT} values");
            return Err(Error::new(ErrorKind::TooLarge, message));
        }
        orbit.push(next);
    };
    let matrices = orbit.iter().map(|place| Transfer::new(arity, symbol, place));
    let matrices: Vec<_> = matrices.collect();
    let cycle = matrices[start..].iter().map(|transfer| transfer.matrix.clone());
    let product = cycle.reduce(|product, matrix| multiply(&product, &matrix));
    let fixed = fixed_vector(context, product.unwrap_or_default())?;
    let before = matrices[..start].iter().rev();
    let values = before.fold(fixed, |values, transfer| times(&transfer.matrix, &values));
    Ok(Laurent::new(matrices[0].lowest, values))
}

type Matrix = Vec<Vec<Rational>>;

/// From the values φ(mx mod 1 + j) to the values φ(x + j), j where x + j is inside of φ's
/// support; a continuous φ is 0 at its ends.
struct Transfer {
    matrix: Matrix,
    lowest: i64,
}

impl Transfer {
    fn new(arity: usize, symbol: &Laurent, x: &Rational) -> Self {
        let m = arity as i64;
        let scaled = x * ratio(m, 1);
        let whole = i64::try_from(scaled.to_integer()).unwrap_or(0);
        let (rows, columns) = (inside(symbol, m, x), inside(symbol, m, &scaled.fract()));
        let entry = |j: i64, i: i64| symbol.at(whole + m * j - i);
        let row = |j: i64| columns.clone().map(|i| entry(j, i)).collect();
        Self { lowest: rows.start, matrix: rows.map(row).collect() }
    }
}

/// The j for which x + j lies between the ends of the support of φ.
fn inside(symbol: &Laurent, m: i64, x: &Rational) -> std::ops::Range<i64> {
    let end = |k: i64| ratio(k, m - 1) - x;
    let floor = |value: Rational| i64::try_from(value.floor().to_integer()).unwrap_or(0);
    let ceil = |value: Rational| i64::try_from(value.ceil().to_integer()).unwrap_or(0);
    let (first, end) = (floor(end(symbol.lowest())) + 1, ceil(end(symbol.highest())));
    first..end.max(first)
}

fn multiply(a: &Matrix, b: &Matrix) -> Matrix {
    let columns = b.first().map_or(0, Vec::len);
    let entry = |row: &[Rational], c: usize| row.iter().zip(b).map(|(x, r)| x * &r[c]).sum();
    a.iter().map(|row| (0..columns).map(|c| entry(row, c)).collect()).collect()
}

fn times(matrix: &Matrix, vector: &[Rational]) -> Vec<Rational> {
    matrix.iter().map(|row| row.iter().zip(vector).map(|(a, b)| a * b).sum()).collect()
}

/// The eigenvector of eigenvalue 1 whose entries sum to 1.
fn fixed_vector(context: &Context, mut matrix: Matrix) -> Result<Vec<Rational>> {
    let unknowns = matrix.len();
    for (i, row) in matrix.iter_mut().enumerate() {
        row[i] -= Rational::one();
        row.push(Rational::zero());
    }
    matrix.push(vec![Rational::one(); unknowns + 1]);
    let solution = if unknowns == 0 { None } else { linear::solve(context, matrix)? };
    solution.ok_or_else(|| {
        let message = "the scheme has no limit here, or no single one".to_owned();
        Error::new(ErrorKind::Unsupported, message)
    })
}

/// Exact values of φ at all multiples of m^−`levels` inside its support: the first multiple
/// and the values from there on.
///
/// # Errors
/// As [`limit_stencil`]; [`ErrorKind::TooLarge`] for more than 2²⁰ values;
/// [`ErrorKind::MemoryCeiling`].
pub fn sample_limit(context: &Context, mask: &Mask, levels: u32) -> Result<(i64, Vec<Rational>)> {
    sample_derivative(context, mask, 0, levels)
}

/// The same for the `derivative`-th derivative of φ, which is 0 at the ends of its support.
///
/// # Errors
/// As [`sample_limit`].
pub fn sample_derivative(
    context: &Context,
    mask: &Mask,
    derivative: usize,
    levels: u32,
) -> Result<(i64, Vec<Rational>)> {
    let m = mask.arity();
    let width = (mask.coefficients().len() - 1).div_ceil(m - 1) + 1;
    let scale = m.checked_pow(levels);
    let count = scale.and_then(|n| n.checked_mul(width));
    if count.is_none_or(|count| count > MOST_VALUES) {
        let message = format!("level {levels}: more than {MOST_VALUES} values");
        return Err(Error::new(ErrorKind::TooLarge, message));
    }
    let (difference, psi) = derived(mask, derivative)?;
    let mut values = values_at(context, m, &psi, &Rational::zero())?;
    context.check_memory(bytes_of(count.unwrap_or(0) as u64, levels, [&psi, &values]))?;
    for level in 0..levels {
        context.check_cancelled()?;
        // φ(i/mᵏ⁺¹) = Σ aₗ φ(i/mᵏ − l): the product with the mask spread out to mᵏ.
        values = &spread(&psi, m.pow(level)) * &values;
    }
    values = &spread(&difference, m.pow(levels)) * &values;
    Ok((values.lowest(), values.coefficients().to_vec()))
}

/// About the memory of so many values after a number of products with a mask: terms as integers
/// and as fractions, with one factor in their denominators from each.
fn bytes_of(count: u64, levels: u32, [mask, values]: [&Laurent; 2]) -> u64 {
    let denominator = |of: &Laurent| over_common(of.coefficients().iter()).1.bits();
    let bits = denominator(mask).saturating_mul(u64::from(levels)) + denominator(values);
    let number = size_of::<Rational>() as u64 + bits / 4;
    count.saturating_mul(2 * number)
}

/// a(z^n).
fn spread(symbol: &Laurent, n: usize) -> Laurent {
    let mut coefficients = vec![Rational::zero(); (symbol.coefficients().len() - 1) * n + 1];
    for (i, c) in symbol.coefficients().iter().enumerate() {
        coefficients[i * n] = c.clone();
    }
    Laurent::new(symbol.lowest() * n as i64, coefficients)
}

impl<T: Coordinate> Polygon<T> {
    /// Points of the limit curve, or its derivatives, at the parameters of this polygon's
    /// points: of point j that is j + τ/(m − 1) on the scale where φ has its knots.
    ///
    /// One point for each of the polygon. Ends that are dropped or kept are so here; where
    /// a derivative is asked for, anchors have none. Derivatives are by a parameter that
    /// grows by 1 from point to point.
    ///
    /// # Errors
    /// As [`limit_stencil`] and [`Polygon::refine`].
    pub fn limit(&self, context: &Context, mask: &Mask, derivative: usize) -> Result<Self> {
        let rules = limit_rules(context, mask, derivative)?;
        check_points(&self.points, self.width)?;
        let extent = Extent::of(&rules, self.ends, self.len())?;
        let (count, ends) = with_anchors(&extent, derivative);
        let anchors = (count - extent.made) / 2 * self.width;
        check_total(context, count, self.width, T::BYTES)?;
        let size = count * self.width;
        let mut points = T::zeros(size)?;
        apply(context, &rules, &self.source(), &extent, &mut points[anchors..size - anchors])?;
        if derivative == 0 && matches!(ends, Ends::Anchored | Ends::Kept) {
            points[..self.width].clone_from_slice(self.point(0));
            points[size - self.width..].clone_from_slice(self.point(self.len() - 1));
        }
        check_overflow(&self.points, rules.norm(), &points, self.width)?;
        Ok(Self { points, width: self.width, ends })
    }

    /// The number of points, and the ends, of [`Polygon::limit`] for so many points.
    ///
    /// # Errors
    /// As [`Polygon::limit`], without those of coordinates and memory.
    pub fn predict_limit(
        context: &Context,
        mask: &Mask,
        points: usize,
        ends: Ends,
        derivative: usize,
    ) -> Result<(usize, Ends)> {
        let rules = limit_rules::<f64>(context, mask, derivative)?;
        Ok(with_anchors(&Extent::of(&rules, ends, points)?, derivative))
    }
}

/// The rule of points of the limit, or of its derivatives.
fn limit_rules<T: Coordinate>(
    context: &Context,
    mask: &Mask,
    derivative: usize,
) -> Result<Rules<T>> {
    let place = mask.tau() / ratio(mask.arity() as i64 - 1, 1);
    let stencil = limit_stencil(context, mask, &place, derivative)?;
    let taps = stencil.weights.iter().map(T::from_rational).zip(stencil.first..);
    Ok(Rules::single(taps, mask.is_symmetric()))
}

/// The points and ends of a limit: anchors stay where they are, and have no derivatives.
fn with_anchors(extent: &Extent, derivative: usize) -> (usize, Ends) {
    match extent.ends {
        Ends::Anchored if derivative == 0 => (extent.made + 2, Ends::Anchored),
        Ends::Anchored => (extent.made, Ends::Dropped),
        ends => (extent.made, ends),
    }
}
