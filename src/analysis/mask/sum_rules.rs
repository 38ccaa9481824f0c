//! Sum rules: how often the symbol has the smoothing factor σ = 1 + z + … + z^(m−1).
//!
//! Equivalently the symbol and its first derivatives vanish at the m-th roots of unity other
//! than 1. A scheme whose symbol has σⁿ generates polynomials of degree n − 1, and its limit is
//! Cⁿ⁻¹ at most unless its shifts depend on one another.

use num_traits::pow;

use crate::curve::rational::ratio;
use crate::curve::{Laurent, Mask};

/// A symbol without its smoothing factors.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Smoothing {
    /// How many factors σ there are, 1 at least.
    pub factors: usize,
    /// What is left, a/σⁿ.
    pub kernel: Laurent,
}

impl Smoothing {
    /// Takes all factors σ out of a mask's symbol, exactly.
    pub fn of(mask: &Mask) -> Self {
        let sigma = Laurent::sigma(mask.arity());
        let most = mask.coefficients().len();
        let (kernel, factors) = mask.symbol().stripped_of(&sigma, most);
        Self { factors, kernel }
    }
}

/// The symbol m^k·a/σ^(k+1), whose scheme refines the differences of the k-th divided
/// differences; `None` if the mask has fewer factors.
pub fn difference_symbol(mask: &Mask, k: usize) -> Option<Laurent> {
    let sigma = Laurent::sigma(mask.arity());
    let (rest, times) = mask.symbol().stripped_of(&sigma, k + 1);
    (times == k + 1).then(|| rest.scaled(&pow(ratio(mask.arity() as i64, 1), k)))
}
