//! Derivatives against differences.

use super::{Shape, WIDTH, at, bases, closed_meshes, quad_schemes};
use carvel::limit::{Derivatives, Surface};
use carvel::{Context, ErrorKind, Scheme};

/// Differences of values this far apart.
const STEP: f64 = 1e-5;
/// Errors of first and second derivatives, of the largest value: rounding over the step, and
/// the step squared, or less where third derivatives have no bound.
const ERRORS: [f64; 2] = [1e-7, 1e-4];

fn check(shape: &Shape, surface: &Surface, face: usize, sector: usize, uv: [f64; 2]) {
    let has_second = {
        let mut out = vec![0.0; WIDTH * 6];
        let sample = [at(face, sector, uv)];
        let second = Derivatives::Second;
        surface
            .evaluate(&Context::serial(), &sample, &shape.values, WIDTH, second, &mut out)
            .is_ok()
    };
    let kind = if has_second { Derivatives::Second } else { Derivatives::First };
    let found = shape.evaluate(surface, at(face, sector, uv), kind);
    let records = if has_second { vec![3, 4, 5] } else { vec![] };
    let scale = found.iter().fold(1.0, |most: f64, x| most.max(x.abs()));
    let moved = |du: f64, dv: f64, derivatives| {
        shape.evaluate(surface, at(face, sector, [uv[0] + du, uv[1] + dv]), derivatives)
    };
    let differences = |by_v: bool, derivatives| {
        let (du, dv) = if by_v { (0.0, STEP) } else { (STEP, 0.0) };
        let [on, back] = [moved(du, dv, derivatives), moved(-du, -dv, derivatives)];
        on.iter().zip(back).map(|(a, b)| (a - b) / (2.0 * STEP)).collect::<Vec<f64>>()
    };
    let near = |a: f64, b: f64, error: f64, what: usize| {
        assert!(
            (a - b).abs() <= error * scale,
            "record {what} at {face} {sector} {uv:?}: {a}, not {b}"
        );
    };
    for by_v in [false, true] {
        let slopes = differences(by_v, Derivatives::None);
        for k in 0..WIDTH {
            let record = 1 + usize::from(by_v);
            near(found[record * WIDTH + k], slopes[k], ERRORS[0], record);
        }
        if records.is_empty() {
            continue;
        }
        let bends = differences(by_v, Derivatives::First);
        for k in 0..WIDTH {
            let [first, second] = if by_v { [4, 5] } else { [3, 4] };
            near(found[first * WIDTH + k], bends[WIDTH + k], ERRORS[1], first);
            near(found[second * WIDTH + k], bends[2 * WIDTH + k], ERRORS[1], second);
        }
    }
}

#[test]
fn derivatives_are_limits_of_differences() {
    for of in closed_meshes() {
        let shape = Shape::new(&of);
        for scheme in quad_schemes() {
            let surface = shape.surface(&scheme);
            let faces = [0, of.faces.len() / 2, of.faces.len() - 1];
            for (face, uv) in faces.iter().zip([[0.31, 0.77], [0.87, 0.83], [0.66, 0.22]]) {
                let sector = surface.sectors(*face) - 1;
                check(&shape, &surface, *face, sector, uv);
            }
        }
    }
}

#[test]
fn triangles_and_boundaries_have_them_too() {
    let scheme = Scheme::loop_triangles();
    for of in [bases::bipyramid(5), bases::bipyramid(6), bases::triangle_grid(4, 4)] {
        let shape = Shape::new(&of);
        let surface = shape.surface(&scheme);
        (0..of.faces.len()).for_each(|face| check(&shape, &surface, face, 0, [0.31, 0.43]));
    }
    for scheme in quad_schemes() {
        let shape = Shape::new(&bases::grid(5, 5));
        let surface = shape.surface(&scheme);
        check(&shape, &surface, 7, 0, [0.31, 0.43]);
        check(&shape, &surface, 12, 0, [0.61, 0.23]);
    }
}

/// Exactly on a boundary there are derivatives, too: those just inside.
#[test]
fn boundaries_have_derivatives() {
    let check = |shape: &Shape, scheme: &Scheme, face: usize, [u, v]: [f64; 2]| {
        let surface = shape.surface(scheme);
        let on = shape.evaluate(&surface, at(face, 0, [u, v]), Derivatives::First);
        let (u, v) = (u + 1e-9 * (0.3 - u).signum(), v + 1e-9 * (0.3 - v).signum());
        let inside = shape.evaluate(&surface, at(face, 0, [u, v]), Derivatives::First);
        super::assert_near(&on, &inside, 1e-7, &format!("{scheme:?}, face {face}"));
    };
    let triangles = Shape::new(&bases::triangle_grid(6, 6));
    let mesh = &triangles.mesh;
    let regular = |&v: &u32| {
        let full = if mesh.is_boundary_vertex(v as usize) { 3 } else { 6 };
        mesh.valence(v as usize) == full
    };
    let mut seen = 0;
    for face in 0..mesh.faces() {
        let first = mesh.face_corners(face).start;
        let open = |place: usize| mesh.corner_twins()[first + place] == u32::MAX;
        if mesh.face_vertices(face).iter().all(regular) {
            for (_, uv) in [(0, [0.4, 0.0]), (2, [0.0, 0.6])].iter().filter(|(p, _)| open(*p)) {
                check(&triangles, &Scheme::loop_triangles(), face, *uv);
                seen += 1;
            }
        }
    }
    assert!(seen > 4, "regular boundary triangles");
    let quads = Shape::new(&bases::grid(5, 5));
    let four = Scheme::primal(&[carvel::Fraction::ZERO, super::fraction(3, 1)]).unwrap();
    for scheme in quad_schemes().into_iter().filter(|scheme| *scheme != four) {
        check(&quads, &scheme, 2, [0.0, 0.4]);
        check(&quads, &scheme, 0, [0.0, 0.0]);
    }
}

/// Derivatives of schemes that are not smooth enough, and at features.
#[test]
fn what_does_not_exist_is_refused() {
    let shape = Shape::new(&bases::cube());
    let kind = |scheme: &Scheme, uv: [f64; 2], derivatives: Derivatives| {
        let mut out = vec![0.0; WIDTH * derivatives.records()];
        let context = Context::serial();
        let surface = shape.surface(scheme);
        let samples = [at(2, 0, uv)];
        let done =
            surface.evaluate(&context, &samples, &shape.values, WIDTH, derivatives, &mut out);
        done.err().map(|error| error.kind())
    };
    let four = Scheme::primal(&[carvel::Fraction::ZERO, super::fraction(3, 1)]).unwrap();
    assert_eq!(kind(&four, [0.3, 0.6], Derivatives::First), None);
    let refused = Some(ErrorKind::Unsupported);
    assert_eq!(kind(&four, [0.3, 0.6], Derivatives::Second), refused);
    assert_eq!(kind(&Scheme::catmull_clark(), [0.0, 1.0], Derivatives::First), refused);
    assert_eq!(kind(&Scheme::catmull_clark(), [0.0, 1.0], Derivatives::None), None);
    assert_eq!(kind(&Scheme::catmull_clark(), [0.0, 1.0 - 1e-9], Derivatives::Second), None);
}
