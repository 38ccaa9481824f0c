//! Circles, conics and polynomials that are kept; waves that shrink.

use std::f64::consts::TAU;

use carvel::Context;
use carvel::analysis::mask::{Degrees, FrequencyResponse, Response};
use carvel::curve::rational::ratio;
use carvel::curve::{
    Ends, Polygon, Rational, Tension, limit_stencil, sample_derivative, sample_limit,
};
use num_traits::{One, Zero, pow};

use crate::support::{named, q, schemes};

/// Points on a conic after some steps.
const CONIC: f64 = 1e-14;

fn context() -> Context {
    Context::serial()
}

fn polygon(n: usize, at: impl Fn(f64) -> [f64; 2], ends: Ends) -> Polygon<f64> {
    Polygon::new((0..n).flat_map(|i| at(i as f64)).collect(), 2, ends)
}

#[test]
fn six_points_make_a_circle() {
    for n in [4, 5, 6, 12] {
        let on_circle = |i: f64| [(TAU * i / n as f64).cos(), (TAU * i / n as f64).sin()];
        let control = polygon(n, on_circle, Ends::Closed);
        let curve = control.refine_with_tension(&context(), Tension::circle(n), 8).expect("points");
        assert_eq!(curve.len(), n << 8);
        let local = vec![(TAU / n as f64).cos(); n];
        let same = control.refine_with_local_tension(&context(), &local, 8).expect("points");
        for polygon in [&curve, &same] {
            for (i, p) in polygon.points.chunks(2).enumerate() {
                let expected = on_circle(i as f64 / 256.0);
                let apart = (p[0] - expected[0]).hypot(p[1] - expected[1]);
                assert!(apart <= CONIC, "{n} points: {p:?} is {apart} off");
            }
        }
    }
}

#[test]
fn ellipses_parabolas_and_hyperbolas_are_kept() {
    let cosh = 0.4_f64.cosh();
    let check = |tension: f64, curve: &dyn Fn(f64) -> [f64; 2], scale: f64| {
        let control = polygon(9, curve, Ends::Dropped);
        let refined = control.refine_with_tension(&context(), Tension::FourPoint(tension), 5);
        let refined = refined.expect("points");
        // Two points go at either end with the first step, and again with each.
        let known = |p: &[f64], t: f64| {
            let e = curve(t);
            (p[0] - e[0]).hypot(p[1] - e[1]) <= 4.0 * CONIC * scale
        };
        let first = (0..9 * 64).find(|&i| known(refined.point(0), i as f64 / 32.0)).expect("one");
        for (i, p) in refined.points.chunks(2).enumerate() {
            assert!(known(p, (first + i) as f64 / 32.0), "{tension}: point {i}, {p:?}");
        }
    };
    check(0.3_f64.cos(), &|t| [3.0 * (0.3 * t).cos(), (0.3 * t).sin() - 1.0], 3.0);
    check(1.0, &|t| [t, t * t / 8.0 - t], 8.0);
    check(cosh, &|t| [(0.4 * (t - 4.0)).cosh(), 2.0 * (0.4 * (t - 4.0)).sinh()], 5.0);
}

/// A tension of 1 is Dubuc's scheme, and no local differences are none.
#[test]
fn no_tension_is_the_stationary_scheme() {
    for ends in [Ends::Closed, Ends::Dropped, Ends::Kept] {
        let control = polygon(8, |i| [i, (i * 1.7).sin()], ends);
        let plain = control.refine(&context(), &named("four-point:1/16"), 3).expect("points");
        let edges = 8 - usize::from(ends != Ends::Closed);
        for other in [
            control.refine_with_tension(&context(), Tension::FourPoint(1.0), 3).expect("points"),
            control.refine_with_local_tension(&context(), &vec![1.0; edges], 3).expect("points"),
            control.refine_non_uniform(&context(), &vec![0.7; edges], 3).expect("points"),
        ] {
            assert_eq!((other.ends, other.len()), (plain.ends, plain.len()));
            let apart = other.points.iter().zip(&plain.points).map(|(a, b)| (a - b).abs());
            assert!(apart.fold(0.0, f64::max) <= 4.0 * CONIC, "{ends:?}");
        }
    }
}

#[test]
fn the_ternary_tension_scheme_becomes_its_limit() {
    let control = polygon(7, |i| [i, (i * 2.1).cos()], Ends::Closed);
    // β = 2 stays 2: the stationary scheme with μ = 1/10.
    let made = control.refine_with_tension(&context(), Tension::TernaryFourPoint(2.0), 3);
    let plain = control.refine(&context(), &named("ternary-four-point:1/10"), 3).expect("points");
    let made = made.expect("points");
    let apart = made.points.iter().zip(&plain.points).map(|(a, b)| (a - b).abs());
    assert!(apart.fold(0.0, f64::max) <= 4.0 * CONIC);
}

/// Cubics on their own parameters, however they are spaced.
#[test]
fn uneven_parameters_keep_cubics() {
    let intervals = [1.0, 0.25, 3.0, 0.5, 2.0, 1.5, 0.75];
    let mut t = vec![0.0];
    for d in intervals {
        t.push(t[t.len() - 1] + d);
    }
    let cubic = |t: f64| 0.2 * t * t * t - t * t + 3.0 * t - 1.0;
    let control = t.iter().flat_map(|&t| [t, cubic(t)]).collect();
    let control = Polygon::new(control, 2, Ends::Dropped);
    let refined = control.refine_non_uniform(&context(), &intervals, 3).expect("points");
    assert!(refined.len() > 20);
    for p in refined.points.chunks(2) {
        assert!((p[1] - cubic(p[0])).abs() <= 1e-12, "{p:?}");
    }
    let square =
        polygon(4, |i| [[0.0, 1.0, 1.0, 0.0][i as usize], f64::from(i > 1.5)], Ends::Closed);
    assert_eq!(square.parameters(0.5).expect("lengths"), [1.0; 4]);
    let long = Polygon::new(vec![0.0, 0.0, 4.0, 3.0], 2, Ends::Kept);
    assert_eq!(long.parameters(1.0).expect("lengths"), [5.0]);
}

/// Point `j` of a polygon and interval `j` beside it, continued by wrapping or mirroring.
fn continued(polygon: &Polygon<f64>, of_edges: &[f64], j: i64) -> (f64, f64) {
    let (n, edges) = (polygon.len() as i64, of_edges.len() as i64);
    let at = |j: i64| polygon.points[j as usize];
    if polygon.ends == Ends::Closed {
        return (at(j.rem_euclid(n)), of_edges[j.rem_euclid(edges) as usize]);
    }
    let point = match j {
        _ if j < 0 => 2.0 * at(0) - at(-j),
        _ if j >= n => 2.0 * at(n - 1) - at(2 * n - 2 - j),
        _ => at(j),
    };
    let edge = if j < 0 { -1 - j } else { j.min(2 * edges - 1 - j) };
    (point, of_edges[edge as usize])
}

/// One step by the formula as it stands, with what the edges' halves inherit.
fn naive(
    polygon: &Polygon<f64>,
    of_edges: &[f64],
    rule: impl Fn([f64; 3], [f64; 4]) -> f64,
    half: impl Fn(f64) -> f64,
) -> (Polygon<f64>, Vec<f64>) {
    let (mut points, mut halves) = (Vec::new(), Vec::new());
    for (i, own) in of_edges.iter().enumerate() {
        let at = |s: i64| continued(polygon, of_edges, i as i64 + s);
        points.push(polygon.points[i]);
        points.push(rule([-1, 0, 1].map(|s| at(s).1), [-1, 0, 1, 2].map(|s| at(s).0)));
        halves.extend([half(*own); 2]);
    }
    if polygon.ends != Ends::Closed {
        points.push(polygon.points[of_edges.len()]);
    }
    (Polygon::new(points, 1, polygon.ends), halves)
}

#[track_caller]
fn nearly(a: &Polygon<f64>, b: &Polygon<f64>) {
    assert_eq!((a.len(), a.ends), (b.len(), b.ends));
    let apart = a.points.iter().zip(&b.points).map(|(a, b)| (a - b).abs());
    assert!(apart.fold(0.0, f64::max) <= 1e-12, "{a:?}, {b:?}");
}

#[test]
fn each_edge_has_its_own_tension_or_interval() {
    for ends in [Ends::Closed, Ends::Kept] {
        let control = Polygon::new(vec![0.0, 3.0, -1.0, 4.0, 1.0, -5.0], 1, ends);
        let edges = [0.3, 2.0, -0.5, 1.0, 0.7, 5.0];
        let edges = &edges[..6 - usize::from(ends == Ends::Kept)];
        let next = |v: f64| f64::midpoint(1.0, v).sqrt();
        let tension = |v: [f64; 3], p: [f64; 4]| {
            let w = 1.0 / (8.0 * next(v[1]) * (1.0 + next(v[1])));
            (0.5 + w) * (p[1] + p[2]) - w * (p[0] + p[3])
        };
        let (once, halves) = naive(&control, edges, tension, next);
        let (twice, _) = naive(&once, &halves, tension, next);
        nearly(&control.refine_with_local_tension(&context(), edges, 2).expect("points"), &twice);
        let edges = edges.iter().map(|v| v + 1.0).collect::<Vec<_>>();
        // Neville's scheme, not Lagrange's weights.
        let cubic = |d: [f64; 3], p: [f64; 4]| {
            let (t, x) = ([-d[0], 0.0, d[1], d[1] + d[2]], d[1] / 2.0);
            let mut p = p;
            for k in 1..4 {
                for i in 0..4 - k {
                    p[i] = ((x - t[i]) * p[i + 1] + (t[i + k] - x) * p[i]) / (t[i + k] - t[i]);
                }
            }
            p[0]
        };
        let (once, halves) = naive(&control, &edges, cubic, |d| d / 2.0);
        let (twice, _) = naive(&once, &halves, cubic, |d| d / 2.0);
        nearly(&control.refine_non_uniform(&context(), &edges, 2).expect("points"), &twice);
    }
}

/// Data of a polynomial at the scheme's parameters go to data of the same
/// polynomial at the next level's parameters, to the stated degree and not beyond.
#[test]
fn polynomials_are_reproduced_to_their_degree_exactly() {
    for scheme in schemes() {
        let mask = scheme.mask();
        let degrees = Degrees::of(&mask);
        assert_eq!(Some(degrees.reproduction), scheme.count("reproduction_degree"));
        for d in 0..=degrees.reproduction + 1 {
            let kept = keeps_power(&mask, d);
            assert_eq!(kept, d <= degrees.reproduction, "{}: degree {d}", scheme.name);
        }
    }
}

fn keeps_power(mask: &carvel::curve::Mask, degree: usize) -> bool {
    let (m, tau) = (mask.arity() as i64, mask.tau());
    let n = mask.coefficients().len() as i64 + 8;
    let data = (0..n).map(|j| pow(ratio(j, 1), degree)).collect();
    let refined = Polygon::new(data, 1, Ends::Closed).refine(&context(), mask, 1).expect("points");
    // Away from where the polygon is closed: point i belongs to (i − τ)/m.
    let reach = mask.coefficients().len() as i64 / m + 2;
    (m * reach..m * (n - reach)).all(|i| {
        let place = (ratio(i, 1) - &tau) / ratio(m, 1);
        refined.points[i as usize] == pow(place, degree)
    })
}

#[test]
fn the_limit_function_at_dyadic_places() {
    // The cubic B-spline by its own formula.
    let (first, values) = sample_limit(&context(), &named("b-spline:3"), 3).expect("values");
    let spline = |x: &Rational| {
        let x = num_traits::abs(x.clone());
        let (one, two) = (Rational::one(), ratio(2, 1));
        if x < one {
            ratio(2, 3) - &x * &x + &x * &x * &x / &two
        } else {
            pow(&two - x, 3) / ratio(6, 1)
        }
    };
    assert_eq!((first, values.len()), (-15, 31));
    for (i, value) in (first..).zip(&values) {
        assert_eq!(*value, spline(&ratio(i, 8)), "at {i}/8");
    }
    // Shifts add up to 1 wherever one looks.
    let (first, values) =
        sample_limit(&context(), &named("ternary-four-point"), 2).expect("values");
    for residue in 0..9 {
        let of_class = (first..).zip(&values).filter(|(i, _)| i.rem_euclid(9) == residue);
        assert_eq!(of_class.map(|(_, v)| v).sum::<Rational>(), q("1"));
    }
    assert!(values.iter().any(|v| !v.is_zero()));
}

#[test]
fn waves_shrink_as_the_splines_transform_says() {
    for (name, factors) in
        [("chaikin", 3), ("b-spline:3", 4), ("b-spline:3,3", 4), ("b-spline:1", 2)]
    {
        for n in [4.0, 6.0, 20.0] {
            let response = Response::of(&named(name), n).expect("a response");
            let half = std::f64::consts::PI / n;
            let sinc = |x: f64| (x.sin() / x).powi(factors).abs();
            assert!((response.gain - sinc(half)).abs() < 1e-12, "{name}, {n}");
            let squares = (1..2000).map(f64::from).map(|k| {
                let at = |k: f64| sinc(half + std::f64::consts::PI * k).powi(2);
                at(k) + at(-k)
            });
            let artifact = squares.sum::<f64>().sqrt() / sinc(half);
            assert!((response.artifact - artifact).abs() < 2e-4 * artifact, "{name}, {n}");
        }
    }
    // The mean radius of the limit of a hexagon: an independent measurement of the gain.
    let mask = named("three-point:1/32");
    let hexagon = polygon(6, |i| [(TAU * i / 6.0).cos(), (TAU * i / 6.0).sin()], Ends::Closed);
    let fine = hexagon.refine(&context(), &mask, 10).expect("points");
    let turn = |i: usize| TAU * (i as f64 + 0.5) / fine.len() as f64;
    let wave = (0..fine.len()).map(|i| {
        let (p, a) = (fine.point(i), turn(i));
        [p[0] * a.cos() + p[1] * a.sin(), p[1] * a.cos() - p[0] * a.sin()]
    });
    let sum = wave.fold([0.0, 0.0], |s, w| [s[0] + w[0], s[1] + w[1]]);
    let gain = sum[0].hypot(sum[1]) / fine.len() as f64;
    let response = Response::of(&mask, 6.0).expect("a response");
    assert!((gain - response.gain).abs() < 1e-5, "{gain}, {response:?}");
}

/// Samples of the limit function's derivatives are the weights that limit stencils give to one
/// control point.
#[test]
fn sampled_derivatives_are_those_of_stencils() {
    for (name, derivatives) in
        [("three-point:1/32", 3), ("b-spline:3", 3), ("b-spline:3,3", 2), ("four-point", 2)]
    {
        let mask = named(name);
        let unit = (mask.arity() as i64).pow(2);
        for derivative in 0..derivatives {
            let sampled = sample_derivative(&Context::serial(), &mask, derivative, 2);
            let (first, values) = sampled.expect("samples");
            for i in first - 3..first + values.len() as i64 + 3 {
                // The weight of the point at 0.
                let at = limit_stencil(&Context::serial(), &mask, &ratio(i, unit), derivative);
                let at = at.expect("a stencil");
                let weight = usize::try_from(-at.first).ok().and_then(|k| at.weights.get(k));
                let value = usize::try_from(i - first).ok().and_then(|k| values.get(k));
                let zero = ratio(0, 1);
                assert_eq!(
                    value.unwrap_or(&zero),
                    weight.unwrap_or(&zero),
                    "{name}, derivative {derivative} at {i}/{unit}"
                );
            }
        }
    }
}

/// The limit function of a B-spline of degree d is a box convolved with itself d times.
#[test]
fn frequencies_of_b_splines_are_powers_of_sinc() {
    for (name, degree, arity) in [("chaikin", 2, 2), ("b-spline:3", 3, 2), ("b-spline:4,3", 4, 3)] {
        let response = FrequencyResponse::new(&named(name));
        for i in 1..40 {
            let omega = f64::from(i) * 0.17;
            let sinc = |x: f64| (x / 2.0).sin() / (x / 2.0);
            let limit = sinc(omega).abs().powi(degree + 1);
            assert!((response.limit(omega) - limit).abs() < 1e-12, "{name} at {omega}");
            let box_of_mask = (sinc(f64::from(arity) * omega) / sinc(omega)).abs();
            let mask = box_of_mask.powi(degree + 1);
            assert!((response.mask(omega) - mask).abs() < 1e-12, "{name} at {omega}");
        }
        assert!((response.mask(0.0) - 1.0).abs() < 1e-15, "{name}");
    }
}
