//! Holes, and what is no manifold.

use crate::against::Failures;
use carvel_peers::{Control, Scheme, shapes};

fn everywhere(failures: &mut Failures, control: &Control, what: &str) {
    let control = control.clone().rounded();
    failures.boundaries(&control, Scheme::CatmullClark, 3, what);
    failures.boundaries(&control, Scheme::Bilinear, 2, what);
    if control.is_triangles() {
        failures.boundaries(&control, Scheme::Loop, 3, what);
    }
}

#[test]
fn holes() {
    let mut failures = Failures::default();
    everywhere(&mut failures, &shapes::grid(4, 4).holed(&[5]), "hole inside");
    everywhere(&mut failures, &shapes::grid(4, 4).holed(&[0, 5, 10]), "holes to the border");
    everywhere(&mut failures, &shapes::prism(5).holed(&[0, 3]), "a face that is no quad");
    everywhere(&mut failures, &shapes::icosahedron().holed(&[0, 1, 19]), "triangles");
    failures.check();
}

#[test]
fn edges_that_are_not_manifold() {
    let mut failures = Failures::default();
    for pages in [3, 4, 7] {
        let book = shapes::book(pages);
        everywhere(&mut failures, &book, &format!("book of {pages}"));
        everywhere(&mut failures, &shapes::triangulated(&book), &format!("cut book of {pages}"));
    }
    everywhere(&mut failures, &fin(), "a fin on a grid");
    everywhere(&mut failures, &shapes::triangulated(&fin()), "a fin on triangles");
    failures.check();
}

/// A grid with a quad that stands on an inner edge.
fn fin() -> Control {
    let mut grid = shapes::grid(3, 3);
    let first = grid.vertices() as u32;
    grid.positions.extend([1.0, 1.0, 1.0, 2.0, 1.0, 1.2]);
    grid.sizes.push(4);
    grid.indices.extend([5, 9, first + 1, first]);
    grid
}

#[test]
fn vertices_that_are_not_manifold() {
    let mut failures = Failures::default();
    let cubes = shapes::touching_cubes();
    everywhere(&mut failures, &cubes, "two cubes at a vertex");
    everywhere(&mut failures, &shapes::triangulated(&cubes), "two cut cubes at a vertex");
    let tie = Control::new(
        &[[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [-1., 0., 0.5], [-1., -1., 0.5]],
        [[0, 1, 2], [0, 3, 4]],
    );
    everywhere(&mut failures, &tie, "bow tie");
    failures.check();
}

#[test]
fn faces_of_opposite_orientation() {
    let mut failures = Failures::default();
    // Both faces run along their common edge in the same direction.
    let twisted = Control::new(
        &[[0., 0., 0.], [1., 0., 0.], [1., 1., 0.3], [0., 1., 0.], [2., 0., 0.1], [2., 1., 0.]],
        [[0, 1, 2, 3], [4, 1, 2, 5]],
    );
    everywhere(&mut failures, &twisted, "two quads");
    failures.check();
}

#[test]
fn creases_beside_what_is_not_manifold() {
    let mut failures = Failures::default();
    let book = shapes::book(4).creased(&[[0, 2], [1, 3]], 1.5);
    everywhere(&mut failures, &book, "book with creases");
    let cubes = shapes::touching_cubes().creased(&[[7, 6]], 2.5).cornered(&[7], 1.0);
    everywhere(&mut failures, &cubes, "cubes with a crease at the vertex");
    failures.check();
}
