//! The tuned rule of three-point(1/32): its local matrices are what they are made for.

use carvel::analysis::surface::{
    Curvature, Feature, LimitWeights, LocalMatrix, Smoothness, Spectrum, Tangent,
};
use carvel::{Extraordinary, Fraction, Scheme};

/// λ and μ of the rule, for all n.
const EIGENVALUE: f64 = 1e-10;

fn three_point() -> Scheme {
    Scheme::three_point(Fraction::new(1, 32).unwrap()).unwrap()
}

fn tuned() -> Scheme {
    three_point().with_extraordinary(Extraordinary::Tuned).unwrap()
}

fn matrix(scheme: &Scheme, valence: usize) -> LocalMatrix<f64> {
    LocalMatrix::new(scheme, Feature::Interior { valence }).unwrap()
}

/// 1, then ½ in the modes ±1, then ¼ in the modes 0 and ±2, everything else smaller; for n = 3
/// mode −2 is mode 1.
#[test]
fn eigenvalues_are_those_of_a_surface_with_curvature() {
    for n in (3..=32).filter(|&n| n != 4) {
        let matrix = matrix(&tuned(), n);
        let spectrum = Spectrum::new(&matrix).unwrap();
        let mut wanted = vec![(1.0, 0), (0.5, 1), (0.25, 0), (0.25, if n == 3 { 1 } else { 2 })];
        for e in spectrum.eigenvalues() {
            let near = |&(size, mode): &(f64, usize)| {
                e.mode == mode && (e.value[0] - size).abs() <= EIGENVALUE
            };
            if let Some(place) = wanted.iter().position(near) {
                assert_eq!((e.value[1], e.copies, e.vectors), (0.0, 1, 1), "n = {n}: {e:?}");
                wanted.remove(place);
            } else {
                assert!(e.size() < 0.25 - 1e-3, "n = {n}: {e:?}");
            }
        }
        assert!(wanted.is_empty(), "n = {n}: without {wanted:?}");
        let verdict = Smoothness::new(&tuned(), &spectrum).unwrap();
        assert_eq!(verdict.tangent, Tangent::Continuous, "n = {n}");
        assert_eq!(verdict.curvature, Some(Curvature::Bounded), "n = {n}");
    }
}

#[test]
fn rows_sum_to_one_and_are_not_negative() {
    for n in 3..=32 {
        for row in matrix(&tuned(), n).dense() {
            assert!((row.iter().sum::<f64>() - 1.0).abs() <= 1e-14, "n = {n}");
            assert!(row.iter().all(|&w| w >= 0.0), "n = {n}");
        }
    }
}

/// There is no rule for quads, and none for more than 32 sides.
#[test]
fn other_sizes_are_as_they_were() {
    for n in [4, 33] {
        assert_eq!(matrix(&tuned(), n).dense(), matrix(&three_point(), n).dense(), "n = {n}");
    }
    assert_ne!(matrix(&tuned(), 32).dense(), matrix(&three_point(), 32).dense());
}

/// Where the middle of the face goes, as the data say: n times the weights of A, B, C and D.
#[test]
fn limits_are_those_of_the_data() {
    for (n, [a, b, d]) in [
        (3, [0.840_003_665_275_741, 0.079_276_859_892_485, 0.001_442_614_939_288]),
        (5, [0.925_427_606_388_167, 0.036_817_029_865_78, 0.000_938_333_880_272]),
        (8, [0.954_831_877_904_845, 0.021_676_117_255_698, 0.001_815_887_583_759]),
    ] {
        let matrix = matrix(&tuned(), n);
        let spectrum = Spectrum::new(&matrix).unwrap();
        let weights = LimitWeights::new(&matrix, &spectrum).unwrap().position;
        let mut found: Vec<f64> = weights.orbits().iter().map(|w| n as f64 * w[0]).collect();
        found.retain(|&w| w != 0.0);
        found.sort_by(|a, b| b.total_cmp(a));
        assert_eq!(found.len(), 4, "n = {n}");
        for (found, wanted) in found.iter().zip([a, b, b, d]) {
            assert!((found - wanted).abs() < 1e-13, "n = {n}: {found} for {wanted}");
        }
    }
}
