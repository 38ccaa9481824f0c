//! Scalars of the reference: doubles, and exact rationals.

use std::fmt::Debug;
use std::ops::{Add, Mul, Sub};

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{FromPrimitive, One, ToPrimitive, Zero};

/// A point or vector of three coordinates.
pub type Point<N> = [N; 3];

/// What the reference needs of a number.
pub trait Number:
    Clone + Debug + PartialEq + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self>
{
    /// The nearest number to an exact one.
    fn from_exact(value: &BigRational) -> Self;

    /// cos(2πj/n).
    ///
    /// # Panics
    /// In exact arithmetic, where the cosine is irrational.
    fn cos_turn(j: usize, n: usize) -> Self;

    fn to_double(&self) -> f64;

    /// `p / q`.
    fn ratio(p: i64, q: i64) -> Self {
        Self::from_exact(&ratio(p, q))
    }

    fn nought() -> Self {
        Self::ratio(0, 1)
    }

    fn unit() -> Self {
        Self::ratio(1, 1)
    }

    /// Σ wᵢ xᵢ.
    fn dot(terms: &[(&Self, &Self)]) -> Self {
        let products = terms.iter().map(|&(w, x)| w.clone() * x.clone());
        products.fold(Self::nought(), |sum, x| sum + x)
    }
}

/// The exact fraction `p / q`.
pub fn ratio(p: i64, q: i64) -> BigRational {
    BigRational::new(p.into(), q.into())
}

/// The exact value of a finite double.
pub fn exact(x: f64) -> BigRational {
    BigRational::from_f64(x).expect("a finite double is a fraction")
}

/// Reads `7/2`, `-1` and the like.
pub fn parse_fraction(text: &str) -> BigRational {
    text.parse().unwrap_or_else(|e| panic!("{text} is no fraction: {e}"))
}

impl Number for f64 {
    fn from_exact(value: &BigRational) -> Self {
        value.to_f64().expect("a fraction in the range of doubles")
    }

    fn cos_turn(j: usize, n: usize) -> Self {
        (std::f64::consts::TAU * j as f64 / n as f64).cos()
    }

    fn to_double(&self) -> f64 {
        *self
    }
}

impl Number for BigRational {
    fn from_exact(value: &BigRational) -> Self {
        value.clone()
    }

    fn cos_turn(j: usize, n: usize) -> Self {
        // The turn in twelfths: n divides 12 exactly where the cosine may be
        // rational, but a twelfth itself (n = 12) is not.
        match (n, (j % n) * 12 / n) {
            (1 | 2 | 3 | 4 | 6, twelfths) => match twelfths {
                0 => ratio(1, 1),
                2 | 10 => ratio(1, 2),
                3 | 9 => BigRational::zero(),
                4 | 8 => ratio(-1, 2),
                _ => ratio(-1, 1),
            },
            _ => panic!("cos(2π·{j}/{n}) has no exact value here: use n = 3, 4, 6 or `Average`"),
        }
    }

    fn to_double(&self) -> f64 {
        f64::from_exact(self)
    }

    /// Over one common denominator, reduced once: tests run without
    /// optimisation, and the default reduces at every product and sum.
    fn dot(terms: &[(&Self, &Self)]) -> Self {
        let terms: Vec<_> = terms.iter().filter(|(w, x)| !w.is_zero() && !x.is_zero()).collect();
        let below = |(w, x): &(&Self, &Self)| w.denom() * x.denom();
        let common = terms.iter().fold(BigInt::one(), |common, term| {
            let own = below(term);
            // common / own in lowest terms has the factor that own lacks.
            let missing = Self::new(own, common.clone()).numer().clone();
            common * missing
        });
        let over = |&&(w, x): &&(&Self, &Self)| w.numer() * x.numer() * (&common / below(&(w, x)));
        Self::new(terms.iter().map(over).sum(), common)
    }
}

/// Σ wᵢ xᵢ of points.
pub fn combine<'a, N: Number + 'a>(terms: impl IntoIterator<Item = (N, &'a Point<N>)>) -> Point<N> {
    let terms: Vec<_> = terms.into_iter().collect();
    std::array::from_fn(|k| N::dot(&terms.iter().map(|(w, x)| (w, &x[k])).collect::<Vec<_>>()))
}

pub fn add<N: Number>(x: &Point<N>, y: &Point<N>) -> Point<N> {
    std::array::from_fn(|k| x[k].clone() + y[k].clone())
}

pub fn scale<N: Number>(w: &N, x: &Point<N>) -> Point<N> {
    std::array::from_fn(|k| w.clone() * x[k].clone())
}

/// The mean of some points.
pub fn mean<'a, N: Number + 'a>(points: impl IntoIterator<Item = &'a Point<N>>) -> Point<N> {
    let points: Vec<_> = points.into_iter().collect();
    let w = N::ratio(1, points.len() as i64);
    combine(points.into_iter().map(|x| (w.clone(), x)))
}

/// `p·x + q·y` with small integer fractions `p = (a, b)` for `a / b`.
pub fn blend<N: Number>(p: (i64, i64), x: &Point<N>, q: (i64, i64), y: &Point<N>) -> Point<N> {
    combine([(N::ratio(p.0, p.1), x), (N::ratio(q.0, q.1), y)])
}
