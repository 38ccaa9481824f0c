//! From faces down to cells that are fine enough.

use super::cell::{Cell, Point, Root, Shape, UNIT};
use super::fit::{Fit, count, places};
use super::measure::Measure;
use crate::base::{Context, Element, Error, ErrorKind, Result, memory};
use crate::limit::surface::{Derivatives, Piece, Sample, Surface};
use std::sync::atomic::{AtomicU64, Ordering};

/// By what the measure of a cell is multiplied that is known from points alone.
const SAFETY: f64 = 2.0;
/// Cells whose points are evaluated together.
const BATCH: usize = 4096;
/// Cells that a thread takes at once.
const SHARE: usize = 16;
/// Leaves that the memory ceiling is asked for at once.
const PAUSE: u64 = 4096;

/// How fine cells are to be.
#[derive(Debug, Clone, Copy)]
pub(super) struct Goal {
    pub(super) measure: Measure,
    pub(super) limit: f64,
    /// Halvings at most.
    pub(super) levels: u32,
    /// Cells at most.
    pub(super) cells: u64,
    /// Bytes that a cell comes to.
    pub(super) bytes: u64,
    /// Faces in parts of which there is no surface are left out there.
    pub(super) partial: bool,
}

/// The cells of a surface.
#[derive(Debug, Default)]
pub(super) struct Leaves {
    /// For each of the roots.
    pub(super) cells: Vec<Vec<Cell>>,
    /// The largest measure of a cell.
    pub(super) largest: f64,
    /// Cells that are as small as they may be and yet not fine enough.
    pub(super) coarse: u64,
    /// Roots that were left out.
    pub(super) missing: u64,
}

/// A cell of one of the roots.
#[derive(Debug, Clone, Copy)]
struct Open {
    root: u32,
    cell: Cell,
    piece: Piece,
}

/// What became of some cells.
#[derive(Default)]
struct Found {
    leaves: Vec<(u32, Cell)>,
    open: Vec<Open>,
    largest: f64,
    coarse: u64,
}

/// What all cells have in common.
struct Splitter<'a> {
    context: &'a Context,
    surface: &'a Surface,
    roots: &'a [Root],
    goal: &'a Goal,
    /// The memory ceiling allows fewer cells than the goal: of two limits only the lower is asked,
    /// so that it does not depend on threads which one is named.
    is_ceiling_lower: bool,
    leaves: AtomicU64,
}

/// Splits every root until its cells are fine enough.
///
/// # Errors
/// [`ErrorKind::Unsupported`] where there is no surface, unless that may be;
/// [`ErrorKind::TooLarge`], and as [`Surface::evaluate`].
pub(super) fn split(
    context: &Context,
    surface: &Surface,
    positions: &[f64],
    roots: &[Root],
    goal: &Goal,
) -> Result<Leaves> {
    let is_ceiling_lower = context.check_memory(goal.cells.saturating_mul(goal.bytes)).is_err();
    let leaves = AtomicU64::new(0);
    let splitter = Splitter { context, surface, roots, goal, is_ceiling_lower, leaves };
    let mut leaves = Leaves::default();
    memory::extend(&mut leaves.cells, roots.iter().map(|_| Vec::new()))?;
    let mut open = splitter.begin(&mut leaves.missing)?;
    let mut done = 0;
    while !open.is_empty() {
        let mut later = Vec::new();
        for (i, batch) in open.chunks(BATCH).enumerate() {
            // Each of those that are open becomes one cell at least.
            splitter.check_open(open.len() - i * BATCH + later.len())?;
            for found in splitter.batch(positions, batch)? {
                for (root, cell) in found.leaves {
                    memory::extend(&mut leaves.cells[root as usize], [cell])?;
                }
                memory::extend(&mut later, found.open)?;
                leaves.largest = leaves.largest.max(found.largest);
                leaves.coarse += found.coarse;
            }
            done += batch.len();
            // Half of the way, as far as one can see it.
            context.report(0.5 * done as f64 / (done + later.len() + open.len()) as f64)?;
        }
        open = later;
    }
    Ok(leaves)
}

impl Splitter<'_> {
    /// The cells to begin with; counts the roots that are left out.
    fn begin(&self, missing: &mut u64) -> Result<Vec<Open>> {
        let mut open = Vec::new();
        for (root, of) in (0..).zip(self.roots) {
            let quarters = of.shape == Shape::Quad && self.surface.has_quarters();
            let cells = Cell::WHOLE.children(of.shape);
            let cells = if quarters { &cells[..] } else { &[Cell::WHOLE] };
            let start = open.len();
            for &cell in cells {
                memory::extend(&mut open, [Open { root, cell, piece: self.piece(root, cell)? }])?;
            }
            // Points between the quarters of a quad are evaluated in one of them.
            if open[start..].iter().any(|first| first.piece == Piece::Missing) {
                if !self.goal.partial {
                    return Err(no_surface(of));
                }
                open.truncate(start);
                *missing += 1;
            }
        }
        Ok(open)
    }

    /// What the surface is over a cell.
    fn piece(&self, root: u32, cell: Cell) -> Result<Piece> {
        let side = f64::from(cell.side.abs()) / f64::from(UNIT);
        self.surface.piece(&self.roots[root as usize].sample(cell.inside()), side)
    }

    /// Refuses cells that would be too many with those that are still to be looked at.
    fn check_open(&self, open: usize) -> Result<()> {
        let cells = self.leaves.load(Ordering::Relaxed) + open as u64;
        if self.is_ceiling_lower {
            return self.context.check_memory(cells.saturating_mul(self.goal.bytes));
        }
        if cells > self.goal.cells { Err(too_many(self.goal.cells)) } else { Ok(()) }
    }

    /// Looks at some cells.
    fn batch(&self, positions: &[f64], open: &[Open]) -> Result<Vec<Found>> {
        let (mut samples, mut starts) = (Vec::new(), Vec::new());
        for &Open { root, cell, .. } in open {
            let root = &self.roots[root as usize];
            memory::extend(&mut starts, [samples.len()])?;
            memory::extend(&mut samples, lattice(cell, root.shape).map(|at| root.sample(at)))?;
        }
        let points = evaluate(self.context, self.surface, &samples, positions)?;
        let shares: Vec<_> = memory::collect(open.chunks(SHARE).zip(starts.chunks(SHARE)))?;
        let look = |(open, starts): (&[Open], &[usize])| {
            let mut found = Found::default();
            for (open, &start) in open.iter().zip(starts) {
                let shape = self.roots[open.root as usize].shape;
                let fit = Fit::new(shape, &points[start..start + count(shape)]);
                self.look(*open, &fit, &mut found)?;
            }
            Ok(found)
        };
        self.context.map(shares, look)?.into_iter().collect()
    }

    /// Looks at a cell with the polynomial through its points.
    fn look(&self, open: Open, fit: &Fit, found: &mut Found) -> Result<()> {
        if open.piece == Piece::Polynomial {
            return self.descend(open.root, open.cell, fit, found);
        }
        if let Some(leaf) = self.leaf(open.cell, SAFETY, fit) {
            return self.add(open.root, open.cell, leaf, found);
        }
        let children = open.cell.children(fit.shape);
        for (cell, fit) in children.into_iter().zip(fit.children()) {
            // The points of a smooth cell are dense enough for its quarters.
            let known = open.piece == Piece::Regular;
            match self.leaf(cell, SAFETY, &fit).filter(|leaf| known && leaf.fine) {
                Some(leaf) => self.add(open.root, cell, leaf, found)?,
                None => match self.piece(open.root, cell)? {
                    Piece::Missing => return Err(no_surface(&self.roots[open.root as usize])),
                    piece => memory::extend(&mut found.open, [Open { cell, piece, ..open }])?,
                },
            }
        }
        Ok(())
    }

    /// Splits a cell over which the surface is a known polynomial.
    fn descend(&self, root: u32, cell: Cell, fit: &Fit, found: &mut Found) -> Result<()> {
        if let Some(leaf) = self.leaf(cell, 1.0, fit) {
            return self.add(root, cell, leaf, found);
        }
        let mut parts = cell.children(fit.shape).into_iter().zip(fit.children());
        parts.try_for_each(|(cell, fit)| self.descend(root, cell, &fit, found))
    }

    /// The measure of a cell that is not to be split.
    fn leaf(&self, cell: Cell, factor: f64, fit: &Fit) -> Option<Leaf> {
        let Goal { measure, limit, levels, .. } = self.goal;
        let factor = if matches!(measure, Measure::Chord) { factor } else { 1.0 };
        let measure = factor * measure.of(fit, limit / factor);
        let fine = measure <= *limit;
        (fine || cell.level() >= *levels).then_some(Leaf { measure, fine })
    }

    fn add(&self, root: u32, cell: Cell, leaf: Leaf, found: &mut Found) -> Result<()> {
        let before = self.leaves.fetch_add(1, Ordering::Relaxed);
        if before.is_multiple_of(PAUSE) {
            self.context.check_cancelled()?;
        }
        if self.is_ceiling_lower {
            let cells = (before / PAUSE + 1) * PAUSE;
            self.context.check_memory(cells.saturating_mul(self.goal.bytes))?;
        } else if before >= self.goal.cells {
            return Err(too_many(self.goal.cells));
        }
        found.largest = found.largest.max(leaf.measure);
        found.coarse += u64::from(!leaf.fine);
        memory::extend(&mut found.leaves, [(root, cell)])
    }
}

/// What is known of a cell that is not split.
#[derive(Clone, Copy)]
struct Leaf {
    measure: f64,
    fine: bool,
}

pub(in crate::limit) fn no_surface(root: &Root) -> Error {
    let face = root.face;
    let message = format!(
        "face {face}: there is no surface in a part of it, or none that is evaluated, as under dual \
         schemes beside a boundary where faces are no regular grid"
    );
    Error::new(ErrorKind::Unsupported, message).with_elements([Element::Face(u64::from(face))])
}

pub(super) fn too_many(most: u64) -> Error {
    let message = format!("more triangles are needed than may be made, {most}");
    Error::new(ErrorKind::TooLarge, message)
}

/// The points that a fit of a cell is made of.
fn lattice(cell: Cell, shape: Shape) -> impl Iterator<Item = Point> {
    places(shape).map(move |[i, j]| cell.quarters([i as i32, j as i32]))
}

/// The positions of samples.
fn evaluate(
    context: &Context,
    surface: &Surface,
    samples: &[Sample],
    positions: &[f64],
) -> Result<Vec<[f64; 3]>> {
    let mut points = memory::filled([0.0; 3], samples.len())?;
    let out = points.as_flattened_mut();
    surface.evaluate(context, samples, positions, 3, Derivatives::None, out)?;
    Ok(points)
}
