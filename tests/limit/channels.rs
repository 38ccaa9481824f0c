//! Surfaces of face-varying values against refinement.

use super::convergence::Spot;
use super::{Derivatives, Poly, Shape, at, bases};
use carvel::hierarchy::FaceVarying;
use carvel::limit::Surface;
use carvel::scheme::Creasing;
use carvel::{
    Boundary, Channel, Context, Element, ErrorKind, FaceVaryingMode, Hierarchy, Refiner, Scheme,
    SplitKind, Task,
};

use FaceVaryingMode::{All, Boundaries, Corners, CornersPlus1, CornersPlus2, Smooth};

const MODES: [FaceVaryingMode; 6] = [Smooth, Corners, CornersPlus1, CornersPlus2, Boundaries, All];
const WIDTH: usize = 2;

/// Which value each corner takes: its vertex's, or another one in faces and at vertices that
/// `is_apart` says.
fn seams(shape: &Shape, is_apart: impl Fn(usize, u32) -> bool) -> Vec<u32> {
    let mesh = &shape.mesh;
    let value = |face: usize, v: u32| {
        if is_apart(face, v) { v + mesh.vertices() as u32 } else { v }
    };
    let corners = |face: usize| mesh.face_vertices(face).iter().map(move |&v| value(face, v));
    // The caller's order of faces.
    let mut faces: Vec<usize> = (0..mesh.faces()).collect();
    faces.sort_by_key(|&face| mesh.face_source(face));
    faces.into_iter().flat_map(corners).collect()
}

fn numbers(count: usize) -> Vec<f64> {
    let mut state = 5_u32;
    let mut next = || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(state >> 8) / f64::from(1 << 24)
    };
    (0..WIDTH * count).map(|_| next()).collect()
}

fn point(surface: &Surface, sample: carvel::limit::Sample, values: &[f64]) -> [f64; WIDTH] {
    let mut out = [f64::NAN; WIDTH];
    let none = Derivatives::None;
    let evaluated = surface.evaluate(&Context::serial(), &[sample], values, WIDTH, none, &mut out);
    evaluated.unwrap_or_else(|error| panic!("{error}"));
    out
}

/// The surface of control values and that of refined ones are one.
fn check(shape: &Shape, scheme: &Scheme, mode: FaceVaryingMode, indices: &[u32]) {
    const LEVEL: u32 = 2;
    let context = Context::serial();
    let values = numbers(2 * shape.mesh.vertices());
    let channel = Channel::new(&shape.mesh, indices, values.len() / WIDTH, mode).unwrap();
    let surface = Surface::of_channel(&context, &shape.mesh, &channel, scheme).unwrap();
    let positions = vec![0.0; 3 * shape.mesh.vertices()];
    let task = Task {
        mesh: &shape.mesh,
        scheme,
        levels: LEVEL,
        positions: &positions,
        attributes: &[],
        channels: &[FaceVarying { channel: &channel, values: &values, width: WIDTH }],
        face_sources: false,
    };
    let refined = Refiner::new().refine(&context, &task).unwrap();
    let fine = &refined.channels[0];
    let hierarchy = Hierarchy::new(&context, shape.mesh.clone(), scheme.clone(), LEVEL).unwrap();
    let mesh = hierarchy.mesh(LEVEL);
    let count = fine.values.len() / WIDTH;
    let channel = Channel::new(mesh, &fine.indices, count, mode).unwrap();
    let below = Surface::of_channel(&context, mesh, &channel, scheme).unwrap();
    let is_loop = scheme.split() == SplitKind::Triangle;
    let sides = if is_loop { 3 } else { 4 };
    let down = |spot: &Spot| -> Vec<Spot> {
        let is_sector = surface.sectors(spot.face) > 1;
        let first = |k| if is_loop { spot.in_triangle(k) } else { spot.in_quad(is_sector, k) };
        let second = |spot: &Spot, k| {
            if is_loop { spot.in_triangle(k) } else { spot.in_quad(false, k) }
        };
        (0..sides).flat_map(|j| (0..sides).map(move |k| second(&first(j), k))).collect()
    };
    for spot in Spot::all(&shape.mesh, scheme, &surface).iter().flat_map(down) {
        let here = point(&surface, spot.sample(), &values);
        let (face, k) = (spot.corner / sides, spot.corner % sides);
        let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let triangle = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
        let corner = if is_loop { triangle[k] } else { corners[k] };
        let there = point(&below, at(face, 0, corner), &fine.values);
        for (a, b) in here.iter().zip(there) {
            assert!((a - b).abs() < 1e-12, "{scheme:?} {mode:?} {spot:?}: {here:?}, {there:?}");
        }
    }
}

/// Seams that make islands, ends of seams inside, and values in several pieces.
fn check_all(of: &Poly<f64>, scheme: &Scheme) {
    for shape in [Shape::new(of), Shape::creased(of)] {
        let faces = shape.mesh.faces();
        let half = seams(&shape, |face, _| 2 * face < faces);
        let dart = seams(&shape, |face, v| face == 0 && v == shape.mesh.face_vertices(0)[1]);
        let wild = seams(&shape, |face, v| face % 2 == 0 && v % 3 != 0);
        for mode in MODES {
            for indices in [&half, &dart, &wild] {
                // Sharpness that ends makes values of a vertex wait for each other in these.
                let waits = matches!(mode, CornersPlus1 | CornersPlus2);
                if !(waits && shape.mesh.creases().next().is_some()) {
                    check(&shape, scheme, mode, indices);
                }
            }
        }
    }
}

#[test]
fn quads_have_the_surface_that_refinement_leads_to() {
    for of in [bases::cube(), bases::prism(5), bases::grid(4, 3)] {
        for rule in [Boundary::Edge, Boundary::EdgeAndCorner] {
            check_all(&of, &Scheme::catmull_clark().with_boundary(rule));
        }
    }
    check_all(&bases::prism(5), &Scheme::primal(&[]).unwrap());
}

#[test]
fn triangles_have_it_too() {
    for of in [bases::bipyramid(5), bases::triangle_grid(3, 3)] {
        check_all(&of, &Scheme::loop_triangles());
    }
}

#[test]
fn holes_stay_holes_and_what_has_no_surface_is_refused() {
    let context = Context::serial();
    let shape = Shape::new(&bases::grid(3, 3));
    let indices = seams(&shape, |face, _| face < 3);
    let values = 2 * shape.mesh.vertices();
    let channel = |mode| Channel::new(&shape.mesh, &indices, values, mode).unwrap();
    let of = |shape: &Shape, mode, scheme: &Scheme| {
        Surface::of_channel(&context, &shape.mesh, &channel(mode), scheme)
    };
    // The middle is all that there is without boundary faces.
    let none = Scheme::catmull_clark().with_boundary(Boundary::None);
    let surface = of(&shape, Corners, &none).unwrap();
    let whole = shape.surface(&none);
    let values = numbers(values);
    for face in 0..9 {
        let mut out = [0.0; WIDTH];
        let sample = [at(face, 0, [0.5, 0.5])];
        let derivatives = Derivatives::None;
        let control = &shape.values;
        let mut point = [0.0; super::WIDTH];
        let width = super::WIDTH;
        let here = surface.evaluate(&context, &sample, &values, WIDTH, derivatives, &mut out);
        let there = whole.evaluate(&context, &sample, control, width, derivatives, &mut point);
        assert_eq!(here.is_ok(), there.is_ok(), "face {face}");
    }
    let kind = |result: carvel::Result<Surface>| result.err().map(|error| error.kind());
    let other = Shape::new(&bases::grid(3, 2));
    assert_eq!(kind(of(&other, Corners, &none)), Some(ErrorKind::LengthMismatch));
    assert_eq!(kind(of(&shape, Corners, &Scheme::quartic())), Some(ErrorKind::Unsupported));
    let few = &values[2..];
    let mut out = [0.0; WIDTH];
    let sample = [at(4, 0, [0.5, 0.5])];
    let short = surface.evaluate(&context, &sample, few, WIDTH, Derivatives::None, &mut out);
    assert_eq!(short.expect_err("an error").kind(), ErrorKind::LengthMismatch);

    // Semi-sharp on one side of the seam alone.
    let seam = shape.mesh.edge_vertices().find(|ends| {
        let sides: Vec<usize> = (0..9)
            .filter(|&f| ends.iter().all(|v| shape.mesh.face_vertices(f).contains(v)))
            .collect();
        sides == [0, 1]
    });
    let crease = carvel::Crease { vertices: seam.expect("an edge"), sharpness: 1.5 };
    let options = carvel::mesh::BuildOptions { creases: &[crease], ..Default::default() };
    let creased = Shape::with(&bases::grid(3, 3), &options);
    let smooth = Scheme::catmull_clark();
    assert!(of(&creased, Corners, &smooth).is_ok());
    for (mode, scheme) in
        [(CornersPlus1, smooth.clone()), (Corners, smooth.clone().with_creasing(Creasing::Chaikin))]
    {
        let Err(error) = of(&creased, mode, &scheme) else {
            panic!("a surface in spite of {mode:?}")
        };
        assert_eq!(error.kind(), ErrorKind::Unsupported);
        assert!(matches!(error.elements(), [Element::Vertex(_)]), "{error}");
    }
}
