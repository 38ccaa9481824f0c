//! Closest points and rays: against dense samples, closed forms, and the triangles of
//! tessellation.

use super::{Shape, bases, fraction};
use carvel::limit::{
    Closest, Derivatives, Fineness, Hit, Ray, Sample, Search, Surface, TessellateOptions,
    tessellate,
};
use carvel::mesh::BuildOptions;
use carvel::{Boundary, Context, Crease, ErrorKind, Mesh, Scheme};
use std::sync::Arc;
use std::time::Instant;

/// How near to the truth a distance is, in units of coordinates of about 1.
const EXACT: f64 = 1e-11;

type Point = [f64; 3];

fn minus(a: Point, b: Point) -> Point {
    [0, 1, 2].map(|k| a[k] - b[k])
}

fn bits(p: Point) -> [u64; 3] {
    p.map(f64::to_bits)
}

fn length(a: Point) -> f64 {
    (a[0] * a[0] + a[1] * a[1] + a[2] * a[2]).sqrt()
}

/// Numbers in [-1, 1] that follow no pattern.
struct Noise(u64);

impl Noise {
    fn next(&mut self) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    fn point(&mut self) -> Point {
        [self.next(), self.next(), self.next()]
    }
}

struct Case {
    name: &'static str,
    shape: Shape,
    surface: Arc<Surface>,
    positions: Vec<f64>,
    search: Search,
}

impl Case {
    fn new(name: &'static str, shape: Shape, scheme: &Scheme) -> Self {
        let context = Context::serial();
        let positions: Vec<f64> =
            shape.values.chunks(super::WIDTH).flat_map(|record| &record[..3]).copied().collect();
        let surface = Arc::new(shape.surface(scheme));
        let search = Search::new(&context, &surface, &positions).expect(name);
        Self { name, shape, surface, positions, search }
    }

    fn point(&self, sample: Sample) -> Point {
        let mut point = [0.0; 3];
        let evaluated = self.surface.evaluate(
            &Context::serial(),
            &[sample],
            &self.positions,
            3,
            Derivatives::None,
            &mut point,
        );
        evaluated.expect(self.name);
        point
    }

    fn closest(&self, points: &[Point]) -> Vec<Closest> {
        let mut out = vec![None; points.len()];
        let context = Context::serial();
        self.search.closest(&context, points, f64::INFINITY, &mut out).expect(self.name);
        out.into_iter().map(|found| found.expect(self.name)).collect()
    }

    fn hits(&self, rays: &[Ray]) -> Vec<Option<Hit>> {
        let mut out = vec![None; rays.len()];
        self.search.intersect(&Context::serial(), rays, &mut out).expect(self.name);
        out
    }

    /// Points of a grid with n intervals in every face and sector.
    fn samples(&self, n: u32) -> Vec<Sample> {
        let mut samples = Vec::new();
        let mesh = &self.shape.mesh;
        for face in 0..mesh.faces() as u32 {
            let sectors = self.surface.sectors(face as usize) as u32;
            let is_triangle = self.name.contains("loop");
            for sector in 0..sectors {
                for i in 0..=n {
                    for j in 0..=if is_triangle { n - i } else { n } {
                        let [u, v] = [i, j].map(|k| f64::from(k) / f64::from(n));
                        samples.push(Sample { face, sector, u, v });
                    }
                }
            }
        }
        samples
    }

    fn points(&self, samples: &[Sample]) -> Vec<Point> {
        let mut points = vec![[0.0; 3]; samples.len()];
        let out = points.as_flattened_mut();
        let context = Context::serial();
        self.surface
            .evaluate(&context, samples, &self.positions, 3, Derivatives::None, out)
            .expect(self.name);
        points
    }

    /// Queries near, on, inside and far from the surface.
    fn queries(&self, count: usize) -> Vec<Point> {
        let mut noise = Noise(7);
        let mut queries = vec![[0.0; 3], [100.0, -50.0, 1e6], [0.0, 0.0, 1e-3]];
        let scales = [1.5, 0.3, 6.0];
        for i in 0..count {
            queries.push(noise.point().map(|x| x * scales[i % 3]));
        }
        // On the surface, its features and borders among them, and just beside it.
        let all = self.samples(4);
        let step = all.len().div_ceil(count).max(1);
        let on: Vec<Sample> = all.into_iter().step_by(step).collect();
        for p in self.points(&on) {
            let off = noise.point();
            queries.push(p);
            queries.push([0, 1, 2].map(|k| p[k] + 1e-2 * off[k]));
        }
        queries
    }
}

fn semi_sharp() -> Shape {
    let cube = bases::cube();
    let plain = Shape::new(&cube);
    let sharpness = [10.0, 2.5, 0.5];
    let edges = plain.mesh.edge_vertices().step_by(2).zip(sharpness.into_iter().cycle());
    let creases: Vec<Crease> =
        edges.map(|(vertices, sharpness)| Crease { vertices, sharpness }).collect();
    Shape::with(&cube, &BuildOptions { creases: &creases, ..BuildOptions::default() })
}

fn three_point() -> Scheme {
    Scheme::three_point(fraction(1, 32)).unwrap()
}

fn cases() -> Vec<Case> {
    let with_edges = |scheme: Scheme| scheme.with_boundary(Boundary::EdgeAndCorner);
    vec![
        Case::new("cube, catmull-clark", Shape::new(&bases::cube()), &Scheme::catmull_clark()),
        Case::new(
            "torus, catmull-clark",
            Shape::new(&bases::torus(5, 4)),
            &Scheme::catmull_clark(),
        ),
        Case::new("prism, catmull-clark", Shape::new(&bases::prism(5)), &Scheme::catmull_clark()),
        Case::new("creased cube, catmull-clark", semi_sharp(), &Scheme::catmull_clark()),
        Case::new("octahedron, loop", Shape::new(&bases::octahedron()), &Scheme::loop_triangles()),
        Case::new(
            "creased bipyramid, loop",
            Shape::creased(&bases::bipyramid(7)),
            &Scheme::loop_triangles(),
        ),
        Case::new("cube, three-point", Shape::new(&bases::cube()), &three_point()),
        Case::new("torus, three-point", Shape::new(&bases::torus(5, 4)), &three_point()),
        Case::new(
            "dodecahedron, doo-sabin",
            Shape::new(&bases::dodecahedron()),
            &Scheme::doo_sabin(),
        ),
        Case::new("pyramid, quartic", Shape::new(&bases::pyramid(6)), &Scheme::quartic()),
        Case::new(
            "open grid, catmull-clark",
            Shape::new(&bases::grid(4, 3)),
            &with_edges(Scheme::catmull_clark()),
        ),
        Case::new(
            "annulus, doo-sabin",
            Shape::new(&bases::annulus(5, 2)),
            &with_edges(Scheme::doo_sabin()),
        ),
    ]
}

fn closed(case: &Case) -> bool {
    case.shape.mesh.is_closed()
}

/// Dense samples, none of which may be nearer than the answer.
fn check_closest(case: &Case, grid: u32, count: usize) {
    let samples = case.points(&case.samples(grid));
    let queries = case.queries(count);
    for (&query, found) in queries.iter().zip(case.closest(&queries)) {
        let Closest { sample, point, distance } = found;
        assert_eq!(bits(point), bits(case.point(sample)), "{}: {query:?}", case.name);
        let scale = 1.0_f64.max(length(query));
        let apart = (length(minus(point, query)) - distance).abs();
        assert!(apart <= EXACT * scale, "{}: {query:?}, {found:?}, {apart}", case.name);
        let nearest =
            samples.iter().map(|&p| length(minus(p, query))).fold(f64::INFINITY, f64::min);
        let name = case.name;
        assert!(
            distance <= nearest + EXACT * scale,
            "{name}: a sample is {nearest} from {query:?}, found was {found:?}"
        );
        // Not much nearer, either, than a fine grid: the samples do go everywhere.
        assert!(nearest - distance < 8.0 / f64::from(grid), "{name}: {query:?} {found:?}");
    }
}

#[test]
fn no_sample_is_nearer_than_the_closest_point() {
    for case in cases() {
        check_closest(&case, 24, 12);
    }
}

#[test]
#[ignore = "takes minutes without optimisation"]
fn no_dense_sample_is_nearer_than_the_closest_point() {
    for case in cases() {
        check_closest(&case, 200, 200);
    }
}

/// Distances from points of the surface are zero.
#[test]
fn points_of_the_surface_are_closest_to_themselves() {
    for case in cases() {
        let queries = case.points(&case.samples(3));
        for (query, found) in queries.iter().zip(case.closest(&queries)) {
            assert!(found.distance < EXACT, "{}: {query:?}, {found:?}", case.name);
        }
    }
}

/// A flat rectangle: the closest point is the foot, or the nearest point of the border.
#[test]
fn a_plane_has_the_feet_one_expects() {
    let mut grid = bases::grid(4, 3);
    for p in &mut grid.positions {
        p[2] = 0.0;
    }
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for p in &grid.positions {
        for k in 0..2 {
            (low[k], high[k]) = (low[k].min(p[k]), high[k].max(p[k]));
        }
    }
    let scheme = Scheme::catmull_clark().with_boundary(Boundary::EdgeAndCorner);
    let case = Case::new("plane", Shape::new(&grid), &scheme);
    let mut noise = Noise(3);
    let queries: Vec<Point> = (0..200).map(|_| noise.point().map(|x| 6.0 * x)).collect();
    let rays: Vec<Ray> = queries.iter().map(|&q| Ray::new(q, [0.3, -0.2, -q[2]])).collect();
    let hits = case.hits(&rays);
    for ((q, found), (ray, hit)) in
        queries.iter().zip(case.closest(&queries)).zip(rays.iter().zip(hits))
    {
        let foot = [q[0].clamp(low[0], high[0]), q[1].clamp(low[1], high[1]), 0.0];
        let off = length(minus(found.point, foot));
        assert!(off < EXACT * 10.0, "{q:?}: {found:?}, {foot:?}");
        let at = [0, 1, 2].map(|k| ray.origin[k] + ray.direction[k]);
        let inside = (0..2).all(|k| low[k] <= at[k] && at[k] <= high[k]);
        assert_eq!(hit.is_some(), inside, "{ray:?}");
        if let Some(hit) = hit {
            assert!((hit.t - 1.0).abs() < EXACT * 10.0, "{ray:?}: {hit:?}");
            assert_eq!(bits(hit.point), bits(case.point(hit.sample)));
        }
    }
}

/// Directions all around.
fn directions(count: usize) -> Vec<Point> {
    let mut noise = Noise(11);
    (0..count).map(|_| noise.point()).filter(|d| length(*d) > 0.1).collect()
}

/// Rays from within closed surfaces that are star-shaped all hit, those at features, edges and
/// middles of faces too, and leave for good.
fn check_inside(case: &Case, count: usize, grid: u32) {
    let name = case.name;
    let mesh = &case.shape.mesh;
    let mut centre = [0.0; 3];
    for p in case.positions.chunks(3) {
        (0..3).for_each(|k| centre[k] += p[k] / mesh.vertices() as f64);
    }
    let mut rays: Vec<Ray> = directions(count).into_iter().map(|d| Ray::new(centre, d)).collect();
    let all = case.samples(grid);
    let step = all.len().div_ceil(4 * count);
    let aimed = case.points(&all.into_iter().step_by(step).collect::<Vec<_>>());
    rays.extend(aimed.iter().map(|&p| Ray::new(centre, minus(p, centre))));
    let hits = case.hits(&rays);
    for (i, (ray, hit)) in rays.iter().zip(&hits).enumerate() {
        let hit = hit.unwrap_or_else(|| panic!("{name}: {ray:?} slips through"));
        assert_eq!(bits(hit.point), bits(case.point(hit.sample)), "{name}");
        let on = [0, 1, 2].map(|k| ray.origin[k] + hit.t * ray.direction[k]);
        assert!(length(minus(on, hit.point)) < EXACT, "{name}: {ray:?}, {hit:?}");
        if i + aimed.len() >= rays.len() {
            assert!((hit.t - 1.0).abs() < 1e-9, "{name}: {ray:?}, {hit:?}");
        }
        // From outside inwards there is the same point.
        let far = [0, 1, 2].map(|k| ray.origin[k] + 10.0 * hit.t * ray.direction[k]);
        let back = case.hits(&[Ray::new(far, ray.direction.map(|x| -x))])[0].expect(name);
        assert!(length(minus(back.point, hit.point)) < 1e-9, "{name}: {ray:?}, {hit:?}, {back:?}");
    }
}

#[test]
fn rays_from_within_do_not_slip_through() {
    // Others take long without optimisation: see below.
    let slow = ["torus", "three-point", "dodecahedron"];
    let is_quick = |name: &str| !slow.iter().any(|part| name.contains(part));
    for case in cases().iter().filter(|case| closed(case) && is_quick(case.name)) {
        check_inside(case, 12, 2);
    }
}

#[test]
#[ignore = "takes minutes without optimisation"]
fn thousands_of_rays_from_within_do_not_slip_through() {
    for case in cases().iter().filter(|case| closed(case) && !case.name.contains("torus")) {
        let start = Instant::now();
        check_inside(case, 2_000, 16);
        println!("{}: {:?}", case.name, start.elapsed());
    }
}

/// How often a ray goes through triangles, and where first (Möller and Trumbore 1997).
fn through(ray: &Ray, triangles: &[[Point; 3]]) -> (usize, f64) {
    let cross = |a: Point, b: Point| {
        [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    };
    let dot = |a: Point, b: Point| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let mut found = (0, f64::INFINITY);
    for &[a, b, c] in triangles {
        let (ab, ac, from) = (minus(b, a), minus(c, a), minus(ray.origin, a));
        let p = cross(ray.direction, ac);
        let determinant = dot(ab, p);
        let (u, q) = (dot(from, p) / determinant, cross(from, ab));
        let (v, t) = (dot(ray.direction, q) / determinant, dot(ac, q) / determinant);
        if u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t >= 0.0 {
            found = (found.0 + 1, found.1.min(t));
        }
    }
    found
}

/// Hits and misses as of fine triangles, but where a ray nearly touches.
#[test]
fn rays_meet_what_triangles_do() {
    for case in cases() {
        let context = Context::serial();
        let tolerance = 1e-2;
        let options = TessellateOptions::new(Fineness::Chord(tolerance));
        let made = tessellate(&context, &case.surface, &case.positions, &options).unwrap();
        let corners = |t: &[u32; 3]| t.map(|v| made.positions[v as usize]);
        let triangles: Vec<_> = made.triangles.iter().map(corners).collect();
        let mut noise = Noise(5);
        let rays: Vec<Ray> = (0..120)
            .map(|_| {
                let origin = noise.point().map(|x| 4.0 * x);
                Ray::new(origin, minus(noise.point(), origin))
            })
            .collect();
        let hits = case.hits(&rays);
        let (mut same, mut hit) = (0, 0);
        for (ray, found) in rays.iter().zip(&hits) {
            let (count, first) = through(ray, &triangles);
            let speed = length(ray.direction);
            hit += usize::from(found.is_some());
            same += usize::from(match found {
                Some(found) => (found.t - first).abs() * speed < 20.0 * tolerance,
                None => count == 0,
            });
        }
        assert!(
            same >= rays.len() - 3 && hit >= 3,
            "{}: {same} of {}, {hit}",
            case.name,
            rays.len()
        );
        if closed(&case) {
            check_parity(&case, &triangles);
        }
    }
}

/// Hits one after the other are as many as say whether the ray began inside.
fn check_parity(case: &Case, triangles: &[[Point; 3]]) {
    let mut noise = Noise(17);
    let mut same = 0;
    for _ in 0..40 {
        let mut ray = Ray::new(noise.point(), noise.point());
        let (expected, _) = through(&ray, triangles);
        let mut count = 0;
        while let Some(hit) = case.hits(&[ray])[0] {
            count += 1;
            ray.range[0] = hit.t + 1e-7;
        }
        same += usize::from(count == expected);
    }
    assert!(same >= 38, "{}: {same} of 40", case.name);
}

#[test]
fn reach_and_range_leave_out_what_is_beyond() {
    let case = Case::new("cube", Shape::new(&bases::cube()), &Scheme::catmull_clark());
    let query = [0.1, 0.2, 9.0];
    let distance = case.closest(&[query])[0].distance;
    let context = Context::serial();
    let reaches =
        [(distance * 0.999, false), (distance * 1.001, true), (distance, true), (0.0, false)];
    for (reach, found) in reaches {
        let mut out = [None];
        case.search.closest(&context, &[query], reach, &mut out).unwrap();
        assert_eq!(out[0].is_some(), found, "{reach}");
        assert!(out[0].is_none_or(|closest| closest.distance <= reach));
    }
    let mut ray = Ray::new(query, [0.0, 0.0, -1.0]);
    let first = case.hits(&[ray])[0].unwrap();
    for (range, found) in [
        ([0.0, first.t * 0.999], false),
        ([0.0, first.t * 1.001], true),
        ([f64::NEG_INFINITY, f64::INFINITY], true),
        ([1.0, 0.0], false),
    ] {
        ray.range = range;
        assert_eq!(case.hits(&[ray])[0].is_some(), found, "{range:?}");
    }
    ray.range = [first.t * 1.001, f64::INFINITY];
    let second = case.hits(&[ray])[0].unwrap();
    assert!(second.t > first.t + 0.1, "{second:?}");
    (ray.direction, ray.range) = ([0.0, 0.0, 1.0], [0.0, f64::INFINITY]);
    assert!(case.hits(&[ray])[0].is_none());
}

/// A ray within a plane, and one that only touches a surface.
#[test]
fn tangent_rays_hit() {
    let mut grid = bases::grid(4, 3);
    for p in &mut grid.positions {
        p[2] = 0.0;
    }
    let scheme = Scheme::catmull_clark().with_boundary(Boundary::EdgeAndCorner);
    let plane = Case::new("plane", Shape::new(&grid), &scheme);
    let middle = plane.point(Sample { face: 5, sector: 0, u: 0.5, v: 0.5 });
    let ray = Ray::new([-20.0, middle[1], 0.0], [1.0, 0.0, 0.0]);
    let hit = plane.hits(&[ray])[0].expect("the ray runs within the plane");
    let low = grid.positions.iter().map(|p| p[0]).fold(f64::INFINITY, f64::min);
    assert!((hit.point[0] - low).abs() < 1e-9, "{hit:?}");
    // So narrowly across it that all of the plane counts as on it.
    for (lift, slope) in [(1e-13, 1e-14), (-1e-13, 1e-14), (1e-13, -1e-14), (0.0, 1e-15)] {
        let ray = Ray::new([-20.0, middle[1], lift - 20.0 * slope], [1.0, 0.0, slope]);
        let hit = plane.hits(&[ray])[0].expect("the ray runs along the plane");
        assert!((hit.point[0] - low).abs() < 1e-9, "{lift} {slope}: {hit:?}");
    }
    let cube = Case::new("cube", Shape::new(&bases::cube()), &Scheme::catmull_clark());
    let top = cube.point(Sample { face: 0, sector: 0, u: 0.5, v: 0.5 });
    let aside = [0, 1, 2].map(|k| if top[k].abs() > 0.1 { 0.0 } else { 1.0 });
    for (lift, hits) in [(1.0, true), (1.0 - 1e-6, true), (1.0 + 1e-6, false)] {
        let origin = [0, 1, 2].map(|k| lift * top[k] - 3.0 * aside[k]);
        let found = cube.hits(&[Ray::new(origin, aside)])[0];
        assert_eq!(found.is_some(), hits, "{lift}: {found:?} from {origin:?}");
    }
}

/// A plane in no special position, and rays at small angles to it through its inner edges.
#[test]
fn rays_at_small_angles_do_not_slip_through() {
    let unit = |p: Point| p.map(|x| x / length(p));
    let cross = |[a, b, c]: Point, [d, e, f]: Point| [b * f - c * e, c * d - a * f, a * e - b * d];
    let mut noise = Noise(11);
    let along = unit(noise.point());
    let across = unit(cross(along, noise.point()));
    let normal = cross(along, across);
    let place = |x: f64, y: f64| [0, 1, 2].map(|k| x * along[k] + y * across[k]);
    let mut grid = bases::grid(8, 8);
    grid.positions.iter_mut().for_each(|p| *p = place(p[0] / 8.0, p[1] / 8.0));
    let scheme = Scheme::catmull_clark().with_boundary(Boundary::EdgeAndCorner);
    let case = Case::new("plane", Shape::new(&grid), &scheme);
    for slope in [1e-4, 1e-6, 1e-7, 1e-8, 1e-10, 1e-12] {
        let rays: Vec<Ray> = (0..50)
            .map(|i| {
                let x = 0.2 + 0.3 * (noise.next() + 1.0);
                let p = if i % 2 == 0 { place(x, 0.5) } else { place(0.5, x) };
                let (sin, cos) = (3.0 * noise.next()).sin_cos();
                let [a, b] = [cos, sin];
                let d = [0, 1, 2].map(|k| a * along[k] + b * across[k] + slope * normal[k]);
                Ray::new([0, 1, 2].map(|k| p[k] - 0.1 * d[k]), d)
            })
            .collect();
        let hits = case.hits(&rays);
        assert!(hits.iter().all(Option::is_some), "{slope}: {hits:?}");
        check_on_rays(&rays, &hits);
    }
}

/// Every hit is on its ray.
#[track_caller]
fn check_on_rays(rays: &[Ray], hits: &[Option<Hit>]) {
    for (ray, hit) in rays.iter().zip(hits) {
        let Some(hit) = hit else { continue };
        let on = [0, 1, 2].map(|k| ray.origin[k] + hit.t * ray.direction[k]);
        assert!(length(minus(on, hit.point)) < EXACT, "{ray:?}: {hit:?}");
    }
}

/// Where a surface without polynomials turns, a part bends as far as it goes: it is no point.
#[test]
fn hits_where_a_surface_turns_are_on_their_rays() {
    let n = 8;
    let mut torus = bases::torus(n, n);
    for (i, p) in torus.positions.iter_mut().enumerate() {
        let sign = |odd: usize| if odd.is_multiple_of(2) { 1.0 } else { -1.0 };
        let (x, y) = (sign(i % n), 0.02 * sign(i / n));
        *p = [x + y, x - y, x];
    }
    let case = Case::new("turns", Shape::new(&torus), &three_point());
    let p = case.closest(&[[5.0; 3]])[0].point;
    let mut noise = Noise(21);
    let near = |d: Point, e: Point| [0, 1, 2].map(|k| p[k] - 3.0 * d[k] + 0.06 * p[2] * e[k]);
    let rays: Vec<Ray> = (0..40)
        .map(|_| {
            let (d, e) = (noise.point(), noise.point());
            Ray::new(near(d, e), d)
        })
        .collect();
    let hits = case.hits(&rays);
    assert!(hits.iter().flatten().count() > 3);
    check_on_rays(&rays, &hits);
}

#[test]
fn a_range_that_ends_before_it_begins_has_no_hit() {
    let case = Case::new("cube", Shape::new(&bases::cube()), &Scheme::catmull_clark());
    let down = Ray::new([0.1, 0.2, 3.0], [0.0, 0.0, -1.5]);
    let mut t = case.hits(&[down])[0].unwrap().t;
    for _ in 0..16 {
        assert_eq!(case.hits(&[Ray { range: [t.next_up(), t], ..down }]), [None]);
        t = t.next_up();
    }
}

#[test]
fn sizes_do_not_matter() {
    let case = Case::new("cube", Shape::new(&bases::cube()), &Scheme::catmull_clark());
    let queries = case.queries(8);
    let expected = case.closest(&queries);
    let rays: Vec<Ray> = queries.iter().map(|&q| Ray::new(q, [0.2, -0.3, 1.0])).collect();
    let hits = case.hits(&rays);
    for exponent in [-600, 600] {
        let factor = 2.0_f64.powi(exponent);
        let scaled = |p: Point| p.map(|x| x * factor);
        let context = Context::serial();
        let positions: Vec<f64> = case.positions.iter().map(|x| x * factor).collect();
        let search = Search::new(&context, &case.surface, &positions).unwrap();
        let points: Vec<Point> = queries.iter().map(|&q| scaled(q)).collect();
        let mut out = vec![None; points.len()];
        search.closest(&context, &points, f64::INFINITY, &mut out).unwrap();
        for (found, expected) in out.into_iter().zip(&expected) {
            let found = found.unwrap();
            assert_eq!(found.sample, expected.sample);
            assert_eq!(bits(found.point), bits(scaled(expected.point)));
            assert_eq!(found.distance.to_bits(), (expected.distance * factor).to_bits());
        }
        for shrink in [1.0, factor] {
            let rays: Vec<Ray> = rays
                .iter()
                .map(|ray| Ray::new(scaled(ray.origin), ray.direction.map(|x| x * shrink)))
                .collect();
            let mut out = vec![None; rays.len()];
            search.intersect(&context, &rays, &mut out).unwrap();
            for (found, expected) in out.iter().zip(&hits) {
                assert_eq!(found.map(|hit| hit.sample), expected.map(|hit| hit.sample));
                assert_eq!(found.map(|hit| hit.t), expected.map(|hit| hit.t * factor / shrink));
            }
        }
    }
}

#[test]
fn threads_change_nothing() {
    let case = Case::new("torus", Shape::new(&bases::torus(5, 4)), &three_point());
    let queries = case.queries(40);
    let rays: Vec<Ray> = queries.iter().map(|&q| Ray::new(q, [0.2, -0.3, 1.0])).collect();
    let (expected, hits) = (case.closest(&queries), case.hits(&rays));
    let context = Context::builder().threads(3).chunk(1).build().unwrap();
    let search = Search::new(&context, &case.surface, &case.positions).unwrap();
    let mut out = vec![None; queries.len()];
    search.closest(&context, &queries, f64::INFINITY, &mut out).unwrap();
    assert_eq!(out.into_iter().flatten().collect::<Vec<_>>(), expected);
    let mut out = vec![None; rays.len()];
    search.intersect(&context, &rays, &mut out).unwrap();
    assert_eq!(out, hits);
}

/// A surface that is one point, none, and one with a hole.
#[test]
fn degenerate_surfaces_have_answers() {
    let context = Context::serial();
    let mut cube = bases::cube();
    cube.positions.iter_mut().for_each(|p| *p = [0.5, -1.0, 2.0]);
    let case = Case::new("point", Shape::new(&cube), &Scheme::catmull_clark());
    let found = case.closest(&[[0.5, -1.0, 5.0], [0.5, -1.0, 2.0]]);
    assert!((found[0].distance - 3.0).abs() < EXACT && found[1].distance < EXACT);
    let rays = [
        Ray::new([0.5, -1.0, 5.0], [0.0, 0.0, -1.0]),
        Ray::new([0.5, -0.9, 5.0], [0.0, 0.0, -1.0]),
    ];
    let hits = case.hits(&rays);
    assert!((hits[0].unwrap().t - 3.0).abs() < EXACT && hits[1].is_none());
    cube.positions.iter_mut().for_each(|p| *p = [0.0; 3]);
    let case = Case::new("origin", Shape::new(&cube), &Scheme::catmull_clark());
    assert!((case.closest(&[[0.0, -3.0, 4.0]])[0].distance - 5.0).abs() < EXACT);

    let empty = Arc::new(Mesh::from_polygons(0, &[], &[]).unwrap());
    let surface = Arc::new(Surface::new(&context, &empty, &Scheme::catmull_clark()).unwrap());
    let search = Search::new::<f64>(&context, &surface, &[]).unwrap();
    let mut out = [None];
    search.closest(&context, &[[1.0; 3]], f64::INFINITY, &mut out).unwrap();
    assert_eq!(out, [None]);
    let mut out = [None];
    search.intersect(&context, &[Ray::new([1.0; 3], [1.0; 3])], &mut out).unwrap();
    assert_eq!(out, [None]);

    let plain = bases::cube();
    let whole = Case::new("cube", Shape::new(&plain), &Scheme::catmull_clark());
    let options = BuildOptions { holes: &[0], ..BuildOptions::default() };
    let case = Case::new("hole", Shape::with(&plain, &options), &Scheme::catmull_clark());
    let middle = whole.point(Sample { face: 0, sector: 0, u: 0.5, v: 0.5 });
    assert!(whole.closest(&[middle])[0].distance < EXACT);
    let found = case.closest(&[middle])[0];
    assert!(found.distance > 0.1 && found.sample.face != 0, "{found:?}");
}

/// Where a surface has no area the places that have one point are curves in it.
#[test]
fn surfaces_without_area_have_answers() {
    for (scheme, expected) in [(Scheme::catmull_clark(), EXACT), (three_point(), 1e-9)] {
        let mut grid = bases::grid(4, 3);
        grid.positions.iter_mut().for_each(|p| *p = [p[0], 0.0, 0.0]);
        let case = Case::new("line", Shape::new(&grid), &scheme);
        let [low, high] = [f64::min, f64::max]
            .map(|pick| grid.positions.iter().map(|p| p[0]).reduce(pick).unwrap());
        let x = 0.4 * low + 0.6 * high;
        let found = case.closest(&[[x, 0.3, -0.4], [x, 0.0, 0.0]]);
        assert!((found[0].distance - 0.5).abs() < expected, "{found:?}");
        assert!(found[1].distance < expected, "{found:?}");
        let across = Ray::new([x, -1.0, 0.0], [0.0, 1.0, 0.0]);
        let beside = Ray::new([x, -1.0, 0.1], [0.0, 1.0, 0.0]);
        let within = Ray::new([low - 1.0, 0.0, 0.0], [1.0, 0.0, 0.0]);
        let hits = case.hits(&[across, beside, within]);
        for hit in [hits[0], hits[2]] {
            assert!((hit.unwrap().t - 1.0).abs() < expected, "{hits:?}");
        }
        assert_eq!(hits[1], None);
        if expected == EXACT {
            // No bound tells its places apart: tolerances grow until it ends.
            let hit = case.hits(&[Ray::new([x - 1.0, -1.0, 0.0], [1.0, 1.0, 0.0])])[0].unwrap();
            assert!((hit.t - 1.0).abs() < 1e-5, "{hit:?}");
        }
    }
}

fn kind<T: std::fmt::Debug>(result: carvel::Result<T>, text: &str) -> ErrorKind {
    let error = result.unwrap_err();
    assert!(error.to_string().contains(text), "{error}");
    error.kind()
}

#[test]
fn bad_queries_are_refused() {
    let case = Case::new("cube", Shape::new(&bases::cube()), &Scheme::catmull_clark());
    let context = Context::serial();
    let closest = |points: &[Point], reach: f64| {
        let mut out = vec![None; points.len()];
        case.search.closest(&context, points, reach, &mut out)
    };
    let bad = [[0.0; 3], [0.0, f64::NAN, 0.0], [f64::INFINITY, 0.0, 0.0]];
    assert_eq!(kind(closest(&bad, 1.0), "point 1 "), ErrorKind::NotFinite);
    assert_eq!(kind(closest(&[[1e150; 3]], 1.0), "point 0 "), ErrorKind::ParameterOutOfRange);
    for reach in [f64::NAN, -1.0] {
        assert_eq!(kind(closest(&bad[..1], reach), "reach"), ErrorKind::ParameterOutOfRange);
    }
    let two = case.search.closest(&context, &bad[..1], 1.0, &mut [None; 2]);
    assert_eq!(kind(two, "2 results of 1"), ErrorKind::LengthMismatch);
    let intersect = |ray: Ray| {
        let rays = [Ray::new([0.0; 3], [1.0; 3]), ray];
        case.search.intersect(&context, &rays, &mut [None; 2])
    };
    let good = Ray::new([0.0; 3], [1.0; 3]);
    let zero = intersect(Ray { direction: [0.0; 3], ..good });
    assert_eq!(kind(zero, "ray 1 has a direction of zero"), ErrorKind::ParameterOutOfRange);
    let nan = f64::NAN;
    for ray in [
        Ray { direction: [0.0, nan, 0.0], ..good },
        Ray { origin: [0.0, nan, 0.0], ..good },
        Ray { range: [0.0, nan], ..good },
    ] {
        assert_eq!(kind(intersect(ray), "ray 1 has"), ErrorKind::NotFinite);
    }
}

#[test]
fn surfaces_that_cannot_be_searched_are_refused() {
    let context = Context::serial();
    let shape = Shape::new(&bases::grid(4, 3));
    let scheme = Scheme::doo_sabin().with_boundary(Boundary::None);
    let surface = Arc::new(shape.surface(&scheme));
    let mut positions = vec![0.0; 3 * shape.mesh.vertices()];
    let refused = Search::new(&context, &surface, &positions);
    assert_eq!(kind(refused, "face"), ErrorKind::Unsupported);
    let case = Case::new("cube", Shape::new(&bases::cube()), &Scheme::catmull_clark());
    positions.truncate(23);
    let refused = Search::new(&context, &case.surface, &positions);
    assert_eq!(kind(refused, "23 numbers"), ErrorKind::LengthMismatch);
    positions.push(f64::NAN);
    let refused = Search::new(&context, &case.surface, &positions);
    assert_eq!(kind(refused, "vertex 7"), ErrorKind::NotFinite);
    let poor = Context::builder().memory_ceiling(10_000).build().unwrap();
    let refused = Search::new(&poor, &case.surface, &case.positions);
    assert_eq!(kind(refused, "ceiling"), ErrorKind::MemoryCeiling);
    context.cancel();
    let refused = Search::new(&context, &case.surface, &case.positions);
    assert_eq!(kind(refused, "cancelled"), ErrorKind::Cancelled);
    let refused = case.search.closest(&context, &[[0.0; 3]], 1.0, &mut [None]);
    assert_eq!(kind(refused, "cancelled"), ErrorKind::Cancelled);
}

/// What docs/search.md says of the time of queries.
#[test]
#[ignore = "prints times, of use with optimisation only"]
fn queries_are_timed() {
    let torus = || Shape::new(&bases::torus(16, 8));
    let cube = || Shape::new(&bases::cube());
    let (catmull_clark, three_point) = (Scheme::catmull_clark(), three_point());
    for (name, shape, scheme) in [
        ("torus, catmull-clark", torus(), &catmull_clark),
        ("cube, catmull-clark", cube(), &catmull_clark),
        ("torus, three-point", torus(), &three_point),
        ("cube, three-point", cube(), &three_point),
    ] {
        let case = Case::new(name, shape, scheme);
        let mut noise = Noise(3);
        let anywhere: Vec<Point> = (0..500).map(|_| noise.point().map(|x| 1.5 * x)).collect();
        let on = case.closest(&anywhere);
        let nudged = |c: &Closest| [0, 1, 2].map(|k| c.point[k] + 1e-3 * noise.next());
        let near: Vec<Point> = on.iter().map(nudged).collect();
        let through = |(p, c): (&Point, &Closest)| Ray::new(*p, minus(c.point, *p));
        let rays: Vec<Ray> = anywhere.iter().zip(&on).map(through).collect();
        let micros = |work: &dyn Fn()| {
            let mut times: Vec<f64> = (0..5)
                .map(|_| {
                    let start = Instant::now();
                    work();
                    start.elapsed().as_secs_f64() * 1e6 / anywhere.len() as f64
                })
                .collect();
            times.sort_by(f64::total_cmp);
            times[2]
        };
        println!(
            "{name}: anywhere {:.1} us, near {:.1} us, rays {:.1} us",
            micros(&|| drop(case.closest(&anywhere))),
            micros(&|| drop(case.closest(&near))),
            micros(&|| drop(case.hits(&rays))),
        );
    }
}

/// At a small angle a root may be far beyond the end of a range, and the surface still near to it.
#[test]
fn ends_of_ranges_meet_what_is_near() {
    let mut grid = bases::grid(4, 3);
    for p in &mut grid.positions {
        p[2] = 0.0;
    }
    let scheme = Scheme::catmull_clark().with_boundary(Boundary::EdgeAndCorner);
    let plane = Case::new("plane", Shape::new(&grid), &scheme);
    let [x, y, _] = plane.point(Sample { face: 5, sector: 0, u: 0.3, v: 0.4 });
    for slope in [1e-3, 1e-5, 1e-6, 1e-8] {
        for lift in [1e-13, -1e-13] {
            // It has come through, or would later on.
            let on = Ray::new([x, y, lift], [1.0, 0.1, slope]);
            for range in [[0.0, f64::INFINITY], [f64::NEG_INFINITY, 0.0], [0.0, 0.0]] {
                let ray = Ray { range, ..on };
                let hit = plane.hits(&[ray])[0].unwrap_or_else(|| panic!("{ray:?}"));
                assert!((hit.point[0] - x - hit.t).abs() < EXACT, "{ray:?}: {hit:?}");
            }
            let apart = Ray { origin: [x, y, 1e3 * lift], range: [0.0, 0.0], ..on };
            assert_eq!(plane.hits(&[apart])[0], None);
        }
    }
}
