//! Stencil tables of every case under every scheme: they do what refinement does, in one
//! table or step by step, for all vertices or for some.

use carvel::{Context, ErrorKind, Hierarchy, Interpolation, Records, RecordsMut, Scheme};
use carvel::{StencilTable, StencilTask, scheme::SplitKind};

use crate::accepted::{meshes, positions};
use crate::rows::is_finite;
use crate::schemes::{Named, all};
use crate::tolerance::{ROW, STEEP};

/// The last level is one that the hierarchy itself does not have.
const LEVELS: u32 = 2;

/// Calls for every case, scheme and boundary rule.
fn each(mut check: impl FnMut(&Hierarchy, &[f64], bool, &str)) {
    for (case, built) in meshes() {
        let positions = positions::<f64>(&case, &built);
        let takes = |named: &Named| !(named.refuses)(&case, &built.mesh) && (named.concerns)(&case);
        for named in all().into_iter().filter(takes) {
            for &boundary in Named::boundaries(&built.mesh) {
                let scheme = named.scheme.clone().with_boundary(boundary);
                let what = format!("{} under {}, {boundary:?}", case.name, named.name);
                let mesh = built.mesh.clone();
                let made = Hierarchy::new(&Context::serial(), mesh, scheme, LEVELS - 1);
                let hierarchy = made.unwrap_or_else(|e| panic!("{what}: {e}"));
                check(&hierarchy, &positions, is_finite(&case), &what);
            }
        }
    }
}

fn table(hierarchy: &Hierarchy, task: &StencilTask, what: &str) -> StencilTable<f64> {
    let made = hierarchy.stencils(&Context::serial(), task);
    made.unwrap_or_else(|e| panic!("{what}: {task:?}: {e}"))
}

fn apply(table: &StencilTable<f64>, values: &[f64]) -> Vec<f64> {
    let mut out = vec![f64::NAN; 3 * table.rows()];
    let (records, into) = (Records::packed(values, 3), RecordsMut::packed(&mut out, 3));
    table.apply(&Context::serial(), records, into).expect("the table is applied");
    out
}

#[track_caller]
fn assert_close(found: &[f64], expected: &[f64], control: &[f64], what: &str) {
    assert_eq!(found.len(), expected.len(), "{what}");
    let largest = control.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    for (i, (found, expected)) in found.iter().zip(expected).enumerate() {
        let far = (found - expected).abs() > STEEP * largest;
        assert!(!far, "{what}: value {i} is {found}, not {expected}");
    }
}

/// Refinement by other means: a hierarchy of its own.
fn refined(
    of: &Hierarchy,
    interpolation: Interpolation,
    positions: &[f64],
    what: &str,
) -> Vec<f64> {
    let (context, mesh) = (Context::serial(), of.shared_mesh(0).expect("a control mesh"));
    let made = Hierarchy::new(&context, mesh, of.scheme().clone(), LEVELS);
    let hierarchy = made.unwrap_or_else(|e| panic!("{what}: {e}"));
    let mut out = vec![0.0; 3 * hierarchy.mesh(LEVELS).vertices()];
    let done = hierarchy.interpolate(&context, LEVELS, interpolation, positions, 3, &mut out);
    done.unwrap_or_else(|e| panic!("{what}: {e}"));
    out
}

#[test]
fn tables_do_what_refinement_does() {
    each(|hierarchy, positions, finite, what| {
        let composed = table(hierarchy, &StencilTask::level(LEVELS), what);
        for row in 0..composed.rows() {
            let (indices, weights) = composed.row(row);
            let sum: f64 = weights.iter().sum();
            assert!((sum - 1.0).abs() <= STEEP, "{what}: row {row} sums to {sum}");
            assert!(weights.iter().all(|&w| w != 0.0), "{what}: row {row} has zeros");
            let mut once = indices.to_vec();
            once.sort_unstable();
            assert!(once.is_sorted_by(|a, b| a < b), "{what}: row {row} repeats a column");
        }
        if finite {
            let expected = refined(hierarchy, Interpolation::Vertex, positions, what);
            assert_close(&apply(&composed, positions), &expected, positions, what);
            let step = |level| table(hierarchy, &StencilTask::step(level), what);
            let by_steps = (1..=LEVELS).fold(positions.to_vec(), |v, l| apply(&step(l), &v));
            assert_close(&by_steps, &expected, positions, what);
        }
    });
}

#[test]
fn composing_the_steps_gives_the_composed_table() {
    each(|hierarchy, _, _, what| {
        let steps = [1, 2].map(|level| table(hierarchy, &StencilTask::step(level), what));
        let composed = steps[0].compose(&Context::serial(), &steps[1]).expect("they fit");
        assert_same_rows(&composed, &table(hierarchy, &StencilTask::level(LEVELS), what), what);
    });
}

/// Rows as maps: the same entries but for rounding, whatever their order.
fn assert_same_rows(a: &StencilTable<f64>, b: &StencilTable<f64>, what: &str) {
    assert_eq!((a.rows(), a.columns()), (b.rows(), b.columns()), "{what}");
    let mut dense = vec![0.0; a.columns()];
    for row in 0..a.rows() {
        for (table, sign) in [(a, 1.0), (b, -1.0)] {
            let (indices, weights) = table.row(row);
            indices.iter().zip(weights).for_each(|(&i, w)| dense[i as usize] += sign * w);
        }
        let far = dense.iter().any(|x| x.abs() > 1e4 * ROW);
        assert!(!far, "{what}: row {row}: {:?} {:?}", a.row(row), b.row(row));
        dense.fill(0.0);
    }
}

#[test]
fn selected_rows_are_rows_of_the_whole_table() {
    each(|hierarchy, _, _, what| {
        let whole = table(hierarchy, &StencilTask::level(LEVELS), what);
        let n = whole.rows() as u32;
        let few = if n == 0 { vec![] } else { vec![n - 1, 0, n / 2, n - 1] };
        let lists: [Vec<u32>; 2] = [few, (0..n).step_by(7).collect()];
        for list in lists {
            let task = StencilTask { vertices: Some(&list), ..StencilTask::level(LEVELS) };
            let some = table(hierarchy, &task, what);
            assert_eq!(some, whole.select(&Context::serial(), &list).expect("rows"), "{what}");
        }
    });
}

#[test]
fn varying_tables_do_what_varying_refinement_does() {
    each(|hierarchy, positions, finite, what| {
        let interpolation = Interpolation::Varying;
        let task = StencilTask { interpolation, ..StencilTask::level(LEVELS) };
        if hierarchy.scheme().split() == SplitKind::Corner {
            let refused = hierarchy.stencils::<f64>(&Context::serial(), &task).unwrap_err();
            assert_eq!(refused.kind(), ErrorKind::Unsupported, "{what}");
        } else if finite {
            let found = apply(&table(hierarchy, &task, what), positions);
            let expected = refined(hierarchy, interpolation, positions, what);
            assert_close(&found, &expected, positions, what);
        }
    });
}

#[test]
fn levels_and_vertices_that_do_not_exist_are_refused() {
    let cube = [0, 1, 3, 2, 4, 6, 7, 5, 0, 4, 5, 1, 2, 3, 7, 6, 0, 2, 6, 4, 1, 5, 7, 3];
    let mesh = carvel::Mesh::from_polygons(8, &[4; 6], &cube).expect("a cube");
    let context = Context::serial();
    let hierarchy = Hierarchy::new(&context, mesh, Scheme::catmull_clark(), 1).expect("small");
    let kind = |from, to, vertices| {
        let task = StencilTask { from, vertices, ..StencilTask::level(to) };
        hierarchy.stencils::<f32>(&context, &task).map_err(|e| e.kind())
    };
    assert!(kind(0, 2, None).is_ok());
    assert_eq!(kind(1, 1, None).map(|table| (table.rows(), table.entries())), Ok((26, 26)));
    assert_eq!(kind(1, 1, Some(&[3])).map(|table| table.indices().to_vec()), Ok(vec![3]));
    for (from, to) in [(0, 3), (2, 1), (2, 2), (u32::MAX, 0), (0, u32::MAX)] {
        assert_eq!(kind(from, to, None), Err(ErrorKind::ParameterOutOfRange), "{from} {to}");
    }
    assert_eq!(kind(0, 1, Some(&[26])), Err(ErrorKind::IndexOutOfRange));
    assert_eq!(kind(1, 1, Some(&[26])), Err(ErrorKind::IndexOutOfRange));
}
