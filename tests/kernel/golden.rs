//! The kernel against the golden files: meshes that an independent reference
//! refined in exact arithmetic. Compared as unordered meshes.

use carvel::base::Scalar;

use crate::support::compare::assert_same;
use crate::support::golden::{self, Case};
use crate::support::kernel;
use crate::support::reference::Split;
use crate::support::tolerance::{GOLDEN, GOLDEN_SINGLE};

/// Runs a check on every case.
fn each_case(check: impl Fn(&Case)) {
    let cases = golden::load_all();
    let primal = cases.iter().filter(|case| case.scheme.split == Split::Primal).count();
    assert!(cases.len() >= 18 && primal >= 1, "golden cases are missing: {} found", cases.len());
    cases.iter().for_each(check);
}

fn check_refiner<T: Scalar>(case: &Case, tolerance: f64) {
    let refined = kernel::refine::<T>(&case.control, &case.scheme, case.levels as u32);
    let what = format!("{} by Refiner, {} bytes per number", case.name, T::BYTES);
    assert_same(&kernel::poly_of(&refined), &case.expected, tolerance, &what);
}

fn check_hierarchy<T: Scalar>(case: &Case, tolerance: f64) {
    let level = case.levels as u32;
    let hierarchy = kernel::hierarchy(&case.control, &case.scheme, level);
    let positions = kernel::coordinates::<T>(&case.control);
    let refined = kernel::refine_values(&hierarchy, level, &positions, 3);
    let what = format!("{} by Hierarchy, {} bytes per number", case.name, T::BYTES);
    assert_same(&kernel::poly(hierarchy.mesh(level), &refined), &case.expected, tolerance, &what);
}

#[test]
fn refiner_reproduces_every_case_in_double_precision() {
    each_case(|case| check_refiner::<f64>(case, GOLDEN));
}

#[test]
fn refiner_reproduces_every_case_in_single_precision() {
    each_case(|case| check_refiner::<f32>(case, GOLDEN_SINGLE));
}

#[test]
fn hierarchy_reproduces_every_case_in_double_precision() {
    each_case(|case| check_hierarchy::<f64>(case, GOLDEN));
}

#[test]
fn hierarchy_reproduces_every_case_in_single_precision() {
    each_case(|case| check_hierarchy::<f32>(case, GOLDEN_SINGLE));
}
