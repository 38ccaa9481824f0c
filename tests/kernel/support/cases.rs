//! What property tests run on: their configuration, and random schemes.

use proptest::prelude::{ProptestConfig, Strategy};
use proptest::sample::select;
use proptest::test_runner::RngSeed;

use super::reference::{Boundary, Rule, Scheme};
use super::tolerance::{ROUNDING, STEEP};

pub const MODES: [Boundary; 3] = [Boundary::None, Boundary::Edge, Boundary::EdgeCorner];
/// The modes that lay an anchor row.
pub const ANCHORING: [Boundary; 2] = [Boundary::Edge, Boundary::EdgeCorner];
pub const RULES: [Rule; 2] = [Rule::Cosine, Rule::Average];

/// Passes within [0, 1]: all weights of the plain rules are non-negative.
pub const TAME: [&[(i64, i64)]; 4] = [&[], &[(1, 2)], &[(0, 1)], &[(3, 4)]];
/// Two passes, one of them beyond 1.
pub const STEEP_PASSES: &[(i64, i64)] = &[(0, 1), (7, 2)];

/// The same cases in every run; `PROPTEST_CASES` sets another number.
pub fn config(cases: u32) -> ProptestConfig {
    let asked = std::env::var("PROPTEST_CASES").ok().and_then(|n| n.parse().ok());
    ProptestConfig {
        cases: asked.unwrap_or(cases),
        failure_persistence: None,
        rng_seed: RngSeed::Fixed(0x000c_a21e),
        ..ProptestConfig::default()
    }
}

/// Schemes of every rule, boundary mode and list of passes.
pub fn schemes() -> impl Strategy<Value = Scheme> {
    (select(pass_lists()), select(&RULES), select(&MODES)).prop_map(build)
}

/// Schemes that lay an anchor row.
pub fn anchoring_schemes() -> impl Strategy<Value = Scheme> {
    (select(pass_lists()), select(&RULES), select(&ANCHORING)).prop_map(build)
}

/// All of [`schemes`].
pub fn all_schemes() -> Vec<Scheme> {
    let rules = |passes| RULES.map(|rule| (passes, rule));
    let modes = |(passes, rule)| MODES.map(|mode| build((passes, rule, mode)));
    pass_lists().into_iter().flat_map(rules).flat_map(modes).collect()
}

fn build((passes, rule, mode): (&[(i64, i64)], Rule, Boundary)) -> Scheme {
    Scheme::dual(passes, rule, mode)
}

fn pass_lists() -> Vec<&'static [(i64, i64)]> {
    TAME.into_iter().chain([STEEP_PASSES]).collect()
}

/// What two orders of summation may differ by under a scheme.
pub fn rounding(scheme: &Scheme) -> f64 {
    if is_tame(scheme) { ROUNDING } else { STEEP }
}

/// Whether all passes are one of [`TAME`].
pub fn is_tame(scheme: &Scheme) -> bool {
    scheme.passes.len() < STEEP_PASSES.len()
}
