//! One refinement with all its data: a mesh file in, a mesh file out.

use crate::args::{Chosen, NumberType};
use crate::carry::{self, Load};
use crate::limit::{self, Wanted};
use crate::memory::zeroed;
use crate::precise::Precise;
use crate::texture::{self, Texture};
use crate::{holes, tags};
use carvel::hierarchy::FaceVarying;
use carvel::io::MeshFile;
use carvel::mesh::Built;
use carvel::scheme::SplitKind;
use carvel::{Attribute, Boundary, Context, Error, Mesh, Output, Prediction, Refiner};
use carvel::{ErrorKind, Result, Scheme, Task};
use std::borrow::Cow;

/// A refiner of either precision, which keeps its memory from mesh to mesh.
#[derive(Debug)]
pub enum Engine {
    /// Computes in single precision.
    Single(Refiner<f32>),
    /// Computes in double precision.
    Double(Refiner<f64>),
}

/// What to refine and how far.
#[derive(Debug, Clone, Copy)]
pub struct Work<'a> {
    /// The control mesh as its file holds it.
    pub control: &'a MeshFile,
    /// Its topology.
    pub built: &'a Built,
    /// The scheme and its options.
    pub chosen: &'a Chosen,
    /// The number of steps, at least 1.
    pub levels: u32,
    /// The predicted sizes.
    pub plan: &'a Prediction,
    /// Whether holes are written.
    pub keep_holes: bool,
    /// What to make of the last level's vertices.
    pub limit: Wanted,
}

/// A refined mesh.
#[derive(Debug)]
pub struct Outcome {
    /// The mesh, ready to be written.
    pub file: MeshFile,
    /// One line for each kind of data that had to be left out.
    pub notes: Vec<String>,
    /// The number of faces that were left out as holes.
    pub holes: u64,
    /// Whether a further step must treat the mesh as anchored.
    pub anchored: bool,
    /// Bytes of scratch memory that the kernel held.
    pub scratch: u64,
    /// Seconds that the kernel was predicted to take, without texture coordinates.
    pub predicted: f64,
}

impl Engine {
    /// An engine that computes in a number type.
    pub fn new(number: NumberType) -> Self {
        match number {
            NumberType::F32 => Self::Single(Refiner::new()),
            NumberType::F64 => Self::Double(Refiner::new()),
        }
    }

    /// Refines.
    ///
    /// # Errors
    /// As [`Refiner::refine_into`]; all sizes are checked before anything is
    /// allocated.
    pub fn run(&mut self, context: &Context, work: &Work) -> Result<Outcome> {
        match self {
            Self::Single(refiner) => run(refiner, context, work),
            Self::Double(refiner) => run(refiner, context, work),
        }
    }
}

/// Predicts all levels, and refuses those that cannot be numbered by naming the
/// first of them and its size.
///
/// # Errors
/// [`ErrorKind::TooLarge`].
pub fn predict(mesh: &Mesh, scheme: &Scheme, levels: u32) -> Result<Prediction> {
    let whole = Prediction::new(mesh, scheme, levels);
    if let Ok(plan) = &whole
        && plan.last().check_index_type().is_ok()
    {
        return whole;
    }
    let fitting = |level| {
        let plan = Prediction::new(mesh, scheme, level)?;
        plan.last().check_index_type().map_err(|e| {
            let message = format!("level {level} of {levels} is too large: {e}");
            Error::new(ErrorKind::TooLarge, message)
        })
    };
    (1..=levels).try_for_each(fitting)?;
    whole
}

fn run<T: Precise>(refiner: &mut Refiner<T>, context: &Context, work: &Work) -> Result<Outcome> {
    let (mesh, scheme) = (&work.built.mesh, &work.chosen.scheme);
    let features = work.chosen.has_features();
    let texture = if features { Texture::of(work.control, mesh, work.chosen.uv)? } else { None };
    let source = work.built.vertex_source.as_deref();
    let load = Load::of(work.control, source, texture.is_none());
    check_memory::<T>(context, work, &load, texture.as_ref())?;
    let predicted = work.plan.seconds(load.width(), T::BYTES, context.threads()).total();
    let Filled { mut file, faces, columns, texture: refined } =
        fill(refiner, context, work, &load, texture.as_ref())?;
    let hole = holes::find(mesh, scheme, &faces)?;
    let faces = sources(mesh, faces);
    carry::inherit(work.control, &faces, &mut file);
    carry::unload(&load, columns, work.control, &mut file);
    if let (Some(texture), Some(refined)) = (&texture, refined) {
        texture.unload(refined, &faces, &mut file);
    }
    limit::finish(context, work, &mut file)?;
    if features {
        tags::unload(work, &mut file)?;
    }
    let mut left_out = 0;
    match hole {
        Some(hole) if work.keep_holes => holes::tag(&mut file, &hole),
        Some(hole) => {
            holes::leave_out(&mut file, &hole);
            left_out = work.plan.last().faces - file.face_sizes.len() as u64;
        }
        None => {}
    }
    let mut notes: Vec<_> = load.dropped.into_iter().collect();
    notes.extend(texture.and_then(|texture| texture.note));
    let anchored = scheme.split() == SplitKind::Corner && scheme.boundary() != Boundary::None;
    let (scratch, holes) = (refiner.bytes(), left_out);
    Ok(Outcome { file, notes, holes, anchored, scratch, predicted })
}

/// What the kernel makes.
struct Filled {
    file: MeshFile,
    /// The control face of every face, in the mesh's order.
    faces: Vec<u32>,
    columns: Vec<Vec<f64>>,
    texture: Option<texture::Refined<f64>>,
}

/// Refines into the arrays of a mesh file and of its data.
fn fill<T: Precise>(
    refiner: &mut Refiner<T>,
    context: &Context,
    work: &Work,
    load: &Load,
    texture: Option<&Texture>,
) -> Result<Filled> {
    let columns = load.columns.iter().map(|c| T::narrow(&c.values, c.width));
    let columns = columns.collect::<Result<Vec<_>>>()?;
    let attributes = load.columns.iter().zip(&columns);
    let attributes: Vec<_> =
        attributes.map(|(column, values)| Attribute::vertex(&values[..], column.width)).collect();
    let uvs = texture.map(|texture| T::narrow(&texture.values, 2)).transpose()?;
    let channels: Vec<_> = texture
        .zip(uvs.as_deref())
        .map(|(texture, values)| FaceVarying { channel: &texture.channel, values, width: 2 })
        .into_iter()
        .collect();
    let points = positions(work.control, work.built);
    let positions = T::narrow(points.as_flattened(), 3)?;
    let task = Task {
        mesh: &work.built.mesh,
        scheme: &work.chosen.scheme,
        levels: work.levels,
        positions: &positions,
        attributes: &attributes,
        channels: &channels,
        face_sources: true,
    };
    run_task(refiner, context, &task, work.plan)
}

/// Makes room for a task's results and refines into it.
fn run_task<T: Precise>(
    refiner: &mut Refiner<T>,
    context: &Context,
    task: &Task<T>,
    plan: &Prediction,
) -> Result<Filled> {
    let last = plan.last();
    let mut file = MeshFile {
        face_sizes: zeroed(0, last.faces)?,
        face_vertices: zeroed(0, last.corners)?,
        ..MeshFile::default()
    };
    let mut faces = zeroed(0, last.faces)?;
    let columns = task.attributes.iter();
    let mut columns = columns
        .map(|a| zeroed(T::default(), last.vertices * a.width as u64))
        .collect::<Result<Vec<_>>>()?;
    let room =
        |data: &FaceVarying<T>| texture::Refined::<T>::room(data.channel, task.scheme, task.levels);
    let mut texture = task.channels.first().map(room).transpose()?;
    file.positions = T::points(last.vertices, |positions| {
        let output = Output {
            face_sizes: Some(&mut file.face_sizes),
            face_vertices: Some(&mut file.face_vertices),
            face_sources: Some(&mut faces),
            positions,
            attributes: columns.iter_mut().map(Vec::as_mut_slice).collect(),
            channels: texture.iter_mut().map(texture::Refined::output).collect(),
        };
        refiner.refine_into(context, task, output)
    })?;
    let columns = columns.into_iter().map(T::widen).collect::<Result<_>>()?;
    let texture = texture.map(texture::Refined::widen).transpose()?;
    Ok(Filled { file, faces, columns, texture })
}

/// The positions of the mesh's vertices, some of which may be copies.
pub fn positions<'a>(control: &'a MeshFile, built: &Built) -> Cow<'a, [[f64; 3]]> {
    let positions = &control.positions;
    match &built.vertex_source {
        None => Cow::Borrowed(positions),
        Some(source) => Cow::Owned(source.iter().map(|&v| positions[v as usize]).collect()),
    }
}

/// From faces of the mesh to faces of the file.
fn sources(mesh: &Mesh, mut faces: Vec<u32>) -> Vec<u32> {
    for face in &mut faces {
        *face = mesh.face_source(*face as usize) as u32;
    }
    faces
}

/// Counts the result as a mesh file, with all that it carries.
fn check_memory<T: Precise>(
    context: &Context,
    work: &Work,
    load: &Load,
    texture: Option<&Texture>,
) -> Result<()> {
    let last = work.plan.last();
    let width = load.width();
    let scratch = work.plan.scratch_bytes(width, T::BYTES);
    // In single precision the kernel's arrays exist beside the file's.
    let narrow = if T::BYTES < 8 { width * T::BYTES * last.vertices } else { 0 };
    let file = 24 * last.vertices + 4 * last.corners + 8 * last.faces;
    let carried = carry::bytes(load, work.control, last.vertices, last.corners, last.faces);
    let count = |texture| texture::bytes::<T>(texture, &work.chosen.scheme, work.levels);
    let texture = texture.map(count).transpose()?.unwrap_or(0);
    context.check_memory(scratch + narrow + file + carried + texture)
}
