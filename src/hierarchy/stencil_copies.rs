//! Tables whose rows are made once for each kind of face and copied for all others, run by
//! run; what lies in no such face is made one by one.

use super::stencil_patterns::Patterns;
use super::stencil_ring::Ring;
use super::stencil_runs::{Inside, Runs};
use super::stencil_sorts::Sorts;
use super::{Hierarchy, StencilTask};
use crate::base::{Context, NONE, Result, Scalar, memory};
use crate::mesh::Mesh;
use crate::scheme::Method;
use crate::sparse::{Columns, Filling, PlacedRows, StencilTable, assemble, filled};
use std::ops::Range;

/// Steps up to which patterns are few beside rows.
const DEEPEST: u32 = 6;

/// Kinds per thread between two looks at the memory that their rows take.
const AT_ONCE: usize = 64;

/// The part of the work that is done before rows are made, as far as progress tells.
const PREPARED: f64 = 0.2;

/// Where the rows of a task can be copied from.
pub(super) struct Copies<'a> {
    hierarchy: &'a Hierarchy,
    task: StencilTask<'a>,
    mesh: &'a Mesh,
    depth: u32,
    runs: Runs<'a>,
    sorts: Sorts,
}

/// A row that can be copied: which one of a face's own, and the face's sort.
#[derive(Clone, Copy)]
struct Own {
    face: u32,
    sort: usize,
    row: usize,
}

impl<'a> Copies<'a> {
    /// Nothing where no face's rows can be copied. Neither the decision nor the rows depend
    /// on which vertices are asked for. There are `rows` vertices in the last level.
    pub(super) fn new(
        context: &Context,
        hierarchy: &'a Hierarchy,
        task: &StencilTask<'a>,
        rows: u32,
    ) -> Result<Option<Self>> {
        let (mesh, scheme) = (hierarchy.mesh(task.from), hierarchy.scheme());
        let depth = task.to - task.from;
        if scheme.method() == Method::Dual || !scheme.passes().is_empty() || depth > DEEPEST {
            return Ok(None);
        }
        let sizes = (task.from..task.to).map(|level| hierarchy.mesh(level).vertices() as u32);
        let firsts = memory::collect(sizes.chain([rows]))?;
        let runs = Runs::new(mesh, scheme.pieces(), firsts)?;
        let sorts = Sorts::new(context, mesh, scheme, &runs, depth)?;
        let some = sorts.len() > 0;
        Ok(some.then_some(Self { hierarchy, task: *task, mesh, depth, runs, sorts }))
    }

    /// The table of the task.
    pub(super) fn table<T: Scalar>(&self, context: &Context) -> Result<StencilTable<T>> {
        let table = match self.task.vertices {
            Some(list) => self.some(context, list),
            None => self.all(context),
        }?;
        context.report(1.0)?;
        Ok(table)
    }

    /// The rows of some vertices.
    fn some<T: Scalar>(&self, context: &Context, list: &[u32]) -> Result<StencilTable<T>> {
        let own = memory::collect(list.iter().map(|&vertex| self.own(vertex)))?;
        let mut wanted = memory::filled(false, self.sorts.len())?;
        let mut rest = Vec::new();
        for (own, &vertex) in own.iter().zip(list) {
            match own {
                Some(own) => wanted[own.sort] = true,
                None => memory::extend(&mut rest, [vertex])?,
            }
        }
        rest.sort_unstable();
        rest.dedup();
        let patterns = self.patterns::<T>(context, &wanted)?;
        let others = self.others::<T>(context, &rest)?;
        assemble(
            context,
            list.len(),
            self.mesh.vertices(),
            || Ok(()),
            |(), at, out| {
                let Some(own) = own[at] else {
                    let place = rest.binary_search(&list[at]).unwrap_or_default();
                    return out.copy(others.row(place));
                };
                let (places, weights) = patterns[own.sort].row(own.row);
                let ring = self.sorts.ring(own.face);
                let columns = places.iter().map(|&place| ring[usize::from(place)]);
                out.row(columns, weights.iter().copied())
            },
        )
    }

    /// The place of a vertex, if its row can be copied.
    fn own(&self, vertex: u32) -> Option<Own> {
        match self.runs.find(vertex) {
            Inside::Old(v) => self.own_of_old(v),
            Inside::New { face, run, place } => {
                let sort = self.sorts.of(face)?;
                let row = self.sorts.slots(sort).run(run).start + place as usize;
                Some(Own { face, sort, row })
            }
        }
    }

    /// The same for a vertex that the mesh has: the face is that which its fan begins with.
    fn own_of_old(&self, vertex: u32) -> Option<Own> {
        let start = self.mesh.start[vertex as usize];
        if start == NONE {
            return None;
        }
        let face = self.mesh.layout.face_of(start);
        let row = (start - self.mesh.layout.face(face).start) as usize;
        Some(Own { face, sort: self.sorts.of(face)?, row })
    }

    /// The rows of all vertices: those that the mesh has, then run after run.
    fn all<T: Scalar>(&self, context: &Context) -> Result<StencilTable<T>> {
        let every = memory::filled(true, self.sorts.len())?;
        let patterns = self.patterns::<T>(context, &every)?;
        let parts = self.parts(context)?;
        let (mut rest, mut firsts) = (Vec::new(), memory::reserved(parts.len())?);
        for part in &parts {
            firsts.push(rest.len());
            self.irregular(part, &mut rest)?;
        }
        let others = self.others::<T>(context, &rest)?;
        let rows = Rows { copies: self, patterns, others };
        let numbered = memory::collect(parts.iter().zip(firsts.iter().copied()))?;
        let sizes = context.map(numbered, |(part, first)| rows.size(part, first))?;
        filled(context, self.mesh.vertices(), &sizes, |part, out: &mut Filling<T>| {
            rows.write(&parts[part], firsts[part], out);
        })
    }

    /// What a table is made of: the old vertices and all runs, cut for the threads.
    fn parts(&self, context: &Context) -> Result<Vec<Part>> {
        let mut parts = Vec::new();
        let old = context.chunks(self.mesh.vertices()).into_iter();
        let part = |range: Range<usize>| Part::Old(range.start as u32..range.end as u32);
        memory::extend(&mut parts, old.map(part))?;
        let faces = self.mesh.layout.faces();
        for run in 0..self.runs.count() {
            let rows = self.runs.vertices(0..faces, run).len();
            let each = faces.div_ceil(context.chunks(rows).len().max(1) as u32);
            let starts = (0..faces).step_by(each as usize);
            let part = |at: u32| Part::Run(run, at..faces.min(at + each));
            memory::extend(&mut parts, starts.map(part))?;
        }
        Ok(parts)
    }

    /// Adds the vertices of a part whose rows cannot be copied.
    fn irregular(&self, part: &Part, out: &mut Vec<u32>) -> Result<()> {
        match part {
            Part::Old(vertices) => {
                memory::extend(out, vertices.clone().filter(|&v| self.own_of_old(v).is_none()))
            }
            Part::Run(run, faces) => {
                let irregular = faces.clone().filter(|&face| self.sorts.of(face).is_none());
                let rows = irregular.flat_map(|face| self.runs.vertices(face..face + 1, *run));
                memory::extend(out, rows)
            }
        }
    }

    /// The rows of the sorts that are wanted, none of the others. They count against the ceiling.
    fn patterns<T: Scalar>(
        &self,
        context: &Context,
        wanted: &[bool],
    ) -> Result<Vec<PlacedRows<T>>> {
        let mut patterns = Patterns::new(self.hierarchy, &self.task)?;
        let (kinds, sorts) = self.sorts.kinds(wanted)?;
        for (done, &(face, _)) in kinds.iter().enumerate() {
            context.report(PREPARED * done as f64 / kinds.len() as f64)?;
            patterns.prepare(face, self.depth)?;
        }
        // What all sorts of a kind have in common is forgotten before the next kind.
        let of_kind = |(face, range): (u32, Range<usize>)| -> Result<Vec<PlacedRows<T>>> {
            let mut ring = Ring::default();
            ring.walk_once(self.mesh, face);
            let rows = patterns.rows::<T>(face, &ring, self.depth)?;
            let mut selected = memory::reserved(range.len())?;
            for &sort in &sorts[range] {
                selected.push(rows.select(&self.sorts.slots(sort as usize).slots)?);
            }
            Ok(selected)
        };
        let mut made = memory::reserved(wanted.len())?;
        made.extend(wanted.iter().map(|_| PlacedRows::none()));
        let (mut bytes, mut places) = (patterns.bytes(), sorts.iter());
        for some in kinds.chunks(AT_ONCE * context.threads()) {
            context.check_memory(bytes)?;
            for of_kind in context.map(memory::collect(some.iter().cloned())?, of_kind)? {
                for (rows, &sort) in of_kind?.into_iter().zip(&mut places) {
                    bytes += rows.bytes();
                    made[sort as usize] = rows;
                }
            }
        }
        context.report(PREPARED)?;
        Ok(made)
    }

    /// The rows of vertices, ascending, that are made one by one.
    fn others<T: Scalar>(&self, context: &Context, rest: &[u32]) -> Result<StencilTable<T>> {
        if rest.is_empty() {
            return StencilTable::new(self.mesh.vertices(), &[0], Vec::new(), Vec::new());
        }
        let task = StencilTask { vertices: Some(rest), ..self.task };
        self.hierarchy.rows_by_stages(context, &task)
    }
}

/// Rows that stand next to each other in a whole table.
enum Part {
    /// Of vertices that the mesh has.
    Old(Range<u32>),
    /// Of a run of some faces.
    Run(usize, Range<u32>),
}

/// The rows of a whole table.
struct Rows<'c, T> {
    copies: &'c Copies<'c>,
    /// The rows of every sort.
    patterns: Vec<PlacedRows<T>>,
    /// Those that were made one by one.
    others: StencilTable<T>,
}

impl<T: Scalar> Rows<'_, T> {
    /// The rows and entries of a part; `other` is where its rows begin among the others.
    fn size(&self, part: &Part, other: usize) -> (usize, usize) {
        let Copies { sorts, runs, .. } = self.copies;
        let (mut rest, mut entries) = (0, 0);
        let rows = match part {
            Part::Old(vertices) => {
                for vertex in vertices.clone() {
                    match self.copies.own_of_old(vertex) {
                        Some(own) => entries += self.patterns[own.sort].row(own.row).0.len(),
                        None => rest += 1,
                    }
                }
                vertices.len()
            }
            Part::Run(run, faces) => {
                for face in faces.clone() {
                    match sorts.of(face) {
                        Some(sort) => {
                            let rows = sorts.slots(sort).run(*run);
                            entries += self.patterns[sort].entries(rows).len();
                        }
                        None => rest += runs.vertices(face..face + 1, *run).len(),
                    }
                }
                runs.vertices(faces.clone(), *run).len()
            }
        };
        (rows, entries + self.others.entries_of(other..other + rest).len())
    }

    /// Writes a part.
    fn write(&self, part: &Part, mut other: usize, out: &mut Filling<T>) {
        let Copies { sorts, runs, .. } = self.copies;
        let mut others = |out: &mut Filling<T>, n: usize| {
            other += n;
            out.copy(&self.others, other - n..other);
        };
        match part {
            Part::Old(vertices) => {
                for vertex in vertices.clone() {
                    match self.copies.own_of_old(vertex) {
                        Some(Own { face, sort, row }) => {
                            out.place_one(&self.patterns[sort], row, sorts.ring(face));
                        }
                        None => others(out, 1),
                    }
                }
            }
            Part::Run(run, faces) => {
                let mut columns: Columns = [0; 256];
                for face in faces.clone() {
                    let Some(sort) = sorts.of(face) else {
                        others(out, runs.vertices(face..face + 1, *run).len());
                        continue;
                    };
                    let ring = sorts.ring(face);
                    columns[..ring.len()].copy_from_slice(ring);
                    out.place(&self.patterns[sort], sorts.slots(sort).run(*run), &columns);
                }
            }
        }
    }
}
