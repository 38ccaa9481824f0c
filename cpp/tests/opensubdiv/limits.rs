//! Limits of vertices against `PrimvarRefiner::Limit`: points, and tangent planes.
//!
//! OpenSubdiv's masks suppose that features are isolated and semi-sharp ones used up, so that
//! both sides are asked about a level where they are.

use carvel_peers::lineage::match_refinement;
use carvel_peers::{Boundary, Control, OpenSubdiv, Options, Precision, Scheme, Task, ours, shapes};
use std::collections::HashSet;

/// Of points, of the mesh's size, and of the cosine between a tangent and a normal.
const ROUNDING: f64 = 1e-10;

/// Vertices whose tangent planes are compared; crease vertices have one on either side.
type Planes<'a> = &'a dyn Fn(&[f64]) -> bool;

fn check(task: &Task, level: u32, planes: Planes, what: &str) {
    let ours::VertexLimits { points, normals, planes: found } =
        ours::limits(task, level).expect("our limits");
    let missing = found.iter().filter(|plane| !**plane).count();
    assert!(missing <= ends(task), "{what}: {missing} vertices without tangents");
    let vertices = points.len() / 3;
    let theirs = OpenSubdiv.limits(task, level, vertices).expect("their limits");
    let refinement = OpenSubdiv.refinement(task, level).expect("a refinement");
    let (_, at) = match_refinement(task, &refinement, level).expect("a match");
    let size = points.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    let xyz = |list: &[f64], v: usize| [list[3 * v], list[3 * v + 1], list[3 * v + 2]];
    let irregular = irregular_ends(task, level);
    let mut seen = 0;
    for v in 0..vertices {
        let w = at.vertices[v] as usize;
        let [mine, other] = [xyz(&points, v), xyz(&theirs.points, w)];
        let near = (0..3).all(|k| (mine[k] - other[k]).abs() <= ROUNDING * size);
        assert!(near, "{what}, {:?}: vertex {v} at {mine:?}, not {other:?}", task.scheme);
        let tangents = [0, 1].map(|k| xyz(&theirs.tangents[k], w));
        let normal = unit(cross(tangents[0], tangents[1]));
        if !found[v] || irregular[v] || !planes(&mine) || normal.iter().any(|x| x.is_nan()) {
            continue;
        }
        let apart = cross(normal, xyz(&normals, v));
        let same = dot(normal, xyz(&normals, v)) > 0.0 && dot(apart, apart).sqrt() <= ROUNDING;
        let found = xyz(&normals, v);
        assert!(same, "{what}, {:?}: normal {v} is {found:?}, not {normal:?}", task.scheme);
        seen += 1;
    }
    assert!(2 * seen >= vertices, "{what}: {seen} planes of {vertices}");
}

/// Vertices of the boundary with more or fewer faces than regular ones. OpenSubdiv's tangents across
/// it are those of Biermann, Levin and Zorin (2000), whose rules beside a boundary are not the
/// ones that either library refines by. In the frame's corners of three faces the left
/// eigenvectors of 0.5797 and 0.5 of the 8 × 8 matrix give the normal (−0.27102, 0.27102, 0.92363),
/// as carvel does; OpenSubdiv has (−0.26434, 0.26434, 0.92750).
fn irregular_ends(task: &Task, level: u32) -> Vec<bool> {
    let mesh = ours::refine(task, level).expect("a level").mesh;
    let (mut faces, mut around) = (vec![0; mesh.vertices()], vec![HashSet::new(); mesh.vertices()]);
    for face in mesh.faces() {
        for (i, &v) in face.iter().enumerate() {
            faces[v as usize] += 1;
            let n = face.len();
            around[v as usize].extend([face[(i + 1) % n], face[(i + n - 1) % n]]);
        }
    }
    let regular = if task.scheme == Scheme::Loop { 3 } else { 2 };
    let open = |v: usize| around[v].len() > faces[v];
    (0..mesh.vertices()).map(|v| open(v) && faces[v] != regular).collect()
}

/// Vertices with one face, where a boundary without corners comes to a stop: carvel has no tangents
/// there, since the one across shrinks by 4 a step, n times as slowly after n steps.
fn ends(task: &Task) -> usize {
    if task.options.boundary != Boundary::Edge {
        return 0;
    }
    let faces = |v: u32| task.control.indices.iter().filter(|&&w| w == v).count();
    (0..task.control.vertices() as u32).filter(|&v| faces(v) == 1).count()
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|k| {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        a[i] * b[j] - a[j] * b[i]
    })
}

fn unit(a: [f64; 3]) -> [f64; 3] {
    a.map(|x| x / dot(a, a).sqrt())
}

fn everywhere(control: &Control, boundary: Boundary, planes: Planes, what: &str) {
    let options = Options { boundary, ..Options::default() };
    let schemes = [Some(Scheme::CatmullClark), control.is_triangles().then_some(Scheme::Loop)];
    for scheme in schemes.into_iter().flatten() {
        let task = Task { control, scheme, precision: Precision::Double, options };
        check(&task, 2, planes, what);
    }
}

#[test]
fn every_valence_and_face_size() {
    for n in 3..=12 {
        for (control, what) in [
            (shapes::prism(n), "prism"),
            (shapes::bipyramid(n), "bipyramid"),
            (shapes::pyramid(n), "pyramid"),
        ] {
            everywhere(&control, Boundary::default(), &|_| true, &format!("{what} of {n}"));
        }
    }
}

#[test]
fn boundaries_and_corners() {
    for boundary in [Boundary::Edge, Boundary::EdgeAndCorner] {
        for (control, what) in [
            (shapes::grid(3, 4), "grid"),
            (shapes::frame(), "frame"),
            (shapes::triangulated(&shapes::grid(3, 4)), "triangle grid"),
            (shapes::half_fan(3), "half fan"),
            (shapes::half_fan(5), "wide half fan"),
        ] {
            everywhere(&control, boundary, &|_| true, what);
        }
    }
}

/// Where creases end, cross and close.
#[test]
fn creases() {
    // A crease vertex has two planes; which one the libraries give is theirs to choose.
    let off_the_line = |p: &[f64]| (p[0] - 2.0).abs() > 1e-9 && (p[1] - 2.0).abs() > 1e-9;
    let line = [[10, 11], [11, 12], [12, 13], [13, 14]];
    let across = [[2, 7], [7, 12], [12, 17], [17, 22]];
    let flat = |mut control: Control| {
        control.positions.chunks_mut(3).for_each(|p| p[2] = (p[0] * 1.3).sin() * p[1]);
        control
    };
    let whole = flat(shapes::grid(4, 4)).creased(&line, 10.0);
    everywhere(&whole, Boundary::default(), &off_the_line, "a crease");
    let crossed = whole.clone().creased(&across, 10.0);
    everywhere(&crossed, Boundary::default(), &off_the_line, "crossing creases");
    let triangles = shapes::triangulated(&flat(shapes::grid(4, 4))).creased(&line, 10.0);
    everywhere(&triangles, Boundary::default(), &off_the_line, "a crease in triangles");
    let passing = flat(shapes::grid(4, 4)).creased(&line, 1.5).cornered(&[6], 0.7);
    everywhere(&passing, Boundary::default(), &|_| true, "a crease that is used up");
}

/// `PrimvarRefiner::Limit` takes a dart for a smooth vertex, which it is not: the crease's edge is
/// split in the middle on every level. Refinement goes where carvel says.
#[test]
fn a_dart_goes_where_refinement_goes() {
    const DART: usize = 12;
    let mut control = shapes::grid(4, 4).creased(&[[10, 11], [11, 12]], 10.0);
    control.positions.chunks_mut(3).for_each(|p| p[2] = (p[0] * 1.3).sin() * p[1]);
    let task = Task::new(&control, Scheme::CatmullClark, Precision::Double);
    // Old vertices come first on every level.
    let z = |points: &[f64]| points[3 * DART + 2];
    let ours = z(&ours::limits(&task, 1).expect("our limits").points);
    let [coarse, fine] = [4, 6].map(|level| {
        let refined = ours::refine(&task, level).expect("a level").mesh;
        (z(&refined.positions) - ours).abs()
    });
    let refinement = OpenSubdiv.refinement(&task, 1).expect("a refinement");
    let (_, at) = match_refinement(&task, &refinement, 1).expect("a match");
    let theirs = OpenSubdiv.limits(&task, 1, at.vertices.len()).expect("their limits").points;
    let theirs = theirs[3 * at.vertices[DART] as usize + 2];
    assert!(fine < coarse / 4.0, "{coarse}, then {fine}");
    assert!(fine < (theirs - ours).abs() / 10.0, "{fine} from {ours}, and theirs is {theirs}");
}
