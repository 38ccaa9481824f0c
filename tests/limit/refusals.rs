//! Bad input is input.

use super::{Shape, WIDTH, at, bases};
use carvel::limit::{Derivatives, Sample, Surface};
use carvel::mesh::BuildOptions;
use carvel::{Boundary, Context, Element, ErrorKind, Hierarchy, Scheme};

#[track_caller]
fn refused(shape: &Shape, surface: &Surface, sample: Sample, kind: ErrorKind) {
    let mut out = vec![0.0; 2 * WIDTH];
    let samples = [at(0, 0, [0.5, 0.5]), sample];
    let context = Context::serial();
    let done =
        surface.evaluate(&context, &samples, &shape.values, WIDTH, Derivatives::None, &mut out);
    let error = done.expect_err("an error");
    assert_eq!(error.kind(), kind, "{error}");
    assert_eq!(error.elements(), [Element::Face(u64::from(sample.face))]);
    assert_eq!(surface.weights(&sample, Derivatives::None).expect_err("an error").kind(), kind);
}

#[test]
fn samples_lie_on_the_surface() {
    let shape = Shape::new(&bases::pyramid(4));
    let surface = shape.surface(&Scheme::catmull_clark());
    let strange = [
        at(99, 0, [0.5; 2]),
        at(0, 4, [0.5; 2]),
        at(0, 0, [-1e-300, 0.5]),
        at(0, 0, [0.5, 1.0 + 1e-15]),
        at(0, 0, [f64::NAN, 0.5]),
        at(0, 0, [0.5, f64::INFINITY]),
    ];
    for sample in strange {
        refused(&shape, &surface, sample, ErrorKind::ParameterOutOfRange);
    }
    let triangles = Shape::new(&bases::octahedron());
    let surface = triangles.surface(&Scheme::loop_triangles());
    refused(&triangles, &surface, at(1, 0, [0.6, 0.5]), ErrorKind::ParameterOutOfRange);
}

#[test]
fn values_are_numbers_as_many_as_needed() {
    let mut shape = Shape::new(&bases::torus(5, 5));
    let surface = shape.surface(&Scheme::catmull_clark());
    let v = shape.mesh.face_vertices(12)[0] as usize;
    shape.values[WIDTH * v + 1] = f64::NAN;
    let (context, one) = (Context::serial(), [at(12, 0, [0.3, 0.3])]);
    let kind = |values: &[f64], out: &mut [f64]| {
        let done = surface.evaluate(&context, &one, values, WIDTH, Derivatives::None, out);
        done.expect_err("an error").kind()
    };
    let mut out = vec![0.0; WIDTH];
    assert_eq!(kind(&shape.values, &mut out), ErrorKind::NotFinite);
    assert_eq!(kind(&shape.values[1..], &mut out), ErrorKind::LengthMismatch);
    assert_eq!(kind(&shape.values, &mut out[1..]), ErrorKind::LengthMismatch);
}

#[test]
fn holes_and_ends_have_no_surface() {
    let options = BuildOptions { holes: &[2], ..BuildOptions::default() };
    let shape = Shape::with(&bases::grid(4, 4), &options);
    let surface = shape.surface(&Scheme::catmull_clark());
    refused(&shape, &surface, at(2, 0, [0.5; 2]), ErrorKind::Unsupported);
    let open = Shape::new(&bases::half_fan(3));
    let ends = Scheme::doo_sabin().with_boundary(Boundary::None);
    let surface = open.surface(&ends);
    let mut out = vec![0.0; WIDTH];
    let context = Context::serial();
    let sample = at(0, 0, [0.1; 2]);
    let weights = surface.weights(&sample, Derivatives::None);
    assert_eq!(weights.expect_err("an error").kind(), ErrorKind::Unsupported);
    let done =
        surface.evaluate(&context, &[sample], &open.values, WIDTH, Derivatives::None, &mut out);
    assert_eq!(done.expect_err("an error").kind(), ErrorKind::Unsupported);
}

/// Values that fit, but whose derivative does not.
#[test]
fn results_beyond_single_precision_are_refused() {
    let shape = Shape::new(&bases::grid(4, 4));
    let surface = shape.surface(&Scheme::catmull_clark());
    // A step in the middle of each face of one row.
    assert_eq!(shape.mesh.vertices(), 25);
    let side = |v: usize| if v % 5 < 2 { -3e38_f32 } else { 3e38 };
    let values: Vec<f32> = (0..25).map(side).collect();
    let context = Context::serial();
    let mut refused = 0;
    for face in 0..16 {
        let samples = [at(face, 0, [0.5; 2])];
        let evaluate = |derivatives, out: &mut [f32]| {
            surface.evaluate(&context, &samples, &values, 1, derivatives, out).map_err(|e| e.kind())
        };
        assert_eq!(evaluate(Derivatives::None, &mut [0.0]), Ok(()));
        let mut out = [0.0; 3];
        match evaluate(Derivatives::First, &mut out) {
            Ok(()) => assert!(out.iter().all(|x| x.is_finite())),
            Err(kind) => {
                assert_eq!(kind, ErrorKind::NotFinite);
                refused += 1;
            }
        }
    }
    assert_eq!(refused, 4);
}

#[test]
fn surfaces_that_are_not_evaluated_are_refused_whole() {
    let kind = |shape: &Shape, scheme: &Scheme| {
        Surface::new(&Context::serial(), &shape.mesh, scheme).expect_err("an error").kind()
    };
    let shape = Shape::new(&bases::cube());
    let paper = Scheme::three_point(super::fraction(1, 32)).unwrap();
    assert_eq!(kind(&shape, &Scheme::loop_triangles()), ErrorKind::Unsupported);
    let wild = Scheme::primal(&[super::fraction(900, 1)]).unwrap();
    assert_eq!(kind(&shape, &wild), ErrorKind::Unsupported);
    let little = Context::builder().memory_ceiling(100).build().unwrap();
    let error = Surface::new(&little, &shape.mesh, &paper).expect_err("an error");
    assert_eq!(error.kind(), ErrorKind::MemoryCeiling);
    let open = Shape::new(&bases::grid(3, 3));
    let hierarchy = Hierarchy::new(&Context::serial(), open.mesh, paper.clone(), 1).unwrap();
    let refined = hierarchy.shared_mesh(1).unwrap();
    let error = Surface::new(&Context::serial(), &refined, &paper).expect_err("an error");
    assert_eq!(error.kind(), ErrorKind::Unsupported);
}
