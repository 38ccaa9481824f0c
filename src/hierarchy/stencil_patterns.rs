//! Rows of everything inside a face, by places in its ring.
//!
//! What a face becomes after d steps is what its children become after d − 1, and so its rows
//! are the children's on the rows of one step. Below the first level there are few kinds of
//! faces, whose patterns are made once.

use super::stencil_block::Block;
use super::stencil_ring::Ring;
use super::stencil_sorts::make_room;
use super::stencil_step::StepRows;
use super::{Hierarchy, Interpolation, StencilTask};
use crate::base::simd::{InnerLoop, with_widest};
use crate::base::{Error, ErrorKind, Result, Scalar, memory};
use crate::mesh::Mesh;
use crate::refine::{Pieces, PrimalSplit};
use crate::sparse::{PlacedRows, PlacedWriter};
use std::collections::HashMap;
use std::ops::Range;

/// Makes patterns, each kind and depth once.
pub(super) struct Patterns<'a> {
    hierarchy: &'a Hierarchy,
    splits: Vec<PrimalSplit<'a>>,
    interpolation: Interpolation,
    from: u32,
    /// By sides and depth.
    blocks: HashMap<(u32, u32), Block>,
    /// By depth and signature.
    known: HashMap<(u32, Vec<u32>), PlacedRows<f64>>,
}

impl<'a> Patterns<'a> {
    /// Of a task whose scheme has a primal split and no passes.
    pub(super) fn new(hierarchy: &'a Hierarchy, task: &StencilTask) -> Result<Self> {
        let pieces = hierarchy.scheme().pieces();
        let split = |level| PrimalSplit::by_corners(hierarchy.mesh(level), pieces);
        Ok(Self {
            hierarchy,
            splits: (task.from..task.to).map(split).collect::<Result<_>>()?,
            interpolation: task.interpolation,
            from: task.from,
            blocks: HashMap::new(),
            known: HashMap::new(),
        })
    }

    /// Makes all that the rows of a face of the task's first level ask for.
    pub(super) fn prepare(&mut self, face: u32, depth: u32) -> Result<()> {
        self.prepare_at(self.from, face, depth)
    }

    fn prepare_at(&mut self, level: u32, face: u32, depth: u32) -> Result<()> {
        let pieces = self.hierarchy.scheme().pieces();
        let sides = self.hierarchy.mesh(level).layout.face(face).len() as u32;
        if !self.blocks.contains_key(&(sides, depth)) {
            let block = Block::new(pieces, sides, depth)?;
            make_room(&mut self.blocks)?;
            self.blocks.insert((sides, depth), block);
        }
        if depth == 1 {
            return Ok(());
        }
        let mesh = self.hierarchy.mesh(level + 1);
        let mut ring = Ring::default();
        for child in self.children(level, face) {
            walk(&mut ring, mesh, child)?;
            let key = (depth - 1, memory::copied(&ring.signature)?);
            if !self.known.contains_key(&key) {
                self.prepare_at(level + 1, child, depth - 1)?;
                let rows = self.rows_at(level + 1, child, &ring, depth - 1)?;
                make_room(&mut self.known)?;
                self.known.insert(key, rows);
            }
        }
        Ok(())
    }

    /// Bytes of what was prepared.
    pub(super) fn bytes(&self) -> u64 {
        self.known.values().map(PlacedRows::bytes).sum()
    }

    fn children(&self, level: u32, face: u32) -> Range<u32> {
        match self.hierarchy.scheme().pieces() {
            Pieces::Quads => self.hierarchy.mesh(level).layout.face(face),
            Pieces::Triangles => 4 * face..4 * face + 4,
        }
    }

    /// The rows of all slots of a face that was prepared.
    pub(super) fn rows<T: Scalar>(
        &self,
        face: u32,
        ring: &Ring,
        depth: u32,
    ) -> Result<PlacedRows<T>> {
        self.rows_at(self.from, face, ring, depth)
    }

    fn rows_at<T: Scalar>(
        &self,
        level: u32,
        face: u32,
        ring: &Ring,
        depth: u32,
    ) -> Result<PlacedRows<T>> {
        let split = &self.splits[(level - self.from) as usize];
        let mut step = StepRows::new(self.hierarchy.scheme(), split, self.interpolation, ring);
        if depth == 1 {
            return step.first();
        }
        let block = self.blocks.get(&(ring.signature[0], depth)).ok_or_else(lost)?;
        let mesh = self.hierarchy.mesh(level + 1);
        step.name_children(mesh)?;
        let (mut inner, mut children, mut dense) = (Ring::default(), Vec::new(), Vec::new());
        let stride = padded(ring.vertices.len());
        for child in self.children(level, face) {
            walk(&mut inner, mesh, child)?;
            let key = (depth - 1, memory::copied(&inner.signature)?);
            let rows = self.known.get(&key).ok_or_else(lost)?;
            memory::extend(&mut children, [(rows, dense.len() / stride)])?;
            for &vertex in &*inner.vertices {
                step.add_row(vertex, &mut dense)?;
            }
        }
        Ok(with_widest(Composed {
            children: &children,
            in_child: &block.in_child,
            dense: &dense,
            places: ring.vertices.len(),
            made: PlacedWriter::new(block.slots, ring.vertices.len())?,
        }))
    }
}

/// The ring of a child. Beside a vertex of valence 3 the middle of a split triangle meets another
/// vertex twice, and no other ring of its kind does.
fn walk(ring: &mut Ring, mesh: &Mesh, child: u32) -> Result<()> {
    if ring.walk_once(mesh, child) { Ok(()) } else { Err(lost()) }
}

/// The length that a row of up to 255 places is filled up to: sums of such lengths are
/// compiled apart, and the usual ones stay in registers.
pub(super) fn padded(places: usize) -> usize {
    match places {
        0..=16 => 16,
        17..=24 => 24,
        25..=32 => 32,
        33..=64 => 64,
        _ => 256,
    }
}

/// Children's rows on the rows of one step.
struct Composed<'s, T> {
    /// The rows of every child, and where those of the step begin for its ring.
    children: &'s [(&'s PlacedRows<f64>, usize)],
    /// For every slot its child and the slot there.
    in_child: &'s [(u32, u32)],
    dense: &'s [f64],
    places: usize,
    made: PlacedWriter<T>,
}

impl<T: Scalar> InnerLoop for Composed<'_, T> {
    type Output = PlacedRows<T>;

    #[inline(always)]
    fn run(self) -> Self::Output {
        match padded(self.places) {
            16 => self.rows::<16>(),
            24 => self.rows::<24>(),
            32 => self.rows::<32>(),
            64 => self.rows::<64>(),
            _ => self.rows::<256>(),
        }
    }
}

impl<T: Scalar> Composed<'_, T> {
    #[inline(always)]
    fn rows<const N: usize>(mut self) -> PlacedRows<T> {
        let step = self.dense.as_chunks::<N>().0;
        for &(child, slot) in self.in_child {
            let (rows, start) = self.children[child as usize];
            let (places, weights) = rows.row(slot as usize);
            let mut sums = [0.0; N];
            for (&place, &weight) in places.iter().zip(weights) {
                let row = &step[start + usize::from(place)];
                for (sum, factor) in sums.iter_mut().zip(row) {
                    *sum += weight * factor;
                }
            }
            self.made.push(&sums[..self.places]);
        }
        self.made.finish()
    }
}

/// Rings hold whatever the rows inside a face speak of.
pub(super) fn lost() -> Error {
    Error::new(ErrorKind::BrokenInvariant, "a stencil pattern leaves its ring")
}
