//! The joint spectral radius of a scheme's kernel: how fast its coefficients can grow.
//!
//! The kernel K is the symbol without smoothing factors. Its rules act on windows of
//! s = ⌈(length − 1)/(m − 1)⌉ consecutive values by m matrices A_e of size s, entries
//! K at D − e + row − m·column (D the degree), and lim ‖S_Kᴸ‖^(1/L) is their joint spectral radius ρ
//! (Rota and Strang 1960; Rioul 1992, Daubechies and Lagarias 1992 for subdivision).
//!
//! * Below: ρ ≥ ρ(P)^(1/n) for every product P of n matrices. The product is looked for in
//!   doubles; that its characteristic polynomial has a root as large as claimed is proved in
//!   exact arithmetic.
//! * Above: an invariant polytope of the matrices scaled by 1/(ρ(1 + ε)), with ε as small as it
//!   is found for. All roundings are counted.
//! * Where the norm of one step, the largest row or column sum, is an eigenvalue of a matrix,
//!   ρ is that rational number.

use num_traits::{One, Signed, Zero};

use super::polytope::Polytope;
use super::spectral::{Dense, Exact, has_root_beyond};
use super::words::{Word, leading_words};
use crate::base::{Context, Error, ErrorKind, Result};
use crate::curve::rational::{from_f64, to_f64};
use crate::curve::{Laurent, Rational};

/// The largest window that matrices are made for.
const LARGEST_WINDOW: usize = 48;
/// How far above the growth that was found a polytope is tried, in turn.
const MARGINS: [f64; 9] = [1e-9, 1e-6, 1e-4, 1e-3, 4e-3, 2e-2, 1e-1, 0.5, 2.0];
/// The most multiplications for one polytope.
const MOST_WORK: u64 = 100_000_000;

/// What proves the upper bound.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Certificate {
    /// A norm of one step that is an eigenvalue as well: the radius is exact.
    Norm,
    /// A polytope of so many pairs of vertices that the matrices map into itself.
    Polytope(usize),
    /// Norms of powers alone; where windows are too large for anything better.
    PowerNorm,
}

/// Bounds on a joint spectral radius.
#[derive(Debug, Clone, PartialEq)]
pub struct JointRadius {
    /// Not above the radius; the largest double where it is beyond.
    pub low: f64,
    /// Not below the radius; infinite where no double is.
    pub high: f64,
    /// The radius itself where it is known as a rational number.
    pub exact: Option<Rational>,
    /// The product that proves the lower bound: matrices by e, applied last to first.
    pub word: Vec<usize>,
    /// What proves the upper bound.
    pub certificate: Certificate,
}

impl JointRadius {
    /// Bounds on the joint spectral radius of the scheme of a kernel, its shift of no
    /// importance.
    ///
    /// Milliseconds for the usual masks, some seconds at most; the work is limited, and if a
    /// polytope is not found the bounds are apart. Reports progress.
    ///
    /// # Errors
    /// [`ErrorKind::ParameterOutOfRange`] for the kernel 0 or an arity below 2;
    /// [`ErrorKind::Cancelled`].
    pub fn of(context: &Context, arity: usize, kernel: &Laurent) -> Result<Self> {
        if kernel.is_zero() || arity < 2 {
            let message =
                format!("no scheme: arity {arity}, {} coefficients", kernel.coefficients().len());
            return Err(Error::new(ErrorKind::ParameterOutOfRange, message));
        }
        context.report(0.0)?;
        let degree = kernel.coefficients().len() - 1;
        let window = degree.div_ceil(arity - 1).max(1);
        if window > LARGEST_WINDOW {
            return by_power_norms(context, arity, kernel);
        }
        let matrices: Vec<_> = (0..arity).map(|e| matrix(arity, kernel, window, e)).collect();
        match by_norm(context, &matrices)? {
            Some(exact) => Ok(exact),
            None => by_polytope(context, &matrices),
        }
    }
}

impl JointRadius {
    /// The radius of `scale` times the kernel, a positive number.
    pub(super) fn scaled(self, scale: &Rational) -> Self {
        let times = |bound: f64| from_f64(bound).map_or(f64::INFINITY, |x| to_f64(&(x * scale)));
        Self {
            // Outwards by more than what the product is rounded.
            low: (times(self.low) * (1.0 - 1e-15)).min(f64::MAX),
            high: times(self.high) * (1.0 + 1e-15),
            exact: self.exact.map(|exact| exact * scale),
            ..self
        }
    }
}

fn matrix(arity: usize, kernel: &Laurent, window: usize, e: usize) -> Vec<Vec<Rational>> {
    let (m, degree) = (arity as i64, kernel.coefficients().len() as i64 - 1);
    let entry = |r: i64, c: i64| kernel.at(kernel.lowest() + degree - e as i64 + r - m * c);
    let size = window as i64;
    (0..size).map(|r| (0..size).map(|c| entry(r, c)).collect()).collect()
}

/// The radius, if the largest row or column sum is the absolute value of an eigenvalue.
fn by_norm(context: &Context, matrices: &[Vec<Vec<Rational>>]) -> Result<Option<JointRadius>> {
    let sum = |row: &Vec<Rational>| row.iter().map(Signed::abs).sum::<Rational>();
    let rows = matrices.iter().flatten().map(sum).max().unwrap_or_else(Rational::zero);
    let column = |a: &Vec<Vec<Rational>>, c: usize| a.iter().map(|row| row[c].abs()).sum();
    let all = |a| (0..matrices[0].len()).map(move |c| column(a, c));
    let columns: Rational = matrices.iter().flat_map(all).max().unwrap_or_else(Rational::zero);
    let norm = rows.min(columns);
    for (e, rows) in matrices.iter().enumerate() {
        context.check_cancelled()?;
        let polynomial = Exact::new(rows).characteristic();
        let value =
            |at: &Rational| polynomial.iter().rev().fold(Rational::zero(), |v, c| v * at + c);
        if value(&norm).is_zero() || value(&-&norm).is_zero() {
            let near = to_f64(&norm);
            let is_exact = from_f64(near).is_some_and(|near| near == norm);
            let apart = if is_exact { 0.0 } else { 1e-15 };
            return Ok(Some(JointRadius {
                low: near.min(f64::MAX) * (1.0 - apart),
                high: near * (1.0 + apart),
                exact: Some(norm),
                word: vec![e],
                certificate: Certificate::Norm,
            }));
        }
    }
    Ok(None)
}

/// Matrices scaled to entries near 1, so that doubles neither overflow nor vanish, and the
/// products of them that grow most.
struct Search<'a> {
    exact: &'a [Vec<Vec<Rational>>],
    largest: Rational,
    dense: Vec<Dense>,
    words: Vec<Word>,
}

impl<'a> Search<'a> {
    fn new(context: &Context, exact: &'a [Vec<Vec<Rational>>]) -> Result<Self> {
        let largest = exact.iter().flatten().flatten().map(Signed::abs).max();
        let largest = largest.unwrap_or_else(Rational::one);
        let entry = |a: &Rational| to_f64(&(a / &largest));
        let dense = |rows: &Vec<Vec<Rational>>| Dense {
            size: rows.len(),
            entries: rows.iter().flatten().map(entry).collect(),
        };
        let dense: Vec<Dense> = exact.iter().map(dense).collect();
        let words = leading_words(context, &dense)?;
        Ok(Self { exact, largest, dense, words })
    }

    /// The growth of the leading words, an estimate.
    fn growth(&self) -> f64 {
        self.words.first().map_or(0.0, |word| word.growth)
    }

    /// The norm of one step, rounded up.
    fn norm(&self) -> f64 {
        let norm = self.dense.iter().map(Dense::norm).fold(0.0, f64::max);
        norm * (1.0 + 1e-14 * self.dense[0].size as f64)
    }

    /// det(x − P) of the product that grows most, and the power of the largest entry that
    /// belongs to its length.
    fn leading_product(&self) -> Option<(Vec<Rational>, Rational, usize)> {
        let word = self.words.first()?;
        let factors = word.letters.iter().map(|&i| Exact::new(&self.exact[i]));
        let product = factors.reduce(|product, factor| product.product(&factor))?;
        let length = word.letters.len();
        let scale = num_traits::pow(self.largest.clone(), length);
        Some((product.characteristic(), scale, length))
    }

    /// A growth a little below that of the leading word, proved.
    fn low(&self, context: &Context) -> Result<f64> {
        let Some((polynomial, scale, length)) = self.leading_product() else { return Ok(0.0) };
        for below in [1e-11, 1e-9, 1e-7, 1e-5, 1e-3, 1e-1] {
            context.check_cancelled()?;
            let growth = self.growth() * (1.0 - below);
            // Near the smallest doubles powers are rounded by more than is taken off below.
            let radius = Some(libm::pow(growth, length as f64)).filter(|radius| radius.is_normal());
            let Some(radius) = radius.and_then(from_f64).map(|radius| radius * &scale) else {
                continue;
            };
            if has_root_beyond(context, &polynomial, &radius)? {
                // The power is rounded, by less than what is taken off here.
                return Ok(growth * (1.0 - 1e-14));
            }
        }
        Ok(0.0)
    }

    /// A bound from above.
    fn high(&self, context: &Context) -> Result<(f64, Certificate)> {
        let norm = self.norm();
        // Matrices of which no product grows still need a scale.
        let growth = if self.growth() > 0.0 { self.growth() } else { norm * 1e-6 };
        for (i, margin) in MARGINS.iter().enumerate() {
            context.report(0.4 + 0.6 * i as f64 / MARGINS.len() as f64)?;
            let target = growth * (1.0 + margin);
            if target >= norm {
                break;
            }
            if let Some(found) = self.polytope(target) {
                return Ok(found);
            }
        }
        Ok((norm, Certificate::PowerNorm))
    }

    /// A bound at or a little above a target, if a polytope is found for it.
    fn polytope(&self, target: f64) -> Option<(f64, Certificate)> {
        let factor = 1.0 / target;
        let scaled: Vec<Dense> = self.dense.iter().map(|a| a.scaled(factor)).collect();
        let start = leading_vectors(&self.dense, &self.words, self.growth());
        let mut polytope = Polytope::around(self.dense[0].size, &start, MOST_WORK);
        let bound = polytope.close(&scaled)?;
        Some((bound / factor * (1.0 + 1e-15), Certificate::Polytope(polytope.vertices())))
    }
}

fn by_polytope(context: &Context, exact: &[Vec<Vec<Rational>>]) -> Result<JointRadius> {
    let search = Search::new(context, exact)?;
    context.report(0.3)?;
    let low = search.low(context)?;
    let (high, certificate) = search.high(context)?;
    let scale = to_f64(&search.largest);
    Ok(JointRadius {
        low: low * scale * (1.0 - 1e-15),
        high: high * scale * (1.0 + 1e-15),
        exact: None,
        word: search.words.into_iter().next().map_or_else(Vec::new, |word| word.letters),
        certificate,
    })
}

/// The side of a threshold on which a joint spectral radius lies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Side {
    Below,
    AtLeast,
    /// Neither is proved.
    Open,
}

/// Compares the joint spectral radius of the scheme of a kernel with a threshold; cheaper
/// than bounds that are as close as can be.
///
/// # Errors
/// As [`JointRadius::of`].
pub(super) fn side_of(
    context: &Context,
    arity: usize,
    kernel: &Laurent,
    threshold: &Rational,
) -> Result<Side> {
    let window = (kernel.coefficients().len() - 1).div_ceil(arity - 1).max(1);
    if window > LARGEST_WINDOW {
        let bounds = by_power_norms(context, arity, kernel)?;
        let at = to_f64(threshold);
        let low_or_open = if bounds.low > at { Side::AtLeast } else { Side::Open };
        return Ok(if bounds.high < at { Side::Below } else { low_or_open });
    }
    let matrices: Vec<_> = (0..arity).map(|e| matrix(arity, kernel, window, e)).collect();
    if let Some(exact) = by_norm(context, &matrices)?.and_then(|radius| radius.exact) {
        return Ok(if exact < *threshold { Side::Below } else { Side::AtLeast });
    }
    let search = Search::new(context, &matrices)?;
    let Some((polynomial, _, length)) = search.leading_product() else { return Ok(Side::Open) };
    if has_root_beyond(context, &polynomial, &num_traits::pow(threshold.clone(), length))? {
        return Ok(Side::AtLeast);
    }
    // Relative to the largest entry, rounded down.
    let limit = to_f64(&(threshold / &search.largest)) * (1.0 - 1e-15);
    let target = (search.growth() * limit).sqrt();
    let found = (target < limit).then(|| search.polytope(target)).flatten();
    Ok(if found.is_some_and(|(high, _)| high < limit) { Side::Below } else { Side::Open })
}

/// The directions that grow most under the leading words and their rotations.
fn leading_vectors(matrices: &[Dense], words: &[Word], growth: f64) -> Vec<Vec<f64>> {
    let mut vectors = Vec::new();
    for word in words {
        for mut vector in independent_columns(&word.power) {
            for &letter in word.letters.iter().rev() {
                vectors.push(vector.clone());
                vector = matrices[letter].times(&vector);
                for x in &mut vector {
                    *x /= growth;
                }
            }
        }
    }
    vectors
}

/// Columns of a matrix of low rank, scaled to largest entry 1, that span it.
fn independent_columns(matrix: &Dense) -> Vec<Vec<f64>> {
    const ALIGNED: f64 = 1e-6;
    let n = matrix.size;
    let column = |c: usize| (0..n).map(|r| matrix.entries[r * n + c]).collect::<Vec<f64>>();
    let mut columns: Vec<Vec<f64>> = (0..n).map(column).collect();
    let size = |v: &[f64]| v.iter().copied().map(f64::abs).fold(0.0, f64::max);
    let mut found = Vec::new();
    let mut threshold = 0.0;
    while found.len() < 2 {
        let largest = columns.iter().cloned().max_by(|a, b| size(a).total_cmp(&size(b)));
        let Some(chosen) = largest.filter(|chosen| size(chosen) > threshold) else { break };
        threshold = threshold.max(ALIGNED * size(&chosen));
        let length: f64 = chosen.iter().map(|x| x * x).sum();
        for other in &mut columns {
            let part = other.iter().zip(&chosen).map(|(x, y)| x * y).sum::<f64>() / length;
            other.iter_mut().zip(&chosen).for_each(|(x, y)| *x -= part * y);
        }
        let scale = 1.0 / size(&chosen);
        found.push(chosen.iter().map(|x| x * scale).collect());
    }
    found
}

/// Where windows are large: the least ‖S_Kᴸ‖^(1/L) from above, the largest coefficient that
/// maps a place to itself from below.
fn by_power_norms(context: &Context, arity: usize, kernel: &Laurent) -> Result<JointRadius> {
    const LONGEST: u32 = 6;
    let mut high = f64::INFINITY;
    for (power, norm) in (1..=LONGEST).zip(super::contractivity::PowerNorms::new(arity, kernel)) {
        context.report(f64::from(power) / f64::from(LONGEST + 1))?;
        let root = libm::pow(to_f64(&norm), 1.0 / f64::from(power)) * (1.0 + 1e-14);
        high = high.min(root);
    }
    // The first and the last coefficient are eigenvalues: the ends of what a 1 becomes.
    let ends = [kernel.coefficients().first(), kernel.coefficients().last()];
    let low = ends.into_iter().flatten().map(|c| to_f64(&c.abs())).fold(0.0, f64::max);
    let low = low * (1.0 - 1e-15);
    Ok(JointRadius {
        low,
        high,
        exact: None,
        word: Vec::new(),
        certificate: Certificate::PowerNorm,
    })
}
