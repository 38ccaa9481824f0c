//! Bounds on joint spectral radii, against norms of powers and against products.

use carvel::Context;
use carvel::analysis::mask::{JointRadius, PowerNorms};
use carvel::curve::Laurent;
use carvel::curve::rational::{ratio, to_f64};

use crate::rng::Rng;

/// ‖Sᴸ‖^(1/L) is never below the radius, and comes near it: within the factor that the size of
/// the windows allows.
#[test]
fn bounds_and_norms_of_powers_agree() {
    let mut rng = Rng::new(5);
    let mut tight = 0;
    for case in 0..40 {
        let (arity, length) = (rng.between(2, 4), rng.between(2, 7));
        let kernel = (0..length).map(|_| ratio(rng.integer(9), 8)).collect();
        let kernel = Laurent::new(rng.integer(5), kernel);
        if kernel.is_zero() {
            continue;
        }
        let found = JointRadius::of(&Context::serial(), arity, &kernel).expect("bounds");
        assert!(found.low <= found.high, "{case}: {found:?}");
        let root = |(power, norm)| to_f64(&norm).powf(1.0 / f64::from(power));
        let roots: Vec<f64> = (1..=7).zip(PowerNorms::new(arity, &kernel)).map(root).collect();
        let least = roots.iter().copied().fold(f64::INFINITY, f64::min);
        assert!(found.low <= least * (1.0 + 1e-12), "{case}: {found:?}, norms {roots:?}");
        let last = roots[roots.len() - 1];
        let factor = (4.0 * length as f64).powf(1.0 / roots.len() as f64);
        assert!(last <= found.high * factor, "{case}: {found:?}, norms {roots:?}");
        // A 1 at either end goes into the end coefficient, again and again.
        let ends =
            [&kernel.coefficients()[0], &kernel.coefficients()[kernel.coefficients().len() - 1]];
        for end in ends.map(|c| to_f64(c).abs()) {
            assert!(found.high >= end * (1.0 - 1e-12), "{case}: {found:?}, {end}");
        }
        tight += u32::from(found.high - found.low <= 1e-8 * found.high);
    }
    assert!(tight > 20, "{tight} of 40 are tight");
}
