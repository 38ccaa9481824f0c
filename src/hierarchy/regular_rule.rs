//! A pass, or the split and the first pass in one go, around regular vertices.
//!
//! A child (v, f) of a vertex v of valence 4 among quads is a mean of the 3×3 values around
//! v, the tensor product of three taps that point towards f. The order of the additions is
//! the same whether one looks along one edge of f at v first or along the other, and
//! nothing else than v and f decides it: who computes a child, and in which array, does not
//! show in its bits. Weighed before they are added, values near the limit stay in range.

use crate::base::Scalar;
use crate::scheme::Taps;

/// Products of two taps. The names say where a value lies: `away` from the face of the child,
/// at the `own` vertex, `toward` the face.
#[derive(Debug, Clone, Copy)]
pub(super) struct RegularRule<T> {
    own: T,
    toward: T,
    away: T,
    /// At the diagonal vertices: of the face, of the face opposite, of the two beside.
    toward_both: T,
    away_both: T,
    across: T,
}

impl<T: Scalar> RegularRule<T> {
    pub(super) fn new(taps: Taps<f64>) -> Self {
        let [away, own, toward] = taps;
        let product = |a: f64, b: f64| T::from_f64(a * b);
        Self {
            own: product(own, own),
            toward: product(own, toward),
            away: product(own, away),
            toward_both: product(toward, toward),
            away_both: product(away, away),
            across: product(toward, away),
        }
    }

    /// A child from weighed values: its vertex with the diagonal ones beside the face, the
    /// neighbours in the face, those away from it, and the other two diagonal ones.
    #[inline(always)]
    fn child(
        middle: T::Lanes,
        toward: T::Lanes,
        away: T::Lanes,
        [near, far]: [T::Lanes; 2],
    ) -> T::Lanes {
        middle + toward + away + (near + far)
    }

    /// The four children of a vertex from the three rows around it, counter-clockwise from the
    /// child to the upper right.
    #[inline(always)]
    pub(super) fn around_vertex(self, rows: [[T::Lanes; 3]; 3]) -> [T::Lanes; 4] {
        let [[sw, s, se], [w, own, e], [nw, n, ne]] = rows;
        let own = own * self.own;
        let falling = own + (nw * self.across + se * self.across);
        let rising = own + (ne * self.across + sw * self.across);
        let child = |middle, [a, b]: [T::Lanes; 2], [c, d]: [T::Lanes; 2], near, far| {
            let toward = a * self.toward + b * self.toward;
            let away = c * self.away + d * self.away;
            Self::child(middle, toward, away, [near * self.toward_both, far * self.away_both])
        };
        [
            child(falling, [e, n], [w, s], ne, sw),
            child(rising, [n, w], [s, e], nw, se),
            child(falling, [w, s], [e, n], sw, ne),
            child(rising, [s, e], [n, w], se, nw),
        ]
    }

    /// The four children of a quad from the four rows around it, counter-clockwise from its
    /// lower left vertex.
    #[inline(always)]
    pub(super) fn around_quad(self, rows: [[T::Lanes; 4]; 4]) -> [T::Lanes; 4] {
        let at = |x: usize, y: usize| rows[y][x];
        // Children opposite each other share the neighbours in the face.
        let falling = at(2, 1) * self.toward + at(1, 2) * self.toward;
        let rising = at(1, 1) * self.toward + at(2, 2) * self.toward;
        // A vertex, and the steps from there into the face.
        let child = |x: usize, y: usize, [right, up]: [bool; 2], toward| {
            let (inner_x, outer_x) = if right { (x + 1, x - 1) } else { (x - 1, x + 1) };
            let (inner_y, outer_y) = if up { (y + 1, y - 1) } else { (y - 1, y + 1) };
            let across = at(outer_x, inner_y) * self.across + at(inner_x, outer_y) * self.across;
            let away = at(outer_x, y) * self.away + at(x, outer_y) * self.away;
            let near = at(inner_x, inner_y) * self.toward_both;
            let far = at(outer_x, outer_y) * self.away_both;
            Self::child(at(x, y) * self.own + across, toward, away, [near, far])
        };
        [
            child(1, 1, [true, true], falling),
            child(2, 1, [false, true], rising),
            child(2, 2, [false, false], falling),
            child(1, 2, [true, false], rising),
        ]
    }
}
