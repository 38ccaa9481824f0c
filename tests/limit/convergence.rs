//! Refined meshes against the surface that they converge to, and how fast.

use super::{Derivatives, Shape, at, bases, quad_schemes};
use carvel::limit::Surface;
use carvel::refine::FaceOrigin;
use carvel::{Context, Hierarchy, Mesh, Scheme, SplitKind};

type Point = [f64; 2];

/// A corner of a level, and where its face lies from there, in coordinates of a control face:
/// along its outgoing edge and along the edge before. Under dual schemes it is the quarter of the face
/// to its middle.
#[derive(Debug, Clone)]
pub(super) struct Spot {
    pub(super) face: usize,
    sector: usize,
    pub(super) corner: usize,
    at: Point,
    axes: [Point; 2],
}

fn add(p: Point, [x, y]: Point, by: f64) -> Point {
    [p[0] + by * x, p[1] + by * y]
}

fn halves(a: Point, b: Point, [i, j]: [f64; 2]) -> [Point; 2] {
    [add([0.0; 2], a, i / 2.0), add([0.0; 2], b, j / 2.0)]
}

impl Spot {
    /// The corners of the control mesh.
    pub(super) fn all(mesh: &Mesh, scheme: &Scheme, surface: &Surface) -> Vec<Self> {
        let turned = |k: usize| match k {
            0 => ([0.0, 0.0], [1.0, 0.0], [0.0, 1.0]),
            1 => ([1.0, 0.0], [0.0, 1.0], [-1.0, 0.0]),
            2 => ([1.0, 1.0], [-1.0, 0.0], [0.0, -1.0]),
            _ => ([0.0, 1.0], [0.0, -1.0], [1.0, 0.0]),
        };
        let of_triangle = |k: usize| match k {
            0 => ([0.0, 0.0], [1.0, 0.0], [0.0, 1.0]),
            1 => ([1.0, 0.0], [-1.0, 1.0], [-1.0, 0.0]),
            _ => ([0.0, 1.0], [0.0, -1.0], [1.0, -1.0]),
        };
        let spot = |face: usize, k: usize| {
            let corner = mesh.face_corners(face).start + k;
            if surface.sectors(face) > 1 {
                return Self {
                    face,
                    sector: k,
                    corner,
                    at: [0.0; 2],
                    axes: [[1.0, 0.0], [0.0, 1.0]],
                };
            }
            let triangle = scheme.split() == SplitKind::Triangle;
            let (at, a, b) = if triangle { of_triangle(k) } else { turned(k) };
            let axes = match scheme.split() {
                SplitKind::Corner => halves(a, b, [1.0, 1.0]),
                _ => [a, b],
            };
            Self { face, sector: 0, corner, at, axes }
        };
        let corners = |face: usize| (0..mesh.face_corners(face).len()).map(move |k| (face, k));
        (0..mesh.faces()).flat_map(corners).map(|(face, k)| spot(face, k)).collect()
    }

    /// True if it is so far from the corners of its face, of which all are control vertices.
    fn is_apart(&self, by: f64) -> bool {
        let [u, v] = self.at;
        let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
        corners.iter().all(|[x, y]| (u - x).hypot(v - y) >= by)
    }

    pub(super) fn sample(&self) -> carvel::limit::Sample {
        at(self.face, self.sector, self.at)
    }

    /// A corner of the quad at this corner that a quad split makes; from a face that is none the quad
    /// is all of a sector.
    pub(super) fn in_quad(&self, is_sector: bool, k: usize) -> Self {
        let scale = if is_sector { 2.0 } else { 1.0 };
        let [a, b] = halves(self.axes[0], self.axes[1], [scale, scale]);
        let [back, down] = [a, b].map(|axis| axis.map(|x| -x));
        let (at, axes) = match k {
            0 => (self.at, [a, b]),
            1 => (add(self.at, a, 1.0), [b, back]),
            2 => (add(add(self.at, a, 1.0), b, 1.0), [back, down]),
            _ => (add(self.at, b, 1.0), [down, a]),
        };
        Self { corner: 4 * self.corner + k, at, axes, ..*self }
    }

    /// A corner of the triangle at this corner that a triangle split makes.
    pub(super) fn in_triangle(&self, k: usize) -> Self {
        let [a, b] = halves(self.axes[0], self.axes[1], [1.0, 1.0]);
        let across = [b[0] - a[0], b[1] - a[1]];
        let turn = |axis: Point| axis.map(|x| -x);
        let (at, axes) = match k {
            0 => (self.at, [a, b]),
            1 => (add(self.at, a, 1.0), [across, turn(a)]),
            _ => (add(self.at, b, 1.0), [turn(b), turn(across)]),
        };
        let face = 4 * (self.corner / 3) + self.corner % 3;
        Self { corner: 3 * face + k, at, axes, ..*self }
    }

    /// A corner at the vertex that a dual step makes of this corner: in the face, across its
    /// outgoing edge, in the face of the vertex, across the edge before.
    fn around(&self, corners: [usize; 4], k: usize) -> Self {
        let [a, b] = self.axes;
        let axes = match k {
            0 => halves(a, b, [1.0, 1.0]),
            1 => halves(b, a, [-1.0, 1.0]),
            2 => halves(a, b, [-1.0, -1.0]),
            _ => halves(b, a, [1.0, -1.0]),
        };
        let at = add(add(self.at, a, 0.5), b, 0.5);
        Self { corner: corners[k], at, axes, ..*self }
    }
}

/// What finds corners around the vertices of a dual step.
struct Around<'a> {
    parent: &'a Mesh,
    child: &'a Mesh,
    origins: Vec<FaceOrigin>,
    /// The face of each corner, and a corner at each vertex.
    face_of: Vec<u32>,
    at_vertex: Vec<u32>,
}

impl<'a> Around<'a> {
    fn new(hierarchy: &'a Hierarchy, level: u32) -> Self {
        let [parent, child] = [hierarchy.mesh(level), hierarchy.mesh(level + 1)];
        let origins = hierarchy.face_origins(level + 1).expect("a level");
        let mut face_of = vec![0; child.corners()];
        for face in 0..child.faces() {
            face_of[child.face_corners(face)].fill(face as u32);
        }
        let mut at_vertex = vec![0; child.vertices()];
        for (corner, &v) in (0..).zip(child.corner_vertices()) {
            at_vertex[v as usize] = corner;
        }
        Self { parent, child, origins, face_of, at_vertex }
    }

    fn corners(&self, corner: usize) -> [usize; 4] {
        let mut corners = [usize::MAX; 4];
        let mut at = self.at_vertex[corner] as usize;
        for _ in 0..4 {
            let twin = self.parent.corner_twins()[corner] as usize;
            let place = match self.origins[self.face_of[at] as usize] {
                FaceOrigin::Face(_) => 0,
                FaceOrigin::Edge(edge) => {
                    if [corner, twin].contains(&(edge as usize)) {
                        1
                    } else {
                        3
                    }
                }
                _ => 2,
            };
            corners[place] = at;
            let across = self.child.corner_twins()[at] as usize;
            let face = self.child.face_corners(self.face_of[across] as usize);
            at = if across + 1 == face.end { face.start } else { across + 1 };
        }
        corners
    }
}

/// From the corners of control faces, where all is regular beyond.
const APART: f64 = 0.2;

/// The largest distance between vertices of a level and their limits, for each level, along ways down
/// from every control corner: of all, and of those apart from control vertices.
///
/// Some of the ways stay at control vertices up to each of the levels.
fn distances(shape: &Shape, scheme: &Scheme, levels: u32) -> Vec<[f64; 2]> {
    const WAYS: usize = 40;
    let context = Context::builder().threads(0).build().expect("threads");
    let surface = shape.surface(scheme);
    let hierarchy =
        Hierarchy::new(&context, shape.mesh.clone(), scheme.clone(), levels).expect("levels");
    let mut spots = Spot::all(&shape.mesh, scheme, &surface);
    let count = spots.len();
    spots = spots.into_iter().cycle().take(WAYS * count).collect();
    let mut state = 7_u32;
    let mut choice = move |n: u32| {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (state >> 16) as usize % n as usize
    };
    let mut largest = Vec::new();
    for level in 1..=levels {
        let around =
            (scheme.split() == SplitKind::Corner).then(|| Around::new(&hierarchy, level - 1));
        for (i, spot) in spots.iter_mut().enumerate() {
            let stays = level as usize <= i / count % (levels as usize + 1);
            let home = if around.is_some() && level == 1 { 2 } else { 0 };
            let mut choice = |n: u32| if stays { home } else { choice(n) };
            let is_sector = level == 1 && surface.sectors(spot.face) > 1;
            *spot = match (scheme.split(), &around) {
                (SplitKind::Corner, Some(around)) => {
                    spot.around(around.corners(spot.corner), choice(4))
                }
                (SplitKind::Triangle, _) => spot.in_triangle(choice(3)),
                _ => spot.in_quad(is_sector, choice(4)),
            };
        }
        let mesh = hierarchy.mesh(level);
        let width = super::WIDTH;
        let mut refined = vec![0.0; width * mesh.vertices()];
        hierarchy.refine(&context, level, &shape.values, width, &mut refined).expect("values");
        let samples: Vec<_> = spots.iter().map(Spot::sample).collect();
        let mut limits = vec![0.0; width * samples.len()];
        let none = Derivatives::None;
        surface
            .evaluate(&context, &samples, &shape.values, width, none, &mut limits)
            .expect("limits");
        let distance = |(spot, limit): (&Spot, &[f64])| {
            let v = mesh.corner_vertices()[spot.corner] as usize;
            let apart = refined[width * v..][..width].iter().zip(limit).map(|(a, b)| (a - b).abs());
            apart.fold(0.0, f64::max)
        };
        let mut most = [0.0; 2];
        for (spot, limit) in spots.iter().zip(limits.chunks(width)) {
            let apart = distance((spot, limit));
            most[0] = f64::max(most[0], apart);
            if spot.is_apart(APART) {
                most[1] = f64::max(most[1], apart);
            }
        }
        largest.push(most);
    }
    largest
}

/// How often a distance is halved from each level to the next.
fn orders(distances: &[f64]) -> Vec<f64> {
    distances.windows(2).map(|pair| (pair[0] / pair[1]).log2()).collect()
}

/// Apart from extraordinary vertices parameters of control points are those of B-splines, and
/// distances are of second order. At them, where rings shrink by λ, control points and limits of equal
/// parameters are λⁿ apart.
fn check(levels: u32) {
    let quads = (Shape::new(&bases::cube()), quad_schemes());
    let triangles = (Shape::new(&bases::bipyramid(5)), vec![Scheme::loop_triangles()]);
    for (shape, schemes) in [quads, triangles] {
        for scheme in schemes {
            let distances = distances(&shape, &scheme, levels);
            let [all, apart] = [0, 1].map(|k| distances.iter().map(|d| d[k]).collect::<Vec<_>>());
            println!("{scheme:?}");
            let each = orders(&all).into_iter().zip(orders(&apart));
            for ((level, distances), (order, order_apart)) in (2..).zip(&distances[1..]).zip(each) {
                let [all, apart] = *distances;
                println!(
                    "  level {level}: {all:.2e}, order {order:.2}; apart {apart:.2e}, {order_apart:.2}"
                );
            }
            let [last, last_apart] = distances[distances.len() - 1];
            if distances.iter().all(|d| d[0] < 1e-13) {
                // Control points stay where they are.
                continue;
            }
            let steps = f64::from(levels - 2);
            let [order, order_apart] = [(all[1], last), (apart[1], last_apart)]
                .map(|(first, last)| (first / last).log2() / steps);
            assert!(order > 0.9, "{scheme:?}: {distances:?}, order {order}");
            assert!(order_apart > 1.75, "{scheme:?}: {distances:?}, order {order_apart}");
            let expected = 0.25_f64.powi(levels as i32 - 1);
            assert!(last_apart < expected, "{scheme:?}: {distances:?}");
        }
    }
}

#[test]
fn refined_meshes_converge() {
    check(5);
}

/// 6 to 8 million faces for each scheme.
#[test]
#[ignore = "takes minutes without optimisation"]
fn refined_meshes_converge_to_level_10() {
    check(10);
}
