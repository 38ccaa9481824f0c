//! The inner loops of tiles under a scheme with one pass.
//!
//! A child asks for the vertices around its own, not only for those of its face. So the first
//! level, whose vertices are the parent's corners, is computed for all tiles together, and the
//! array of a level holds the tile, a ring of faces around it and, where the next level needs
//! it, a second one. All regular vertices in there go by the same rule (`regular_rule`); the
//! children of vertices of faces that are no quads are taken from `tile_rings`. Such vertices are
//! within reach of the quads of edges and vertices on the first level only, and of sectors, seen
//! as if their face were a quad, on all levels.

use super::kernel::{Value, narrow, widen};
use super::regular_rule::RegularRule;
use super::tile_kernel::{TileArray, seen_as_quad, tile_array};
use super::tile_rings::TileRings;
use super::tile_step::TileLoop;
use crate::base::{Result, Scalar};
use crate::mesh::QuadWalker;
use crate::refine::{CELL, Place, Stand, TILE_ROW, TileKind, Tiles, array_index};

/// The cells around the one in the middle: across its sides, and at its vertices.
const BESIDE: [Place; 4] = [[1, 0], [2, 1], [1, 2], [0, 1]];
const BEYOND: [Place; 4] = [[0, 0], [2, 0], [2, 2], [0, 2]];

/// Refines tiles, one after the other.
pub(super) struct SmoothTileKernel<'v, T: Scalar, const W: usize> {
    tiles: &'v Tiles<'v>,
    quads: QuadWalker<'v>,
    /// By corner of the parent.
    first: &'v [Value<T, W>],
    rings: &'v TileRings<T>,
    rule: RegularRule<T>,
    /// The arrays of this level and of the next.
    from: TileArray<T::Lanes>,
    to: TileArray<T::Lanes>,
}

impl<'v, T: Scalar, const W: usize> SmoothTileKernel<'v, T, W> {
    pub(super) fn new(
        tiles: &'v Tiles<'v>,
        rule: RegularRule<T>,
        first: &'v [Value<T, W>],
        rings: &'v TileRings<T>,
    ) -> Result<Self> {
        let (from, to) = (tile_array::<T>()?, tile_array::<T>()?);
        let quads = QuadWalker::new(tiles.parent());
        Ok(Self { tiles, quads, first, rings, rule, from, to })
    }

    /// The first level of a face and of what is around it.
    #[inline(always)]
    fn gather(&mut self, corner: u32, kind: TileKind) {
        // With the places known, no index needs a check.
        match kind {
            TileKind::Face => self.gather_faces::<0, 0>(corner),
            TileKind::Edge => self.gather_faces::<0, 1>(corner),
            TileKind::Vertex => self.gather_faces::<1, 1>(corner),
        }
        let shift = kind.shift(0);
        let rings = kind.rings(1, self.tiles.depth());
        // Without shift those faces end with the first ring.
        let further = [rings[0] == 2 && shift[0] == 0, rings[1] == 2 && shift[1] == 0];
        if further != [false; 2] {
            self.gather_further(corner, shift, further);
        }
    }

    /// The corners of a face and of the faces around it, with the shift of [`TileKind::shift`].
    #[inline(always)]
    fn gather_faces<const RIGHT: i32, const UP: i32>(&mut self, corner: u32) {
        let own = self.seen_as_quad(corner);
        let mesh = self.tiles.parent();
        self.face::<RIGHT, UP>(own, [1, 1], 0);
        self.face::<RIGHT, UP>(self.seen_as_quad(mesh.twin[own[0] as usize]), BESIDE[0], 2);
        self.face::<RIGHT, UP>(self.seen_as_quad(mesh.twin[own[1] as usize]), BESIDE[1], 3);
        self.face::<RIGHT, UP>(self.seen_as_quad(mesh.twin[own[2] as usize]), BESIDE[2], 0);
        self.face::<RIGHT, UP>(self.seen_as_quad(mesh.twin[own[3] as usize]), BESIDE[3], 1);
        self.face::<RIGHT, UP>(self.seen_as_quad(self.tiles.beyond(own[0])), BEYOND[0], 2);
        self.face::<RIGHT, UP>(self.seen_as_quad(self.tiles.beyond(own[1])), BEYOND[1], 3);
        self.face::<RIGHT, UP>(self.seen_as_quad(self.tiles.beyond(own[2])), BEYOND[2], 0);
        self.face::<RIGHT, UP>(self.seen_as_quad(self.tiles.beyond(own[3])), BEYOND[3], 1);
    }

    /// The second ring of vertices along x, y or both: the corners of the faces further out at the
    /// vertices of those around the middle.
    #[inline(never)]
    fn gather_further(&mut self, corner: u32, shift: Place, further: [bool; 2]) {
        let mesh = self.tiles.parent();
        let own = self.seen_as_quad(corner);
        let sides = own.map(|c| self.seen_as_quad(mesh.twin[c as usize]));
        let corners = own.map(|c| self.seen_as_quad(self.tiles.beyond(c)));
        let vertex = |cell: Place, i: usize| [cell[0] + CELL[i][0], cell[1] + CELL[i][1]];
        for side in (0..4).filter(|side| further[(side + 1) % 2]) {
            // The faces along the side, by their corner where the side starts.
            let after = (side + 1) % 4;
            let along = [
                (corners[side][2], BEYOND[side]),
                (sides[side][2], BESIDE[side]),
                (corners[after][1], BEYOND[after]),
            ];
            for (corner, cell) in along {
                let twin = mesh.twin[corner as usize];
                self.put_first(twin, vertex(cell, after), shift, side + 2);
                self.put_first(mesh.next(twin), vertex(cell, side), shift, side + 3);
            }
        }
        if further == [true; 2] {
            for side in 0..4 {
                let corner = self.tiles.beyond(corners[side][2]);
                self.put_first(corner, vertex(BEYOND[side], side), shift, side + 2);
            }
        }
    }

    #[inline(always)]
    fn seen_as_quad(&self, corner: u32) -> [u32; 4] {
        let turn = |by: u32| self.quads.turn(corner, by);
        if self.quads.holds(corner) {
            return [corner, turn(1), turn(2), turn(3)];
        }
        seen_as_quad(self.tiles.parent(), corner)
    }

    /// The children of the corners of a face, the first of which stands at a vertex of a cell.
    #[inline(always)]
    fn face<const RIGHT: i32, const UP: i32>(
        &mut self,
        corners: [u32; 4],
        cell: Place,
        vertex: usize,
    ) {
        let flat = self.tiles.depth() == 2;
        let mut put = |corner: u32, at: Place| {
            let [x, y] = [2 * cell[0] - RIGHT + at[0], 2 * cell[1] - UP + at[1]];
            // No split asks for a second ring.
            let further = !(0..=5 - 2 * RIGHT).contains(&x) || !(0..=5 - 2 * UP).contains(&y);
            if !(further && flat) {
                self.from[array_index([x, y])] = widen::<T, W>(&self.first[corner as usize]);
            }
        };
        put(corners[0], CELL[vertex % 4]);
        put(corners[1], CELL[(vertex + 1) % 4]);
        put(corners[2], CELL[(vertex + 2) % 4]);
        put(corners[3], CELL[(vertex + 3) % 4]);
    }

    /// The child of a corner, which lies in a quadrant around its vertex.
    fn put_first(&mut self, corner: u32, vertex: Place, shift: Place, quadrant: usize) {
        let value = widen::<T, W>(&self.first[corner as usize]);
        self.from[array_index(child(vertex, shift, quadrant))] = value;
    }

    /// The children of a vertex of a face that is no quad and lies in a quadrant around it.
    fn put_ring(&mut self, level: u32, corner: u32, vertex: Place, shift: Place, quadrant: usize) {
        for (i, value) in self.rings.at(level, corner).into_iter().enumerate() {
            self.from[array_index(child(vertex, shift, quadrant + i))] = value;
        }
    }

    /// One split: the children of all vertices that have their eight neighbours in the array.
    #[inline(always)]
    fn split(&mut self, kind: TileKind, level: u32) {
        let (cells, shift) = (kind.cells(level), kind.shift(level));
        let rings = kind.rings(level, self.tiles.depth());
        // A tile has the vertices from 1 on, one more than faces.
        let first = rings.map(|rings| 2 - rings);
        let [across, along] = [0, 1].map(|i| (cells[i] as i32 + 2 * rings[i] - 1) as usize);
        for y in first[1]..first[1] + along as i32 {
            let rows = [-1, 0, 1].map(|by| {
                let start = array_index([first[0] - 1, y + by]);
                &self.from[start..start + across + 2]
            });
            let low = array_index([2 * first[0] - 1 - shift[0], 2 * y - 1 - shift[1]]);
            let (below, above) = self.to[low..low + TILE_ROW + 2 * across].split_at_mut(TILE_ROW);
            let below = below[..2 * across].as_chunks_mut::<2>().0;
            let above = above.as_chunks_mut::<2>().0;
            let [a, b, c] = rows.map(|row| row.windows(3));
            for ((((a, b), c), below), above) in a.zip(b).zip(c).zip(below).zip(above) {
                let rows = [a, b, c].map(|row| [row[0], row[1], row[2]]);
                let [ne, nw, sw, se] = self.rule.around_vertex(rows);
                (*below, *above) = ([sw, se], [nw, ne]);
            }
        }
        std::mem::swap(&mut self.from, &mut self.to);
    }

    /// The rings at the corners of the quad of an edge or a vertex, on the second level: on later
    /// ones they are out of reach.
    #[inline(always)]
    fn put_rings(&mut self, corner: u32, kind: TileKind) {
        let mesh = self.tiles.parent();
        for (i, at) in CELL.into_iter().enumerate() {
            // So many faces on counter-clockwise stands the child of a face, quad or not.
            let on = match kind {
                TileKind::Face => return,
                TileKind::Edge => 3 - 2 * (i % 2),
                TileKind::Vertex => 2,
            };
            let face = (0..on).fold(corner + i as u32, |c, _| mesh.ccw(c));
            if !self.quads.holds(face) {
                let vertex = child([at[0] + 1, at[1] + 1], kind.shift(0), i + on);
                self.put_ring(2, face, vertex, kind.shift(1), i + on);
            }
        }
    }

    /// The children that vertices of the sector's face have in the quads made last: that of the
    /// first vertex, and that of the edge, which starts at the second one.
    fn put_last_rings(&self, [first, second, ..]: [u32; 4], quads: &mut [[Value<T, W>; 4]]) {
        let [vertex, edge] = quads else { return };
        let last = |corner| self.rings.at(self.tiles.depth(), corner).map(narrow::<T, W>);
        [_, _, vertex[0], edge[1]] = last(first);
        [_, edge[0], ..] = last(second);
    }

    /// The children of a face of the level before the last.
    #[inline(always)]
    fn children(&self, stand: Stand, out: &mut [Value<T, W>; 4]) {
        const WINDOW: usize = 3 * TILE_ROW + 4;
        let from = &self.from[stand.index as usize - (TILE_ROW + 1)..][..WINDOW];
        let at = |x: usize, y: usize| from[y * TILE_ROW + x];
        let row = |y: usize| [at(0, y), at(1, y), at(2, y), at(3, y)];
        let children = self.rule.around_quad([row(0), row(1), row(2), row(3)]);
        let first = 4 - stand.turn as usize;
        for (i, &child) in children.iter().enumerate() {
            out[(first + i) % 4] = narrow::<T, W>(child);
        }
    }
}

/// Where a split puts the child of a vertex in a quadrant, counter-clockwise from the upper right.
#[inline(always)]
fn child(vertex: Place, shift: Place, quadrant: usize) -> Place {
    let [x, y] = CELL[(quadrant + 2) % 4];
    [2 * vertex[0] - shift[0] - 1 + x, 2 * vertex[1] - shift[1] - 1 + y]
}

impl<T: Scalar, const W: usize> TileLoop<T, W> for SmoothTileKernel<'_, T, W> {
    #[inline(always)]
    fn tile<'o>(
        &mut self,
        tile: usize,
        out: &'o mut [[Value<T, W>; 4]],
    ) -> &'o mut [[Value<T, W>; 4]] {
        let (kind, corner) = (self.tiles.kind(tile), self.tiles.corner(tile));
        self.gather(corner, kind);
        for level in 1..self.tiles.depth() - 1 {
            self.split(kind, level);
            if level == 1 {
                self.put_rings(corner, kind);
            }
        }
        let stands = &self.tiles.tables().tile(kind).stands;
        let (mine, later) = out.split_at_mut(stands.len());
        for (out, &stand) in mine.iter_mut().zip(stands) {
            self.children(stand, out);
        }
        later
    }

    fn sector(&mut self, sector: u32, runs: &mut [&mut [[Value<T, W>; 4]]]) {
        let table = &self.tiles.tables().sector;
        let centre = seen_as_quad(self.tiles.parent(), sector);
        self.gather(sector, TileKind::Face);
        for level in 0..self.tiles.depth() - 1 {
            if level > 0 {
                self.split(TileKind::Face, level);
            }
            let shift = TileKind::Face.shift(level);
            for (i, &vertex) in table.centres[level as usize].iter().enumerate() {
                self.put_ring(level + 1, centre[i], vertex, shift, i);
            }
        }
        for (run, parents) in (0..).zip(&table.parents) {
            let (mine, later) = std::mem::take(&mut runs[run]).split_at_mut(parents.len());
            for (out, &places) in mine.iter_mut().zip(parents) {
                self.children(Stand::of(places), out);
            }
            if run + 1 == table.parents.len() {
                self.put_last_rings(centre, mine);
            }
            runs[run] = later;
        }
    }
}
