//! Cells: what a point of the surface is looked up in, and which child cell it lies in.
//!
//! Every cell belongs to a corner and has coordinates (s, t) in it: s along the corner's outgoing
//! edge, t along the edge before it. A step takes a cell to cells of the child mesh by maps
//! whose factors are 0, ±1 and ±2; most are exact in floating point.

use crate::base::{NONE, Result};
use crate::hierarchy::Hierarchy;
use crate::mesh::Mesh;
use crate::refine::FaceOrigin;
use crate::scheme::Scheme;

/// What a cell is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    /// A quad of a primal scheme, from its corner's vertex to the opposite one.
    Quad,
    /// The part of a face that is no quad that a primal scheme makes the corner's quad of.
    Sector,
    /// The quarter of a face between a corner's vertex and the face's middle, for dual schemes.
    Quarter,
    /// A triangle of Loop's scheme, s + t ≤ 1.
    Triangle,
}

/// An affine map of the plane.
#[derive(Debug, Clone, Copy)]
pub(super) struct Map {
    pub(super) linear: [[f64; 2]; 2],
    shift: [f64; 2],
}

const fn map(linear: [[f64; 2]; 2], shift: [f64; 2]) -> Map {
    Map { linear, shift }
}

pub(super) const IDENTITY: Map = map([[1.0, 0.0], [0.0, 1.0]], [0.0, 0.0]);

/// From a quad to the quarters at its corners, in order.
const QUARTERS: [Map; 4] = [
    map([[2.0, 0.0], [0.0, 2.0]], [0.0, 0.0]),
    map([[0.0, 2.0], [-2.0, 0.0]], [0.0, 2.0]),
    map([[-2.0, 0.0], [0.0, -2.0]], [2.0, 2.0]),
    map([[0.0, -2.0], [2.0, 0.0]], [2.0, 0.0]),
];
/// From a quarter to those around its child vertex: in the face, on the edge, in the face of the
/// vertex, on the edge before.
const AROUND: [Map; 4] = [
    map([[2.0, 0.0], [0.0, 2.0]], [-1.0, -1.0]),
    map([[0.0, -2.0], [2.0, 0.0]], [1.0, -1.0]),
    map([[-2.0, 0.0], [0.0, -2.0]], [1.0, 1.0]),
    map([[0.0, 2.0], [-2.0, 0.0]], [-1.0, 1.0]),
];
/// From a triangle to those at its corners and that in the middle, turned.
const TRIANGLES: [Map; 4] = [
    map([[2.0, 0.0], [0.0, 2.0]], [0.0, 0.0]),
    map([[2.0, 0.0], [0.0, 2.0]], [-1.0, 0.0]),
    map([[2.0, 0.0], [0.0, 2.0]], [0.0, -1.0]),
    map([[-2.0, 0.0], [0.0, -2.0]], [1.0, 1.0]),
];

impl Map {
    pub(super) fn apply(&self, [s, t]: [f64; 2]) -> [f64; 2] {
        let [[a, b], [c, d]] = self.linear;
        [a * s + b * t + self.shift[0], c * s + d * t + self.shift[1]]
    }

    /// This map after another.
    pub(super) fn following(&self, first: &Map) -> Map {
        map(self.after(first.linear), self.apply(first.shift))
    }

    /// The linear part of this map after another.
    pub(super) fn after(&self, first: [[f64; 2]; 2]) -> [[f64; 2]; 2] {
        let entry =
            |i: usize, j: usize| self.linear[i][0] * first[0][j] + self.linear[i][1] * first[1][j];
        [[entry(0, 0), entry(0, 1)], [entry(1, 0), entry(1, 1)]]
    }
}

/// The corner of a quad in whose quarter a point lies, counted from the first, and the map there.
pub(super) fn quarter([s, t]: [f64; 2]) -> (usize, Map) {
    // 0, 1, 2, 3 for (no, no), (yes, no), (yes, yes), (no, yes), without a branch that no
    // processor could foresee.
    let [right, upper] = [s, t].map(|x| usize::from(x >= 0.5));
    let at = (right ^ upper) + 2 * upper;
    (at, QUARTERS[at])
}

/// Halvings of a cell that [`Kind::part`] tells apart.
pub(super) const HALVINGS: u32 = 3;
const PARTS_ALONG: u32 = 1 << HALVINGS;
/// Parts of a cell: squares, or the triangles that they are cut into.
pub(super) const PARTS: usize = 2 * (PARTS_ALONG * PARTS_ALONG) as usize;

impl Kind {
    /// The number of the part of a cell that a point lies in, and a point inside that part.
    #[inline(always)]
    pub(super) fn part(self, at: [f64; 2]) -> (usize, [f64; 2]) {
        Self::part_of(self == Self::Triangle, at)
    }

    /// The same for a triangle or any other cell.
    #[inline(always)]
    pub(super) fn part_of(is_triangle: bool, at: [f64; 2]) -> (usize, [f64; 2]) {
        let along = f64::from(PARTS_ALONG);
        let [mut i, j] = at.map(|x| ((along * x) as u32).min(PARTS_ALONG - 1));
        if is_triangle {
            // On the side s + t = 1.
            i = i.min(PARTS_ALONG - 1 - j);
        }
        let first = [i, j].map(f64::from);
        let rest = along * at[0] - first[0] + (along * at[1] - first[1]);
        let upper = is_triangle && rest > 1.0 && i + j + 1 < PARTS_ALONG;
        let inside = match (is_triangle, upper) {
            (false, _) => 0.5,
            (true, false) => 0.25,
            (true, true) => 0.75,
        };
        let part = 2 * (j * PARTS_ALONG + i) + u32::from(upper);
        (part as usize, first.map(|x| (x + inside) / along))
    }

    /// The cell of a scheme at a corner.
    pub(super) fn at(scheme: &Scheme, mesh: &Mesh, corner: u32) -> Self {
        use crate::scheme::SplitKind::{Corner, Quad, Triangle};
        match scheme.split() {
            Corner => Self::Quarter,
            Triangle => Self::Triangle,
            Quad if mesh.layout.face_around(corner).len() == 4 => Self::Quad,
            Quad => Self::Sector,
        }
    }

    /// Which child cell a point lies in, and the map there.
    pub(super) fn child(self, at: [f64; 2]) -> (usize, Map) {
        let [s, t] = at;
        match self {
            Self::Quad => quarter(at),
            Self::Sector => (0, IDENTITY),
            Self::Quarter => {
                // 0, 1, 2, 3 for (yes, yes), (yes, no), (no, no), (no, yes).
                let [left, lower] = [s, t].map(|x| usize::from(x < 0.5));
                let place = (left ^ lower) + 2 * left;
                (place, AROUND[place])
            }
            Self::Triangle => {
                let place = if s >= 0.5 {
                    1
                } else if t >= 0.5 {
                    2
                } else {
                    // The middle begins beyond the line between two midpoints.
                    3 * usize::from(s + t > 0.5)
                };
                (place, TRIANGLES[place])
            }
        }
    }

    /// The corners of the child cells in the mesh of level 1, [`NONE`] where there is none.
    pub(super) fn children(self, hierarchy: &Hierarchy, corner: u32) -> Result<Vec<u32>> {
        let (parent, child) = (hierarchy.mesh(0), hierarchy.mesh(1));
        let pieces = hierarchy.scheme().pieces();
        let [next, before] = [parent.next(corner), parent.prev(corner)];
        Ok(match self {
            Self::Quad => {
                let around = [corner, next, parent.next(next), before];
                around.map(|c| pieces.start_half(c)).to_vec()
            }
            Self::Sector => vec![pieces.start_half(corner)],
            Self::Triangle => {
                let at = |c: u32, turn: u32| pieces.start_half(c) + turn;
                let first = corner - corner % 3;
                let middle = pieces.start_half(first) + 9 + before % 3;
                vec![at(corner, 0), at(next, 2), at(before, 1), middle]
            }
            Self::Quarter => {
                let origins = hierarchy.face_origins(1)?;
                let mut around = vec![NONE; 4];
                for c in child.fan(corner) {
                    let place = match origins[child.layout.face_of(c) as usize] {
                        FaceOrigin::Vertex(_) => 2,
                        FaceOrigin::Edge(edge)
                            if parent.first_of_edge(edge) == parent.first_of_edge(corner) =>
                        {
                            1
                        }
                        FaceOrigin::Edge(_) => 3,
                        FaceOrigin::Face(_) | FaceOrigin::Corner(_) => 0,
                    };
                    around[place] = c;
                }
                around
            }
        })
    }
}
