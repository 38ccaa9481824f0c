//! The catalogue and its page in the documentation.

use std::fmt::Write as _;

use carvel::ErrorKind;
use carvel::curve::catalogue::{self, FAMILIES, NON_STATIONARY};

use crate::support::{named, q};

const PAGE: &str = include_str!("../../docs/curves.md");

/// The table of the page, as it has to be.
fn table() -> String {
    let mut text = String::from(
        "| name | parameters (default) | authors, year | mask or symbol | attribution |\n\
         |---|---|---|---|---|\n",
    );
    for family in &FAMILIES {
        let parameter =
            |p: &catalogue::Parameter| format!("{}: {} ({})", p.name, p.range, p.default);
        let parameters: Vec<_> = family.parameters.iter().map(parameter).collect();
        let parameters =
            if parameters.is_empty() { "–".to_owned() } else { parameters.join("; ") };
        let (name, authors, year) = (family.name, family.authors, family.year);
        let (formula, mark) = (family.formula, family.attribution.name());
        writeln!(text, "| `{name}` | {parameters} | {authors}, {year} | `{formula}` | {mark} |")
            .expect("a string grows");
    }
    for family in &NON_STATIONARY {
        let (name, authors, year) = (family.name, family.authors, family.year);
        let (formula, mark) = (family.formula, family.attribution.name());
        writeln!(
            text,
            "| `{name}` | by level or edge | {authors}, {year} | `{formula}` | {mark} |"
        )
        .expect("a string grows");
    }
    text
}

#[test]
fn the_page_lists_every_family() {
    let table = table();
    assert!(PAGE.contains(&table), "docs/curves.md needs this table:\n{table}");
}

#[test]
fn every_family_makes_its_default() {
    for family in &FAMILIES {
        family.mask(&[]).unwrap_or_else(|e| panic!("{}: {e}", family.name));
        assert!(family.name.bytes().all(|b| b.is_ascii_lowercase() || b == b'-'));
        assert_eq!(catalogue::family(family.name).expect("itself").name, family.name);
    }
    for family in &NON_STATIONARY {
        catalogue::mask(family.limit).unwrap_or_else(|e| panic!("{}: {e}", family.name));
    }
}

/// A free parameter is one in which the mask is affine: its second difference is 0.
#[test]
fn free_parameters_are_affine() {
    let mut seen = 0;
    for family in &FAMILIES {
        let defaults: Vec<_> = family.parameters.iter().map(|p| q(p.default)).collect();
        for (index, _) in family.parameters.iter().enumerate().filter(|(_, p)| p.is_free) {
            let at = |w: &str| {
                let mut all = defaults.clone();
                all[index] = q(w);
                family.mask(&all).expect("any rational is a value").symbol().clone()
            };
            let middle = at("1/2").scaled(&q("2"));
            assert_eq!(&at("0") + &at("1"), middle, "{}", family.name);
            seen += 1;
        }
    }
    assert_eq!(seen, 9);
}

#[test]
fn parameters_that_are_missing_are_the_defaults() {
    assert_eq!(named("three-point"), named("three-point:1/32"));
    assert_eq!(named("b-spline"), named("b-spline:3,2"));
    assert_eq!(named(" chaikin "), named("corner-cutting:0.25,1/4"));
    let error = catalogue::mask("three_point").expect_err("no such name");
    assert_eq!(error.kind(), ErrorKind::InvalidText);
}
