//! Eigenvalues and eigenvectors of a local matrix, mode by mode.
//!
//! A turn by one face multiplies a vector of mode k by e^{2πik/n}. On such vectors the matrix
//! of an interior feature is a small block, one row for each orbit, and its eigenvalues are
//! those of all blocks. Other features have one block, the matrix itself.

use super::{Feature, LocalMatrix};
use crate::base::{Error, ErrorKind, Result, Weight};
use faer::{Mat, c64};
use std::f64::consts::TAU;

/// Eigenvalues that are not farther apart are one of several times; a Jordan block of two
/// parts by the root of a rounding error.
const APART: f64 = 1e-6;
/// Sizes that are not farther apart are equal.
const EQUAL: f64 = 1e-9;
/// Singular values below are zero.
const ZERO: f64 = 1e-9;
/// Smaller eigenvalues are left out.
const NOTHING: f64 = 1e-7;

/// An eigenvalue of one mode.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Eigenvalue {
    /// Its real and imaginary part.
    pub value: [f64; 2],
    /// Its mode, from 0 to half the sectors; mode k stands for n − k, too.
    pub mode: usize,
    /// How often it comes in its block.
    pub copies: usize,
    /// Independent eigenvectors; fewer than copies in a Jordan block, where powers grow by
    /// a further factor of their exponent.
    pub vectors: usize,
}

impl Eigenvalue {
    /// Its absolute value.
    pub fn size(&self) -> f64 {
        libm::hypot(self.value[0], self.value[1])
    }

    /// How often it comes in the whole matrix of so many sectors.
    pub fn multiplicity(&self, sectors: usize) -> usize {
        let twice = self.mode > 0 && 2 * self.mode != sectors;
        self.copies << usize::from(twice)
    }
}

/// The eigenvalues of a local matrix, largest first, those without effect left out.
#[derive(Debug, Clone)]
pub struct Spectrum {
    feature: Feature,
    sectors: usize,
    eigenvalues: Vec<Eigenvalue>,
}

impl Spectrum {
    /// The spectrum of a matrix.
    ///
    /// # Errors
    /// [`ErrorKind::BrokenInvariant`] if the iteration for eigenvalues does not converge.
    pub fn new(matrix: &LocalMatrix<f64>) -> Result<Self> {
        let mut eigenvalues = Vec::new();
        for mode in 0..=matrix.sectors() / 2 {
            eigenvalues.extend(block_eigenvalues(matrix, mode)?);
        }
        eigenvalues.sort_by(|a: &Eigenvalue, b| b.size().total_cmp(&a.size()));
        // Of equals the lower mode comes first.
        let same = |a: &Eigenvalue, b: &Eigenvalue| a.size() - b.size() <= EQUAL;
        for equals in eigenvalues.chunk_by_mut(same) {
            equals.sort_by(|a, b| a.mode.cmp(&b.mode).then(b.value[0].total_cmp(&a.value[0])));
        }
        Ok(Self { feature: matrix.feature(), sectors: matrix.sectors(), eigenvalues })
    }

    /// The feature.
    pub fn feature(&self) -> Feature {
        self.feature
    }

    /// Turns that lead back to the start.
    pub fn sectors(&self) -> usize {
        self.sectors
    }

    /// Eigenvalues by mode, largest first.
    pub fn eigenvalues(&self) -> &[Eigenvalue] {
        &self.eigenvalues
    }

    /// All eigenvalues, each as often as it comes.
    pub fn all(&self) -> impl Iterator<Item = Eigenvalue> + '_ {
        let repeat = |e: &Eigenvalue| std::iter::repeat_n(*e, e.multiplicity(self.sectors));
        self.eigenvalues.iter().flat_map(repeat)
    }

    /// The largest eigenvalue beside the first.
    pub fn lambda(&self) -> f64 {
        self.all().nth(1).map_or(0.0, |e| e.size())
    }

    /// The largest one beside the first three.
    pub fn mu(&self) -> f64 {
        self.all().nth(3).map_or(0.0, |e| e.size())
    }
}

/// The matrix on vectors of one mode.
pub(super) fn block(matrix: &LocalMatrix<f64>, mode: usize) -> Mat<c64> {
    let orbits = present(matrix, mode);
    let mut place = vec![None; matrix.orbits()];
    for (i, &orbit) in orbits.iter().enumerate() {
        place[orbit] = Some(i);
    }
    let mut block = Mat::<c64>::zeros(orbits.len(), orbits.len());
    for (i, &orbit) in orbits.iter().enumerate() {
        for (other, sector, &weight) in matrix.row(orbit) {
            if let Some(j) = place[other] {
                block[(i, j)] += turn(mode * sector, matrix.sectors()) * weight;
            }
        }
    }
    block
}

/// The orbits that a mode has: a vertex in the middle has mode 0 alone.
pub(super) fn present(matrix: &LocalMatrix<f64>, mode: usize) -> Vec<usize> {
    let full = |&orbit: &usize| mode == 0 || matrix.orbit_size(orbit) == matrix.sectors();
    (0..matrix.orbits()).filter(full).collect()
}

/// e^{2πij/n}.
pub(super) fn turn(j: usize, n: usize) -> c64 {
    let sine = libm::sin(TAU * (j % n) as f64 / n as f64);
    c64::new(f64::cos_turn(j, n), sine)
}

fn failed() -> Error {
    Error::new(ErrorKind::BrokenInvariant, "eigenvalues of a local matrix did not converge")
}

fn block_eigenvalues(matrix: &LocalMatrix<f64>, mode: usize) -> Result<Vec<Eigenvalue>> {
    let block = block(matrix, mode);
    let mut found = Vec::new();
    if block.nrows() == 0 {
        return Ok(found);
    }
    let mut rest = block.eigenvalues().map_err(|_| failed())?;
    while let Some(first) = rest.pop() {
        // A cluster grows by what is near its middle.
        let mut cluster = vec![first];
        let mut middle = first;
        while let Some(i) = rest.iter().position(|&e| (e - middle).norm() <= APART) {
            cluster.push(rest.swap_remove(i));
            middle = cluster.iter().sum::<c64>() / cluster.len() as f64;
        }
        let vectors = match cluster.len() {
            1 => 1,
            _ => null_vectors(&block, middle, Side::Right)?.len().min(cluster.len()),
        };
        let members = cluster.len();
        // No eigenvector in the middle: they are near each other, but not the same.
        let (parts, vectors) = if vectors == 0 { (cluster, 1) } else { (vec![middle], vectors) };
        let copies = if parts.len() == 1 { members } else { 1 };
        for part in parts.into_iter().filter(|part| part.norm() >= NOTHING) {
            let value = [part.re, if part.im.abs() < ZERO { 0.0 } else { part.im }];
            found.push(Eigenvalue { value, mode, copies, vectors });
        }
    }
    Ok(found)
}

/// Which eigenvectors.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Side {
    /// Rows u with u·B = λu: weights.
    Left,
    /// Columns v with B·v = λv: shapes.
    Right,
}

/// The eigenvectors of a block to an eigenvalue, orthonormal, the best first.
pub(super) fn null_vectors(block: &Mat<c64>, value: c64, side: Side) -> Result<Vec<Vec<c64>>> {
    let n = block.nrows();
    let mut shifted = block.clone();
    for i in 0..n {
        shifted[(i, i)] -= value;
    }
    let svd = shifted.svd().map_err(|_| failed())?;
    let sizes = svd.S().column_vector();
    let vector = |k: usize| match side {
        Side::Right => (0..n).map(|i| svd.V()[(i, k)]).collect(),
        Side::Left => (0..n).map(|i| svd.U()[(i, k)].conj()).collect(),
    };
    Ok((0..n).rev().take_while(|&k| sizes[k].norm() <= ZERO).map(vector).collect())
}
