//! The stages of a stencil table: each made of the one before.

use super::stencil_rows::{Needs, StepRows, Wanted, face_row};
use super::stencils::StencilTask;
use super::step::Interpolation;
use crate::base::{Context, Error, ErrorKind, Result, Scalar};
use crate::refine::Split;
use crate::scheme::{PointSink, RowSink, Scheme};
use crate::sparse::{Accumulator, RowWriter, StencilTable, assemble};

/// Entries up to which a row of a pass is searched for an entry of the same vertex.
const SHORT: usize = 64;

/// What all stages have in common.
pub(super) struct Builder<'a> {
    context: &'a Context,
    scheme: &'a Scheme,
    interpolation: Interpolation,
    columns: usize,
    /// A bound on all weights.
    bound: f64,
}

impl<'a> Builder<'a> {
    pub(super) fn new(
        context: &'a Context,
        scheme: &'a Scheme,
        task: &StencilTask,
        columns: usize,
    ) -> Self {
        let bound = scheme.growth().powi((task.to - task.from) as i32);
        Self { context, scheme, interpolation: task.interpolation, columns, bound }
    }

    fn passes(&self) -> usize {
        if self.interpolation == Interpolation::Varying { 0 } else { self.scheme.passes().len() }
    }

    fn rows<'s>(&'s self, split: &'s Split<'s>) -> StepRows<'s> {
        StepRows::new(self.scheme, split, self.interpolation)
    }

    /// What every step must make so that some vertices of the last level, or all, get
    /// their rows.
    pub(super) fn needs(&self, splits: &[Split], last: Option<&[u32]>) -> Result<Vec<Needs>> {
        let Some(list) = last else {
            let all = |split| Needs::all(split, self.passes());
            return Ok(splits.iter().map(all).collect());
        };
        let mut needs = Vec::new();
        let mut marked = None;
        for split in splits.iter().rev() {
            let children = split.counts().vertices as usize;
            let wanted = match marked.take() {
                Some(marked) => Wanted::marked(marked)?,
                None => Wanted::new(children, list)?,
            };
            let (need, parents) = Needs::of(&mut self.rows(split), split, self.passes(), wanted)?;
            marked = Some(parents);
            needs.push(need);
        }
        needs.reverse();
        Ok(needs)
    }

    /// The rows of one more step: `table` has those of its parents that `inputs` lists.
    pub(super) fn step<T: Scalar>(
        &self,
        split: &Split,
        inputs: &Wanted,
        needs: &Needs,
        table: &StencilTable<f64>,
    ) -> Result<StencilTable<T>> {
        let Some(last) = self.passes().checked_sub(1) else {
            return self.split_stage(split, inputs, needs, table);
        };
        let mut stage = self.split_stage(split, inputs, needs, table)?;
        for pass in 0..last {
            stage = self.pass_stage(split, pass, needs, &stage, None)?;
        }
        self.pass_stage(split, last, needs, &stage, Some((inputs, table)))
    }

    fn split_stage<T: Scalar>(
        &self,
        split: &Split,
        inputs: &Wanted,
        needs: &Needs,
        table: &StencilTable<f64>,
    ) -> Result<StencilTable<T>> {
        let faces = self.face_rows(split, inputs, &needs.faces, table)?;
        let wanted = needs.stage(0);
        let state = || Ok((self.rows(split), Accumulator::new(self.columns)?));
        let watch = self.watches::<T>();
        assemble(
            self.context,
            wanted.len(),
            self.columns,
            state,
            |(rows, sum): &mut (_, Accumulator<T>), at, out| {
                let mut sink =
                    Points { sum: &mut *sum, table, inputs, faces: &faces, of_face: &needs.faces };
                rows.split_row(split, wanted.at(at), &mut sink);
                put(sum, watch, out)
            },
        )
    }

    /// The rows of the new vertices of faces, where a split speaks of them.
    fn face_rows(
        &self,
        split: &Split,
        inputs: &Wanted,
        faces: &Wanted,
        table: &StencilTable<f64>,
    ) -> Result<StencilTable<f64>> {
        let mesh = split.parent();
        let state = || Accumulator::new(self.columns);
        let watch = self.watches::<f64>();
        assemble(self.context, faces.len(), self.columns, state, |sum, at, out| {
            let face = faces.at(at) as usize;
            face_row(mesh, face, |v, weight| sum.add(table.row(inputs.place(v)), weight));
            put(sum, watch, out)
        })
    }

    /// The rows of a pass on those of the stage before; of the last pass with the rows of the
    /// parents, for vertices that ask for these instead.
    fn pass_stage<T: Scalar>(
        &self,
        split: &Split,
        pass: usize,
        needs: &Needs,
        table: &StencilTable<f64>,
        parents: Option<(&Wanted, &StencilTable<f64>)>,
    ) -> Result<StencilTable<T>> {
        let (before, wanted) = (needs.stage(pass), needs.stage(pass + 1));
        let state = || Ok((self.rows(split), Merged::default(), Accumulator::new(self.columns)?));
        let watch = self.watches::<T>();
        assemble(
            self.context,
            wanted.len(),
            self.columns,
            state,
            |(rows, merged, sum): &mut (_, Merged, Accumulator<T>), at, out| {
                let vertex = wanted.at(at);
                if let Some((inputs, table)) = parents {
                    let mut add = |v, weight| sum.add(table.row(inputs.place(v)), weight);
                    if rows.tuned_row(vertex, &mut add) {
                        return put(sum, watch, out);
                    }
                }
                merged.0.clear();
                rows.pass_row(pass, vertex, merged);
                for &(v, weight) in &merged.0 {
                    sum.add(table.row(before.place(v)), weight);
                }
                put(sum, watch, out)
            },
        )
    }

    /// True if weights may leave the range of their number type.
    fn watches<T: Scalar>(&self) -> bool {
        !T::from_f64(self.bound).is_finite()
    }
}

/// Hands a finished row over.
fn put<T: Scalar>(sum: &mut Accumulator<T>, watch: bool, out: &mut RowWriter<T>) -> Result<()> {
    let row = sum.take()?;
    if watch && !row.1.iter().all(|w| w.is_finite()) {
        let message = "a weight leaves the range of the number type";
        return Err(Error::new(ErrorKind::Overflow, message));
    }
    out.copy(row)
}

/// Adds multiples of rows that are there already.
struct Points<'s, 't, T> {
    sum: &'s mut Accumulator<'t, T>,
    table: &'t StencilTable<f64>,
    inputs: &'t Wanted,
    faces: &'t StencilTable<f64>,
    of_face: &'t Wanted,
}

impl<T: Scalar> PointSink<f64> for Points<'_, '_, T> {
    #[inline]
    fn vertex(&mut self, vertex: u32, weight: f64) {
        self.sum.add(self.table.row(self.inputs.place(vertex)), weight);
    }

    #[inline]
    fn face(&mut self, face: u32, weight: f64) {
        self.sum.add(self.faces.row(self.of_face.place(face)), weight);
    }
}

/// A row of a pass, in which most vertices come several times.
#[derive(Default)]
struct Merged(Vec<(u32, f64)>);

impl RowSink<f64> for Merged {
    fn add(&mut self, vertex: u32, weight: f64) {
        let known = if self.0.len() < SHORT { &mut self.0[..] } else { &mut [] };
        match known.iter_mut().find(|entry| entry.0 == vertex) {
            Some(entry) => entry.1 += weight,
            None => self.0.push((vertex, weight)),
        }
    }
}
