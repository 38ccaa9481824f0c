//! Masks as split and passes.

use carvel::curve::{CurveSplit, Factors, Laurent, Mask};
use carvel::{ErrorKind, Fraction, Scheme};

use crate::support::{list, named, schemes};

fn fraction(text: &str) -> Fraction {
    text.parse().expect("a fraction")
}

#[track_caller]
fn check(mask: &Mask, split: CurveSplit, passes: &str) {
    let passes = passes.split_whitespace().map(fraction).collect();
    assert_eq!(Factors::of(mask).expect("factors"), Factors { split, passes });
}

#[test]
fn masks_of_the_specification() {
    check(&named("chaikin"), CurveSplit::Dual, "");
    check(&"1/32,9/32,22/32,22/32,9/32,1/32".parse().unwrap(), CurveSplit::Dual, "1/2");
    check(&named("three-point:1/16"), CurveSplit::Dual, "0");
    check(&named("three-point:1/64"), CurveSplit::Dual, "3/4");
    check(&named("b-spline:1"), CurveSplit::Primal, "");
    check(&named("four-point:1/16"), CurveSplit::Primal, "0 3");
    check(&named("dyn-floater-hormann:1/128"), CurveSplit::Dual, "0 7/2");
    for degree in 1..=12 {
        let split = if degree % 2 == 0 { CurveSplit::Dual } else { CurveSplit::Primal };
        check(&named(&format!("b-spline:{degree}")), split, &"0 ".repeat((degree - 1) / 2));
    }
}

/// What was found, multiplied out, is the mask, and a scheme on meshes takes it.
#[test]
fn factors_multiply_to_the_mask() {
    let mut found = 0;
    for scheme in schemes().iter().filter(|scheme| scheme.arity == 2) {
        let mask = scheme.mask();
        let Ok(factors) = Factors::of(&mask) else { continue };
        found += 1;
        let (start, made) = match factors.split {
            CurveSplit::Dual => ("1/4 3/4 3/4 1/4", Scheme::dual(&factors.passes)),
            CurveSplit::Primal => ("1/2 1 1/2", Scheme::primal(&factors.passes)),
        };
        assert!(made.is_ok(), "{}", scheme.name);
        let filter = |t: &Fraction| {
            let t = carvel::curve::rational::from_fraction(*t);
            let a = (list("1")[0].clone() - t) / list("2")[0].clone();
            let outer = &a / list("2")[0].clone();
            Laurent::new(-1, vec![outer.clone(), list("1")[0].clone() - a, outer])
        };
        let start = Laurent::new(0, list(start));
        let product = factors.passes.iter().fold(start, |product, t| &product * &filter(t));
        assert_eq!(product.coefficients(), mask.coefficients(), "{}", scheme.name);
    }
    assert!(found > 50, "{found} masks factor");
}

#[track_caller]
fn refused(mask: &Mask, reason: &str) {
    let error = Factors::of(mask).expect_err("no factors");
    assert_eq!(error.kind(), ErrorKind::Unsupported);
    assert!(error.to_string().contains(reason), "{error}");
}

#[test]
fn what_does_not_factor_is_refused_with_the_reason() {
    refused(&named("b-spline:2,3"), "arity is 3");
    refused(&named("corner-cutting:1/4,1/3"), "not symmetric");
    refused(&named("de-rham"), "[1,3,3,1]/4 is no factor");
    refused(&named("deslauriers-dubuc:3"), "2 of its 4 passes are not rational");
    refused(&"1/3,1/3,1/3,1/3,1/3,1/3".parse().unwrap(), "is no factor");
    refused(&named("deslauriers-dubuc:64"), "it would take 126, schemes have 64 at most");
}

#[test]
fn as_many_passes_as_a_scheme_has() {
    let smoothed = |passes: usize| {
        let start = Laurent::new(0, list("1/4 3/4 3/4 1/4"));
        let filter = Laurent::new(-1, list("1/4 1/2 1/4"));
        let symbol = (0..passes).fold(start, |product, _| &product * &filter);
        Mask::new(2, 0, symbol.coefficients().to_vec()).unwrap()
    };
    let most = Factors::of(&smoothed(64)).expect("factors");
    assert_eq!(most.passes, vec![fraction("0"); 64]);
    assert!(Scheme::dual(&most.passes).is_ok());
    refused(&smoothed(65), "it would take 65");
    assert!(Scheme::dual(&[fraction("0"); 65]).is_err());
}
