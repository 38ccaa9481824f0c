//! The kernel's weights in exact arithmetic.

use std::ops::{Add, Mul, Sub};

use carvel::Hierarchy;
use carvel::base::Weight;
use num_rational::BigRational;

use super::number::{self, Number};

/// A rational number as the kernel's [`Weight`].
#[derive(Clone, Debug, PartialEq)]
pub struct Exact(pub BigRational);

impl Add for Exact {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self(self.0 + other.0)
    }
}

impl Sub for Exact {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self(self.0 - other.0)
    }
}

impl Mul for Exact {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        Self(self.0 * other.0)
    }
}

impl Weight for Exact {
    fn ratio(num: i64, den: i64) -> Self {
        Self(number::ratio(num, den))
    }

    fn cos_turn(j: usize, n: usize) -> Self {
        Self(BigRational::cos_turn(j, n))
    }
}

/// One row: (vertex, weight), a vertex perhaps more than once.
pub type Row<W> = Vec<(u32, W)>;

/// The rows of one step: `stages[stage][vertex]`.
pub fn stages<W: Weight>(hierarchy: &Hierarchy, level: u32) -> Vec<Vec<Row<W>>> {
    let mut stages: Vec<Vec<Row<W>>> = Vec::new();
    let each = |stage: usize, vertex: u32, row: &[(u32, W)]| {
        if stages.len() == stage {
            stages.push(Vec::new());
        }
        assert_eq!(stages.len(), stage + 1, "stages come in order");
        assert_eq!(stages[stage].len(), vertex as usize, "vertices come in order");
        stages[stage].push(row.to_vec());
    };
    hierarchy.each_row(level, each).expect("a level that was built");
    stages
}

/// One coordinate through one step, exactly.
pub fn apply_exactly(stages: &[Vec<Row<Exact>>], values: &[BigRational]) -> Vec<BigRational> {
    let dot = |row: &Row<Exact>, x: &[BigRational]| {
        let terms: Vec<_> = row.iter().map(|(v, w)| (&w.0, &x[*v as usize])).collect();
        BigRational::dot(&terms)
    };
    let stage =
        |x: Vec<BigRational>, rows: &Vec<Row<Exact>>| rows.iter().map(|row| dot(row, &x)).collect();
    stages.iter().fold(values.to_vec(), stage)
}

/// One coordinate through one step, in doubles, naively.
pub fn apply_naively(stages: &[Vec<Row<f64>>], values: &[f64]) -> Vec<f64> {
    let stage = |x: Vec<f64>, rows: &Vec<Row<f64>>| {
        let dot = |row: &Row<f64>| row.iter().map(|(v, w)| w * x[*v as usize]).sum();
        rows.iter().map(dot).collect()
    };
    stages.iter().fold(values.to_vec(), stage)
}
