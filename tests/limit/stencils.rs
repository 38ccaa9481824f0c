//! Stencil tables of samples against evaluation.

use super::{Shape, WIDTH, assert_near, at, bases, closed_meshes, quad_schemes};
use carvel::limit::{Derivatives, Sample, Surface};
use carvel::{Context, Element, ErrorKind, Records, RecordsMut, Scheme, StencilTable};

const ORDERS: [Derivatives; 3] = [Derivatives::None, Derivatives::First, Derivatives::Second];

/// Four samples in every sector.
fn samples(shape: &Shape, surface: &Surface) -> Vec<Sample> {
    let faces = 0..shape.mesh.faces();
    let sectors = faces.flat_map(|face| (0..surface.sectors(face)).map(move |at| (face, at)));
    let places = [[0.31, 0.12], [0.77, 0.21], [0.11, 0.83], [0.05, 0.03]];
    sectors.flat_map(|(face, sector)| places.map(|place| at(face, sector, place))).collect()
}

fn applied(table: &StencilTable<f64>, values: &[f64]) -> Vec<f64> {
    let mut out = vec![f64::NAN; WIDTH * table.rows()];
    let (values, to) = (Records::packed(values, WIDTH), RecordsMut::packed(&mut out, WIDTH));
    table.apply(&Context::serial(), values, to).expect("values");
    out
}

/// The sum of products of two arrays.
fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// A table of everything that the scheme has derivatives of, held to evaluation.
fn check(shape: &Shape, scheme: &Scheme) {
    let surface = shape.surface(scheme);
    let (context, samples) = (Context::serial(), samples(shape, &surface));
    for derivatives in ORDERS {
        let mut expected = vec![0.0; samples.len() * WIDTH * derivatives.records()];
        let values = &shape.values;
        let there = surface.evaluate(&context, &samples, values, WIDTH, derivatives, &mut expected);
        let table = surface.stencils::<f64>(&context, &samples, derivatives);
        if let Err(error) = there {
            // A scheme without such derivatives says so in the same words.
            assert_eq!(table.expect_err("an error").to_string(), error.to_string());
            continue;
        }
        let table = table.unwrap_or_else(|error| panic!("{scheme:?}: {error}"));
        assert_eq!(table.rows(), samples.len() * derivatives.records());
        assert_eq!(table.columns(), shape.mesh.vertices());
        assert!((0..table.rows()).all(|row| table.row(row).0.is_sorted_by(|a, b| a < b)));
        let found = applied(&table, values);
        assert_near(&found, &expected, 1e-13, &format!("{scheme:?}, {derivatives:?}"));
        // ⟨S x, y⟩ = ⟨x, Sᵀ y⟩.
        let back: Vec<f64> = (0..found.len()).map(|i| ((7 * i) % 11) as f64 - 5.0).collect();
        let turned = table.transpose(&context).expect("a transpose");
        let [one, other] = [dot(&found, &back), dot(values, &applied(&turned, &back))];
        let size = found.iter().zip(&back).map(|(x, y)| (x * y).abs()).sum::<f64>();
        assert!((one - other).abs() <= 1e-13 * size, "{scheme:?}: {one} is not {other}");
    }
}

#[test]
fn tables_apply_as_samples_evaluate() {
    for of in closed_meshes() {
        for scheme in quad_schemes() {
            check(&Shape::new(&of), &scheme);
        }
    }
    check(&Shape::new(&bases::octahedron()), &Scheme::loop_triangles());
}

#[test]
fn boundaries_and_creases_are_in_the_table() {
    check(&Shape::creased(&bases::cube()), &Scheme::catmull_clark());
    check(&Shape::creased(&bases::grid(4, 3)), &Scheme::catmull_clark());
    check(&Shape::new(&bases::annulus(5, 2)), &Scheme::doo_sabin());
}

#[test]
fn threads_change_no_bit_and_single_precision_is_rounded_once() {
    let shape = Shape::new(&bases::prism(5));
    let surface = shape.surface(&Scheme::doo_sabin());
    let samples = samples(&shape, &surface);
    let threads = Context::builder().threads(3).chunk(4).build().unwrap();
    let first = Derivatives::First;
    let alone = surface.stencils::<f64>(&Context::serial(), &samples, first).unwrap();
    let together = surface.stencils::<f64>(&threads, &samples, first).unwrap();
    assert!(alone == together);
    let single = surface.stencils::<f32>(&threads, &samples, first).unwrap();
    let rounded: Vec<f32> = alone.weights().iter().map(|&x| x as f32).collect();
    assert_eq!(single.weights(), rounded);
}

#[test]
fn the_first_bad_sample_is_named() {
    let shape = Shape::new(&bases::torus(5, 4));
    let surface = shape.surface(&Scheme::catmull_clark());
    let threads = Context::builder().threads(2).chunk(1).build().unwrap();
    let mut samples = samples(&shape, &surface);
    samples[9].u = f64::NAN;
    samples[50].face = 1000;
    let face = samples[9].face;
    let error = surface.stencils::<f64>(&threads, &samples, Derivatives::First).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::ParameterOutOfRange, "{error}");
    assert_eq!(error.elements(), [Element::Face(u64::from(face))]);
}

#[test]
fn weights_beyond_single_precision_are_refused() {
    let shape = Shape::new(&bases::pyramid(6));
    let surface = shape.surface(&Scheme::catmull_clark());
    // The corner of a face at the apex, so near that second derivatives exceed 10³⁸.
    let near = |corner| at(0, corner, [1e-120; 2]);
    let found = (0..surface.sectors(0)).filter_map(|corner| {
        let wide = surface.stencils::<f64>(&Context::serial(), &[near(corner)], ORDERS[2]);
        let narrow = surface.stencils::<f32>(&Context::serial(), &[near(corner)], ORDERS[2]);
        wide.is_ok().then(|| narrow.map(drop).map_err(|error| error.kind()))
    });
    assert!(found.collect::<Vec<_>>().contains(&Err(ErrorKind::NotFinite)));
}
