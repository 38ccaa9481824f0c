//! The numbering of a few splits of one face, worked out once for all faces.
//!
//! A split numbers edges by their first corners and faces in order. The children of a face
//! follow each other, so all that they lead, level by level, is numbered in one run; which
//! of the edges on the sides belong to it depends on nothing but which sides it leads.

use super::Pieces;
use super::patch_grid::{PatchFrame, PatchGrid, Place};
use crate::base::{Result, memory};

/// Which sides a face leads, one bit each.
pub(crate) type Led = u8;

/// Kinds of faces by what they lead.
const KINDS: usize = 16;

/// The order of the new vertices of one kind of face.
#[derive(Debug)]
pub(crate) struct PatchOrder {
    /// Array index by number, for each level those on edges and then those in faces.
    runs: Vec<Vec<u16>>,
    /// Number in its run by array index, for vertices on edges.
    number: Vec<u16>,
}

impl PatchOrder {
    /// The array indices of the vertices that a level adds on edges, in order.
    #[inline(always)]
    pub(crate) fn on_edges(&self, level: usize) -> &[u16] {
        &self.runs[2 * level]
    }

    /// Those that it adds in faces.
    #[inline(always)]
    pub(crate) fn in_faces(&self, level: usize) -> &[u16] {
        &self.runs[2 * level + 1]
    }

    /// The number, within its run, of a vertex on an edge.
    #[inline(always)]
    pub(crate) fn number(&self, index: usize) -> u32 {
        u32::from(self.number[index])
    }

    fn push(&mut self, run: usize, index: usize) -> Result<()> {
        self.number[index] = self.runs[run].len() as u16;
        memory::extend(&mut self.runs[run], [index as u16])
    }
}

/// The orders of all kinds of faces, and the last level's faces.
#[derive(Debug)]
pub(crate) struct PatchTables {
    frames: Vec<PatchFrame>,
    kinds: Vec<Option<PatchOrder>>,
    /// Of all faces but the last level's: the array indices of their vertices and of the
    /// middles of their edges.
    parents: Vec<u16>,
    /// Those of the vertices that the levels add on each side, in the side's direction.
    sides: Vec<Vec<u16>>,
}

impl PatchTables {
    /// The tables of the kinds of faces that occur, for `depth` splits.
    pub(crate) fn new(pieces: Pieces, depth: u32, kinds: [bool; KINDS]) -> Result<Self> {
        let grid = PatchGrid::new(pieces, depth);
        let mut faces = memory::collect((0..grid.sides()).map(|i| grid.corner(i)))?;
        let mut orders = memory::reserved(KINDS)?;
        for used in kinds {
            orders.push(if used { Some(empty(grid, depth)?) } else { None });
        }
        for level in 0..depth as usize {
            for (led, order) in (0..).zip(&mut orders) {
                if let Some(order) = order {
                    number(grid, &faces, led, level, order)?;
                }
            }
            if level + 1 < depth as usize {
                faces = children(pieces, &faces)?;
            }
        }
        let parents = faces.chunks_exact(grid.sides()).flat_map(|face| {
            let next = face.iter().cycle().skip(1);
            let middles = face.iter().zip(next).map(|(&a, &b)| mean(a, b));
            face.iter().copied().chain(middles).map(|place| grid.index(place) as u16)
        });
        let parents = memory::collect(parents)?;
        let frame = |level| PatchFrame::new(PatchGrid::new(pieces, level));
        let frames = memory::collect((0..=depth).map(frame))?;
        let sides = memory::collect((0..grid.sides()).map(|side| along(grid, side, depth)))?;
        let sides = sides.into_iter().collect::<Result<_>>()?;
        Ok(Self { frames, kinds: orders, parents, sides })
    }

    /// The frame of the array of a level.
    #[inline(always)]
    pub(crate) fn frame(&self, level: u32) -> &PatchFrame {
        &self.frames[level as usize]
    }

    /// The array indices of the vertices that a level adds on a side, from its start.
    #[inline(always)]
    pub(crate) fn side(&self, side: usize, level: usize) -> &[u16] {
        let count = 1 << level;
        &self.sides[side][count - 1..2 * count - 1]
    }

    /// For each face of the level before the last, in order, the array indices of its N
    /// vertices and of the middles of its N edges.
    #[inline(always)]
    pub(crate) fn parents<const N: usize>(&self) -> &[[[u16; N]; 2]] {
        self.parents.as_chunks::<N>().0.as_chunks::<2>().0
    }

    /// The order of the faces that lead some sides.
    ///
    /// # Panics
    /// If that kind was not asked for.
    #[inline(always)]
    pub(crate) fn order(&self, led: Led) -> &PatchOrder {
        self.kinds[led as usize].as_ref().expect("kinds that occur have tables")
    }
}

/// What the levels add on a side, level after level.
fn along(grid: PatchGrid, side: usize, depth: u32) -> Result<Vec<u16>> {
    let places = (0..depth).flat_map(|level| {
        let length = grid.cells() >> level;
        (0..1 << level).map(move |number| grid.index(grid.on_side(side, number, length)) as u16)
    });
    memory::collect(places)
}

fn empty(grid: PatchGrid, depth: u32) -> Result<PatchOrder> {
    let mut runs = memory::reserved(2 * depth as usize)?;
    runs.resize_with(2 * depth as usize, Vec::new);
    Ok(PatchOrder { runs, number: memory::filled(u16::MAX, grid.places())? })
}

/// Numbers what one split adds to the faces of a level.
fn number(
    grid: PatchGrid,
    faces: &[Place],
    led: Led,
    level: usize,
    order: &mut PatchOrder,
) -> Result<()> {
    for face in faces.chunks_exact(grid.sides()) {
        for (i, &start) in face.iter().enumerate() {
            let middle = mean(start, face[(i + 1) % face.len()]);
            let index = grid.index(middle);
            let first = match grid.side_of(middle) {
                Some(side) => led >> side & 1 == 1,
                None => order.number[index] == u16::MAX,
            };
            if first {
                order.push(2 * level, index)?;
            }
        }
        if let &[a, _, c, _] = face {
            let middle = grid.index(mean(a, c)) as u16;
            memory::extend(&mut order.runs[2 * level + 1], [middle])?;
        }
    }
    Ok(())
}

/// The vertices of the children of some faces, as the splits order them.
fn children(pieces: Pieces, faces: &[Place]) -> Result<Vec<Place>> {
    let mut children = memory::reserved(4 * faces.len())?;
    for face in faces.chunks_exact(pieces.sides() as usize) {
        match *face {
            [a, b, c, d] => {
                let [ab, bc, cd, da] = [mean(a, b), mean(b, c), mean(c, d), mean(d, a)];
                let m = mean(a, c);
                let quads = [[a, ab, m, da], [b, bc, m, ab], [c, cd, m, bc], [d, da, m, cd]];
                children.extend(quads.into_iter().flatten());
            }
            [a, b, c] => {
                let [ab, bc, ca] = [mean(a, b), mean(b, c), mean(c, a)];
                let triangles = [[a, ab, ca], [b, bc, ab], [c, ca, bc], [ca, ab, bc]];
                children.extend(triangles.into_iter().flatten());
            }
            _ => unreachable!("pieces have three or four sides"),
        }
    }
    Ok(children)
}

fn mean(a: Place, b: Place) -> Place {
    [i32::midpoint(a[0], b[0]), i32::midpoint(a[1], b[1])]
}
