//! A point of the surface: down from cell to cell to a regular patch, or on to where a cell's
//! points become one.

use super::box_spline::Triangle;
use super::cell::{HALVINGS, IDENTITY, Kind, Map};
use super::lanes::{Block, LANES, Tensor, ZERO, blocks, plus};
use super::memo::Memo;
use super::nodes::Node;
use super::univariate::{ORDERS, Univariate};
use crate::base::simd::with_widest;
use crate::base::{Error, ErrorKind, Result, Scalar, memory};

/// Steps after which points that do not come together are given up.
const MOST_STEPS: u32 = 4000;
/// How far apart points that are one may be, of what they were.
const TOGETHER: f64 = 1.0 / (1_u64 << 54) as f64;

/// The derivatives by s and t of each number of a record, in order.
pub(super) const PARTIALS: [[usize; 2]; 6] = [[0, 0], [1, 0], [0, 1], [2, 0], [1, 1], [0, 2]];

/// What evaluation needs of a surface.
#[derive(Clone, Copy)]
pub(super) struct Patches<'a> {
    pub(super) nodes: &'a [Node],
    pub(super) univariate: Option<&'a Univariate>,
    pub(super) window: [i32; 2],
}

/// Where to begin.
#[derive(Clone, Copy)]
pub(super) struct Start {
    /// That of the first cell.
    pub(super) corner: u32,
    pub(super) node: u32,
    pub(super) at: [f64; 2],
    /// Derivatives of cell coordinates by those asked for.
    pub(super) jacobian: [[f64; 2]; 2],
}

/// The first cell of a corner: its control vertices, and values of all control vertices.
#[derive(Clone, Copy)]
pub(super) struct Cell<'a, T> {
    pub(super) vertices: &'a [u32],
    pub(super) values: &'a [T],
    pub(super) width: usize,
}

/// Memory of a thread, for values that stay the same.
#[derive(Debug, Default)]
pub(in crate::limit) struct Scratch {
    points: Vec<Block>,
    sums: Vec<Block>,
    taps: Vec<f64>,
    pub(super) results: Vec<f64>,
    pub(super) memo: Memo,
}

fn unsupported(message: &str) -> Error {
    Error::new(ErrorKind::Unsupported, message)
}

impl Patches<'_> {
    /// Writes the position and derivatives of a point: as many records as `out` holds, in the
    /// order of [`PARTIALS`].
    pub(super) fn evaluate<T: Scalar>(
        &self,
        cell: &Cell<'_, T>,
        start: &Start,
        scratch: &mut Scratch,
        out: &mut [f64],
    ) -> Result<()> {
        // It has no points, of which weights are made as many numbers wide.
        if let Node::Refused(why) = &self.nodes[start.node as usize] {
            return Err(unsupported(why));
        }
        let (width, blocks) = (cell.width, blocks(cell.width));
        let sums = out.len() / width * blocks;
        if scratch.sums.len() != sums {
            memory::resize(&mut scratch.sums, sums)?;
        }
        let mut jacobian = start.jacobian;
        let mut origin: &[Block] = &[];
        match &self.nodes[start.node as usize] {
            Node::Split { .. } => {
                let root = match scratch.memo.find(start.corner) {
                    Some(root) => root,
                    None => self.root(cell, start, scratch)?,
                };
                let memo = &mut scratch.memo;
                let (part, inside) = memo.root(root).kind.part(start.at);
                let place = match memo.part(root, part) {
                    Some(place) => place,
                    None => self.enter(root, part, inside, width, memo)?,
                };
                let (place, at) = self.arrive(place, start.at, width, out.len() == width, memo)?;
                let place = scratch.memo.place(place);
                let points;
                (points, origin) = scratch.memo.points(place, blocks);
                jacobian = place.jacobian;
                match at {
                    Some(at) => {
                        let node = &self.nodes[place.node as usize];
                        let (taps, sums) = (&mut scratch.taps, &mut scratch.sums[..]);
                        self.patch(node, at, points, blocks, taps, sums)?;
                    }
                    None => scratch.sums.fill(ZERO),
                }
            }
            node => {
                cell.gather(&mut scratch.points)?;
                let (taps, sums) = (&mut scratch.taps, &mut scratch.sums[..]);
                self.patch(node, start.at, &scratch.points, blocks, taps, sums)?;
            }
        }
        finish(jacobian, width, origin, &mut scratch.sums, out)
    }

    /// From the place of a part to a regular cell, and where in it a point of the first cell is; or to one whose
    /// points are one, without.
    #[inline(always)]
    pub(super) fn arrive(
        &self,
        place: u32,
        at: [f64; 2],
        width: usize,
        position_only: bool,
        memo: &mut Memo,
    ) -> Result<(u32, Option<[f64; 2]>)> {
        let here = memo.place(place);
        let at = here.map.apply(at);
        if here.kind.is_none() {
            return Ok((place, Some(at)));
        }
        self.descend(place, at, position_only, width, memo)
    }

    /// Remembers the first cell of a corner.
    #[cold]
    pub(super) fn root<T: Scalar>(
        &self,
        cell: &Cell<'_, T>,
        start: &Start,
        scratch: &mut Scratch,
    ) -> Result<u32> {
        cell.gather(&mut scratch.points)?;
        let Some(kind) = self.kind(start.node) else {
            return Err(Error::new(ErrorKind::BrokenInvariant, "a regular cell has no children"));
        };
        let (memo, points) = (&mut scratch.memo, &scratch.points);
        memo.add_root(start.corner, start.node, kind, start.jacobian, points, cell.width)
    }

    /// The place that holds all of a part of a first cell. It is found from a point inside, not
    /// from whichever sample came first, which may lie between two parts.
    #[cold]
    pub(super) fn enter(
        &self,
        root: u32,
        part: usize,
        inside: [f64; 2],
        width: usize,
        memo: &mut Memo,
    ) -> Result<u32> {
        let (mut place, mut at, mut halvings) = (memo.root(root).place, inside, 0);
        let age = memo.age();
        while let Some(kind) = memo.place(place).kind {
            if kind != Kind::Sector {
                if halvings == HALVINGS {
                    break;
                }
                halvings += 1;
            }
            let (turn, map) = kind.child(at);
            at = map.apply(at);
            (place, _) = self.step(place, turn, &map, width, memo)?;
        }
        if memo.age() == age {
            memo.set_part(root, part, place);
        }
        Ok(place)
    }

    /// What a cell with children is.
    fn kind(&self, node: u32) -> Option<Kind> {
        match self.nodes[node as usize] {
            Node::Split { kind, .. } => Some(kind),
            _ => None,
        }
    }

    /// The same from any cell.
    fn descend(
        &self,
        mut place: u32,
        mut at: [f64; 2],
        position_only: bool,
        width: usize,
        memo: &mut Memo,
    ) -> Result<(u32, Option<[f64; 2]>)> {
        for _ in 0..MOST_STEPS {
            let here = memo.place(place);
            let Some(kind) = here.kind else {
                return Ok((place, Some(at)));
            };
            let (turn, map) = kind.child(at);
            let there = map.apply(at);
            let stays = (0..2).all(|k| there[k].to_bits() == at[k].to_bits());
            if let Some(known) = here.child(turn)
                && !stays
            {
                (place, at) = (known, there);
                continue;
            }
            let is_here;
            (place, is_here) = self.step(place, turn, &map, width, memo)?;
            if stays && is_here {
                if !position_only {
                    return Err(unsupported("derivatives do not exist at a feature"));
                }
                if memo.place(place).is_within(TOGETHER) {
                    return Ok((place, None));
                }
            }
            at = there;
        }
        Err(unsupported("points do not converge"))
    }

    /// A child's place, made if it is new; and whether it has the surface of its parent.
    #[cold]
    fn step(
        &self,
        place: u32,
        turn: usize,
        map: &Map,
        width: usize,
        memo: &mut Memo,
    ) -> Result<(u32, bool)> {
        let here = memo.place(place);
        let child = match &self.nodes[here.node as usize] {
            Node::Split { children, .. } => children[turn].as_ref(),
            _ => None,
        };
        let child = child.ok_or_else(|| unsupported("there is no surface"))?;
        let is_same = child.node == here.node;
        if let Some(known) = here.child(turn) {
            return Ok((known, is_same));
        }
        let kind = self.kind(child.node);
        Ok((memo.add_child(place, turn, child, kind, map, width)?, is_same))
    }

    /// A regular cell, or the reason why there is none.
    fn patch(
        &self,
        node: &Node,
        at: [f64; 2],
        points: &[Block],
        blocks: usize,
        taps: &mut Vec<f64>,
        sums: &mut [Block],
    ) -> Result<()> {
        match node {
            Node::Grid(extent) => self.grid(*extent, at, points, blocks, taps, sums),
            Node::Triangle => {
                match sums.len() / blocks {
                    1 => with_widest(Triangle::<1> { at, points, sums, blocks }),
                    3 => with_widest(Triangle::<3> { at, points, sums, blocks }),
                    _ => with_widest(Triangle::<6> { at, points, sums, blocks }),
                }
                Ok(())
            }
            Node::Refused(why) => Err(unsupported(why)),
            Node::Split { .. } => {
                Err(Error::new(ErrorKind::BrokenInvariant, "a way down ended too early"))
            }
        }
    }

    /// The tensor product over the points of a grid.
    fn grid(
        &self,
        extent: [[i32; 2]; 2],
        at: [f64; 2],
        points: &[Block],
        blocks: usize,
        taps: &mut Vec<f64>,
        sums: &mut [Block],
    ) -> Result<()> {
        let univariate = self
            .univariate
            .ok_or_else(|| Error::new(ErrorKind::BrokenInvariant, "a grid without a mask"))?;
        let highest = PARTIALS[sums.len() / blocks - 1][1];
        if highest > univariate.derivatives() {
            return Err(unsupported("the scheme has no such derivatives"));
        }
        let orders = highest + 1;
        let [lowest, last] = self.window;
        let n = (last - lowest + 1) as usize;
        if taps.len() != 2 * ORDERS * n {
            memory::resize(taps, 2 * ORDERS * n)?;
        }
        // Under dual schemes a cell is the second half of an interval about its vertex.
        let is_dual = lowest + last == 0;
        for (axis, taps) in taps.chunks_exact_mut(ORDERS * n).enumerate() {
            let x = if is_dual { 0.5 + 0.5 * at[axis] } else { at[axis] };
            let taps = &mut taps[..orders * n];
            univariate.taps(x, orders, taps);
            let mut scale = 1.0;
            for weights in taps.chunks_exact_mut(n) {
                if is_dual {
                    for weight in weights.iter_mut() {
                        *weight *= scale;
                    }
                    scale *= 0.5;
                }
                if extent[axis] != self.window {
                    fold(weights, lowest, extent[axis]);
                }
            }
        }
        let taps: [[&[f64]; ORDERS]; 2] = std::array::from_fn(|axis| {
            let [first, last] = extent[axis].map(|x| (x - lowest) as usize);
            std::array::from_fn(|order| &taps[(axis * ORDERS + order) * n..][first..=last])
        });
        with_widest(Tensor { taps, points, sums, blocks });
        Ok(())
    }
}

impl<T: Scalar> Cell<'_, T> {
    /// The values of the control vertices in blocks.
    fn gather(&self, points: &mut Vec<Block>) -> Result<()> {
        let blocks = blocks(self.width);
        points.clear();
        memory::grow(points, self.vertices.len() * blocks)?;
        for &v in self.vertices {
            let record = &self.values[v as usize * self.width..][..self.width];
            if let [x, y, z] = record {
                points.push([x.to_f64(), y.to_f64(), z.to_f64(), 0.0]);
                continue;
            }
            for part in record.chunks(LANES) {
                let mut block = ZERO;
                block.iter_mut().zip(part).for_each(|(x, value)| *x = value.to_f64());
                points.push(block);
            }
        }
        Ok(())
    }
}

/// Turns weights of the points of a window into weights of those in a range, the others being
/// p₋ⱼ = 2p₀ − pⱼ beyond either end.
fn fold(taps: &mut [f64], lowest: i32, [first, last]: [i32; 2]) {
    let place = |x: i32| (x - lowest) as usize;
    let highest = lowest + taps.len() as i32 - 1;
    // The farthest first: an image may lie beyond the other end, but less far.
    let farthest = (first - lowest).max(highest - last);
    for distance in (1..=farthest).rev() {
        for (x, end) in [(first - distance, first), (last + distance, last)] {
            if x < lowest || x > highest {
                continue;
            }
            let weight = taps[place(x)];
            taps[place(x)] = 0.0;
            taps[place(end)] += 2.0 * weight;
            taps[place(2 * end - x)] -= weight;
        }
    }
}

/// Derivatives by cell coordinates become those by the coordinates asked for, and records those
/// of the caller.
fn finish(
    j: [[f64; 2]; 2],
    width: usize,
    origin: &[Block],
    sums: &mut [Block],
    out: &mut [f64],
) -> Result<()> {
    let blocks = blocks(width);
    let records = sums.len() / blocks;
    for (block, origin) in origin.iter().enumerate() {
        sums[block] = plus(sums[block], 1.0, origin);
    }
    if j != IDENTITY.linear {
        for block in 0..blocks {
            let at = |record: usize| record * blocks + block;
            for k in 0..LANES {
                if records >= 3 {
                    let [s, t] = [1, 2].map(|record| sums[at(record)][k]);
                    sums[at(1)][k] = s * j[0][0] + t * j[1][0];
                    sums[at(2)][k] = s * j[0][1] + t * j[1][1];
                }
                if records == 6 {
                    let [ss, st, tt] = [3, 4, 5].map(|record| sums[at(record)][k]);
                    let second = |a: usize, b: usize| {
                        ss * j[0][a] * j[0][b]
                            + st * (j[0][a] * j[1][b] + j[1][a] * j[0][b])
                            + tt * j[1][a] * j[1][b]
                    };
                    sums[at(3)][k] = second(0, 0);
                    sums[at(4)][k] = second(0, 1);
                    sums[at(5)][k] = second(1, 1);
                }
            }
        }
    }
    for (record, out) in sums.chunks_exact(blocks).zip(out.chunks_exact_mut(width)) {
        for (block, out) in record.iter().zip(out.chunks_mut(LANES)) {
            out.iter_mut().zip(block).for_each(|(x, sum)| *x = *sum);
        }
    }
    if out.iter().all(|x| x.is_finite()) {
        return Ok(());
    }
    Err(not_finite())
}

pub(super) fn not_finite() -> Error {
    Error::new(ErrorKind::NotFinite, "a value there, or a derivative, is not finite")
}
