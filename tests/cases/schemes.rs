//! Every scheme that the cases run under: a line each.

use carvel::{Boundary, CornerRule, Fraction, Scheme};

use crate::case::Case;

/// A scheme, and the cases that are not for it.
pub struct Named {
    pub name: &'static str,
    pub scheme: Scheme,
    /// True for what must be answered with `Unsupported`.
    pub refuses: fn(&Case) -> bool,
}

pub const BOUNDARIES: [Boundary; 3] = [Boundary::None, Boundary::Edge, Boundary::EdgeAndCorner];

/// All schemes, with the boundary rule that they have by themselves.
pub fn all() -> Vec<Named> {
    let named = |name, scheme, refuses| Named { name, scheme, refuses };
    vec![
        named("Doo-Sabin", Scheme::doo_sabin(), takes_all),
        named("Catmull and Clark's quadratic", averaged(Scheme::doo_sabin()), takes_all),
        named("three-point 1/32", three_point(1, 32), takes_all),
        named("three-point 1/64, average", averaged(three_point(1, 64)), takes_all),
        named("quartic", Scheme::quartic(), takes_all),
        named("B-spline of degree 6", b_spline(6), takes_all),
        named(
            "four-point C2",
            Scheme::dual(&[fraction(0, 1), fraction(7, 2)]).expect("passes"),
            takes_all,
        ),
        named("Catmull-Clark", Scheme::catmull_clark(), takes_all),
        named("Loop", Scheme::loop_triangles(), |case| !case.is_triangles()),
        named("bilinear", Scheme::bilinear(), takes_all),
        named("cubic by averaging", Scheme::primal(&[fraction(0, 1)]).expect("passes"), takes_all),
    ]
}

fn takes_all(_: &Case) -> bool {
    false
}

fn averaged(scheme: Scheme) -> Scheme {
    scheme.with_rule(CornerRule::Average)
}

fn three_point(numerator: i64, denominator: i64) -> Scheme {
    Scheme::three_point(fraction(numerator, denominator)).expect("w in range")
}

fn b_spline(degree: u32) -> Scheme {
    Scheme::b_spline(degree).expect("a degree on offer")
}

fn fraction(numerator: i64, denominator: i64) -> Fraction {
    Fraction::new(numerator, denominator).expect("a fraction")
}
