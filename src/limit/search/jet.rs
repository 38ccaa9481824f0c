//! A fit's polynomial at a point, its derivatives there, and bounds on those over all of a cell.

use crate::limit::tessellate::{Fit, Shape, places};
use glam::DVec3;

/// The position and the derivatives by s, t, ss, st and tt, the cell's own coordinates.
#[derive(Debug, Clone, Copy)]
pub(super) struct Jet(pub(super) [DVec3; 6]);

/// Bernstein polynomials of degree 4 with two derivatives.
fn bernstein(x: f64) -> [[f64; 5]; 3] {
    let y = 1.0 - x;
    let (xx, yy, xy) = (x * x, y * y, x * y);
    let [a, b, c, d] = [y * yy, 3.0 * x * yy, 3.0 * xx * y, x * xx];
    let mid = 2.0 * xy;
    [
        [yy * yy, 4.0 * xy * yy, 6.0 * xy * xy, 4.0 * xx * xy, xx * xx],
        [-a, a - b, b - c, c - d, d].map(|x| 4.0 * x),
        [yy, mid - 2.0 * yy, xx - 2.0 * mid + yy, mid - 2.0 * xx, xx].map(|x| 12.0 * x),
    ]
}

impl Jet {
    pub(super) fn of(fit: &Fit, at: [f64; 2]) -> Self {
        if fit.shape == Shape::Triangle {
            Self::of_triangle(fit, at)
        } else {
            Self::of_square(fit, at)
        }
    }

    fn of_square(fit: &Fit, at: [f64; 2]) -> Self {
        let [along, across] = at.map(bernstein);
        let mut jet = [DVec3::ZERO; 6];
        for j in 0..5 {
            let mut row = [DVec3::ZERO; 3];
            for i in 0..5 {
                let b = fit.at(i, j);
                (0..3).for_each(|order| row[order] += along[order][i] * b);
            }
            let orders = [(0, 0), (1, 0), (0, 1), (2, 0), (1, 1), (0, 2)];
            for (sum, (s, t)) in jet.iter_mut().zip(orders) {
                *sum += across[t][j] * row[s];
            }
        }
        Self(jet)
    }

    /// By the points of de Casteljau's scheme.
    fn of_triangle(fit: &Fit, [s, t]: [f64; 2]) -> Self {
        let r = 1.0 - s - t;
        let mut b = [[DVec3::ZERO; 5]; 5];
        places(fit.shape).for_each(|[i, j]| b[i][j] = fit.at(i, j));
        let reduce = |b: &mut [[DVec3; 5]; 5], degree: usize| {
            for j in 0..degree {
                for i in 0..degree - j {
                    b[i][j] = r * b[i][j] + s * b[i + 1][j] + t * b[i][j + 1];
                }
            }
        };
        reduce(&mut b, 4);
        reduce(&mut b, 3);
        let seconds = [
            b[2][0] - 2.0 * b[1][0] + b[0][0],
            b[1][1] - b[1][0] - b[0][1] + b[0][0],
            b[0][2] - 2.0 * b[0][1] + b[0][0],
        ]
        .map(|x| 12.0 * x);
        reduce(&mut b, 2);
        let firsts = [b[1][0] - b[0][0], b[0][1] - b[0][0]].map(|x| 4.0 * x);
        reduce(&mut b, 1);
        Self([b[0][0], firsts[0], firsts[1], seconds[0], seconds[1], seconds[2]])
    }
}

/// Derivatives as coefficients, in whose hull their values are.
pub(super) struct Hodograph<'a> {
    fit: &'a Fit,
}

impl<'a> Hodograph<'a> {
    pub(super) fn of(fit: &'a Fit) -> Self {
        Self { fit }
    }

    fn each(&self, reach: [usize; 2], mut take: impl FnMut(usize, usize)) {
        for [i, j] in places(self.fit.shape) {
            let [x, y] = [i + reach[0], j + reach[1]];
            let fits =
                if self.fit.shape == Shape::Triangle { x + y <= 4 } else { x <= 4 && y <= 4 };
            if fits {
                take(i, j);
            }
        }
    }

    /// Hands over the coefficients of the derivative by s (0) or t (1).
    pub(super) fn first(&self, axis: usize, mut take: impl FnMut(DVec3)) {
        let step = [1 - axis, axis];
        let fit = self.fit;
        self.each(step, |i, j| take(4.0 * (fit.at(i + step[0], j + step[1]) - fit.at(i, j))));
    }

    /// Hands over those of the derivative by two coordinates.
    pub(super) fn second(&self, [a, b]: [usize; 2], mut take: impl FnMut(DVec3)) {
        let (a, b) = ([1 - a, a], [1 - b, b]);
        let fit = self.fit;
        // Along both axes a square's degree is 4.
        let factor = if a != b && fit.shape != Shape::Triangle { 16.0 } else { 12.0 };
        self.each([a[0] + b[0], a[1] + b[1]], |i, j| {
            let far = fit.at(i + a[0] + b[0], j + a[1] + b[1]);
            let beside = fit.at(i + a[0], j + a[1]) + fit.at(i + b[0], j + b[1]);
            take(factor * (far - beside + fit.at(i, j)));
        });
    }

    /// The mean of the coefficients of a first derivative, and how far from it they are.
    pub(super) fn spread(&self, axis: usize) -> (DVec3, f64) {
        let (mut sum, mut count) = (DVec3::ZERO, 0.0);
        self.first(axis, |d| (sum, count) = (sum + d, count + 1.0));
        let mean = sum / count;
        let mut far: f64 = 0.0;
        self.first(axis, |d| far = far.max(d.distance_squared(mean)));
        (mean, far.sqrt())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Differences of values are what derivatives say, and their coefficients enclose them.
    #[test]
    fn derivatives_are_those_of_the_polynomial() {
        for shape in [Shape::Quad, Shape::Triangle] {
            let point = |[i, j]: [usize; 2]| {
                let (x, y) = (i as f64 / 4.0, j as f64 / 4.0);
                [x * x * x - y, x * y * y, (x - 0.3) * y * y * y + x * x]
            };
            let points: Vec<_> = places(shape).map(point).collect();
            let fit = Fit::new(shape, &points);
            let (x, y, h) = (0.3, 0.45, 1e-4);
            let at = |x: f64, y: f64| Jet::of(&fit, [x, y]).0;
            let jet = at(x, y);
            let value = [x * x * x - y, x * y * y, (x - 0.3) * y * y * y + x * x];
            assert!(jet[0].distance(DVec3::from(value)) < 1e-13);
            for (of, by, step) in [
                (0, 1, [h, 0.0]),
                (0, 2, [0.0, h]),
                (1, 3, [h, 0.0]),
                (1, 4, [0.0, h]),
                (2, 5, [0.0, h]),
            ] {
                let across = at(x + step[0], y + step[1])[of] - at(x - step[0], y - step[1])[of];
                assert!((across / (2.0 * h)).distance(jet[by]) < 1e-6, "{shape:?}: {of} by {by}");
            }
            let hodograph = Hodograph::of(&fit);
            let mut seconds = [DVec3::INFINITY, DVec3::NEG_INFINITY];
            for (which, axes) in [(3, [0, 0]), (4, [0, 1]), (5, [1, 1])] {
                hodograph.second(axes, |d| seconds = [seconds[0].min(d), seconds[1].max(d)]);
                let inside = jet[which].clamp(seconds[0], seconds[1]);
                assert!(inside.distance(jet[which]) < 1e-12, "{shape:?}: {which}");
                seconds = [DVec3::INFINITY, DVec3::NEG_INFINITY];
            }
            for axis in [0, 1] {
                let (mean, far) = hodograph.spread(axis);
                assert!(jet[1 + axis].distance(mean) <= far, "{shape:?}: {axis}");
            }
        }
    }
}
