//! Triangles within a tolerance: distances by samples, cracks, counts, refusals.

use super::{
    Poly, Shape, bases, closed_meshes, open_meshes, primal_schemes, quad_schemes, with_boundaries,
};
use carvel::limit::{
    Derivatives, Fineness, Sample, Screen, Surface, TessellateOptions, Tessellation, tessellate,
};
use carvel::mesh::BuildOptions;
use carvel::{Boundary, Context, Crease, Element, Error, ErrorKind, Fraction, Mesh, Scheme};
use std::collections::HashMap;

fn positions(shape: &Shape) -> Vec<f64> {
    shape.values.chunks(super::WIDTH).flat_map(|record| &record[..3]).copied().collect()
}

fn made(
    shape: &Shape,
    scheme: &Scheme,
    options: &TessellateOptions,
) -> Result<Tessellation, Error> {
    let surface = Surface::new(&Context::serial(), &shape.mesh, scheme)?;
    tessellate(&Context::serial(), &surface, &positions(shape), options)
}

fn chord(tolerance: f64) -> TessellateOptions {
    TessellateOptions::new(Fineness::Chord(tolerance))
}

/// The triangles as a mesh of their own.
fn mesh(of: &Tessellation) -> Mesh {
    let sizes = vec![3; of.triangles.len()];
    Mesh::from_polygons(of.positions.len(), &sizes, of.triangles.as_flattened()).expect("a mesh")
}

fn euler(mesh: &Mesh) -> i64 {
    let isolated = (0..mesh.vertices()).filter(|&v| mesh.valence(v) == 0).count();
    (mesh.vertices() - isolated + mesh.faces()) as i64 - mesh.edges() as i64
}

fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|k| a[k] - b[k])
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// The square of the distance from a triangle: by its regions (Ericson 2004, 5.1.5), and so
/// another way than the kernel's.
fn from_triangle(p: [f64; 3], [a, b, c]: [[f64; 3]; 3]) -> f64 {
    let (ab, ac) = (minus(b, a), minus(c, a));
    let to = |q: [f64; 3]| dot(minus(p, q), minus(p, q));
    let along = |from: [f64; 3], by: [f64; 3], t: f64| [0, 1, 2].map(|k| from[k] + t * by[k]);
    let [d1, d2] = [ab, ac].map(|e| dot(e, minus(p, a)));
    let [d3, d4] = [ab, ac].map(|e| dot(e, minus(p, b)));
    let [d5, d6] = [ab, ac].map(|e| dot(e, minus(p, c)));
    let (va, vb, vc) = (d3 * d6 - d5 * d4, d5 * d2 - d1 * d6, d1 * d4 - d3 * d2);
    if d1 <= 0.0 && d2 <= 0.0 {
        to(a)
    } else if d3 >= 0.0 && d4 <= d3 {
        to(b)
    } else if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        to(along(a, ab, d1 / (d1 - d3)))
    } else if d6 >= 0.0 && d5 <= d6 {
        to(c)
    } else if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        to(along(a, ac, d2 / (d2 - d6)))
    } else if va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0 {
        to(along(b, minus(c, b), (d4 - d3) / ((d4 - d3) + (d5 - d6))))
    } else {
        let sum = va + vb + vc;
        to(along(along(a, ab, vb / sum), ac, vc / sum))
    }
}

/// Points that follow no pattern, in the unit square.
fn scattered(count: usize) -> impl Iterator<Item = [f64; 2]> {
    // Steps of the golden ratio's kin (Roberts 2018).
    let fraction = |x: f64| x - x.floor();
    let point =
        move |i: usize| [0.754_877_666, 0.569_840_291].map(|a| fraction(0.5 + a * i as f64));
    (1..=count).map(point)
}

/// The largest distance of samples of the surface from the triangles.
fn farthest(shape: &Shape, scheme: &Scheme, of: &Tessellation, count: usize) -> f64 {
    let surface = shape.surface(scheme);
    let positions = positions(shape);
    let mut by_part: HashMap<(u32, u32), Vec<usize>> = HashMap::new();
    for (i, places) in of.triangle_places.iter().enumerate() {
        let Sample { face, sector, .. } = of.places[places[0] as usize];
        by_part.entry((face, sector)).or_default().push(i);
    }
    let distance =
        |p: [f64; 3], i: usize| from_triangle(p, of.triangles[i].map(|v| of.positions[v as usize]));
    let mut farthest: f64 = 0.0;
    for (&(face, sector), triangles) in &by_part {
        let is_loop = scheme.split() == carvel::SplitKind::Triangle;
        for (i, [u, v]) in scattered(count).enumerate() {
            let [u, v] = if is_loop && u + v > 1.0 { [1.0 - u, 1.0 - v] } else { [u, v] };
            // Some near corners, where features are.
            let near = 0.5_f64.powi(3 * (i % 4) as i32);
            let [u, v] = match i % 8 {
                4..8 if !is_loop => [1.0 - near * u, 1.0 - near * v],
                _ => [near * u, near * v],
            };
            let sample = Sample { face, sector, u, v };
            let mut p = [0.0; 3];
            let evaluated = surface.evaluate(
                &Context::serial(),
                &[sample],
                &positions,
                3,
                Derivatives::None,
                &mut p,
            );
            evaluated.expect("a point");
            let holds = |&&i: &&usize| {
                let at = of.triangle_places[i].map(|place| of.places[place as usize]);
                let within =
                    |x: f64, of: [f64; 3]| of.iter().any(|&y| y <= x) && of.iter().any(|&y| y >= x);
                within(u, at.map(|s| s.u)) && within(v, at.map(|s| s.v))
            };
            let nearest = |of: &mut dyn Iterator<Item = usize>| {
                of.map(|i| distance(p, i)).fold(f64::INFINITY, f64::min).sqrt()
            };
            let here = nearest(&mut triangles.iter().filter(holds).copied());
            if here > farthest {
                // Another triangle may be nearer than that with the same coordinates.
                farthest = farthest.max(nearest(&mut (0..of.triangles.len())));
            }
        }
    }
    farthest
}

/// A cube, drawn out, so that its surface is bent here and nearly flat there.
fn cigar() -> Shape {
    let mut torus = bases::torus(8, 6);
    for p in &mut torus.positions {
        p[0] *= 4.0;
    }
    Shape::new(&torus)
}

fn three_point() -> Scheme {
    Scheme::three_point(Fraction::new(1, 32).unwrap()).unwrap()
}

/// Meshes like a sphere and like a torus with schemes for them.
fn smooth() -> Vec<(&'static str, Shape, Scheme)> {
    vec![
        ("cube, catmull-clark", Shape::new(&bases::cube()), Scheme::catmull_clark()),
        ("octahedron, loop", Shape::new(&bases::octahedron()), Scheme::loop_triangles()),
        ("cube, three-point", Shape::new(&bases::cube()), three_point()),
        ("dodecahedron, doo-sabin", Shape::new(&bases::dodecahedron()), Scheme::doo_sabin()),
        ("torus, catmull-clark", cigar(), Scheme::catmull_clark()),
        ("torus, quartic", cigar(), Scheme::quartic()),
    ]
}

/// Samples are near the triangles, and their bound is one.
fn check_distance((name, shape, scheme): &(&str, Shape, Scheme), tolerance: f64, count: usize) {
    let of = made(shape, scheme, &chord(tolerance)).unwrap();
    let found = farthest(shape, scheme, &of, count);
    let (triangles, bound) = (of.triangles.len(), of.measure);
    println!("{name}, {tolerance}: {triangles} triangles, {found:.1e} away, bound {bound:.1e}");
    assert!(found <= bound && bound <= tolerance, "{name}: {found}, {bound} for {tolerance}");
    assert!(of.coarse == 0 && found > tolerance / 20.0, "{name}: {found} for {tolerance}");
}

#[test]
fn no_sample_is_farther_than_the_tolerance() {
    for of in smooth() {
        check_distance(&of, 1e-1, 64);
        check_distance(&of, 1e-2, 32);
    }
    check_distance(&smooth()[0], 1e-3, 32);
    check_distance(&smooth()[1], 1e-3, 32);
}

/// By powers of two every number scales exactly, far beyond where squares leave the range.
#[test]
fn size_does_not_matter() {
    let shape = Shape::new(&bases::cube());
    let surface = Surface::new(&Context::serial(), &shape.mesh, &Scheme::catmull_clark()).unwrap();
    let of_size = |size: f64| {
        let positions: Vec<f64> = positions(&shape).iter().map(|x| x * size).collect();
        tessellate(&Context::serial(), &surface, &positions, &chord(0.1 * size)).unwrap()
    };
    let usual = of_size(1.0);
    assert!(usual.measure > 0.0);
    for size in [2.0_f64.powi(-560), 2.0_f64.powi(600), 2.0_f64.powi(1022)] {
        let scaled = of_size(size);
        assert_eq!(scaled.triangles, usual.triangles, "{size}");
        assert_eq!(scaled.normals, usual.normals, "{size}");
        assert_eq!(scaled.measure.to_bits(), (usual.measure * size).to_bits());
        let points = usual.positions.iter().map(|p| p.map(|x| x * size));
        assert!(points.eq(scaled.positions), "{size}");
    }
}

/// The table of docs/tessellation.md: up to millions of triangles, beside equal steps.
#[test]
#[ignore = "takes minutes without optimisation"]
fn no_sample_is_farther_than_a_small_tolerance() {
    for of in smooth() {
        for (tolerance, count) in [(1e-2, 256), (1e-3, 64), (1e-4, 16)] {
            check_distance(&of, tolerance, count);
            let (equal, bound) = by_equal_steps(&of.1, &of.2, tolerance);
            println!("    {equal} by equal steps, bound {bound:.1e}");
        }
    }
}

/// How many triangles it takes if all faces are halved as often, until samples are near enough, and
/// the bound that they have: around extraordinary vertices it is what equal steps never bring down.
fn by_equal_steps(shape: &Shape, scheme: &Scheme, tolerance: f64) -> (usize, f64) {
    let steps = (0..12).map(|levels| {
        let all = chord(f64::MIN_POSITIVE);
        let equal = made(shape, scheme, &TessellateOptions { levels, ..all }).unwrap();
        (farthest(shape, scheme, &equal, 16), equal.triangles.len(), equal.measure)
    });
    let found = steps.into_iter().find(|&(far, ..)| far <= tolerance).expect("a level");
    (found.1, found.2)
}

/// No cracks: closed if the control mesh is, of the same genus, with boundaries where it has some.
#[test]
fn triangles_hang_together_as_faces_do() {
    let check = |shape: &Shape, scheme: &Scheme, tolerance: f64| {
        let made = made(shape, scheme, &chord(tolerance)).unwrap();
        let triangles = mesh(&made);
        let what = format!("{scheme:?}, {} faces, {tolerance}", shape.mesh.faces());
        assert_eq!(triangles.is_closed(), shape.mesh.is_closed(), "{what}");
        assert_eq!(euler(&triangles), euler(&shape.mesh), "{what}");
        assert!((0..triangles.vertices()).all(|v| triangles.valence(v) > 0), "{what}");
        let corners = made.triangles.iter().flatten().zip(made.triangle_places.iter().flatten());
        for (&v, &place) in corners {
            assert_eq!(made.place_vertices[place as usize], v, "{what}");
        }
        for (&face, places) in made.faces.iter().zip(&made.triangle_places) {
            let faces = places.map(|place| made.places[place as usize].face);
            assert_eq!(faces, [face; 3], "{what}");
        }
    };
    for tolerance in [10.0, 0.2] {
        for scheme in quad_schemes() {
            for of in closed_meshes() {
                check(&Shape::new(&of), &scheme, tolerance);
            }
        }
        for scheme in primal_schemes() {
            check(&Shape::new(&bases::pillow(5)), &scheme, tolerance);
        }
        for of in [bases::tetrahedron(), bases::octahedron(), bases::bipyramid(7)] {
            check(&Shape::new(&of), &Scheme::loop_triangles(), tolerance);
            check(&Shape::creased(&of), &Scheme::loop_triangles(), tolerance);
        }
        for of in [bases::cube(), bases::torus(5, 4), bases::grid(3, 3)] {
            check(&Shape::creased(&of), &Scheme::catmull_clark(), tolerance);
        }
        for of in open_meshes().into_iter().chain([bases::valence_two()]) {
            let primal = [Scheme::catmull_clark(), Scheme::bilinear()];
            for scheme in primal.iter().flat_map(with_boundaries) {
                check(&Shape::new(&of), &scheme, tolerance);
            }
        }
        for scheme in [Scheme::doo_sabin(), three_point()].iter().flat_map(with_boundaries) {
            check(&Shape::new(&bases::annulus(6, 4)), &scheme, tolerance);
            if scheme.boundary() == Boundary::EdgeAndCorner {
                check(&Shape::new(&bases::grid(4, 3)), &scheme, tolerance);
            }
        }
    }
}

/// Two quads that share three vertices have a diagonal in common.
#[test]
fn flat_quads_are_two_triangles_unless_they_are_folded() {
    let triangles = |of: &Poly<f64>| {
        let made = made(&Shape::new(of), &Scheme::bilinear(), &chord(10.0)).unwrap();
        mesh(&made).faces()
    };
    assert_eq!(triangles(&bases::cube()), 12);
    assert_eq!(triangles(&bases::pillow(4)), 16);
}

/// Flat faces are cut once, whatever the coordinates in them do.
#[test]
fn what_is_flat_stays_coarse() {
    let cube = Shape::new(&bases::cube());
    let edges: Vec<Crease> =
        cube.mesh.edge_vertices().map(|vertices| Crease { vertices, sharpness: 10.0 }).collect();
    let sharp =
        Shape::with(&bases::cube(), &BuildOptions { creases: &edges, ..BuildOptions::default() });
    let of = made(&sharp, &Scheme::catmull_clark(), &chord(1e-6)).unwrap();
    assert_eq!((of.triangles.len(), of.coarse), (12, 0));
    let mut uneven = bases::grid(3, 3);
    for p in &mut uneven.positions {
        *p = [p[0] * p[0] * p[0] + p[1], p[1] * p[1], 0.0];
    }
    let curved = made(&Shape::new(&uneven), &Scheme::bilinear(), &chord(1e-6)).unwrap();
    assert_eq!(curved.triangles.len(), 18);
}

/// Uniform refinement comes to a tolerance by its worst face.
#[test]
fn fewer_triangles_than_by_equal_steps() {
    // A sharp tip, and much that is nearly flat.
    let mut grid = bases::grid(8, 8);
    for p in &mut grid.positions {
        let far = (p[0] - 4.0) * (p[0] - 4.0) + (p[1] - 4.0) * (p[1] - 4.0);
        p[2] = 3.0 / (1.0 + far * far);
    }
    let shape = Shape::new(&grid);
    let scheme = Scheme::catmull_clark();
    for tolerance in [1e-2, 3e-3] {
        let adaptive = made(&shape, &scheme, &chord(tolerance)).unwrap();
        let (equal, _) = by_equal_steps(&shape, &scheme, tolerance);
        println!("{tolerance}: {} triangles, {equal} by equal steps", adaptive.triangles.len());
        assert!(adaptive.triangles.len() < equal, "{tolerance}");
        assert!(farthest(&shape, &scheme, &adaptive, 16) <= tolerance);
    }
}

#[test]
fn the_same_at_any_number_of_threads() {
    let (creased, plain) = (Shape::creased(&bases::prism(5)), Shape::new(&bases::prism(5)));
    for (shape, scheme) in [
        (&creased, Scheme::catmull_clark()),
        (&plain, Scheme::doo_sabin()),
        (&plain, three_point()),
    ] {
        let surface = shape.surface(&scheme);
        let run = |threads| {
            let context = Context::builder().threads(threads).chunk(7).build().unwrap();
            tessellate(&context, &surface, &positions(shape), &chord(3e-3)).unwrap()
        };
        assert!(run(1) == run(3) && run(1) == made(shape, &scheme, &chord(3e-3)).unwrap());
    }
}

/// Looks along −z at what lies around the origin.
fn screen(distance: f64) -> Screen {
    let matrix = [
        [2.0, 0.0, 0.0, 0.0],
        [0.0, 2.0, 0.0, 0.0],
        [0.0, 0.0, -1.0, distance - 0.5],
        [0.0, 0.0, -1.0, distance],
    ];
    Screen { matrix, viewport: [400.0, 300.0] }
}

#[test]
fn edges_in_view_are_no_longer_than_asked() {
    for (shape, scheme) in [
        (Shape::new(&bases::cube()), Scheme::catmull_clark()),
        (Shape::new(&bases::octahedron()), Scheme::loop_triangles()),
        (Shape::new(&bases::prism(5)), three_point()),
    ] {
        let pixels = |distance| {
            let options = TessellateOptions::new(Fineness::Pixels(8.0, screen(distance)));
            made(&shape, &scheme, &options).unwrap()
        };
        let of = pixels(4.0);
        let to_pixel = |v: u32| {
            let [x, y, z] = of.positions[v as usize];
            let w = 4.0 - z;
            [2.0 * x / w * 200.0, 2.0 * y / w * 150.0]
        };
        let mut longest: f64 = 0.0;
        for &[a, b, c] in &of.triangles {
            for (from, to) in [(a, b), (b, c), (c, a)] {
                let (p, q) = (to_pixel(from), to_pixel(to));
                longest = longest.max((p[0] - q[0]).hypot(p[1] - q[1]));
            }
        }
        assert!(longest <= 8.0 && of.coarse == 0, "{longest}");
        assert!((longest - of.measure).abs() < 1e-9, "{longest} {}", of.measure);
        assert!(longest > 4.0, "{longest}");
        assert_eq!(euler(&mesh(&of)), 2);
        assert!(pixels(40.0).triangles.len() < of.triangles.len() / 8);
        // Behind the eye nothing is seen.
        assert!(pixels(-40.0).triangles.len() <= 60);
    }
}

/// No chord of the whole is in view, nor one of its quarters.
#[test]
fn what_only_its_inside_is_seen_of_is_fine_there() {
    let shape = Shape::new(&bases::grid(1, 1));
    let scheme = Scheme::primal(&[]).unwrap();
    let surface = Surface::new(&Context::serial(), &shape.mesh, &scheme).unwrap();
    let square: Vec<f64> = shape
        .mesh
        .face_vertices(0)
        .iter()
        .zip([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
        .fold(vec![0.0; 12], |mut all, (&v, [x, y])| {
            all[3 * v as usize..][..2].copy_from_slice(&[x, y]);
            all
        });
    // From straight above, a thousandth of the side to either side of a point.
    let [x, y] = [0.4, 0.17];
    let matrix = [
        [1e3, 0.0, 0.0, -1e3 * x],
        [0.0, 1e3, 0.0, -1e3 * y],
        [0.0, 0.0, 1.0, 0.0],
        [0.0, 0.0, 0.0, 1.0],
    ];
    let fineness = Fineness::Pixels(30.0, Screen { matrix, viewport: [100.0, 100.0] });
    let options = TessellateOptions::new(fineness);
    let of = tessellate(&Context::serial(), &surface, &square, &options).unwrap();
    let longest_at = |at: [f64; 2]| {
        let corners = |t: &[u32; 3]| t.map(|v| of.positions[v as usize]);
        let holds = |t: &&[u32; 3]| {
            let [a, b, c] = corners(t);
            [[a, b], [b, c], [c, a]].iter().all(|[p, q]| {
                (q[0] - p[0]) * (at[1] - p[1]) - (q[1] - p[1]) * (at[0] - p[0]) >= -1e-12
            })
        };
        let [a, b, c] = corners(of.triangles.iter().find(holds).expect("a triangle"));
        let length = |p: [f64; 3], q: [f64; 3]| 5e4 * (p[0] - q[0]).hypot(p[1] - q[1]);
        length(a, b).max(length(b, c)).max(length(c, a))
    };
    for [i, j] in [[0, 0], [9, 9], [-9, 9], [9, -9], [-5, -9]] {
        let at = [x + 1e-4 * f64::from(i), y + 1e-4 * f64::from(j)];
        assert!(longest_at(at) <= 30.0, "{at:?}: {}", longest_at(at));
    }
    assert!(of.measure > 15.0 && of.measure <= 30.0 && of.coarse == 0, "{}", of.measure);
    assert!(of.triangles.len() < 1500, "{}", of.triangles.len());
}

#[test]
fn normals_are_the_surface_s() {
    let shape = Shape::new(&bases::dodecahedron());
    for scheme in [Scheme::catmull_clark(), Scheme::doo_sabin(), three_point()] {
        let of = made(&shape, &scheme, &chord(1e-2)).unwrap();
        let surface = shape.surface(&scheme);
        let of_places = |v: u32| {
            let here = of.place_vertices.iter().zip(&of.normals).filter(move |(w, _)| **w == v);
            here.map(|(_, normal)| *normal)
        };
        for &[a, b, c] in &of.triangles {
            let [p, q, r] = [a, b, c].map(|v| of.positions[v as usize]);
            let area = cross(minus(q, p), minus(r, p));
            let length = dot(area, area).sqrt();
            for normal in of_places(a) {
                assert!((dot(normal, normal) - 1.0).abs() < 1e-12);
                assert!(dot(normal, area) > 0.8 * length, "{scheme:?}");
            }
            assert!(of_places(a).all(|normal| Some(normal) == of_places(a).next()));
        }
        for (place, normal) in of.places.iter().zip(&of.normals).skip(7).step_by(13) {
            let mut record = [0.0; 9];
            let done = surface.evaluate(
                &Context::serial(),
                &[*place],
                &positions(&shape),
                3,
                Derivatives::First,
                &mut record,
            );
            if done.is_err() {
                continue;
            }
            let [u, v] = [3, 6].map(|k| [record[k], record[k + 1], record[k + 2]]);
            let expected = cross(u, v);
            let length = dot(expected, expected).sqrt();
            assert!(length == 0.0 || dot(expected, *normal) > (1.0 - 1e-6) * length);
        }
    }
}

#[test]
fn sharp_edges_have_two_normals() {
    let of = made(&Shape::new(&bases::cube()), &Scheme::bilinear(), &chord(1.0)).unwrap();
    // The prism's faces are square to each other: no two of a vertex's normals agree.
    assert_eq!((of.positions.len(), of.places.len()), (8, 24));
    for (i, (v, normal)) in of.place_vertices.iter().zip(&of.normals).enumerate() {
        for (w, other) in of.place_vertices.iter().zip(&of.normals).skip(i + 1) {
            assert!(v != w || dot(*normal, *other).abs() < 1e-12);
        }
    }
}

#[test]
fn what_has_no_surface_is_left_out_or_refused() {
    let options = BuildOptions { holes: &[2], ..BuildOptions::default() };
    let shape = Shape::with(&bases::cube(), &options);
    let of = made(&shape, &Scheme::catmull_clark(), &chord(0.1)).unwrap();
    assert!(!of.faces.contains(&2) && of.faces.contains(&3) && of.missing == 0);
    assert_eq!(euler(&mesh(&of)), 1);
    let open = Shape::new(&bases::grid(4, 4));
    let inner = Scheme::doo_sabin().with_boundary(Boundary::None);
    let error = made(&open, &inner, &chord(0.1)).expect_err("an error");
    assert_eq!(error.kind(), ErrorKind::Unsupported);
    assert!(matches!(error.elements(), [Element::Face(_)]));
    let partial = TessellateOptions { partial: true, ..chord(0.1) };
    let of = made(&open, &inner, &partial).unwrap();
    // All faces with a vertex on the boundary.
    assert_eq!(of.missing, 16 - 4);
    assert_eq!(euler(&mesh(&of)), 1);
}

#[test]
fn options_positions_and_limits_are_checked() {
    let shape = Shape::new(&bases::cube());
    let surface = shape.surface(&Scheme::catmull_clark());
    let serial = Context::serial();
    let kind = |context: &Context, positions: &[f64], options: &TessellateOptions| {
        tessellate(context, &surface, positions, options).expect_err("an error").kind()
    };
    let good = positions(&shape);
    let mut bad: Vec<TessellateOptions> = [0.0, -1.0, f64::NAN, f64::INFINITY].map(chord).to_vec();
    bad.push(TessellateOptions { levels: 25, ..chord(0.1) });
    bad.push(TessellateOptions::new(Fineness::Pixels(0.0, screen(4.0))));
    for strange in [
        Screen { viewport: [0.0, 10.0], ..screen(4.0) },
        Screen { viewport: [10.0, f64::NAN], ..screen(4.0) },
        Screen { matrix: [[f64::NAN; 4]; 4], ..screen(4.0) },
    ] {
        bad.push(TessellateOptions::new(Fineness::Pixels(1.0, strange)));
    }
    for options in bad {
        assert_eq!(kind(&serial, &good, &options), ErrorKind::ParameterOutOfRange, "{options:?}");
    }
    assert_eq!(kind(&serial, &good[1..], &chord(0.1)), ErrorKind::LengthMismatch);
    let mut wrong = good.clone();
    wrong[7] = f64::NAN;
    let error = tessellate(&serial, &surface, &wrong, &chord(0.1)).expect_err("an error");
    assert_eq!((error.kind(), error.elements()), (ErrorKind::NotFinite, &[Element::Vertex(2)][..]));

    let needed = tessellate(&serial, &surface, &good, &chord(1e-3)).unwrap().triangles.len() as u64;
    let most = |triangles| TessellateOptions { triangles, ..chord(1e-3) };
    assert!(tessellate(&serial, &surface, &good, &most(needed)).is_ok());
    assert_eq!(kind(&serial, &good, &most(needed - 1)), ErrorKind::TooLarge);
    assert_eq!(kind(&serial, &good, &most(100)), ErrorKind::TooLarge);
    let small = Context::builder().memory_ceiling(100_000).build().unwrap();
    assert_eq!(kind(&small, &good, &chord(1e-3)), ErrorKind::MemoryCeiling);
    // No cell is fine enough before there are millions: those still to be looked at count as well.
    let hard = shape.surface(&three_point());
    let fine = TessellateOptions { triangles: 1000, ..chord(1e-11) };
    let kind_of = |context: &Context, options: &TessellateOptions| {
        tessellate(context, &hard, &good, options).expect_err("an error").kind()
    };
    assert_eq!(kind_of(&serial, &fine), ErrorKind::TooLarge);
    assert_eq!(kind_of(&small, &chord(1e-11)), ErrorKind::MemoryCeiling);
    serial.cancel();
    assert_eq!(kind(&serial, &good, &chord(0.1)), ErrorKind::Cancelled);
    let stopped = Context::builder().progress(|done| done < 0.5).build().unwrap();
    assert_eq!(kind(&stopped, &good, &chord(0.1)), ErrorKind::Cancelled);
}

/// Around an extraordinary vertex no level suffices for second derivatives.
#[test]
fn levels_are_bounded_and_what_they_leave_is_told() {
    let shape = Shape::new(&bases::bipyramid(12));
    let scheme = Scheme::loop_triangles();
    let rough = TessellateOptions { levels: 2, ..chord(1e-6) };
    let of = made(&shape, &scheme, &rough).unwrap();
    assert_eq!(of.triangles.len(), 24 * 16);
    assert!(of.coarse > 0 && of.measure > 1e-6);
    let found = farthest(&shape, &scheme, &of, 32);
    assert!(found <= of.measure, "{found}, said to be {}", of.measure);
    let fine = made(&shape, &scheme, &chord(1e-4)).unwrap();
    assert_eq!(fine.coarse, 0);
    assert!(farthest(&shape, &scheme, &fine, 8) <= 1e-4);
}

/// A face with equal corners, and one that is a line.
#[test]
fn collapsed_faces_are_no_trouble() {
    let mut cube = bases::cube();
    cube.positions[1] = cube.positions[0];
    let mut line = bases::cube();
    line.positions[..4].fill([0.0, 0.0, 1.0]);
    let mut point = bases::cube();
    point.positions.fill([1.0, 2.0, 3.0]);
    for of in [cube, line, point] {
        for scheme in [Scheme::catmull_clark(), three_point(), Scheme::doo_sabin()] {
            let shape = Shape::new(&of);
            let made = made(&shape, &scheme, &chord(1e-2)).unwrap();
            assert_eq!(euler(&mesh(&made)), 2);
            assert!(farthest(&shape, &scheme, &made, 16) <= 1e-2);
            assert!(made.normals.iter().flatten().all(|x| x.is_finite()));
        }
    }
}
