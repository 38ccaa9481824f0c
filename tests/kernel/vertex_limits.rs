//! Limits of vertices against deep refinement, and against themselves one level on.

use super::support::poly::Poly;
use super::support::{bases, kernel};
use carvel::hierarchy::Hierarchy;
use carvel::limit::Limits;
use carvel::mesh::BuildOptions;
use carvel::{Boundary, Context, CornerRule, Crease, ErrorKind, Fraction, Mesh, Scheme};
use carvel::{Records, RecordsMut, SharpVertex};
use std::sync::Arc;

fn xyz(of: &Poly<f64>) -> Vec<f64> {
    kernel::coordinates(of)
}

/// Limit positions and both tangents of a mesh's vertices, xyz each.
fn limits(mesh: &Arc<Mesh>, scheme: &Scheme, positions: &[f64]) -> [Vec<f64>; 3] {
    let limits = Limits::<f64>::new(&Context::serial(), mesh, scheme).unwrap();
    let [first, second] = limits.tangents();
    [limits.position(), first, second].map(|table| {
        let mut out = vec![0.0; positions.len()];
        let records = Records::packed(positions, 3);
        table.apply(&Context::serial(), records, RecordsMut::packed(&mut out, 3)).unwrap();
        out
    })
}

fn at(list: &[f64], v: usize) -> [f64; 3] {
    [0, 1, 2].map(|k| list[3 * v + k])
}

fn apart(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter().zip(b).fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()))
}

fn refined(hierarchy: &Hierarchy, level: u32, positions: &[f64]) -> Vec<f64> {
    kernel::refine_values(hierarchy, level, positions, 3)
}

/// Any mesh with sharp edges of all kinds: every third edge, by turns 1.5, 0.7 and for ever.
fn creased(of: &Poly<f64>) -> Mesh {
    let plain = kernel::mesh(of);
    let sharpness = [1.5, 0.7, 10.0];
    let edges: Vec<[u32; 2]> = plain.edge_vertices().collect();
    let creases: Vec<Crease> = edges
        .iter()
        .step_by(3)
        .zip(sharpness.into_iter().cycle())
        .map(|(&vertices, sharpness)| Crease { vertices, sharpness })
        .collect();
    let sharp_vertices = [SharpVertex { vertex: 1, sharpness: 1.3 }];
    let options =
        BuildOptions { creases: &creases, sharp_vertices: &sharp_vertices, ..Default::default() };
    kernel::Soup::new(of.positions.len(), &of.faces).build(&options).unwrap().mesh
}

fn quad_meshes() -> Vec<Poly<f64>> {
    vec![
        bases::cube(),
        bases::prism(5),
        bases::pyramid(6),
        bases::dodecahedron(),
        bases::grid(4, 3),
        bases::half_fan(3),
        bases::frame(),
        bases::torus(3, 4),
    ]
}

fn triangle_meshes() -> Vec<Poly<f64>> {
    vec![bases::tetrahedron(), bases::octahedron(), bases::bipyramid(7), bases::triangle_grid(3, 4)]
}

/// The limit of a vertex that stays is the same from one level on.
fn assert_stays(scheme: &Scheme, mesh: Mesh, positions: &[f64]) {
    let count = mesh.vertices();
    let hierarchy = Hierarchy::new(&Context::serial(), mesh, scheme.clone(), 1).unwrap();
    let [here, ..] = limits(&hierarchy.shared_mesh(0).unwrap(), scheme, positions);
    let next = refined(&hierarchy, 1, positions);
    let [there, ..] = limits(&hierarchy.shared_mesh(1).unwrap(), scheme, &next);
    for v in 0..count {
        let off = apart(at(&here, v), at(&there, v));
        assert!(off < 1e-12, "{scheme:?}: vertex {v} of {count} is {off} off");
    }
}

#[test]
fn primal_limits_do_not_depend_on_the_level() {
    let schemes = [
        Scheme::catmull_clark(),
        Scheme::catmull_clark().with_boundary(Boundary::Edge),
        Scheme::catmull_clark().with_boundary(Boundary::None),
        Scheme::bilinear(),
        Scheme::primal(&[Fraction::new(0, 1).unwrap()]).unwrap(),
        Scheme::primal(&[Fraction::new(0, 1).unwrap(), Fraction::new(0, 1).unwrap()]).unwrap(),
    ];
    for scheme in &schemes {
        for mesh in quad_meshes() {
            assert_stays(scheme, kernel::mesh(&mesh), &xyz(&mesh));
        }
    }
    for scheme in [Scheme::loop_triangles(), Scheme::loop_triangles().with_boundary(Boundary::Edge)]
    {
        for mesh in triangle_meshes() {
            assert_stays(&scheme, kernel::mesh(&mesh), &xyz(&mesh));
        }
    }
}

#[test]
fn limits_on_creases_do_not_depend_on_the_level() {
    for mesh in quad_meshes() {
        assert_stays(&Scheme::catmull_clark(), creased(&mesh), &xyz(&mesh));
    }
    for mesh in triangle_meshes() {
        assert_stays(&Scheme::loop_triangles(), creased(&mesh), &xyz(&mesh));
    }
}

fn tagged(of: &Poly<f64>, creases: &[Crease], sharp_vertices: &[SharpVertex]) -> Mesh {
    let options = BuildOptions { creases, sharp_vertices, ..Default::default() };
    kernel::Soup::new(of.positions.len(), &of.faces).build(&options).unwrap().mesh
}

/// All edges of one face sharp for ever: at each of its vertices one side is that face alone.
#[test]
fn creases_around_a_face() {
    let of = bases::cube();
    let face = &of.faces[0];
    let edge =
        |i: usize| Crease { vertices: [face[i] as u32, face[(i + 1) % 4] as u32], sharpness: 10.0 };
    let creases: Vec<Crease> = (0..4).map(edge).collect();
    assert_stays(&Scheme::catmull_clark(), tagged(&of, &creases, &[]), &xyz(&of));
}

/// Parts of the mesh that touch themselves, and creases whose ends are in them but not they.
#[test]
fn sharp_vertices_apart() {
    let sharp = |vertex| SharpVertex { vertex, sharpness: 2.5 };
    let of = bases::grid(20, 20);
    let mesh = tagged(&of, &[], &[sharp(21 * 5 + 5), sharp(21 * 8 + 8)]);
    assert_stays(&Scheme::catmull_clark(), mesh, &xyz(&of));
    let of = bases::torus(7, 7);
    let plain = kernel::mesh(&of);
    let near = |v: u32, far: &[u32]| {
        let beside = |e: &[u32; 2]| e.contains(&v);
        let others = plain.edge_vertices().filter(beside).map(|[a, b]| a + b - v);
        others.filter(|w| !far.contains(w)).collect::<Vec<u32>>()
    };
    let mut rings = vec![vec![0]];
    for _ in 0..3 {
        let known: Vec<u32> = rings.concat();
        let mut next: Vec<u32> = known.iter().flat_map(|&v| near(v, &known)).collect();
        next.sort_unstable();
        next.dedup();
        rings.push(next);
    }
    for vertices in plain.edge_vertices().filter(|ends| ends.iter().all(|v| rings[3].contains(v))) {
        let crease = Crease { vertices, sharpness: 10.0 };
        let mesh = tagged(&of, &[crease], &[SharpVertex { vertex: 0, sharpness: 1.5 }]);
        assert_stays(&Scheme::catmull_clark(), mesh, &xyz(&of));
    }
}

/// Many passes ask for many rings.
#[test]
fn limits_after_many_passes() {
    let of = bases::grid(6, 6);
    let passes = [Fraction::new(0, 1).unwrap(); 4];
    assert_stays(&Scheme::primal(&passes).unwrap(), kernel::mesh(&of), &xyz(&of));
}

/// How far the limits are from the vertices, or the middles of the faces in their places,
/// after each of some levels.
fn distances(scheme: &Scheme, of: &Poly<f64>, levels: u32) -> Vec<f64> {
    let positions = xyz(of);
    let mesh = kernel::mesh(of);
    let hierarchy = Hierarchy::new(&Context::serial(), mesh, scheme.clone(), levels).unwrap();
    let [limit, ..] = limits(&hierarchy.shared_mesh(0).unwrap(), scheme, &positions);
    let dual = scheme.split() == carvel::SplitKind::Corner;
    let mut faces: Vec<Option<u32>> = Vec::new();
    let mut all = Vec::new();
    for level in 1..=levels {
        let values = refined(&hierarchy, level, &positions);
        let fine = hierarchy.mesh(level);
        if dual {
            use carvel::refine::FaceOrigin;
            let origins = hierarchy.face_origins(level).unwrap();
            let find = |wanted: FaceOrigin| origins.iter().position(|&o| o == wanted);
            faces = match level {
                1 => (0..positions.len() as u32 / 3)
                    .map(|v| find(FaceOrigin::Vertex(v)).map(|f| f as u32))
                    .collect(),
                _ => faces
                    .iter()
                    .map(|f| f.and_then(|f| find(FaceOrigin::Face(f))).map(|f| f as u32))
                    .collect(),
            };
        }
        let middle = |v: usize| {
            if !dual {
                return Some(at(&values, v));
            }
            let corners = fine.face_vertices(faces[v]? as usize);
            let sum = |k: usize| corners.iter().map(|&c| values[3 * c as usize + k]).sum::<f64>();
            Some([0, 1, 2].map(|k| sum(k) / corners.len() as f64))
        };
        let off = (0..positions.len() / 3).filter_map(|v| Some(apart(middle(v)?, at(&limit, v))));
        all.push(off.fold(0.0, f64::max));
    }
    all
}

fn three_point() -> Scheme {
    Scheme::three_point(Fraction::new(1, 32).unwrap()).unwrap()
}

#[test]
fn refinement_goes_to_the_limits() {
    let quartic = Scheme::three_point(Fraction::new(1, 16).unwrap()).unwrap();
    let schemes = [
        three_point(),
        three_point().with_rule(CornerRule::Average),
        three_point().with_boundary(Boundary::Edge),
        crate::tuned::tuned(),
        quartic,
        Scheme::doo_sabin(),
        Scheme::catmull_clark(),
    ];
    for scheme in &schemes {
        for mesh in quad_meshes() {
            let off = distances(scheme, &mesh, 5);
            // The mean of a face's corners errs by a factor λ or μ per level; beside the wrong
            // limit the distance would settle.
            let (last, before) = (off[4], off[3]);
            assert!(last < 0.75 * before || last < 1e-13, "{scheme:?}: {off:?}");
        }
    }
}

/// Limits on a level are those on the level after: of anchored vertices on the boundary, which
/// have no faces in their places, by the curve that the boundary is.
#[test]
fn limits_on_anchored_meshes() {
    for scheme in [three_point(), Scheme::doo_sabin(), three_point().with_boundary(Boundary::Edge)]
    {
        for of in [bases::grid(3, 2), bases::half_fan(4), bases::frame(), bases::pyramid(5)] {
            let positions = xyz(&of);
            let levels = Hierarchy::new(&Context::serial(), kernel::mesh(&of), scheme.clone(), 5);
            let levels = levels.unwrap();
            let first = refined(&levels, 1, &positions);
            let mesh = levels.shared_mesh(1).unwrap();
            let [limit, ..] = limits(&mesh, &scheme, &first);
            let deep = refined(&levels, 5, &positions);
            for v in 0..first.len() / 3 {
                let to = |p: [f64; 3]| apart(at(&limit, v), p);
                let near = (0..deep.len() / 3).map(|w| to(at(&deep, w))).fold(f64::MAX, f64::min);
                let far = to(at(&first, v));
                assert!(near < 0.04, "{scheme:?}: vertex {v}: {near}");
                if mesh.is_boundary_vertex(v) && mesh.valence(v) == 1 {
                    assert!(far < 1e-14, "{scheme:?}: corner {v}");
                }
            }
        }
    }
}

#[test]
fn closed_forms_of_the_field() {
    let of = bases::torus(6, 6);
    let mesh = Arc::new(kernel::mesh(&of));
    let weights = |scheme: &Scheme| {
        let limits = Limits::<f64>::new(&Context::serial(), &mesh, scheme).unwrap();
        let mut weights = limits.position().row(7).1.to_vec();
        weights.sort_by(f64::total_cmp);
        weights
    };
    let tensor = |factors: &[f64]| {
        let mut all: Vec<f64> =
            factors.iter().flat_map(|a| factors.iter().map(move |b| a * b)).collect();
        all.sort_by(f64::total_cmp);
        all
    };
    let close = |found: Vec<f64>, wanted: Vec<f64>| {
        assert_eq!(found.len(), wanted.len(), "{found:?}");
        found.iter().zip(wanted).for_each(|(f, w)| assert!((f - w).abs() < 1e-14, "{f} {w}"));
    };
    close(weights(&Scheme::catmull_clark()), tensor(&[1.0, 4.0, 1.0].map(|w| w / 6.0)));
    close(weights(&Scheme::doo_sabin()), tensor(&[1.0, 6.0, 1.0].map(|w| w / 8.0)));
    let paper = [1.0, 252.0, 1030.0, 252.0, 1.0].map(|w| w / 1536.0);
    close(weights(&three_point()), tensor(&paper));
    let quartic = Scheme::three_point(Fraction::new(1, 16).unwrap()).unwrap();
    close(weights(&quartic), tensor(&[1.0, 76.0, 230.0, 76.0, 1.0].map(|w| w / 384.0)));
}

/// Along the boundary a dual surface is the curve of the boundary polygon.
#[test]
fn the_boundary_is_a_curve() {
    let levels =
        Hierarchy::new(&Context::serial(), kernel::mesh(&bases::grid(6, 6)), three_point(), 1);
    let mesh = levels.unwrap().shared_mesh(1).unwrap();
    let limits = Limits::<f64>::new(&Context::serial(), &mesh, &three_point()).unwrap();
    let curve = [1.0, 1.0, 252.0, 252.0, 1030.0].map(|w| w / 1536.0);
    let boundary = |v: &usize| mesh.is_boundary_vertex(*v) && mesh.valence(*v) == 2;
    let regular = (0..mesh.vertices()).filter(boundary).filter(|&v| {
        let (vertices, weights) = limits.position().row(v);
        assert!(vertices.iter().all(|&w| mesh.is_boundary_vertex(w as usize)));
        let mut weights = weights.to_vec();
        weights.sort_by(f64::total_cmp);
        weights.len() == 5 && weights.iter().zip(curve).all(|(a, b)| (a - b).abs() < 1e-14)
    });
    // Each side has twelve such vertices; beside the corners the polygon is continued.
    assert_eq!(regular.count(), 4 * (12 - 4));
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[test]
fn normals_point_out_of_round_meshes() {
    let bilinear = Scheme::bilinear();
    let schemes = [three_point(), Scheme::doo_sabin(), Scheme::catmull_clark(), bilinear];
    for scheme in &schemes {
        for of in [bases::cube(), bases::prism(7), bases::pyramid(5), bases::dodecahedron()] {
            let (mesh, positions) = (Arc::new(kernel::mesh(&of)), xyz(&of));
            let limits = Limits::<f64>::new(&Context::serial(), &mesh, scheme).unwrap();
            let mut normals = vec![0.0; positions.len()];
            limits.normals(&Context::serial(), &positions, &mut normals).unwrap();
            let count = positions.len() / 3;
            let mean = |k: usize| (0..count).map(|v| positions[3 * v + k]).sum::<f64>();
            let middle = [0, 1, 2].map(|k| mean(k) / count as f64);
            for v in 0..count {
                let (n, p) = (at(&normals, v), at(&positions, v));
                assert!((dot(n, n) - 1.0).abs() < 1e-14);
                let out = [0, 1, 2].map(|k| p[k] - middle[k]);
                assert!(dot(n, out) > 0.0, "{scheme:?}: {n:?} at {p:?}");
            }
        }
    }
}

/// A plane's normal, everywhere, on its boundary and beside a collapsed face too.
#[test]
fn normals_of_a_plane() {
    let mut of = bases::grid(5, 5);
    of.positions.iter_mut().for_each(|p| p[2] = 0.0);
    let collapsed = of.positions[7];
    for &v in &of.faces[9].clone() {
        of.positions[v] = collapsed;
    }
    let (mesh, positions) = (Arc::new(kernel::mesh(&of)), xyz(&of));
    for scheme in [three_point(), Scheme::catmull_clark(), Scheme::doo_sabin()] {
        let limits = Limits::<f64>::new(&Context::serial(), &mesh, &scheme).unwrap();
        let mut normals = vec![0.0; positions.len()];
        limits.normals(&Context::serial(), &positions, &mut normals).unwrap();
        for v in 0..positions.len() / 3 {
            let n = at(&normals, v);
            let none = n.iter().all(|x| x.abs() < f64::MIN_POSITIVE);
            assert!(n[2].abs() > 0.999 || none, "{scheme:?} vertex {v}: {n:?}");
        }
    }
}

/// A corner that goes round three quarters of a turn shows the same side as all others.
#[test]
fn normals_at_a_reflex_corner() {
    let mut of = bases::grid(2, 2);
    of.positions.iter_mut().for_each(|p| p[2] = 0.0);
    of.faces.pop();
    let inner = (0..9).find(|v| of.faces.iter().filter(|f| f.contains(v)).count() == 3).unwrap();
    let used: Vec<usize> = (0..9).filter(|v| of.faces.iter().any(|f| f.contains(v))).collect();
    let mesh = tagged(&of, &[], &[SharpVertex { vertex: inner as u32, sharpness: 10.0 }]);
    let (mesh, positions) = (Arc::new(mesh), xyz(&of));
    let limits = Limits::<f64>::new(&Context::serial(), &mesh, &Scheme::catmull_clark()).unwrap();
    let mut normals = vec![0.0; positions.len()];
    limits.normals(&Context::serial(), &positions, &mut normals).unwrap();
    let side = normals[3 * inner + 2];
    assert!(side.abs() > 0.999);
    for v in used {
        assert!(normals[3 * v + 2] * side > 0.999, "{v}");
    }
}

/// Where all points are one there is no normal, wherever that point is.
#[test]
fn collapsed_neighbourhoods_have_no_normal() {
    let mut of = bases::grid(6, 6);
    of.positions.iter_mut().for_each(|p| *p = [3.1, 0.7, 0.3]);
    let (mesh, positions) = (Arc::new(kernel::mesh(&of)), xyz(&of));
    for scheme in [three_point(), Scheme::catmull_clark()] {
        let limits = Limits::<f64>::new(&Context::serial(), &mesh, &scheme).unwrap();
        let mut normals = vec![1.0; positions.len()];
        limits.normals(&Context::serial(), &positions, &mut normals).unwrap();
        assert!(normals.iter().all(|&x| x == 0.0));
    }
}

#[test]
fn what_has_no_limit_is_refused() {
    let of = bases::grid(2, 2);
    let mesh = Arc::new(kernel::mesh(&of));
    let kind =
        |scheme: &Scheme| Limits::<f64>::new(&Context::serial(), &mesh, scheme).unwrap_err().kind();
    assert_eq!(kind(&three_point().with_boundary(Boundary::None)), ErrorKind::Unsupported);
    assert_eq!(kind(&Scheme::loop_triangles()), ErrorKind::Unsupported);
    let limits = Limits::<f64>::new(&Context::serial(), &mesh, &three_point()).unwrap();
    let refused = limits.normals(&Context::serial(), &xyz(&of), &mut [0.0; 5]);
    assert_eq!(refused.unwrap_err().kind(), ErrorKind::LengthMismatch);
    let context = Context::serial();
    context.cancel();
    let cancelled = Limits::<f64>::new(&context, &mesh, &three_point());
    assert_eq!(cancelled.unwrap_err().kind(), ErrorKind::Cancelled);
}
