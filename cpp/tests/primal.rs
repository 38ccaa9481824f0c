//! Catmull–Clark and Loop against CGAL and OpenMesh, which number and cut as they like:
//! matched by walking both meshes side by side.

use carvel_peers::normalise::{Border, border};
use carvel_peers::{
    Cgal, Comparison, Control, OpenMesh, Peer, Precision, Scheme, Task, ours, shapes,
};

fn agree(peer: &dyn Peer, control: &Control, scheme: Scheme, levels: u32, what: &str) {
    let control = control.clone().rounded();
    for precision in Precision::ALL {
        let task = Task::new(&control, scheme, precision);
        let mut mine = task;
        if let Border::Is(boundary) = border(peer.name(), scheme) {
            mine.options.boundary = boundary;
        }
        let ours = ours::refine(&mine, levels).expect("carvel").mesh;
        let theirs = peer.refine(&task, levels).unwrap_or_else(|e| panic!("{what}: {e}"));
        let apart = Comparison::through_adjacency(&ours, &theirs);
        let name = peer.name();
        assert!(apart.agrees(precision), "{name} {scheme:?} {what} level {levels}: {apart:?}");
    }
}

const BOTH: [&dyn Peer; 2] = [&Cgal, &OpenMesh];

#[test]
fn catmull_clark_on_closed_meshes() {
    for peer in BOTH {
        for n in 3..=30 {
            agree(peer, &shapes::prism(n), Scheme::CatmullClark, 2, &format!("prism {n}"));
            agree(peer, &shapes::bipyramid(n), Scheme::CatmullClark, 2, &format!("bipyramid {n}"));
        }
        agree(peer, &shapes::torus(6, 5), Scheme::CatmullClark, 4, "torus");
        let several = shapes::components(&[shapes::cube(), shapes::prism(5)]);
        agree(peer, &several, Scheme::CatmullClark, 4, "components");
    }
}

#[test]
fn loop_on_closed_meshes() {
    for peer in BOTH {
        for n in 3..=30 {
            agree(peer, &shapes::bipyramid(n), Scheme::Loop, 2, &format!("bipyramid {n}"));
        }
        agree(peer, &shapes::tetrahedron(), Scheme::Loop, 4, "tetrahedron");
        agree(peer, &shapes::icosahedron(), Scheme::Loop, 4, "icosahedron");
    }
}

#[test]
fn open_meshes_by_the_rule_that_each_peer_has() {
    let triangles = shapes::triangulated(&shapes::grid(4, 3));
    for (control, what) in [(shapes::grid(4, 3), "grid"), (shapes::frame(), "frame")] {
        agree(&Cgal, &control, Scheme::CatmullClark, 3, what);
    }
    for peer in BOTH {
        agree(peer, &triangles, Scheme::Loop, 3, "triangles");
        agree(peer, &shapes::half_fan(7), Scheme::Loop, 3, "half fan");
    }
}
