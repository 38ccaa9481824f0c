//! Random sequences of C calls with random descriptors.
//!
//! Counts never promise memory that is not there: that is the caller's part of
//! the contract, and cannot be checked. Everything else may be wrong: pointers
//! that are NULL or misaligned, absurd counts that must be refused unread, sizes,
//! strides, enumerators, levels, sizes of structs, buffers that overlap. Buffers
//! have their exact size on the heap, so that the address sanitizer sees one byte
//! too many. A refused call must leave its outputs alone, and say why.
#![no_main]

mod soup;

use carvel::capi::*;
use soup::{Bytes, Soup};
use std::ffi::{CStr, c_void};
use std::ptr::{null, null_mut};

libfuzzer_sys::fuzz_target!(|data: &[u8]| {
    let mut run = Run::new(Bytes::new(data));
    for _ in 0..40 {
        if run.bytes.is_empty() {
            break;
        }
        run.step();
    }
});

/// Objects in the hands of a caller.
struct Run<'d> {
    bytes: Bytes<'d>,
    error: *mut carvel_error,
    contexts: Vec<*mut carvel_context>,
    schemes: Vec<*mut carvel_scheme>,
    meshes: Vec<*mut carvel_mesh>,
    refiners: Vec<*mut carvel_refiner>,
    hierarchies: Vec<*mut carvel_hierarchy>,
}

/// Every status that a call may answer; a panic is a defect.
fn is_known(status: carvel_status) -> bool {
    matches!(status, 0..=17 | 101..=107)
}

/// Calls until the callback cancels.
unsafe extern "C" fn progress(done: f64, user_data: *mut c_void) -> i32 {
    assert!((0.0..=1.0).contains(&done));
    i32::from(user_data.is_null())
}

impl Drop for Run<'_> {
    fn drop(&mut self) {
        // SAFETY: each object is destroyed once, whatever the order.
        unsafe {
            self.meshes.iter().for_each(|&mesh| carvel_mesh_destroy(mesh));
            self.contexts.iter().for_each(|&context| carvel_context_destroy(context));
            self.schemes.iter().for_each(|&scheme| carvel_scheme_destroy(scheme));
            self.hierarchies.iter().for_each(|&hierarchy| carvel_hierarchy_destroy(hierarchy));
            self.refiners.iter().for_each(|&refiner| carvel_refiner_destroy(refiner));
            carvel_error_destroy(self.error);
        }
    }
}

impl<'d> Run<'d> {
    fn new(bytes: Bytes<'d>) -> Self {
        let mut error = null_mut();
        // SAFETY: a place to write to.
        assert_eq!(unsafe { carvel_error_create(&raw mut error) }, 0);
        let (contexts, schemes, meshes) = (Vec::new(), Vec::new(), Vec::new());
        let (refiners, hierarchies) = (Vec::new(), Vec::new());
        Self { bytes, error, contexts, schemes, meshes, refiners, hierarchies }
    }

    fn step(&mut self) {
        match self.bytes.below(16) {
            0 => self.context(),
            1 | 2 => self.scheme(),
            3..=5 => self.mesh(),
            6 => self.refiner(),
            7 => self.hierarchy(),
            8 => self.look_at_mesh(),
            9 => self.predict(),
            10 | 11 => self.refine::<f32>(),
            12 => self.refine::<f64>(),
            13 => self.refine_level::<f32>(),
            14 => self.refine_level::<f64>(),
            _ => self.look_at_hierarchy(),
        }
    }

    /// True now and then.
    fn rarely(&mut self) -> bool {
        self.bytes.byte() > 240
    }

    /// One of some objects, or NULL.
    fn pick<T>(&mut self, of: fn(&Self) -> &Vec<*mut T>) -> *mut T {
        let list = of(self).len();
        match self.bytes.below(list + 1) {
            0 if list == 0 || self.rarely() => null_mut(),
            i => of(self)[i % list],
        }
    }

    fn context_or_null(&mut self) -> *const carvel_context {
        if self.bytes.byte() & 1 == 0 { null() } else { self.pick(|run| &run.contexts) }
    }

    /// A struct's size, mostly the right one.
    fn size_of<T>(&mut self) -> u32 {
        if self.rarely() { self.bytes.byte().into() } else { size_of::<T>() as u32 }
    }

    /// A number that is mostly small and sometimes absurd.
    fn number(&mut self, below: usize) -> u64 {
        if self.rarely() { self.bytes.word() } else { self.bytes.below(below) as u64 }
    }

    /// Checks an answer and what the error says of it.
    fn answer(&mut self, status: carvel_status) -> bool {
        assert!(is_known(status), "status {status}");
        // SAFETY: the error lives.
        unsafe {
            assert_eq!(carvel_error_status(self.error), status);
            let message = CStr::from_ptr(carvel_error_message(self.error)).to_str();
            let message = message.expect("UTF-8");
            assert_eq!(message.lines().count(), usize::from(status != 0), "{message}");
            let entries = carvel_error_entry_count(self.error);
            assert_eq!(entries > 0, status != 0);
            for entry in 0..entries.min(4) + 1 {
                let text = CStr::from_ptr(carvel_error_entry_message(self.error, entry));
                assert_eq!(text.is_empty(), entry >= entries);
                for element in 0..carvel_error_element_count(self.error, entry) + 1 {
                    carvel_error_element(self.error, entry, element);
                }
            }
        }
        status == 0
    }

    fn context(&mut self) {
        let desc = carvel_context_desc {
            struct_size: self.size_of::<carvel_context_desc>(),
            // Starting threads is slow; a fuzzer lives from many runs.
            thread_count: if self.rarely() { [0, 2, 3, 1025][self.bytes.below(4)] } else { 1 },
            memory_ceiling: if self.rarely() { self.bytes.word() >> 40 } else { 0 },
            progress: (self.bytes.byte() & 1 == 0).then_some(progress),
            user_data: if self.rarely() { null_mut() } else { self.error.cast() },
        };
        let mut out = null_mut();
        // SAFETY: valid pointers.
        let status = unsafe { carvel_context_create(&raw const desc, &raw mut out, self.error) };
        if self.answer(status) {
            if self.rarely() {
                // SAFETY: the context lives.
                unsafe { carvel_context_cancel(out) };
            }
            self.contexts.push(out);
        }
    }

    fn scheme(&mut self) {
        let fraction = |run: &mut Self| carvel_fraction {
            numerator: run.number(8) as i64,
            denominator: run.number(40) as i64,
        };
        let passes: Vec<_> = (0..self.bytes.below(4)).map(|_| fraction(self)).collect();
        let family = self.number(5) as i32;
        let averaging = family == CARVEL_SCHEME_AVERAGING || self.rarely();
        let absurd = self.rarely();
        let desc = carvel_scheme_desc {
            struct_size: self.size_of::<carvel_scheme_desc>(),
            family,
            corner_rule: self.number(2) as i32,
            boundary: self.number(3) as i32,
            w: if self.bytes.byte() & 1 == 0 { carvel_fraction::default() } else { fraction(self) },
            degree: if family == CARVEL_SCHEME_B_SPLINE { self.number(9) } else { 0 },
            passes: passes.as_ptr(),
            pass_count: match (absurd, averaging) {
                (true, _) => self.bytes.word() | 1 << 20,
                (_, true) => passes.len() as u64,
                _ => 0,
            },
        };
        let mut out = null_mut();
        // SAFETY: `passes` are there unless their count is absurd.
        let status = unsafe { carvel_scheme_create(&raw const desc, &raw mut out, self.error) };
        if self.answer(status) {
            let mut count = 0;
            // SAFETY: the scheme lives.
            let status =
                unsafe { carvel_scheme_passes(out, null_mut(), 0, &raw mut count, self.error) };
            assert!(self.answer(status) && count <= 64);
            self.schemes.push(out);
        }
    }

    fn mesh(&mut self) {
        let soup = Soup::new(&mut self.bytes);
        let sizes: Box<[u32]> = soup.sizes.clone().into();
        let offsets: Box<[u32]> = std::iter::once(0)
            .chain(soup.sizes.iter().scan(0_u32, |sum, &size| {
                *sum = sum.wrapping_add(size);
                Some(*sum)
            }))
            .collect();
        let indices: Box<[u32]> = soup.indices.clone().into();
        let tags: Box<[u32]> = soup.tags.clone().into();
        let layout = self.bytes.below(8);
        let odd = |pointer: *const u32, run: &mut Self| match (run.rarely(), run.bytes.byte()) {
            (false, _) => pointer,
            (_, 0..128) => null(),
            _ => pointer.wrapping_byte_add(1),
        };
        let absurd = self.rarely().then(|| self.bytes.word() | 1 << 32);
        let desc = carvel_mesh_desc {
            struct_size: self.size_of::<carvel_mesh_desc>(),
            face_size: if layout == 7 { self.number(6) as u32 } else { 0 },
            vertex_count: soup.vertices as u64,
            face_count: absurd.unwrap_or(sizes.len() as u64),
            face_sizes: if layout < 4 { odd(sizes.as_ptr(), self) } else { null() },
            face_offsets: if matches!(layout, 3..7) { odd(offsets.as_ptr(), self) } else { null() },
            face_vertices: odd(indices.as_ptr(), self),
            face_vertex_count: indices.len() as u64,
            non_manifold: if self.rarely() { 7 } else { soup.cut.into() },
            anchored: if self.rarely() { -1 } else { soup.anchored.into() },
            corner_tags: odd(tags.as_ptr(), self),
            corner_tag_count: tags.len() as u64,
        };
        let context = self.context_or_null();
        let mut out = null_mut();
        // SAFETY: arrays are as long as their counts say, or the count is absurd.
        let status =
            unsafe { carvel_mesh_create(context, &raw const desc, &raw mut out, self.error) };
        assert_eq!(out.is_null(), status != 0);
        if self.answer(status) {
            // SAFETY: the mesh lives.
            assert_eq!(unsafe { carvel_mesh_validate(out, self.error) }, 0);
            self.meshes.push(out);
            if self.meshes.len() > 4 {
                let old = self.meshes.remove(0);
                // SAFETY: nothing uses it any more.
                unsafe { carvel_mesh_destroy(old) };
            }
        }
    }

    fn refiner(&mut self) {
        let mut out = null_mut();
        // SAFETY: a place to write to.
        let status = unsafe { carvel_refiner_create(&raw mut out, self.error) };
        assert!(self.answer(status));
        self.refiners.push(out);
    }

    fn counts(&mut self, mesh: *const carvel_mesh) -> Option<carvel_counts> {
        let mut counts = zeroed::<carvel_counts>();
        // SAFETY: valid pointers or NULL.
        let status = unsafe {
            carvel_counts_init(&raw mut counts, size_of::<carvel_counts>() as u32);
            carvel_mesh_counts(mesh, &raw mut counts, self.error)
        };
        self.answer(status).then_some(counts)
    }

    fn look_at_mesh(&mut self) {
        let mesh = self.pick(|run| &run.meshes);
        let Some(counts) = self.counts(mesh) else { return };
        let arrays: [(Fill, u64); 6] = [
            (carvel_mesh_face_sizes, counts.faces),
            (carvel_mesh_face_offsets, counts.faces + 1),
            (carvel_mesh_face_vertices, counts.corners),
            (carvel_mesh_edges, 2 * counts.edges),
            (carvel_mesh_corner_edges, counts.corners),
            (carvel_mesh_valences, counts.vertices),
        ];
        for (fill, needed) in arrays {
            let capacity = (needed + 2).saturating_sub(self.bytes.below(5) as u64);
            let mut out = vec![FILL; capacity as usize].into_boxed_slice();
            // SAFETY: the buffer has its capacity.
            let status = unsafe { fill(mesh, out.as_mut_ptr(), capacity, self.error) };
            let done = self.answer(status);
            assert_eq!(done, capacity >= needed);
            let untouched = if done { needed as usize } else { 0 };
            assert!(out[untouched..].iter().all(|&x| x == FILL));
        }
        let mut survey = zeroed::<carvel_survey>();
        survey.struct_size = self.size_of::<carvel_survey>();
        // SAFETY: valid pointers.
        let status = unsafe { carvel_mesh_survey(mesh, &raw mut survey, self.error) };
        self.answer(status);
    }

    fn predict(&mut self) {
        let (mesh, scheme) = (self.pick(|run| &run.meshes), self.pick(|run| &run.schemes));
        let level = self.number(70) as u32;
        let (mut counts, mut bytes) = (zeroed::<carvel_counts>(), zeroed::<carvel_bytes>());
        counts.struct_size = self.size_of::<carvel_counts>();
        bytes.struct_size = self.size_of::<carvel_bytes>();
        let (width, size) = (self.number(9) as u32, self.number(9) as u32);
        // SAFETY: valid pointers or NULL.
        unsafe {
            let status = carvel_predict_counts(mesh, scheme, level, &raw mut counts, self.error);
            self.answer(status);
            let status =
                carvel_predict_bytes(mesh, scheme, level, width, size, &raw mut bytes, self.error);
            self.answer(status);
        }
    }

    fn hierarchy(&mut self) {
        let (mesh, scheme) = (self.pick(|run| &run.meshes), self.pick(|run| &run.schemes));
        let (context, levels) = (self.context_or_null(), self.bytes.below(3) as u32);
        let mut out = null_mut();
        // SAFETY: valid pointers or NULL.
        let status = unsafe {
            carvel_hierarchy_create(context, mesh, scheme, levels, &raw mut out, self.error)
        };
        if self.answer(status) {
            self.hierarchies.push(out);
        }
    }

    fn look_at_hierarchy(&mut self) {
        let hierarchy = self.pick(|run| &run.hierarchies);
        let level = self.number(4) as u32;
        let mut mesh = null_mut();
        // SAFETY: valid pointers or NULL.
        let status = unsafe { carvel_hierarchy_mesh(hierarchy, level, &raw mut mesh, self.error) };
        if !self.answer(status) {
            return;
        }
        let counts = self.counts(mesh).expect("counts of a mesh");
        let none = carvel_origin { kind: 0, index: 0 };
        let mut vertices = vec![none; counts.vertices as usize].into_boxed_slice();
        let mut offsets = vec![0; counts.vertices as usize + 1].into_boxed_slice();
        let (stage, mut entries) = (self.number(3) as u32, 0);
        // SAFETY: buffers have their capacities; the mesh is destroyed once.
        unsafe {
            let (out, capacity) = (vertices.as_mut_ptr(), vertices.len() as u64);
            let status =
                carvel_hierarchy_vertex_origins(hierarchy, level, out, capacity, self.error);
            assert_eq!(self.answer(status), level > 0);
            let (out, capacity) = (offsets.as_mut_ptr(), offsets.len() as u64);
            let count = &raw mut entries;
            let status = carvel_hierarchy_rows(
                hierarchy,
                level,
                stage,
                out,
                capacity,
                null_mut(),
                null_mut(),
                0,
                count,
                self.error,
            );
            if self.answer(status) {
                assert_eq!(offsets[offsets.len() - 1], entries);
                let mut indices = vec![0; entries as usize].into_boxed_slice();
                let mut weights = vec![0.0; entries as usize].into_boxed_slice();
                let status = carvel_hierarchy_rows(
                    hierarchy,
                    level,
                    stage,
                    out,
                    capacity,
                    indices.as_mut_ptr(),
                    weights.as_mut_ptr(),
                    entries,
                    count,
                    self.error,
                );
                assert!(self.answer(status));
            }
            carvel_mesh_destroy(mesh);
        }
    }

    /// Records for a number of vertices, in memory of their exact size.
    fn records<T: Number>(&mut self, vertices: u64, width: u64) -> Records<T> {
        let (size, align) = (size_of::<T>() as u64, align_of::<T>() as u64);
        let gap = self.bytes.below(4) as u64 * align;
        let stride = if self.rarely() {
            self.number(64)
        } else if gap == 0 && self.bytes.byte() & 1 == 0 {
            0
        } else {
            width * size + gap
        };
        // A stride that is refused is never followed.
        let step = if stride == 0 { width * size } else { stride };
        let bytes = if step > 1 << 20 { 8 } else { (vertices * step).max(8) };
        let mut memory = vec![T::default(); bytes.div_ceil(size) as usize].into_boxed_slice();
        for value in &mut memory {
            *value = T::number(if self.bytes.is_empty() { 1 } else { self.bytes.byte() });
        }
        Records { memory, count: vertices, width, stride }
    }

    fn refine<T: Number>(&mut self) {
        let refiner = self.pick(|run| &run.refiners);
        let (mesh, scheme) = (self.pick(|run| &run.meshes), self.pick(|run| &run.schemes));
        let (context, levels) = (self.context_or_null(), self.bytes.below(3) as u32);
        let mut last = zeroed::<carvel_counts>();
        last.struct_size = size_of::<carvel_counts>() as u32;
        // SAFETY: valid pointers or NULL.
        let status =
            unsafe { carvel_predict_counts(mesh, scheme, levels, &raw mut last, self.error) };
        let Some(counts) = self.counts(mesh).filter(|_| status == 0) else { return };
        let wrong = |run: &mut Self| if run.rarely() { run.bytes.below(4) as u64 } else { 0 };
        let (more, narrower) = (wrong(self), wrong(self) % 2);
        let positions = self.records::<T>(counts.vertices + more, 3 - narrower);
        let width = self.bytes.below(10) as u64;
        let attributes = [self.records::<T>(counts.vertices, width)];
        let attribute_count = self.bytes.below(2) as u64;
        let inputs = [attributes[0].input()];
        let input = RefineInput::<T> {
            struct_size: self.size_of::<RefineInput<T>>(),
            levels,
            mesh,
            scheme,
            positions: positions.input(),
            attributes: if self.rarely() { null() } else { inputs.as_ptr() },
            attribute_count,
        };
        let fewer = wrong(self) / 2;
        let mut points = self.records::<T>((last.vertices + 1).saturating_sub(2 * fewer), 3);
        let mut others = [self.records::<T>(last.vertices, width)];
        let needed = [last.faces, last.faces + 1, last.corners, last.faces];
        let mut indices = needed.map(|n| {
            let n = (n + 1).saturating_sub(wrong(self));
            vec![FILL; n as usize].into_boxed_slice()
        });
        let outputs = [others[0].output()];
        let given = self.bytes.byte();
        let mut index = 0;
        let [face_sizes, face_offsets, face_vertices, face_sources] =
            indices.each_mut().map(|list| {
                index += 1;
                let data = if given >> index & 1 == 0 { null_mut() } else { list.as_mut_ptr() };
                carvel_indices { data, count: list.len() as u64 }
            });
        // Outputs that overlap an input must be refused.
        let overlap = self.rarely();
        let mut output = RefineOutput::<T> {
            struct_size: self.size_of::<RefineOutput<T>>(),
            anchored: -1,
            face_sizes,
            face_offsets,
            face_vertices: if overlap { face_sizes } else { face_vertices },
            face_sources,
            positions: points.output(),
            attributes: outputs.as_ptr(),
            attribute_count,
        };
        // SAFETY: every buffer has its capacity.
        let status =
            unsafe { T::REFINE(refiner, context, &raw const input, &raw mut output, self.error) };
        let done = self.answer(status);
        assert!(done || output.anchored == -1);
        let whole = output.struct_size as usize == size_of::<RefineOutput<T>>();
        assert!(!(done && overlap && whole) || face_sizes.data.is_null() || last.faces == 0);
        for (list, needed) in indices.iter().zip(needed) {
            let beyond = list.get(needed as usize..).unwrap_or_default();
            assert!(beyond.iter().all(|&x| x == FILL));
        }
    }

    fn refine_level<T: Number>(&mut self) {
        let hierarchy = self.pick(|run| &run.hierarchies);
        let (context, level) = (self.context_or_null(), self.number(3) as u32);
        let mut sizes = [zeroed::<carvel_counts>(); 2];
        for (counts, level) in sizes.iter_mut().zip([0, level]) {
            counts.struct_size = size_of::<carvel_counts>() as u32;
            // SAFETY: valid pointers or NULL.
            let status =
                unsafe { carvel_hierarchy_counts(hierarchy, level, &raw mut *counts, self.error) };
            self.answer(status);
        }
        let width = self.bytes.below(7) as u64;
        let values = self.records::<T>(sizes[0].vertices, width);
        let mut out = self.records::<T>(sizes[1].vertices, width);
        let (input, output) = (values.input(), out.output());
        // SAFETY: every buffer has its capacity.
        let status = unsafe {
            T::REFINE_LEVEL(
                hierarchy,
                context,
                level,
                &raw const input,
                &raw const output,
                self.error,
            )
        };
        self.answer(status);
    }
}

type Fill =
    unsafe extern "C" fn(*const carvel_mesh, *mut u32, u64, *mut carvel_error) -> carvel_status;

/// What buffers hold before a call.
const FILL: u32 = 0xa5a5_a5a5;

/// A struct of numbers and pointers that is all zero.
fn zeroed<T: Copy>() -> T {
    // SAFETY: only used for the interface's structs, for which zero is a value.
    unsafe { std::mem::zeroed() }
}

struct Records<T> {
    memory: Box<[T]>,
    count: u64,
    width: u64,
    stride: u64,
}

impl<T> Records<T> {
    fn input(&self) -> ConstValues<T> {
        let Self { count, width, stride, .. } = *self;
        ConstValues { data: self.memory.as_ptr(), count, width, stride }
    }

    fn output(&mut self) -> Values<T> {
        let Self { count, width, stride, .. } = *self;
        Values { data: self.memory.as_mut_ptr(), count, width, stride }
    }
}

type Refine<T> = unsafe extern "C" fn(
    *mut carvel_refiner,
    *const carvel_context,
    *const RefineInput<T>,
    *mut RefineOutput<T>,
    *mut carvel_error,
) -> carvel_status;
type RefineLevel<T> = unsafe extern "C" fn(
    *const carvel_hierarchy,
    *const carvel_context,
    u32,
    *const ConstValues<T>,
    *const Values<T>,
    *mut carvel_error,
) -> carvel_status;

trait Number: Copy + Default {
    const REFINE: Refine<Self>;
    const REFINE_LEVEL: RefineLevel<Self>;
    fn number(byte: u8) -> Self;
}

impl Number for f32 {
    const REFINE: Refine<Self> = carvel_refiner_refine_f32;
    const REFINE_LEVEL: RefineLevel<Self> = carvel_hierarchy_refine_f32;
    fn number(byte: u8) -> Self {
        [f32::NAN, f32::MAX].get(usize::from(byte)).copied().unwrap_or(f32::from(byte))
    }
}

impl Number for f64 {
    const REFINE: Refine<Self> = carvel_refiner_refine_f64;
    const REFINE_LEVEL: RefineLevel<Self> = carvel_hierarchy_refine_f64;
    fn number(byte: u8) -> Self {
        [f64::NAN, f64::MAX].get(usize::from(byte)).copied().unwrap_or(f64::from(byte))
    }
}
