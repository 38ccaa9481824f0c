//! The factorisation of a symmetric binary mask into a split and smoothing passes.
//!
//! The averaging family of surfaces holds the tensor squares of all masks that are a split,
//! dual [1,3,3,1]/4 or primal [1,2,1]/2, times filters (a/2, 1 − a, a/2), a = (1 − t)/2, one for
//! each pass M_t. With x = (z + 1/z)/2 a filter is 1 − a + a·x, so what is left of the mask
//! beside the split is a polynomial in x that is 1 at x = 1, and the passes are its roots,
//! t = 1 − 2/(1 − x): the mask is in the family exactly if they are all rational.

use num_traits::{One, Zero};

use super::laurent::Laurent;
use super::mask::Mask;
use super::rational::{Rational, ratio, to_fraction};
use super::roots::rational_roots;
use crate::base::{Error, ErrorKind, Fraction, Result};

/// As many as schemes may have.
const MOST_PASSES: usize = 64;

/// How the faces of a mesh are split.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum CurveSplit {
    /// Doo and Sabin's corner split, `[1,3,3,1]/4`.
    Dual,
    /// The linear quad split, `[1,2,1]/2`.
    Primal,
}

/// A mask of the averaging family: `Scheme::dual(&passes)` or `Scheme::primal(&passes)` is
/// the scheme on meshes whose regular rule is the mask's tensor square.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Factors {
    /// The split.
    pub split: CurveSplit,
    /// The passes t, ascending; the order changes nothing on regular meshes.
    pub passes: Vec<Fraction>,
}

impl Factors {
    /// Finds split and passes of a mask, exactly.
    ///
    /// # Errors
    /// [`ErrorKind::Unsupported`], with the reason: the mask is not binary, not symmetric,
    /// lacks the split's factor, or has more than 64 passes, or passes that are irrational or
    /// complex, or whose terms do not fit 64 bits.
    pub fn of(mask: &Mask) -> Result<Self> {
        if mask.arity() != 2 {
            return Err(refused(&format!("its arity is {}, not 2", mask.arity())));
        }
        if !mask.is_symmetric() {
            return Err(refused("it is not symmetric"));
        }
        let (split, factor, name) = if mask.coefficients().len().is_multiple_of(2) {
            (CurveSplit::Dual, Laurent::from_integers(0, &[1, 3, 3, 1], 4), "[1,3,3,1]/4")
        } else {
            (CurveSplit::Primal, Laurent::from_integers(0, &[1, 2, 1], 2), "[1,2,1]/2")
        };
        let rest = mask.symbol().divided_by(&factor);
        let rest = rest.ok_or_else(|| refused(&format!("{name} is no factor of it")))?;
        let most = 2 * MOST_PASSES + 1;
        if rest.coefficients().len() > most {
            let passes = rest.coefficients().len() / 2;
            let message = format!("it would take {passes}, schemes have {MOST_PASSES} at most");
            return Err(refused(&message));
        }
        let polynomial = in_cosines(&rest);
        let roots = rational_roots(&polynomial);
        if roots.len() + 1 < polynomial.len() {
            let left = polynomial.len() - 1 - roots.len();
            let found = format!("{left} of its {} passes are not rational", polynomial.len() - 1);
            return Err(refused(&found));
        }
        let mut passes: Vec<Rational> = roots.iter().map(pass).collect();
        passes.sort();
        let passes = passes.iter().map(to_fraction).collect::<Option<Vec<_>>>();
        let too_long = || refused("a pass does not fit 64 bits");
        Ok(Self { split, passes: passes.ok_or_else(too_long)? })
    }
}

fn pass(root: &Rational) -> Rational {
    Rational::one() - ratio(2, 1) / (Rational::one() - root)
}

fn refused(reason: &str) -> Error {
    let message = format!("the mask is no split with smoothing passes: {reason}");
    Error::new(ErrorKind::Unsupported, message)
}

/// A symmetric polynomial of odd length as a polynomial in x = (z + 1/z)/2, by ascending
/// powers: zᵏ + z⁻ᵏ is 2·Tₖ(x), Chebyshev's polynomial.
fn in_cosines(symmetric: &Laurent) -> Vec<Rational> {
    let coefficients = symmetric.coefficients();
    let middle = coefficients.len() / 2;
    let mut sum = vec![Rational::zero(); middle + 1];
    let (mut before, mut current) =
        (vec![Rational::zero(), Rational::one()], vec![Rational::one()]);
    for k in 0..=middle {
        let weight = &coefficients[middle + k] * ratio(if k == 0 { 1 } else { 2 }, 1);
        sum.iter_mut().zip(&current).for_each(|(s, c)| *s += c * &weight);
        let next = chebyshev_next(&before, &current);
        before = std::mem::replace(&mut current, next);
    }
    sum
}

/// Tₖ₊₁ = 2x·Tₖ − Tₖ₋₁, where T₋₁ = x.
fn chebyshev_next(before: &[Rational], current: &[Rational]) -> Vec<Rational> {
    let at = |list: &[Rational], i: usize| list.get(i).cloned().unwrap_or_else(Rational::zero);
    let shifted = |i: usize| if i == 0 { Rational::zero() } else { at(current, i - 1) };
    let next = (0..=current.len()).map(|i| shifted(i) * ratio(2, 1) - at(before, i));
    next.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cosines_of_the_filter() {
        // (1/4)(z + 1/z)·(1/2)… : z² + z⁻² = 2·(2x² − 1).
        let symmetric = Laurent::from_integers(-2, &[1, 0, 0, 0, 1], 1);
        assert_eq!(in_cosines(&symmetric), [ratio(-2, 1), ratio(0, 1), ratio(4, 1)]);
        let filter = Laurent::from_integers(-1, &[1, 6, 1], 8);
        assert_eq!(in_cosines(&filter), [ratio(3, 4), ratio(1, 4)]);
    }
}
