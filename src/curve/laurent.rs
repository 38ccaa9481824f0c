//! Laurent polynomials in one variable with exact rational coefficients.
//!
//! The symbol of a mask is one: a(z) = Σ aₖ zᵏ, k from `lowest` on.

use std::ops::{Add, Mul, Sub};

use num_bigint::BigInt;
use num_integer::Integer as _;
use num_traits::{One, Zero, pow};

use super::rational::{Rational, over_common, ratio};

/// A Laurent polynomial; neither the first nor the last coefficient is 0.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Laurent {
    lowest: i64,
    coefficients: Vec<Rational>,
}

impl Laurent {
    /// Σ cᵢ z^(lowest + i); zeros at both ends are taken off.
    pub fn new(lowest: i64, mut coefficients: Vec<Rational>) -> Self {
        let used = coefficients.iter().rposition(|c| !c.is_zero()).map_or(0, |last| last + 1);
        coefficients.truncate(used);
        let skipped = coefficients.iter().take_while(|c| c.is_zero()).count();
        coefficients.drain(..skipped);
        let lowest = if coefficients.is_empty() { 0 } else { lowest + skipped as i64 };
        Self { lowest, coefficients }
    }

    /// The same from small integers over a denominator.
    ///
    /// # Panics
    /// If `den` is 0.
    pub fn from_integers(lowest: i64, numerators: &[i64], den: i64) -> Self {
        Self::new(lowest, numerators.iter().map(|&n| ratio(n, den)).collect())
    }

    /// 1.
    pub fn one() -> Self {
        Self::from_integers(0, &[1], 1)
    }

    /// The smoothing factor σ = 1 + z + … + z^(m−1).
    pub fn sigma(arity: usize) -> Self {
        Self::new(0, vec![Rational::one(); arity])
    }

    /// True for 0.
    pub fn is_zero(&self) -> bool {
        self.coefficients.is_empty()
    }

    /// The lowest exponent; 0 for the polynomial 0.
    pub fn lowest(&self) -> i64 {
        self.lowest
    }

    /// The highest exponent; −1 for the polynomial 0.
    pub fn highest(&self) -> i64 {
        self.lowest + self.coefficients.len() as i64 - 1
    }

    /// All coefficients from the lowest exponent to the highest.
    pub fn coefficients(&self) -> &[Rational] {
        &self.coefficients
    }

    /// The coefficient of z^k; 0 outside.
    pub fn at(&self, k: i64) -> Rational {
        let index = usize::try_from(k - self.lowest).ok();
        index.and_then(|i| self.coefficients.get(i)).cloned().unwrap_or_else(Rational::zero)
    }

    /// The sum of all coefficients, the value at 1.
    pub fn sum(&self) -> Rational {
        self.coefficients.iter().sum()
    }

    /// Every coefficient times a number.
    #[must_use]
    pub fn scaled(&self, factor: &Rational) -> Self {
        Self::new(self.lowest, self.coefficients.iter().map(|c| c * factor).collect())
    }

    /// Times z^k.
    #[must_use]
    pub fn shifted(&self, k: i64) -> Self {
        Self::new(self.lowest + k, self.coefficients.clone())
    }

    /// To the power `n`.
    #[must_use]
    pub fn power(&self, n: usize) -> Self {
        (0..n).fold(Self::one(), |product, _| &product * self)
    }

    /// The polynomial at z⁻¹.
    #[must_use]
    pub fn mirrored(&self) -> Self {
        Self::new(-self.highest(), self.coefficients.iter().rev().cloned().collect())
    }

    /// True if the coefficients read the same from both ends.
    pub fn is_symmetric(&self) -> bool {
        self.coefficients.iter().eq(self.coefficients.iter().rev())
    }

    /// The n-th derivative at 1: Σ k(k−1)…(k−n+1) aₖ.
    pub fn derivative_at_one(&self, n: usize) -> Rational {
        let (whole, common) = over_common(self.coefficients.iter());
        let falling = |k: i64| (0..n as i64).map(|i| BigInt::from(k - i)).product::<BigInt>();
        let terms = whole.into_iter().zip(self.lowest..);
        Rational::new(terms.map(|(c, k)| c * falling(k)).sum(), common)
    }

    /// The quotient by a polynomial, up to a power of z, if there is no remainder.
    ///
    /// The quotient's exponents are such that quotient · divisor is the polynomial itself.
    /// `None` for a divisor 0. O(length of the quotient · length of the divisor).
    pub fn divided_by(&self, divisor: &Self) -> Option<Self> {
        let (quotient, times) = self.divided(divisor, 1);
        (times == 1).then_some(quotient)
    }

    /// Divides as often as there is no remainder, `most` times at most: the quotient and
    /// how often. Nothing is divided by a unit (a single term), or in 0.
    pub fn stripped_of(&self, divisor: &Self, most: usize) -> (Self, usize) {
        let may = !self.is_zero() && divisor.coefficients.len() > 1;
        self.divided(divisor, if may { most } else { 0 })
    }

    /// The same by any divisor, in integers, which have no common factors to be looked for.
    fn divided(&self, divisor: &Self, most: usize) -> (Self, usize) {
        let (whole, denominator) = over_common(divisor.coefficients.iter());
        let content = whole.iter().fold(BigInt::zero(), |all, c| all.gcd(c));
        let primitive: Vec<BigInt> = whole.iter().map(|c| c / &content).collect();
        let (mut rest, common) = over_common(self.coefficients.iter());
        let mut times = 0;
        while times < most
            && let Some(quotient) = quotient(&rest, &primitive)
        {
            (rest, times) = (quotient, times + 1);
        }
        let scale = pow(Rational::new(denominator, content.max(BigInt::one())), times);
        let (numerator, common) = (scale.numer(), common * scale.denom());
        let coefficients = rest.into_iter().map(|c| Rational::new(c * numerator, common.clone()));
        let lowest = self.lowest - divisor.lowest * times as i64;
        (Self::new(lowest, coefficients.collect()), times)
    }
}

/// The quotient of polynomials by falling powers, if there is no remainder. The divisor's
/// coefficients have no common factor: the quotient's are integers then (Gauss).
fn quotient(dividend: &[BigInt], divisor: &[BigInt]) -> Option<Vec<BigInt>> {
    let leading = divisor.first()?;
    let length = (dividend.len() + 1).saturating_sub(divisor.len());
    let mut rest = dividend.to_vec();
    let mut quotient = Vec::with_capacity(length);
    for i in 0..length {
        let (factor, left) = rest[i].div_rem(leading);
        if !left.is_zero() {
            return None;
        }
        if !factor.is_zero() {
            for (value, d) in rest[i..].iter_mut().zip(divisor) {
                *value -= d * &factor;
            }
        }
        quotient.push(factor);
    }
    rest.iter().all(Zero::is_zero).then_some(quotient)
}

impl Mul for &Laurent {
    type Output = Laurent;

    fn mul(self, other: &Laurent) -> Laurent {
        if self.is_zero() || other.is_zero() {
            return Laurent::new(0, Vec::new());
        }
        let ((a, over), (b, under)) =
            (over_common(self.coefficients.iter()), over_common(other.coefficients.iter()));
        let mut product = vec![BigInt::zero(); a.len() + b.len() - 1];
        for (i, a) in a.iter().enumerate().filter(|(_, a)| !a.is_zero()) {
            for (sum, b) in product[i..].iter_mut().zip(&b) {
                *sum += a * b;
            }
        }
        let common = over * under;
        let coefficients = product.into_iter().map(|c| Rational::new(c, common.clone()));
        Laurent::new(self.lowest + other.lowest, coefficients.collect())
    }
}

impl Add for &Laurent {
    type Output = Laurent;

    fn add(self, other: &Laurent) -> Laurent {
        if self.is_zero() || other.is_zero() {
            return if self.is_zero() { other.clone() } else { self.clone() };
        }
        let lowest = self.lowest.min(other.lowest);
        let highest = self.highest().max(other.highest());
        Laurent::new(lowest, (lowest..=highest).map(|k| self.at(k) + other.at(k)).collect())
    }
}

impl Sub for &Laurent {
    type Output = Laurent;

    fn sub(self, other: &Laurent) -> Laurent {
        self + &other.scaled(&ratio(-1, 1))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn products_divide_exactly_and_others_do_not() {
        let a = Laurent::from_integers(-2, &[1, 3, 3, 1], 4);
        let b = Laurent::from_integers(1, &[1, 0, -5], 3);
        let product = &a * &b;
        assert_eq!(product.divided_by(&a), Some(b.clone()));
        assert_eq!(product.divided_by(&b), Some(a.clone()));
        assert_eq!(a.divided_by(&b), None);
        assert_eq!(b.divided_by(&a), None);
        let (rest, times) = a.stripped_of(&Laurent::sigma(2), 9);
        assert_eq!((rest.coefficients().len(), times), (1, 3));
        assert_eq!(rest.lowest(), -2);
    }

    #[test]
    fn sums_meet_at_their_exponents() {
        let a = Laurent::from_integers(-1, &[1, 2], 1);
        let b = Laurent::from_integers(1, &[5], 1);
        assert_eq!(&a + &b, Laurent::from_integers(-1, &[1, 2, 5], 1));
        assert!((&a - &a).is_zero());
        assert_eq!(a.mirrored(), Laurent::from_integers(0, &[2, 1], 1));
        assert_eq!(Laurent::from_integers(2, &[1, 1], 1).derivative_at_one(2), ratio(8, 1));
    }
}
