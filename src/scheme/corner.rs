//! The corner operator C_t: a corner of an n-gon moves to a mean of its vertices.
//!
//! For x₀ … xₙ₋₁ and a number t, corner 0 moves to Σⱼ αⱼ xⱼ with
//!
//! * `Cosine`: αⱼ = t²·[j=0] + (1 − t² + 2t(1−t)·cos(2πj/n)) / n, whose Fourier
//!   multipliers are 1 for mode 0, t for modes ±1 and t² for the rest (Doo and
//!   Sabin 1978 for t = ½);
//! * `Average`: t²·x₀ + t(1−t)·(e₋ + e₊) + (1−t)²·c, with e± the midpoints of
//!   the two edges at x₀ and c the mean of all vertices (Catmull and Clark's
//!   1978 quadratic rule for t = ½).
//!
//! Both agree for n = 4, where they are the tensor square of the univariate cut
//! ((1+t)/2, (1−t)/2). C₁ is the identity, C₀ the centroid. A 2-gon, which is
//! what the mirror image makes of a triangle's side on a boundary, takes the
//! univariate cut.

use crate::base::{Fraction, Weight};

/// Which corner operator a scheme uses on n-gons other than quads.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
#[non_exhaustive]
pub enum CornerRule {
    /// Doo and Sabin's cosine weights.
    #[default]
    Cosine,
    /// Mean of vertex, edge midpoints and centroid.
    Average,
}

/// The weights α₀ … αₙ₋₁ of C_t by n, computed once each.
#[derive(Debug, Clone)]
pub(crate) struct CornerWeights<W> {
    rule: CornerRule,
    t: W,
    by_size: Vec<Vec<W>>,
}

impl<W: Weight> CornerWeights<W> {
    pub(crate) fn new(rule: CornerRule, t: Fraction) -> Self {
        Self { rule, t: W::from_fraction(t), by_size: Vec::new() }
    }

    /// The weights for an n-gon, n ≥ 2.
    pub(crate) fn of(&mut self, n: usize) -> &[W] {
        if self.by_size.len() <= n {
            self.by_size.resize(n + 1, Vec::new());
        }
        if self.by_size[n].is_empty() {
            self.by_size[n] = weights(self.rule, &self.t, n);
        }
        &self.by_size[n]
    }
}

fn weights<W: Weight>(rule: CornerRule, t: &W, n: usize) -> Vec<W> {
    let one = || W::ratio(1, 1);
    let rest = one() - t.clone();
    let square = t.clone() * t.clone();
    if n == 2 {
        let half = W::ratio(1, 2);
        return vec![half.clone() * (one() + t.clone()), half * rest];
    }
    let share = W::ratio(1, n as i64);
    // t(1−t) and the part that every vertex gets.
    let cross = t.clone() * rest.clone();
    let mut weights: Vec<W> = match rule {
        CornerRule::Cosine => {
            let all = one() - square.clone();
            let wave = W::ratio(2, 1) * cross;
            let at = |j| share.clone() * (all.clone() + wave.clone() * W::cos_turn(j, n));
            (0..n).map(at).collect()
        }
        CornerRule::Average => {
            let all = share * (rest.clone() * rest);
            let beside = W::ratio(1, 2) * cross.clone();
            let mut weights = vec![all.clone(); n];
            weights[1] = all.clone() + beside.clone();
            weights[n - 1] = all.clone() + beside;
            weights[0] = all + cross;
            weights
        }
    };
    weights[0] = weights[0].clone() + square;
    weights
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn doo_sabin_weights() {
        for n in [3, 4, 5, 6, 7, 30] {
            let mut table = CornerWeights::<f64>::new(CornerRule::Cosine, Fraction::HALF);
            let row = table.of(n).to_vec();
            let size = n as f64;
            assert!((row[0] - (size + 5.0) / (4.0 * size)).abs() < 1e-15);
            for (j, w) in row.iter().enumerate().skip(1) {
                let angle = std::f64::consts::TAU * j as f64 / size;
                assert!((w - (3.0 + 2.0 * angle.cos()) / (4.0 * size)).abs() < 1e-15);
            }
        }
    }

    #[test]
    fn quads_get_the_tensor_square_of_the_cut() {
        for rule in [CornerRule::Cosine, CornerRule::Average] {
            let mut table = CornerWeights::<f64>::new(rule, Fraction::HALF);
            assert_eq!(table.of(4), [9.0 / 16.0, 3.0 / 16.0, 1.0 / 16.0, 3.0 / 16.0]);
            assert_eq!(table.of(2), [0.75, 0.25]);
        }
    }
}
