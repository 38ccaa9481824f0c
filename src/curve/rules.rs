//! A mask's rules in the number type of the points.

use num_traits::Signed;

use super::coordinate::Coordinate;
use super::mask::Mask;
use super::rational;

/// One rule for each residue of the new point's index.
#[derive(Debug, Clone)]
pub struct Rules<W> {
    /// For each residue: (weight, shift of the old point), by ascending shift; not empty.
    by_residue: Vec<Vec<(W, i64)>>,
    twice_centre: Option<i64>,
    norm: f64,
}

impl<W: Coordinate> Rules<W> {
    /// The rules of a mask, weights rounded to the nearest number.
    pub fn new(mask: &Mask) -> Self {
        let rule = |residue| {
            let taps = mask.taps(residue).into_iter();
            taps.map(|tap| (W::from_rational(&tap.weight), tap.shift)).collect()
        };
        let norm = |residue| mask.taps(residue).iter().map(|tap| tap.weight.abs()).sum();
        let norms = (0..mask.arity()).map(norm);
        Self {
            by_residue: (0..mask.arity()).map(rule).collect(),
            twice_centre: mask.is_symmetric().then(|| mask.twice_centre()),
            norm: norms.map(|norm| rational::to_f64(&norm)).fold(1.0, f64::max),
        }
    }

    /// One rule, of arity 1; it has its middle at 0 if the mask it belongs to is symmetric.
    pub(crate) fn single(taps: impl Iterator<Item = (W, i64)>, symmetric: bool) -> Self {
        let rule: Vec<_> = taps.collect();
        let norm = rule.iter().map(|(w, _)| w.to_f64().abs()).sum::<f64>().max(1.0);
        Self { by_residue: vec![rule], twice_centre: symmetric.then_some(0), norm }
    }

    /// The binary rules of an interpolating scheme: old points stay, and the new one
    /// between points t and t+1 takes these weights of t−1, t, t+1, t+2.
    pub(crate) fn four_point(weights: [f64; 4]) -> Self {
        let taps = (-1..).zip(weights).map(|(shift, w)| (W::from_f64(w), shift));
        let symmetric = weights.iter().eq(weights.iter().rev());
        Self {
            by_residue: vec![vec![(W::from_f64(1.0), 0)], taps.collect()],
            twice_centre: symmetric.then_some(0),
            norm: weights.into_iter().map(f64::abs).sum::<f64>().max(1.0),
        }
    }

    /// The ternary rules of a symmetric interpolating scheme: point 3t stays, 3t+1 takes
    /// these weights of t−1, t, t+1, t+2 and 3t+2 the same from the other side.
    pub(crate) fn ternary_four_point(weights: [f64; 4]) -> Self {
        let taps = |w: [f64; 4]| (-1..).zip(w).map(|(s, w)| (W::from_f64(w), s)).collect();
        let [a, b, c, d] = weights;
        Self {
            by_residue: vec![vec![(W::from_f64(1.0), 0)], taps(weights), taps([d, c, b, a])],
            twice_centre: Some(0),
            norm: weights.into_iter().map(f64::abs).sum::<f64>().max(1.0),
        }
    }
}

impl<W> Rules<W> {
    /// Rules that only say how far they reach: for each residue (weight, shift).
    pub(crate) fn of_reach(by_residue: Vec<Vec<(W, i64)>>) -> Self {
        Self { by_residue, twice_centre: None, norm: 1.0 }
    }

    /// The number of rules.
    pub(crate) fn arity(&self) -> i64 {
        self.by_residue.len() as i64
    }

    pub(crate) fn rule(&self, residue: usize) -> &[(W, i64)] {
        &self.by_residue[residue]
    }

    /// For each rule the least and the largest shift.
    pub(crate) fn reaches(&self) -> impl Iterator<Item = (i64, i64)> + '_ {
        self.by_residue.iter().map(|rule| {
            let shifts = || rule.iter().map(|(_, shift)| *shift);
            (shifts().min().unwrap_or(0), shifts().max().unwrap_or(0))
        })
    }

    /// Twice the middle of a symmetric mask.
    pub(crate) fn twice_centre(&self) -> Option<i64> {
        self.twice_centre
    }

    /// The largest sum of absolute weights of a rule, at least 1.
    pub(crate) fn norm(&self) -> f64 {
        self.norm
    }
}
