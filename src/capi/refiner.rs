//! `carvel_refiner`: one-shot, the faces and values of level n.

use super::buffer::{Name, Span, Target, check_overlap, input};
use super::guard::{Call, call};
use super::mesh::write_offsets;
use super::object::{destroy_function, look, object, poisoned};
use super::status::{
    CARVEL_STATUS_BUSY, CARVEL_STATUS_LENGTH_MISMATCH, Fault, Result, carvel_status,
};
use super::values::{ConstValues, Records, Sink, Source, Values, carvel_indices, interpolation};
use super::versioned::{init_function, read, versioned, write_field};
use super::{carvel_context, carvel_error, carvel_mesh, carvel_scheme};
use crate::base::{Context, Scalar};
use crate::hierarchy::{Attribute, Interpolation, Output, Prediction, Refiner, Task};
use crate::mesh::Mesh;
use crate::scheme::Scheme;
use std::mem::offset_of;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, MutexGuard, TryLockError};

object!(carvel_refiner, Guarded);

/// The refiners, for one call at a time.
#[derive(Default)]
pub(super) struct Guarded {
    refiners: Mutex<Refiners>,
    /// Scratch memory held, as of the last call that ended.
    bytes: AtomicU64,
}

/// The most attributes that one call refines.
const MOST_ATTRIBUTES: u64 = 256;

/// A refiner for each number type.
#[derive(Default)]
pub(super) struct Refiners {
    single: Refiner<f32>,
    double: Refiner<f64>,
}

/// A number type of the interface.
pub(super) trait Precision: Scalar {
    fn refiner(all: &mut Refiners) -> &mut Refiner<Self>;
}

impl Refiners {
    fn bytes(&self) -> u64 {
        self.single.bytes() + self.double.bytes()
    }
}

impl Precision for f32 {
    fn refiner(all: &mut Refiners) -> &mut Refiner<Self> {
        &mut all.single
    }
}

impl Precision for f64 {
    fn refiner(all: &mut Refiners) -> &mut Refiner<Self> {
        &mut all.double
    }
}

versioned! {
    pub struct RefineInput<T> as "carvel_refine_input" {
        pub struct_size: u32,
        pub levels: u32,
        pub mesh: *const carvel_mesh,
        pub scheme: *const carvel_scheme,
        pub positions: ConstValues<T>,
        pub attributes: *const ConstValues<T>,
        pub attribute_count: u64,
        pub interpolations: *const i32,
    }
}

versioned! {
    pub struct RefineOutput<T> as "carvel_refine_output" {
        pub struct_size: u32,
        pub anchored: i32,
        pub face_sizes: carvel_indices,
        pub face_offsets: carvel_indices,
        pub face_vertices: carvel_indices,
        pub face_sources: carvel_indices,
        pub positions: Values<T>,
        pub attributes: *const Values<T>,
        pub attribute_count: u64,
    }
}

pub type carvel_refine_input_f32 = RefineInput<f32>;
pub type carvel_refine_input_f64 = RefineInput<f64>;
pub type carvel_refine_output_f32 = RefineOutput<f32>;
pub type carvel_refine_output_f64 = RefineOutput<f64>;

/// Records for positions and attributes, positions first.
type AllRecords<P> = Vec<Records<P>>;

impl<T: Scalar> RefineInput<T> {
    /// Checks all inputs.
    ///
    /// # Safety
    /// `attributes` leads to as many entries as the count says.
    unsafe fn check(&self, mesh: &Mesh) -> Result<AllRecords<*const T>> {
        if self.attribute_count > MOST_ATTRIBUTES {
            return Err(Fault::out_of_range(format!(
                "{} attributes: the limit is {MOST_ATTRIBUTES}",
                self.attribute_count
            )));
        }
        // SAFETY: the caller's contract.
        let attributes =
            unsafe { input(self.attributes, self.attribute_count, "input.attributes")? };
        let vertices = mesh.vertices() as u64;
        let mut records = vec![self.positions.check(vertices, "input.positions".into())?];
        if records[0].width != 3 {
            return Err(Fault::new(
                CARVEL_STATUS_LENGTH_MISMATCH,
                format!("input.positions: the width is {}, not 3", records[0].width),
            ));
        }
        for (i, attribute) in attributes.iter().enumerate() {
            let name = Name { text: "input.attributes", index: Some(i) };
            records.push(attribute.check(vertices, name)?);
        }
        Ok(records)
    }

    /// How each attribute is refined; all by the scheme's rows, if nothing is said.
    ///
    /// # Safety
    /// `interpolations` is NULL or leads to one for each attribute, of which there are
    /// as many as [`Self::check`] allows.
    unsafe fn interpolations(&self, scheme: &Scheme) -> Result<Vec<Interpolation>> {
        let count = self.attribute_count;
        if self.interpolations.is_null() {
            return Ok(vec![Interpolation::Vertex; count as usize]);
        }
        // SAFETY: the caller's contract.
        let kinds = unsafe { input(self.interpolations, count, "input.interpolations")? };
        let check = |&kind: &i32| {
            let kind = interpolation(kind)?;
            scheme.check_interpolation(kind)?;
            Ok(kind)
        };
        kinds.iter().map(check).collect()
    }
}

impl<T: Scalar> RefineOutput<T> {
    /// The attributes, one for each of the input.
    ///
    /// # Safety
    /// `attributes` leads to as many entries as the count says.
    unsafe fn attributes<'a>(&self, expected: usize) -> Result<&'a [Values<T>]> {
        if self.attribute_count != expected as u64 {
            return Err(Fault::new(
                CARVEL_STATUS_LENGTH_MISMATCH,
                format!("{} output.attributes for {expected} of the input", self.attribute_count),
            ));
        }
        // SAFETY: the caller's contract.
        unsafe { input(self.attributes, self.attribute_count, "output.attributes") }
    }

    /// Bytes of the copies of records that are not one after the other.
    fn copies(&self, attributes: &[Values<T>], vertices: u64) -> u64 {
        let all = std::iter::once(&self.positions).chain(attributes);
        all.map(|values| values.copy_bytes(vertices)).fold(0, u64::saturating_add)
    }

    /// Checks all outputs of values.
    fn check(
        &self,
        attributes: &[Values<T>],
        vertices: u64,
        inputs: &AllRecords<*const T>,
    ) -> Result<AllRecords<*mut T>> {
        let mut records = vec![self.positions.check(vertices, 3, "output.positions".into())?];
        for (i, (attribute, from)) in attributes.iter().zip(&inputs[1..]).enumerate() {
            let name = Name { text: "output.attributes", index: Some(i) };
            records.push(attribute.check(vertices, from.width, name)?);
        }
        Ok(records)
    }
}

/// Bytes of the copies of records that are not one after the other.
fn input_copies<T: Scalar>(records: &AllRecords<*const T>) -> u64 {
    records.iter().map(Records::copy_bytes::<T>).fold(0, u64::saturating_add)
}

/// The index arrays of an output.
struct Faces {
    sizes: Target<u32>,
    offsets: Target<u32>,
    vertices: Target<u32>,
    sources: Target<u32>,
}

impl Faces {
    fn of<T>(output: &RefineOutput<T>, plan: &Prediction) -> Self {
        let last = plan.last();
        let target = |indices: carvel_indices, needed, name| {
            Target::new((indices.data, indices.count), needed, name)
        };
        Self {
            sizes: target(output.face_sizes, last.faces, "output.face_sizes"),
            offsets: target(output.face_offsets, last.faces + 1, "output.face_offsets"),
            vertices: target(output.face_vertices, last.corners, "output.face_vertices"),
            sources: target(output.face_sources, last.faces, "output.face_sources"),
        }
    }

    /// Checks the arrays that are wanted, and adds what will be written.
    fn add_spans(&self, spans: &mut Vec<Span>) -> Result<()> {
        let all = [self.sizes, self.offsets, self.vertices, self.sources];
        all.iter().filter(|target| target.is_given()).try_for_each(|target| {
            spans.push(target.span()?);
            Ok(())
        })
    }
}

/// Borrows an array, if it is wanted.
///
/// # Safety
/// As [`Target::slice`].
unsafe fn wanted<'a>(target: &Target<u32>) -> Option<&'a mut [u32]> {
    // SAFETY: the caller's contract.
    target.is_given().then(|| unsafe { target.slice() })
}

/// Everything of a call, checked.
struct Job<'a, T> {
    mesh: &'a Mesh,
    scheme: &'a Scheme,
    plan: Prediction,
    inputs: AllRecords<*const T>,
    interpolations: Vec<Interpolation>,
    outputs: AllRecords<*mut T>,
    faces: Faces,
}

impl<'a, T: Precision> Job<'a, T> {
    /// Checks everything that can be checked before anything is allocated.
    ///
    /// # Safety
    /// The header's contract.
    unsafe fn check(
        call: &mut Call<'a>,
        context: &Context,
        (input, output): (&RefineInput<T>, &RefineOutput<T>),
        places: [Span; 2],
    ) -> Result<Self> {
        // SAFETY: the caller's contract.
        let (mesh, scheme) =
            unsafe { (&*call.object(input.mesh)?.mesh, call.object(input.scheme)?) };
        // SAFETY: the caller's contract.
        let (inputs, interpolations) =
            unsafe { (input.check(mesh)?, input.interpolations(scheme)?) };
        let plan = Prediction::new(mesh, scheme, input.levels)?;
        plan.check_index_type()?;
        // What no buffer can change comes before the buffers, as the header says.
        let faces = Faces::of(output, &plan);
        let width: usize = inputs.iter().map(|records| records.width).sum();
        let scratch = plan.refiner_bytes(width as u64, T::BYTES, faces.sources.is_given());
        // SAFETY: the caller's contract.
        let attributes = unsafe { output.attributes(inputs.len() - 1)? };
        let copies = output.copies(attributes, plan.last().vertices);
        let copies = copies.saturating_add(input_copies(&inputs));
        context.check_memory(scratch.saturating_add(copies))?;
        let outputs = output.check(attributes, plan.last().vertices, &inputs)?;
        let job = Self { mesh, scheme, plan, inputs, interpolations, outputs, faces };
        job.check_overlap(places, input, output)?;
        Ok(job)
    }

    /// Refuses outputs that overlap anything of the call.
    fn check_overlap(
        &self,
        places: [Span; 2],
        input: &RefineInput<T>,
        output: &RefineOutput<T>,
    ) -> Result<()> {
        // Both lists have one entry for each attribute.
        let count = self.inputs.len() - 1;
        let (read, written) = (size_of::<ConstValues<T>>(), size_of::<Values<T>>());
        let kinds = if input.interpolations.is_null() { 0 } else { count * size_of::<i32>() };
        let lists = [
            Span::of(input.attributes, count * read, false, "input.attributes"),
            Span::of(input.interpolations, kinds, false, "input.interpolations"),
            Span::of(output.attributes, count * written, false, "output.attributes"),
        ];
        let values = self.inputs.len() + self.outputs.len();
        let mut spans = Vec::with_capacity(values + 9);
        spans.extend(places.into_iter().chain(lists));
        self.faces.add_spans(&mut spans)?;
        spans.extend(self.inputs.iter().map(Records::read_span));
        spans.extend(self.outputs.iter().map(Records::write_span));
        check_overlap(&spans)
    }

    /// Refines; returns whether the result is anchored.
    ///
    /// # Safety
    /// The header's contract.
    unsafe fn run(self, context: &Context, refiner: &mut Refiner<T>) -> Result<bool> {
        // SAFETY: the caller's contract; overlap has been checked.
        let (inputs, mut sinks) = unsafe { (self.sources()?, self.sinks()?) };
        let attributes: Vec<_> = inputs[1..]
            .iter()
            .zip(&self.inputs[1..])
            .zip(&self.interpolations)
            .map(|((source, records), &interpolation)| Attribute {
                values: source.values(),
                width: records.width,
                interpolation,
            })
            .collect();
        let levels = self.plan.levels().len() as u32 - 1;
        let mut task = Task::new(self.mesh, self.scheme, levels, inputs[0].values());
        task.attributes = &attributes;
        // SAFETY: as above.
        let mut offsets = unsafe { wanted(&self.faces.offsets) };
        // SAFETY: as above.
        let mut sizes = unsafe { wanted(&self.faces.sizes) };
        let (positions, rest) = sinks.split_at_mut(1);
        // SAFETY: as above.
        let (face_vertices, face_sources) =
            unsafe { (wanted(&self.faces.vertices), wanted(&self.faces.sources)) };
        task.face_sources = face_sources.is_some();
        let output = Output {
            // Offsets alone are made of sizes written one place further.
            face_sizes: sizes.as_deref_mut().or_else(|| Some(&mut offsets.as_deref_mut()?[1..])),
            face_vertices,
            face_sources,
            channels: Vec::new(),
            positions: positions[0].values(),
            attributes: rest.iter_mut().map(Sink::values).collect(),
        };
        refiner.run(context, &task, &self.plan, output)?;
        let anchored = task.anchored();
        if let Some(offsets) = offsets {
            sum_up(sizes.as_deref(), offsets);
        }
        for sink in sinks {
            // SAFETY: as above.
            unsafe { sink.finish() };
        }
        Ok(anchored)
    }

    /// # Safety
    /// The header's contract.
    unsafe fn sources<'s>(&self) -> Result<Vec<Source<'s, T>>> {
        // SAFETY: the caller's contract.
        self.inputs.iter().map(|records| unsafe { records.read() }).collect()
    }

    /// # Safety
    /// The header's contract, and overlap has been checked.
    unsafe fn sinks<'s>(&self) -> Result<Vec<Sink<'s, T>>> {
        // SAFETY: the caller's contract.
        self.outputs.iter().map(|records| unsafe { records.sink() }).collect()
    }
}

/// Offsets from the sizes, which stand in the offsets themselves if there is no
/// other place.
fn sum_up(sizes: Option<&[u32]>, offsets: &mut [u32]) {
    if let Some(sizes) = sizes {
        return write_offsets(sizes.iter().copied(), offsets);
    }
    offsets[0] = 0;
    for i in 1..offsets.len() {
        offsets[i] += offsets[i - 1];
    }
}

fn lock(refiners: &Mutex<Refiners>) -> Result<MutexGuard<'_, Refiners>> {
    refiners.try_lock().map_err(|error| match error {
        TryLockError::WouldBlock => {
            Fault::new(CARVEL_STATUS_BUSY, "carvel_refiner is at work for another call")
        }
        TryLockError::Poisoned(_) => poisoned::<carvel_refiner>(),
    })
}

/// # Safety
/// The header's contract.
unsafe fn refine<T: Precision>(
    refiner: *mut carvel_refiner,
    context: *const carvel_context,
    (input, output): (*const RefineInput<T>, *mut RefineOutput<T>),
    error: *mut carvel_error,
) -> carvel_status {
    // SAFETY: the caller's contract.
    unsafe {
        call(error, |call| {
            let refiner = call.object(refiner.cast_const())?;
            let context = call.context(context)?;
            let (task, result) = (read(input)?, read(output)?);
            let places = [
                Span::of(input, task.struct_size as usize, false, "input"),
                Span::of(output, result.struct_size as usize, true, "output"),
            ];
            let job = Job::check(call, &context, (&task, &result), places)?;
            let mut refiners = lock(&refiner.refiners)?;
            let outcome = job.run(&context, T::refiner(&mut refiners));
            refiner.bytes.store(refiners.bytes(), Ordering::Relaxed);
            let anchored = i32::from(outcome?);
            let offset = offset_of!(RefineOutput<T>, anchored);
            write_field(output, result.struct_size, offset, anchored);
            Ok(())
        })
    }
}

#[unsafe(no_mangle)]
pub unsafe extern "C" fn carvel_refiner_create(
    out: *mut *mut carvel_refiner,
    error: *mut carvel_error,
) -> carvel_status {
    // SAFETY: the header's contract.
    unsafe { call(error, |call| call.create(out, |_| Ok(Guarded::default()))) }
}

destroy_function!(carvel_refiner_destroy, carvel_refiner);

#[unsafe(no_mangle)]
pub unsafe extern "C" fn carvel_refiner_bytes(refiner: *const carvel_refiner) -> u64 {
    // SAFETY: the header's contract.
    unsafe { look(refiner) }.map_or(0, |handle| handle.value.bytes.load(Ordering::Relaxed))
}

/// The functions that exist for each number type.
macro_rules! twins {
    ($number:ty, $init_input:ident, $init_output:ident, $refine:ident) => {
        init_function!($init_input, RefineInput<$number>);

        init_function!($init_output, RefineOutput<$number>);

        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $refine(
            refiner: *mut carvel_refiner,
            context: *const carvel_context,
            input: *const RefineInput<$number>,
            output: *mut RefineOutput<$number>,
            error: *mut carvel_error,
        ) -> carvel_status {
            // SAFETY: the header's contract.
            unsafe { refine(refiner, context, (input, output), error) }
        }
    };
}

twins!(f32, carvel_refine_input_f32_init, carvel_refine_output_f32_init, carvel_refiner_refine_f32);
twins!(f64, carvel_refine_input_f64_init, carvel_refine_output_f64_init, carvel_refiner_refine_f64);
