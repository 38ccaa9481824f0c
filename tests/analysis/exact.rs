//! Limit weights in exact arithmetic: left eigenvectors to the last digit.

use carvel::analysis::surface::{Feature, LimitWeights, LocalMatrix, Spectrum};
use carvel::base::Weight;
use carvel::{CornerRule, Fraction, Scheme};
use num_rational::BigRational;
use num_traits::{One, ToPrimitive, Zero};
use std::ops::{Add, Mul, Sub};

/// A fraction without limits.
#[derive(Debug, Clone, PartialEq)]
struct Exact(BigRational);

impl Add for Exact {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self(self.0 + other.0)
    }
}

impl Sub for Exact {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self(self.0 - other.0)
    }
}

impl Mul for Exact {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self(self.0 * other.0)
    }
}

fn ratio(num: i64, den: i64) -> BigRational {
    BigRational::new(num.into(), den.into())
}

impl Weight for Exact {
    fn ratio(num: i64, den: i64) -> Self {
        Self(ratio(num, den))
    }

    fn cos_turn(j: usize, n: usize) -> Self {
        let twice = match 12 * (j % n) {
            twelfths if twelfths % n == 0 => [2, 9, 1, 0, -1, 9, -2, 9, -1, 0, 1, 9][twelfths / n],
            _ => 9,
        };
        assert_ne!(twice, 9, "cos(2π·{j}/{n}) is irrational");
        Self(ratio(twice, 2))
    }
}

/// The weights in doubles, each replaced by the nearest of some fractions, and whether they are
/// an exact left eigenvector to the eigenvalue 1 with the sum 1.
fn is_exact_limit(scheme: &Scheme, valence: usize, candidates: &[BigRational]) -> bool {
    let feature = Feature::Interior { valence };
    let double = LocalMatrix::<f64>::new(scheme, feature).unwrap();
    let spectrum = Spectrum::new(&double).unwrap();
    let weights = LimitWeights::new(&double, &spectrum).unwrap().position;
    let nearest = |w: f64| {
        let apart = |c: &BigRational| (c.to_f64().unwrap() - w).abs();
        candidates.iter().min_by(|a, b| apart(a).total_cmp(&apart(b))).unwrap().clone()
    };
    let mut row = Vec::new();
    for orbit in 0..double.orbits() {
        row.extend(weights.orbit(orbit).iter().map(|&w| nearest(w)));
    }
    let matrix = LocalMatrix::<Exact>::new(scheme, feature).unwrap().dense();
    assert_eq!(matrix.len(), row.len());
    for line in &matrix {
        let sum: BigRational = line.iter().map(|w| &w.0).sum();
        assert!(sum.is_one(), "{scheme:?}, n = {valence}: a row sums to {sum}");
    }
    let product = |column: usize| -> BigRational {
        row.iter().zip(&matrix).map(|(w, line)| w * &line[column].0).sum()
    };
    let total: BigRational = row.iter().sum();
    total.is_one() && (0..row.len()).all(|column| product(column) == row[column])
}

#[test]
fn limits_of_dual_schemes_are_exact() {
    let paper = Scheme::three_point(Fraction::new(1, 32).unwrap()).unwrap();
    for (scheme, [corner, side, across], den) in [
        (Scheme::doo_sabin(), [1, 0, 0], 1),
        (paper, [4 * 529, 4 * 23, 4], 2304),
        (Scheme::quartic(), [4 * 121, 4 * 11, 4], 576),
    ] {
        let fractions = |n: i64| {
            let mut list = [corner, side, across].map(|w| ratio(w, den * n)).to_vec();
            list.push(BigRational::zero());
            list
        };
        for n in [3, 4, 6] {
            assert!(is_exact_limit(&scheme, n, &fractions(n as i64)), "{scheme:?}, n = {n}");
        }
        // Averages know no cosine.
        let average = scheme.with_rule(CornerRule::Average);
        for n in [3, 4, 5, 7, 12] {
            assert!(is_exact_limit(&average, n, &fractions(n as i64)), "{average:?}, n = {n}");
        }
    }
}

#[test]
fn limits_of_catmull_clark_are_exact() {
    for n in [3_i64, 4, 5, 7, 11] {
        let mut fractions = [n * n, 4, 1].map(|w| ratio(w, n * (n + 5))).to_vec();
        fractions.push(BigRational::zero());
        assert!(is_exact_limit(&Scheme::catmull_clark(), n as usize, &fractions), "n = {n}");
    }
}

#[test]
fn limits_of_loop_are_exact_where_cosines_are() {
    for (n, beta) in [(3_i64, ratio(3, 16)), (4, ratio(31, 256)), (6, ratio(1, 16))] {
        let near = (ratio(n, 1) + ratio(3, 8) / beta).recip();
        let own = ratio(1, 1) - ratio(n, 1) * &near;
        let fractions = [own, near, BigRational::zero()];
        assert!(is_exact_limit(&Scheme::loop_triangles(), n as usize, &fractions), "n = {n}");
    }
}

/// The check itself: a wrong fraction is found.
#[test]
fn a_wrong_weight_is_no_limit() {
    let mut fractions = [16, 4, 1].map(|w| ratio(w, 36)).to_vec();
    fractions.push(BigRational::zero());
    assert!(is_exact_limit(&Scheme::catmull_clark(), 4, &fractions));
    fractions[1] = ratio(1_000_001, 9_000_000);
    assert!(!is_exact_limit(&Scheme::catmull_clark(), 4, &fractions));
}
