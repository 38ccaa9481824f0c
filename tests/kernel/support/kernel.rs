//! The kernel in the oracle's words: conversions in and out of its types.

use carvel::base::Scalar;
use carvel::mesh::{BuildOptions, Built, Defects, build};
use carvel::{Context, Fraction, Hierarchy, Mesh, Refined, Refiner, Task};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::ToPrimitive;

use super::number::Number;
use super::poly::Poly;
use super::reference::{Boundary, Rule, Scheme, Split};

/// Faces as the kernel takes them.
#[derive(Clone, Debug)]
pub struct Soup {
    pub vertices: usize,
    pub sizes: Vec<u32>,
    pub indices: Vec<u32>,
}

impl Soup {
    pub fn new<F: AsRef<[usize]>>(vertices: usize, faces: &[F]) -> Self {
        let faces = || faces.iter().map(F::as_ref);
        Self {
            vertices,
            sizes: faces().map(|f| f.len() as u32).collect(),
            indices: faces().flatten().map(|&v| v as u32).collect(),
        }
    }

    pub fn build(&self, options: &BuildOptions) -> Result<Built, Defects> {
        build(&Context::serial(), self.vertices, &self.sizes, &self.indices, options)
    }

    /// The mesh of a sound soup.
    pub fn mesh(&self, anchored: bool) -> Mesh {
        let options = BuildOptions { anchored, ..BuildOptions::default() };
        self.build(&options).expect("a manifold soup").mesh
    }
}

pub fn fraction(of: &BigRational) -> Fraction {
    let part = |n: &BigInt| n.to_i64().expect("tests use small fractions");
    Fraction::new(part(of.numer()), part(of.denom())).expect("a fraction")
}

/// The kernel's scheme.
pub fn scheme(of: &Scheme) -> carvel::Scheme {
    let passes: Vec<Fraction> = of.passes.iter().map(fraction).collect();
    let rule = match of.rule {
        Rule::Cosine => carvel::CornerRule::Cosine,
        Rule::Average => carvel::CornerRule::Average,
    };
    let boundary = match of.boundary {
        Boundary::None => carvel::Boundary::None,
        Boundary::Edge => carvel::Boundary::Edge,
        Boundary::EdgeCorner => carvel::Boundary::EdgeAndCorner,
    };
    let scheme = match of.split {
        Split::Dual => carvel::Scheme::dual(&passes),
        Split::Primal => carvel::Scheme::primal(&passes),
    };
    scheme.expect("passes in range").with_rule(rule).with_boundary(boundary)
}

/// The kernel's mesh, tags and flag included.
pub fn mesh<N: Number>(of: &Poly<N>) -> Mesh {
    let tags: Vec<u32> = of.tags.iter().map(|&v| v as u32).collect();
    let options =
        BuildOptions { anchored: of.anchored, corner_tags: &tags, ..BuildOptions::default() };
    Soup::new(of.positions.len(), &of.faces).build(&options).expect("a manifold mesh").mesh
}

pub fn hierarchy<N: Number>(of: &Poly<N>, by: &Scheme, levels: u32) -> Hierarchy {
    let hierarchy = Hierarchy::new(&Context::serial(), mesh(of), scheme(by), levels);
    hierarchy.expect("a small hierarchy")
}

/// xyz of every vertex, rounded to the kernel's number type.
pub fn coordinates<T: Scalar>(of: &Poly<f64>) -> Vec<T> {
    of.positions.iter().flatten().map(|&x| T::from_f64(x)).collect()
}

/// Positions alone, by a fresh [`Refiner`] on one thread.
pub fn refine<T: Scalar>(of: &Poly<f64>, by: &Scheme, levels: u32) -> Refined<T> {
    refine_mesh(&mesh(of), &scheme(by), levels, &coordinates(of))
}

pub fn refine_mesh<T: Scalar>(
    mesh: &Mesh,
    scheme: &carvel::Scheme,
    levels: u32,
    positions: &[T],
) -> Refined<T> {
    let task = Task {
        mesh,
        scheme,
        levels,
        positions,
        attributes: &[],
        channels: &[],
        face_sources: true,
    };
    Refiner::new().refine(&Context::serial(), &task).expect("a small refinement")
}

/// Values refined to a level of a hierarchy.
pub fn refine_values<T: Scalar>(
    hierarchy: &Hierarchy,
    level: u32,
    values: &[T],
    width: usize,
) -> Vec<T> {
    let mut out = vec![T::default(); hierarchy.mesh(level).vertices() * width];
    let done = hierarchy.refine(&Context::serial(), level, values, width, &mut out);
    done.expect("values of the right length");
    out
}

/// The faces of a mesh as the oracle writes them, in the mesh's order.
pub fn faces(mesh: &Mesh) -> Vec<Vec<usize>> {
    let face = |f| mesh.face_vertices(f).iter().map(|&v| v as usize).collect();
    (0..mesh.faces()).map(face).collect()
}

pub fn faces_of<T>(refined: &Refined<T>) -> Vec<Vec<usize>> {
    let mut rest = &refined.face_vertices[..];
    let mut face = |&size: &u32| {
        let (cycle, later) = rest.split_at(size as usize);
        rest = later;
        cycle.iter().map(|&v| v as usize).collect()
    };
    refined.face_sizes.iter().map(&mut face).collect()
}

/// A mesh of the kernel as the oracle writes it.
pub fn poly<T: Scalar>(mesh: &Mesh, positions: &[T]) -> Poly<f64> {
    with_positions(faces(mesh), positions, mesh.is_anchored())
}

pub fn poly_of<T: Scalar>(refined: &Refined<T>) -> Poly<f64> {
    with_positions(faces_of(refined), &refined.positions, refined.anchored)
}

fn with_positions<T: Scalar>(faces: Vec<Vec<usize>>, positions: &[T], anchored: bool) -> Poly<f64> {
    let point = |p: &[T]| [p[0], p[1], p[2]].map(T::to_f64);
    Poly { anchored, ..Poly::new(positions.chunks(3).map(point).collect(), faces) }
}

/// What two results must share to be the same bytes.
pub fn bits<T: Scalar>(values: &[T]) -> Vec<u64> {
    values.iter().map(|x| x.to_f64().to_bits()).collect()
}

/// Panics unless two refinements are the same byte for byte.
pub fn assert_same_bytes<T: Scalar>(a: &Refined<T>, b: &Refined<T>, what: &str) {
    assert_eq!(a.face_sizes, b.face_sizes, "{what}: face sizes");
    assert_eq!(a.face_vertices, b.face_vertices, "{what}: face vertices");
    assert_eq!(a.face_sources, b.face_sources, "{what}: face sources");
    assert_eq!(a.anchored, b.anchored, "{what}: anchored");
    assert_eq!(bits(&a.positions), bits(&b.positions), "{what}: positions");
    assert_eq!(a.attributes.len(), b.attributes.len(), "{what}: attributes");
    for (a, b) in a.attributes.iter().zip(&b.attributes) {
        assert_eq!(bits(a), bits(b), "{what}: an attribute");
    }
}
