//! A norm in which some matrices do not grow: the invariant polytope.
//!
//! The polytope is the smallest set that holds ± some vectors and their segments. If the matrices
//! map each of its vertices into it, no product of them grows, so that their joint spectral
//! radius is 1 at most (Guglielmi and Protasov, *Exact computation of joint spectral
//! characteristics of linear operators*, 2013). Vertices are found in doubles. What is then
//! claimed does not rest on that: for every vertex and matrix a combination of vertices is at hand
//! that is the image but for a remainder, and both are bounded with all roundings counted.
//!
//! Whether a vector lies inside is a linear programme with as many equations as the space has
//! dimensions, solved here by a dense simplex method that starts from ± the axes: sixty lines
//! against a dependency whose start-up would cost more than the solution.

use super::spectral::Dense;

/// The part of the largest vector that the vertices on the axes have.
const AXIS: f64 = 1e-3;
/// How far above 1 the norm of an image may come out and still count as inside.
const SLACK: f64 = 1e-11;
/// Half the distance from 1 to the next double.
const ROUNDING: f64 = f64::EPSILON / 2.0;

/// ± these vectors span the unit ball.
pub(super) struct Polytope {
    size: usize,
    vertices: Vec<Vec<f64>>,
    axis: f64,
    /// Multiplications spent, and the most that may be.
    work: u64,
    most: u64,
}

impl Polytope {
    /// A polytope around some vectors.
    pub fn around(size: usize, vectors: &[Vec<f64>], most: u64) -> Self {
        let largest = vectors.iter().flatten().map(|x| x.abs()).fold(0.0, f64::max);
        let axis = if largest > 0.0 { AXIS * largest } else { 1.0 };
        let unit = |i: usize| (0..size).map(|j| if i == j { axis } else { 0.0 }).collect();
        let vertices = (0..size).map(unit).chain(vectors.iter().cloned()).collect();
        Self { size, vertices, axis, work: 0, most }
    }

    pub fn vertices(&self) -> usize {
        self.vertices.len()
    }

    /// Adds images of vertices until all are inside. Returns a bound γ on the norm of all
    /// matrices, a little above 1 at most; `None` if it takes too long or too large vectors.
    pub fn close(&mut self, matrices: &[Dense]) -> Option<f64> {
        /// A vertex so far outside says that the matrices do grow.
        const FAR: f64 = 1e4;
        let mut bound: f64 = 1.0;
        let mut next = 0;
        while next < self.vertices.len() {
            for matrix in matrices {
                let image = matrix.times(&self.vertices[next]);
                let norm = self.norm(matrix, next, &image);
                if norm > 1.0 + SLACK {
                    if norm > FAR || self.work > self.most {
                        return None;
                    }
                    self.vertices.push(image);
                    bound = bound.max(1.0 + self.rounding(matrix, next, &[]));
                } else {
                    bound = bound.max(norm);
                }
            }
            next += 1;
        }
        Some(bound)
    }

    /// A bound from above on the norm of the exact image of a vertex.
    fn norm(&mut self, matrix: &Dense, vertex: usize, image: &[f64]) -> f64 {
        let solution = self.combination(image);
        let sum: f64 = solution.iter().map(|(_, x)| x.abs()).sum();
        let mut rest = image.to_vec();
        for (j, x) in &solution {
            rest.iter_mut().zip(&self.vertices[*j]).for_each(|(r, v)| *r -= x * v);
        }
        let remainder: f64 = rest.iter().map(|r| r.abs()).sum();
        let counted = (sum + remainder / self.axis) * (1.0 + 64.0 * self.size as f64 * ROUNDING);
        counted + self.rounding(matrix, vertex, &solution)
    }

    /// A bound on the norm of all roundings: of the matrix's entries (each within half a
    /// unit), of the image, and of the remainder beside a combination.
    fn rounding(&self, matrix: &Dense, vertex: usize, solution: &[(usize, f64)]) -> f64 {
        let absolute = |v: &[f64]| v.iter().map(|x| x.abs()).collect::<Vec<_>>();
        let entries = absolute(&matrix.entries);
        let magnitudes =
            Dense { size: self.size, entries }.times(&absolute(&self.vertices[vertex]));
        let own: f64 = magnitudes.iter().sum();
        let term = |(j, x): &(usize, f64)| {
            x.abs() * self.vertices[*j].iter().map(|v| v.abs()).sum::<f64>()
        };
        let others: f64 = solution.iter().map(term).sum();
        let operations = (2 * self.size + solution.len() + 8) as f64;
        let underflow = operations * self.size as f64 * f64::MIN_POSITIVE;
        (2.0 * operations * ROUNDING * (own + others) + underflow) / self.axis
    }

    /// Vertices and coefficients whose absolute values have a small sum, by the simplex
    /// method: a sum of 1 or less proves that the target is inside.
    fn combination(&mut self, target: &[f64]) -> Vec<(usize, f64)> {
        let mut basis = Basis::of_axes(target, self.axis);
        for _ in 0..20 * self.size + 20 {
            self.work += ((self.vertices.len() + 3 * self.size) * self.size) as u64;
            if basis.sum() <= 1.0 || !basis.improve(&self.vertices) {
                break;
            }
        }
        basis.solution()
    }
}

/// A basis of the simplex method: signed vertices whose combination is the target.
struct Basis {
    size: usize,
    /// Vertex and sign of each member.
    members: Vec<(usize, f64)>,
    /// The inverse of the matrix whose columns are the members.
    inverse: Vec<f64>,
    /// Coefficients, none negative.
    values: Vec<f64>,
}

impl Basis {
    /// The vertices on the axes, which come first.
    fn of_axes(target: &[f64], axis: f64) -> Self {
        let size = target.len();
        let sign = |x: f64| if x < 0.0 { -1.0 } else { 1.0 };
        let members: Vec<_> = (0..size).map(|i| (i, sign(target[i]))).collect();
        let mut inverse = vec![0.0; size * size];
        for (i, (_, sign)) in members.iter().enumerate() {
            inverse[i * size + i] = sign / axis;
        }
        let values = target.iter().map(|x| x.abs() / axis).collect();
        Self { size, members, inverse, values }
    }

    fn sum(&self) -> f64 {
        self.values.iter().sum()
    }

    fn solution(&self) -> Vec<(usize, f64)> {
        let members = self.members.iter().zip(&self.values);
        members.map(|(&(j, sign), x)| (j, sign * x)).collect()
    }

    /// Lets in the vertex that saves most; false if none does.
    fn improve(&mut self, vertices: &[Vec<f64>]) -> bool {
        const TINY: f64 = 1e-13;
        let n = self.size;
        let mut prices = vec![0.0; n];
        for row in self.inverse.chunks_exact(n) {
            prices.iter_mut().zip(row).for_each(|(price, x)| *price += x);
        }
        let worth = |v: &Vec<f64>| v.iter().zip(&prices).map(|(x, price)| x * price).sum::<f64>();
        let (mut entering, mut gain) = (None, 1.0 + 1e-12);
        for (j, v) in vertices.iter().enumerate() {
            let worth = worth(v);
            if worth.abs() > gain {
                (entering, gain) = (Some((j, worth.signum())), worth.abs());
            }
        }
        let Some((j, sign)) = entering else { return false };
        let column =
            |row: &[f64]| sign * row.iter().zip(&vertices[j]).map(|(a, x)| a * x).sum::<f64>();
        let column: Vec<f64> = self.inverse.chunks_exact(n).map(column).collect();
        let ratio = |i: usize| self.values[i] / column[i];
        let candidates = (0..n).filter(|&i| column[i] > TINY);
        let Some(leaving) = candidates.min_by(|&a, &b| ratio(a).total_cmp(&ratio(b))) else {
            return false;
        };
        self.exchange(leaving, (j, sign), &column);
        true
    }

    fn exchange(&mut self, leaving: usize, entering: (usize, f64), column: &[f64]) {
        let (n, pivot) = (self.size, column[leaving]);
        let row: Vec<f64> = self.inverse[leaving * n..][..n].iter().map(|x| x / pivot).collect();
        let step = self.values[leaving] / pivot;
        let rows = self.inverse.chunks_exact_mut(n).zip(&mut self.values);
        for (i, ((own, value), factor)) in rows.zip(column).enumerate() {
            if i == leaving {
                own.copy_from_slice(&row);
                *value = step;
            } else {
                own.iter_mut().zip(&row).for_each(|(x, r)| *x -= factor * r);
                *value = (*value - factor * step).max(0.0);
            }
        }
        self.members[leaving] = entering;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_turn_keeps_a_polytope_and_growth_keeps_none() {
        let matrix = |entries: [f64; 4]| Dense { size: 2, entries: entries.to_vec() };
        let turn = matrix([0.0, -1.0, 1.0, 0.0]);
        let start = [vec![1.0, 0.0]];
        let bound = Polytope::around(2, &start, 1 << 20).close(std::slice::from_ref(&turn));
        assert!(bound.is_some_and(|bound| (1.0..1.0 + 1e-10).contains(&bound)), "{bound:?}");
        let grow = turn.scaled(1.01);
        assert!(Polytope::around(2, &start, 1 << 20).close(&[grow]).is_none());
        // 0.6 of a turn by 45 degrees: the octagon's images are inside.
        let eighth = matrix([0.6, -0.6, 0.6, 0.6]);
        assert!(Polytope::around(2, &start, 1 << 20).close(&[eighth, turn]).is_some());
    }
}
