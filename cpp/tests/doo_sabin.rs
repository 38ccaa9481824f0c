//! Doo–Sabin against CGAL, whose weights are the cosine ones of the 1978 paper.

use carvel_peers::normalise::{Border, border};
use carvel_peers::{
    Boundary, Cgal, Comparison, Control, Peer, PeerMesh, Precision, Scheme, Task, ours, shapes,
};

const SCHEME: Scheme = Scheme::DooSabin;

fn cgal(control: &Control, precision: Precision, levels: u32) -> PeerMesh {
    Cgal.refine(&Task::new(control, SCHEME, precision), levels).expect("CGAL")
}

fn carvel(control: &Control, boundary: Boundary, precision: Precision, levels: u32) -> PeerMesh {
    let mut task = Task::new(control, SCHEME, precision);
    task.options.boundary = boundary;
    ours::refine(&task, levels).expect("carvel").mesh
}

fn agree(control: &Control, boundary: Boundary, levels: u32, what: &str) {
    let control = control.clone().rounded();
    for precision in Precision::ALL {
        let (ours, theirs) =
            (carvel(&control, boundary, precision, levels), cgal(&control, precision, levels));
        let apart = Comparison::through_adjacency(&ours, &theirs);
        assert!(apart.agrees(precision), "{what}, level {levels}, {precision:?}: {apart:?}");
    }
}

#[test]
fn closed_meshes_of_every_face_size_and_valence() {
    for n in 3..=30 {
        // Closed, so the boundary rule must not matter: the default is taken.
        let boundary = Boundary::default();
        for levels in 1..=3 {
            agree(&shapes::prism(n), boundary, levels, &format!("{n}-gons"));
            agree(&shapes::bipyramid(n), boundary, levels, &format!("valence {n}"));
            agree(&shapes::pyramid(n), boundary, levels, &format!("{n}-gon and valence {n}"));
        }
    }
}

#[test]
fn closed_meshes_of_other_kinds() {
    let several = [shapes::cube(), shapes::icosahedron(), shapes::prism(7)];
    for (control, what) in [
        (shapes::cube(), "cube"),
        (shapes::tetrahedron(), "tetrahedron"),
        (shapes::icosahedron(), "icosahedron"),
        (shapes::torus(5, 4), "torus"),
        (shapes::components(&several), "three components"),
    ] {
        for levels in 1..=4 {
            agree(&control, Boundary::default(), levels, what);
        }
    }
}

/// CGAL has no border rule: where a child face would need a face beyond the border it
/// is removed, and with it the ring of faces along the border. carvel's `Boundary::None`
/// makes no such child in the first place, so the two are the same surface; under
/// carvel's default the surface reaches the border, and no option of CGAL's gives that.
#[test]
fn open_meshes_end_half_a_cell_inside_as_with_boundary_none() {
    assert_eq!(border(Cgal.name(), SCHEME), Border::Is(Boundary::None));
    let shapes = [
        (shapes::grid(4, 3), "grid"),
        (shapes::frame(), "frame"),
        (shapes::triangulated(&shapes::grid(3, 4)), "triangles"),
        (shapes::fan(7), "fan"),
    ];
    for (control, what) in shapes {
        for levels in 1..=2 {
            agree(&control, Boundary::None, levels, what);
        }
    }
}

#[test]
fn on_open_meshes_the_default_reaches_the_border_and_cgal_does_not() {
    let control = shapes::grid(4, 4);
    let (ours, theirs) = (
        carvel(&control, Boundary::default(), Precision::Double, 3),
        cgal(&control, Precision::Double, 3),
    );
    assert!(!Comparison::through_adjacency(&ours, &theirs).same_counts);
    assert_eq!(extent(&ours), (0.0, 4.0));
    let (low, high) = extent(&theirs);
    // Half a cell of the control mesh, less the eighth of it that later levels take.
    assert_eq!((low, high), (0.4375, 4.0 - 0.4375));
}

/// The range of x.
fn extent(mesh: &PeerMesh) -> (f64, f64) {
    let x = || mesh.positions.iter().step_by(3).copied();
    (x().fold(f64::MAX, f64::min), x().fold(f64::MIN, f64::max))
}
