//! The smooth rules of the primal schemes: weights by valence, nothing else.
//!
//! The new vertex of an edge is `end`·(both ends) + `beside`·(both sides), that of an old
//! vertex `own`·(itself) + `near`·Σ(its n neighbours) + `face`·Σ(its n faces). What a side
//! or a face stands for is the split's: the face's new vertex in a quad split, the
//! opposite vertex of the triangle in a triangle split.

use super::{LoopWeights, Method, Scheme, TriangleRule};
use crate::base::Weight;

/// Weights of an edge's new vertex.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct EdgeMask<W> {
    pub(crate) end: W,
    pub(crate) beside: W,
}

/// Weights of an old vertex.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct VertexMask<W> {
    pub(crate) own: W,
    pub(crate) near: W,
    pub(crate) face: W,
}

/// The largest valence whose mask is kept.
const TABLE: usize = 64;

/// Which rules.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Rules {
    Linear,
    CatmullClark(TriangleRule),
    Loop(LoopWeights),
}

/// The smooth masks of a scheme, computed once for each valence.
#[derive(Debug, Clone)]
pub(crate) struct SmoothMasks<W> {
    rules: Rules,
    by_valence: Vec<Option<VertexMask<W>>>,
}

impl<W: Weight> SmoothMasks<W> {
    /// The masks of a primal scheme.
    pub(crate) fn new(scheme: &Scheme) -> Self {
        let rules = match scheme.method() {
            Method::CatmullClark => Rules::CatmullClark(scheme.triangle_rule()),
            Method::Loop => Rules::Loop(scheme.loop_weights()),
            Method::Primal | Method::Dual => Rules::Linear,
        };
        Self { rules, by_valence: Vec::new() }
    }

    /// Midpoints and old vertices in place, under any scheme.
    pub(crate) fn linear() -> Self {
        Self { rules: Rules::Linear, by_valence: Vec::new() }
    }

    /// True if there is nothing but midpoints.
    pub(crate) fn is_linear(&self) -> bool {
        self.rules == Rules::Linear
    }

    /// True if triangles of the parent have weights of their own.
    pub(crate) fn minds_triangles(&self) -> bool {
        self.rules == Rules::CatmullClark(TriangleRule::Smooth)
    }

    /// The mask of an interior edge with a number of triangles, 0 to 2, beside it.
    pub(crate) fn edge(&self, triangles: usize) -> EdgeMask<W> {
        let mask = |end: (i64, i64), beside: (i64, i64)| EdgeMask {
            end: W::ratio(end.0, end.1),
            beside: W::ratio(beside.0, beside.1),
        };
        match self.rules {
            Rules::Linear => mask((1, 2), (0, 1)),
            // A side weighs ¼, or 0.47 if it is a triangle: both get the mean.
            Rules::CatmullClark(TriangleRule::Smooth) => match triangles {
                0 => mask((1, 4), (1, 4)),
                1 => mask((14, 100), (36, 100)),
                _ => mask((3, 100), (47, 100)),
            },
            Rules::CatmullClark(TriangleRule::CatmullClark) => mask((1, 4), (1, 4)),
            Rules::Loop(_) => mask((3, 8), (1, 8)),
        }
    }

    /// The mask of an interior vertex of valence n ≥ 2.
    pub(crate) fn vertex(&mut self, n: usize) -> VertexMask<W> {
        if n > TABLE {
            return self.of_valence(n);
        }
        if self.by_valence.len() <= n {
            self.by_valence.resize(n + 1, None);
        }
        if let Some(mask) = &self.by_valence[n] {
            return mask.clone();
        }
        let mask = self.of_valence(n);
        self.by_valence[n] = Some(mask.clone());
        mask
    }

    fn of_valence(&self, n: usize) -> VertexMask<W> {
        let size = n as i64;
        let (zero, one) = (W::ratio(0, 1), W::ratio(1, 1));
        match self.rules {
            Rules::Linear => VertexMask { own: one, near: zero.clone(), face: zero },
            Rules::CatmullClark(_) => {
                let share = W::ratio(1, size.saturating_mul(size));
                VertexMask { own: W::ratio(size - 2, size), near: share.clone(), face: share }
            }
            Rules::Loop(weights) => {
                let near = loop_beta::<W>(weights, n);
                VertexMask { own: one - W::ratio(size, 1) * near.clone(), near, face: zero }
            }
        }
    }
}

/// β of Loop's scheme.
fn loop_beta<W: Weight>(weights: LoopWeights, n: usize) -> W {
    match (weights, n) {
        (LoopWeights::Warren, 3) => W::ratio(3, 16),
        (LoopWeights::Warren, _) => W::ratio(3, 8 * n as i64),
        (LoopWeights::Loop, _) => {
            let inner = W::ratio(3, 8) + W::ratio(1, 4) * W::cos_turn(1, n);
            W::ratio(1, n as i64) * (W::ratio(5, 8) - inner.clone() * inner)
        }
    }
}

#[cfg(test)]
#[allow(clippy::float_cmp)] // what is exact is compared exactly
mod tests {
    use super::*;

    fn masks(scheme: &Scheme) -> SmoothMasks<f64> {
        SmoothMasks::new(scheme)
    }

    #[test]
    fn rows_sum_to_one() {
        let cc = Scheme::catmull_clark;
        let warren = Scheme::loop_triangles().with_loop_weights(LoopWeights::Warren);
        for scheme in [
            cc(),
            cc().with_triangle_rule(TriangleRule::Smooth),
            warren,
            Scheme::bilinear(),
            Scheme::loop_triangles(),
        ] {
            let mut masks = masks(&scheme);
            for n in 2..40 {
                let VertexMask { own, near, face } = masks.vertex(n);
                assert!((own + n as f64 * (near + face) - 1.0).abs() < 1e-15, "{scheme:?} {n}");
            }
            for triangles in 0..3 {
                let EdgeMask { end, beside } = masks.edge(triangles);
                assert!((2.0 * (end + beside) - 1.0).abs() < 1e-15);
            }
        }
    }

    #[test]
    fn known_weights() {
        assert_eq!(
            masks(&Scheme::catmull_clark()).vertex(4),
            VertexMask { own: 0.5, near: 1.0 / 16.0, face: 1.0 / 16.0 }
        );
        assert_eq!(
            masks(&Scheme::loop_triangles()).vertex(6),
            VertexMask { own: 0.625, near: 1.0 / 16.0, face: 0.0 }
        );
        assert_eq!(masks(&Scheme::loop_triangles()).vertex(3).near, 3.0 / 16.0);
        let warren = Scheme::loop_triangles().with_loop_weights(LoopWeights::Warren);
        assert_eq!(masks(&warren).vertex(5).near, 3.0 / 40.0);
        assert_eq!(masks(&warren).vertex(3).near, 3.0 / 16.0);
        let smooth = Scheme::catmull_clark().with_triangle_rule(TriangleRule::Smooth);
        assert_eq!(masks(&smooth).edge(2).beside, 0.47);
        assert_eq!(masks(&smooth).edge(1).end, 0.14);
    }
}
