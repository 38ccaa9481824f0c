//! Every scheme that the cases run under: a line each.

use carvel::scheme::{Creasing, LoopWeights, TriangleRule};
use carvel::{Boundary, CornerRule, Extraordinary, Fraction, Mesh, Scheme};

use crate::case::Case;

/// A scheme, and the cases that are not for it.
pub struct Named {
    pub name: &'static str,
    pub scheme: Scheme,
    /// True for what must be answered with `Unsupported`.
    pub refuses: fn(&Case, &Mesh) -> bool,
    /// False where an option of the scheme has nothing to say.
    pub concerns: fn(&Case) -> bool,
}

impl Named {
    fn only(self, concerns: fn(&Case) -> bool) -> Self {
        Self { concerns, ..self }
    }

    /// The boundary rules to run on a mesh: one where there is no boundary.
    pub fn boundaries(mesh: &Mesh) -> &'static [Boundary] {
        const ALL: [Boundary; 3] = [Boundary::EdgeAndCorner, Boundary::Edge, Boundary::None];
        if mesh.is_closed() { &ALL[..1] } else { &ALL }
    }
}

/// All schemes, with the boundary rule that they have by themselves.
pub fn all() -> Vec<Named> {
    let named =
        |name, scheme, refuses| Named { name, scheme, refuses, concerns: |case| !case.is_tagged() };
    let any = |name, scheme, refuses| named(name, scheme, refuses).only(|_| true);
    let cubic = Scheme::primal(&[fraction(0, 1)]).expect("passes");
    let steep = Scheme::dual(&[fraction(0, 1), fraction(7, 2)]).expect("passes");
    let (catmull_clark, triangles) = (Scheme::catmull_clark(), Scheme::loop_triangles());
    let smooth = catmull_clark.clone().with_triangle_rule(TriangleRule::Smooth);
    let tuned = three_point(1, 32).with_extraordinary(Extraordinary::Tuned).expect("w = 1/32");
    let warren = triangles.clone().with_loop_weights(LoopWeights::Warren);
    vec![
        any("Doo-Sabin", Scheme::doo_sabin(), is_sharp),
        named("Catmull and Clark's quadratic", averaged(Scheme::doo_sabin()), is_sharp),
        named("three-point 1/32", three_point(1, 32), is_sharp),
        named("three-point 1/32, tuned", tuned, is_sharp),
        named("three-point 1/64, average", averaged(three_point(1, 64)), is_sharp),
        named("quartic", Scheme::quartic(), is_sharp),
        named("B-spline of degree 6", b_spline(6), is_sharp),
        named("four-point C2", steep, is_sharp),
        any("Catmull-Clark", catmull_clark.clone(), takes_all),
        any("Catmull-Clark, Chaikin", chaikin(catmull_clark), takes_all).only(Case::is_tagged),
        any("Catmull-Clark, smooth triangles", smooth, takes_all).only(Case::has_triangles),
        any("Loop", triangles.clone(), has_others),
        any("Loop, Chaikin", chaikin(triangles), has_others).only(Case::is_tagged),
        any("Loop, Warren's weights", warren, has_others).only(Case::is_triangles),
        any("bilinear", Scheme::bilinear(), takes_all),
        any("cubic by averaging", cubic, is_sharp),
    ]
}

fn takes_all(_: &Case, _: &Mesh) -> bool {
    false
}

/// Averaging knows neither creases nor what is not manifold.
fn is_sharp(case: &Case, mesh: &Mesh) -> bool {
    case.is_sharp() || !mesh.is_manifold()
}

fn has_others(case: &Case, _: &Mesh) -> bool {
    !case.is_triangles()
}

fn chaikin(scheme: Scheme) -> Scheme {
    scheme.with_creasing(Creasing::Chaikin)
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
