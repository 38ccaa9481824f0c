//! Limit positions, tangents and normals of the vertices of a level.

use super::rows::{Rows, rows};
use crate::base::{Context, Element, Error, ErrorKind, Result, Scalar, memory};
use crate::mesh::Mesh;
use crate::scheme::Scheme;
use crate::sparse::StencilTable;
use std::sync::Arc;

/// Where the vertices of a mesh go in the limit, and two tangents of the surface there, as
/// stencil tables on the vertices of that mesh.
///
/// The limit of a vertex under a dual scheme is the point in the middle of all the faces that
/// later levels put in its place.
///
/// # Example
/// ```
/// use carvel::{Context, Mesh, Scheme};
/// use carvel::limit::Limits;
/// use std::sync::Arc;
/// let cube = Arc::new(Mesh::from_polygons(8, &[4; 6], &[
///     0, 1, 3, 2, 4, 6, 7, 5, 0, 4, 5, 1, 2, 3, 7, 6, 0, 2, 6, 4, 1, 5, 7, 3,
/// ])?);
/// let limits = Limits::<f64>::new(&Context::serial(), &cube, &Scheme::catmull_clark())?;
/// let (vertices, weights) = limits.position().row(0);
/// // (9 + 4·3 + 3)/24 of the corners, of which each has 9/24 of itself.
/// let own = vertices.iter().position(|&v| v == 0).map(|i| weights[i]);
/// assert!((own.unwrap_or(0.0) - 9.0 / 24.0).abs() < 1e-15);
/// # Ok::<(), carvel::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Limits<T> {
    mesh: Arc<Mesh>,
    position: StencilTable<T>,
    tangents: [StencilTable<T>; 2],
}

impl<T: Scalar> Limits<T> {
    /// The limits of a mesh's vertices under a scheme: of a control mesh, or of a level
    /// ([`crate::Hierarchy::shared_mesh`]).
    ///
    /// Weights are computed in double precision from the scheme's own rows and rounded once.
    /// Vertices near a single feature use its rule; others are followed to later levels, in a
    /// part of the mesh around them under primal schemes. A dual scheme takes the time and memory
    /// of one level more, and of two where features are near each other; a primal one that of a
    /// walk around each vertex, and beside semi-sharp creases of as many levels as they last.
    ///
    /// # Errors
    /// As [`Scheme::check`]; [`ErrorKind::Unsupported`] for a mesh that is not manifold, for
    /// vertices with too many faces, on the boundary of a dual scheme that ends inside
    /// ([`crate::Boundary::None`]), and where points do not converge, naming the vertex;
    /// [`ErrorKind::TooLarge`], [`ErrorKind::MemoryCeiling`], [`ErrorKind::OutOfResources`],
    /// [`ErrorKind::Cancelled`].
    pub fn new(context: &Context, mesh: &Arc<Mesh>, scheme: &Scheme) -> Result<Self> {
        let rows = rows(context, mesh, scheme)?;
        let table = |k: usize| table(&rows, mesh.vertices(), k);
        let (position, tangents) = (table(0)?, [table(1)?, table(2)?]);
        Ok(Self { mesh: Arc::clone(mesh), position, tangents })
    }

    /// A row for each vertex: its limit position.
    pub fn position(&self) -> &StencilTable<T> {
        &self.position
    }

    /// Two tangents, the second counter-clockwise from the first seen from outside. Their
    /// lengths mean nothing. Rows are empty where the surface has no tangent plane. On a crease
    /// and at a corner they are those of one side.
    pub fn tangents(&self) -> [&StencilTable<T>; 2] {
        self.tangents.each_ref()
    }

    /// One table of three times as many rows: limit positions of all vertices, then their first
    /// tangents, then their second ones.
    ///
    /// # Errors
    /// [`ErrorKind::TooLarge`] for 2³² − 1 rows or weights and more,
    /// [`ErrorKind::OutOfResources`].
    pub fn stacked(&self) -> Result<StencilTable<T>> {
        let tables = [&self.position, &self.tangents[0], &self.tangents[1]];
        let (mut offsets, mut indices, mut weights) = (Vec::new(), Vec::new(), Vec::new());
        memory::extend(&mut offsets, [0])?;
        for table in tables {
            let before = indices.len() as u64;
            let ends = table.offsets()[1..].iter().map(|&end| before + u64::from(end));
            memory::extend(&mut offsets, ends)?;
            memory::extend(&mut indices, table.indices().iter().copied())?;
            memory::extend(&mut weights, table.weights().iter().copied())?;
        }
        StencilTable::new(self.position.columns(), &offsets, indices, weights)
    }

    /// Unit normals from positions of the mesh's vertices, three numbers each.
    ///
    /// Where there is no tangent plane, or both tangents are parallel as happens at collapsed
    /// faces, the normal is that of the polygons around the vertex, weighted by area; where they
    /// have none, or at an isolated vertex, it is zero.
    ///
    /// # Errors
    /// [`ErrorKind::LengthMismatch`] for other numbers of values, [`ErrorKind::NotFinite`],
    /// [`ErrorKind::OutOfResources`], [`ErrorKind::Cancelled`].
    pub fn normals(&self, context: &Context, positions: &[T], out: &mut [T]) -> Result<()> {
        if out.len() != 3 * self.mesh.vertices() {
            let message = format!("{} numbers for {} normals", out.len(), self.mesh.vertices());
            return Err(Error::new(ErrorKind::LengthMismatch, message));
        }
        if positions.len() != out.len() {
            let message = format!("{} numbers for {} positions", positions.len(), out.len() / 3);
            return Err(Error::new(ErrorKind::LengthMismatch, message));
        }
        if let Some(at) = positions.iter().position(|x| !x.to_f64().is_finite()) {
            let message = format!("the position of vertex {} is not finite", at / 3);
            return Err(Error::new(ErrorKind::NotFinite, message)
                .with_elements([Element::Vertex(at as u64 / 3)]));
        }
        context.fill(out, 3, |start, part| {
            for (v, normal) in (start..).zip(part.as_chunks_mut::<3>().0) {
                let tangents = [0, 1].map(|k| self.tangent(k, positions, v));
                let unit = match tangents {
                    [Some(first), Some(second)] => unit_normal::<T>([first, second]),
                    _ => None,
                };
                *normal = unit.unwrap_or_else(|| self.of_faces(positions, v)).map(T::from_f64);
            }
        })
    }

    /// A tangent at a vertex, if it is more than what rounding makes of equal points.
    fn tangent(&self, k: usize, positions: &[T], v: usize) -> Option<[f64; 3]> {
        let (vertices, weights) = self.tangents[k].row(v);
        let point = |v: u32| [0, 1, 2].map(|k| positions[3 * v as usize + k].to_f64());
        // Weights sum to zero but for rounding: sums of differences stay small where points do.
        let origin = point(*vertices.first()?);
        let (mut sum, mut size) = ([0.0; 3], 0.0);
        for (&v, weight) in vertices.iter().zip(weights) {
            let weight = weight.to_f64();
            let from = difference(point(v), origin);
            sum.iter_mut().zip(from).for_each(|(sum, x)| *sum += weight * x);
            size += weight.abs() * length(from);
        }
        (length(sum) > ROUNDING * epsilon::<T>() * size).then_some(sum)
    }

    /// The normal of the polygons around a vertex.
    fn of_faces(&self, positions: &[T], v: usize) -> [f64; 3] {
        let mesh = &self.mesh;
        let mut sum = [0.0; 3];
        for corner in mesh.fans(v as u32) {
            let around = mesh.layout.face_around(corner);
            let point = |c: u32| {
                let v = mesh.vert[c as usize] as usize;
                [0, 1, 2].map(|k| positions[3 * v + k].to_f64())
            };
            let origin = point(around.start);
            let from = |c: u32| difference(point(c), origin);
            for c in around.start + 1..around.end - 1 {
                let area = cross(from(c), from(c + 1));
                sum.iter_mut().zip(area).for_each(|(sum, x)| *sum += x);
            }
        }
        scaled(sum).unwrap_or([0.0; 3])
    }
}

/// Rounding errors of sums of some tens of terms, in units of the last place.
const ROUNDING: f64 = 64.0;

/// What 1 is rounded by.
fn epsilon<T: Scalar>() -> f64 {
    if T::BYTES == 4 { f64::from(f32::EPSILON) } else { f64::EPSILON }
}

/// The unit normal of two tangents that are not parallel.
fn unit_normal<T: Scalar>(tangents: [[f64; 3]; 2]) -> Option<[f64; 3]> {
    let [first, second] = [scaled(tangents[0])?, scaled(tangents[1])?];
    let normal = cross(first, second);
    (length(normal) > ROUNDING * epsilon::<T>()).then(|| scaled(normal)).flatten()
}

/// A vector of length 1, whatever its length was.
fn scaled(vector: [f64; 3]) -> Option<[f64; 3]> {
    let most = vector.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    if most == 0.0 || !most.is_finite() {
        return None;
    }
    let small = vector.map(|x| x / most);
    let length = length(small);
    Some(small.map(|x| x / length))
}

fn length(vector: [f64; 3]) -> f64 {
    vector.iter().map(|x| x * x).sum::<f64>().sqrt()
}

fn difference(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|k| a[k] - b[k])
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|k| {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        a[i] * b[j] - a[j] * b[i]
    })
}

/// One of the three weights of all rows.
fn table<T: Scalar>(rows: &Rows, columns: usize, k: usize) -> Result<StencilTable<T>> {
    let count = rows.offsets.len().saturating_sub(1);
    let mut offsets = memory::reserved(count + 1)?;
    let (mut indices, mut weights) = (Vec::new(), Vec::new());
    offsets.push(0);
    for row in rows.offsets.windows(2) {
        for &(v, all) in &rows.entries[row[0] as usize..row[1] as usize] {
            let weight = T::from_f64(all[k]);
            if weight != T::default() {
                memory::extend(&mut indices, [v])?;
                memory::extend(&mut weights, [weight])?;
            }
        }
        offsets.push(indices.len() as u64);
    }
    StencilTable::new(columns, &offsets, indices, weights)
}
