//! How the curvature of cups and saddles goes on around extraordinary points, step by step.

use carvel::analysis::surface::{CupsAndSaddles, Feature, LocalMatrix};
use carvel::{Extraordinary, Fraction, Scheme};

fn three_point() -> Scheme {
    Scheme::three_point(Fraction::new(1, 32).unwrap()).unwrap()
}

/// Gauss curvature of a cup and of a saddle after 0 to 8 steps.
fn curvatures(name: &str, scheme: &Scheme, valence: usize) -> [Vec<f64>; 2] {
    let matrix = LocalMatrix::new(scheme, Feature::Interior { valence }).unwrap();
    let CupsAndSaddles { cup, saddle } = CupsAndSaddles::new(&matrix, 8).unwrap();
    let found = [cup, saddle];
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
