//! What a face becomes, looked at alone.
//!
//! Vertices are counted as in the refinement of a mesh of this one face, and are called
//! *slots*. In any other mesh the slots of a step come in the same order: those on edges in
//! one run, without the edges that another face leads, and those in faces in another.

use super::Hierarchy;
use crate::base::{Context, NONE, Result, memory};
use crate::mesh::Mesh;
use crate::refine::Pieces;
use crate::scheme::Scheme;
use std::ops::Range;

/// The vertices inside a face and on its border after some steps.
pub(super) struct Block {
    pub(super) slots: usize,
    /// For each step the slots on edges and those in faces.
    runs: Vec<[Range<u32>; 2]>,
    /// The side of the face that a slot on an edge lies on, or `NONE`.
    sides: Vec<u32>,
    /// For every slot a child of the face that has it, and the slot there.
    pub(super) in_child: Vec<(u32, u32)>,
}

impl Block {
    /// A face of some sides after one step or more.
    pub(super) fn new(pieces: Pieces, sides: u32, depth: u32) -> Result<Self> {
        let whole = alone(pieces, sides, depth)?;
        let slots = whole.mesh(depth).vertices();
        let mut block = Self {
            slots,
            runs: Vec::new(),
            sides: memory::filled(NONE, slots)?,
            in_child: memory::filled((0, NONE), slots)?,
        };
        block.find_sides(pieces, &whole)?;
        block.find_children(pieces, &whole, depth)?;
        Ok(block)
    }

    fn find_sides(&mut self, pieces: Pieces, whole: &Hierarchy) -> Result<()> {
        // The sides that the edges of a level lie on, by corner.
        let mut on_side = memory::collect(0..whole.mesh(0).corners() as u32)?;
        for level in 0..whole.last_level() {
            let (mesh, child) = (whole.mesh(level), whole.mesh(level + 1));
            let mut slot = mesh.vertices();
            let mut halves = memory::filled(NONE, child.corners())?;
            for corner in 0..mesh.corners() as u32 {
                let side = on_side[corner as usize];
                halves[pieces.start_half(corner) as usize] = side;
                halves[pieces.end_half(mesh.next(corner)) as usize] = side;
                if mesh.is_first_of_edge(corner) {
                    self.sides[slot] = side;
                    slot += 1;
                }
            }
            let [first, middle, end] = [mesh.vertices(), slot, child.vertices()].map(|n| n as u32);
            memory::extend(&mut self.runs, [[first..middle, middle..end]])?;
            on_side = halves;
        }
        Ok(())
    }

    /// After the first step there is nothing in the children that the face has not: its
    /// only child is itself.
    fn find_children(&mut self, pieces: Pieces, whole: &Hierarchy, depth: u32) -> Result<()> {
        if depth == 1 {
            for (slot, place) in (0..).zip(&mut self.in_child) {
                *place = (0, slot);
            }
            return Ok(());
        }
        let child = alone(pieces, pieces.sides(), depth - 1)?;
        let inner = child.mesh(depth - 1).corner_vertices();
        let corners = whole.mesh(depth).corner_vertices().chunks_exact(inner.len());
        for (number, part) in (0..).zip(corners) {
            for (&slot, &inner) in part.iter().zip(inner) {
                let place = &mut self.in_child[slot as usize];
                if place.1 == NONE {
                    *place = (number, inner);
                }
            }
        }
        Ok(())
    }

    /// The slots of a face that leads some of its sides, a bit for each: its vertices, then
    /// those of every run.
    pub(super) fn led(&self, leads: u32) -> Result<Led> {
        let kept = |&slot: &u32| {
            let side = self.sides[slot as usize];
            side == NONE || leads >> side & 1 == 1
        };
        let own = self.runs.first().map_or(0, |runs| runs[0].start);
        let mut led = Led { slots: Vec::new(), starts: Vec::new() };
        let mut len = own;
        memory::extend(&mut led.slots, std::iter::once(0..own))?;
        memory::extend(&mut led.starts, [len])?;
        for run in self.runs.iter().flatten() {
            for slot in run.clone().filter(kept) {
                len += 1;
                match led.slots.last_mut() {
                    Some(range) if range.end == slot => range.end += 1,
                    _ => memory::extend(&mut led.slots, std::iter::once(slot..slot + 1))?,
                }
            }
            memory::extend(&mut led.starts, [len])?;
        }
        Ok(led)
    }
}

/// The slots of a face that are its own.
pub(super) struct Led {
    pub(super) slots: Vec<Range<u32>>,
    /// Where each run begins among them, and where the last one ends.
    starts: Vec<u32>,
}

impl Led {
    /// The places of a run.
    #[inline]
    pub(super) fn run(&self, run: usize) -> Range<usize> {
        self.starts[run] as usize..self.starts[run + 1] as usize
    }
}

/// A mesh of one face, refined.
fn alone(pieces: Pieces, sides: u32, depth: u32) -> Result<Hierarchy> {
    let scheme = match pieces {
        Pieces::Quads => Scheme::bilinear(),
        Pieces::Triangles => Scheme::loop_triangles(),
    };
    let face = memory::collect(0..sides)?;
    let mesh = Mesh::from_polygons(sides as usize, &[sides], &face)?;
    Hierarchy::new(&Context::serial(), mesh, scheme, depth)
}
