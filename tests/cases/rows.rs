//! The weights of every new vertex of every case: they add up to 1, so that what comes
//! out moves with what goes in, name vertices that exist, and give what the loops that
//! know shorter ways compute.

use carvel::{Context, Hierarchy};

use crate::accepted::{meshes, positions};
use crate::case::{Case, Outcome};
use crate::schemes::{Named, all};
use crate::tolerance::STEEP;

const LEVELS: u32 = 2;

#[test]
fn rows_sum_to_one_and_give_the_positions() {
    for (case, built) in meshes() {
        let positions = positions::<f64>(&case, &built);
        let takes = |named: &Named| !(named.refuses)(&case, &built.mesh) && (named.concerns)(&case);
        for named in all().into_iter().filter(takes) {
            for &boundary in Named::boundaries(&built.mesh) {
                let scheme = named.scheme.clone().with_boundary(boundary);
                let what = format!("{} under {}, {boundary:?}", case.name, named.name);
                let mesh = built.mesh.clone();
                let made = Hierarchy::new(&Context::serial(), mesh, scheme, LEVELS);
                let hierarchy = made.unwrap_or_else(|e| panic!("{what}: {e}"));
                let by_rows = apply(&hierarchy, &positions, &what);
                if is_finite(&case) {
                    compare(&hierarchy, &positions, &by_rows, &what);
                }
            }
        }
    }
}

/// Applies the rows of all steps to xyz of the control vertices, checking each.
fn apply(hierarchy: &Hierarchy, positions: &[f64], what: &str) -> Vec<f64> {
    let mut values = positions.to_vec();
    for level in 1..=LEVELS {
        for stage in 0..hierarchy.scheme().stages() {
            values = apply_stage(hierarchy, (level, stage), &values, what);
        }
    }
    values
}

fn apply_stage(
    hierarchy: &Hierarchy,
    (level, stage): (u32, usize),
    values: &[f64],
    what: &str,
) -> Vec<f64> {
    let mut out = Vec::new();
    let done = hierarchy.each_row_of(level, stage, |vertex, row: &[(u32, f64)]| {
        let place = || format!("{what}: level {level}, stage {stage}, vertex {vertex}");
        let sum: f64 = row.iter().map(|(_, weight)| weight).sum();
        assert!((sum - 1.0).abs() <= STEEP, "{} sums to {sum}", place());
        let exists = |&(v, _): &(u32, f64)| (v as usize) < values.len() / 3;
        assert!(row.iter().all(exists), "{}: {row:?}", place());
        assert_eq!(3 * vertex as usize, out.len(), "{}: rows come in order", place());
        let axis = |k: usize| row.iter().map(|&(v, w)| w * values[3 * v as usize + k]).sum::<f64>();
        out.extend([0, 1, 2].map(axis));
    });
    done.unwrap_or_else(|e| panic!("{what}: {e}"));
    assert_eq!(out.len(), 3 * hierarchy.mesh(level).vertices(), "{what}: rows of level {level}");
    out
}

/// True if every scheme can refine the case's coordinates.
pub fn is_finite(case: &Case) -> bool {
    let refused = Outcome::Error("NotFinite".to_owned());
    case.may_fail.is_none() && *case.expected("") != refused
}

fn compare(hierarchy: &Hierarchy, positions: &[f64], by_rows: &[f64], what: &str) {
    let mut values = vec![0.0; by_rows.len()];
    let done = hierarchy.refine(&Context::serial(), LEVELS, positions, 3, &mut values);
    done.unwrap_or_else(|e| panic!("{what}: {e}"));
    let largest = positions.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    for (i, (found, expected)) in values.iter().zip(by_rows).enumerate() {
        let difference = (found - expected).abs();
        assert!(difference <= STEEP * largest, "{what}: value {i} is {found}, not {expected}");
    }
}
