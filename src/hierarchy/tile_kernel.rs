//! The inner loops of tiles: one quad, split a few times in its own small arrays.
//!
//! The array of a level holds the vertices of the tile and of a ring of faces around it.
//! Children of a quad depend on its corners alone, in an order of additions that does not
//! depend on where the quad starts, so that both ways of refining give the same bits.
//! Around a face that is no quad the arrays are those of its sectors, seen as if it
//! were a quad; what is wrong then is either written again or belongs to other sectors.

use super::kernel::{QuadWeights, Value, narrow, quad_children, vertex_grid, widen};
use super::tile_centres::TileCentres;
use super::tile_step::TileLoop;
use crate::base::{Result, Scalar, memory};
use crate::mesh::{Mesh, QuadWalker};
use crate::refine::{CELL, Place, TILE_ORIGIN, TILE_ROW, TileKind, Tiles, array_index};

/// Places in an array, rounded up to a power of two: an index that is cut to that many bits
/// needs no check.
const PLACES: usize = (TILE_ROW * TILE_ROW).next_power_of_two();

pub(super) type TileArray<L> = Box<[L; PLACES]>;

/// Refines tiles, one after the other.
pub(super) struct TileKernel<'v, T: Scalar, const W: usize> {
    tiles: &'v Tiles<'v>,
    quads: QuadWalker<'v>,
    values: &'v [Value<T, W>],
    centres: &'v TileCentres<T>,
    weights: QuadWeights<T>,
    /// The arrays of this level and of the next.
    from: TileArray<T::Lanes>,
    to: TileArray<T::Lanes>,
}

impl<'v, T: Scalar, const W: usize> TileKernel<'v, T, W> {
    pub(super) fn new(
        tiles: &'v Tiles<'v>,
        weights: QuadWeights<T>,
        values: &'v [Value<T, W>],
        centres: &'v TileCentres<T>,
    ) -> Result<Self> {
        let (from, to) = (tile_array::<T>()?, tile_array::<T>()?);
        let quads = QuadWalker::new(tiles.parent());
        Ok(Self { tiles, quads, values, centres, weights, from, to })
    }

    /// The vertices of a quad and, where more than the last split comes after, of the ring of
    /// faces around it; false if one of them is no quad.
    #[inline(always)]
    fn gather(&mut self, corner: u32, kind: TileKind) -> bool {
        let at = |v: u32| widen::<T, W>(&self.values[v as usize]);
        if self.tiles.depth() == 2 && kind != TileKind::Face {
            let [a, b, c, d] = self.quads.vertices(corner).map(at);
            let (low, high) = (array_index([1, 1]), array_index([1, 2]));
            (self.from[low], self.from[low + 1]) = (a, b);
            (self.from[high], self.from[high + 1]) = (d, c);
            if kind == TileKind::Vertex {
                return true;
            }
            // The tile of an edge is longer than its quad.
            let [_, right, _, left] = self.quads.twins(corner);
            if !self.quads.holds(right) || !self.quads.holds(left) {
                return false;
            }
            let beside = |corner: u32, by: u32| {
                at(self.quads.mesh.vert[self.quads.turn(corner, by) as usize])
            };
            (self.from[low - 1], self.from[low + 2]) = (beside(left, 3), beside(right, 2));
            (self.from[high - 1], self.from[high + 2]) = (beside(left, 2), beside(right, 3));
            return true;
        }
        let Some(grid) = vertex_grid(self.quads, corner, false) else { return false };
        for (y, row) in grid.rows().into_iter().enumerate() {
            for (x, vertex) in row.into_iter().enumerate() {
                self.from[array_index([x as i32, y as i32])] = at(vertex);
            }
        }
        true
    }

    /// The children of a face of the level before the last.
    #[inline(always)]
    fn children(&self, corners: [u16; 4]) -> [Value<T, W>; 4] {
        let corners = corners.map(|index| self.from[index as usize % PLACES]);
        quad_children::<T>(self.weights, corners).map(narrow::<T, W>)
    }

    /// The first level around a face, from the faces around it one by one; `sides` are
    /// those that matter.
    #[cold]
    #[inline(never)]
    fn around(&mut self, corner: u32, kind: TileKind, sides: impl Iterator<Item = usize>) {
        let mesh = self.tiles.parent();
        self.face(corner, kind, [1, 1], 0);
        let own = seen_as_quad(mesh, corner);
        for i in sides {
            let beside = [[1, 0], [2, 1], [1, 2], [0, 1]];
            let beyond = [[0, 0], [2, 0], [2, 2], [0, 2]];
            let twin = mesh.twin[own[i] as usize];
            self.face(twin, kind, beside[i], (i + 2) % 4);
            self.face(self.tiles.beyond(own[i]), kind, beyond[i], (i + 2) % 4);
        }
    }

    /// The children of the face of a corner, which stands at a vertex of a cell.
    fn face(&mut self, corner: u32, kind: TileKind, cell: Place, vertex: usize) {
        let mesh = self.tiles.parent();
        let shift = kind.shift(0);
        let place = |i: usize| {
            let at = CELL[(vertex + i) % 4];
            array_index(std::array::from_fn(|k| 2 * cell[k] + at[k] - shift[k]))
        };
        if self.quads.holds(corner) {
            let own: [u32; 4] = std::array::from_fn(|i| self.quads.turn(corner, i as u32));
            let values = own.map(|c| widen::<T, W>(&self.values[mesh.vert[c as usize] as usize]));
            let children = quad_children::<T>(self.weights, values);
            for (i, child) in children.into_iter().enumerate() {
                self.from[place(i)] = child;
            }
            return;
        }
        for (i, corner) in seen_as_quad(mesh, corner).into_iter().enumerate() {
            self.from[place(i)] = self.centres.at(1, corner);
        }
    }

    /// One split of the whole array.
    #[inline(always)]
    fn split(&mut self, kind: TileKind, level: u32) {
        // With the size known, no index needs a check.
        use TileKind::{Edge, Face, Vertex};
        if level + 2 < self.tiles.depth() {
            match (kind, level) {
                (Face, 0) | (Vertex, 1..) => self.split_cells::<1, 1, 0, 0, true>(),
                (Face, 1..) => self.split_cells::<3, 3, 1, 1, true>(),
                (Edge, 0) => self.split_cells::<1, 1, 0, 1, true>(),
                (Edge, 1..) => self.split_cells::<3, 1, 1, 0, true>(),
                (Vertex, 0) => self.split_cells::<1, 1, 1, 1, true>(),
            }
        } else {
            match (kind, level) {
                (Face, 0) | (Vertex, 1) => self.split_cells::<1, 1, 0, 0, false>(),
                (Face, 1) | (Vertex, 2..) => self.split_cells::<3, 3, 1, 1, false>(),
                (Face, 2..) => self.split_cells::<5, 5, 0, 0, false>(),
                (Edge, 0) => self.split_cells::<1, 1, 0, 1, false>(),
                (Edge, 1) => self.split_cells::<3, 1, 1, 0, false>(),
                (Edge, 2..) => self.split_cells::<5, 3, 0, 1, false>(),
                (Vertex, 0) => self.split_cells::<1, 1, 1, 1, false>(),
            }
        }
        std::mem::swap(&mut self.from, &mut self.to);
    }

    /// One split of X by Y faces and the ring around them, with the shifts of
    /// [`TileKind::shift`]; the last one only where the ring has children in the tile.
    #[inline(never)]
    fn split_cells<
        const X: usize,
        const Y: usize,
        const RIGHT: usize,
        const UP: usize,
        const RING: bool,
    >(
        &mut self,
    ) {
        let (across, along) = if RING { (0, 0) } else { (RIGHT, UP) };
        for y in along..Y + 2 - along {
            let at = y + TILE_ORIGIN;
            let (low, high) = (row(&self.from, at), row(&self.from, at + 1));
            let at = 2 * y + TILE_ORIGIN - UP;
            let out = &mut self.to[at * TILE_ROW..(at + 2) * TILE_ROW];
            let (below, above) = out.split_at_mut(TILE_ROW);
            for x in across..X + 2 - across {
                let at = x + TILE_ORIGIN;
                let corners = [low[at], low[at + 1], high[at + 1], high[at]];
                let [a, b, c, d] = quad_children::<T>(self.weights, corners);
                let at = 2 * x + TILE_ORIGIN - RIGHT;
                (below[at], below[at + 1], above[at + 1], above[at]) = (a, b, c, d);
            }
        }
    }
}

impl<T: Scalar, const W: usize> TileLoop<T, W> for TileKernel<'_, T, W> {
    #[inline(always)]
    fn tile<'o>(
        &mut self,
        tile: usize,
        out: &'o mut [[Value<T, W>; 4]],
    ) -> &'o mut [[Value<T, W>; 4]] {
        let (kind, corner) = (self.tiles.kind(tile), self.tiles.corner(tile));
        let first = if self.gather(corner, kind) {
            0
        } else {
            self.around(corner, kind, 0..4);
            1
        };
        for level in first..self.tiles.depth() - 1 {
            self.split(kind, level);
        }
        let parents = &self.tiles.tables().tile(kind).parents;
        let (mine, later) = out.split_at_mut(parents.len());
        for (out, &corners) in mine.iter_mut().zip(parents) {
            *out = self.children(corners);
        }
        later
    }

    fn sector(&mut self, sector: u32, runs: &mut [&mut [[Value<T, W>; 4]]]) {
        let table = &self.tiles.tables().sector;
        let mesh = self.tiles.parent();
        let centre = seen_as_quad(mesh, sector);
        self.around(sector, TileKind::Face, [0, 1, 3].into_iter());
        for level in 1..self.tiles.depth() {
            for (&place, corner) in table.centres[level as usize].iter().zip(centre) {
                self.from[array_index(place)] = self.centres.at(level, corner);
            }
            if level + 1 < self.tiles.depth() {
                self.split(TileKind::Face, level);
            }
        }
        for (run, parents) in runs.iter_mut().zip(&table.parents) {
            let (mine, later) = std::mem::take(run).split_at_mut(parents.len());
            for (out, places) in mine.iter_mut().zip(parents) {
                *out = self.children(places.map(|place| array_index(place) as u16));
            }
            *run = later;
        }
    }
}

/// A corner of a face, the two after it and the one before: all of a quad's, and of other
/// faces those that the quads around the corner's edge ask for.
pub(super) fn seen_as_quad(mesh: &Mesh, corner: u32) -> [u32; 4] {
    let next = mesh.next(corner);
    [corner, next, mesh.next(next), mesh.prev(corner)]
}

#[inline(always)]
fn row<L>(array: &[L; PLACES], y: usize) -> &[L] {
    &array[y * TILE_ROW..(y + 1) * TILE_ROW]
}

pub(super) fn tile_array<T: Scalar>() -> Result<TileArray<T::Lanes>> {
    let list = memory::filled(T::lanes([T::default(); 4]), PLACES)?.into_boxed_slice();
    Ok(list.try_into().unwrap_or_else(|_| unreachable!("the list is that long")))
}
