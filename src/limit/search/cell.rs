//! Cells of a face's coordinates, so small as doubles allow: all their corners are dyadic, and
//! exact.

use crate::limit::surface::Sample;
use crate::limit::tessellate::{Root, Shape};

/// The shortest side: a quarter of it is still a difference of doubles below 1.
const SMALLEST: f64 = 1.0 / (1_u64 << 50) as f64;

/// A square, or half of one: that of the right angle at the first corner.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Cell {
    pub(super) at: [f64; 2],
    /// Negative in triangles that are turned by half a turn.
    pub(super) side: f64,
}

impl Cell {
    pub(super) const WHOLE: Self = Self { at: [0.0; 2], side: 1.0 };

    /// The point with coordinates in the cell itself.
    pub(super) fn place(self, [s, t]: [f64; 2]) -> [f64; 2] {
        [self.at[0] + self.side * s, self.at[1] + self.side * t]
    }

    /// The four parts, those of a triangle at its corners first.
    pub(super) fn children(self, shape: Shape) -> [Self; 4] {
        let child = |s, t| Self { at: self.place([s, t]), side: self.side / 2.0 };
        let last = match shape {
            Shape::Triangle => Self { side: -self.side / 2.0, ..child(0.5, 0.5) },
            _ => child(0.5, 0.5),
        };
        [child(0.0, 0.0), child(0.5, 0.0), child(0.0, 0.5), last]
    }

    /// True if it is not to be divided further.
    pub(super) fn is_smallest(self) -> bool {
        self.side.abs() <= SMALLEST
    }
}

/// The corners of a cell in its own coordinates, counter-clockwise.
pub(super) fn corners(shape: Shape) -> &'static [[f64; 2]] {
    match shape {
        Shape::Triangle => &[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]],
        _ => &[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]],
    }
}

/// The middle of a cell in its own coordinates.
pub(super) fn middle(shape: Shape) -> [f64; 2] {
    match shape {
        Shape::Triangle => [1.0 / 3.0; 2],
        _ => [0.5; 2],
    }
}

/// Moves a point into the unit square or triangle.
pub(super) fn within(shape: Shape, [s, t]: [f64; 2]) -> [f64; 2] {
    if shape != Shape::Triangle || s + t <= 1.0 {
        let [s, t] = [s, t].map(|x| x.clamp(0.0, 1.0));
        return if shape == Shape::Triangle { [s, t.min(1.0 - s)] } else { [s, t] };
    }
    let s = (0.5 * (s - t + 1.0)).clamp(0.0, 1.0);
    [s, 1.0 - s]
}

/// A point of a face or sector.
pub(super) fn sample(root: &Root, at: [f64; 2]) -> Sample {
    let [u, v] = within(root.shape, at);
    Sample { face: root.face, sector: root.sector, u, v }
}
