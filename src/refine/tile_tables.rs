//! The numbering of a few corner splits of one quad, worked out once for all quads.
//!
//! In a mesh that a corner split has made, quads are of three kinds: the child of a face leads
//! all that is around it, the quad of an edge its two short sides, the quad of a vertex
//! nothing. What such a quad becomes, its *tile*, follows each other in the numbering and is
//! a rectangle of faces at every level, long sides f = 1, 3, 5, 11, 21, by turns 2f + 1 and
//! 2f − 1, short sides one f behind:
//!
//! ```text
//!   V ─ E ─ V        the quads around the child F of a face: the tile of F is as
//!   │   │   │        long as those of E, that of V as long as those of E are
//!   E ─ F ─ E        wide, so that each side of a tile is one side of another
//!   │   │   │
//!   V ─ E ─ V
//! ```
//!
//! A vertex belongs to the face, one level before, whose corner it is. At odd depths the faces
//! of F reach one vertex into E and those of E into V; at even depths those of V reach
//! into E and those of E into F, and never both ways.
//!
//! A face that is no quad keeps its size and is surrounded by quads. It is a tile of the
//! first kind with as many sides as it has; the part at one of its sides is a *sector*. The
//! quads that a level adds around it are numbered together, before those of older levels.

use super::patch_grid::Place;
use crate::base::{Result, memory};
use crate::mesh::near::{LEADS_ALL, LEADS_NONE, LEADS_OUTER};

/// The deepest tiles.
pub(crate) const DEEPEST_TILE: u32 = 4;

/// Places in a row of the array behind a tile: the longest side of the level before the
/// last, 11, the vertices of a ring of faces around it, and two more on either side. The faces
/// of the tile have the vertices from 1 on, those of the ring the vertices from 0 on.
pub(crate) const TILE_ROW: usize = 18;

/// Where place 0 is in a row.
pub(crate) const TILE_ORIGIN: usize = 2;

/// The vertices of a cell, counter-clockwise from its lowest.
pub(crate) const CELL: [Place; 4] = [[0, 0], [1, 0], [1, 1], [0, 1]];

/// From the sides of a tile outwards.
const OUTWARDS: [Place; 4] = [[0, -1], [1, 0], [0, 1], [-1, 0]];

fn add(a: Place, b: Place) -> Place {
    [a[0] + b[0], a[1] + b[1]]
}

/// The lowest vertex of a face.
fn low(face: [Place; 4]) -> Place {
    let low = |i: usize| face.iter().map(|place| place[i]).min().unwrap_or(0);
    [low(0), low(1)]
}

/// What a quad of a split mesh stands for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum TileKind {
    Face,
    Edge,
    Vertex,
}

/// All of them.
pub(crate) const TILE_KINDS: [TileKind; 3] = [TileKind::Face, TileKind::Edge, TileKind::Vertex];

impl TileKind {
    /// The kind of a quad with near bits of a split mesh.
    #[inline(always)]
    pub(crate) fn of(near: u8) -> Self {
        match near {
            LEADS_ALL => Self::Face,
            LEADS_OUTER => Self::Edge,
            _ => {
                debug_assert_eq!(near, LEADS_NONE);
                Self::Vertex
            }
        }
    }

    /// Faces along x and y after some splits.
    pub(crate) fn cells(self, level: u32) -> [usize; 2] {
        let (long, short) = (length(level), if level == 0 { 1 } else { length(level - 1) });
        match self {
            Self::Face => [long, long],
            Self::Edge => [long, short],
            Self::Vertex => [short, short],
        }
    }

    /// Faces in all.
    pub(crate) fn faces(self, level: u32) -> u32 {
        let [x, y] = self.cells(level);
        (x * y) as u32
    }

    /// Where the split of a level puts the children of face a, along x and y: at 2a − shift
    /// and the place after it.
    pub(crate) fn shift(self, level: u32) -> [i32; 2] {
        let long = (level % 2) as i32;
        match self {
            Self::Face => [long, long],
            Self::Edge => [long, 1 - long],
            Self::Vertex => [1 - long, 1 - long],
        }
    }

    /// How many rings of faces around a tile, along x and y, a level must have where a vertex asks
    /// for the vertices around its own, so that the faces one level before `depth` have one.
    pub(crate) fn rings(self, level: u32, depth: u32) -> [i32; 2] {
        let splits = (level..depth - 1).map(|level| self.shift(level));
        // A split without shift needs a further ring for one, and none for two.
        std::array::from_fn(|i| if splits.clone().any(|shift| shift[i] == 0) { 2 } else { 1 })
    }
}

/// Faces on the long side of a tile: 1, 3, 5, 11, 21.
fn length(level: u32) -> usize {
    (0..level).fold(1, |f, step| if step % 2 == 0 { 2 * f + 1 } else { 2 * f - 1 })
}

/// A vertex of another tile: which corner of which face has it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Foreign {
    /// Corner, counted from the first face of the tile.
    pub(crate) slot: u16,
    /// The place in the row of the tile across the side, in that one's direction; at a
    /// corner nothing.
    pub(crate) at: u16,
}

/// How a face stands in the array: the index of its lowest vertex, and where its first vertex
/// is, counter-clockwise from the lowest.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Stand {
    pub(crate) index: u16,
    pub(crate) turn: u16,
}

impl Stand {
    pub(crate) fn of(at: [Place; 4]) -> Self {
        let low = low(at);
        let first = [at[0][0] - low[0], at[0][1] - low[1]];
        let turn = CELL.iter().position(|&place| place == first).unwrap_or(0);
        Self { index: array_index(low) as u16, turn: turn as u16 }
    }
}

/// The vertices of a tile along a side. There are 22 at most; an index that is cut to five bits
/// needs no check.
pub(crate) type TileSide = [u32; 32];

/// One kind of tile.
#[derive(Debug)]
pub(crate) struct TileTable {
    /// The array indices of the vertices of each face, one level before the last.
    pub(crate) parents: Vec<[u16; 4]>,
    /// How the same faces stand.
    pub(crate) stands: Vec<Stand>,
    /// The vertices of each last face, counted from the tile's first; 0 where foreign.
    pub(crate) faces: Vec<[u32; 4]>,
    /// The vertices across each side, and at each corner.
    pub(crate) across: [Vec<Foreign>; 4],
    pub(crate) beyond: [Vec<Foreign>; 4],
    /// The tile's own vertices along each side, in its direction, and at each corner.
    pub(crate) sides: [TileSide; 4],
    pub(crate) corners: [u32; 4],
}

/// A vertex of a face that is no quad: by the sector and the split that made it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SectorVertex {
    /// It belongs to the sector of the next corner.
    pub(crate) next: bool,
    pub(crate) run: u32,
    /// The number among those that the split made there.
    pub(crate) at: u32,
}

/// The part of a face that is no quad at one of its sides, seen as that of a quad.
#[derive(Debug)]
pub(crate) struct SectorTable {
    /// For each split but the last: the faces that it made, one level before the last, by
    /// the places of their vertices, and of the vertices at their corners.
    pub(crate) parents: Vec<Vec<[Place; 4]>>,
    pub(crate) vertices: Vec<Vec<[Place; 4]>>,
    /// For each split: the last faces that it made.
    pub(crate) faces: Vec<Vec<[Place; 4]>>,
    /// For each level the vertices of the face that is no quad.
    pub(crate) centres: Vec<[Place; 4]>,
    /// The vertices along the side, in its direction.
    pub(crate) side: Vec<SectorVertex>,
    /// The vertex at the corner.
    pub(crate) corner: SectorVertex,
    /// The vertices across each side: where along it, seen from there, and the place.
    pub(crate) across: [Vec<(u16, Place)>; 4],
    /// The vertices beyond the sector's corner and the next, if faces reach there.
    pub(crate) beyond: Option<[Place; 2]>,
}

/// The tables of all kinds.
#[derive(Debug)]
pub(crate) struct TileTables {
    pub(crate) depth: u32,
    pub(crate) tiles: [TileTable; 3],
    pub(crate) sector: SectorTable,
}

impl TileTables {
    /// The tables for `depth` splits, from 2 to [`DEEPEST_TILE`].
    pub(crate) fn new(depth: u32) -> Result<Self> {
        debug_assert!((2..=DEEPEST_TILE).contains(&depth));
        let [face, edge, vertex] = TILE_KINDS.map(|kind| tile(kind, depth));
        let tiles = [face?, edge?, vertex?];
        Ok(Self { depth, tiles, sector: sector(depth)? })
    }

    #[inline(always)]
    pub(crate) fn tile(&self, kind: TileKind) -> &TileTable {
        &self.tiles[kind as usize]
    }
}

/// The index of a place in the array behind a tile.
#[inline(always)]
pub(crate) fn array_index([x, y]: Place) -> usize {
    const ORIGIN: i32 = TILE_ORIGIN as i32;
    (y + ORIGIN) as usize * TILE_ROW + (x + ORIGIN) as usize
}

/// A quarter turn clockwise about the middle of a tile of the first kind: what the sector of
/// the next corner sees at a place.
pub(crate) fn seen_from_next([x, y]: Place, level: u32) -> Place {
    let [cells, _] = TileKind::Face.cells(level);
    [y, cells as i32 + 2 - x]
}

/// What the sector of the previous corner sees at a place: a quarter turn the other way.
pub(crate) fn seen_from_previous([x, y]: Place, level: u32) -> Place {
    let [cells, _] = TileKind::Face.cells(level);
    [cells as i32 + 2 - y, x]
}

/// A face on its way through the levels.
#[derive(Debug, Clone, Copy)]
struct Cell {
    at: [Place; 4],
    kind: TileKind,
}

impl Cell {
    /// The quad of level 0.
    fn first(kind: TileKind) -> Self {
        Self { at: CELL.map(|[x, y]| [x + 1, y + 1]), kind }
    }

    /// The vertex that a split makes at a corner of the face that lies `by` from this one.
    fn child(&self, corner: usize, by: Place, shift: Place) -> Place {
        let (low, at) = (low(self.at), self.at[corner % 4]);
        std::array::from_fn(|i| low[i] + by[i] + at[i] - shift[i])
    }

    fn own_child(&self, shift: Place) -> Self {
        let at = std::array::from_fn(|i| self.child(i, [0, 0], shift));
        Self { at, kind: TileKind::Face }
    }

    /// From the side at a corner outwards.
    fn outwards(&self, corner: usize) -> Place {
        let ([x, y], [u, v]) = (self.at[corner % 4], self.at[(corner + 1) % 4]);
        [v - y, x - u]
    }

    /// The quad of the vertex at a corner: around it from the own face on.
    fn vertex_quad(&self, corner: usize, shift: Place) -> Self {
        let (out, before) = (self.outwards(corner), self.outwards(corner + 3));
        let at = [[0, 0], before, add(out, before), out].map(|by| self.child(corner, by, shift));
        Self { at, kind: TileKind::Vertex }
    }

    /// The quad of the edge that a corner leads.
    fn edge_quad(&self, corner: usize, shift: Place) -> Self {
        let (own, out) = ([0, 0], self.outwards(corner));
        let ends = [(corner + 1, own), (corner, own), (corner, out), (corner + 1, out)];
        Self { at: ends.map(|(c, by)| self.child(c, by, shift)), kind: TileKind::Edge }
    }

    /// Adds the children that stand near the face.
    fn split(&self, shift: Place, out: &mut Vec<Self>) -> Result<()> {
        memory::extend(out, [self.own_child(shift)])?;
        let leads = match self.kind {
            TileKind::Face => {
                memory::extend(out, (0..4).map(|i| self.vertex_quad(i, shift)))?;
                &[0, 1, 2, 3][..]
            }
            TileKind::Edge => &[1, 3],
            TileKind::Vertex => &[],
        };
        memory::extend(out, leads.iter().map(|&i| self.edge_quad(i, shift)))
    }
}

fn split_all(cells: &[Cell], shift: Place) -> Result<Vec<Cell>> {
    let mut children = Vec::new();
    cells.iter().try_for_each(|cell| cell.split(shift, &mut children))?;
    Ok(children)
}

/// The numbers of vertices by place, in a square around a tile.
#[derive(Debug)]
pub(crate) struct PlaceNumbers(Vec<u32>);

const UNKNOWN: u32 = u32::MAX;
/// Places in a row: the longest side of all and a ring of vertices.
const ROW: i32 = 24;

impl PlaceNumbers {
    pub(crate) fn new() -> Result<Self> {
        Ok(Self(memory::filled(UNKNOWN, (ROW * ROW) as usize)?))
    }

    pub(crate) fn get(&self, [x, y]: Place) -> Option<u32> {
        let inside = (0..ROW).contains(&x) && (0..ROW).contains(&y);
        let number = if inside { self.0[(y * ROW + x) as usize] } else { UNKNOWN };
        (number != UNKNOWN).then_some(number)
    }

    pub(crate) fn set(&mut self, [x, y]: Place, number: u32) {
        debug_assert!((0..ROW).contains(&x));
        self.0[(y * ROW + x) as usize] = number;
    }
}

fn tile(kind: TileKind, depth: u32) -> Result<TileTable> {
    let mut cells = memory::collect([Cell::first(kind)])?;
    for level in 0..depth - 1 {
        cells = split_all(&cells, kind.shift(level))?;
    }
    let index = |place: Place| array_index(place) as u16;
    let parents = memory::collect(cells.iter().map(|cell| cell.at.map(index)))?;
    let stands = memory::collect(cells.iter().map(|cell| Stand::of(cell.at)))?;
    let shift = kind.shift(depth - 1);
    let mut numbers = PlaceNumbers::new()?;
    for (first, cell) in (0..).step_by(4).zip(&cells) {
        for (number, place) in (first..).zip(cell.own_child(shift).at) {
            numbers.set(place, number);
        }
    }
    let last = split_all(&cells, shift)?;
    let own = |place: Place| numbers.get(place).unwrap_or(0);
    let faces = memory::collect(last.iter().map(|cell| cell.at.map(own)))?;
    let bounds = Bounds::new(kind, depth);
    let mut table = TileTable {
        parents,
        stands,
        faces,
        across: Default::default(),
        beyond: Default::default(),
        sides: [[0; 32]; 4],
        corners: std::array::from_fn(|i| own(bounds.corner(i))),
    };
    for (side, row) in table.sides.iter_mut().enumerate() {
        for (slot, place) in row.iter_mut().zip(bounds.side(side)) {
            *slot = own(place);
        }
    }
    let places = last.iter().flat_map(|cell| cell.at);
    for (slot, place) in (0..).zip(places).filter(|&(_, place)| numbers.get(place).is_none()) {
        let (side, at) = bounds.outside(place);
        let (list, at) = match at {
            Some(at) => (&mut table.across[side], at),
            None => (&mut table.beyond[side], 0),
        };
        memory::extend(list, [Foreign { slot, at }])?;
    }
    Ok(table)
}

/// The rectangle of a tile's own vertices.
struct Bounds {
    low: Place,
    high: Place,
}

impl Bounds {
    fn new(kind: TileKind, depth: u32) -> Self {
        let (shift, cells) = (kind.shift(depth - 1), kind.cells(depth - 1));
        let low = shift.map(|s| 2 - s);
        Self { low, high: std::array::from_fn(|i| low[i] + 2 * cells[i] as i32 - 1) }
    }

    fn corner(&self, corner: usize) -> Place {
        let [x, y] = CELL[corner % 4];
        let pick = |i: usize, high: i32| if high == 1 { self.high[i] } else { self.low[i] };
        [pick(0, x), pick(1, y)]
    }

    /// The places along a side, from its corner on.
    fn side(&self, side: usize) -> impl Iterator<Item = Place> + use<> {
        let ([x, y], [u, v]) = (self.corner(side), self.corner(side + 1));
        let steps = (u - x).abs() + (v - y).abs();
        (0..=steps).map(move |i| [x + i * (u - x).signum(), y + i * (v - y).signum()])
    }

    /// Where a place beside the rectangle is: across which side, and where along it seen
    /// from there; or beyond which corner.
    fn outside(&self, [x, y]: Place) -> (usize, Option<u16>) {
        let within = |i: usize, at: i32| (self.low[i]..=self.high[i]).contains(&at);
        let side = match (within(0, x), within(1, y)) {
            (true, _) => {
                if y < self.low[1] {
                    0
                } else {
                    2
                }
            }
            (_, true) => {
                if x > self.high[0] {
                    1
                } else {
                    3
                }
            }
            _ => {
                let beyond = |i: usize| {
                    let [u, v] = self.corner(i);
                    (u - x).abs() == 1 && (v - y).abs() == 1
                };
                return ((0..4).position(beyond).unwrap_or(0), None);
            }
        };
        let [u, v] = self.corner(side + 1);
        let along = if side % 2 == 0 { u - x } else { v - y };
        (side, Some(along.unsigned_abs() as u16))
    }
}

fn sector(depth: u32) -> Result<SectorTable> {
    let kind = TileKind::Face;
    let mut centre = Cell::first(kind);
    let mut runs: Vec<Vec<Cell>> = Vec::new();
    let mut table = SectorTable {
        parents: Vec::new(),
        vertices: Vec::new(),
        faces: Vec::new(),
        centres: Vec::new(),
        side: Vec::new(),
        corner: SectorVertex { next: false, run: 0, at: 0 },
        across: Default::default(),
        beyond: None,
    };
    for level in 0..depth {
        let shift = kind.shift(level);
        memory::extend(&mut table.centres, [centre.at])?;
        if level + 1 == depth {
            let own = |cell: &Cell| cell.own_child(shift).at;
            for run in &runs {
                memory::extend(&mut table.parents, [places(run, |cell| cell.at)?])?;
                memory::extend(&mut table.vertices, [places(run, own)?])?;
            }
        }
        for run in &mut runs {
            *run = split_all(run, shift)?;
        }
        let added = [centre.vertex_quad(0, shift), centre.edge_quad(0, shift)];
        memory::extend(&mut runs, [memory::collect(added)?])?;
        centre = centre.own_child(shift);
    }
    memory::extend(&mut table.centres, [centre.at])?;
    for run in &runs {
        memory::extend(&mut table.faces, [places(run, |cell| cell.at)?])?;
    }
    let bounds = Bounds::new(kind, depth);
    let find = |place: Place, next: bool| {
        let runs = (0..).zip(&table.vertices);
        let mut found = runs.filter_map(|(run, faces)| {
            let at = faces.as_flattened().iter().position(|&p| p == place)?;
            Some(SectorVertex { next, run, at: at as u32 })
        });
        found.next()
    };
    let vertex = |place: Place| {
        let next = || find(seen_from_next(place, depth), true);
        find(place, false).or_else(next).expect("a side belongs to two sectors")
    };
    let side = memory::collect(bounds.side(0).map(vertex))?;
    let corner = vertex(bounds.corner(0));
    // The faces at the border reach one vertex further in every second level.
    if kind.shift(depth - 1) == [0, 0] {
        for (side, row) in table.across.iter_mut().enumerate() {
            let out = OUTWARDS[side];
            let places = bounds.side(side).map(|place| add(place, out));
            *row =
                memory::collect(places.map(|place| (bounds.outside(place).1.unwrap_or(0), place)))?;
        }
        let beyond = |i: usize| add(bounds.corner(i), add(OUTWARDS[i], OUTWARDS[(i + 3) % 4]));
        table.beyond = Some([0, 1].map(beyond));
    }
    Ok(SectorTable { side, corner, ..table })
}

fn places(cells: &[Cell], of: impl Fn(&Cell) -> [Place; 4]) -> Result<Vec<[Place; 4]>> {
    memory::collect(cells.iter().map(of))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Tiles are rectangles, each with its own faces once; whoever has no vertex for a
    /// border finds as many on the other side.
    #[test]
    fn tiles_fit_together() {
        for depth in 2..=DEEPEST_TILE {
            let tables = TileTables::new(depth).unwrap();
            for kind in TILE_KINDS {
                let table = tables.tile(kind);
                let [x, y] = kind.cells(depth);
                assert_eq!(table.faces.len(), x * y);
                assert_eq!(table.parents.len() as u32, kind.faces(depth - 1));
                assert!(x.max(y) + 3 <= ROW as usize);
                let [x, y] = kind.cells(depth - 1);
                assert!(x.max(y) + 3 + TILE_ORIGIN <= TILE_ROW);
            }
            let rows = |kind| [0, 1].map(|side| Bounds::new(kind, depth).side(side).count());
            let [face, edge, vertex] = TILE_KINDS.map(rows);
            assert_eq!((face[0], edge[1]), (edge[0], vertex[0]));
            assert!(face[0] <= 32);
            let foreign = |kind| tables.tile(kind).across.each_ref().map(|list| !list.is_empty());
            let odd = depth % 2 == 1;
            assert_eq!(foreign(TileKind::Face), [odd; 4]);
            assert_eq!(foreign(TileKind::Edge), [!odd, odd, !odd, odd]);
            assert_eq!(foreign(TileKind::Vertex), [!odd; 4]);
        }
    }
}
