//! The children of a split: their numbers, how many there are, and the same by one thread
//! and by two.

use carvel::refine::{Counts, FaceOrigin, VertexOrigin};
use carvel::{
    Boundary, Context, ErrorKind, Fraction, Hierarchy, Mesh, Prediction, Refiner, Scheme, Task,
};

use crate::control::Control;

fn faces(mesh: &Mesh) -> Vec<Vec<u32>> {
    (0..mesh.faces()).map(|f| mesh.face_vertices(f).to_vec()).collect()
}

#[test]
fn quads_of_all_corners_in_order() {
    let control = Control::new(&[vec![0, 1, 2, 3], vec![1, 4, 2]]);
    let hierarchy = control.hierarchy(&Scheme::catmull_clark(), 1);
    // The triangle comes first; edges 1-4, 4-2, 2-1, 0-1, 2-3, 3-0 are 5 to 10.
    let expected = [
        [1, 5, 11, 7],
        [4, 6, 11, 5],
        [2, 7, 11, 6],
        [0, 8, 12, 10],
        [1, 7, 12, 8],
        [2, 9, 12, 7],
        [3, 10, 12, 9],
    ];
    assert_eq!(faces(hierarchy.mesh(1)), expected);
    let origins = hierarchy.vertex_origins(1).unwrap();
    let edges = [0, 1, 2, 3, 5, 6].map(VertexOrigin::Edge);
    let (old, middles) = ((0..5).map(VertexOrigin::Vertex), (0..2).map(VertexOrigin::Face));
    assert_eq!(origins, old.chain(edges).chain(middles).collect::<Vec<_>>());
    let corners: Vec<_> = (0..7).map(FaceOrigin::Corner).collect();
    assert_eq!(hierarchy.face_origins(1).unwrap(), corners);
}

#[test]
fn four_triangles_of_each_in_order() {
    let control = Control::new(&[[0, 1, 2], [2, 1, 3]]);
    let hierarchy = control.hierarchy(&Scheme::loop_triangles(), 1);
    let expected =
        [[0, 4, 6], [1, 5, 4], [2, 6, 5], [6, 4, 5], [2, 5, 8], [1, 7, 5], [3, 8, 7], [8, 5, 7]];
    assert_eq!(faces(hierarchy.mesh(1)), expected);
    let edges = [0, 1, 2, 4, 5].map(VertexOrigin::Edge);
    let all: Vec<_> = (0..4).map(VertexOrigin::Vertex).chain(edges).collect();
    assert_eq!(hierarchy.vertex_origins(1).unwrap(), all);
    let corner = FaceOrigin::Corner;
    let middle = FaceOrigin::Face;
    let origins =
        [corner(0), corner(1), corner(2), middle(0), corner(3), corner(4), corner(5), middle(1)];
    assert_eq!(hierarchy.face_origins(1).unwrap(), origins);
}

fn controls() -> Vec<(Control, Scheme)> {
    let mixed = Control::new(&[
        vec![0, 1, 2, 3, 4],
        vec![1, 0, 5, 6],
        vec![2, 1, 6],
        vec![3, 2, 6, 7],
        vec![4, 3, 7, 8],
    ]);
    let pages = |i: u32| [[0, 1, 4 + 3 * i, 3 + 3 * i], [1, 2, 5 + 3 * i, 4 + 3 * i]];
    let book = Control::new(&(0..3).flat_map(pages).collect::<Vec<_>>());
    vec![
        (mixed.clone(), Scheme::catmull_clark()),
        (mixed, Scheme::b_spline(5).unwrap()),
        (Control { vertices: 30, ..Control::grid(4, 4) }, Scheme::bilinear()),
        (Control::torus(5, 7), Scheme::catmull_clark()),
        (Control::torus(5, 7).cut(), Scheme::loop_triangles()),
        (Control::grid(5, 3).cut(), Scheme::loop_triangles()),
        (Control::bipyramid(9), Scheme::catmull_clark()),
        (book.clone(), Scheme::catmull_clark()),
        (book.cut(), Scheme::loop_triangles()),
        (Control::grid(4, 4).crease([12, 13], 1.5).sharp(6, 2.5), Scheme::catmull_clark()),
    ]
}

#[test]
fn levels_are_as_large_as_predicted() {
    for (control, scheme) in controls() {
        let hierarchy = control.hierarchy(&scheme, 3);
        let plan = Prediction::new(hierarchy.mesh(0), &scheme, 3).unwrap();
        for level in 0..=3 {
            let (mesh, counts) = (hierarchy.mesh(level), plan.counts(level));
            mesh.validate().unwrap();
            let found = [
                mesh.vertices(),
                mesh.faces(),
                mesh.corners(),
                mesh.edges(),
                mesh.boundary_edges(),
                mesh.irregular_faces(),
            ];
            let expected = [
                counts.vertices,
                counts.faces,
                counts.corners,
                counts.edges,
                counts.boundary_edges,
                counts.irregular_faces,
            ];
            assert_eq!(found.map(|n| n as u64), expected, "{control:?}, level {level}");
            assert!(level == 0 || counts.irregular_corners == 0);
        }
    }
}

/// Meshes for corner splits, each under every boundary rule.
fn corner_splits() -> Vec<(Control, Scheme)> {
    let valence_two = Control::new(&[[0, 1, 2, 3], [3, 2, 1, 0]]);
    let mut controls: Vec<Control> = controls().into_iter().map(|(control, _)| control).collect();
    controls.retain(|control| control.mesh().is_manifold() && control.creases.is_empty());
    controls.extend([valence_two, Control::bipyramid(3), Control::grid(1, 1)]);
    let modes = [Boundary::None, Boundary::Edge, Boundary::EdgeAndCorner];
    let with = |control: Control| {
        modes.map(|mode| (control.clone(), Scheme::doo_sabin().with_boundary(mode)))
    };
    controls.into_iter().flat_map(with).collect()
}

/// The counts of corner splits stand beside those of primal ones.
#[test]
fn corner_splits_are_as_large_as_predicted() {
    for (control, scheme) in corner_splits() {
        let hierarchy = control.hierarchy(&scheme, 3);
        let plan = Prediction::new(hierarchy.mesh(0), &scheme, 3).unwrap();
        for level in 0..=3 {
            let (mesh, counts) = (hierarchy.mesh(level), plan.counts(level));
            let irregular = mesh.face_sizes().take(mesh.irregular_faces()).sum::<u32>();
            let found = [mesh.vertices(), mesh.faces(), mesh.corners(), mesh.edges()];
            let expected = [counts.vertices, counts.faces, counts.corners, counts.edges];
            let what = format!("{control:?}, {:?}, level {level}", scheme.boundary());
            assert_eq!(found.map(|n| n as u64), expected, "{what}");
            assert_eq!(mesh.boundary_edges() as u64, counts.boundary_edges, "{what}");
            assert_eq!(mesh.irregular_faces() as u64, counts.irregular_faces, "{what}");
            assert_eq!(u64::from(irregular), counts.irregular_corners, "{what}");
        }
    }
}

/// 24·4^29 corners fit 64 bits, four times as many do not.
#[test]
fn counts_end_where_64_bits_do() {
    let mesh = Control::grid(2, 3).mesh();
    for scheme in [Scheme::catmull_clark(), Scheme::bilinear()] {
        Prediction::new(&mesh, &scheme, 29).unwrap();
        let error = Prediction::new(&mesh, &scheme, 30).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::TooLarge);
        assert!(error.to_string().starts_with("level 30"), "{error}");
    }
    let triangles = Control::bipyramid(4).mesh();
    Prediction::new(&triangles, &Scheme::loop_triangles(), 29).unwrap();
    assert!(Prediction::new(&triangles, &Scheme::loop_triangles(), 30).is_err());
}

/// Corners are what there is most of: 24·4^13 have numbers, four times as many have not.
#[test]
fn corners_alone_may_be_too_many() {
    let plan = Prediction::new(&Control::grid(2, 3).mesh(), &Scheme::catmull_clark(), 14).unwrap();
    plan.counts(13).check_index_type().unwrap();
    assert!(plan.counts(14).vertices < u64::from(u32::MAX));
    assert_eq!(plan.counts(14).check_index_type().unwrap_err().kind(), ErrorKind::TooLarge);
}

/// By chunks of one piece and by chunks of several: what is counted within a chunk starts
/// anew in each.
#[test]
fn two_threads_build_and_refine_the_same() {
    let two = |chunk| Context::builder().threads(2).chunk(chunk).build().expect("two threads");
    let (serial, threads) = (Context::serial(), [1, 3].map(two));
    for (control, scheme) in controls().into_iter().chain(corner_splits()) {
        let made = |context| Hierarchy::new(context, control.mesh(), scheme.clone(), 2).unwrap();
        let values: Vec<f64> = (0..3 * control.vertices).map(|i| (i * i % 17) as f64).collect();
        let refined = |hierarchy: &Hierarchy, context, level| {
            let mut out = vec![0.0; 3 * hierarchy.mesh(level).vertices()];
            hierarchy.refine(context, level, &values, 3, &mut out).unwrap();
            out
        };
        let one = made(&serial);
        for context in &threads {
            let two = made(context);
            for level in 0..=2 {
                assert_eq!(one.mesh(level), two.mesh(level), "{control:?}, level {level}");
                assert_eq!(refined(&one, &serial, level), refined(&two, context, level));
            }
        }
    }
}

#[test]
fn one_shot_refinement_tells_the_sizes_of_faces() {
    for (faces, scheme, size) in [
        (vec![vec![0, 1, 2, 3], vec![1, 4, 2]], Scheme::catmull_clark(), 4),
        (vec![vec![0, 1, 2], vec![2, 1, 3]], Scheme::loop_triangles(), 3),
    ] {
        let mesh = Control::new(&faces).mesh();
        let positions = vec![0.0; 3 * mesh.vertices()];
        let task = Task::new(&mesh, &scheme, 1, &positions);
        let refined = Refiner::new().refine(&Context::serial(), &task).unwrap();
        let children = refined.face_vertices.len() / size;
        assert_eq!(refined.face_sizes, vec![size as u32; children]);
    }
}

#[test]
fn numbers_are_used_up_to_the_last() {
    let mesh = Control::new(&[[0, 1, 2], [2, 1, 3]]).mesh();
    let small = Counts::of(&mesh);
    let limit = u64::from(u32::MAX);
    for set in [
        |counts: &mut Counts, n| counts.vertices = n,
        |counts: &mut Counts, n| counts.corners = n,
        |counts: &mut Counts, n| counts.edges = n,
    ] {
        let mut counts = small;
        set(&mut counts, limit - 1);
        counts.check_index_type().unwrap();
        set(&mut counts, limit);
        assert_eq!(counts.check_index_type().unwrap_err().kind(), ErrorKind::TooLarge);
    }
}

#[test]
fn the_paper_has_one_pass() {
    let scheme = Scheme::three_point(Fraction::new(1, 32).unwrap()).unwrap();
    assert_eq!(scheme.passes(), [Fraction::new(1, 2).unwrap()]);
}

/// A torus of 256 quads is refined patch by patch, but not with a crease, and a grid as
/// large is not either: patches know no rule of a crease or of a boundary.
#[test]
fn patches_are_for_closed_meshes_without_creases() {
    let (scheme, context) = (Scheme::catmull_clark(), Context::serial());
    let torus = Control::torus(16, 16);
    for (control, depth) in
        [(torus.clone(), 2), (torus.crease([0, 1], 1.5), 0), (Control::grid(16, 16), 0)]
    {
        let mesh = control.mesh();
        assert_eq!(Prediction::new(&mesh, &scheme, 2).unwrap().patch_depth(), depth);
        let positions: Vec<f64> = (0..3 * control.vertices).map(|i| (i * i % 17) as f64).collect();
        let task = Task::new(&mesh, &scheme, 2, &positions);
        let refined = Refiner::new().refine(&context, &task).unwrap();
        let hierarchy = control.hierarchy(&scheme, 2);
        let mut expected = vec![0.0; refined.positions.len()];
        hierarchy.refine(&context, 2, &positions, 3, &mut expected).unwrap();
        assert_eq!(refined.positions, expected);
        assert_eq!(refined.face_vertices, hierarchy.mesh(2).corner_vertices());
    }
}
