//! One-shot refinement: the faces and values of level n, and nothing else.
//!
//! A [`Refiner`] keeps its scratch memory, so that refining the same mesh again
//! touches hardly a fresh page. For several levels at once, or for new positions on
//! the same topology, see [`super::Hierarchy`].

use super::channels::{ChannelOutput, ChannelRun, FaceVarying, RefinedChannel};
use super::columns::{Column, Place};
use super::patch_step::PatchStep;
use super::predict::Prediction;
use super::step::{Interpolation, Step};
use super::tile_step::TileStep;
use super::values::{check, check_length, check_overflow, lanes};
use crate::base::memory::{resize, zeroed};
use crate::base::{Context, Error, ErrorKind, Result, Scalar};
use crate::mesh::Mesh;
use crate::refine::adjacency::Recycled;
use crate::refine::{Counts, EdgeNumbers, Patches, Split, Tiles};
use crate::scheme::{Scheme, SmoothMasks, SplitKind};

/// Values on vertices, any number of them per vertex.
#[derive(Debug, Clone, Copy)]
pub struct Attribute<'a, T> {
    /// One record per vertex, one after the other.
    pub values: &'a [T],
    /// Values per record, at least 1.
    pub width: usize,
    /// By which rows.
    pub interpolation: Interpolation,
}

impl<'a, T> Attribute<'a, T> {
    /// Values that are refined by the scheme's own rows, as positions are.
    pub fn vertex(values: &'a [T], width: usize) -> Self {
        Self { values, width, interpolation: Interpolation::Vertex }
    }

    /// Values that are refined linearly.
    pub fn varying(values: &'a [T], width: usize) -> Self {
        Self { values, width, interpolation: Interpolation::Varying }
    }
}

/// What to refine, how, and how far.
#[derive(Debug, Clone, Copy)]
pub struct Task<'a, T> {
    /// The control mesh.
    pub mesh: &'a Mesh,
    /// The scheme.
    pub scheme: &'a Scheme,
    /// The number of steps; 0 copies the input.
    pub levels: u32,
    /// xyz of every vertex, 3 values each.
    pub positions: &'a [T],
    /// Further values, refined by the same rows.
    pub attributes: &'a [Attribute<'a, T>],
    /// Values at the corners of faces, with seams; for Catmull–Clark, Loop and bilinear
    /// refinement.
    pub channels: &'a [FaceVarying<'a, T>],
    /// Also report the control face that each refined face descends from.
    pub face_sources: bool,
}

/// Where the result goes; sizes by [`Prediction::last`].
#[derive(Debug)]
pub struct Output<'a, T> {
    /// The size of every face, if wanted. From level 1 on all are triangles after
    /// triangle splits, and all but the first `irregular_faces` are quads after others.
    pub face_sizes: Option<&'a mut [u32]>,
    /// The concatenated vertices of all faces, if wanted.
    pub face_vertices: Option<&'a mut [u32]>,
    /// The control face (in the mesh's order) that each face descends from.
    pub face_sources: Option<&'a mut [u32]>,
    /// xyz of every vertex.
    pub positions: &'a mut [T],
    /// One array per attribute of the task.
    pub attributes: Vec<&'a mut [T]>,
    /// One pair of arrays per face-varying channel of the task.
    pub channels: Vec<ChannelOutput<'a, T>>,
}

/// A refined mesh as arrays.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Refined<T> {
    /// The size of every face.
    pub face_sizes: Vec<u32>,
    /// The concatenated vertices of all faces.
    pub face_vertices: Vec<u32>,
    /// The control face (in the mesh's order) that each face descends from;
    /// empty unless asked for.
    pub face_sources: Vec<u32>,
    /// xyz of every vertex.
    pub positions: Vec<T>,
    /// One array per attribute of the task.
    pub attributes: Vec<Vec<T>>,
    /// Indices and values of each face-varying channel of the task.
    pub channels: Vec<RefinedChannel<T>>,
    /// A further step must treat the mesh as anchored.
    pub anchored: bool,
}

/// Refines meshes, keeping scratch memory from call to call.
#[derive(Debug)]
pub struct Refiner<T> {
    levels: Vec<Recycled>,
    columns: Vec<Column<T>>,
    face_sources: Vec<Vec<u32>>,
    /// Numbers of the edges of the level in work.
    edges: EdgeNumbers,
}

impl<T: Scalar> Default for Refiner<T> {
    fn default() -> Self {
        Self::new()
    }
}

impl<T: Scalar> Refiner<T> {
    /// A refiner without memory yet.
    pub fn new() -> Self {
        let (levels, columns) = (Vec::new(), Vec::new());
        Self { levels, columns, face_sources: Vec::new(), edges: EdgeNumbers::default() }
    }

    /// Bytes of scratch memory held.
    pub fn bytes(&self) -> u64 {
        let columns: u64 = self.columns.iter().map(Column::bytes).sum();
        let sources: usize = self.face_sources.iter().map(Vec::capacity).sum();
        let sources = self.edges.bytes() + 4 * sources as u64;
        self.levels.iter().map(Recycled::bytes).sum::<u64>() + columns + sources
    }

    /// Refines into arrays of its own.
    ///
    /// # Errors
    /// As [`Refiner::refine_into`].
    pub fn refine(&mut self, context: &Context, task: &Task<T>) -> Result<Refined<T>> {
        let plan = task.plan(context, true)?;
        let last = plan.last();
        let mut refined = Refined {
            face_sizes: zeroed(last.faces as usize)?,
            face_vertices: zeroed(last.corners as usize)?,
            face_sources: zeroed(if task.face_sources { last.faces as usize } else { 0 })?,
            positions: zeroed(last.vertices as usize * 3)?,
            attributes: Vec::new(),
            channels: Vec::new(),
            anchored: task.anchored(),
        };
        for attribute in task.attributes {
            let len = last.vertices as usize * attribute.width;
            refined.attributes.push(zeroed(len)?);
        }
        for data in task.channels {
            let plan = data.plan(task.mesh, task.scheme, task.levels)?;
            let indices = zeroed(plan.last().corners as usize)?;
            let values = zeroed(plan.last().vertices as usize * data.width)?;
            refined.channels.push(RefinedChannel { indices, values });
        }
        let output = Output {
            face_sizes: Some(&mut refined.face_sizes),
            face_vertices: Some(&mut refined.face_vertices),
            face_sources: task.face_sources.then_some(&mut refined.face_sources[..]),
            positions: &mut refined.positions,
            attributes: refined.attributes.iter_mut().map(Vec::as_mut_slice).collect(),
            channels: refined.channels.iter_mut().map(RefinedChannel::output).collect(),
        };
        self.run(context, task, &plan, output)?;
        Ok(refined)
    }

    /// Refines into the caller's arrays. On an error their content is undefined.
    ///
    /// The result does not depend on threads, and n steps at once give the same
    /// bytes as one step n times on the meshes of a [`super::Hierarchy`]. A mesh
    /// built anew from the faces of a level gives the same surface, numbered
    /// otherwise.
    ///
    /// # Errors
    /// [`ErrorKind::LengthMismatch`] for a slice of another length than
    /// [`Prediction::last`] says, [`ErrorKind::NotFinite`] and
    /// [`ErrorKind::Overflow`] for values, [`ErrorKind::TooLarge`],
    /// [`ErrorKind::MemoryCeiling`] and [`ErrorKind::OutOfResources`] for sizes,
    /// all checked before work starts but for overflow, and
    /// [`ErrorKind::Cancelled`].
    pub fn refine_into(
        &mut self,
        context: &Context,
        task: &Task<T>,
        output: Output<T>,
    ) -> Result<()> {
        let plan = task.plan(context, false)?;
        self.run(context, task, &plan, output)
    }

    /// Refines with sizes and limits checked already.
    ///
    /// # Errors
    /// As [`Refiner::refine_into`].
    pub(crate) fn run(
        &mut self,
        context: &Context,
        task: &Task<T>,
        plan: &Prediction,
        output: Output<T>,
    ) -> Result<()> {
        output.check(task, plan)?;
        context.report(0.0)?;
        let largest = task.check_values(context)?;
        if task.levels == 0 {
            copy(task, output);
            return Ok(());
        }
        // Where no value can come near the limits, nothing is checked again. Means may add up
        // all of a face's or a vertex's neighbours before they divide.
        let growth = task.scheme.growth().powi(task.levels.min(1 << 20) as i32);
        let bound = largest * growth * task.mesh.vertices().max(6) as f64;
        let watch = !T::from_f64(bound).is_finite();
        self.levels.resize_with(task.levels as usize, Recycled::default);
        Run { context, task, plan, watch }.levels(self, output)
    }
}

impl<'a, T> Output<'a, T> {
    /// An output for positions alone; set the other fields for more.
    pub fn new(positions: &'a mut [T]) -> Self {
        Self {
            face_sizes: None,
            face_vertices: None,
            face_sources: None,
            positions,
            attributes: Vec::new(),
            channels: Vec::new(),
        }
    }
}

impl<'a, T> Task<'a, T> {
    /// A task for positions alone; set the other fields for more.
    pub fn new(mesh: &'a Mesh, scheme: &'a Scheme, levels: u32, positions: &'a [T]) -> Self {
        Self {
            mesh,
            scheme,
            levels,
            positions,
            attributes: &[],
            channels: &[],
            face_sources: false,
        }
    }
}

impl<T: Scalar> Task<'_, T> {
    /// Predicts the sizes and checks them against the limits.
    fn plan(&self, context: &Context, with_output: bool) -> Result<Prediction> {
        let vertices = self.mesh.vertices();
        check_length("positions", self.positions.len(), 3, vertices)?;
        for (i, a) in self.attributes.iter().enumerate() {
            check_length(&format!("attribute {i}"), a.values.len(), a.width, vertices)?;
        }
        for attribute in self.attributes {
            self.scheme.check_interpolation(attribute.interpolation)?;
        }
        let mut plan = Prediction::new(self.mesh, self.scheme, self.levels)?;
        plan.check_index_type()?;
        if !self.channels.is_empty() {
            plan = plan.level_by_level();
        }
        let mut channels = 0_u64;
        for data in self.channels {
            let plan = data.plan(self.mesh, self.scheme, self.levels)?;
            let width = data.width as u64;
            let output = if with_output { plan.output_bytes(width, T::BYTES) } else { 0 };
            let bytes = data.scratch_bytes(&plan).saturating_add(output);
            channels = channels.saturating_add(bytes);
        }
        let widths = self.attributes.iter().map(|a| a.width as u64);
        let width = widths.fold(3, u64::saturating_add);
        let output = if with_output { plan.output_bytes(width, T::BYTES) } else { 0 };
        let scratch = plan.refiner_bytes(width, T::BYTES, self.face_sources);
        context.check_memory(scratch.saturating_add(output).saturating_add(channels))?;
        Ok(plan)
    }

    /// Checks all inputs; returns the largest magnitude.
    fn check_values(&self, context: &Context) -> Result<f64> {
        let vertices = self.mesh.vertices();
        let mut largest = check(context, "positions", self.positions, 3, vertices)?;
        for (i, attribute) in self.attributes.iter().enumerate() {
            let name = format!("attribute {i}");
            let values = attribute.values;
            largest = largest.max(check(context, &name, values, attribute.width, vertices)?);
        }
        for data in self.channels {
            largest = largest.max(data.check_values(context)?);
        }
        Ok(largest)
    }

    /// True if the result is anchored.
    pub(crate) fn anchored(&self) -> bool {
        if self.levels == 0 { self.mesh.is_anchored() } else { self.scheme.anchors() }
    }
}

impl<T: Scalar> Output<'_, T> {
    fn check(&self, task: &Task<T>, plan: &Prediction) -> Result<()> {
        let last = plan.last();
        let length = |what: &str, len: usize, expected: u64| {
            if len as u64 == expected {
                return Ok(());
            }
            Err(Error::new(
                ErrorKind::LengthMismatch,
                format!("{what}: the output has {len} entries, {expected} are needed"),
            ))
        };
        if let Some(sizes) = &self.face_sizes {
            length("face sizes", sizes.len(), last.faces)?;
        }
        if let Some(sources) = &self.face_sources {
            length("face sources", sources.len(), last.faces)?;
        }
        if self.face_sources.is_some() != task.face_sources {
            return Err(Error::new(
                ErrorKind::LengthMismatch,
                "face sources must be asked for by the task and by the output alike",
            ));
        }
        if let Some(vertices) = &self.face_vertices {
            length("face vertices", vertices.len(), last.corners)?;
        }
        length("positions", self.positions.len(), 3 * last.vertices)?;
        length("attributes", self.attributes.len(), task.attributes.len() as u64)?;
        for (out, attribute) in self.attributes.iter().zip(task.attributes) {
            let len = last.vertices.saturating_mul(attribute.width as u64);
            length("attribute", out.len(), len)?;
        }
        length("channels", self.channels.len(), task.channels.len() as u64)?;
        for (out, data) in self.channels.iter().zip(task.channels) {
            out.check(&data.plan(task.mesh, task.scheme, task.levels)?, data.width)?;
        }
        Ok(())
    }
}

/// Level 0: the control mesh itself.
fn copy<T: Scalar>(task: &Task<T>, output: Output<T>) {
    let mesh = task.mesh;
    if let Some(sizes) = output.face_sizes {
        for (slot, size) in sizes.iter_mut().zip(mesh.face_sizes()) {
            *slot = size;
        }
    }
    if let Some(sources) = output.face_sources {
        for (slot, face) in sources.iter_mut().zip(0..) {
            *slot = face;
        }
    }
    if let Some(vertices) = output.face_vertices {
        vertices.copy_from_slice(mesh.corner_vertices());
    }
    output.positions.copy_from_slice(task.positions);
    for (out, attribute) in output.attributes.into_iter().zip(task.attributes) {
        out.copy_from_slice(attribute.values);
    }
    for (mut out, data) in output.channels.into_iter().zip(task.channels) {
        data.copy(&mut out);
    }
}

/// One step, for values by the scheme's rows and for varying ones.
struct Steps<'s> {
    vertex: Step<'s>,
    varying: Option<Step<'s>>,
}

impl<'s> Steps<'s> {
    fn of(&self, interpolation: Interpolation) -> &Step<'s> {
        match (interpolation, &self.varying) {
            (Interpolation::Varying, Some(step)) => step,
            _ => &self.vertex,
        }
    }
}

/// Several levels at once.
#[expect(clippy::large_enum_variant, reason = "a call has one, on its stack")]
enum Blocks<'m> {
    Patches(Patches<'m>),
    Tiles(Tiles<'m>),
}

impl<'m> Blocks<'m> {
    fn new(context: &Context, mesh: &'m Mesh, scheme: &Scheme, depth: u32) -> Result<Self> {
        if scheme.split() == SplitKind::Corner {
            return Ok(Self::Tiles(Tiles::new(context, mesh, depth)?));
        }
        let linear = SmoothMasks::<f64>::new(scheme).is_linear();
        Ok(Self::Patches(Patches::new(context, mesh, (scheme.pieces(), depth), linear)?))
    }

    fn write_sizes(&self, out: &mut [u32]) {
        match self {
            Self::Patches(patches) => patches.write_sizes(out),
            Self::Tiles(tiles) => tiles.write_sizes(out),
        }
    }

    fn write_faces(&self, context: &Context, out: &mut [u32]) -> Result<()> {
        match self {
            Self::Patches(patches) => patches.write_faces(context, out),
            Self::Tiles(tiles) => tiles.write_faces(context, out),
        }
    }

    fn each_face_source(&self, each: impl FnMut(usize, u32)) {
        match self {
            Self::Patches(patches) => patches.each_face_source(each),
            Self::Tiles(tiles) => tiles.each_face_source(each),
        }
    }

    /// The steps for the scheme's own values and, if asked for, for varying ones.
    fn steps<'s>(&'s self, scheme: &'s Scheme, varying: bool) -> Steps<'s> {
        match self {
            Self::Patches(patches) => {
                let step = |masks| Step::patches(PatchStep::new(patches, masks));
                let varying = varying.then(|| step(SmoothMasks::linear()));
                Steps { vertex: step(SmoothMasks::new(scheme)), varying }
            }
            Self::Tiles(tiles) => {
                Steps { vertex: Step::tiles(TileStep::new(scheme, tiles)), varying: None }
            }
        }
    }
}

/// A call in progress.
struct Run<'r, T> {
    context: &'r Context,
    task: &'r Task<'r, T>,
    plan: &'r Prediction,
    /// Values may overflow: look at every level.
    watch: bool,
}

impl<T: Scalar> Run<'_, T> {
    fn levels(&self, refiner: &mut Refiner<T>, output: Output<T>) -> Result<()> {
        let places = self.places(&mut refiner.columns);
        let channels = self.task.channels.iter();
        let channels = channels.map(|data| ChannelRun::new(self.task.scheme, self.task.mesh, data));
        let mut channels = channels.collect::<Result<Vec<_>>>()?;
        let mut owned: Option<Mesh> = None;
        let levels = self.task.levels as usize;
        let last = levels - (self.plan.patch_depth() as usize).max(1);
        for level in 0..last {
            let parent = owned.as_ref().unwrap_or(self.task.mesh);
            let split = self.task.scheme.plan(self.context, parent, &mut refiner.edges)?;
            let steps = self.steps(&split)?;
            for (column, &place) in refiner.columns.iter_mut().zip(&places) {
                let step = steps.of(self.interpolation(place));
                let values = column.step(self.context, step, level, place, self.input(place))?;
                self.check(values, level + 1)?;
            }
            drop(steps);
            for (channel, shape) in channels.iter_mut().zip(split.primal()) {
                channel.step(self.context, shape, level, self.watch)?;
            }
            self.inherit(&mut refiner.face_sources, &split, level, None)?;
            // Holes follow from the control faces, which the caller knows.
            let carried = self.task.scheme.carried(&[]);
            let child = split.mesh(self.context, carried, &mut refiner.levels[level])?;
            split.recycle(&mut refiner.edges);
            if let Some(mesh) = owned.replace(child) {
                refiner.levels[level - 1].absorb(mesh);
            }
            self.progress(level + 1, 0.0)?;
        }
        let parent = owned.as_ref().unwrap_or(self.task.mesh);
        if last + 1 == levels {
            self.last_level(refiner, parent, &places, &mut channels, output)?;
        } else {
            self.last_levels(refiner, parent, &places, last, output)?;
        }
        if let Some(mesh) = owned {
            refiner.levels[last - 1].absorb(mesh);
        }
        self.progress(levels, 0.0)
    }

    /// Faces and values only, straight into the output.
    fn last_level(
        &self,
        refiner: &mut Refiner<T>,
        parent: &Mesh,
        places: &[Place],
        channels: &mut [ChannelRun<T>],
        mut output: Output<T>,
    ) -> Result<()> {
        let level = self.task.levels as usize - 1;
        let split = self.task.scheme.plan(self.context, parent, &mut refiner.edges)?;
        if let Some(sizes) = &mut output.face_sizes {
            split.write_sizes(sizes);
        }
        if let Some(vertices) = output.face_vertices.take() {
            split.write_faces(self.context, vertices)?;
        }
        self.inherit(&mut refiner.face_sources, &split, level, output.face_sources.take())?;
        self.finish(refiner, places, level, &self.steps(&split)?, &mut output)?;
        for ((channel, out), shape) in
            channels.iter_mut().zip(&mut output.channels).zip(split.primal())
        {
            channel.finish(self.context, shape, level, self.watch, out)?;
        }
        split.recycle(&mut refiner.edges);
        Ok(())
    }

    /// The same for all levels from one on, in one step.
    fn last_levels(
        &self,
        refiner: &mut Refiner<T>,
        parent: &Mesh,
        places: &[Place],
        level: usize,
        mut output: Output<T>,
    ) -> Result<()> {
        let (scheme, depth) = (self.task.scheme, self.plan.patch_depth());
        let blocks = Blocks::new(self.context, parent, scheme, depth)?;
        if let Some(sizes) = &mut output.face_sizes {
            blocks.write_sizes(sizes);
        }
        if let Some(vertices) = output.face_vertices.take() {
            blocks.write_faces(self.context, vertices)?;
        }
        if let Some(sources) = output.face_sources.take() {
            let kept = &refiner.face_sources;
            blocks.each_face_source(|child, face| {
                sources[child] = if level == 0 { face } else { kept[level][face as usize] };
            });
        }
        let steps = blocks.steps(scheme, self.varies());
        self.finish(refiner, places, level, &steps, &mut output)
    }

    /// The values of the last level, from those of the level that the steps start from.
    fn finish(
        &self,
        refiner: &mut Refiner<T>,
        places: &[Place],
        level: usize,
        steps: &Steps,
        output: &mut Output<T>,
    ) -> Result<()> {
        let parts = places.len() as f64 + 1.0;
        for (done, (column, &place)) in refiner.columns.iter_mut().zip(places).enumerate() {
            self.progress(level, (done as f64 + 1.0) / parts)?;
            let out = match place.attribute.checked_sub(1) {
                None => &mut *output.positions,
                Some(i) => &mut *output.attributes[i],
            };
            let step = steps.of(self.interpolation(place));
            column.finish(self.context, step, level, place, self.input(place), out)?;
            // Not before all lanes are there: what a buffer held does not count.
            if place.first + column.lanes() == place.width {
                self.check(out, self.task.levels as usize)?;
            }
        }
        Ok(())
    }

    /// The steps for all kinds of values.
    fn steps<'s>(&'s self, split: &'s Split<'s>) -> Result<Steps<'s>> {
        let step = |interpolation| Step::new(self.task.scheme, split, interpolation);
        Ok(Steps {
            vertex: step(Interpolation::Vertex)?,
            varying: if self.varies() { Some(step(Interpolation::Varying)?) } else { None },
        })
    }

    /// True if some values are refined linearly.
    fn varies(&self) -> bool {
        self.task.attributes.iter().any(|a| a.interpolation == Interpolation::Varying)
    }

    fn interpolation(&self, place: Place) -> Interpolation {
        let attribute = place.attribute.checked_sub(1);
        attribute.map_or(Interpolation::Vertex, |i| self.task.attributes[i].interpolation)
    }

    /// The columns of all values; those of the last call are used again.
    fn places(&self, columns: &mut Vec<Column<T>>) -> Vec<Place> {
        let widths = std::iter::once(3).chain(self.task.attributes.iter().map(|a| a.width));
        let mut places = Vec::new();
        for (attribute, width) in widths.enumerate() {
            for (first, lanes) in lanes(width) {
                match columns.get(places.len()) {
                    Some(column) if column.lanes() == lanes => {}
                    _ => {
                        columns.truncate(places.len());
                        columns.push(Column::new(lanes));
                    }
                }
                places.push(Place { attribute, width, first });
            }
        }
        columns.truncate(places.len());
        places
    }

    fn input(&self, place: Place) -> &[T] {
        match place.attribute.checked_sub(1) {
            None => self.task.positions,
            Some(i) => self.task.attributes[i].values,
        }
    }

    fn check(&self, values: &[T], level: usize) -> Result<()> {
        if self.watch { check_overflow(self.context, values, level) } else { Ok(()) }
    }

    /// Hands the control faces down to the children of a level.
    fn inherit(
        &self,
        kept: &mut Vec<Vec<u32>>,
        split: &Split,
        level: usize,
        out: Option<&mut [u32]>,
    ) -> Result<()> {
        if !self.task.face_sources {
            return Ok(());
        }
        kept.resize_with(kept.len().max(level + 2), Vec::new);
        let (from, to) = kept.split_at_mut(level + 1);
        let to = if let Some(out) = out {
            out
        } else {
            resize(&mut to[0], split.counts().faces as usize)?;
            &mut to[0]
        };
        split.each_face_origin(|child, origin| {
            let face = origin.representative(split.parent());
            to[child] = if level == 0 { face } else { from[level][face as usize] };
        });
        Ok(())
    }

    /// Reports the part of all vertices that is done: those of the levels up to
    /// one, and a part of the next step's.
    fn progress(&self, level: usize, part: f64) -> Result<()> {
        let vertices = |levels: &[Counts]| levels.iter().map(|c| c.vertices as f64).sum::<f64>();
        let all = self.plan.levels();
        let depth = self.plan.patch_depth() as usize;
        let step = if level + depth + 1 == all.len() { depth.max(1) } else { 1 };
        let next = all.get(level + 1..=level + step).map_or(0.0, |next| part * vertices(next));
        self.context.report((vertices(&all[1..=level]) + next) / vertices(&all[1..]).max(1.0))
    }
}
