//! Limit and tangent weights: left eigenvectors of a local matrix, by power iteration.
//!
//! Sums are taken in a fixed order, so that the same bits come out on every processor, which
//! no library of linear algebra promises. `analysis::surface` has the same weights by
//! eigenvalues of Fourier blocks; tests hold both to each other.

use super::local::Model;
use super::{Feature, LocalMatrix};
use crate::base::{Context, Error, ErrorKind, Result};

/// Rounds after which an iteration is given up; each makes an error smaller by the ratio of
/// two eigenvalues.
const ROUNDS: usize = 20_000;
/// Changes of normalised vectors by rounding alone.
const SETTLED: f64 = 4e-16;
/// Changes below which a vector that does not settle is good enough.
const NEARLY: f64 = 1e-13;
/// Weights that are smaller, relative to the largest, are rounding errors.
const ROUNDING: f64 = 1e-13;

/// A vertex of the model with its weights: of the position, and of two tangents.
pub(super) type Weighted = (u32, [f64; 3]);

/// The weights at the centre of a feature: the vertices of [`Model::mesh`] that have some.
///
/// Tangents are those of the plane over which the model is drawn: the first points along its
/// first axis, the second counter-clockwise from there. Without a tangent plane they are zero.
///
/// # Errors
/// [`ErrorKind::Unsupported`] if points do not converge.
pub(super) fn at_centre(
    context: &Context,
    model: &Model,
    matrix: &LocalMatrix<f64>,
) -> Result<Vec<Weighted>> {
    let rows = Rows::new(matrix);
    let position = rows.position(context, matrix.feature())?;
    let plane = plane(model, matrix.feature())?;
    let plane: Vec<[f64; 2]> = rows.vertices.iter().map(|&v| plane[v as usize]).collect();
    let none = || [0; 2].map(|_| vec![0.0; position.len()]);
    let pair = rows.tangents(context, &position, &plane)?.unwrap_or_else(none);
    let vectors = [&position, &pair[0], &pair[1]].map(|vector| without_rounding(vector));
    let weighted = |i: usize| (rows.vertices[i], [0, 1, 2].map(|k| vectors[k][i]));
    let some = |(_, weights): &Weighted| weights.iter().any(|&w| w != 0.0);
    Ok((0..position.len()).map(weighted).filter(some).collect())
}

/// A vector whose entries that are errors became zero.
fn without_rounding(vector: &[f64]) -> Vec<f64> {
    let most = ROUNDING * largest(vector);
    vector.iter().map(|&w| if w.abs() <= most { 0.0 } else { w }).collect()
}

fn largest(vector: &[f64]) -> f64 {
    vector.iter().fold(0.0, |most: f64, w| most.max(w.abs()))
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Adds a multiple of another vector.
fn add(to: &mut [f64], factor: f64, other: &[f64]) {
    to.iter_mut().zip(other).for_each(|(to, other)| *to += factor * other);
}

/// Scales to length 1; false if there is no length.
fn normalise(vector: &mut [f64]) -> bool {
    let length = dot(vector, vector).sqrt();
    for x in vector.iter_mut() {
        *x /= length;
    }
    length > f64::MIN_POSITIVE && length.is_finite()
}

/// The largest difference of two vectors.
fn change(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()))
}

/// A local matrix on the vertices that it speaks of.
struct Rows {
    vertices: Vec<u32>,
    rows: Vec<Vec<(u32, f64)>>,
}

impl Rows {
    fn new(matrix: &LocalMatrix<f64>) -> Self {
        let mut listed = Vec::new();
        matrix.each_vertex(|vertex, row| {
            listed.push((vertex, row.map(|(v, &weight)| (v, weight)).collect::<Vec<_>>()));
        });
        listed.sort_by_key(|row| row.0);
        let vertices: Vec<u32> = listed.iter().map(|row| row.0).collect();
        // A row speaks of vertices that have rows.
        let place = |v: u32| vertices.binary_search(&v).unwrap_or_default() as u32;
        let named = |row: Vec<(u32, f64)>| row.into_iter().map(|(v, w)| (place(v), w)).collect();
        let rows = listed.into_iter().map(|(_, row)| named(row)).collect();
        Self { vertices, rows }
    }

    /// A row vector times the matrix.
    fn times(&self, vector: &[f64]) -> Vec<f64> {
        let mut product = vec![0.0; vector.len()];
        for (&factor, row) in vector.iter().zip(&self.rows) {
            for &(place, weight) in row {
                product[place as usize] += factor * weight;
            }
        }
        product
    }

    /// The left eigenvector of 1, of sum 1.
    fn position(&self, context: &Context, feature: Feature) -> Result<Vec<f64>> {
        let mut vector = vec![1.0 / self.rows.len() as f64; self.rows.len()];
        let mut moved = f64::INFINITY;
        for round in 0..ROUNDS {
            look(context, round)?;
            let mut next = self.times(&vector);
            let sum: f64 = next.iter().sum();
            for weight in &mut next {
                *weight /= sum;
            }
            let before = moved;
            moved = change(&next, &vector);
            vector = next;
            if moved <= SETTLED || (moved <= NEARLY && moved >= before) {
                return Ok(vector);
            }
        }
        let message = format!("{feature}: points do not converge there");
        Err(Error::new(ErrorKind::Unsupported, message))
    }

    /// Left vectors of the plane that points tend to, or nothing.
    fn tangents(
        &self,
        context: &Context,
        position: &[f64],
        plane: &[[f64; 2]],
    ) -> Result<Option<[Vec<f64>; 2]>> {
        let mut pair = [0, 1].map(|k| plane.iter().map(|p| p[k]).collect::<Vec<f64>>());
        if without_position(position, &mut pair).is_none() {
            return Ok(None);
        }
        let mut moved = f64::INFINITY;
        for round in 0..ROUNDS {
            look(context, round)?;
            let mut next = pair.each_ref().map(|vector| self.times(vector));
            if without_position(position, &mut next).is_none() {
                break;
            }
            let before = moved;
            moved = change(&next[0], &pair[0]).max(change(&next[1], &pair[1]));
            pair = next;
            if moved <= SETTLED || (moved <= NEARLY && moved >= before) {
                return Ok(over(&pair, plane));
            }
        }
        Ok(None)
    }
}

/// Takes the eigenvector of 1 out of two vectors and makes them orthonormal.
fn without_position(position: &[f64], pair: &mut [Vec<f64>; 2]) -> Option<()> {
    for vector in pair.iter_mut() {
        // The right eigenvector of 1 has ones only.
        let sum: f64 = vector.iter().sum();
        add(vector, -sum, position);
    }
    let [first, second] = pair;
    let whole = normalise(first);
    let shared = dot(first, second);
    add(second, -shared, first);
    (normalise(second) && whole).then_some(())
}

/// Asks now and then whether to go on.
fn look(context: &Context, round: usize) -> Result<()> {
    if round.is_multiple_of(256) { context.check_cancelled() } else { Ok(()) }
}

/// The vectors of the same plane whose values on the plane's own points are its axes.
fn over(pair: &[Vec<f64>; 2], plane: &[[f64; 2]]) -> Option<[Vec<f64>; 2]> {
    let on = |vector: &[f64], k: usize| vector.iter().zip(plane).map(|(w, p)| w * p[k]).sum();
    let [[a, b], [c, d]]: [[f64; 2]; 2] = pair.each_ref().map(|v| [on(v, 0), on(v, 1)]);
    let determinant = a * d - b * c;
    if determinant.abs() <= 1e-9 * (a.abs() + b.abs()) * (c.abs() + d.abs()) {
        return None;
    }
    let mixed = |x: f64, y: f64| {
        let both = pair[0].iter().zip(&pair[1]);
        both.map(|(p, q)| (x * p + y * q) / determinant).collect()
    };
    Some([mixed(d, -b), mixed(-c, a)])
}

/// Where the vertices of a model lie if its control mesh is drawn in the plane.
fn plane(model: &Model, feature: Feature) -> Result<Vec<[f64; 2]>> {
    let control = feature.plane(model.rings);
    let mut points = vec![[0.0; 2]; model.mesh().vertices()];
    let out = points.as_flattened_mut();
    model.hierarchy.refine(&Context::serial(), 1, control.as_flattened(), 2, out)?;
    Ok(points)
}
