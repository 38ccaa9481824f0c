//! Limit and tangent weights: left eigenvectors of a local matrix.

use super::spectrum::{Side, block, null_vectors, present, turn};
use super::{LocalMatrix, Spectrum};
use crate::base::{Error, ErrorKind, Result};
use faer::c64;

/// Weights smaller than this, of their largest, are rounding errors.
const ROUNDING: f64 = 1e-13;

/// A weight for each vertex around a feature, by orbit and sector.
#[derive(Debug, Clone, PartialEq)]
pub struct VertexWeights(Vec<Vec<f64>>);

impl VertexWeights {
    /// The weights of an orbit's vertices.
    ///
    /// # Panics
    /// If there is no such orbit.
    pub fn orbit(&self, orbit: usize) -> &[f64] {
        &self.0[orbit]
    }

    /// All weights, orbit by orbit, up to the last orbit that has some.
    pub fn orbits(&self) -> &[Vec<f64>] {
        let nothing = |weights: &Vec<f64>| weights.iter().all(|&w| w == 0.0);
        let count = self.0.iter().rposition(|weights| !nothing(weights)).map_or(0, |last| last + 1);
        &self.0[..count]
    }

    /// Without what is nothing but a rounding error.
    fn rounded(mut self) -> Self {
        let largest = self.0.iter().flatten().fold(0.0, |most: f64, w| most.max(w.abs()));
        for weight in self.0.iter_mut().flatten().filter(|w| w.abs() <= ROUNDING * largest) {
            *weight = 0.0;
        }
        self
    }

    /// The real part of a mode's vector, spread over all sectors.
    fn spread(matrix: &LocalMatrix<f64>, mode: usize, vector: &[c64], phase: c64) -> Self {
        let orbits = present(matrix, mode);
        let mut weights: Vec<Vec<f64>> =
            (0..matrix.orbits()).map(|orbit| vec![0.0; matrix.orbit_size(orbit)]).collect();
        for (&orbit, &entry) in orbits.iter().zip(vector) {
            for (sector, weight) in weights[orbit].iter_mut().enumerate() {
                *weight = (entry * phase * turn(mode * sector, matrix.sectors()).conj()).re;
            }
        }
        Self(weights)
    }
}

/// Where the middle of a feature goes, and two directions that span the tangent plane there.
#[derive(Debug, Clone)]
pub struct LimitWeights {
    /// The limit of the vertex or the middle of the face; weights sum to 1.
    pub position: VertexWeights,
    /// Two tangents; absent where the eigenvalues promise no tangent plane. Around an interior
    /// feature the second lies a quarter of a turn on, counter-clockwise seen from outside;
    /// elsewhere they are any two that span the plane. Largest weight 1.
    pub tangents: Option<[VertexWeights; 2]>,
}

impl LimitWeights {
    /// The weights of a matrix.
    ///
    /// # Errors
    /// [`ErrorKind::Unsupported`] if points do not converge: 1 is no simple eigenvalue or others
    /// are larger; [`ErrorKind::BrokenInvariant`] if an iteration fails.
    pub fn new(matrix: &LocalMatrix<f64>, spectrum: &Spectrum) -> Result<Self> {
        let position = position(matrix, spectrum)?;
        let tangents = match tangent_mode(spectrum) {
            Some(Tangents::Turning(lambda)) => Some(turning(matrix, lambda)?),
            Some(Tangents::Separate(pair)) => Some(separate(matrix, pair)?),
            None => None,
        };
        Ok(Self { position, tangents })
    }
}

fn position(matrix: &LocalMatrix<f64>, spectrum: &Spectrum) -> Result<VertexWeights> {
    let first = spectrum.eigenvalues().first();
    let one = |e: &&super::Eigenvalue| (e.value[0] - 1.0).abs() < 1e-9 && e.value[1] == 0.0;
    let simple = first.filter(one).filter(|e| e.copies == 1 && e.mode == 0);
    let converges = simple.is_some() && spectrum.lambda() < 1.0 - 1e-9;
    let vectors = null_vectors(&block(matrix, 0), c64::new(1.0, 0.0), Side::Left)?;
    match vectors.first() {
        Some(vector) if converges => {
            let sum: c64 = vector.iter().sum();
            // Entries are those of whole orbits.
            let sizes = present(matrix, 0).into_iter().map(|orbit| matrix.orbit_size(orbit) as f64);
            let each: Vec<c64> = vector.iter().zip(sizes).map(|(&w, size)| w / size).collect();
            Ok(VertexWeights::spread(matrix, 0, &each, sum.inv()).rounded())
        }
        _ => {
            let message = format!("{}: points do not converge there", matrix.feature());
            Err(Error::new(ErrorKind::Unsupported, message))
        }
    }
}

/// How the tangent plane comes about.
pub(super) enum Tangents {
    /// By modes 1 and n − 1 with one eigenvalue.
    Turning(f64),
    /// By two real eigenvalues of a matrix without symmetry.
    Separate([f64; 2]),
}

/// The eigenvalues of the tangent plane: real, positive, two with an eigenvector each, larger
/// than all that follow and smaller than 1.
pub(super) fn tangent_mode(spectrum: &Spectrum) -> Option<Tangents> {
    let [second, third] = [spectrum.all().nth(1)?, spectrum.all().nth(2)?];
    let fourth = spectrum.mu();
    let real = |e: &super::Eigenvalue| e.value[1] == 0.0 && e.value[0] > 0.0;
    let first = spectrum.all().next()?;
    let converges = (first.value[0] - 1.0).abs() < 1e-9 && second.size() < 1.0 - 1e-9;
    if !converges || !real(&second) || !real(&third) || third.size() <= fourth + 1e-9 {
        return None;
    }
    if spectrum.sectors() > 1 {
        let turning = second.mode == 1 && third == second && second.copies == 1;
        return turning.then(|| Tangents::Turning(second.value[0]));
    }
    let whole = second.copies == second.vectors && third.copies == third.vectors;
    whole.then(|| Tangents::Separate([second.value[0], third.value[0]]))
}

/// The largest entry becomes 1 and real.
fn phase(vector: &[c64]) -> c64 {
    let largest = vector.iter().fold(c64::new(0.0, 0.0), |most, &w| {
        // Of almost equal ones the first counts, whatever the rounding.
        if w.norm() > most.norm() * (1.0 + 1e-6) { w } else { most }
    });
    largest.inv()
}

fn turning(matrix: &LocalMatrix<f64>, lambda: f64) -> Result<[VertexWeights; 2]> {
    let vectors = null_vectors(&block(matrix, 1), c64::new(lambda, 0.0), Side::Left)?;
    let vector = vectors.first().ok_or_else(no_vector)?;
    let along = phase(vector);
    // A quarter of a turn farther in the direction of the sectors.
    let across = along * c64::new(0.0, 1.0);
    Ok([along, across].map(|phase| VertexWeights::spread(matrix, 1, vector, phase).rounded()))
}

fn separate(matrix: &LocalMatrix<f64>, pair: [f64; 2]) -> Result<[VertexWeights; 2]> {
    let block = block(matrix, 0);
    let mut found = null_vectors(&block, c64::new(pair[0], 0.0), Side::Left)?;
    if found.len() < 2 {
        found.extend(null_vectors(&block, c64::new(pair[1], 0.0), Side::Left)?);
    }
    let [one, other] = found.get(..2).ok_or_else(no_vector)? else { return Err(no_vector()) };
    Ok([one, other].map(|vector| VertexWeights::spread(matrix, 0, vector, phase(vector)).rounded()))
}

fn no_vector() -> Error {
    Error::new(ErrorKind::BrokenInvariant, "an eigenvalue without an eigenvector")
}
