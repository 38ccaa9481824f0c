//! Where the vertices of a refined face lie in a square array.
//!
//! A quad refined k times is a grid of n = 2ᵏ by n cells, a triangle half of such a grid:
//! corner 0 at (0, 0), corner 1 at (n, 0), the last at (0, n). Around it lies a ring one
//! cell wide, so that the array has n + 3 rows of n + 3 places.

use super::Pieces;
use crate::base::{Result, memory};

/// The deepest patches: 32 by 32 faces and what they come from fit a first-level cache.
pub(crate) const DEEPEST: u32 = 5;

/// Places in the largest array, rounded up to a power of two: an index that is cut to
/// that many bits needs no check.
const PLACES: usize = 2048;

/// The array behind a patch.
pub(crate) type PatchArray<V> = Box<[V; PLACES]>;

/// An array behind a patch.
pub(crate) fn patch_array<V: Copy>(value: V) -> Result<PatchArray<V>> {
    let list = memory::filled(value, PLACES)?.into_boxed_slice();
    Ok(list.try_into().unwrap_or_else(|_| unreachable!("the list is that long")))
}

/// An index of such an array.
#[inline(always)]
pub(crate) fn within(index: u16) -> usize {
    index as usize % PLACES
}

/// A place in the grid: x, y.
pub(crate) type Place = [i32; 2];

/// The directions of the edges at a vertex, counter-clockwise.
const QUADS: [Place; 4] = [[1, 0], [0, 1], [-1, 0], [0, -1]];
const TRIANGLES: [Place; 6] = [[1, 0], [0, 1], [-1, 1], [-1, 0], [0, -1], [1, -1]];

/// The grid of a face that was refined some number of times.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PatchGrid {
    pieces: Pieces,
    cells: i32,
}

impl PatchGrid {
    pub(crate) fn new(pieces: Pieces, level: u32) -> Self {
        debug_assert!(level <= DEEPEST);
        Self { pieces, cells: 1 << level }
    }

    /// Cells along a side.
    pub(crate) fn cells(self) -> usize {
        self.cells as usize
    }

    /// Places in a row of the array.
    pub(crate) fn row(self) -> usize {
        self.cells as usize + 3
    }

    /// Places in the array.
    pub(crate) fn places(self) -> usize {
        self.row() * self.row()
    }

    /// The index of a place.
    #[inline(always)]
    pub(crate) fn index(self, place: Place) -> usize {
        let [x, y] = place.map(|it| (it + 1) as usize);
        y * self.row() + x
    }

    /// Corners, and sides, of the face.
    pub(crate) fn sides(self) -> usize {
        self.pieces.sides() as usize
    }

    /// The place of a corner of the face.
    pub(super) fn corner(self, corner: usize) -> Place {
        let n = self.cells;
        match self.pieces {
            Pieces::Quads => [[0, 0], [n, 0], [n, n], [0, n]][corner % 4],
            Pieces::Triangles => [[0, 0], [n, 0], [0, n]][corner % 3],
        }
    }

    /// The end of the edge that lies `by` edges counter-clockwise from the outgoing edge of
    /// a corner of the face.
    pub(super) fn beside(self, corner: usize, by: usize) -> Place {
        add(self.corner(corner), self.direction(corner, by))
    }

    /// The vertex across the face that lies opposite the own one at a corner, among quads.
    pub(super) fn across(self, corner: usize) -> Place {
        add(self.beside(corner, 2), self.direction(corner, 3))
    }

    /// The middle of an edge on a side, by its number counted from the side's start, of
    /// those that are `of` grid steps long.
    pub(crate) fn on_side(self, side: usize, number: usize, of: usize) -> Place {
        let (start, [x, y]) = (self.corner(side), self.direction(side, 0));
        let by = (of * number + of / 2) as i32;
        add(start, [x * by, y * by])
    }

    /// The side that a place other than a corner lies on.
    pub(crate) fn side_of(self, [x, y]: Place) -> Option<usize> {
        let n = self.cells;
        let on = match self.pieces {
            Pieces::Quads => [y == 0, x == n, y == n, x == 0],
            Pieces::Triangles => [y == 0, x + y == n, x == 0, false],
        };
        on.iter().position(|&on| on)
    }

    fn direction(self, corner: usize, by: usize) -> Place {
        match self.pieces {
            Pieces::Quads => QUADS[(corner + by) % 4],
            Pieces::Triangles => TRIANGLES[(2 * corner + by) % 6],
        }
    }
}

/// The array indices at the corners of a patch, as the loops want them.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PatchFrame {
    /// The corner itself.
    pub(crate) own: [u16; 4],
    /// The neighbours of the corner outside the patch: the next one clockwise of its
    /// outgoing edge, and two further counter-clockwise.
    pub(crate) before: [u16; 4],
    pub(crate) second: [u16; 4],
    /// What lies beyond: across the opposite face among quads, two more neighbours among
    /// triangles.
    pub(crate) beyond: [[u16; 2]; 4],
}

impl PatchFrame {
    pub(crate) fn new(grid: PatchGrid) -> Self {
        let index = |place| grid.index(place) as u16;
        let each = std::array::from_fn::<usize, 4, _>(|i| i % grid.sides());
        let beyond = |i| match grid.pieces {
            Pieces::Quads => [grid.across(i); 2],
            Pieces::Triangles => [grid.beside(i, 3), grid.beside(i, 4)],
        };
        Self {
            own: each.map(|i| index(grid.corner(i))),
            before: each.map(|i| index(grid.beside(i, grid.pieces.valence() - 1))),
            second: each.map(|i| index(grid.beside(i, 2))),
            beyond: each.map(|i| beyond(i).map(index)),
        }
    }
}

fn add(a: Place, b: Place) -> Place {
    [a[0] + b[0], a[1] + b[1]]
}
