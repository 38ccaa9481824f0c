//! Which polynomials a scheme generates and reproduces.
//!
//! A scheme *generates* degree d if limits of polynomial data are polynomials of degree d; for that
//! σ^(d+1) has to divide the symbol. It *reproduces* degree d if data taken from a polynomial at
//! the parameters of the scheme have that polynomial for a limit; for that it has to generate it
//! and a^(k)(1) = m·τ(τ − 1)…(τ − k + 1) for k ≤ d, τ = a′(1)/m (Dyn, Hormann, Sabin and Shen 2008
//! for m = 2; Conti and Hormann 2011 for any arity).

use super::sum_rules::Smoothing;
use crate::curve::Mask;
use crate::curve::rational::ratio;

/// The degrees of a scheme.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Degrees {
    /// The largest degree that is generated.
    pub generation: usize,
    /// The largest degree that is reproduced, with the parameters of shift τ.
    pub reproduction: usize,
}

impl Degrees {
    /// The degrees of a mask, exactly.
    pub fn of(mask: &Mask) -> Self {
        let generation = Smoothing::of(mask).factors.saturating_sub(1);
        let tau = mask.tau();
        let mut falling = ratio(mask.arity() as i64, 1);
        let mut reproduction = 0;
        for k in 0..=generation {
            if mask.symbol().derivative_at_one(k) != falling {
                break;
            }
            reproduction = k;
            falling *= &tau - ratio(k as i64, 1);
        }
        Self { generation, reproduction }
    }
}
