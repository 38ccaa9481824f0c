//! Creases and sharp vertices in the middle of a grid: vertex 12, with the neighbours 7
//! and 17 across, 11 and 13 along.

use carvel::scheme::Creasing;
use carvel::{Boundary, Context, ErrorKind, Hierarchy, Refiner, Scheme, Task};

use crate::control::{Control, Row, Rows, blend, mean, row, sum};
use crate::support::number::ratio;

fn grid() -> Control {
    Control::grid(4, 4)
}

fn catmull_clark() -> Scheme {
    Scheme::catmull_clark()
}

fn chaikin() -> Scheme {
    Scheme::catmull_clark().with_creasing(Creasing::Chaikin)
}

/// The smooth rule at vertex 12.
fn smooth() -> Row {
    let corners = [6, 8, 16, 18].map(|v| (v, 1));
    let sides = [7, 11, 13, 17].map(|v| (v, 6));
    row(64, &[&corners[..], &sides, &[(12, 36)]].concat())
}

/// That of the edge from 12 to 13.
fn smooth_edge() -> Row {
    row(16, &[(12, 6), (13, 6), (7, 1), (8, 1), (17, 1), (18, 1)])
}

/// The crease rule at 12 between two neighbours.
fn crease(a: u32, b: u32) -> Row {
    row(8, &[(a, 1), (12, 6), (b, 1)])
}

fn stays() -> Row {
    row(1, &[(12, 1)])
}

/// The row at 12 under Catmull–Clark.
fn at_12(control: &Control) -> Row {
    control.rows(&catmull_clark()).at(&[12]).clone()
}

/// A crease along the row of 12 with one sharpness before it and another after it.
fn along(before: f32, after: f32) -> Control {
    grid().crease([11, 12], before).crease([13, 12], after)
}

// -------------------------------------------------------------------------------- rules

#[test]
fn sharp_edges_at_a_vertex_are_counted() {
    let sharp = |neighbours: &[u32]| {
        let with = |control: Control, &v: &u32| control.crease([12, v], 10.0);
        at_12(&neighbours.iter().fold(grid(), with))
    };
    assert_eq!(sharp(&[]), smooth());
    assert_eq!(sharp(&[13]), smooth(), "a dart");
    assert_eq!(sharp(&[11, 13]), crease(11, 13));
    assert_eq!(sharp(&[7, 13]), crease(7, 13), "a bend");
    assert_eq!(sharp(&[7, 11, 13]), stays(), "a corner of three");
    assert_eq!(sharp(&[7, 11, 13, 17]), stays(), "a corner of four");
}

#[test]
fn sharp_edges_keep_their_middle() {
    for sharpness in [1.0, 1.5, 9.5, 10.0, f32::INFINITY] {
        let rows = along(0.0, sharpness).rows(&catmull_clark());
        assert_eq!(rows.at(&[12, 13]), &mean(&[12, 13]), "{sharpness}");
        assert_ne!(rows.at(&[11, 12]), &mean(&[11, 12]), "{sharpness}");
    }
    let half = along(0.0, 0.5).rows(&catmull_clark());
    assert_eq!(half.at(&[12, 13]), &blend((1, 2), mean(&[12, 13]), smooth_edge()));
    let smooth = along(0.0, 0.0).rows(&catmull_clark());
    assert_eq!(smooth.at(&[12, 13]), &smooth_edge());
}

#[test]
fn what_ends_within_the_step_is_mixed() {
    assert_eq!(at_12(&along(0.5, 0.5)), blend((1, 2), crease(11, 13), smooth()));
    assert_eq!(at_12(&along(1.0, 1.0)), crease(11, 13));
    assert_eq!(at_12(&along(1.5, 1.5)), crease(11, 13));
    // The mean of what ends.
    assert_eq!(at_12(&along(0.5, 1.0)), blend((3, 4), crease(11, 13), smooth()));
    // What lasts does not count: a crease on its way to a dart.
    assert_eq!(at_12(&along(0.5, 10.0)), blend((1, 2), crease(11, 13), smooth()));
    assert_eq!(at_12(&along(0.5, 1.25)), blend((1, 2), crease(11, 13), smooth()));
    // A dart stays one until it is smooth, which is the same.
    assert_eq!(at_12(&along(0.0, 0.5)), smooth());
    // A corner on its way to a crease of the two that last.
    let corner = along(10.0, 10.0).crease([12, 7], 0.25);
    assert_eq!(at_12(&corner), blend((1, 4), stays(), crease(11, 13)));
    let bend = along(10.0, 0.25).crease([12, 7], 2.0);
    assert_eq!(at_12(&bend), blend((1, 4), stays(), crease(7, 11)));
}

/// A dart that ends within the step is no mixture of the smooth rule with itself, which
/// would be rounded in another way.
#[test]
fn darts_have_the_row_of_a_smooth_vertex() {
    let row = |control: &Control| {
        let mut found = Vec::new();
        let each = |v: u32, row: &[(u32, f64)]| {
            if v == 12 {
                found = row.to_vec();
            }
        };
        control.hierarchy(&catmull_clark(), 1).each_row_of(1, 0, each).expect("level 1");
        found
    };
    assert_eq!(row(&along(0.0, 0.3)), row(&grid()));
}

#[test]
fn sharp_vertices_stay_as_long_as_they_are_sharp() {
    assert_eq!(at_12(&grid().sharp(12, 10.0)), stays());
    assert_eq!(at_12(&grid().sharp(12, 1.0)), stays());
    assert_eq!(at_12(&grid().sharp(12, 1.5)), stays());
    assert_eq!(at_12(&grid().sharp(12, 0.5)), blend((1, 2), stays(), smooth()));
    assert_eq!(at_12(&grid().sharp(12, 0.0)), smooth());
    let on_crease = along(10.0, 10.0).sharp(12, 0.25);
    assert_eq!(at_12(&on_crease), blend((1, 4), stays(), crease(11, 13)));
    // All that ends together: (1/4 + 5/8 + 5/8)/3.
    let all = along(0.625, 0.625).sharp(12, 0.25);
    assert_eq!(at_12(&all), blend((1, 2), stays(), smooth()));
    // A vertex that stays sharp hides what ends around it.
    assert_eq!(at_12(&along(0.5, 0.5).sharp(12, 2.0)), stays());
}

#[test]
fn loop_has_the_same_creases() {
    let scheme = Scheme::loop_triangles();
    let rows = |control: Control| control.cut().rows(&scheme);
    let ring = [6, 7, 11, 13, 17, 18].map(|v| (v, 1));
    let smooth = row(16, &[&ring[..], &[(12, 10)]].concat());
    assert_eq!(rows(grid()).at(&[12]), &smooth);
    assert_eq!(rows(along(10.0, 10.0)).at(&[12]), &crease(11, 13));
    assert_eq!(rows(along(0.5, 0.5)).at(&[12]), &blend((1, 2), crease(11, 13), smooth));
    let edge = row(8, &[(12, 3), (13, 3), (7, 1), (18, 1)]);
    assert_eq!(rows(grid()).at(&[12, 13]), &edge);
    let half = rows(along(0.0, 0.5));
    assert_eq!(half.at(&[12, 13]), &blend((1, 2), mean(&[12, 13]), edge));
}

#[test]
fn linear_refinement_knows_no_creases() {
    let control = along(10.0, 0.5).sharp(12, 3.0);
    let (tagged, plain) = (control.rows(&Scheme::bilinear()), grid().rows(&Scheme::bilinear()));
    for parent in [&[12][..], &[12, 13], &[11, 12], &[12, 13, 18, 17]] {
        assert_eq!(tagged.at(parent), plain.at(parent), "{parent:?}");
    }
}

/// On the boundary a crease that ends there makes a corner: three sharp edges.
#[test]
fn creases_that_reach_the_boundary() {
    let edge = catmull_clark().with_boundary(Boundary::Edge);
    let rows = |sharpness| grid().crease([2, 7], sharpness).rows(&edge);
    let along = row(8, &[(1, 1), (2, 6), (3, 1)]);
    assert_eq!(rows(10.0).at(&[2]), &row(1, &[(2, 1)]));
    assert_eq!(rows(0.5).at(&[2]), &blend((1, 2), row(1, &[(2, 1)]), along.clone()));
    // A vertex of one face, sharp for half a step.
    let corner = grid().sharp(4, 0.5).sharp(2, 0.25).rows(&edge);
    let round = row(8, &[(3, 1), (4, 6), (9, 1)]);
    assert_eq!(corner.at(&[4]), &blend((1, 2), row(1, &[(4, 1)]), round));
    assert_eq!(corner.at(&[2]), &blend((1, 4), row(1, &[(2, 1)]), along));
}

// ------------------------------------------------------------------- from step to step

/// Rows at level 2 around the vertex that 12 became, by the children along the crease.
fn second(hierarchy: &Hierarchy) -> (Row, [u32; 4], u32) {
    let first = Rows::of(hierarchy, 1);
    let near = [[11, 12], [12, 13], [7, 12], [12, 17]].map(|edge| first.child(&edge));
    let own = first.child(&[12]);
    (Rows::of(hierarchy, 2).at(&[own]).clone(), near, own)
}

#[test]
fn each_step_takes_one_off() {
    let rule = |control: Control| {
        let (row, near, own) = second(&control.hierarchy(&catmull_clark(), 2));
        let is_crease = row == self::row(8, &[(near[0], 1), (own, 6), (near[1], 1)]);
        (row[&own].clone(), is_crease)
    };
    // 9/16 where smooth, 3/4 on a crease, half way between, 1 at a corner.
    assert_eq!(rule(along(1.0, 1.0)), (ratio(9, 16), false));
    assert_eq!(rule(along(1.5, 1.5)), (ratio(21, 32), false));
    assert_eq!(rule(along(2.0, 2.0)), (ratio(3, 4), true));
    assert_eq!(rule(along(10.0, 10.0)), (ratio(3, 4), true));
    assert_eq!(rule(grid().sharp(12, 1.0)), (ratio(9, 16), false));
    assert_eq!(rule(grid().sharp(12, 1.5)), (ratio(25, 32), false));
    assert_eq!(rule(grid().sharp(12, 10.0)), (ratio(1, 1), false));
}

/// Sharp halves, by the end and the edge that they are of, and sharp vertices.
type Tags = (Vec<([u32; 2], f32)>, Vec<(u32, f32)>);

/// Tags of level 1 along the edges from 11 and 13 to 12.
fn left(control: &Control, scheme: &Scheme) -> Tags {
    let hierarchy = control.hierarchy(scheme, 1);
    let (mesh, rows) = (hierarchy.mesh(1), Rows::of(&hierarchy, 1));
    mesh.validate().expect("a sound mesh");
    let middles = [[11, 12], [12, 13]].map(|edge| rows.child(&edge));
    let creases = mesh.creases().map(|crease| {
        let mut ends = crease.vertices;
        ends.sort_unstable();
        assert!(middles.contains(&ends[1]), "{ends:?} is no half of the crease");
        (ends, crease.sharpness)
    });
    let mut creases: Vec<_> = creases.collect();
    creases.sort_by(|a, b| a.partial_cmp(b).expect("numbers"));
    let name = |([v, m], s): ([u32; 2], f32)| ([v, if m == middles[0] { 11 } else { 13 }], s);
    let sharp = mesh.sharp_vertices().map(|tag| (tag.vertex, tag.sharpness));
    (creases.into_iter().map(name).collect(), sharp.collect())
}

#[test]
fn halves_inherit_what_is_left() {
    let (creases, sharp) = left(&along(1.5, 10.0).sharp(12, 2.5).sharp(3, 1.0), &catmull_clark());
    assert_eq!(creases, [([11, 11], 0.5), ([12, 11], 0.5), ([12, 13], 10.0), ([13, 13], 10.0)]);
    assert_eq!(sharp, [(12, 1.5)]);
    let (creases, sharp) = left(&along(1.0, 0.5).sharp(12, 0.5), &catmull_clark());
    assert_eq!((creases.len(), sharp.len()), (0, 0));
}

#[test]
fn triangles_inherit_as_well() {
    let scheme = Scheme::loop_triangles();
    let (creases, _) = left(&along(1.5, 10.0).cut(), &scheme);
    assert_eq!(creases, [([11, 11], 0.5), ([12, 11], 0.5), ([12, 13], 10.0), ([13, 13], 10.0)]);
}

// ------------------------------------------------------------------------------ Chaikin

/// 3/4 of its own and 1/4 of the mean of the others, less 1.
#[test]
fn chaikin_creasing_looks_at_the_other_edges() {
    let (creases, _) = left(&along(1.0, 3.0), &chaikin());
    // At 12: 3/4 + 3/4 − 1 and 9/4 + 1/4 − 1; at 11 and 13 there is no other edge.
    assert_eq!(creases, [([12, 11], 0.5), ([12, 13], 1.5), ([13, 13], 2.0)]);
    // Infinite sharpness stays, and is no other edge.
    let (creases, _) = left(&along(10.0, 3.0), &chaikin());
    assert_eq!(creases, [([11, 11], 10.0), ([12, 11], 10.0), ([12, 13], 2.0), ([13, 13], 2.0)]);
    let star = along(2.0, 4.0).crease([12, 7], 1.0).crease([12, 17], 10.0);
    let hierarchy = star.hierarchy(&chaikin(), 1);
    let mut found: Vec<f32> = hierarchy.mesh(1).creases().map(|crease| crease.sharpness).collect();
    found.sort_by(f32::total_cmp);
    // 3/4·(2, 4, 1) + 1/4·(5/2, 3/2, 3) − 1 at 12, and 1, 3, 0 at the far ends.
    assert_eq!(found, [0.5, 1.0, 1.125, 2.375, 3.0, 10.0, 10.0]);
}

#[test]
fn chaikin_mixes_by_what_ends() {
    let rows = along(1.25, 0.25).rows(&chaikin());
    // 5/4·3/4 + 1/16 − 1 is 0: both end, of mean sharpness 3/4.
    assert_eq!(rows.at(&[12]), &blend((3, 4), crease(11, 13), smooth()));
    // Their own sharpness is the weight of the midpoint, beyond 1 as well.
    assert_eq!(rows.at(&[12, 13]), &blend((1, 4), mean(&[12, 13]), smooth_edge()));
    let left_edge = row(16, &[(11, 6), (12, 6), (6, 1), (7, 1), (16, 1), (17, 1)]);
    assert_eq!(rows.at(&[11, 12]), &blend((5, 4), mean(&[11, 12]), left_edge));
    // One ends, the other lasts: a crease becomes a dart.
    let rows = along(0.25, 2.0).rows(&chaikin());
    assert_eq!(rows.at(&[12]), &blend((1, 4), crease(11, 13), smooth()));
    assert_eq!(rows.at(&[12, 13]), &mean(&[12, 13]));
    // Sharper than 1 by its neighbour's help: under the uniform rule 3/4 would end.
    let rows = along(0.75, 3.0).rows(&chaikin());
    assert_eq!(rows.at(&[12]), &crease(11, 13));
}

/// In the middle of the edge from 11 to 12: 17/32 of either end and −1/64 of four others.
#[test]
fn beyond_a_crease_values_may_overflow() {
    let mesh = along(1.25, 0.25).mesh();
    let sign = |v: usize| if [11, 12].contains(&v) { 1.0 } else { -1.0 };
    let positions: Vec<f64> = (0..75).map(|i| sign(i / 3) * f64::MAX).collect();
    let scheme = chaikin();
    let task = Task::new(&mesh, &scheme, 1, &positions);
    let refused = Refiner::new().refine(&Context::serial(), &task).unwrap_err();
    assert_eq!(refused.kind(), ErrorKind::Overflow);
}

/// A whole line of semi-sharp edges: nothing ends in the middle of it.
#[test]
fn chaikin_keeps_even_creases_even() {
    let line = along(2.5, 2.5).crease([10, 11], 2.5).crease([13, 14], 2.5);
    let hierarchy = line.hierarchy(&chaikin(), 2);
    assert!(hierarchy.mesh(1).creases().all(|crease| crease.sharpness == 1.5));
    assert!(hierarchy.mesh(2).creases().all(|crease| crease.sharpness == 0.5));
    assert_eq!(hierarchy.mesh(2).creases().len(), 16);
}

/// Weights of a mixed row add up: what the parts have in common counts twice.
#[test]
fn parts_of_a_mixed_row_add_up() {
    let total: num_rational::BigRational = at_12(&along(0.5, 0.75)).into_values().sum();
    assert_eq!(total, ratio(1, 1));
    let parts = [(ratio(5, 8), crease(11, 13)), (ratio(3, 8), smooth())];
    assert_eq!(at_12(&along(0.5, 0.75)), sum(parts));
}

/// What the bulk computes is written again where a crease rules.
#[test]
fn values_follow_creases_as_rows_do() {
    let control = Control::torus(4, 4).crease([0, 1], 10.0).crease([1, 2], 10.0);
    let hierarchy = control.hierarchy(&Scheme::catmull_clark(), 1);
    let values: Vec<f64> = (0..16).map(|v| f64::from(v * v % 7)).collect();
    let mut refined = vec![0.0; hierarchy.mesh(1).vertices()];
    hierarchy.refine(&Context::serial(), 1, &values, 1, &mut refined).unwrap();
    assert_eq!(refined[1], 0.75 * values[1] + 0.125 * (values[0] + values[2]));
}
