//! Laurent polynomials in two variables, and C^k of bivariate schemes.

use std::collections::BTreeMap;
use std::ops::{Add, Mul};

use num_traits::{One, Signed, Zero, pow};

use crate::base::{Context, Result};
use crate::curve::rational::ratio;
use crate::curve::{GridMask, Laurent, Rational};

/// The most terms of a product that norms are taken of.
const MOST_TERMS: usize = 1 << 16;

/// Σ c_ij z₁ⁱ z₂ʲ; no coefficient that is kept is 0.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Bivariate {
    terms: BTreeMap<[i64; 2], Rational>,
}

impl Bivariate {
    /// The polynomial with some terms; terms of one exponent are added up.
    pub fn new(terms: impl IntoIterator<Item = ([i64; 2], Rational)>) -> Self {
        let mut it = Self::default();
        terms.into_iter().for_each(|(at, c)| it.add_term(at, c));
        it
    }

    /// a(z₁)·b(z₂).
    pub fn tensor(a: &Laurent, b: &Laurent) -> Self {
        &Self::along(a, 0) * &Self::along(b, 1)
    }

    /// A polynomial in one of the variables, the first (0) or the second (1).
    ///
    /// # Panics
    /// If there is no such variable.
    pub fn along(a: &Laurent, variable: usize) -> Self {
        let place = |k: i64| {
            let mut at = [0, 0];
            at[variable] = k;
            at
        };
        let terms = (a.lowest()..).zip(a.coefficients());
        Self::new(terms.map(|(k, c)| (place(k), c.clone())))
    }

    /// The symbol of a bivariate mask.
    pub fn symbol(mask: &GridMask) -> Self {
        Self::new(mask.terms().map(|(at, c)| (at, c.clone())))
    }

    /// All terms by ascending exponents.
    pub fn terms(&self) -> impl Iterator<Item = ([i64; 2], &Rational)> {
        self.terms.iter().map(|(at, c)| (*at, c))
    }

    /// The coefficient of z₁ⁱ z₂ʲ.
    pub fn at(&self, at: [i64; 2]) -> Rational {
        self.terms.get(&at).cloned().unwrap_or_else(Rational::zero)
    }

    /// True for 0.
    pub fn is_zero(&self) -> bool {
        self.terms.is_empty()
    }

    /// Every coefficient times a number.
    #[must_use]
    pub fn scaled(&self, factor: &Rational) -> Self {
        Self::new(self.terms().map(|(at, c)| (at, c * factor)))
    }

    /// The polynomial at z₁^m, z₂^n.
    #[must_use]
    pub fn spread(&self, [m, n]: [i64; 2]) -> Self {
        Self::new(self.terms().map(|([i, j], c)| ([i * m, j * n], c.clone())))
    }

    /// The quotient, if there is no remainder; `None` for a divisor 0.
    pub fn divided_by(&self, divisor: &Self) -> Option<Self> {
        let (&top, leading) = divisor.terms.last_key_value()?;
        let (low, high) = match (self.corners(), divisor.corners()) {
            (None, _) => return Some(self.clone()),
            (Some((a, b)), Some((c, d))) => {
                ([a[0] - c[0], a[1] - c[1]], [b[0] - d[0], b[1] - d[1]])
            }
            (_, None) => return None,
        };
        let (mut rest, mut quotient) = (self.clone(), Self::default());
        while let Some((&at, c)) = rest.terms.last_key_value() {
            let place = [at[0] - top[0], at[1] - top[1]];
            // A quotient has no exponents beyond those of the corners.
            if (0..2).any(|v| place[v] < low[v] || place[v] > high[v]) {
                return None;
            }
            let factor = c / leading;
            for ([i, j], d) in divisor.terms() {
                rest.add_term([place[0] + i, place[1] + j], -(d * &factor));
            }
            quotient.add_term(place, factor);
        }
        Some(quotient)
    }

    /// The lowest and the highest exponents of both variables.
    fn corners(&self) -> Option<([i64; 2], [i64; 2])> {
        let least = |v: usize| self.terms.keys().map(move |at| at[v]).min();
        let most = |v: usize| self.terms.keys().map(move |at| at[v]).max();
        Some(([least(0)?, least(1)?], [most(0)?, most(1)?]))
    }

    fn add_term(&mut self, at: [i64; 2], c: Rational) {
        let sum = self.terms.entry(at).or_insert_with(Rational::zero);
        *sum += c;
        if sum.is_zero() {
            self.terms.remove(&at);
        }
    }

    /// The largest sum of absolute coefficients in a pair of residue classes.
    fn class_norm(&self, [m, n]: [i64; 2]) -> Rational {
        let mut sums: BTreeMap<[i64; 2], Rational> = BTreeMap::new();
        for ([i, j], c) in self.terms() {
            let class = [i.rem_euclid(m), j.rem_euclid(n)];
            *sums.entry(class).or_insert_with(Rational::zero) += c.abs();
        }
        sums.into_values().max().unwrap_or_else(Rational::zero)
    }
}

impl Mul for &Bivariate {
    type Output = Bivariate;

    fn mul(self, other: &Bivariate) -> Bivariate {
        let times = |([i, j], a): ([i64; 2], Rational)| {
            other.terms().map(move |([k, l], b)| ([i + k, j + l], &a * b))
        };
        Bivariate::new(self.terms().flat_map(|(at, a)| times((at, a.clone()))))
    }
}

impl Add for &Bivariate {
    type Output = Bivariate;

    fn add(self, other: &Bivariate) -> Bivariate {
        Bivariate::new(self.terms().chain(other.terms()).map(|(at, c)| (at, c.clone())))
    }
}

/// That a bivariate scheme is C^`continuity`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct GridContractivity {
    /// The order k.
    pub continuity: usize,
    /// The largest L that one of the difference schemes needed.
    pub power: u32,
    /// The largest norm ‖Sᴸ‖∞ that was reached, below 1.
    pub norm: Rational,
}

/// The largest k up to `most` for which a bivariate scheme is proved C^k, powers up to
/// `longest` tried.
///
/// It is C^k if for all i + j = k the scheme of mⁱnʲ·a/(σ(z₁)ⁱσ(z₂)ʲ) is C⁰, and that is so if
/// its differences in both directions contract (Dyn 1992, section 4). Sufficient, and for
/// tensor products what both masks have; a scheme whose smoothing factors lie in other
/// directions, such as Loop's, may be smoother than is seen here.
///
/// # Errors
/// [`crate::ErrorKind::Cancelled`].
pub fn grid_contractivity(
    context: &Context,
    mask: &GridMask,
    most: usize,
    longest: u32,
) -> Result<Option<GridContractivity>> {
    let mut proved = None;
    for k in 0..=most {
        let Some((power, norm)) = proof(context, mask, k, longest)? else { break };
        proved = Some(GridContractivity { continuity: k, power, norm });
    }
    Ok(proved)
}

fn proof(
    context: &Context,
    mask: &GridMask,
    k: usize,
    longest: u32,
) -> Result<Option<(u32, Rational)>> {
    let mut worst = (1, Rational::zero());
    for i in 0..=k {
        for extra in [[1, 0], [0, 1]] {
            let orders = [i, k - i];
            let Some(symbol) = difference(mask, orders, extra) else { return Ok(None) };
            let Some(found) = contracts(context, mask.arity(), &symbol, longest)? else {
                return Ok(None);
            };
            worst = (worst.0.max(found.0), worst.1.max(found.1));
        }
    }
    Ok(Some(worst))
}

/// mⁱnʲ·a/(σ(z₁)^(i+e) σ(z₂)^(j+f)).
fn difference(mask: &GridMask, orders: [usize; 2], extra: [usize; 2]) -> Option<Bivariate> {
    let mut symbol = Bivariate::symbol(mask);
    for v in 0..2 {
        let arity = mask.arity()[v];
        let sigma = Bivariate::along(&Laurent::sigma(arity), v);
        for _ in 0..orders[v] + extra[v] {
            symbol = symbol.divided_by(&sigma)?;
        }
        symbol = symbol.scaled(&pow(ratio(arity as i64, 1), orders[v]));
    }
    Some(symbol)
}

/// The first power whose norm is below 1, and the norm.
fn contracts(
    context: &Context,
    arity: [usize; 2],
    symbol: &Bivariate,
    longest: u32,
) -> Result<Option<(u32, Rational)>> {
    let [m, n] = arity.map(|m| m as i64);
    let mut product = symbol.clone();
    for power in 1..=longest {
        context.check_cancelled()?;
        let (Some(a), Some(b)) = (m.checked_pow(power), n.checked_pow(power)) else { break };
        let norm = product.class_norm([a, b]);
        if norm < Rational::one() {
            return Ok(Some((power, norm)));
        }
        if product.terms.len().saturating_mul(symbol.terms.len()) > MOST_TERMS {
            break;
        }
        product = &product * &symbol.spread([a, b]);
    }
    Ok(None)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quotients_of_products() {
        let a =
            Bivariate::new([([0, 0], ratio(1, 1)), ([1, 0], ratio(2, 1)), ([1, 1], ratio(1, 3))]);
        let b = Bivariate::new([([-2, 1], ratio(5, 1)), ([0, -1], ratio(-1, 2))]);
        let product = &a * &b;
        assert_eq!(product.divided_by(&a), Some(b.clone()));
        assert_eq!(product.divided_by(&b), Some(a.clone()));
        assert_eq!((&product + &a).divided_by(&b), None);
        assert_eq!(a.divided_by(&Bivariate::default()), None);
    }
}
