//! Local matrices of the mesh code against closed forms and published numbers.

use carvel::analysis::surface::{
    Curvature, Feature, LimitWeights, LocalMatrix, Smoothness, Spectrum, Tangent,
};
use carvel::{Boundary, CornerRule, Fraction, LoopWeights, Scheme};
use std::f64::consts::TAU;

const CLOSE: f64 = 1e-12;

fn interior(scheme: &Scheme, valence: usize) -> (LocalMatrix<f64>, Spectrum) {
    of(scheme, Feature::Interior { valence })
}

fn of(scheme: &Scheme, feature: Feature) -> (LocalMatrix<f64>, Spectrum) {
    let matrix = LocalMatrix::new(scheme, feature).unwrap();
    let spectrum = Spectrum::new(&matrix).unwrap();
    (matrix, spectrum)
}

fn three_point(num: i64, den: i64) -> Scheme {
    Scheme::three_point(Fraction::new(num, den).unwrap()).unwrap()
}

fn assert_close(what: &str, found: f64, wanted: f64) {
    assert!((found - wanted).abs() <= CLOSE, "{what}: {found} for {wanted}");
}

/// The limit weights of an interior feature: one number for each orbit that has some.
fn limit(scheme: &Scheme, valence: usize) -> Vec<f64> {
    let (matrix, spectrum) = interior(scheme, valence);
    let weights = LimitWeights::new(&matrix, &spectrum).unwrap().position;
    let orbit = |orbit: &Vec<f64>| {
        assert!(orbit.iter().all(|w| (w - orbit[0]).abs() < CLOSE), "{orbit:?}");
        orbit[0]
    };
    weights.orbits().iter().map(orbit).collect()
}

#[test]
fn doo_sabin_shrinks_by_half_at_every_valence() {
    for n in 4..=64 {
        let (_, spectrum) = interior(&Scheme::doo_sabin(), n);
        assert_close(&format!("λ, n = {n}"), spectrum.lambda(), 0.5);
        assert_close(&format!("μ, n = {n}"), spectrum.mu(), 0.25);
    }
}

/// Its saddles: mode 2 has a Jordan block at 1/4, but for n = 4.
#[test]
fn doo_sabin_has_a_jordan_block() {
    for n in [4, 5, 6, 9] {
        let (_, spectrum) = interior(&Scheme::doo_sabin(), n);
        let mode = |e: &&carvel::analysis::surface::Eigenvalue| {
            e.mode == 2 && (e.size() - 0.25).abs() < 1e-9
        };
        let saddle = spectrum.eigenvalues().iter().find(mode).unwrap();
        assert_eq!(saddle.vectors < saddle.copies, n != 4, "n = {n}: {saddle:?}");
        let verdict = Smoothness::new(&Scheme::doo_sabin(), &spectrum).unwrap();
        let wanted = if n == 4 { Curvature::Bounded } else { Curvature::Growing };
        assert_eq!(verdict.curvature, Some(wanted), "n = {n}");
    }
}

#[test]
fn catmull_clark_follows_its_closed_forms() {
    for n in 3..=64_usize {
        let theta = TAU / n as f64;
        let root = (theta / 2.0).cos() * (2.0 * (9.0 + theta.cos())).sqrt();
        let lambda = 5.0 / 16.0 + (theta.cos() + root) / 16.0;
        let (_, spectrum) = interior(&Scheme::catmull_clark(), n);
        assert_close(&format!("λ, n = {n}"), spectrum.lambda(), lambda);
        let wanted = [(n * n) as f64, 4.0, 1.0].map(|w| w / (n * (n + 5)) as f64);
        let found = limit(&Scheme::catmull_clark(), n);
        assert_eq!(found.len(), 3, "n = {n}");
        found.iter().zip(wanted).for_each(|(&f, w)| assert_close(&format!("n = {n}"), f, w));
    }
}

#[test]
fn loop_follows_its_closed_forms() {
    for (weights, scheme) in [
        (LoopWeights::Loop, Scheme::loop_triangles()),
        (LoopWeights::Warren, Scheme::loop_triangles().with_loop_weights(LoopWeights::Warren)),
    ] {
        for n in 3..=24_usize {
            let cosine = (TAU / n as f64).cos();
            let beta = match weights {
                LoopWeights::Warren if n == 3 => 3.0 / 16.0,
                LoopWeights::Warren => 3.0 / (8.0 * n as f64),
                _ => (0.625 - (0.375 + 0.25 * cosine).powi(2)) / n as f64,
            };
            let near = 1.0 / (n as f64 + 3.0 / (8.0 * beta));
            let found = limit(&scheme, n);
            assert_close(&format!("{weights:?}, own, n = {n}"), found[0], 1.0 - n as f64 * near);
            assert_close(&format!("{weights:?}, near, n = {n}"), found[1], near);
            let (_, spectrum) = interior(&scheme, n);
            let lambda = 0.375 + 0.25 * cosine;
            let first = spectrum.eigenvalues().iter().find(|e| e.mode == 1).unwrap();
            assert_close(&format!("{weights:?}, mode 1, n = {n}"), first.size(), lambda);
        }
    }
}

/// Weights of a sector on the n-gon's corner, the two next to it and the diagonal one.
#[test]
fn dual_schemes_meet_the_middle_of_a_face_as_stated() {
    for rule in [CornerRule::Cosine, CornerRule::Average] {
        for n in [3, 4, 5, 6, 8, 13] {
            for (scheme, wanted, den) in [
                (Scheme::doo_sabin(), [1.0, 0.0, 0.0], 1.0),
                (three_point(1, 32), [4.0 * 529.0, 4.0 * 23.0, 4.0], 2304.0),
                (Scheme::quartic(), [4.0 * 121.0, 4.0 * 11.0, 4.0], 576.0),
            ] {
                let scheme = scheme.with_rule(rule);
                let mut found = limit(&scheme, n);
                found.retain(|&w| w != 0.0);
                found.resize(4, 0.0);
                found.sort_by(|a, b| b.total_cmp(a));
                let [corner, side, across] = wanted.map(|w| w / (den * n as f64));
                let what = format!("{scheme:?}, n = {n}: {found:?}");
                [corner, side, side, across]
                    .iter()
                    .zip(&found)
                    .for_each(|(&w, &f)| assert_close(&what, f, w));
            }
        }
    }
}

/// SPEC's table of subdominant eigenvalues, to the digits that it gives.
#[test]
fn three_point_shrinks_as_tabulated() {
    let valences = [3, 4, 5, 6, 8];
    for (rule, table) in [
        (CornerRule::Cosine, [0.4317, 0.5, 0.5384, 0.5614, 0.5857]),
        (CornerRule::Average, [0.3868, 0.5, 0.5792, 0.6322, 0.6932]),
    ] {
        for (n, wanted) in valences.into_iter().zip(table) {
            let (_, spectrum) = interior(&three_point(1, 32).with_rule(rule), n);
            let found = spectrum.lambda();
            assert!((found - wanted).abs() < 6e-5, "{rule:?}, n = {n}: {found} for {wanted}");
        }
    }
}

/// Catmull and Clark's quadratic scheme of 1978 is Doo and Sabin's with averages.
#[test]
fn the_quadratic_scheme_of_1978_shrinks_as_known() {
    for n in 3..=32_usize {
        let (_, spectrum) = interior(&Scheme::doo_sabin().with_rule(CornerRule::Average), n);
        let wanted = if n == 3 { 0.375 } else { 0.5 + (TAU / n as f64).cos() / 4.0 };
        assert_close(&format!("n = {n}"), spectrum.lambda(), wanted);
    }
}

/// Cubic B-splines on a boundary and along a crease: 1/6, 2/3, 1/6.
#[test]
fn boundaries_and_creases_are_curves() {
    let scheme = Scheme::catmull_clark();
    for feature in [
        Feature::Boundary { faces: 2 },
        Feature::Boundary { faces: 5 },
        Feature::Crease { faces: [2, 3] },
        Feature::Crease { faces: [1, 4] },
    ] {
        let (matrix, spectrum) = of(&scheme, feature);
        let weights = LimitWeights::new(&matrix, &spectrum).unwrap().position;
        let mut found: Vec<f64> = weights.orbits().concat();
        found.retain(|w| *w != 0.0);
        found.sort_by(f64::total_cmp);
        assert_eq!(found.len(), 3, "{feature}: {found:?}");
        for (found, wanted) in found.into_iter().zip([1.0 / 6.0, 1.0 / 6.0, 2.0 / 3.0]) {
            assert_close(&feature.to_string(), found, wanted);
        }
    }
    for feature in [Feature::Corner { faces: 1 }, Feature::Corner { faces: 4 }] {
        let (matrix, spectrum) = of(&scheme, feature);
        let weights = LimitWeights::new(&matrix, &spectrum).unwrap().position;
        assert_close(&feature.to_string(), weights.orbit(0)[0], 1.0);
    }
}

/// On the boundary of a dual scheme one direction follows the boundary curve, whose eigenvalue
/// is 1/2, and the other is that of an interior vertex with twice the faces.
#[test]
fn a_dual_boundary_is_half_an_interior() {
    for scheme in [Scheme::doo_sabin(), three_point(1, 32), Scheme::quartic()] {
        for faces in 2..=5 {
            let (_, half) = of(&scheme, Feature::Boundary { faces });
            let (_, whole) = interior(&scheme, 2 * faces);
            for wanted in [0.5, whole.lambda()] {
                let found = half.eigenvalues().iter().any(|e| (e.size() - wanted).abs() < CLOSE);
                assert!(found, "{scheme:?}, {faces} faces: {wanted}");
            }
        }
    }
}

/// With many faces the second bending of the quartic's mirror image shrinks more slowly than
/// the boundary curve, and no tangent plane is left.
#[test]
fn boundaries_with_many_faces_are_not_smooth() {
    let tangent = |scheme: &Scheme, faces| {
        let (_, spectrum) = of(scheme, Feature::Boundary { faces });
        Smoothness::new(scheme, &spectrum).unwrap().tangent
    };
    assert_eq!(tangent(&Scheme::quartic(), 4), Tangent::Continuous);
    assert_ne!(tangent(&Scheme::quartic(), 5), Tangent::Continuous);
    assert_eq!(tangent(&Scheme::doo_sabin(), 8), Tangent::Continuous);
}

#[test]
fn verdicts_are_those_of_the_literature() {
    let cases = [
        (Scheme::catmull_clark(), 3, Curvature::Vanishing),
        (Scheme::catmull_clark(), 4, Curvature::Bounded),
        (Scheme::catmull_clark(), 5, Curvature::Unbounded),
        (Scheme::loop_triangles(), 6, Curvature::Bounded),
        (Scheme::loop_triangles(), 7, Curvature::Unbounded),
        (Scheme::doo_sabin(), 3, Curvature::Bounded),
        (three_point(1, 32), 4, Curvature::Bounded),
    ];
    for (scheme, n, curvature) in cases {
        let (_, spectrum) = interior(&scheme, n);
        let verdict = Smoothness::new(&scheme, &spectrum).unwrap();
        assert_eq!(verdict.tangent, Tangent::Continuous, "{scheme:?}, n = {n}");
        assert_eq!(verdict.curvature, Some(curvature), "{scheme:?}, n = {n}: {:?}", verdict.ratio);
    }
    // Linear refinement has no tangent plane, whatever the valence.
    let (_, spectrum) = interior(&Scheme::bilinear(), 5);
    let verdict = Smoothness::new(&Scheme::bilinear(), &spectrum).unwrap();
    assert_ne!(verdict.tangent, Tangent::Continuous);
}

/// Eigenvalues that are almost the same are no Jordan block.
#[test]
fn near_eigenvalues_are_two() {
    let scheme = three_point(1, 10_000_000);
    let (_, spectrum) = of(&scheme, Feature::Boundary { faces: 3 });
    assert!(spectrum.all().take(3).all(|e| e.copies == e.vectors), "{:?}", spectrum.eigenvalues());
    let verdict = Smoothness::new(&scheme, &spectrum).unwrap();
    assert_eq!(verdict.tangent, Tangent::Continuous);
}

/// The second tangent lies a quarter of a turn after the first, counter-clockwise.
#[test]
fn tangents_turn_counter_clockwise() {
    for scheme in [Scheme::catmull_clark(), Scheme::doo_sabin(), Scheme::loop_triangles()] {
        for n in [5, 8] {
            let (matrix, spectrum) = interior(&scheme, n);
            let weights = LimitWeights::new(&matrix, &spectrum).unwrap();
            let [along, across] = weights.tangents.expect("a tangent plane");
            // A regular star in the plane: the sum over its vertices is the tangent itself.
            let orbit = (0..matrix.orbits()).find(|&i| matrix.orbit_size(i) == n).unwrap();
            let sum = |weights: &[f64]| {
                let turn = |k: usize| TAU * k as f64 / n as f64;
                let x: f64 = weights.iter().enumerate().map(|(k, w)| w * turn(k).cos()).sum();
                let y: f64 = weights.iter().enumerate().map(|(k, w)| w * turn(k).sin()).sum();
                [x, y]
            };
            let ([x, y], [u, v]) = (sum(along.orbit(orbit)), sum(across.orbit(orbit)));
            assert!(x * v - y * u > 0.1, "{scheme:?}, n = {n}: {x} {y}, {u} {v}");
        }
    }
}

#[test]
fn what_cannot_be_analysed_is_refused() {
    let refused = |scheme: &Scheme, feature: Feature| {
        LocalMatrix::<f64>::new(scheme, feature).unwrap_err().to_string()
    };
    for valence in [0, 2, 513, usize::MAX] {
        let message = refused(&Scheme::doo_sabin(), Feature::Interior { valence });
        assert!(message.contains("3 to 512"), "{message}");
    }
    let message = refused(&Scheme::catmull_clark(), Feature::Crease { faces: [0, 4] });
    assert!(message.contains("crease"), "{message}");
    let open = Scheme::doo_sabin().with_boundary(Boundary::None);
    let message = refused(&open, Feature::Boundary { faces: 2 });
    assert!(message.contains("no face there"), "{message}");
}
