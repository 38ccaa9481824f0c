//! The proof of C^k by contractivity.
//!
//! A scheme with k + 1 smoothing factors is C^k if some power of the scheme of b = m^k·a/σ^(k+1)
//! contracts: ‖S_bᴸ‖∞ < 1, where ‖S_bᴸ‖∞ is the largest sum of absolute values of the coefficients
//! of b(z)·b(zᵐ)·…·b(z^(m^(L−1))) in a residue class mod mᴸ (Dyn, Gregory and Levin 1991; Dyn 1992,
//! theorem 3.4). The pair of L and norm is the certificate.

use num_bigint::BigInt;
use num_traits::{One, Signed, Zero, pow};

use super::sum_rules::difference_symbol;
use crate::base::{Context, Result};
use crate::curve::rational::over_common;
use crate::curve::{Laurent, Mask, Rational};

/// The largest product that is looked at, in coefficients.
const LARGEST_PRODUCT: usize = 1 << 18;

/// Multiplications of words for all powers of one order: about a second.
pub(super) const MOST_WORK: u64 = 1 << 28;

/// That the scheme is C^`continuity`: ‖S_bᴸ‖∞ = `norm` < 1, for the first such L.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Contractivity {
    /// The order k.
    pub continuity: usize,
    /// L.
    pub power: u32,
    /// ‖S_bᴸ‖∞.
    pub norm: Rational,
}

/// The norms ‖S_bᴸ‖∞ of a symbol for L = 1, 2, …
///
/// They end where the product has more than 2¹⁸ coefficients, or would take too long.
pub struct PowerNorms {
    arity: usize,
    /// Numerators of b over `denominator`.
    symbol: Vec<BigInt>,
    denominator: BigInt,
    /// Numerators of the product so far, over `denominator` to the power `power`.
    product: Vec<BigInt>,
    power: u32,
    /// Multiplications of words that are left.
    work: u64,
}

impl PowerNorms {
    /// The norms of the scheme of a symbol.
    pub fn new(arity: usize, symbol: &Laurent) -> Self {
        let coefficients = symbol.coefficients();
        let (symbol, denominator) = over_common(coefficients.iter());
        Self { arity, symbol, denominator, product: vec![BigInt::one()], power: 0, work: u64::MAX }
    }

    /// With a limit for multiplications of words in all.
    #[must_use]
    pub(super) fn within(self, work: u64) -> Self {
        Self { work, ..self }
    }

    /// Multiplications of words that the next product takes.
    fn next_work(&self) -> u64 {
        let words = |list: &[BigInt]| list.iter().map(|x| x.bits() / 64 + 1).sum::<u64>();
        words(&self.symbol).saturating_mul(words(&self.product))
    }

    /// Multiplies the product by b(z^(m^power)); false if that is too long.
    fn multiply(&mut self) -> bool {
        let stride = self.arity.checked_pow(self.power);
        let reach = stride.and_then(|s| s.checked_mul(self.symbol.len().saturating_sub(1)));
        let length = reach.and_then(|reach| reach.checked_add(self.product.len()));
        let (Some(stride), Some(length)) = (stride, length) else { return false };
        if length > LARGEST_PRODUCT || self.symbol.is_empty() {
            return false;
        }
        match self.work.checked_sub(self.next_work()) {
            Some(left) => self.work = left,
            None => return false,
        }
        let mut product = vec![BigInt::zero(); length];
        for (i, b) in self.symbol.iter().enumerate().filter(|(_, b)| !b.is_zero()) {
            for (sum, c) in product[i * stride..].iter_mut().zip(&self.product) {
                *sum += b * c;
            }
        }
        self.product = product;
        self.power += 1;
        true
    }

    fn norm(&self) -> Rational {
        let modulus = self.arity.pow(self.power);
        let class = |e: usize| self.product.iter().skip(e).step_by(modulus);
        let sum = |e: usize| class(e).map(Signed::abs).sum::<BigInt>();
        let classes = 0..modulus.min(self.product.len());
        let largest = classes.map(sum).max().unwrap_or_else(BigInt::zero);
        Rational::new(largest, pow(self.denominator.clone(), self.power as usize))
    }
}

impl Iterator for PowerNorms {
    type Item = Rational;

    fn next(&mut self) -> Option<Rational> {
        self.multiply().then(|| self.norm())
    }
}

/// Looks for the certificate of C^k among the powers up to `longest`; `None` if there is
/// none.
///
/// O(length of the mask · m^L) operations on integers of O(L) words, 2²⁸ multiplications of words at
/// most.
///
/// # Errors
/// [`crate::ErrorKind::Cancelled`].
pub fn contractivity(
    context: &Context,
    mask: &Mask,
    k: usize,
    longest: u32,
) -> Result<Option<Contractivity>> {
    within(context, mask, k, longest, MOST_WORK)
}

/// The same with another limit for multiplications of words.
pub(super) fn within(
    context: &Context,
    mask: &Mask,
    k: usize,
    longest: u32,
    work: u64,
) -> Result<Option<Contractivity>> {
    let Some(symbol) = difference_symbol(mask, k) else { return Ok(None) };
    let norms = PowerNorms::new(mask.arity(), &symbol).within(work);
    for (power, norm) in (1..=longest).zip(norms) {
        if norm < Rational::one() {
            return Ok(Some(Contractivity { continuity: k, power, norm }));
        }
        context.check_cancelled()?;
    }
    Ok(None)
}
