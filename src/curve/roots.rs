//! Rational roots of polynomials with rational coefficients, exactly.
//!
//! With integer coefficients and the leading one l, every root p/q has q | l, so that l·x is an
//! integer root of a polynomial with leading coefficient 1. Integer roots are found between
//! bounds that are halved as long as Sturm's theorem counts roots in between.

use num_bigint::BigInt;
use num_integer::Integer as _;
use num_traits::{One, Signed, Zero};

use super::rational::Rational;

/// Coefficients by ascending powers; the last one is not 0.
type Polynomial = Vec<Rational>;

/// All rational roots, each as often as it is one. Trailing zeros are allowed.
pub(crate) fn rational_roots(coefficients: &[Rational]) -> Vec<Rational> {
    let mut rest = trimmed(coefficients.to_vec());
    let mut roots = Vec::new();
    if rest.len() < 2 {
        return roots;
    }
    for root in distinct_roots(&rest) {
        while let Some(quotient) = without_root(&rest, &root) {
            roots.push(root.clone());
            rest = quotient;
        }
    }
    roots
}

fn trimmed(mut polynomial: Polynomial) -> Polynomial {
    let used = polynomial.iter().rposition(|c| !c.is_zero()).map_or(0, |last| last + 1);
    polynomial.truncate(used);
    polynomial
}

/// The quotient by x − root, if there is no remainder (Horner).
fn without_root(polynomial: &[Rational], root: &Rational) -> Option<Polynomial> {
    let (leading, others) = polynomial.split_last()?;
    let mut quotient = vec![leading.clone()];
    for c in others.iter().rev() {
        let next = c + root * &quotient[quotient.len() - 1];
        quotient.push(next);
    }
    let exact = quotient.pop()?.is_zero();
    quotient.reverse();
    (exact && !others.is_empty()).then_some(quotient)
}

fn distinct_roots(polynomial: &[Rational]) -> Vec<Rational> {
    let common = polynomial.iter().fold(BigInt::one(), |d, c| d.lcm(c.denom()));
    let integer = |c: &Rational| c.numer() * (&common / c.denom());
    let integers: Vec<BigInt> = polynomial.iter().map(integer).collect();
    let Some(leading) = integers.last() else { return Vec::new() };
    // With y = l·x: l^(n−1)·P(x) = yⁿ + Σ cₖ l^(n−1−k) yᵏ.
    let n = integers.len() - 1;
    let scaled = |(k, c): (usize, &BigInt)| {
        if k == n {
            Rational::one()
        } else {
            Rational::from(c * num_traits::pow(leading.clone(), n - 1 - k))
        }
    };
    let monic: Polynomial = integers.iter().enumerate().map(scaled).collect();
    let bound = cauchy_bound(&monic);
    let chain = sturm_chain(monic);
    let mut found = Vec::new();
    search(&chain, &(-&bound - 1), &bound, &mut found);
    found.into_iter().map(|y| Rational::new(y, leading.clone())).collect()
}

/// An integer that no root exceeds in absolute value.
fn cauchy_bound(monic: &[Rational]) -> BigInt {
    let largest = monic.iter().map(Rational::abs).max().unwrap_or_else(Rational::zero);
    largest.ceil().to_integer() + 1
}

/// The polynomial, its derivative and the negated remainders, all over the last of them, so
/// that every root is a simple one and counted once.
fn sturm_chain(polynomial: Polynomial) -> Vec<Polynomial> {
    let powers = polynomial.iter().enumerate().skip(1);
    let derivative = powers.map(|(k, c)| c * Rational::from(BigInt::from(k))).collect();
    let mut chain = vec![polynomial, derivative];
    loop {
        let (_, remainder) = divided(&chain[chain.len() - 2], &chain[chain.len() - 1]);
        if remainder.is_empty() {
            let common = chain[chain.len() - 1].clone();
            return chain.iter().map(|p| divided(p, &common).0).collect();
        }
        // Any positive factor is right; this one keeps numbers short.
        let scale = remainder[remainder.len() - 1].abs().recip();
        chain.push(remainder.iter().map(|c| -(c * &scale)).collect());
    }
}

/// Quotient and remainder.
fn divided(dividend: &[Rational], divisor: &[Rational]) -> (Polynomial, Polynomial) {
    let mut rest = dividend.to_vec();
    let mut quotient = Vec::new();
    while rest.len() >= divisor.len() {
        let factor = &rest[rest.len() - 1] / &divisor[divisor.len() - 1];
        let start = rest.len() - divisor.len();
        for (value, d) in rest[start..].iter_mut().zip(divisor) {
            *value -= d * &factor;
        }
        rest.pop();
        quotient.push(factor);
    }
    quotient.reverse();
    (quotient, trimmed(rest))
}

fn value(polynomial: &[Rational], at: &BigInt) -> Rational {
    let at = Rational::from(at.clone());
    polynomial.iter().rev().fold(Rational::zero(), |sum, c| sum * &at + c)
}

/// The number of sign changes of the chain at a place.
fn changes(chain: &[Polynomial], at: &BigInt) -> usize {
    let values = chain.iter().map(|p| value(p, at)).filter(|v| !v.is_zero());
    let signs: Vec<bool> = values.map(|v| v.is_positive()).collect();
    signs.windows(2).filter(|pair| pair[0] != pair[1]).count()
}

/// Adds the integer roots in (low, high].
fn search(chain: &[Polynomial], low: &BigInt, high: &BigInt, found: &mut Vec<BigInt>) {
    let mut open = vec![(low.clone(), high.clone())];
    while let Some((low, high)) = open.pop() {
        if &high - &low == BigInt::one() {
            if value(&chain[0], &high).is_zero() {
                found.push(high);
            }
            continue;
        }
        if changes(chain, &low) == changes(chain, &high) {
            continue;
        }
        let middle = (&low + &high).div_floor(&BigInt::from(2));
        open.push((low, middle.clone()));
        open.push((middle, high));
    }
}

#[cfg(test)]
mod tests {
    use super::super::rational::ratio;
    use super::*;

    fn product(roots: &[Rational], extra: Polynomial) -> Polynomial {
        let times = |p: Polynomial, root: &Rational| {
            let mut result = vec![Rational::zero(); p.len() + 1];
            for (k, c) in p.iter().enumerate() {
                result[k + 1] += c;
                result[k] -= c * root;
            }
            result
        };
        roots.iter().fold(extra, times)
    }

    #[test]
    fn finds_every_root_as_often_as_it_is_one() {
        let mut roots = [ratio(-7, 3), ratio(-7, 3), ratio(0, 1), ratio(5, 2), ratio(1, 64)];
        roots.sort();
        // x² − 2 and x² + 1 have no rational roots.
        for extra in [vec![ratio(6, 5)], vec![ratio(-2, 1), ratio(0, 1), ratio(1, 1)]] {
            let mut found = rational_roots(&product(&roots, extra));
            found.sort();
            assert_eq!(found, roots);
        }
        assert!(rational_roots(&[ratio(1, 1), ratio(0, 1), ratio(1, 1)]).is_empty());
        assert!(rational_roots(&[ratio(3, 1)]).is_empty());
    }
}
