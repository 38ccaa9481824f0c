//! Cells of a face's coordinates: squares and triangles that halving leads to, in whole numbers.

use crate::limit::surface::{Sample, Surface};

/// The length of a side of a face.
pub(super) const UNIT: i32 = 1 << 26;
/// Halvings at most: a quarter of the smallest side is still a whole number.
pub(super) const MOST_LEVELS: u32 = 24;

/// Coordinates of a point, [`UNIT`] for 1.
pub(super) type Point = [i32; 2];

/// What part of a face has coordinates of its own.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::limit) enum Shape {
    /// All of a quad.
    Quad,
    /// The sector at a corner of another face.
    Sector,
    /// All of a triangle of Loop's scheme.
    Triangle,
}

/// A face, or a sector of one.
#[derive(Debug, Clone, Copy)]
pub(in crate::limit) struct Root {
    pub(in crate::limit) shape: Shape,
    pub(in crate::limit) face: u32,
    pub(in crate::limit) sector: u32,
    /// The corner that has coordinates (0, 0).
    pub(super) corner: u32,
}

impl Root {
    pub(in crate::limit) fn new(surface: &Surface, face: u32, sector: u32) -> Self {
        let corners = surface.mesh().layout.face(face);
        let shape = match corners.len() {
            _ if surface.is_triangle(face as usize) => Shape::Triangle,
            4 => Shape::Quad,
            _ => Shape::Sector,
        };
        Self { shape, face, sector, corner: corners.start + sector }
    }

    pub(super) fn sample(&self, point: Point) -> Sample {
        let [u, v] = point.map(|x| f64::from(x) / f64::from(UNIT));
        Sample { face: self.face, sector: self.sector, u, v }
    }
}

/// A square, or half of one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Cell {
    /// The first corner; that of the right angle in a triangle.
    pub(super) at: Point,
    /// To the next corner along u, and to the last along v. Negative in triangles that
    /// are turned by half a turn, as those in the middle of others are.
    pub(super) side: i32,
}

impl Cell {
    pub(super) const WHOLE: Self = Self { at: [0, 0], side: UNIT };

    /// The point so many quarters of the side from the first corner.
    pub(super) fn quarters(self, [i, j]: [i32; 2]) -> Point {
        let step = self.side / 4;
        [self.at[0] + i * step, self.at[1] + j * step]
    }

    /// The corners in quarters of the side, counter-clockwise.
    pub(super) fn corners(shape: Shape) -> &'static [[i32; 2]] {
        match shape {
            Shape::Triangle => &[[0, 0], [4, 0], [0, 4]],
            _ => &[[0, 0], [4, 0], [4, 4], [0, 4]],
        }
    }

    /// The four parts, those of a triangle at its corners first.
    pub(super) fn children(self, shape: Shape) -> [Self; 4] {
        let child = |i, j| Self { at: self.quarters([i, j]), side: self.side / 2 };
        match shape {
            Shape::Triangle => {
                let middle = Self { at: self.quarters([2, 2]), side: -self.side / 2 };
                [child(0, 0), child(2, 0), child(0, 2), middle]
            }
            _ => [child(0, 0), child(2, 0), child(0, 2), child(2, 2)],
        }
    }

    /// A point inside.
    pub(super) fn inside(self) -> Point {
        self.quarters([1, 1])
    }

    /// Halvings that led here.
    pub(super) fn level(self) -> u32 {
        UNIT.trailing_zeros() - self.side.trailing_zeros()
    }

    /// Along a curve that fills the face.
    pub(super) fn order(self) -> (u64, bool) {
        let low = self.at.map(|x| if self.side < 0 { x + self.side } else { x } as u64);
        let spread = |x: u64| (0..32).fold(0, |sum, bit| sum | (x >> bit & 1) << (2 * bit));
        (spread(low[0]) | spread(low[1]) << 1, self.side < 0)
    }
}
