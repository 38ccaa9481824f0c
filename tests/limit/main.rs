//! The limit surface at any point, against closed forms, refinement and itself.

mod channels;
mod convergence;
mod derivatives;
mod points;
mod refusals;
mod regular;
mod search;
mod stencils;
mod tessellation;
mod weights;

#[path = "../kernel/support/bases.rs"]
#[allow(dead_code, reason = "meshes for all tests")]
mod bases;
#[path = "../kernel/support/number.rs"]
#[allow(dead_code, reason = "numbers for all tests")]
mod number;
#[path = "../kernel/support/poly.rs"]
#[allow(dead_code, reason = "polygon meshes for all tests")]
mod poly;

use carvel::limit::{Derivatives, Sample, Surface};
use carvel::mesh::{BuildOptions, build};
use carvel::{Boundary, Context, Crease, Extraordinary, Fraction, Mesh, Scheme, SharpVertex};
use poly::Poly;
use std::sync::Arc;

fn fraction(p: i64, q: i64) -> Fraction {
    Fraction::new(p, q).expect("a fraction")
}

/// A mesh with a value at each vertex that follows no pattern, after its coordinates.
struct Shape {
    mesh: Arc<Mesh>,
    values: Vec<f64>,
}

const WIDTH: usize = 4;

impl Shape {
    fn new(of: &Poly<f64>) -> Self {
        Self::with(of, &BuildOptions::default())
    }

    fn with(of: &Poly<f64>, options: &BuildOptions) -> Self {
        let sizes: Vec<u32> = of.faces.iter().map(|face| face.len() as u32).collect();
        let indices: Vec<u32> = of.faces.iter().flatten().map(|&v| v as u32).collect();
        let vertices = of.positions.len();
        let built = build(&Context::serial(), vertices, &sizes, &indices, options).expect("a mesh");
        let mut state = 1_u32;
        let mut noise = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            f64::from(state >> 8) / f64::from(1 << 24) - 0.5
        };
        let record = |p: &[f64; 3]| [p[0], p[1], p[2], 2.0 * noise()];
        let values = of.positions.iter().flat_map(record).collect();
        Self { mesh: Arc::new(built.mesh), values }
    }

    /// Every third edge sharp, by turns for ever and not, and a sharp vertex.
    fn creased(of: &Poly<f64>) -> Self {
        let plain = Self::new(of);
        let sharpness = [10.0, 1.5, 10.0, 0.7];
        let edges = plain.mesh.edge_vertices().step_by(3).zip(sharpness.into_iter().cycle());
        let creases: Vec<Crease> =
            edges.map(|(vertices, sharpness)| Crease { vertices, sharpness }).collect();
        let sharp_vertices = [SharpVertex { vertex: 1, sharpness: 1.3 }];
        let options = BuildOptions {
            creases: &creases,
            sharp_vertices: &sharp_vertices,
            ..BuildOptions::default()
        };
        Self::with(of, &options)
    }

    fn surface(&self, scheme: &Scheme) -> Surface {
        Surface::new(&Context::serial(), &self.mesh, scheme).expect("a surface")
    }

    fn evaluate(&self, surface: &Surface, sample: Sample, derivatives: Derivatives) -> Vec<f64> {
        let mut out = vec![f64::NAN; WIDTH * derivatives.records()];
        let context = Context::serial();
        let evaluated =
            surface.evaluate(&context, &[sample], &self.values, WIDTH, derivatives, &mut out);
        evaluated.unwrap_or_else(|error| panic!("{error}"));
        out
    }

    fn point(&self, surface: &Surface, sample: Sample) -> Vec<f64> {
        self.evaluate(surface, sample, Derivatives::None)
    }
}

fn at(face: usize, sector: usize, [u, v]: [f64; 2]) -> Sample {
    Sample { face: face as u32, sector: sector as u32, u, v }
}

#[track_caller]
fn assert_near(found: &[f64], expected: &[f64], tolerance: f64, what: &str) {
    let scale = expected.iter().fold(1.0, |most: f64, x| most.max(x.abs()));
    for (a, b) in found.iter().zip(expected) {
        assert!((a - b).abs() <= tolerance * scale, "{what}: {found:?} is not {expected:?}");
    }
}

/// All that the averaging family does differently.
fn quad_schemes() -> Vec<Scheme> {
    let dual = |passes: &[Fraction]| Scheme::dual(passes).expect("passes");
    let primal = |passes: &[Fraction]| Scheme::primal(passes).expect("passes");
    let three_point = Scheme::three_point(fraction(1, 32)).expect("a weight");
    let tuned = three_point.with_extraordinary(Extraordinary::Tuned).expect("its weight");
    vec![
        Scheme::catmull_clark(),
        Scheme::doo_sabin(),
        Scheme::quartic(),
        dual(&[Fraction::HALF]),
        tuned,
        dual(&[Fraction::ZERO, fraction(7, 2)]),
        primal(&[]),
        primal(&[Fraction::ZERO]),
        primal(&[Fraction::ZERO, fraction(3, 1)]),
        primal(&[Fraction::ZERO, Fraction::ZERO]),
    ]
}

fn primal_schemes() -> Vec<Scheme> {
    let primal = |scheme: &Scheme| scheme.split() != carvel::SplitKind::Corner;
    quad_schemes().into_iter().filter(primal).collect()
}

fn dual_schemes() -> Vec<Scheme> {
    let dual = |scheme: &Scheme| scheme.split() == carvel::SplitKind::Corner;
    quad_schemes().into_iter().filter(dual).collect()
}

fn closed_meshes() -> Vec<Poly<f64>> {
    vec![
        bases::cube(),
        bases::prism(5),
        bases::dodecahedron(),
        bases::pyramid(6),
        bases::torus(5, 4),
    ]
}

fn open_meshes() -> Vec<Poly<f64>> {
    vec![bases::grid(4, 3), bases::half_fan(3), bases::annulus(5, 2), bases::polygon(5)]
}

/// With the boundary rules that a scheme tells apart.
fn with_boundaries(scheme: &Scheme) -> [Scheme; 2] {
    [Boundary::Edge, Boundary::EdgeAndCorner].map(|rule| scheme.clone().with_boundary(rule))
}
