//! The characteristic map: the surface in the plane that a scheme tends to around a feature.
//!
//! Its control points are the right eigenvectors of the two subdominant eigenvalues. The
//! surface is C¹ there if this map is regular and injective (Reif 1995). Both are looked at
//! on a sampling: the ring of faces around the innermost ones, refined a few times, as all
//! that lies farther inside is a smaller copy of it.

use super::spectrum::{Side, block, null_vectors, present, turn};
use super::weights::{Tangents, tangent_mode};
use super::{LocalMatrix, Spectrum};
use crate::base::{Context, Error, ErrorKind, Result};
use crate::hierarchy::Hierarchy;
use crate::limit::{Model, control_reach};
use crate::mesh::Mesh;
use crate::refine::FaceOrigin;
use crate::scheme::Scheme;
use faer::c64;
use std::f64::consts::TAU;

/// Steps after which a face is measured.
const STEPS: u32 = 3;

/// Points in the plane.
type Point = [f64; 2];

/// A sampled characteristic map.
#[derive(Debug, Clone)]
pub struct CharacteristicMap {
    /// The natural configuration: faces of the control mesh, the ring's and those inside it, with
    /// the eigenvectors of λ as vertices (Ball and Storry 1988).
    pub control: Vec<Vec<Point>>,
    /// Faces of the sampling, as polygons in the plane: the ring, and what is inside.
    pub ring: Vec<Vec<Point>>,
    /// The faces inside the ring.
    pub inside: Vec<Vec<Point>>,
    /// The smallest signed Jacobian of the ring over their mean size; positive if the
    /// map is regular at all samples.
    pub least_jacobian: f64,
    /// Samples of the Jacobian.
    pub samples: usize,
    /// The sampling covers no point twice: its outline goes around once and does not meet itself.
    pub injective: bool,
}

impl CharacteristicMap {
    /// Samples the map of a scheme around the feature of a spectrum; nothing where the
    /// eigenvalues promise no tangent plane.
    ///
    /// # Errors
    /// As [`LocalMatrix::new`].
    pub fn new(scheme: &Scheme, spectrum: &Spectrum) -> Result<Option<Self>> {
        let Some(tangents) = tangent_mode(spectrum) else { return Ok(None) };
        let reach = control_reach(scheme);
        let model = Model::new(scheme, spectrum.feature(), reach)?;
        let inner = LocalMatrix::of_model(&model, spectrum.feature(), None)?;
        let mut points = vec![[0.0; 2]; model.mesh().vertices()];
        control_points(&inner, &tangents, &mut points)?;
        let outer = LocalMatrix::of_model(&model, spectrum.feature(), Some(reach))?;
        extend(&outer, &tangents, reach, &mut points);
        orient(&model, &mut points);
        let sampling = Sampling::new(scheme, &model, &points)?;
        Ok(Some(sampling.measure()))
    }
}

/// The eigenvectors of the innermost vertices as points.
fn control_points(
    matrix: &LocalMatrix<f64>,
    tangents: &Tangents,
    points: &mut [Point],
) -> Result<()> {
    match *tangents {
        Tangents::Turning(lambda) => {
            let vectors = null_vectors(&block(matrix, 1), c64::new(lambda, 0.0), Side::Right)?;
            let vector = vectors.first().ok_or_else(no_vector)?;
            // The innermost vertex lies on the first axis.
            let unit = vector[0].conj() / vector[0].norm();
            for (&orbit, &entry) in present(matrix, 1).iter().zip(vector) {
                for (sector, &v) in matrix.orbit_vertices(orbit).iter().enumerate() {
                    let at = entry * unit * turn(sector, matrix.sectors());
                    points[v as usize] = [at.re, at.im];
                }
            }
        }
        Tangents::Separate(pair) => {
            let block = block(matrix, 0);
            let mut found = null_vectors(&block, c64::new(pair[0], 0.0), Side::Right)?;
            if found.len() < 2 {
                found.extend(null_vectors(&block, c64::new(pair[1], 0.0), Side::Right)?);
            }
            let [x, y] = found.get(..2).ok_or_else(no_vector)? else { return Err(no_vector()) };
            let [x, y] = [x, y].map(|vector| real(vector));
            for (orbit, point) in x.into_iter().zip(y).map(<[f64; 2]>::from).enumerate() {
                for &v in matrix.orbit_vertices(orbit) {
                    points[v as usize] = point;
                }
            }
        }
    }
    Ok(())
}

/// A real vector that was multiplied by some unit.
fn real(vector: &[c64]) -> Vec<f64> {
    let longer = |a: c64, &b: &c64| if b.norm() > a.norm() { b } else { a };
    let longest = vector.iter().fold(c64::new(0.0, 0.0), longer);
    vector.iter().map(|&entry| (entry / longest).re).collect()
}

/// The points farther out: their images are made of points nearer to the middle, and images are
/// λ times as far.
fn extend(matrix: &LocalMatrix<f64>, tangents: &Tangents, reach: u32, points: &mut [Point]) {
    let pair = match *tangents {
        Tangents::Turning(lambda) => [lambda; 2],
        Tangents::Separate(pair) => pair,
    };
    for _ in 0..reach {
        let before = points.to_vec();
        matrix.each_vertex(|vertex, row| {
            let mut sum = [0.0; 2];
            for (v, weight) in row {
                for (sum, x) in sum.iter_mut().zip(before[v as usize]) {
                    *sum += weight * x;
                }
            }
            points[vertex as usize] = std::array::from_fn(|k| sum[k] / pair[k]);
        });
    }
}

fn no_vector() -> Error {
    Error::new(ErrorKind::BrokenInvariant, "an eigenvalue without an eigenvector")
}

/// Eigenvectors have no sign: turns the picture over if its faces lie on their backs.
fn orient(model: &Model, points: &mut [Point]) {
    let mesh = model.mesh();
    let [inner, ring] = rings(model);
    let area = |&face: &u32| area(&polygon(mesh, points, face));
    let sum: f64 = inner.iter().chain(&ring).map(area).sum();
    if sum < 0.0 {
        for point in points {
            point[1] = -point[1];
        }
    }
}

/// The faces in the middle of a model, and those that touch them.
fn rings(model: &Model) -> [Vec<u32>; 2] {
    let mesh = model.mesh();
    let mut inner: Vec<u32> = model.innermost();
    inner.sort_unstable();
    inner.dedup();
    let vertices =
        inner.iter().flat_map(|&face| mesh.layout.face(face)).map(|c| mesh.vert[c as usize]);
    let mut ring: Vec<u32> =
        vertices.flat_map(|v| mesh.fans(v)).map(|c| mesh.layout.face_of(c)).collect();
    ring.sort_unstable();
    ring.dedup();
    ring.retain(|face| inner.binary_search(face).is_err());
    [inner, ring]
}

fn polygon(mesh: &Mesh, points: &[Point], face: u32) -> Vec<Point> {
    mesh.layout.face(face).map(|c| points[mesh.vert[c as usize] as usize]).collect()
}

/// The signed area of a polygon, positive counter-clockwise.
fn area(polygon: &[Point]) -> f64 {
    let next = polygon.iter().cycle().skip(1);
    polygon.iter().zip(next).map(|(a, b)| (a[0] * b[1] - a[1] * b[0]) / 2.0).sum()
}

/// The refined faces of a model.
struct Sampling {
    control: Vec<Vec<Point>>,
    inside: Vec<Vec<Point>>,
    ring: Vec<Vec<Point>>,
    outline: Vec<Point>,
}

impl Sampling {
    fn new(scheme: &Scheme, model: &Model, points: &[Point]) -> Result<Self> {
        let context = Context::serial();
        let base = model.hierarchy.shared_mesh(1)?;
        let fine = Hierarchy::new(&context, base, scheme.clone(), STEPS)?;
        let mesh = fine.mesh(STEPS);
        let mut values = vec![0.0; 2 * mesh.vertices()];
        fine.refine(&context, STEPS, points.as_flattened(), 2, &mut values)?;
        let refined = values.as_chunks::<2>().0;
        let [inner, ring] = rings(model);
        let part = |face: u32| {
            let found = |list: &[u32]| list.binary_search(&face).is_ok();
            if found(&inner) {
                Part::Inside
            } else if found(&ring) {
                Part::Ring
            } else {
                Part::Outside
            }
        };
        let mut parts: Vec<Part> = (0..fine.mesh(0).faces() as u32).map(part).collect();
        for level in 1..=STEPS {
            parts = descend(&fine, level, &parts)?;
        }
        let of = |part: Part| {
            let faces = (0..mesh.faces() as u32).filter(|&face| parts[face as usize] == part);
            faces.map(|face| polygon(mesh, refined, face)).collect::<Vec<_>>()
        };
        let outline = outline(mesh, refined, &parts);
        let control = inner.iter().chain(&ring);
        let control = control.map(|&face| polygon(model.mesh(), points, face)).collect();
        Ok(Self { control, inside: of(Part::Inside), ring: of(Part::Ring), outline })
    }

    fn measure(self) -> CharacteristicMap {
        // Corner by corner: twice the area of the triangle there.
        let jacobians = |polygon: &Vec<Point>| {
            let n = polygon.len();
            let at = |i: usize| {
                let (a, b, c) = (polygon[(i + n - 1) % n], polygon[i], polygon[(i + 1) % n]);
                (c[0] - b[0]) * (a[1] - b[1]) - (c[1] - b[1]) * (a[0] - b[0])
            };
            (0..n).map(at).collect::<Vec<f64>>()
        };
        let all: Vec<f64> = self.ring.iter().flat_map(jacobians).collect();
        let mean = all.iter().map(|j| j.abs()).sum::<f64>() / all.len().max(1) as f64;
        let least = all.iter().fold(f64::INFINITY, |least, &j| least.min(j));
        let injective = is_simple(&self.outline);
        CharacteristicMap {
            control: self.control,
            ring: self.ring,
            inside: self.inside,
            least_jacobian: if mean > 0.0 { least / mean } else { 0.0 },
            samples: all.len(),
            injective,
        }
    }
}

/// Where a face of the sampling lies.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Part {
    Inside,
    Ring,
    Outside,
}

/// The parts of a level's faces by those of the level before. Faces that a dual step lays on
/// edges and vertices count to the outermost part that they touch.
fn descend(fine: &Hierarchy, level: u32, parts: &[Part]) -> Result<Vec<Part>> {
    let parent = fine.mesh(level - 1);
    let of = |face: u32| parts[face as usize];
    let outermost = |corners: &mut dyn Iterator<Item = u32>| {
        let mut part = Part::Inside;
        for corner in corners {
            match of(parent.layout.face_of(corner)) {
                Part::Outside => part = Part::Outside,
                Part::Ring if part == Part::Inside => part = Part::Ring,
                _ => {}
            }
        }
        part
    };
    let origins = fine.face_origins(level)?;
    let part = |origin: FaceOrigin| match origin {
        FaceOrigin::Face(face) => of(face),
        FaceOrigin::Corner(corner) => of(parent.layout.face_of(corner)),
        FaceOrigin::Edge(corner) => {
            let twin = parent.twin[corner as usize];
            let twin = (twin != crate::base::NONE).then_some(twin);
            outermost(&mut std::iter::once(corner).chain(twin))
        }
        FaceOrigin::Vertex(v) => outermost(&mut parent.fans(v)),
    };
    Ok(origins.into_iter().map(part).collect())
}

/// The boundary of all that is not outside, in order.
fn outline(mesh: &Mesh, points: &[Point], parts: &[Part]) -> Vec<Point> {
    let within = |c: u32| parts[mesh.layout.face_of(c) as usize] != Part::Outside;
    let across = |c: u32| mesh.twin[c as usize];
    let edge = |c: &u32| within(*c) && (across(*c) == crate::base::NONE || !within(across(*c)));
    let Some(start) = (0..mesh.corners() as u32).find(edge) else { return Vec::new() };
    let mut outline = Vec::new();
    let mut corner = start;
    loop {
        outline.push(points[mesh.vert[corner as usize] as usize]);
        // On to the next edge of the outline around the end of this one.
        corner = mesh.next(corner);
        while !edge(&corner) {
            corner = mesh.next(across(corner));
        }
        if corner == start || outline.len() > mesh.corners() {
            return outline;
        }
    }
}

/// True if a closed polygon goes around once, counter-clockwise, without meeting itself.
fn is_simple(outline: &[Point]) -> bool {
    let n = outline.len();
    if n < 3 || area(outline) <= 0.0 {
        return false;
    }
    let direction = |i: usize| {
        let (a, b) = (outline[i % n], outline[(i + 1) % n]);
        libm::atan2(b[1] - a[1], b[0] - a[0])
    };
    let turned: f64 = (0..n)
        .map(|i| {
            let by = direction(i + 1) - direction(i);
            by - TAU * libm::round(by / TAU)
        })
        .sum();
    if (turned - TAU).abs() > 1e-6 {
        return false;
    }
    let segment = |i: usize| [outline[i], outline[(i + 1) % n]];
    (0..n).all(|i| (i + 2..n).all(|j| (j + 1) % n == i || !cross(segment(i), segment(j))))
}

/// True if two segments cross.
fn cross([a, b]: [Point; 2], [c, d]: [Point; 2]) -> bool {
    let apart = |k: usize| a[k].max(b[k]) < c[k].min(d[k]) || c[k].max(d[k]) < a[k].min(b[k]);
    let side = |p: Point, q: Point, r: Point| {
        (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])
    };
    !apart(0)
        && !apart(1)
        && side(a, b, c) * side(a, b, d) < 0.0
        && side(c, d, a) * side(c, d, b) < 0.0
}
