//! Awkward meshes, one small OBJ file each, with the purpose written on top: every
//! scheme, boundary rule, precision and number of threads takes them as they say.
//!
//! A further mesh is a further file; a further scheme is a line in `schemes.rs`. The C
//! programs and the command run the same files (`tests/capi`, `tests/cli`).

mod accepted;
mod case;
mod channels;
#[cfg(feature = "io")]
mod files;
mod refined;
mod rows;
mod schemes;
mod stencils;
#[path = "../kernel/support/tolerance.rs"]
#[allow(dead_code, reason = "one table for all tests")]
mod tolerance;

use std::collections::BTreeSet;
use std::path::Path;

use case::Case;

/// All cases.
fn cases() -> Vec<Case> {
    case::all(&Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/cases"))
}

#[test]
fn every_case_has_a_purpose_of_its_own() {
    let cases = cases();
    assert!(cases.len() >= 60, "cases are missing: {} found", cases.len());
    let purposes: BTreeSet<&str> = cases.iter().map(|case| case.purpose.as_str()).collect();
    assert_eq!(purposes.len(), cases.len());
}
