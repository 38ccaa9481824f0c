//! Positions against the limits of refined vertices, and from one face to the next.

use super::{
    Poly, Shape, WIDTH, assert_near, at, bases, closed_meshes, dual_schemes, open_meshes,
    primal_schemes, quad_schemes, with_boundaries,
};
use carvel::limit::{Limits, Surface};
use carvel::{Context, Hierarchy, Mesh, Records, RecordsMut, Scheme, SplitKind};

/// A face of a refined mesh: where its corners lie in a control face.
#[derive(Clone)]
struct Piece {
    face: usize,
    sector: usize,
    corners: Vec<[f64; 2]>,
}

fn middle(points: &[[f64; 2]]) -> [f64; 2] {
    [0, 1].map(|k| points.iter().map(|p| p[k]).sum::<f64>() / points.len() as f64)
}

/// The children of a piece under a primal split, in order.
fn children(piece: &Piece) -> Vec<Piece> {
    let corners = &piece.corners;
    let n = corners.len();
    let edge = |i: usize| middle(&[corners[i % n], corners[(i + 1) % n]]);
    let with = |corners: Vec<[f64; 2]>| Piece { corners, ..piece.clone() };
    if n == 3 {
        let at = |i: usize| with(vec![corners[i], edge(i), edge(i + 2)]);
        return vec![at(0), at(1), at(2), with(vec![edge(2), edge(0), edge(1)])];
    }
    let at = |i: usize| with(vec![corners[i], edge(i), middle(corners), edge(i + n - 1)]);
    (0..n).map(at).collect()
}

/// The faces of a level of a primal scheme, in order.
fn pieces(hierarchy: &Hierarchy, surface: &Surface, level: u32) -> Vec<Piece> {
    let square = vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let triangle = vec![[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
    let triangles = hierarchy.scheme().split() == SplitKind::Triangle;
    let mut pieces = Vec::new();
    for face in 0..hierarchy.mesh(0).faces() {
        let sides = hierarchy.mesh(0).face_corners(face).len();
        if surface.sectors(face) == 1 {
            let corners = if triangles { triangle.clone() } else { square.clone() };
            pieces.extend(children(&Piece { face, sector: 0, corners }));
        } else {
            let sector = |sector: usize| Piece { face, sector, corners: square.clone() };
            pieces.extend((0..sides).map(sector));
        }
    }
    (1..level).for_each(|_| pieces = pieces.iter().flat_map(children).collect());
    pieces
}

/// Limits of the vertices of a level.
fn limits(shape: &Shape, hierarchy: &Hierarchy, level: u32) -> Vec<f64> {
    let context = Context::serial();
    let mesh = hierarchy.shared_mesh(level).unwrap();
    let mut refined = vec![0.0; WIDTH * mesh.vertices()];
    hierarchy.refine(&context, level, &shape.values, WIDTH, &mut refined).unwrap();
    let limits = Limits::<f64>::new(&context, &mesh, hierarchy.scheme()).unwrap();
    let mut limit = vec![0.0; refined.len()];
    let out = RecordsMut::packed(&mut limit, WIDTH);
    limits.position().apply(&context, Records::packed(&refined, WIDTH), out).unwrap();
    limit
}

/// The face of a corner, and its place there.
fn place(mesh: &Mesh, corner: usize) -> (usize, usize) {
    let face = (0..mesh.faces()).find(|&face| mesh.face_corners(face).contains(&corner));
    let face = face.expect("a corner of the mesh");
    (face, corner - mesh.face_corners(face).start)
}

fn check_primal(shape: &Shape, scheme: &Scheme, level: u32) {
    let surface = shape.surface(scheme);
    let context = Context::serial();
    let hierarchy = Hierarchy::new(&context, shape.mesh.clone(), scheme.clone(), level).unwrap();
    let mesh = hierarchy.shared_mesh(level).unwrap();
    let limit = limits(shape, &hierarchy, level);
    for (face, piece) in pieces(&hierarchy, &surface, level).iter().enumerate() {
        for (&v, &uv) in mesh.face_vertices(face).iter().zip(&piece.corners) {
            let found = shape.point(&surface, at(piece.face, piece.sector, uv));
            let expected = &limit[WIDTH * v as usize..][..WIDTH];
            let what = format!("{scheme:?}, face {} sector {} at {uv:?}", piece.face, piece.sector);
            assert_near(&found, expected, 1e-11, &what);
        }
    }
}

#[test]
fn primal_surfaces_meet_the_limits_of_refined_vertices() {
    for of in closed_meshes() {
        for scheme in primal_schemes() {
            check_primal(&Shape::new(&of), &scheme, 2);
        }
    }
}

#[test]
fn so_they_do_at_boundaries() {
    for of in open_meshes() {
        for scheme in primal_schemes().iter().flat_map(with_boundaries) {
            check_primal(&Shape::new(&of), &scheme, 2);
        }
    }
}

#[test]
fn so_they_do_at_creases() {
    for of in [bases::cube(), bases::torus(5, 4), bases::grid(3, 3)] {
        let uniform = Scheme::catmull_clark();
        let chaikin = uniform.clone().with_creasing(carvel::Creasing::Chaikin);
        for scheme in [uniform, chaikin] {
            check_primal(&Shape::creased(&of), &scheme, 2);
        }
    }
}

#[test]
fn triangles_do_so_as_well() {
    let scheme = Scheme::loop_triangles();
    for of in [bases::tetrahedron(), bases::octahedron(), bases::bipyramid(6), bases::bipyramid(7)]
    {
        check_primal(&Shape::new(&of), &scheme, 2);
        check_primal(&Shape::creased(&of), &scheme, 2);
    }
    for scheme in with_boundaries(&scheme) {
        check_primal(&Shape::new(&bases::triangle_grid(4, 4)), &scheme, 2);
        check_primal(&Shape::new(&bases::fan(5)), &scheme, 2);
    }
}

/// Faces of a dual step lie in the middle of their parents.
#[test]
fn dual_surfaces_meet_the_limits_inside_faces() {
    for (of, scheme) in
        closed_meshes().iter().flat_map(|of| dual_schemes().into_iter().map(move |s| (of, s)))
    {
        let shape = Shape::new(of);
        let surface = shape.surface(&scheme);
        let context = Context::serial();
        let hierarchy = Hierarchy::new(&context, shape.mesh.clone(), scheme.clone(), 2).unwrap();
        for level in 0..=2 {
            let mesh = hierarchy.shared_mesh(level).unwrap();
            let limit = limits(&shape, &hierarchy, level);
            // The child of the face of each control corner, and its corner there.
            for corner in 0..shape.mesh.corners() {
                let (face, place) = place(&shape.mesh, corner);
                let mut at_level = corner;
                for step in 0..level {
                    at_level = child_corner(&hierarchy, step, at_level);
                }
                let v = mesh.corner_vertices()[at_level] as usize;
                let inset = 1.0 - 0.5_f64.powi(level as i32);
                let sample = if surface.sectors(face) > 1 {
                    at(face, place, [inset, inset])
                } else {
                    let near = inset / 2.0;
                    let uv = [
                        [near, near],
                        [1.0 - near, near],
                        [1.0 - near, 1.0 - near],
                        [near, 1.0 - near],
                    ];
                    at(face, 0, uv[place])
                };
                let found = shape.point(&surface, sample);
                let what = format!("{scheme:?}, level {level}, {sample:?}");
                assert_near(&found, &limit[WIDTH * v..][..WIDTH], 1e-11, &what);
            }
        }
    }
}

/// The corner that a dual step makes of a corner, in the child of its face.
fn child_corner(hierarchy: &Hierarchy, level: u32, corner: usize) -> usize {
    use carvel::refine::FaceOrigin;
    let [parent, child] = [hierarchy.mesh(level), hierarchy.mesh(level + 1)];
    let (face, _) = place(parent, corner);
    let origins = hierarchy.face_origins(level + 1).unwrap();
    let image = origins.iter().position(|&o| o == FaceOrigin::Face(face as u32)).unwrap();
    child.face_corners(image).find(|&c| child.corner_vertices()[c] as usize == corner).unwrap()
}

/// Both sides of every edge, and of every border between sectors.
#[test]
fn surfaces_are_continuous() {
    let check = |of: &Poly<f64>, scheme: &Scheme| {
        let shape = Shape::new(of);
        let surface = shape.surface(scheme);
        let (vert, twin) = (shape.mesh.corner_vertices(), shape.mesh.corner_twins());
        // A point on a corner's edge.
        let on_edge = |corner: usize, t: f64| {
            let (face, place) = place(&shape.mesh, corner);
            let sides = shape.mesh.face_corners(face).len();
            match (surface.sectors(face), sides) {
                (1, 3) => at(face, 0, [[t, 0.0], [1.0 - t, t], [0.0, 1.0 - t]][place]),
                (1, _) => at(face, 0, [[t, 0.0], [1.0, t], [1.0 - t, 1.0], [0.0, 1.0 - t]][place]),
                (n, _) if t > 0.5 => at(face, (place + 1) % n, [0.0, 2.0 - 2.0 * t]),
                _ => at(face, place, [2.0 * t, 0.0]),
            }
        };
        for corner in (0..vert.len()).filter(|&c| twin[c] != u32::MAX) {
            for t in [0.0, 0.3, 0.5, 0.8125, 1.0] {
                let here = shape.point(&surface, on_edge(corner, t));
                let there = shape.point(&surface, on_edge(twin[corner] as usize, 1.0 - t));
                assert_near(&here, &there, 1e-11, &format!("{scheme:?}, corner {corner} at {t}"));
            }
        }
        for face in (0..shape.mesh.faces()).filter(|&f| surface.sectors(f) > 1) {
            let n = surface.sectors(face);
            for (sector, t) in (0..n).flat_map(|s| [0.0, 0.4, 0.75, 1.0].map(|t| (s, t))) {
                let here = shape.point(&surface, at(face, sector, [1.0, t]));
                let there = shape.point(&surface, at(face, (sector + 1) % n, [t, 1.0]));
                assert_near(&here, &there, 1e-11, &format!("{scheme:?}, face {face} at {t}"));
            }
        }
    };
    for of in closed_meshes() {
        for scheme in quad_schemes() {
            check(&of, &scheme);
        }
    }
    check(&bases::bipyramid(5), &Scheme::loop_triangles());
}
