//! Stencil tables from a scheme's rows.
//!
//! A row of level n is a sum of rows of level n − 1, which are known when it is made: each
//! entry that the scheme sends adds a multiple of such a row, and no table of the step alone
//! is ever stored. Where only some vertices are wanted, what they need is found first, from
//! the last level back, and only those rows are made.

use super::Hierarchy;
use super::stencil_build::Builder;
use super::stencil_regular::Regular;
use super::stencil_rows::Wanted;
use super::step::Interpolation;
use crate::base::{Context, Element, Error, ErrorKind, Result, Scalar, memory};
use crate::refine::{EdgeNumbers, Split};
use crate::sparse::{StencilTable, assemble};

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
    /// once; rows do not depend on the number of threads.
    ///
    /// The time is that of the last level: for each row a sum of four to nine others.
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
        let split = self.split(context, before, &mut EdgeNumbers::default())?;
        let rows = split.counts().vertices as usize;
        check_vertices(task.vertices, rows)?;
        if let Split::Primal(split) = &split
            && let Some(regular) = Regular::new(context, self, task, split)?
        {
            return self.rows_by_patterns(context, task, &regular, rows);
        }
        drop(split);
        self.rows_by_stages(context, task)
    }

    /// Rows copied where the mesh is regular; the others stage by stage.
    fn rows_by_patterns<T: Scalar>(
        &self,
        context: &Context,
        task: &StencilTask,
        regular: &Regular,
        rows: usize,
    ) -> Result<StencilTable<T>> {
        let irregular = |v: &u32| regular.find(*v).is_none();
        let mut rest = match task.vertices {
            Some(list) => memory::collect(list.iter().copied().filter(irregular))?,
            None => memory::collect((0..rows as u32).filter(irregular))?,
        };
        rest.sort_unstable();
        rest.dedup();
        let columns = self.mesh(task.from).vertices();
        let others: StencilTable<T> = if rest.is_empty() {
            StencilTable::new(columns, &[0], Vec::new(), Vec::new())?
        } else {
            self.rows_by_stages(context, &StencilTask { vertices: Some(&rest), ..*task })?
        };
        let count = task.vertices.map_or(rows, <[u32]>::len);
        let table = assemble(
            context,
            count,
            columns,
            || Ok(()),
            |(), at, out| {
                let vertex = task.vertices.map_or(at as u32, |list| list[at]);
                if let Some(found) = regular.find(vertex) {
                    let (columns, weights) = regular.row(found);
                    return out.row(columns, weights);
                }
                // It was not found before either.
                let place = rest.binary_search(&vertex).unwrap_or_default();
                out.copy(others.row(place))
            },
        )?;
        context.report(1.0)?;
        Ok(table)
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
