//! Semi-sharp and infinitely sharp edges and vertices.

use crate::against::Failures;
use carvel_peers::{Boundary, Control, Creasing, Options, Scheme, shapes};

/// Fractions that wear off at once, in the middle of a level, in the middle of a later
/// one; and one that never does.
const SHARPNESS: [f32; 5] = [0.3, 1.0, 2.5, 3.7, 10.0];

fn both_methods(failures: &mut Failures, control: &Control, what: &str) {
    let control = control.clone().rounded();
    for creasing in Creasing::ALL {
        for boundary in [Boundary::Edge, Boundary::EdgeAndCorner] {
            let options = Options { creasing, boundary, ..Options::default() };
            failures.levels(&control, Scheme::CatmullClark, options, 4, what);
            if control.is_triangles() {
                failures.levels(&control, Scheme::Loop, options, 4, what);
            }
        }
    }
}

/// On the quad grid and on the triangle grid of the same vertices, (i, j) = 6 i + j.
fn on_grids(name: &str, tag: impl Fn(Control, f32) -> Control) {
    let mut failures = Failures::default();
    for sharpness in SHARPNESS {
        let what = format!("{name} of sharpness {sharpness}");
        let grid = shapes::grid(5, 5);
        both_methods(&mut failures, &tag(grid.clone(), sharpness), &what);
        both_methods(&mut failures, &tag(shapes::triangulated(&grid), sharpness), &what);
    }
    failures.check();
}

#[test]
fn a_line_from_border_to_border() {
    let line: Vec<_> = (0..5).map(|i| [6 * i + 2, 6 * i + 8]).collect();
    on_grids("line", |control, sharpness| control.creased(&line, sharpness));
}

#[test]
fn a_dart_ends_inside() {
    on_grids("dart", |control, s| control.creased(&[[2, 8], [8, 14]], s));
}

#[test]
fn three_and_four_creases_meet() {
    on_grids("three", |control, s| control.creased(&[[8, 14], [14, 20], [14, 15]], s));
    on_grids("four", |control, s| control.creased(&[[8, 14], [14, 20], [14, 15], [13, 14]], s));
}

#[test]
fn creases_of_different_sharpness_meet() {
    on_grids("rising", |control, s| {
        control.creased(&[[2, 8]], s).creased(&[[8, 14]], s + 0.75).creased(&[[14, 20]], s + 1.5)
    });
    on_grids("fractions", |control, s| {
        control.creased(&[[8, 14]], 0.5 * s).creased(&[[14, 20]], s).creased(&[[14, 15]], 1.25)
    });
}

#[test]
fn sharp_vertices_inside_and_at_the_border() {
    on_grids("inside", |control, s| control.cornered(&[14], s));
    on_grids("border and corner", |control, s| control.cornered(&[2, 0], s));
}

#[test]
fn sharp_vertices_on_creases() {
    on_grids("vertex on a crease", |control, s| {
        control.creased(&[[8, 14], [14, 20]], 2.0).cornered(&[14], s)
    });
    on_grids("vertex at the end of a dart", |control, s| {
        control.creased(&[[2, 8], [8, 14]], 1.5).cornered(&[14], s)
    });
}

#[test]
fn closed_meshes() {
    let mut failures = Failures::default();
    for sharpness in SHARPNESS {
        let what = format!("sharpness {sharpness}");
        let rim: Vec<_> = (0..9).map(|i| [9 + i, 9 + (i + 1) % 9]).collect();
        let prism = shapes::prism(9).creased(&rim, sharpness);
        both_methods(&mut failures, &prism, &format!("rim of a nonagon, {what}"));
        let cube = shapes::cube().creased(&[[0, 1], [1, 3], [1, 5]], sharpness);
        both_methods(&mut failures, &cube, &format!("corner of a cube, {what}"));
        let solid =
            shapes::icosahedron().creased(&[[0, 1], [1, 2]], sharpness).cornered(&[4], sharpness);
        both_methods(&mut failures, &solid, &format!("icosahedron, {what}"));
        let spike = shapes::bipyramid(30).creased(&[[0, 30], [15, 30]], sharpness);
        both_methods(&mut failures, &spike, &format!("through valence 30, {what}"));
    }
    failures.check();
}

#[test]
fn linear_refinement_heeds_no_crease() {
    let mut failures = Failures::default();
    let control = shapes::grid(3, 3).creased(&[[5, 6]], 2.0).cornered(&[10], 1.0).rounded();
    failures.boundaries(&control, Scheme::Bilinear, 3, "creased grid");
    failures.check();
}
