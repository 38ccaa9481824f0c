//! Regular grids against closed forms and the limits of their refined vertices.

use super::{Shape, WIDTH, assert_near, at, bases, dual_schemes, fraction, primal_schemes};
use carvel::limit::Derivatives;
use carvel::{Boundary, Context, Hierarchy, Scheme};

/// Derivatives of the cardinal B-spline over [0, degree + 1], by truncated powers (Schoenberg).
fn cardinal(degree: usize, x: f64, order: usize) -> f64 {
    if order > degree || !(0.0..=(degree + 1) as f64).contains(&x) {
        return 0.0;
    }
    let power = degree - order;
    let mut binomial = 1.0;
    let mut sum = 0.0;
    for k in 0..=degree + 1 {
        let y = x - k as f64;
        if y > 0.0 {
            sum += binomial * y.powi(power as i32);
        }
        binomial *= -((degree + 1 - k) as f64) / (k + 1) as f64;
    }
    sum / (1..=power).map(|k| k as f64).product::<f64>()
}

const AROUND: i32 = 7;
const ACROSS: i32 = 6;
const PARTIALS: [[usize; 2]; 6] = [[0, 0], [1, 0], [0, 1], [2, 0], [1, 1], [0, 2]];

/// A tensor product of functions of one variable, all around the torus.
fn tensor(values: &[f64], [x, y]: [f64; 2], basis: impl Fn(f64, usize) -> f64) -> Vec<f64> {
    let mut out = Vec::new();
    for [by_x, by_y] in PARTIALS {
        let mut sum = [0.0; WIDTH];
        for (i, j) in (-9..18_i32).flat_map(|i| (-9..18_i32).map(move |j| (i, j))) {
            let weight = basis(x - f64::from(i), by_x) * basis(y - f64::from(j), by_y);
            let v = (i.rem_euclid(AROUND) * ACROSS + j.rem_euclid(ACROSS)) as usize;
            (0..WIDTH).for_each(|k| sum[k] += weight * values[WIDTH * v + k]);
        }
        out.extend(sum);
    }
    out
}

#[test]
fn splines_are_those_of_truncated_powers() {
    let shape = Shape::new(&bases::torus(AROUND as usize, ACROSS as usize));
    let degrees = (1..=6).map(|degree| (Scheme::b_spline(degree).unwrap(), degree as usize));
    for (scheme, degree) in degrees.chain([(Scheme::catmull_clark(), 3)]) {
        let surface = shape.surface(&scheme);
        for (i, j, [u, v]) in [(0, 0, [0.2, 0.7]), (6, 5, [0.9, 0.6]), (3, 2, [0.5 + 1e-9, 0.3])] {
            let centred =
                |x: f64, order: usize| cardinal(degree, x + (degree + 1) as f64 / 2.0, order);
            let place = [f64::from(i) + u, f64::from(j) + v];
            let expected = tensor(&shape.values, place, centred);
            let sample = at((i * ACROSS + j) as usize, 0, [u, v]);
            let found = shape.evaluate(&surface, sample, Derivatives::Second);
            assert_near(&found, &expected, 1e-10, &format!("degree {degree} at {place:?}"));
        }
    }
}

#[test]
fn the_papers_scheme_has_the_stencils_of_the_specification() {
    let shape = Shape::new(&bases::torus(AROUND as usize, ACROSS as usize));
    let surface = shape.surface(&Scheme::three_point(fraction(1, 32)).unwrap());
    let stencil = |at: f64, order: usize| -> Vec<(f64, f64)> {
        let (over, list): (f64, &[f64]) = match (at > 0.25, order) {
            (false, 0) => (1536.0, &[1.0, 252.0, 1030.0, 252.0, 1.0]),
            (true, 0) => (48.0, &[1.0, 23.0, 23.0, 1.0]),
            (false, 1) => (160.0, &[-1.0, -78.0, 0.0, 78.0, 1.0]),
            _ => (10.0, &[-1.0, -7.0, 7.0, 1.0]),
        };
        let middle = at - (list.len() - 1) as f64 / 2.0;
        list.iter().enumerate().map(|(i, w)| (middle + i as f64, w / over)).collect()
    };
    for uv in [[0.0, 0.0], [0.5, 0.0], [0.5, 0.5], [0.0, 0.5]] {
        let basis = |x: f64, order: usize, at: f64| {
            let found = stencil(at, order).into_iter().find(|(i, _)| (i - (at - x)).abs() < 1e-9);
            found.map_or(0.0, |(_, weight)| weight)
        };
        let place = [3.0 + uv[0], 2.0 + uv[1]];
        for [by_x, by_y] in [[0, 0], [1, 0], [0, 1]] {
            let mut sum = [0.0; WIDTH];
            for (i, j) in (-2..14_i32).flat_map(|i| (-2..14_i32).map(move |j| (i, j))) {
                let weight = basis(place[0] - f64::from(i), by_x, uv[0])
                    * basis(place[1] - f64::from(j), by_y, uv[1]);
                let v = (i.rem_euclid(AROUND) * ACROSS + j.rem_euclid(ACROSS)) as usize;
                (0..WIDTH).for_each(|k| sum[k] += weight * shape.values[WIDTH * v + k]);
            }
            let sample = at((3 * ACROSS + 2) as usize, 0, uv);
            let found = shape.evaluate(&surface, sample, Derivatives::First);
            let record = by_x + 2 * by_y;
            let found = &found[record * WIDTH..][..WIDTH];
            assert_near(found, &sum, 1e-13, &format!("{uv:?}, derivative {by_x} {by_y}"));
        }
    }
}

/// On an open grid over the plane linear functions stay as they are, so that a refined vertex
/// says itself at which point of the surface it lies. It comes nearer by the square of the step.
#[test]
fn open_grids_go_where_refinement_goes() {
    let (width, height) = (5, 4);
    let mut shape = Shape::new(&bases::grid(width, height));
    for (v, record) in shape.values.chunks_exact_mut(WIDTH).enumerate() {
        record[..2].copy_from_slice(&[(v / (height + 1)) as f64, (v % (height + 1)) as f64]);
    }
    let mut schemes = primal_schemes();
    schemes.retain(|scheme| *scheme != Scheme::catmull_clark());
    schemes.push(Scheme::catmull_clark().with_boundary(Boundary::EdgeAndCorner));
    schemes.extend(dual_schemes());
    for scheme in schemes {
        let surface = shape.surface(&scheme);
        let hierarchy =
            Hierarchy::new(&Context::serial(), shape.mesh.clone(), scheme.clone(), 4).unwrap();
        let distance = |level: u32| {
            let mut refined = vec![0.0; WIDTH * hierarchy.mesh(level).vertices()];
            let context = Context::serial();
            hierarchy.refine(&context, level, &shape.values, WIDTH, &mut refined).unwrap();
            let apart = |expected: &[f64]| {
                let [x, y] = [expected[0], expected[1]];
                let last = [width as f64 - 1.0, height as f64 - 1.0];
                let cell = [x.floor().clamp(0.0, last[0]), y.floor().clamp(0.0, last[1])];
                let local = [x - cell[0], y - cell[1]].map(|x| x.clamp(0.0, 1.0));
                let face = cell[0] as usize * height + cell[1] as usize;
                let found = shape.point(&surface, at(face, 0, local));
                assert_near(&found[..2], &expected[..2], 1e-12, "the plane");
                (found[3] - expected[3]).abs()
            };
            refined.chunks_exact(WIDTH).map(apart).fold(0.0, f64::max)
        };
        let [coarse, fine] = [2, 4].map(distance);
        assert!(fine <= 1e-12 || fine < coarse / 10.0, "{scheme:?}: {coarse}, then {fine}");
    }
}
