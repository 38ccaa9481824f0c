//! How curvature goes on from step to step around an interior feature.
//!
//! The control points of the characteristic map are lifted to z = x² + y² (a cup) or
//! z = x² − y² (a saddle) and refined by the local matrix, which leaves x and y in their
//! proportions. After each step the quadric that fits the control points best has a Gauss curvature
//! in the middle: 4 and −4 at first. Where curvature is bounded and does not vanish, it settles.

use super::{Feature, LocalMatrix};
use crate::base::{Error, ErrorKind, Result};
use faer::linalg::solvers::Solve;
use faer::{Col, Mat};
use std::f64::consts::TAU;

/// Steps of the power iteration for the characteristic map: λ is above all other eigenvalues of
/// its mode by far.
const ROUNDS: usize = 200;

type Complex = [f64; 2];

/// Gauss curvature of a cup and a saddle around a feature, before the first step and after each.
#[derive(Debug, Clone, PartialEq)]
pub struct CupsAndSaddles {
    /// Of the cup: 4 at first.
    pub cup: Vec<f64>,
    /// Of the saddle: −4 at first.
    pub saddle: Vec<f64>,
}

impl CupsAndSaddles {
    /// Refines both, `steps` times; each step costs one product with the local matrix.
    ///
    /// # Errors
    /// [`ErrorKind::Unsupported`] for a feature that is not [`Feature::Interior`].
    pub fn new(matrix: &LocalMatrix<f64>, steps: u32) -> Result<Self> {
        if !matches!(matrix.feature(), Feature::Interior { .. }) {
            let message = "cups and saddles are refined around interior features only";
            return Err(Error::new(ErrorKind::Unsupported, message));
        }
        let map = Map::new(matrix);
        Ok(Self { cup: map.curvatures(matrix, 0, steps), saddle: map.curvatures(matrix, 2, steps) })
    }
}

fn times(a: Complex, b: Complex) -> Complex {
    [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]]
}

fn turn(mode: usize, sector: usize, n: usize) -> Complex {
    let angle = TAU * (mode * sector % n) as f64 / n as f64;
    [libm::cos(angle), libm::sin(angle)]
}

/// One step for values that a turn by a sector multiplies by e^{2πi·mode/n}, one for each orbit.
fn step(matrix: &LocalMatrix<f64>, mode: usize, values: &[Complex]) -> Vec<Complex> {
    let of_orbit = |orbit: usize| {
        // A vertex in the middle has the modes that no turn changes.
        if matrix.orbit_size(orbit) == 1 && !mode.is_multiple_of(matrix.sectors()) {
            return [0.0; 2];
        }
        matrix.row(orbit).fold([0.0; 2], |sum: Complex, (from, sector, &w)| {
            let value = times(values[from], turn(mode, sector, matrix.sectors()));
            [sum[0] + w * value[0], sum[1] + w * value[1]]
        })
    };
    (0..matrix.orbits()).map(of_orbit).collect()
}

/// Control points of the characteristic map, and λ.
struct Map {
    points: Vec<Complex>,
    lambda: f64,
}

impl Map {
    fn new(matrix: &LocalMatrix<f64>) -> Self {
        let (mut points, mut lambda) = (vec![[1.0, 0.0]; matrix.orbits()], 0.0);
        for _ in 0..ROUNDS {
            points = step(matrix, 1, &points);
            // The outermost orbit is never in the middle.
            let last = points[points.len() - 1];
            lambda = libm::hypot(last[0], last[1]);
            let unit = [last[0] / lambda / lambda, -last[1] / lambda / lambda];
            for p in &mut points {
                *p = times(*p, unit);
            }
        }
        Self { points, lambda }
    }

    /// Curvatures of z = x² + y² (mode 0) or z = x² − y² (mode 2).
    fn curvatures(&self, matrix: &LocalMatrix<f64>, mode: usize, steps: u32) -> Vec<f64> {
        let height = |&p: &Complex| match mode {
            0 => [p[0] * p[0] + p[1] * p[1], 0.0],
            _ => times(p, p),
        };
        let mut heights: Vec<_> = self.points.iter().map(height).collect();
        let mut scale = 1.0;
        let mut found = Vec::new();
        for _ in 0..=steps {
            found.push(self.curvature(matrix, mode, &heights, scale));
            heights = step(matrix, mode, &heights);
            scale *= self.lambda;
        }
        found
    }

    /// Gauss curvature, in the middle, of the quadric that fits best, x and y being this much
    /// smaller than the map's.
    fn curvature(
        &self,
        matrix: &LocalMatrix<f64>,
        mode: usize,
        heights: &[Complex],
        scale: f64,
    ) -> f64 {
        let mut normal = Mat::<f64>::zeros(6, 6);
        let mut right = Col::<f64>::zeros(6);
        for (orbit, (&point, &height)) in self.points.iter().zip(heights).enumerate() {
            for sector in 0..matrix.orbit_size(orbit) {
                let [x, y] = times(point, turn(1, sector, matrix.sectors()));
                let z = times(height, turn(mode, sector, matrix.sectors()))[0];
                let row = [x * x / 2.0, x * y, y * y / 2.0, x, y, 1.0];
                for (i, a) in row.iter().enumerate() {
                    right[i] += a * z;
                    row.iter().enumerate().for_each(|(j, b)| normal[(i, j)] += a * b);
                }
            }
        }
        let quadric = normal.partial_piv_lu().solve(&right);
        let [l, m, n] = [0, 1, 2].map(|i| quadric[i] / (scale * scale));
        let [a, b] = [3, 4].map(|i| quadric[i] / scale);
        let steepness = 1.0 + a * a + b * b;
        (l * n - m * m) / (steepness * steepness)
    }
}
