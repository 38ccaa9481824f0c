//! Rational roots of polynomials with rational coefficients, exactly.
//!
//! A root is one modulo every prime that does not divide the leading coefficient l. Those modulo
//! a small prime, found by trying all residues, are lifted to roots modulo a power of it (Hensel; as
//! in Loos 1983, "Computing rational zeros of integral polynomials by p-adic expansion") that tells
//! all integers apart that l times a root can be. Exact division decides.

use num_bigint::BigInt;
use num_integer::Integer as _;
use num_traits::{One, Signed, ToPrimitive, Zero};

use super::rational::{Rational, over_common};

/// Coefficients by ascending powers; the last one is not 0.
type Polynomial = Vec<BigInt>;

/// Primes are looked for below this.
const PRIMES_BELOW: u64 = 1 << 14;
/// Primes after which roots that agree modulo each of them are taken for the same.
const UNLUCKY_PRIMES: usize = 8;

/// All rational roots, each as often as it is one. Trailing zeros are allowed.
///
/// The degree has to be far below 2¹⁴.
pub(crate) fn rational_roots(coefficients: &[Rational]) -> Vec<Rational> {
    let mut rest = integers(coefficients);
    // What has the roots that are left, each once at least.
    let mut searched = rest.clone();
    let mut roots = Vec::new();
    let mut unlucky = 0;
    for prime in primes() {
        if searched.len() < 2 {
            break;
        }
        let modulo: Vec<u64> = searched.iter().map(|c| residue(c, prime)).collect();
        if modulo[modulo.len() - 1] == 0 {
            continue;
        }
        let mut is_complete = true;
        let polynomial = searched.clone();
        for (start, multiplicity) in roots_modulo(&modulo, prime) {
            let root = lifted(&polynomial, start, multiplicity, prime);
            let found = divide_out(&mut searched, &root);
            roots.extend(std::iter::repeat_n(root.clone(), divide_out(&mut rest, &root)));
            // A simple root has one lift. Others may be several roots that agree modulo the prime.
            is_complete &= multiplicity == 1 || found == multiplicity;
        }
        if is_complete {
            break;
        }
        unlucky += 1;
        if unlucky == UNLUCKY_PRIMES {
            searched = square_free(&searched);
        }
    }
    roots
}

/// A multiple of a polynomial, without trailing zeros.
fn integers(polynomial: &[Rational]) -> Polynomial {
    trimmed(over_common(polynomial.iter()).0)
}

fn trimmed<T: Zero>(mut polynomial: Vec<T>) -> Vec<T> {
    let used = polynomial.iter().rposition(|c| !c.is_zero()).map_or(0, |last| last + 1);
    polynomial.truncate(used);
    polynomial
}

/// The primes below [`PRIMES_BELOW`], the largest first.
fn primes() -> impl Iterator<Item = u64> {
    let is_prime = |&n: &u64| (2..=n.isqrt()).all(|d| !n.is_multiple_of(d));
    (3..PRIMES_BELOW).rev().filter(is_prime)
}

fn residue(c: &BigInt, prime: u64) -> u64 {
    c.mod_floor(&BigInt::from(prime)).to_u64().unwrap_or(0)
}

/// The roots of a polynomial modulo a prime, with their multiplicities.
fn roots_modulo(polynomial: &[u64], prime: u64) -> Vec<(u64, usize)> {
    let remainder = |p: &[u64], at: u64| p.iter().rev().fold(0, |sum, c| (sum * at + c) % prime);
    let quotient = |p: &[u64], at: u64| {
        let sums = p.iter().rev().scan(0, |sum, c| {
            *sum = (*sum * at + c) % prime;
            Some(*sum)
        });
        let mut falling: Vec<u64> = sums.collect();
        falling.pop();
        falling.reverse();
        falling
    };
    let mut rest = polynomial.to_vec();
    let mut roots = Vec::new();
    for at in 0..prime {
        let mut multiplicity = 0;
        while rest.len() > 1 && remainder(&rest, at) == 0 {
            rest = quotient(&rest, at);
            multiplicity += 1;
        }
        if multiplicity > 0 {
            roots.push((at, multiplicity));
        }
    }
    roots
}

/// The one rational number that can be a root, of a multiplicity, and agrees with another modulo
/// a prime.
fn lifted(polynomial: &[BigInt], start: u64, multiplicity: usize, prime: u64) -> Rational {
    let leading = &polynomial[polynomial.len() - 1];
    let largest = polynomial.iter().map(Signed::abs).max().unwrap_or_else(BigInt::one);
    // |root| ≤ 1 + largest/|leading| (Cauchy).
    let most: BigInt = largest * 4;
    // Of these it is a simple root.
    let simple = (1..multiplicity).fold(polynomial.to_vec(), |p, _| derivative(&p));
    let slope = derivative(&simple);
    let mut modulus = BigInt::from(prime);
    let value = |p: &[BigInt], at: &BigInt, modulus: &BigInt| {
        p.iter().rev().fold(BigInt::zero(), |sum, c| (sum * at + c).mod_floor(modulus))
    };
    let mut root = BigInt::from(start);
    let power = BigInt::from(prime - 2);
    // By Fermat's little theorem.
    let mut inverse = value(&slope, &root, &modulus).modpow(&power, &modulus);
    while modulus <= most {
        modulus = &modulus * &modulus;
        root = (&root - value(&simple, &root, &modulus) * &inverse).mod_floor(&modulus);
        inverse = &inverse * (2 - value(&slope, &root, &modulus) * &inverse);
        inverse = inverse.mod_floor(&modulus);
    }
    let mut numerator = (root * leading).mod_floor(&modulus);
    if &numerator * 2 > modulus {
        numerator -= modulus;
    }
    Rational::new(numerator, leading.clone())
}

fn derivative(polynomial: &[BigInt]) -> Polynomial {
    polynomial.iter().enumerate().skip(1).map(|(k, c)| c * k).collect()
}

/// Divides by x − root as often as nothing remains; how often that is.
fn divide_out(polynomial: &mut Polynomial, root: &Rational) -> usize {
    let mut times = 0;
    while let Some(quotient) = without_root(polynomial, root) {
        *polynomial = quotient;
        times += 1;
    }
    times
}

/// The quotient by q·x − p for the root p/q, if there is no remainder: it has integer coefficients
/// then (Gauss).
fn without_root(polynomial: &[BigInt], root: &Rational) -> Option<Polynomial> {
    let (first, others) = polynomial.split_first()?;
    let mut quotient = Vec::new();
    let mut carried = BigInt::zero();
    for c in others.iter().rev() {
        let (factor, rest) = (c + carried).div_rem(root.denom());
        if !rest.is_zero() {
            return None;
        }
        carried = root.numer() * &factor;
        quotient.push(factor);
    }
    quotient.reverse();
    (!others.is_empty() && (first + carried).is_zero()).then_some(quotient)
}

/// A polynomial with the same roots, each of them once.
fn square_free(polynomial: &[BigInt]) -> Polynomial {
    let rational = |p: &[BigInt]| p.iter().cloned().map(Rational::from).collect::<Vec<_>>();
    let whole = rational(polynomial);
    let (mut common, mut rest) = (whole.clone(), rational(&derivative(polynomial)));
    while !rest.is_empty() {
        let (_, remainder) = divided(&common, &rest);
        // Any factor is right; this one keeps numbers short.
        let scale = remainder.last().map_or_else(Rational::one, Rational::recip);
        let scaled = remainder.iter().map(|c| c * &scale).collect();
        common = std::mem::replace(&mut rest, scaled);
    }
    integers(&divided(&whole, &common).0)
}

/// Quotient and remainder.
fn divided(dividend: &[Rational], divisor: &[Rational]) -> (Vec<Rational>, Vec<Rational>) {
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

#[cfg(test)]
mod tests {
    use super::super::rational::ratio;
    use super::*;

    fn product(roots: &[Rational], extra: Vec<Rational>) -> Vec<Rational> {
        let times = |p: Vec<Rational>, root: &Rational| {
            let mut result = vec![Rational::zero(); p.len() + 1];
            for (k, c) in p.iter().enumerate() {
                result[k + 1] += c;
                result[k] -= c * root;
            }
            result
        };
        roots.iter().fold(extra, times)
    }

    /// Checks the roots of a product with a polynomial that has none.
    fn check(roots: &[Rational], extra: Vec<Rational>) {
        let mut roots = roots.to_vec();
        roots.sort();
        let mut found = rational_roots(&product(&roots, extra));
        found.sort();
        assert_eq!(found, roots);
    }

    #[test]
    fn finds_every_root_as_often_as_it_is_one() {
        let roots = [ratio(-7, 3), ratio(-7, 3), ratio(0, 1), ratio(5, 2), ratio(1, 64)];
        // x² − 2 and x² + 1 have no rational roots.
        for extra in [vec![ratio(6, 5)], vec![ratio(-2, 1), ratio(0, 1), ratio(1, 1)]] {
            check(&roots, extra);
        }
        assert!(rational_roots(&[ratio(1, 1), ratio(0, 1), ratio(1, 1)]).is_empty());
        assert!(rational_roots(&[ratio(3, 1)]).is_empty());
        assert!(rational_roots(&[]).is_empty());
    }

    #[test]
    fn roots_that_agree_modulo_primes_are_told_apart() {
        // Modulo each of the first ten primes all these are 1, or have a denominator 0.
        let product: BigInt = primes().take(10).map(BigInt::from).product();
        let one = BigInt::one();
        let near = [
            Rational::from(one.clone()),
            Rational::from(&product + 1),
            Rational::from(1 - &product),
            Rational::new(&product + 1, 2 * &product + 1),
            Rational::new(one, product.clone()),
        ];
        check(&near, vec![ratio(1, 1)]);
        // (x² − 2)², whose irrational roots are double ones.
        let twice = [4, 0, -4, 0, 1].map(|c| ratio(c, 1)).to_vec();
        check(&near, twice.clone());
        check(&near[..1], twice);
    }

    #[test]
    fn long_polynomials_with_large_coefficients_take_no_time() {
        let roots: Vec<Rational> = (0..60).map(|k| ratio(k % 20 - 10, 3 * k + 1)).collect();
        let extra = (0..60).map(|k| ratio(3 * k - 100, 1 << (k % 60))).collect();
        check(&roots, extra);
    }
}
