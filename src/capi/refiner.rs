//! `carvel_refiner`: one-shot, the faces and values of level n.

use super::buffer::{Span, Target, check_overlap};
use super::channel::{ChannelInput, ChannelOutput, Lent};
use super::guard::{Call, call};
use super::mesh::write_offsets;
use super::object::{destroy_function, look, object, poisoned};
use super::refine_desc::{
    AllRecords, RefineInput, RefineOutput, channel_bytes, input_copies, targets,
};
use super::status::{CARVEL_STATUS_BUSY, Fault, Result, carvel_status};
use super::values::{ConstValues, Records, Sink, Source, Values, carvel_indices};
use super::versioned::{init_function, read, write_field};
use super::{carvel_context, carvel_error};
use crate::base::{Context, Scalar};
use crate::hierarchy::{
    self, Attribute, FaceVarying, Interpolation, Output, Prediction, Refiner, Task,
};
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
    channels: Vec<Lent<'a>>,
    outputs: AllRecords<*mut T>,
    faces: Faces,
    /// Of the channels.
    indices: Vec<Target<u32>>,
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
            unsafe { (&call.object(input.mesh)?.mesh, call.object(input.scheme)?) };
        // SAFETY: the caller's contract.
        let (mut inputs, interpolations) =
            unsafe { (input.check(mesh)?, input.interpolations(scheme)?) };
        let plan = Prediction::new(mesh, scheme, input.levels)?;
        plan.check_index_type()?;
        // What no buffer can change comes before the buffers, as the header says.
        let faces = Faces::of(output, &plan);
        let width: usize = inputs.iter().map(|records| records.width).sum();
        // SAFETY: the caller's contract.
        let channels = unsafe { input.channels(call, (mesh, scheme), &mut inputs)? };
        let plan = if channels.is_empty() { plan } else { plan.level_by_level() };
        let scratch = plan.refiner_bytes(width as u64, T::BYTES, faces.sources.is_given());
        let others = channel_bytes(&channels, &inputs[inputs.len() - channels.len()..]);
        // SAFETY: the caller's contract.
        let lists = unsafe { output.lists(input)? };
        let copies = output.copies(&lists, plan.last().vertices, &channels);
        let parts = [scratch, others, copies, input_copies(&inputs)];
        context.check_memory(parts.into_iter().fold(0, u64::saturating_add))?;
        let outputs = output.check(&lists, plan.last().vertices, (&inputs, &channels))?;
        let indices = targets(&lists, &channels);
        let job =
            Self { mesh, scheme, plan, inputs, interpolations, channels, outputs, faces, indices };
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
        // The lists of input and output have the same lengths.
        let (channels, attributes) = (self.channels.len(), self.interpolations.len());
        let (read, written) = (size_of::<ConstValues<T>>(), size_of::<Values<T>>());
        let (taken, given) = (size_of::<ChannelInput<T>>(), size_of::<ChannelOutput<T>>());
        let kinds = if input.interpolations.is_null() { 0 } else { attributes * size_of::<i32>() };
        let lists = [
            Span::of(input.attributes, attributes * read, false, "input.attributes"),
            Span::of(input.interpolations, kinds, false, "input.interpolations"),
            Span::of(input.channels, channels * taken, false, "input.channels"),
            Span::of(output.attributes, attributes * written, false, "output.attributes"),
            Span::of(output.channels, channels * given, false, "output.channels"),
        ];
        let values = self.inputs.len() + self.outputs.len() + channels;
        let mut spans = Vec::with_capacity(values + 11);
        spans.extend(places.into_iter().chain(lists));
        self.faces.add_spans(&mut spans)?;
        for indices in &self.indices {
            spans.push(indices.span()?);
        }
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
        let attributes = self.attributes(&inputs);
        let channels = self.face_varying(&inputs);
        let levels = self.plan.levels().len() as u32 - 1;
        let mut task = Task::new(self.mesh, self.scheme, levels, inputs[0].values());
        (task.attributes, task.channels) = (&attributes, &channels);
        // SAFETY: as above.
        let mut offsets = unsafe { wanted(&self.faces.offsets) };
        // SAFETY: as above.
        let mut sizes = unsafe { wanted(&self.faces.sizes) };
        let (positions, rest) = sinks.split_at_mut(1);
        let (others, last) = rest.split_at_mut(attributes.len());
        // SAFETY: as above.
        let (face_vertices, face_sources) =
            unsafe { (wanted(&self.faces.vertices), wanted(&self.faces.sources)) };
        task.face_sources = face_sources.is_some();
        let output = Output {
            // Offsets alone are made of sizes written one place further.
            face_sizes: sizes.as_deref_mut().or_else(|| Some(&mut offsets.as_deref_mut()?[1..])),
            face_vertices,
            face_sources,
            positions: positions[0].values(),
            attributes: others.iter_mut().map(Sink::values).collect(),
            // SAFETY: as above.
            channels: unsafe { channel_outputs(&self.indices, last) },
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

    fn attributes<'s>(&self, inputs: &'s [Source<T>]) -> Vec<Attribute<'s, T>> {
        let listed = inputs.iter().zip(&self.inputs).skip(1).zip(&self.interpolations);
        let attribute = |((source, records), &interpolation): ((&'s Source<T>, &Records<_>), _)| {
            Attribute { values: source.values(), width: records.width, interpolation }
        };
        listed.map(attribute).collect()
    }

    fn face_varying<'s>(&'s self, inputs: &'s [Source<T>]) -> Vec<FaceVarying<'s, T>> {
        let first = inputs.len() - self.channels.len();
        let listed = inputs[first..].iter().zip(&self.inputs[first..]).zip(&self.channels);
        let values = |((source, records), lent): ((&'s Source<T>, &Records<_>), &'s Lent)| {
            FaceVarying { channel: lent.channel, values: source.values(), width: records.width }
        };
        listed.map(values).collect()
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

/// Where the channels go.
///
/// # Safety
/// As [`Target::slice`], for all indices.
unsafe fn channel_outputs<'s, T: Scalar>(
    indices: &[Target<u32>],
    values: &'s mut [Sink<'_, T>],
) -> Vec<hierarchy::ChannelOutput<'s, T>> {
    let pairs = indices.iter().zip(values);
    let output = |(indices, values): (&Target<u32>, &'s mut Sink<'_, T>)| {
        // SAFETY: the caller's contract.
        let indices = unsafe { indices.slice() };
        hierarchy::ChannelOutput { indices, values: values.values() }
    };
    pairs.map(output).collect()
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
