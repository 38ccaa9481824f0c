//! Creases after refinement: what is tracked is what the meshes of a hierarchy have.

use carvel::hierarchy::creases_left;
use carvel::mesh::{BuildOptions, build};
use carvel::scheme::Creasing;
use carvel::{Context, Crease, ErrorKind, Hierarchy, Mesh, Refiner, Scheme, Task};

/// Sharpness of every kind, in no order.
const SHARPNESS: [f32; 9] = [0.3, 10.0, 1.0, 2.5, 0.0, 3.7, 1.25, 4.0, 2.0];

/// A torus of quads, or of triangles, with creases along most of its edges.
fn torus(triangles: bool) -> Mesh {
    let at = |i: u32, j: u32| 4 * (i % 5) + j % 4;
    let mut faces = Vec::new();
    for (i, j) in (0..5).flat_map(|i| (0..4).map(move |j| (i, j))) {
        let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
        faces.extend(if triangles { vec![a, b, c, a, c, d] } else { vec![a, b, c, d] });
    }
    let sizes = if triangles { vec![3; 40] } else { vec![4; 20] };
    let plain = Mesh::from_polygons(20, &sizes, &faces).unwrap();
    let edges = plain.edge_vertices().zip(SHARPNESS.iter().cycle());
    let creases: Vec<Crease> =
        edges.map(|(vertices, &sharpness)| Crease { vertices, sharpness }).collect();
    let options = BuildOptions { creases: &creases, ..BuildOptions::default() };
    build(&Context::serial(), 20, &sizes, &faces, &options).unwrap().mesh
}

/// The last edge of an open fan is no crease, and no neighbour of one.
#[test]
fn creases_that_reach_a_boundary_are_tracked() {
    let faces = [0, 1, 5, 4, 1, 2, 6, 5, 2, 3, 7, 6];
    let creases =
        [Crease { vertices: [1, 5], sharpness: 2.0 }, Crease { vertices: [2, 6], sharpness: 3.0 }];
    let options = BuildOptions { creases: &creases, ..BuildOptions::default() };
    let strip = build(&Context::serial(), 8, &[4; 3], &faces, &options).unwrap().mesh;
    let scheme = Scheme::catmull_clark().with_creasing(Creasing::Chaikin);
    let hierarchy = Hierarchy::new(&Context::serial(), strip.clone(), scheme.clone(), 2).unwrap();
    for level in 0..=2 {
        let faces = refined_faces(&strip, &scheme, level);
        let left = creases_left(&strip, &scheme, level, &faces).unwrap();
        assert_eq!(sorted(left), sorted(hierarchy.mesh(level).creases()), "level {level}");
    }
}

/// Edges with both ends in order, ascending, and the bits of their sharpness.
fn sorted(creases: impl IntoIterator<Item = Crease>) -> Vec<([u32; 2], u32)> {
    let tag = |crease: Crease| {
        let [a, b] = crease.vertices;
        ([a.min(b), a.max(b)], crease.sharpness.to_bits())
    };
    let mut tags: Vec<_> = creases.into_iter().map(tag).collect();
    tags.sort_unstable();
    tags
}

fn refined_faces(mesh: &Mesh, scheme: &Scheme, levels: u32) -> Vec<u32> {
    let positions = vec![0.0; 3 * mesh.vertices()];
    let task = Task::new(mesh, scheme, levels, &positions);
    Refiner::new().refine(&Context::serial(), &task).unwrap().face_vertices
}

#[test]
fn tracked_creases_are_those_of_the_meshes() {
    for (scheme, triangles) in [
        (Scheme::catmull_clark(), false),
        (Scheme::catmull_clark(), true),
        (Scheme::bilinear(), false),
        (Scheme::loop_triangles(), true),
    ] {
        let mesh = torus(triangles);
        for creasing in [Creasing::Uniform, Creasing::Chaikin] {
            let scheme = scheme.clone().with_creasing(creasing);
            let hierarchy =
                Hierarchy::new(&Context::serial(), mesh.clone(), scheme.clone(), 5).unwrap();
            for level in 0..=5 {
                let faces = refined_faces(&mesh, &scheme, level);
                let left = creases_left(&mesh, &scheme, level, &faces).unwrap();
                let there = sorted(hierarchy.mesh(level).creases());
                assert!(!there.is_empty());
                assert_eq!(sorted(left), there, "{scheme:?} level {level}");
            }
        }
    }
}

#[test]
fn creases_of_other_levels_and_splits_are_refused() {
    let (mesh, scheme) = (torus(false), Scheme::catmull_clark());
    let faces = refined_faces(&mesh, &scheme, 1);
    let kind =
        |scheme: &Scheme, levels| creases_left(&mesh, scheme, levels, &faces).unwrap_err().kind();
    assert_eq!(kind(&scheme, 2), ErrorKind::LengthMismatch);
    assert_eq!(kind(&Scheme::doo_sabin(), 1), ErrorKind::Unsupported);
}
