//! The cells that samples have led to, with their points: near features samples have most of
//! the way down in common. A cell's points are the same however one came to it, so that what is
//! remembered changes no bit.

use super::cell::{IDENTITY, Kind, Map, PARTS};
use super::lanes::{Block, ZERO, blocks, plus};
use super::nodes::Child;
use crate::base::simd::fetch_ahead;
use crate::base::{Error, ErrorKind, NONE, Result, memory};
use std::collections::HashMap;
use std::hash::{BuildHasherDefault, Hasher};

/// Blocks that are remembered, 8 MB, and about as much for what leads to them; then all is
/// forgotten.
const MOST: usize = 1 << 18;

/// A cell below an irregular one, its points less an origin.
#[derive(Debug, Clone, Copy)]
pub(super) struct Place {
    pub(super) node: u32,
    /// What it is, if it has children.
    pub(super) kind: Option<Kind>,
    /// Where its origin is, which its points follow.
    start: u32,
    points: u32,
    /// To its coordinates from those of the first cell.
    pub(super) map: Map,
    /// Derivatives of its coordinates by those asked for.
    pub(super) jacobian: [[f64; 2]; 2],
    /// The largest coordinate of its points, and of those of the first cell below the root.
    spread: f64,
    first_spread: f64,
    children: [u32; 4],
}

impl Place {
    /// The place of a child cell, once it has been made.
    pub(super) fn child(&self, at: usize) -> Option<u32> {
        Some(self.children[at]).filter(|&child| child != NONE)
    }

    /// How far its points are apart, of what those of the first cell were.
    pub(super) fn is_within(&self, factor: f64) -> bool {
        self.spread <= self.first_spread * factor
    }
}

/// The first cell of a corner.
#[derive(Debug, Clone, Copy)]
pub(super) struct Root {
    pub(super) place: u32,
    pub(super) kind: Kind,
    /// For each part of the cell the last place that holds it all, or [`NONE`].
    parts: [u32; PARTS],
}

/// Places of a thread.
#[derive(Debug, Default)]
pub(super) struct Memo {
    places: Vec<Place>,
    records: Vec<Block>,
    roots: Vec<Root>,
    /// Numbers of roots by the corners of their cells.
    by_corner: HashMap<u32, u32, BuildHasherDefault<Multiplied>>,
    /// How often all was forgotten.
    age: u64,
}

impl Memo {
    /// The number of the first cell of a corner.
    #[inline(always)]
    pub(super) fn find(&self, corner: u32) -> Option<u32> {
        self.by_corner.get(&corner).copied()
    }

    pub(super) fn root(&self, root: u32) -> &Root {
        &self.roots[root as usize]
    }

    /// The place of a part of a first cell, once it has been made.
    #[inline(always)]
    pub(super) fn part(&self, root: u32, part: usize) -> Option<u32> {
        Some(self.roots[root as usize].parts[part]).filter(|&place| place != NONE)
    }

    pub(super) fn set_part(&mut self, root: u32, part: usize, place: u32) {
        self.roots[root as usize].parts[part] = place;
    }

    /// Changes when all is forgotten, and every number with it.
    pub(super) fn age(&self) -> u64 {
        self.age
    }

    pub(super) fn place(&self, place: u32) -> &Place {
        &self.places[place as usize]
    }

    /// The points of a place, and the origin that they are to be added to.
    #[inline(always)]
    pub(super) fn points(&self, place: &Place, blocks: usize) -> (&[Block], &[Block]) {
        let (start, count) = (place.start as usize, place.points as usize);
        let (origin, points) = self.records[start..][..(1 + count) * blocks].split_at(blocks);
        (points, origin)
    }

    /// Asks for a place ahead.
    #[inline(always)]
    pub(super) fn ask_place(&self, place: u32) {
        fetch_ahead(&self.places, place as usize);
    }

    /// Asks for a place's points ahead, `N` of a block each.
    #[inline(always)]
    pub(super) fn ask_points<const N: usize>(&self, place: u32) {
        let start = self.place(place).start as usize;
        // Two of these blocks are as much as comes at once.
        for record in (0..=N).step_by(2) {
            fetch_ahead(&self.records, start + record);
        }
    }

    /// Remembers the cell of a corner with its points.
    pub(super) fn add_root(
        &mut self,
        corner: u32,
        node: u32,
        kind: Kind,
        jacobian: [[f64; 2]; 2],
        points: &[Block],
        width: usize,
    ) -> Result<u32> {
        let blocks = blocks(width);
        if self.records.len() + points.len() > MOST {
            self.records.clear();
            self.forget();
        }
        let start = self.records.len() as u32;
        memory::grow(&mut self.records, blocks + points.len())?;
        self.records.extend(std::iter::repeat_n(ZERO, blocks));
        self.records.extend_from_slice(points);
        let refused = |_| Error::new(ErrorKind::OutOfResources, "a table could not grow");
        self.by_corner.try_reserve(1).map_err(refused)?;
        let points = (points.len() / blocks) as u32;
        let place = self.places.len() as u32;
        let (spread, children) = (f64::NAN, [NONE; 4]);
        let new = Place {
            node,
            kind: Some(kind),
            start,
            points,
            map: IDENTITY,
            jacobian,
            spread,
            first_spread: spread,
            children,
        };
        memory::extend(&mut self.places, [new])?;
        let root = self.roots.len() as u32;
        memory::extend(&mut self.roots, [Root { place, kind, parts: [NONE; PARTS] }])?;
        self.by_corner.insert(corner, root);
        Ok(root)
    }

    /// Goes from a place to a child cell, and remembers that; `kind` is the
    /// child's, `map` leads to it.
    pub(super) fn add_child(
        &mut self,
        parent: u32,
        at: usize,
        child: &Child,
        kind: Option<Kind>,
        map: &Map,
        width: usize,
    ) -> Result<u32> {
        let blocks = blocks(width);
        let more = (1 + child.count()) * blocks;
        let parent = if self.records.len() + more > MOST {
            self.forget_others(parent, blocks)
        } else {
            parent
        };
        let from = *self.place(parent);
        memory::grow(&mut self.records, more)?;
        let start = self.records.len();
        self.records.extend_from_within(from.start as usize..from.start as usize + blocks);
        let points = from.start as usize + blocks;
        for row in child.rows() {
            for block in 0..blocks {
                let term = |sum: Block, &(from, weight): &(u32, f64)| {
                    plus(sum, weight, &self.records[points + from as usize * blocks + block])
                };
                let sum = row.iter().fold(ZERO, term);
                self.records.push(sum);
            }
        }
        let spread = recentre(&mut self.records[start..], blocks);
        let first_spread = if from.spread.is_nan() { spread } else { from.first_spread };
        let place = self.places.len() as u32;
        memory::extend(
            &mut self.places,
            [Place {
                node: child.node,
                kind,
                start: start as u32,
                points: child.count() as u32,
                map: map.following(&from.map),
                jacobian: map.after(from.jacobian),
                spread,
                first_spread,
                children: [NONE; 4],
            }],
        )?;
        self.places[parent as usize].children[at] = place;
        Ok(place)
    }

    /// Forgets all but one place, and returns its new name.
    fn forget_others(&mut self, place: u32, blocks: usize) -> u32 {
        let mut kept = *self.place(place);
        let (start, count) = (kept.start as usize, (1 + kept.points as usize) * blocks);
        self.records.copy_within(start..start + count, 0);
        self.records.truncate(count);
        (kept.start, kept.children) = (0, [NONE; 4]);
        self.forget();
        self.places.push(kept);
        0
    }

    fn forget(&mut self) {
        self.places.clear();
        self.roots.clear();
        self.by_corner.clear();
        self.age += 1;
    }
}

/// Moves the origin, which comes first, to the first point, so that differences of the others
/// keep their digits; returns the largest coordinate.
fn recentre(records: &mut [Block], blocks: usize) -> f64 {
    let (origin, points) = records.split_at_mut(blocks);
    let (first, rest) = points.split_at_mut(blocks);
    let mut spread = ZERO;
    for point in rest.chunks_exact_mut(blocks) {
        for (block, from) in point.iter_mut().zip(&*first) {
            for k in 0..block.len() {
                block[k] -= from[k];
                spread[k] = spread[k].max(block[k].abs());
            }
        }
    }
    for (sum, from) in origin.iter_mut().zip(first) {
        *sum = plus(*sum, 1.0, from);
        *from = ZERO;
    }
    spread.into_iter().fold(0.0, f64::max)
}

/// Spreads numbers of corners, which nobody chooses to be in each other's way, by Knuth's
/// multiplicative hashing.
#[derive(Debug, Default)]
struct Multiplied(u64);

impl Hasher for Multiplied {
    fn finish(&self) -> u64 {
        self.0
    }

    fn write(&mut self, bytes: &[u8]) {
        for &byte in bytes {
            self.write_u32(u32::from(byte));
        }
    }

    fn write_u32(&mut self, number: u32) {
        let mixed = (self.0 ^ u64::from(number)).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        self.0 = mixed ^ (mixed >> 32);
    }
}
