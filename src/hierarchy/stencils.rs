//! Stencil tables from a scheme's rows.
//!
//! A row of level n is a sum of rows of level n − 1, which are known when it is made: each
//! entry that the scheme sends adds a multiple of such a row, and no table of the step alone
//! is ever stored. Where only some vertices are wanted, what they need is found first, from
//! the last level back, and only those rows are made.

use super::Hierarchy;
use super::stencil_build::Builder;
use super::stencil_copies::Copies;
use super::stencil_rows::Wanted;
use super::step::Interpolation;
use crate::base::{Context, Element, Error, ErrorKind, Result, Scalar, memory};
use crate::refine::{EdgeNumbers, PrimalSplit, Split};
use crate::scheme::Method;
use crate::sparse::StencilTable;

/// Which stencil table to make of a [`Hierarchy`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct StencilTask<'a> {
    /// The level that columns belong to; 0 is the control mesh.
    pub from: u32,
    /// The level that rows belong to: at least `from`, at most one beyond the last level
    /// of the hierarchy, since rows need no more than the mesh before.
    pub to: u32,
    /// By which rows.
    pub interpolation: Interpolation,
    /// The vertices of level `to` that get a row, in the order of the rows; all if absent.
    pub vertices: Option<&'a [u32]>,
}

impl StencilTask<'_> {
    /// All vertices of a level on the control vertices.
    pub fn level(level: u32) -> Self {
        Self { from: 0, to: level, interpolation: Interpolation::Vertex, vertices: None }
    }

    /// The last of the steps that lead to a level, alone; nothing for level 0.
    pub fn step(level: u32) -> Self {
        Self { from: level.saturating_sub(1), ..Self::level(level) }
    }
}

impl Hierarchy {
    /// The stencil table of a task. Weights are computed in double precision and rounded
    /// once; rows depend neither on the number of threads nor on which others are asked for.
    /// Their entries come in no order to rely on.
    ///
    /// The time is that of the last level. Under Catmull–Clark, Loop and bilinear refinement
    /// over up to six levels rows inside faces that are alike are computed once and copied:
    /// faces of up to 16 sides, vertices of up to 32 faces, away from boundaries and sharp
    /// features. Their weights are sums in another order than elsewhere, a few units in the
    /// last place apart. Each other row is a sum of four to nine rows of the level before.
    ///
    /// # Errors
    /// [`ErrorKind::ParameterOutOfRange`] for levels that were not built or are turned
    /// round, [`ErrorKind::IndexOutOfRange`] for a vertex,
    /// [`ErrorKind::Unsupported`] for varying values under a dual scheme,
    /// [`ErrorKind::TooLarge`] for 2³² − 1 weights and more,
    /// [`ErrorKind::Overflow`], [`ErrorKind::MemoryCeiling`],
    /// [`ErrorKind::OutOfResources`], [`ErrorKind::Cancelled`].
    pub fn stencils<T: Scalar>(
        &self,
        context: &Context,
        task: &StencilTask,
    ) -> Result<StencilTable<T>> {
        self.scheme().check_interpolation(task.interpolation)?;
        self.check_task(task)?;
        context.report(0.0)?;
        let columns = self.mesh(task.from).vertices();
        let Some(before) = (task.from < task.to).then(|| task.to - 1) else {
            check_vertices(task.vertices, columns)?;
            let table = StencilTable::identity(columns)?;
            return match task.vertices {
                Some(list) => table.select(context, list),
                None => Ok(table),
            };
        };
        let rows = self.vertices_after(context, before)?;
        check_vertices(task.vertices, rows as usize)?;
        if let Some(copies) = Copies::new(context, self, task, rows)? {
            return copies.table(context);
        }
        self.rows_by_stages(context, task)
    }

    /// The vertices of the level after one that was built.
    fn vertices_after(&self, context: &Context, level: u32) -> Result<u32> {
        let (scheme, mesh) = (self.scheme(), self.mesh(level));
        if scheme.method() == Method::Dual {
            let split = self.split(context, level, &mut EdgeNumbers::default())?;
            return Ok(split.counts().vertices as u32);
        }
        scheme.check(mesh)?;
        Ok(PrimalSplit::by_corners(mesh, scheme.pieces())?.counts.vertices as u32)
    }

    /// All rows of a task, each stage made of the one before; there is a step.
    pub(super) fn rows_by_stages<T: Scalar>(
        &self,
        context: &Context,
        task: &StencilTask,
    ) -> Result<StencilTable<T>> {
        let splits: Vec<Split> = (task.from..task.to)
            .map(|level| self.split(context, level, &mut EdgeNumbers::default()))
            .collect::<Result<_>>()?;
        let columns = self.mesh(task.from).vertices();
        let (last, before) = splits.split_last().ok_or_else(|| {
            Error::new(ErrorKind::BrokenInvariant, "rows are asked for without a step")
        })?;
        let rows = last.counts().vertices as usize;
        let builder = Builder::new(context, self.scheme(), task, columns);
        let needs = builder.needs(&splits, task.vertices)?;
        let all = Wanted::All(columns);
        let mut table = StencilTable::identity(columns)?;
        let mut inputs = &all;
        for (split, need) in before.iter().zip(&needs) {
            table = builder.step(split, inputs, need, &table)?;
            inputs = need.last();
            context.report(split.counts().vertices as f64 / rows.max(1) as f64)?;
        }
        let table = builder.step(last, inputs, &needs[before.len()], &table)?;
        context.report(1.0)?;
        match task.vertices {
            // Rows were made in ascending order, each once.
            Some(list) if !list.is_sorted_by(|a, b| a < b) => {
                let made = Wanted::new(rows, list)?;
                let places = list.iter().map(|&v| made.place(v) as u32);
                table.select(context, &memory::collect(places)?)
            }
            _ => Ok(table),
        }
    }

    fn check_task(&self, task: &StencilTask) -> Result<()> {
        let last = self.last_level() + 1;
        if task.from <= task.to && task.to <= last && task.from < last {
            return Ok(());
        }
        let message = format!(
            "stencils from level {} to level {}: levels 0 to {last} can be had, ascending",
            task.from, task.to
        );
        Err(Error::new(ErrorKind::ParameterOutOfRange, message))
    }
}

/// Refuses a list that names a vertex which does not exist.
fn check_vertices(list: Option<&[u32]>, vertices: usize) -> Result<()> {
    let strange = list.into_iter().flatten().find(|&&v| v as usize >= vertices);
    strange.map_or(Ok(()), |&v| {
        let message = format!("vertex {v} of {vertices} is asked for");
        let element = Element::Vertex(v.into());
        Err(Error::new(ErrorKind::IndexOutOfRange, message).with_elements([element]))
    })
}
