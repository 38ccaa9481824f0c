//! Cells beside each other: none with a side that others cut into more than two.

use super::cell::{Cell, Point, Root, Shape};
use super::plan;
use super::shared::Shared;
use crate::base::{Context, Result, memory};
use crate::mesh::Mesh;

/// Roots that a thread takes at once.
const SHARE: usize = 64;
/// Cells of a root after which it is asked whether to go on.
const PAUSE: usize = 4096;

/// The cells of all roots with their corners.
pub(super) struct Net<'a> {
    context: &'a Context,
    mesh: &'a Mesh,
    pub(super) roots: &'a [Root],
    /// For each root, in the order of a curve that fills it.
    pub(super) cells: Vec<Vec<Cell>>,
    /// Corners of the cells of each root, ascending.
    pub(super) points: Vec<Vec<Point>>,
    /// Those on borders of roots, ascending.
    border: Vec<Shared>,
}

impl<'a> Net<'a> {
    /// # Errors
    /// [`crate::ErrorKind::MemoryCeiling`], [`crate::ErrorKind::OutOfResources`],
    /// [`crate::ErrorKind::Cancelled`].
    pub(super) fn new(
        context: &'a Context,
        mesh: &'a Mesh,
        roots: &'a [Root],
        cells: Vec<Vec<Cell>>,
    ) -> Result<Self> {
        let mut net = Self { context, mesh, roots, cells, points: Vec::new(), border: Vec::new() };
        net.split_folded()?;
        net.find_points()?;
        net.balance()?;
        Ok(net)
    }

    /// Runs work on every root, and collects what it gives.
    pub(super) fn each<R: Send>(
        &self,
        work: impl Fn(usize) -> Result<R> + Sync + Send,
    ) -> Result<Vec<R>> {
        let shares = memory::collect((0..self.roots.len()).step_by(SHARE))?;
        let run = |first: usize| {
            let last = (first + SHARE).min(self.roots.len());
            (first..last).map(&work).collect::<Result<Vec<R>>>()
        };
        let mut all = Vec::new();
        for share in self.context.map(shares, run)? {
            memory::extend(&mut all, share?)?;
        }
        Ok(all)
    }

    /// Runs work on the cells of a root with their numbers, until a cancel is asked for.
    pub(super) fn each_cell(
        &self,
        root: usize,
        mut work: impl FnMut(usize, Cell) -> Result<()>,
    ) -> Result<()> {
        for (k, &cell) in self.cells[root].iter().enumerate() {
            if k.is_multiple_of(PAUSE) {
                self.context.check_cancelled()?;
            }
            work(k, cell)?;
        }
        Ok(())
    }

    /// The name of a point of a root that others may have too.
    pub(super) fn shared(&self, root: usize, point: Point) -> Option<Shared> {
        Shared::of(self.mesh, &self.roots[root], point)
    }

    /// Splits quads whose diagonals are edges or diagonals elsewhere: two triangles instead of the
    /// quad would share an edge with others that are not beside them.
    fn split_folded(&mut self) -> Result<()> {
        let whole =
            |i: &usize| self.roots[*i].shape == Shape::Quad && self.cells[*i] == [Cell::WHOLE];
        let wholes = memory::collect((0..self.roots.len()).filter(whole))?;
        if wholes.is_empty() {
            return Ok(());
        }
        let sorted = |[a, b]: [u32; 2]| [a.min(b), a.max(b)];
        let diagonals = |&i: &usize| {
            let c = self.roots[i].corner as usize;
            let v = &self.mesh.vert[c..c + 4];
            [sorted([v[0], v[2]]), sorted([v[1], v[3]])]
        };
        let mut lines = memory::collect(self.mesh.edge_vertices().map(sorted))?;
        memory::extend(&mut lines, wholes.iter().flat_map(diagonals))?;
        lines.sort_unstable();
        let is_single = |line: &[u32; 2]| {
            let first = lines.partition_point(|other| other < line);
            lines.get(first + 1).is_none_or(|next| next != line)
        };
        let folded = |i: &&usize| !diagonals(i).iter().all(is_single);
        let folded = memory::collect(wholes.iter().filter(folded).copied())?;
        for i in folded {
            self.cells[i] = memory::copied(&Cell::WHOLE.children(Shape::Quad))?;
        }
        Ok(())
    }

    fn find_points(&mut self) -> Result<()> {
        let found = self.each(|i| {
            let shape = self.roots[i].shape;
            let mut points = memory::reserved(self.cells[i].len() * 4)?;
            self.each_cell(i, |_, cell| {
                points.extend(Cell::corners(shape).iter().map(|&at| cell.quarters(at)));
                Ok(())
            })?;
            points.sort_unstable();
            points.dedup();
            let border = points.iter().filter_map(|&point| self.shared(i, point));
            Ok((memory::collect(border)?, points))
        })?;
        self.points.clear();
        self.border.clear();
        memory::grow(&mut self.points, found.len())?;
        for (border, points) in found {
            memory::extend(&mut self.border, border)?;
            self.points.push(points);
        }
        self.border.sort_unstable();
        self.border.dedup();
        Ok(())
    }

    fn is_corner(&self, root: usize, point: Point) -> bool {
        match self.shared(root, point) {
            Some(shared) => self.border.binary_search(&shared).is_ok(),
            None => self.points[root].binary_search(&point).is_ok(),
        }
    }

    /// Whether other cells have a corner in the middle of each side of a cell.
    pub(super) fn cuts(&self, root: usize, cell: Cell) -> [bool; 4] {
        let corners = Cell::corners(self.roots[root].shape);
        let mut cuts = [false; 4];
        for (i, cut) in cuts.iter_mut().enumerate().take(corners.len()) {
            *cut = self.is_corner(root, cell.quarters(middle(corners, i)));
        }
        cuts
    }

    /// True if a half of a side is cut again.
    fn is_too_coarse(&self, root: usize, cell: Cell) -> bool {
        let corners = Cell::corners(self.roots[root].shape);
        let cuts = self.cuts(root, cell);
        (0..corners.len()).filter(|&i| cuts[i]).any(|i| {
            let [m, a, b] = [middle(corners, i), corners[i], corners[(i + 1) % corners.len()]];
            [a, b].iter().any(|end| {
                let half = [0, 1].map(|k| i32::midpoint(m[k], end[k]));
                self.is_corner(root, cell.quarters(half))
            })
        })
    }

    /// Splits cells until none is too coarse for those beside it.
    fn balance(&mut self) -> Result<()> {
        loop {
            let finer = self.each(|i| {
                let mut finer = Vec::new();
                self.each_cell(i, |_, cell| {
                    if self.is_too_coarse(i, cell) {
                        memory::extend(&mut finer, cell.children(self.roots[i].shape))
                    } else {
                        memory::extend(&mut finer, [cell])
                    }
                })?;
                Ok((finer.len() > self.cells[i].len()).then_some(finer))
            })?;
            let mut changed = false;
            for (cells, finer) in self.cells.iter_mut().zip(finer) {
                if let Some(finer) = finer {
                    *cells = finer;
                    changed = true;
                }
            }
            let count: usize = self.cells.iter().map(Vec::len).sum();
            self.context.check_memory(count as u64 * plan::CELL)?;
            if !changed {
                self.cells.iter_mut().for_each(|cells| cells.sort_unstable_by_key(|c| c.order()));
                return Ok(());
            }
            self.find_points()?;
        }
    }
}

/// The middle of a side.
pub(super) fn middle(corners: &[[i32; 2]], side: usize) -> [i32; 2] {
    let [a, b] = [corners[side], corners[(side + 1) % corners.len()]];
    [0, 1].map(|k| i32::midpoint(a[k], b[k]))
}
