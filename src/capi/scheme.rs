//! `carvel_scheme`: a subdivision scheme with its parameters.

use super::buffer::{Name, input, list};
use super::guard::call;
use super::object::{destroy_function, object};
use super::status::{Fault, Result, carvel_status};
use super::versioned::{init_function, read, versioned};
use super::{carvel_error, carvel_mesh};
use crate::base::Fraction;
use crate::scheme::{
    Boundary, CornerRule, Creasing, Extraordinary, LoopWeights, MOST_PASSES, Scheme, TriangleRule,
};

object!(carvel_scheme, Scheme);

#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct carvel_fraction {
    pub numerator: i64,
    pub denominator: i64,
}

pub const CARVEL_SCHEME_DOO_SABIN: i32 = 0;
pub const CARVEL_SCHEME_THREE_POINT: i32 = 1;
pub const CARVEL_SCHEME_QUARTIC: i32 = 2;
pub const CARVEL_SCHEME_B_SPLINE: i32 = 3;
pub const CARVEL_SCHEME_AVERAGING: i32 = 4;
pub const CARVEL_SCHEME_CATMULL_CLARK: i32 = 5;
pub const CARVEL_SCHEME_LOOP: i32 = 6;
pub const CARVEL_SCHEME_BILINEAR: i32 = 7;
pub const CARVEL_SCHEME_PRIMAL: i32 = 8;

pub const CARVEL_CORNER_RULE_COSINE: i32 = 0;
pub const CARVEL_CORNER_RULE_AVERAGE: i32 = 1;

pub const CARVEL_BOUNDARY_EDGE_AND_CORNER: i32 = 0;
pub const CARVEL_BOUNDARY_EDGE: i32 = 1;
pub const CARVEL_BOUNDARY_NONE: i32 = 2;

pub const CARVEL_CREASING_UNIFORM: i32 = 0;
pub const CARVEL_CREASING_CHAIKIN: i32 = 1;

pub const CARVEL_TRIANGLE_RULE_CATMULL_CLARK: i32 = 0;
pub const CARVEL_TRIANGLE_RULE_SMOOTH: i32 = 1;

pub const CARVEL_LOOP_WEIGHTS_LOOP: i32 = 0;
pub const CARVEL_LOOP_WEIGHTS_WARREN: i32 = 1;

pub const CARVEL_EXTRAORDINARY_DEFAULT: i32 = 0;
pub const CARVEL_EXTRAORDINARY_TUNED: i32 = 1;

versioned! {
    pub struct carvel_scheme_desc {
        pub struct_size: u32,
        pub family: i32,
        pub corner_rule: i32,
        pub boundary: i32,
        pub w: carvel_fraction,
        pub degree: u64,
        pub passes: *const carvel_fraction,
        pub pass_count: u64,
        pub creasing: i32,
        pub triangle_rule: i32,
        pub loop_weights: i32,
        pub extraordinary: i32,
    }
}

impl From<Fraction> for carvel_fraction {
    fn from(f: Fraction) -> Self {
        Self { numerator: f.numerator(), denominator: f.denominator() }
    }
}

impl carvel_fraction {
    pub(super) fn exact(self, name: impl Into<Name>) -> Result<Fraction> {
        let made = Fraction::new(self.numerator, self.denominator);
        Ok(made.map_err(|e| e.in_context(name.into()))?)
    }
}

/// The scheme that a description and its passes ask for.
fn scheme(desc: &carvel_scheme_desc, passes: &[carvel_fraction]) -> Result<Scheme> {
    check_foreign_fields(desc)?;
    let scheme = match desc.family {
        CARVEL_SCHEME_DOO_SABIN => Scheme::doo_sabin(),
        CARVEL_SCHEME_THREE_POINT => Scheme::three_point(three_point_w(desc.w)?)?,
        CARVEL_SCHEME_QUARTIC => Scheme::quartic(),
        CARVEL_SCHEME_B_SPLINE => Scheme::b_spline(u32::try_from(desc.degree).unwrap_or(u32::MAX))?,
        CARVEL_SCHEME_AVERAGING => Scheme::dual(&exact(passes)?)?,
        CARVEL_SCHEME_CATMULL_CLARK => Scheme::catmull_clark(),
        CARVEL_SCHEME_LOOP => Scheme::loop_triangles(),
        CARVEL_SCHEME_BILINEAR => Scheme::bilinear(),
        CARVEL_SCHEME_PRIMAL => Scheme::primal(&exact(passes)?)?,
        other => return Err(Fault::out_of_range(format!("there is no scheme family {other}"))),
    };
    Ok(scheme
        .with_rule(corner_rule(desc.corner_rule)?)
        .with_boundary(boundary(desc.boundary)?)
        .with_creasing(creasing(desc.creasing)?)
        .with_triangle_rule(triangle_rule(desc.triangle_rule)?)
        .with_loop_weights(loop_weights(desc.loop_weights)?)
        .with_extraordinary(extraordinary(desc.extraordinary)?)?)
}

fn exact(passes: &[carvel_fraction]) -> Result<Vec<Fraction>> {
    let name = |i| Name { text: "passes", index: Some(i) };
    passes.iter().enumerate().map(|(i, t)| t.exact(name(i))).collect()
}

/// The families that smooth by averaging, with a corner operator.
const AVERAGING: &[i32] = &[
    CARVEL_SCHEME_DOO_SABIN,
    CARVEL_SCHEME_THREE_POINT,
    CARVEL_SCHEME_QUARTIC,
    CARVEL_SCHEME_B_SPLINE,
    CARVEL_SCHEME_AVERAGING,
    CARVEL_SCHEME_PRIMAL,
];

/// A parameter that the family does not have is a mistake, not a decoration.
fn check_foreign_fields(desc: &carvel_scheme_desc) -> Result<()> {
    let foreign: [(&str, bool, &[i32]); 8] = [
        ("w", desc.w != carvel_fraction::default(), &[CARVEL_SCHEME_THREE_POINT]),
        ("degree", desc.degree != 0, &[CARVEL_SCHEME_B_SPLINE]),
        ("pass_count", desc.pass_count != 0, &[CARVEL_SCHEME_AVERAGING, CARVEL_SCHEME_PRIMAL]),
        ("corner_rule", desc.corner_rule != 0, AVERAGING),
        ("creasing", desc.creasing != 0, &[CARVEL_SCHEME_CATMULL_CLARK, CARVEL_SCHEME_LOOP]),
        ("triangle_rule", desc.triangle_rule != 0, &[CARVEL_SCHEME_CATMULL_CLARK]),
        ("loop_weights", desc.loop_weights != 0, &[CARVEL_SCHEME_LOOP]),
        ("extraordinary", desc.extraordinary != 0, &[CARVEL_SCHEME_THREE_POINT]),
    ];
    match foreign.iter().find(|(_, given, families)| *given && !families.contains(&desc.family)) {
        Some((name, ..)) => Err(Fault::out_of_range(format!(
            "{name} is set, but scheme family {} does not have it",
            desc.family
        ))),
        None => Ok(()),
    }
}

fn check_pass_count(count: u64) -> Result<()> {
    if count <= MOST_PASSES as u64 {
        return Ok(());
    }
    Err(Fault::out_of_range(format!("{count} passes: the limit is {MOST_PASSES}")))
}

fn three_point_w(w: carvel_fraction) -> Result<Fraction> {
    const PAPER: carvel_fraction = carvel_fraction { numerator: 1, denominator: 32 };
    if w == carvel_fraction::default() { PAPER.exact("w") } else { w.exact("w") }
}

fn corner_rule(rule: i32) -> Result<CornerRule> {
    match rule {
        CARVEL_CORNER_RULE_COSINE => Ok(CornerRule::Cosine),
        CARVEL_CORNER_RULE_AVERAGE => Ok(CornerRule::Average),
        other => Err(Fault::out_of_range(format!("there is no corner rule {other}"))),
    }
}

fn boundary(rule: i32) -> Result<Boundary> {
    match rule {
        CARVEL_BOUNDARY_EDGE_AND_CORNER => Ok(Boundary::EdgeAndCorner),
        CARVEL_BOUNDARY_EDGE => Ok(Boundary::Edge),
        CARVEL_BOUNDARY_NONE => Ok(Boundary::None),
        other => Err(Fault::out_of_range(format!("there is no boundary rule {other}"))),
    }
}

fn creasing(method: i32) -> Result<Creasing> {
    match method {
        CARVEL_CREASING_UNIFORM => Ok(Creasing::Uniform),
        CARVEL_CREASING_CHAIKIN => Ok(Creasing::Chaikin),
        other => Err(Fault::out_of_range(format!("there is no creasing {other}"))),
    }
}

fn triangle_rule(rule: i32) -> Result<TriangleRule> {
    match rule {
        CARVEL_TRIANGLE_RULE_CATMULL_CLARK => Ok(TriangleRule::CatmullClark),
        CARVEL_TRIANGLE_RULE_SMOOTH => Ok(TriangleRule::Smooth),
        other => Err(Fault::out_of_range(format!("there is no triangle rule {other}"))),
    }
}

fn loop_weights(weights: i32) -> Result<LoopWeights> {
    match weights {
        CARVEL_LOOP_WEIGHTS_LOOP => Ok(LoopWeights::Loop),
        CARVEL_LOOP_WEIGHTS_WARREN => Ok(LoopWeights::Warren),
        other => Err(Fault::out_of_range(format!("there are no Loop weights {other}"))),
    }
}

fn extraordinary(rule: i32) -> Result<Extraordinary> {
    match rule {
        CARVEL_EXTRAORDINARY_DEFAULT => Ok(Extraordinary::Default),
        CARVEL_EXTRAORDINARY_TUNED => Ok(Extraordinary::Tuned),
        other => Err(Fault::out_of_range(format!("there is no extraordinary rule {other}"))),
    }
}

init_function!(carvel_scheme_desc_init, carvel_scheme_desc);

#[unsafe(no_mangle)]
pub unsafe extern "C" fn carvel_scheme_create(
    desc: *const carvel_scheme_desc,
    out: *mut *mut carvel_scheme,
    error: *mut carvel_error,
) -> carvel_status {
    let make = || {
        // SAFETY: the header's contract.
        let desc = unsafe { read(desc)? };
        check_pass_count(desc.pass_count)?;
        // SAFETY: the header's contract.
        let passes = unsafe { input(desc.passes, desc.pass_count, "passes")? };
        scheme(&desc, passes)
    };
    // SAFETY: the header's contract.
    unsafe { call(error, |call| call.create(out, |_| make())) }
}

destroy_function!(carvel_scheme_destroy, carvel_scheme);

#[unsafe(no_mangle)]
pub unsafe extern "C" fn carvel_scheme_passes(
    scheme: *const carvel_scheme,
    out: *mut carvel_fraction,
    capacity: u64,
    count: *mut u64,
    error: *mut carvel_error,
) -> carvel_status {
    // SAFETY: the header's contract.
    unsafe {
        call(error, |call| {
            let scheme = call.object(scheme)?;
            let passes: Vec<_> = scheme.passes().iter().map(|&t| t.into()).collect();
            list(&passes, out, capacity, count)
        })
    }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn carvel_scheme_holes(
    scheme: *const carvel_scheme,
    mesh: *const carvel_mesh,
    out: *mut u32,
    capacity: u64,
    count: *mut u64,
    error: *mut carvel_error,
) -> carvel_status {
    // SAFETY: the header's contract.
    unsafe {
        call(error, |call| {
            let (scheme, mesh) = (call.object(scheme)?, call.object(mesh)?);
            list(&scheme.holes(&mesh.mesh)?, out, capacity, count)
        })
    }
}
