//! The surface between vertices against `Far::PatchTable` and `Bfr::Surface`: position, first and
//! second derivatives.
//!
//! Both isolate features so many levels and put Gregory patches in what is left, which meet the
//! surface at corners and nowhere else for certain. Everything outside is a B-spline or box
//! spline patch, where nothing but rounding may differ: it grows with the levels by which
//! derivatives are scaled, since their patches keep coordinates and ours differences.
//!
//! In a triangle that stands on its head OpenSubdiv turns the sign of second derivatives, as it
//! has to that of the first ones; so they are compared up to one sign. That ours is right
//! is shown by differences of first derivatives, in carvel's own tests.

use carvel::Context;
use carvel::limit::Derivatives;
use carvel_peers::{
    Boundary, Control, Creasing, Options, Patches, Place, Precision, Scheme, Task, ours, shapes,
};

/// Levels that features are isolated: Gregory patches are 2⁻¹⁰ of a face wide.
const DEEP: u32 = 10;
/// How far samples stay away from corners, so that they are outside of those.
const MARGIN: f64 = 1.0 / 64.0;

/// Rounding of the position and derivatives, of the largest value: by the levels between a face
/// and a patch at the margin.
fn bounds(precision: Precision) -> [f64; 3] {
    match precision {
        Precision::Single => [1e-5, 1e-4, 1e-2],
        Precision::Double => [1e-12, 1e-11, 1e-10],
    }
}

/// Samples that follow no pattern in each face and sector that has a surface.
fn places(control: &Control, scheme: Scheme, holes: &[u32]) -> Vec<Place> {
    let mut state = 7_u64;
    let mut number = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963);
        MARGIN + (1.0 - 2.0 * MARGIN) * (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    let mut places = Vec::new();
    for (face, &sides) in (0..).zip(&control.sizes) {
        if holes.contains(&face) {
            continue;
        }
        let whole = if scheme == Scheme::Loop { 3 } else { 4 };
        for sector in 0..if sides == whole { 1 } else { sides } {
            for _ in 0..8 {
                let [mut u, mut v] = [number(), number()];
                if scheme == Scheme::Loop && u + v > 1.0 {
                    [u, v] = [1.0 - u, 1.0 - v];
                }
                places.push(Place { face, sector, uv: [u, v] });
            }
        }
    }
    places
}

fn check(task: &Task, what: &str) {
    let (surface, faces) = ours::surface(task).expect("our surface");
    let holes = ours::scheme(task).expect("a scheme").holes(surface.mesh()).expect("holes");
    let holes: Vec<u32> =
        (0..).zip(&faces).filter(|(_, face)| holes.contains(face)).map(|(f, _)| f).collect();
    let places = places(task.control, task.scheme, &holes);
    let samples = ours::samples(&faces, &places);
    let mut mine = vec![0.0; 18 * samples.len()];
    let (context, positions) = (Context::serial(), &task.control.positions);
    surface
        .evaluate(&context, &samples, positions, 3, Derivatives::Second, &mut mine)
        .expect("our points");
    for (way, patches) in [("Far", Patches::far(task, DEEP)), ("Bfr", Patches::bfr(task, DEEP))] {
        let mut patches = patches.expect("patches");
        patches.place(&places).expect("places");
        patches.evaluate(6).expect("their points");
        let theirs = patches.values().expect("their points");
        let size = mine.iter().fold(1.0, |most: f64, x| most.max(x.abs()));
        let both = mine.chunks(18).zip(theirs.chunks(18));
        for ((mine, theirs), place) in both.zip(&places) {
            let turned = task.scheme == Scheme::Loop
                && (9..18).all(|k| (mine[k] + theirs[k]).abs() <= size * bounds(task.precision)[2]);
            for (k, (a, b)) in mine.iter().zip(theirs).enumerate() {
                let b = if turned && k >= 9 { -b } else { *b };
                let bound = size * bounds(task.precision)[[0, 1, 1, 2, 2, 2][k / 3]];
                let Task { scheme, precision, .. } = task;
                assert!(
                    (a - b).abs() <= bound,
                    "{what}, {scheme:?} {precision:?} by {way}: record {} at {place:?} is {a}, not {b}",
                    k / 3
                );
            }
        }
    }
}

fn everywhere(control: &Control, options: Options, what: &str) {
    let control = &control.clone().rounded();
    let schemes = [Some(Scheme::CatmullClark), control.is_triangles().then_some(Scheme::Loop)];
    for scheme in schemes.into_iter().flatten() {
        for precision in Precision::ALL {
            check(&Task { control, scheme, precision, options }, what);
        }
    }
}

#[test]
fn every_valence_and_face_size() {
    for n in 3..=9 {
        for (control, what) in [
            (shapes::prism(n), "prism"),
            (shapes::bipyramid(n), "bipyramid"),
            (shapes::pyramid(n), "pyramid"),
        ] {
            everywhere(&control, Options::default(), &format!("{what} of {n}"));
        }
    }
}

#[test]
fn regular_meshes() {
    let torus = shapes::torus(7, 6);
    everywhere(&torus, Options::default(), "torus");
    everywhere(&shapes::triangulated(&torus), Options::default(), "triangulated torus");
}

#[test]
fn boundaries() {
    for boundary in Boundary::ALL {
        let options = Options { boundary, ..Options::default() };
        for (control, what) in [
            (shapes::grid(4, 4), "grid"),
            (shapes::frame(), "frame"),
            (shapes::triangulated(&shapes::grid(5, 5)), "triangle grid"),
            (shapes::half_fan(4), "half fan"),
        ] {
            everywhere(&control, options, &format!("{what}, {boundary:?}"));
        }
    }
}

#[test]
fn creases() {
    let line = [[10, 11], [11, 12], [12, 13], [13, 14]];
    let grid = shapes::grid(4, 4);
    let triangles = shapes::triangulated(&grid);
    for creasing in Creasing::ALL {
        let options = Options { creasing, ..Options::default() };
        for sharpness in [10.0, 2.0, 1.3] {
            let what = format!("a crease of {sharpness}, {creasing:?}");
            everywhere(&grid.clone().creased(&line, sharpness), options, &what);
            everywhere(&triangles.clone().creased(&line[..3], sharpness), options, &what);
        }
        let uneven = shapes::cube().creased(&[[0, 1], [1, 3]], 2.6).creased(&[[3, 7]], 10.0);
        everywhere(&uneven.cornered(&[4], 1.4), options, "a cube with creases and a corner");
    }
}

/// Gregory patches have the surface's own points at corners.
#[test]
fn corners_are_limits_of_vertices() {
    for (control, scheme) in [
        (shapes::prism(7), Scheme::CatmullClark),
        (shapes::cube(), Scheme::CatmullClark),
        (shapes::bipyramid(9), Scheme::Loop),
    ] {
        let task = Task::new(&control, scheme, Precision::Double);
        let (surface, faces) = ours::surface(&task).expect("our surface");
        let places: Vec<Place> = places(&control, scheme, &[])
            .into_iter()
            .map(|place| Place { uv: [0.0, 0.0], ..place })
            .collect();
        let samples = ours::samples(&faces, &places);
        let mut mine = vec![0.0; 3 * samples.len()];
        let (context, positions) = (Context::serial(), &control.positions);
        surface
            .evaluate(&context, &samples, positions, 3, Derivatives::None, &mut mine)
            .expect("our points");
        for isolation in [2, DEEP] {
            let mut patches = Patches::far(&task, isolation).expect("patches");
            patches.place(&places).expect("places");
            patches.evaluate(1).expect("their points");
            for (a, b) in mine.iter().zip(patches.values().expect("their points")) {
                assert!((a - b).abs() < bounds(Precision::Double)[0], "{scheme:?}: {a}, not {b}");
            }
        }
    }
}
