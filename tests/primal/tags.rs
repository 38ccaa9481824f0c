//! Holes through the levels, tags that no mesh takes, meshes that no rule is for.

use carvel::mesh::{Defects, NonManifold};
use carvel::{
    Boundary, Context, Element, Error, ErrorKind, Fraction, Hierarchy, Prediction, Scheme,
};

use crate::control::{Control, mean, row};

// -------------------------------------------------------------------------------- holes

#[test]
fn holes_go_to_all_their_children() {
    let hierarchy = Control::grid(3, 3).holes(&[7, 4]).hierarchy(&Scheme::catmull_clark(), 2);
    assert_eq!(hierarchy.mesh(0).holes(), [4, 7]);
    assert_eq!(hierarchy.mesh(1).holes(), [16, 17, 18, 19, 28, 29, 30, 31]);
    let second: Vec<u32> = (64..80).chain(112..128).collect();
    assert_eq!(hierarchy.mesh(2).holes(), second);
    let triangles = Control::bipyramid(4).holes(&[2]).hierarchy(&Scheme::loop_triangles(), 2);
    assert_eq!(triangles.mesh(1).holes(), [8, 9, 10, 11]);
    assert_eq!(triangles.mesh(2).holes(), (32..48).collect::<Vec<_>>());
    let pentagon = Control::new(&[vec![0, 1, 2, 3, 4], vec![1, 0, 5, 6]]).holes(&[0]);
    let hierarchy = pentagon.hierarchy(&Scheme::bilinear(), 1);
    assert_eq!(hierarchy.mesh(1).holes(), [0, 1, 2, 3, 4]);
}

/// With `Boundary::None` every face that touches the boundary is a hole.
#[test]
fn faces_at_the_boundary_are_holes_if_there_is_no_boundary_rule() {
    let none = |scheme: Scheme| scheme.with_boundary(Boundary::None);
    let mesh = Control::grid(4, 4).holes(&[5]).mesh();
    let inside = [6, 9, 10];
    let others: Vec<u32> = (0..16).filter(|f| !inside.contains(f)).collect();
    assert_eq!(none(Scheme::catmull_clark()).holes(&mesh).unwrap(), others);
    assert_eq!(none(Scheme::bilinear()).holes(&mesh).unwrap(), [5]);
    assert_eq!(Scheme::catmull_clark().holes(&mesh).unwrap(), [5]);
    let closed = Control::torus(4, 4).holes(&[3]).mesh();
    assert_eq!(none(Scheme::catmull_clark()).holes(&closed).unwrap(), [3]);
    let cut = Control::grid(4, 4).cut().mesh();
    let around: Vec<u32> = (0..32).filter(|f| !inside.contains(&(f / 2)) && f / 2 != 5).collect();
    assert_eq!(none(Scheme::loop_triangles()).holes(&cut).unwrap(), around);
    // What several faces share is no boundary: two tetrahedra at an edge are closed.
    let kissing = Control::new(&[
        [0, 1, 2],
        [1, 0, 3],
        [0, 2, 3],
        [2, 1, 3],
        [0, 1, 4],
        [1, 0, 5],
        [0, 4, 5],
        [4, 1, 5],
    ]);
    assert_eq!(none(Scheme::loop_triangles()).holes(&kissing.mesh()).unwrap(), [] as [u32; 0]);
}

// -------------------------------------------------------------------------- unusable tags

#[track_caller]
fn refused(control: &Control, element: Element, words: &str) {
    for policy in [NonManifold::Error, NonManifold::Cut, NonManifold::Sharpen] {
        let error = match control.try_mesh(policy).unwrap_err() {
            Defects::Call(error) => error,
            soup @ Defects::Soup(_) => panic!("{soup:?}"),
        };
        assert_eq!(error.kind(), ErrorKind::InvalidTag);
        assert_eq!(error.elements(), [element]);
        assert!(error.to_string().contains(words), "{error}");
    }
}

#[test]
fn tags_that_mean_nothing_are_refused() {
    let grid = || Control::grid(2, 2);
    let edge = Element::Edge(1, 4);
    for sharpness in [f32::NAN, -1.0, -f32::MIN_POSITIVE, f32::NEG_INFINITY] {
        let words = "which is not a number from 0 up";
        refused(&grid().crease([1, 4], sharpness), edge, words);
        refused(&grid().sharp(4, sharpness), Element::Vertex(4), words);
    }
    let words = "names no edge of the mesh";
    refused(&grid().crease([0, 4], 1.0), Element::Edge(0, 4), words);
    refused(&grid().crease([0, 9], 1.0), Element::Edge(0, 9), words);
    refused(&grid().crease([9, 0], 1.0), Element::Edge(9, 0), words);
    refused(&grid().crease([4, 4], 1.0), Element::Edge(4, 4), words);
    refused(&grid().sharp(9, 1.0), Element::Vertex(9), "is not in the mesh");
    refused(&grid().holes(&[1, 4]), Element::Face(4), "is not in the mesh");
    let twice = grid().crease([1, 4], 1.0).crease([4, 1], 2.0);
    let error = twice.try_mesh(NonManifold::Error).unwrap_err();
    assert!(Error::from(error).to_string().contains("has two sharpnesses, 1 and 2"));
    let twice = grid().sharp(4, 1.0).sharp(4, 0.0);
    refused(&twice, Element::Vertex(4), "has two sharpnesses, 0 and 1");
}

#[test]
fn tags_that_say_the_same_are_one() {
    let mesh = Control::grid(2, 2).crease([1, 4], 2.0).crease([4, 1], 2.0).sharp(4, 50.0);
    let mesh = mesh.sharp(4, 50.0).crease([0, 1], 3.0).crease([4, 7], 0.0).sharp(8, 0.0).mesh();
    let creases: Vec<_> = mesh.creases().map(|c| c.sharpness).collect();
    assert_eq!(creases, [2.0], "the boundary is sharp anyway, 0 is not");
    let sharp: Vec<_> = mesh.sharp_vertices().map(|s| (s.vertex, s.sharpness)).collect();
    assert_eq!(sharp, [(4, 10.0)]);
}

// ------------------------------------------------------------------------------ refusals

#[track_caller]
fn unsupported(control: &Control, scheme: &Scheme, words: &str) -> Error {
    let mesh = control.mesh();
    let error = scheme.check(&mesh).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Unsupported);
    assert!(error.to_string().contains(words), "{error}");
    let made = Hierarchy::new(&Context::serial(), mesh, scheme.clone(), 1);
    assert_eq!(made.unwrap_err().kind(), ErrorKind::Unsupported);
    error
}

/// Three pages at a spine 0, 1, 2.
fn book() -> Control {
    let page = |i: u32| [[0, 1, 4 + 3 * i, 3 + 3 * i], [1, 2, 5 + 3 * i, 4 + 3 * i]];
    Control::new(&(0..3).flat_map(page).collect::<Vec<_>>())
}

#[test]
fn schemes_refuse_what_they_have_no_rule_for() {
    let mixed = Control::new(&[vec![0, 1, 2, 3], vec![2, 1, 4], vec![1, 0, 5, 6, 7]]);
    let error = unsupported(&mixed, &Scheme::loop_triangles(), "face 0 has 4 sides");
    assert_eq!(error.elements(), [Element::Face(0)]);
    let averaging =
        [Scheme::doo_sabin(), Scheme::quartic(), Scheme::primal(&[Fraction::HALF]).unwrap()];
    for scheme in averaging {
        let words = "creases and sharp vertices";
        unsupported(&Control::grid(2, 2).crease([1, 4], 0.5), &scheme, words);
        unsupported(&Control::grid(2, 2).sharp(0, 0.5), &scheme, words);
        unsupported(&book(), &scheme, "not manifold");
        scheme.check(&Control::grid(2, 2).crease([0, 1], 1.0).holes(&[0]).mesh()).unwrap();
    }
    for scheme in [Scheme::catmull_clark(), Scheme::bilinear()] {
        scheme.check(&book().sharp(4, 1.0).mesh()).unwrap();
    }
    assert_eq!(
        Prediction::new(&book().mesh(), &Scheme::doo_sabin(), 1).unwrap_err().kind(),
        ErrorKind::Unsupported
    );
}

// -------------------------------------------------------------------------- no manifold

/// Two such edges in a line are a crease; their ends on the boundary are corners.
#[test]
fn edges_of_several_faces_are_sharp() {
    let rows = book().rows(&Scheme::catmull_clark());
    assert_eq!(rows.at(&[1]), &row(8, &[(0, 1), (1, 6), (2, 1)]));
    assert_eq!(rows.at(&[0]), &row(1, &[(0, 1)]));
    assert_eq!(rows.at(&[0, 1]), &mean(&[0, 1]));
    let edge = book().rows(&Scheme::catmull_clark().with_boundary(Boundary::Edge));
    assert_eq!(edge.at(&[0]), &row(1, &[(0, 1)]), "sharp without the boundary's help");
    assert_eq!(edge.at(&[4]), &row(8, &[(3, 1), (4, 6), (5, 1)]));
}

#[test]
fn vertices_of_several_fans_stay() {
    let tie = Control::new(&[[0, 1, 2], [0, 3, 4]]);
    for scheme in [Scheme::loop_triangles(), Scheme::catmull_clark()] {
        let rows = tie.rows(&scheme.with_boundary(Boundary::Edge));
        assert_eq!(rows.at(&[0]), &row(1, &[(0, 1)]));
        assert_eq!(rows.at(&[1]), &row(8, &[(0, 1), (1, 6), (2, 1)]));
    }
}

#[test]
fn levels_of_what_is_no_manifold_are_sound() {
    for (control, scheme) in [
        (book(), Scheme::catmull_clark()),
        (book(), Scheme::bilinear()),
        (book().cut(), Scheme::loop_triangles()),
    ] {
        let hierarchy = control.hierarchy(&scheme, 3);
        for level in 0..=3 {
            let mesh = hierarchy.mesh(level);
            mesh.validate().unwrap();
            assert!(!mesh.is_manifold());
            // Halves of the two edges of the spine have three sides each.
            let (spine, edges) = (2 << level, mesh.edges());
            let twice = mesh.corners() - 3 * spine + mesh.boundary_edges();
            assert_eq!(edges, spine + twice / 2, "level {level}");
            assert_eq!(mesh.boundary_edges(), 12 << level);
        }
    }
}
