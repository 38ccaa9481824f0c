//! The polygon mesh of the oracle: a face list and positions, nothing derived.

use num_rational::BigRational;

use super::number::{Number, Point, exact};

#[derive(Clone, Debug, PartialEq)]
pub struct Poly<N> {
    pub positions: Vec<Point<N>>,
    /// Cycles of vertex indices, counter-clockwise seen from outside.
    pub faces: Vec<Vec<usize>>,
    /// Whether the boundary is an anchor row (see [`super::reference`]).
    pub anchored: bool,
    /// Boundary vertices that the caller tagged as corners.
    pub tags: Vec<usize>,
}

impl<N: Number> Poly<N> {
    /// A control mesh: not anchored, nothing tagged.
    pub fn new(positions: Vec<Point<N>>, faces: Vec<Vec<usize>>) -> Self {
        Self { positions, faces, anchored: false, tags: Vec::new() }
    }

    /// The same mesh with every position mapped.
    pub fn map<M: Number>(&self, f: impl FnMut(&Point<N>) -> Point<M>) -> Poly<M> {
        Poly {
            positions: self.positions.iter().map(f).collect(),
            faces: self.faces.clone(),
            anchored: self.anchored,
            tags: self.tags.clone(),
        }
    }

    pub fn to_doubles(&self) -> Poly<f64> {
        self.map(|p| std::array::from_fn(|k| p[k].to_double()))
    }

    /// The number of corners.
    pub fn corner_count(&self) -> usize {
        self.faces.iter().map(Vec::len).sum()
    }
}

impl Poly<f64> {
    /// The same mesh with every double taken at its exact value.
    pub fn to_exact(&self) -> Poly<BigRational> {
        self.map(|p| p.map(exact))
    }
}
