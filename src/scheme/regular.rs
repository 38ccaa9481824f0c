//! The regular rule, where it is a tensor product: three taps per direction.

use super::{CornerRule, CornerWeights, Scheme};
use crate::base::{Fraction, Weight};

/// Three taps of a univariate rule: away from the middle of the cell that the
/// new point belongs to, at the point itself, towards the middle.
pub(crate) type Taps<W> = [W; 3];

impl Scheme {
    /// The split followed by the first pass on a regular quad mesh.
    ///
    /// The cut (¾, ¼) filtered by (a/2, 1−a, a/2); for the founding paper's
    /// scheme (1, 22, 9)/32.
    pub(crate) fn fused_taps<W: Weight>(&self) -> Option<Taps<W>> {
        let [away, own, toward]: Taps<W> = self.pass_taps(0)?;
        let mut cut = CornerWeights::<W>::new(CornerRule::default(), Fraction::HALF);
        let [near, far] = [cut.of(2)[0].clone(), cut.of(2)[1].clone()];
        // The new point lies between its old vertex (near) and the next (far),
        // its twin across the cell the other way round, and the one beyond the
        // old vertex between that and the one before.
        Some([
            away.clone() * far.clone(),
            away * near.clone() + own.clone() * near.clone() + toward.clone() * far.clone(),
            own * far + toward * near,
        ])
    }

    /// A pass on a regular quad mesh: (a/2, 1−a, a/2) with a = (1−t)/2.
    pub(crate) fn pass_taps<W: Weight>(&self, pass: usize) -> Option<Taps<W>> {
        let t = W::from_fraction(*self.passes().get(pass)?);
        let rest = W::ratio(1, 1) - t.clone();
        let half = W::ratio(1, 4) * rest;
        Some([half.clone(), W::ratio(1, 2) * (W::ratio(1, 1) + t), half])
    }
}
