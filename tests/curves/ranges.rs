//! Ranges of parameters, against what is known of the families.

use carvel::Context;
use carvel::analysis::mask::{AffineFamily, Analysis, Effort, ParameterRange};
use carvel::curve::catalogue;
use carvel::curve::rational::to_f64;

use crate::support::q;

/// How close both sides of an end are asked to be.
const CLOSE: f64 = 2e-5;

fn open(name: &str) -> AffineFamily {
    let family = catalogue::family(name).expect("a family");
    let defaults = family.parameters.iter().map(|p| q(p.default)).collect::<Vec<_>>();
    AffineFamily::of(family, &defaults, 0).expect("a free parameter")
}

#[track_caller]
fn check(name: &str, k: usize, search: [&str; 2], expected: [f64; 2]) {
    let family = open(name);
    let [low, high] = search.map(q);
    let found = family.continuity_range(&Context::serial(), k, [&low, &high], &q("0.000005"));
    let found = found.expect("done");
    let [ParameterRange::Interval { low, high }] = &found[..] else {
        panic!("{name}, C^{k}: {found:?}")
    };
    for (end, expected) in [(low, expected[0]), (high, expected[1])] {
        let outside = end.outside.as_ref().map(to_f64).expect("both sides are decided");
        let inside = to_f64(&end.inside);
        let (least, most) = (inside.min(outside), inside.max(outside));
        assert!(least <= expected + 1e-7 && expected <= most + 1e-7, "{name}, C^{k}: {end:?}");
        assert!(most - least <= CLOSE, "{name}, C^{k}: {end:?}");
    }
}

/// More than any scheme of the family has factors for; at once, whatever is asked.
#[test]
fn no_parameter_is_smooth_without_end() {
    for k in [7, u32::MAX as usize] {
        let search = [&q("0"), &q("1/4")];
        let found =
            open("four-point").continuity_range(&Context::serial(), k, search, &q("1/1000"));
        assert_eq!(found.expect("done"), []);
    }
}

#[test]
fn three_point_c0_c1_c2() {
    check("three-point", 0, ["-1", "1"], [-0.375, 0.625]);
    check("three-point", 1, ["-1", "1"], [-0.125, 0.375]);
    check("three-point", 2, ["-1", "1"], [0.0, 0.25]);
}

#[test]
fn three_point_c3_is_the_quartic_alone() {
    let family = open("three-point");
    assert_eq!(family.factors(), (3, Some(q("1/16"))));
    let search = [q("-1"), q("1")];
    let found =
        family.continuity_range(&Context::serial(), 3, [&search[0], &search[1]], &q("0.01"));
    assert_eq!(found.expect("done"), [ParameterRange::Single(q("1/16"))]);
    let found =
        family.continuity_range(&Context::serial(), 4, [&search[0], &search[1]], &q("0.01"));
    assert_eq!(found.expect("done"), []);
}

#[test]
fn interpolating_families() {
    check("four-point", 0, ["-1", "1"], [-0.5, 0.5]);
    check("four-point", 1, ["-1", "1"], [0.0, 0.192_729_249_264_785]);
    check("hassan-dodgson-interpolating", 1, ["-1/2", "1/2"], [-1.0 / 9.0, 0.0]);
    check("ternary-four-point", 2, ["0", "1/5"], [1.0 / 15.0, 1.0 / 9.0]);
}

/// Bounds between which the exponent of three-point schemes is known as a formula.
#[test]
fn the_exponent_by_its_formulas() {
    let exponent = |w: &str| {
        let mask = open("three-point").mask(&q(w)).expect("a mask");
        Analysis::of(&Context::serial(), &mask, Effort::default()).expect("done").holder
    };
    for (w, expected) in [
        ("1/100", 2.0 - (1.0 - 0.08_f64).log2()),
        ("1/20", 2.0 - (1.0 - 0.4_f64).log2()),
        ("1/7", -(1.0_f64 / 7.0).log2()),
        ("6/25", -(0.24_f64).log2()),
    ] {
        let holder = exponent(w);
        assert!(
            holder.low <= expected + 1e-12 && expected <= holder.high + 1e-12,
            "{w}: {holder:?}"
        );
        assert!(holder.high - holder.low < 1e-8, "{w}: {holder:?}");
    }
}
