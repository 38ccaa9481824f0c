//! Every row of the oracle: the mask from the catalogue's formula, and each property.

use carvel::Context;
use carvel::analysis::mask::{Analysis, Effort, Holder};
use carvel::curve::{Mask, limit_stencil, rational};
use num_traits::Zero;
use serde_json::Value;

use crate::support::{Scheme, named, q, schemes};

/// The oracle gives exponents to six digits behind the point.
const SIX_DIGITS: f64 = 6e-7;
/// The oracle gives norms with long terms as doubles.
const DOUBLE: f64 = 1e-15;

/// A row's name in the catalogue, from its name in the oracle.
fn name_in_catalogue(name: &str) -> String {
    let first = name.split(" = ").next().expect("a name");
    let value = || first.rsplit('=').next().expect("a value").split(' ').next().expect("a value");
    let number = |word: usize| {
        let word = name.split_whitespace().nth(word).expect("a word");
        word.split('-').next().expect("a number").parse::<usize>().expect("a number")
    };
    let pair = || name[name.find('(').expect("(") + 1..name.find(')').expect(")")].to_owned();
    match name {
        "Chaikin" => "chaikin".to_owned(),
        "de Rham trisection" => "de-rham".to_owned(),
        _ if name.starts_with("B-spline") => format!("b-spline:{}", number(2)),
        _ if name.starts_with("ternary B-spline degree 3") => "hassan-dodgson-approximating".into(),
        _ if name.starts_with("ternary B-spline") => format!("b-spline:{},3", number(3)),
        _ if name.starts_with("corner cutting") => format!("corner-cutting:{0},{0}", value()),
        _ if name.contains("DLG 4-point w") => format!("four-point:{}", value()),
        _ if name.starts_with("Deslauriers") => format!("deslauriers-dubuc:{}", number(1) / 2),
        _ if name.starts_with("ternary Deslauriers") => {
            format!("deslauriers-dubuc:{},3", number(2) / 2)
        }
        _ if name.starts_with("Weissman") => format!("weissman:{}", value()),
        _ if name.starts_with("Dyn-Floater") => format!("dyn-floater-hormann:{}", value()),
        _ if name.starts_with("3-point binary") => format!("three-point:{}", value()),
        _ if name.starts_with("ternary 3-point") => {
            format!("hassan-dodgson-interpolating:{}", value())
        }
        _ if name.starts_with("ternary 4-point") => format!("ternary-four-point:{}", value()),
        _ if name.contains("quinary") => format!("odd-point:{},5", number(0) / 2),
        _ if name.ends_with("(Lagrange)") => format!("odd-point:{},3", number(0) / 2),
        _ if name.starts_with("Hormann-Sabin") => {
            format!("hormann-sabin:{}", first.rsplit('_').next().expect("a number"))
        }
        _ if name.starts_with("primal pseudo") => format!("primal-pseudo-spline:{}", pair()),
        _ if name.starts_with("dual pseudo") => format!("dual-pseudo-spline:{}", pair()),
        _ if name.starts_with("m-point") => {
            let m = name.split("m=").nth(1).expect("m").split(',').next().expect("m");
            format!("m-point:{m},{}", value())
        }
        _ => format!("even-point-{}:{},{}", kind(name), number(0) / 2 - 2, number(1)),
    }
}

fn kind(name: &str) -> &str {
    name.split_whitespace().last().expect("a word")
}

#[test]
fn every_mask_comes_from_its_formula() {
    for scheme in schemes() {
        let name = name_in_catalogue(&scheme.name);
        let mask = named(&name);
        assert_eq!(mask, scheme.mask(), "{}: {name}", scheme.name);
        assert_eq!(mask.offset(), scheme.offset, "{name}");
        let family = name.split(':').next().expect("a name");
        let family = carvel::curve::catalogue::family(family).expect("a family");
        let mark = family.attribution.name();
        let given = scheme.attribution.to_lowercase();
        // The oracle's rows of one formula sit in several families at times.
        let same = given.contains(mark) || name.starts_with("deslauriers-dubuc");
        assert!(same, "{name}: {mark}, the oracle says {given}");
    }
}

fn check_continuity(scheme: &Scheme, analysis: &Analysis) {
    let name = &scheme.name;
    assert_eq!(analysis.continuity, scheme.count("Ck"), "{name}: C^k");
    let proof = analysis.contractivity.as_ref();
    assert_eq!(proof.map(|p| p.continuity), scheme.count("Ck_contractivity"), "{name}");
    let Some(proof) = proof else { return };
    assert_eq!(Some(proof.power as usize), scheme.count("contractivity_L"), "{name}: L");
    match scheme.property("contractivity_norm").as_str() {
        Some(text) if !text.contains('.') => assert_eq!(proof.norm, q(text), "{name}: norm"),
        Some(text) => close(rational::to_f64(&proof.norm), text.parse().expect("a number"), name),
        None => close(rational::to_f64(&proof.norm), scheme.number("contractivity_norm"), name),
    }
}

fn close(a: f64, b: f64, name: &str) {
    assert!((a - b).abs() <= DOUBLE, "{name}: {a} and {b}");
}

fn check_holder(scheme: &Scheme, holder: &Holder) {
    let (low, high) = (scheme.number("holder_lower"), scheme.number("holder_upper"));
    let name = &scheme.name;
    assert!(holder.low <= holder.high, "{name}");
    // Of the oracle's one value, or its bounds, which may be wider than ours.
    let encloses = holder.low <= low + SIX_DIGITS && holder.high >= high - SIX_DIGITS;
    let inside = holder.low >= low - SIX_DIGITS && holder.high <= high + SIX_DIGITS;
    assert!(encloses || inside, "{name}: {holder:?}, the oracle says {low} to {high}");
    assert!(holder.high - holder.low <= 1e-8_f64.max(high - low), "{name}: {holder:?}");
}

/// The oracle has some masks under several names.
fn check_properties(schemes: &[Scheme]) {
    let mut known: Vec<(Mask, Analysis)> = Vec::new();
    for scheme in schemes {
        let mask = scheme.mask();
        if known.iter().all(|(other, _)| *other != mask) {
            let analysis = Analysis::of(&Context::serial(), &mask, Effort::default());
            known.push((mask.clone(), analysis.expect("done")));
        }
        let (_, analysis) = known.iter().find(|(other, _)| *other == mask).expect("it is known");
        let name = &scheme.name;
        check_continuity(scheme, analysis);
        check_holder(scheme, &analysis.holder);
        assert_eq!(analysis.parametrisation.name(), scheme.property("parametrisation"), "{name}");
        assert_eq!(analysis.tau, scheme.exact("tau"), "{name}");
        assert_eq!(analysis.support, scheme.exact("support_width"), "{name}");
        assert_eq!(Some(analysis.smoothing.factors), scheme.count("smoothing_factors"), "{name}");
        let degrees = analysis.degrees;
        assert_eq!(Some(degrees.generation), scheme.count("generation_degree"), "{name}");
        assert_eq!(Some(degrees.reproduction), scheme.count("reproduction_degree"), "{name}");
        assert_eq!(&Value::from(analysis.is_symmetric), scheme.property("symmetric"), "{name}");
        assert_eq!(
            &Value::from(analysis.is_interpolating),
            scheme.property("interpolating"),
            "{name}"
        );
        let kernel = scheme.property("kernel").as_array().expect("a kernel");
        let kernel: Vec<_> = kernel.iter().map(|x| q(x.as_str().expect("text"))).collect();
        assert_eq!(analysis.smoothing.kernel.coefficients(), kernel, "{name}");
    }
}

#[test]
fn every_property_of_short_masks_is_reproduced() {
    let (short, _): (Vec<_>, Vec<_>) = schemes().into_iter().partition(is_short);
    check_properties(&short);
}

#[test]
fn every_property_of_long_masks_is_reproduced() {
    let (_, long): (Vec<_>, Vec<_>) = schemes().into_iter().partition(is_short);
    assert!(long.len() > 20);
    check_properties(&long);
}

fn is_short(scheme: &Scheme) -> bool {
    scheme.coefficients.len() < 10
}

#[test]
fn limit_stencils_are_reproduced() {
    for scheme in schemes() {
        let stencil = limit_stencil(&Context::serial(), &scheme.mask(), &q("0"), 0).expect("one");
        let expected = scheme.property("limit_stencil_at_integers").as_object().expect("a map");
        // The oracle has the limit function at j, the stencil its value at −j for point j.
        for (place, value) in expected {
            let j = -place.parse::<i64>().expect("an integer");
            let index = usize::try_from(j - stencil.first).ok();
            let weight = index.and_then(|i| stencil.weights.get(i)).cloned();
            let value = q(value.as_str().expect("text"));
            assert_eq!(weight.unwrap_or_else(Zero::zero), value, "{}", scheme.name);
        }
        let used = stencil.weights.iter().filter(|w| !w.is_zero()).count();
        let known = expected.values().filter(|value| *value != "0").count();
        assert_eq!(used, known, "{}", scheme.name);
    }
}
