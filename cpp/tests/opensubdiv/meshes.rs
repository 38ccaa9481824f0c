//! Plain meshes: every face size, every valence, open and closed, all boundary rules.

use crate::against::Failures;
use carvel::io::{self, ReadOptions};
use carvel_peers::{Control, Options, Scheme, Triangles, shapes};
use std::path::Path;

const QUAD_SCHEMES: [Scheme; 2] = [Scheme::CatmullClark, Scheme::Bilinear];

fn cow() -> Control {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../assets/spot/spot_control_mesh.obj");
    let file = io::read(&path, &ReadOptions::default()).expect("the cow");
    Control::new(&file.positions, file.faces()).rounded()
}

/// The schemes that take a mesh.
fn schemes(control: &Control) -> impl Iterator<Item = Scheme> {
    let triangles = control.is_triangles();
    QUAD_SCHEMES.into_iter().chain(triangles.then_some(Scheme::Loop))
}

#[test]
fn the_cow() {
    let mut failures = Failures::default();
    let cow = cow();
    for scheme in QUAD_SCHEMES {
        failures.levels(&cow, scheme, Options::default(), 3, "cow");
    }
    let triangles = shapes::triangulated(&cow);
    failures.levels(&triangles, Scheme::Loop, Options::default(), 3, "triangulated cow");
    failures.check();
}

#[test]
fn platonic_solids_to_level_five() {
    let mut failures = Failures::default();
    for (control, what) in [
        (shapes::cube(), "cube"),
        (shapes::tetrahedron(), "tetrahedron"),
        (shapes::icosahedron(), "icosahedron"),
    ] {
        for scheme in schemes(&control) {
            failures.levels(&control.clone().rounded(), scheme, Options::default(), 5, what);
        }
    }
    failures.check();
}

#[test]
fn open_meshes_under_every_boundary_rule() {
    let mut failures = Failures::default();
    for (control, what) in [
        (shapes::grid(1, 1), "one quad"),
        (shapes::grid(1, 3), "strip"),
        (shapes::grid(4, 3), "grid"),
        (shapes::frame(), "frame"),
        (shapes::polygon(3), "one triangle"),
        (shapes::triangulated(&shapes::grid(3, 4)), "triangle grid"),
        (shapes::valence_two(), "valence two inside"),
        (shapes::components(&[shapes::cube(), shapes::frame(), shapes::prism(7)]), "components"),
    ] {
        for scheme in schemes(&control) {
            failures.boundaries(&control.clone().rounded(), scheme, 3, what);
        }
    }
    failures.check();
}

#[test]
fn every_face_size_and_valence() {
    let mut failures = Failures::default();
    for n in 1..=30 {
        let mut meshes = vec![(shapes::half_fan(n), "half fan")];
        if n >= 3 {
            meshes.push((shapes::prism(n), "prism"));
            meshes.push((shapes::bipyramid(n), "bipyramid"));
            meshes.push((shapes::pyramid(n), "pyramid"));
            meshes.push((shapes::polygon(n), "polygon"));
            meshes.push((shapes::fan(n), "fan"));
        }
        for (control, what) in meshes {
            for scheme in schemes(&control) {
                let what = format!("{what} of {n}");
                failures.boundaries(&control.clone().rounded(), scheme, 2, &what);
            }
        }
    }
    failures.check();
}

#[test]
fn the_smooth_triangle_rule() {
    let mut failures = Failures::default();
    let options = Options { triangles: Triangles::Smooth, ..Options::default() };
    for (control, what) in [
        (shapes::icosahedron(), "icosahedron"),
        (shapes::pyramid(5), "pyramid: triangles beside a pentagon"),
        (shapes::pyramid(4), "pyramid: triangles beside a quad"),
        (shapes::triangulated(&shapes::grid(3, 3)), "open triangles"),
    ] {
        failures.levels(&control.rounded(), Scheme::CatmullClark, options, 3, what);
    }
    failures.check();
}
