//! How the curvature of cups and saddles goes on around extraordinary points, step by step.
//!
//! The control points of the characteristic map are lifted to z = x² + y² or z = x² − y² and
//! refined by the local matrix, which leaves x and y in their proportions. After each step the
//! quadric that fits the control points best has a Gauss curvature in the middle: 4 and −4 at
//! first. Where curvature is bounded and does not vanish, it settles.

use carvel::analysis::surface::{Feature, LocalMatrix};
use carvel::{Extraordinary, Fraction, Scheme};
use std::f64::consts::TAU;

/// The curvature of a cup or a saddle around a feature, level after level.
struct Curved {
    /// Control points of the characteristic map, one for each orbit, and how often a turn by a
    /// sector turns them.
    points: Vec<Complex>,
    heights: Vec<Complex>,
    mode: usize,
    sizes: Vec<usize>,
    lambda: f64,
}

type Complex = [f64; 2];

fn times(a: Complex, b: Complex) -> Complex {
    [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]]
}

fn turn(mode: usize, sector: usize, n: usize) -> Complex {
    let angle = TAU * (mode * sector % n) as f64 / n as f64;
    [angle.cos(), angle.sin()]
}

/// One step for values that a turn by a sector multiplies by e^{2πi·mode/n}.
fn step(matrix: &LocalMatrix<f64>, mode: usize, values: &[Complex]) -> Vec<Complex> {
    let of_orbit = |orbit: usize| {
        // A vertex in the middle has the modes that no turn changes.
        let still = matrix.orbit_size(orbit) == 1 && !mode.is_multiple_of(matrix.sectors());
        let terms = matrix.row(orbit).map(|(from, sector, &w)| {
            let value = times(values[from], turn(mode, sector, matrix.sectors()));
            value.map(|x| w * x)
        });
        let sum = terms.fold([0.0; 2], |sum: Complex, x| [sum[0] + x[0], sum[1] + x[1]]);
        if still { [0.0; 2] } else { sum }
    };
    (0..matrix.orbits()).map(of_orbit).collect()
}

impl Curved {
    /// On z = x² + y² (mode 0) or z = x² − y² (mode 2).
    fn new(matrix: &LocalMatrix<f64>, mode: usize) -> Self {
        let mut points = vec![[1.0, 0.0]; matrix.orbits()];
        let mut lambda = 0.0;
        for _ in 0..200 {
            points = step(matrix, 1, &points);
            // The outermost orbit is never still.
            let last = points[points.len() - 1];
            lambda = last[0].hypot(last[1]);
            let unit = [last[0] / lambda / lambda, -last[1] / lambda / lambda];
            points = points.iter().map(|&p| times(p, unit)).collect();
        }
        let height = |&p: &Complex| match mode {
            0 => [p[0] * p[0] + p[1] * p[1], 0.0],
            _ => times(p, p),
        };
        let heights = points.iter().map(height).collect();
        let sizes = (0..matrix.orbits()).map(|orbit| matrix.orbit_size(orbit)).collect();
        Self { points, heights, mode, sizes, lambda }
    }

    /// The Gauss curvature, at the middle, of the quadric that fits the control points best after
    /// each of some steps.
    fn after_steps(mut self, matrix: &LocalMatrix<f64>, steps: i32) -> Vec<f64> {
        let mut found = Vec::new();
        for level in 0..=steps {
            found.push(self.curvature(matrix.sectors(), self.lambda.powi(level)));
            self.heights = step(matrix, self.mode, &self.heights);
        }
        found
    }

    fn curvature(&self, n: usize, scale: f64) -> f64 {
        let mut normal = [[0.0; 7]; 6];
        for (orbit, &size) in self.sizes.iter().enumerate() {
            for sector in 0..size {
                let [x, y] = times(self.points[orbit], turn(1, sector, n));
                let z = times(self.heights[orbit], turn(self.mode, sector, n))[0];
                let row = [x * x / 2.0, x * y, y * y / 2.0, x, y, 1.0, z];
                for (sums, a) in normal.iter_mut().zip(row) {
                    sums.iter_mut().zip(row).for_each(|(sum, b)| *sum += a * b);
                }
            }
        }
        let [l, m, n, a, b, _] = solved(normal);
        let [l, m, n] = [l, m, n].map(|x| x / (scale * scale));
        let [a, b] = [a, b].map(|x| x / scale);
        (l * n - m * m) / (1.0 + a * a + b * b).powi(2)
    }
}

/// A system of six equations by elimination.
fn solved(mut rows: [[f64; 7]; 6]) -> [f64; 6] {
    for i in 0..6 {
        let pivot = (i..6).max_by(|&a, &b| rows[a][i].abs().total_cmp(&rows[b][i].abs())).unwrap();
        rows.swap(i, pivot);
        let chosen = rows[i];
        for (_, row) in rows.iter_mut().enumerate().filter(|(j, _)| *j != i) {
            let factor = row[i] / chosen[i];
            row.iter_mut().zip(chosen).for_each(|(x, c)| *x -= factor * c);
        }
    }
    std::array::from_fn(|i| rows[i][6] / rows[i][i])
}

fn three_point() -> Scheme {
    Scheme::three_point(Fraction::new(1, 32).unwrap()).unwrap()
}

/// Gauss curvature of a cup and of a saddle after 0 to 8 steps.
fn curvatures(name: &str, scheme: &Scheme, valence: usize) -> [Vec<f64>; 2] {
    let matrix = LocalMatrix::new(scheme, Feature::Interior { valence }).unwrap();
    let found = [0, 2].map(|mode| Curved::new(&matrix, mode).after_steps(&matrix, 8));
    for (shape, values) in ["cup", "saddle"].iter().zip(&found) {
        let told: Vec<String> = values.iter().map(|k| format!("{k:.3}")).collect();
        println!("{name}, n = {valence}, {shape}: {}", told.join(" "));
    }
    found
}

/// How much the last step changes, in the logarithm.
fn drift(values: &[f64]) -> f64 {
    (values[8] / values[7]).ln()
}

/// The table in docs/analysis.md: `cargo test --all-features --test analysis cups -- --nocapture`.
#[test]
fn cups_and_saddles_settle_by_the_tuned_rule_alone() {
    let tuned = three_point().with_extraordinary(Extraordinary::Tuned).unwrap();
    for n in [3, 5, 6, 8, 12] {
        let [cup, saddle] = curvatures("tuned", &tuned, n);
        for values in [&cup, &saddle] {
            assert!(drift(values).abs() < 0.01, "n = {n}: {values:?}");
            assert!((1.0..8.0).contains(&values[8].abs()), "n = {n}: {values:?}");
        }
        assert!(cup[8] > 0.0 && saddle[8] < 0.0);
        // Flat in the limit beyond n = 4, and unbounded for triangles.
        let [cup, saddle] = curvatures("default", &three_point(), n);
        if n == 3 {
            assert!(drift(&cup) > 0.25, "{cup:?}");
        } else {
            assert!(drift(&cup) < -0.25 && drift(&saddle) > 0.1, "n = {n}: {cup:?} {saddle:?}");
        }
        // A Jordan block: roots grow by the same amount with each step.
        let [cup, saddle] = curvatures("Doo-Sabin", &Scheme::doo_sabin(), n);
        assert!(drift(&cup).abs() < 0.01, "n = {n}: {cup:?}");
        if n > 4 {
            let roots: Vec<f64> = saddle.iter().map(|k| (-k).sqrt()).collect();
            let [before, last] = [roots[7] - roots[6], roots[8] - roots[7]];
            assert!(last > 0.2 && (last / before - 1.0).abs() < 0.01, "n = {n}: {roots:?}");
        }
        let [cup, saddle] = curvatures("Catmull-Clark", &Scheme::catmull_clark(), n);
        if n > 4 {
            assert!(drift(&cup) > 0.1 && drift(&saddle) > 0.1, "n = {n}: {cup:?} {saddle:?}");
        }
    }
}
