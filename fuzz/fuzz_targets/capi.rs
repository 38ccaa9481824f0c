//! Random sequences of C calls with random descriptors.
//!
//! Counts never promise memory that is not there: that is the caller's part of
//! the contract, and cannot be checked. Everything else may be wrong: pointers
//! that are NULL or misaligned, absurd counts that must be refused unread, sizes,
//! strides, enumerators, levels, sizes of structs, buffers that overlap. Buffers
//! have their exact size on the heap, so that the address sanitizer sees one byte
//! too many. A refused call must leave its outputs alone, and say why; a call that
//! succeeds writes what was asked for and nothing beside it. Objects are destroyed
//! in any order.
#![no_main]

mod soup;

use carvel::capi::*;
use soup::{Bytes, Soup};
use std::alloc::{Layout, alloc, dealloc};
use std::ffi::{CStr, c_void};
use std::mem::MaybeUninit;
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
    /// The error that the last call was given, if it was not that one.
    given: Given,
    contexts: Vec<*mut carvel_context>,
    schemes: Vec<*mut carvel_scheme>,
    meshes: Vec<*mut carvel_mesh>,
    refiners: Vec<*mut carvel_refiner>,
    hierarchies: Vec<*mut carvel_hierarchy>,
}

#[derive(Clone, Copy, PartialEq)]
enum Given {
    Error,
    Null,
    Misaligned,
}

/// Every status that a call may answer; a panic is a defect.
fn is_known(status: carvel_status) -> bool {
    matches!(status, 0..=17 | 101..=107)
}

/// Whether a status was decided before anything was written.
fn is_decided_early(status: carvel_status) -> bool {
    !matches!(
        status,
        CARVEL_STATUS_OK
            | CARVEL_STATUS_OVERFLOW
            | CARVEL_STATUS_CANCELLED
            | CARVEL_STATUS_OUT_OF_RESOURCES
    )
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
        let given = Given::Error;
        Self { bytes, error, given, contexts, schemes, meshes, refiners, hierarchies }
    }

    fn step(&mut self) {
        match self.bytes.below(19) {
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
            15 => self.look_at_hierarchy(),
            16 => self.list_histogram(),
            17 => self.list_passes(),
            _ => self.destroy(),
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

    /// The error for the next call, which may fail for it: mostly the right one.
    fn error(&mut self) -> *mut carvel_error {
        self.given = match self.bytes.byte() {
            250.. => Given::Misaligned,
            240.. => Given::Null,
            _ => Given::Error,
        };
        match self.given {
            Given::Error => self.error,
            Given::Null => null_mut(),
            Given::Misaligned => self.error.wrapping_byte_add(1),
        }
    }

    /// Checks an answer and what the error says of it.
    fn answer(&mut self, status: carvel_status) -> bool {
        assert!(is_known(status), "status {status}");
        match std::mem::replace(&mut self.given, Given::Error) {
            Given::Null => return status == 0,
            Given::Misaligned => {
                assert_eq!(status, CARVEL_STATUS_MISALIGNED);
                return false;
            }
            Given::Error => {}
        }
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

    /// A call that makes an object. The place for it may be none.
    fn create<T>(
        &mut self,
        call: impl FnOnce(*mut *mut T, *mut carvel_error) -> carvel_status,
    ) -> Option<*mut T> {
        let before = std::ptr::without_provenance_mut::<T>(64);
        let mut place = [before; 2];
        let out = match (self.rarely(), self.bytes.byte()) {
            (false, _) => place.as_mut_ptr(),
            (_, 0..128) => null_mut(),
            _ => place.as_mut_ptr().wrapping_byte_add(1),
        };
        let error = self.error();
        let unread = self.given == Given::Misaligned;
        let done = {
            let status = call(out, error);
            self.answer(status)
        };
        let is_right = out == place.as_mut_ptr();
        assert!(is_right || !done);
        assert_eq!(place[1], before);
        if !is_right || unread {
            assert_eq!(place[0], before);
        } else {
            assert_eq!(done, !place[0].is_null());
            assert_ne!(place[0], before);
        }
        done.then_some(place[0])
    }

    /// A query of a struct that begins with its size, which may be another; the
    /// bytes beyond that are nobody's.
    fn ask<T: Copy>(
        &mut self,
        call: impl FnOnce(*mut T, *mut carvel_error) -> carvel_status,
    ) -> Option<T> {
        let size = self.size_of::<T>();
        let mut out = MaybeUninit::<T>::uninit();
        // SAFETY: these structs hold numbers alone, without gaps, the first one 32 bits.
        let bytes = unsafe {
            out.as_mut_ptr().write_bytes(0xa5, 1);
            out.as_mut_ptr().cast::<u32>().write(size);
            std::slice::from_raw_parts(out.as_ptr().cast::<u8>(), size_of::<T>())
        };
        let before = bytes.to_vec();
        let error = self.error();
        let status = call(out.as_mut_ptr(), error);
        let done = self.answer(status);
        // SAFETY: as above; the borrow from before the call is over.
        let bytes =
            unsafe { std::slice::from_raw_parts(out.as_ptr().cast::<u8>(), size_of::<T>()) };
        let written = if done { (size as usize).min(bytes.len()) } else { 0 };
        assert_eq!(bytes[written..], before[written..]);
        // SAFETY: as above.
        (done && written == bytes.len()).then(|| unsafe { out.assume_init() })
    }

    /// A call that fills an array of `needed` entries, of which there are more, fewer
    /// or none.
    fn fill<E: Copy>(
        &mut self,
        needed: u64,
        call: impl FnOnce(*mut E, u64, *mut carvel_error) -> carvel_status,
    ) -> Option<Vec<E>> {
        let capacity = (needed + 2).saturating_sub(self.bytes.below(5) as u64);
        let mut room = Buffer::of::<E>(capacity);
        let right = room.start::<E>();
        let out = match (self.rarely(), self.bytes.byte()) {
            (false, _) => right,
            (_, 0..128) => null_mut(),
            // Bytes are always aligned.
            _ => right.wrapping_byte_add(usize::from(align_of::<E>() > 1)),
        };
        let error = self.error();
        let possible =
            capacity >= needed && (out == right || needed == 0) && self.given != Given::Misaligned;
        let status = call(out, capacity, error);
        let done = self.answer(status);
        assert!(possible || !done);
        assert!(
            done || !possible || status == CARVEL_STATUS_OUT_OF_RESOURCES || is_refusal(status)
        );
        room.check_beyond::<E>(if done { needed } else { 0 });
        done.then(|| room.entries::<E>(needed))
    }

    /// Destroys some object, whatever was made of it or with it.
    fn destroy(&mut self) {
        fn any<T>(bytes: &mut Bytes, list: &mut Vec<*mut T>) -> *mut T {
            if list.is_empty() { null_mut() } else { list.swap_remove(bytes.below(list.len())) }
        }
        // SAFETY: taken off its list, an object is not used again; nor does any need
        // another one to live.
        unsafe {
            match self.bytes.below(6) {
                0 => carvel_context_destroy(any(&mut self.bytes, &mut self.contexts)),
                1 => carvel_scheme_destroy(any(&mut self.bytes, &mut self.schemes)),
                2 | 3 => carvel_mesh_destroy(any(&mut self.bytes, &mut self.meshes)),
                4 => carvel_refiner_destroy(any(&mut self.bytes, &mut self.refiners)),
                _ => carvel_hierarchy_destroy(any(&mut self.bytes, &mut self.hierarchies)),
            }
        }
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
        // SAFETY: valid pointers.
        let made =
            self.create(|out, error| unsafe { carvel_context_create(&raw const desc, out, error) });
        if let Some(out) = made {
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
        // SAFETY: `passes` are there unless their count is absurd.
        let made =
            self.create(|out, error| unsafe { carvel_scheme_create(&raw const desc, out, error) });
        self.schemes.extend(made);
    }

    /// A list that also tells its length, which may not lie within it.
    fn list<E: Copy>(
        &mut self,
        needed: u64,
        call: impl Fn(*mut E, u64, *mut u64, *mut carvel_error) -> carvel_status,
    ) {
        let capacity = if self.bytes.byte() & 3 == 0 {
            0
        } else {
            (needed + 2).saturating_sub(self.bytes.below(5) as u64)
        };
        let mut room = Buffer::of::<E>(capacity);
        let mut length = 77;
        let out = room.start::<E>();
        // The words of what is written: whether the rest counts is nobody's concern.
        let words = needed.min(capacity) as usize * size_of::<E>() / 8;
        let mut inside = false;
        let count = match self.bytes.byte() {
            0..40 => null_mut(),
            40..80 if words > 0 => {
                inside = true;
                room.start::<u64>().wrapping_add(self.bytes.below(words))
            }
            _ => &raw mut length,
        };
        let error = self.error();
        let unread = self.given == Given::Misaligned;
        let status = call(out, capacity, count, error);
        let done = self.answer(status);
        let fits = capacity >= needed || capacity == 0;
        if done {
            assert!(fits && !inside);
        }
        room.check_beyond::<E>(if done { needed.min(capacity) } else { 0 });
        if inside {
            assert!(unread || status == CARVEL_STATUS_OVERLAP, "status {status}");
        } else if fits && !unread {
            assert!(done || status == CARVEL_STATUS_OUT_OF_RESOURCES, "status {status}");
        }
        if done && count == &raw mut length {
            assert_eq!(length, needed);
        } else if !done && status != CARVEL_STATUS_BUFFER_TOO_SMALL {
            assert_eq!(length, 77);
        }
    }

    fn list_passes(&mut self) {
        let scheme = self.pick(|run| &run.schemes);
        let mut needed = 0;
        // SAFETY: a scheme that lives, or NULL.
        let status =
            unsafe { carvel_scheme_passes(scheme, null_mut(), 0, &raw mut needed, self.error) };
        if self.answer(status) {
            assert!(needed <= 64);
            // SAFETY: as above; the buffer has its capacity.
            self.list(needed, |out, capacity, count, error| unsafe {
                carvel_scheme_passes(scheme, out, capacity, count, error)
            });
        }
    }

    fn list_histogram(&mut self) {
        let (mesh, which) = (self.pick(|run| &run.meshes), self.number(5) as i32);
        let mut needed = 0;
        // SAFETY: a mesh that lives, or NULL.
        let status = unsafe {
            carvel_mesh_histogram(mesh, which, null_mut(), 0, &raw mut needed, self.error)
        };
        if self.answer(status) {
            // SAFETY: as above; the buffer has its capacity.
            self.list(needed, |out, capacity, count, error| unsafe {
                carvel_mesh_histogram(mesh, which, out, capacity, count, error)
            });
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
        // SAFETY: arrays are as long as their counts say, or the count is absurd.
        let made = self.create(|out, error| unsafe {
            carvel_mesh_create(context, &raw const desc, out, error)
        });
        if let Some(mesh) = made {
            // SAFETY: the context lives, or is NULL.
            assert_eq!(unsafe { carvel_context_is_cancelled(context) }, 0);
            self.keep_mesh(mesh);
        }
    }

    fn keep_mesh(&mut self, mesh: *mut carvel_mesh) {
        // SAFETY: the mesh lives.
        assert_eq!(unsafe { carvel_mesh_validate(mesh, self.error) }, 0);
        self.meshes.push(mesh);
        if self.meshes.len() > 4 {
            let old = self.meshes.remove(0);
            // SAFETY: nothing uses it any more.
            unsafe { carvel_mesh_destroy(old) };
        }
    }

    fn refiner(&mut self) {
        // SAFETY: a place to write to, or none.
        let made = self.create(|out, error| unsafe { carvel_refiner_create(out, error) });
        self.refiners.extend(made);
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
        // SAFETY: the mesh lives.
        let survey = self.ask(|out, error| unsafe { carvel_mesh_survey(mesh, out, error) });
        let arrays: [(Fill, u64); 9] = [
            (carvel_mesh_face_sizes, counts.faces),
            (carvel_mesh_face_offsets, counts.faces + 1),
            (carvel_mesh_face_vertices, counts.corners),
            (carvel_mesh_edges, 2 * counts.edges),
            (carvel_mesh_corner_edges, counts.corners),
            (carvel_mesh_corner_twins, counts.corners),
            (carvel_mesh_valences, counts.vertices),
            (carvel_mesh_face_sources, counts.faces),
            (carvel_mesh_vertex_sources, counts.vertices),
        ];
        let tags = survey.map(|survey: carvel_survey| survey.corner_tags);
        let tags = tags.map(|tags| (carvel_mesh_corner_tags as Fill, tags));
        for (array, needed) in arrays.into_iter().chain(tags) {
            // SAFETY: the buffer has its capacity, or is refused.
            self.fill(needed, |out, capacity, error| unsafe { array(mesh, out, capacity, error) });
        }
        // SAFETY: as above.
        let flags = self.fill(counts.vertices, |out: *mut u8, capacity, error| unsafe {
            carvel_mesh_boundary_flags(mesh, out, capacity, error)
        });
        assert!(flags.is_none_or(|flags| flags.iter().all(|&flag| flag <= 1)));
    }

    fn predict(&mut self) {
        let (mesh, scheme) = (self.pick(|run| &run.meshes), self.pick(|run| &run.schemes));
        let level = self.number(70) as u32;
        let (width, size) = (self.number(9) as u32, self.number(9) as u32);
        // SAFETY: valid pointers or NULL.
        self.ask(|out: *mut carvel_counts, error| unsafe {
            carvel_predict_counts(mesh, scheme, level, out, error)
        });
        // SAFETY: as above.
        self.ask(|out: *mut carvel_bytes, error| unsafe {
            carvel_predict_bytes(mesh, scheme, level, width, size, out, error)
        });
    }

    fn hierarchy(&mut self) {
        let (mesh, scheme) = (self.pick(|run| &run.meshes), self.pick(|run| &run.schemes));
        let (context, levels) = (self.context_or_null(), self.bytes.below(3) as u32);
        // SAFETY: valid pointers or NULL.
        let made = self.create(|out, error| unsafe {
            carvel_hierarchy_create(context, mesh, scheme, levels, out, error)
        });
        if let Some(hierarchy) = made {
            // SAFETY: the context lives, or is NULL.
            assert_eq!(unsafe { carvel_context_is_cancelled(context) }, 0);
            self.hierarchies.push(hierarchy);
        }
    }

    fn look_at_hierarchy(&mut self) {
        let hierarchy = self.pick(|run| &run.hierarchies);
        let level = self.number(4) as u32;
        // SAFETY: valid pointers or NULL.
        let mesh = self
            .create(|out, error| unsafe { carvel_hierarchy_mesh(hierarchy, level, out, error) });
        let Some(mesh) = mesh else { return };
        let counts = self.counts(mesh).expect("counts of a mesh");
        // SAFETY: the hierarchy lives; buffers have their capacities, or are refused.
        let vertices = self.fill(counts.vertices, |out, capacity, error| unsafe {
            carvel_hierarchy_vertex_origins(hierarchy, level, out, capacity, error)
        });
        // SAFETY: as above.
        let faces = self.fill(counts.faces, |out, capacity, error| unsafe {
            carvel_hierarchy_face_origins(hierarchy, level, out, capacity, error)
        });
        for origins in [vertices, faces].into_iter().flatten() {
            assert!(level > 0);
            assert!(origins.iter().all(|origin: &carvel_origin| (1..=6).contains(&origin.kind)));
        }
        self.rows(hierarchy, level, counts.vertices);
        if counts.faces < 2000 && self.bytes.byte() & 1 == 0 {
            // It outlives the hierarchy.
            self.keep_mesh(mesh);
        } else {
            // SAFETY: it is destroyed once.
            unsafe { carvel_mesh_destroy(mesh) };
        }
    }

    fn rows(&mut self, hierarchy: *const carvel_hierarchy, level: u32, vertices: u64) {
        let (stage, mut entries) = (self.number(3) as u32, 0);
        // SAFETY: valid pointers; the buffer has its capacity, or is refused.
        let offsets = self.fill(vertices + 1, |out: *mut u64, capacity, error| unsafe {
            let (indices, weights, count) = (null_mut(), null_mut(), &raw mut entries);
            carvel_hierarchy_rows(
                hierarchy, level, stage, out, capacity, indices, weights, 0, count, error,
            )
        });
        let Some(offsets) = offsets else { return };
        assert_eq!(offsets.last(), Some(&entries));
        let capacity = entries + 2 - (self.bytes.below(4) as u64).min(entries + 1);
        let mut room = [
            Buffer::of::<u64>(vertices + 1),
            Buffer::of::<u32>(capacity),
            Buffer::of::<f64>(capacity),
        ];
        let [out, indices, weights] = room.each_mut();
        let (out, indices, weights) = (out.start(), indices.start(), weights.start());
        let error = self.error();
        // SAFETY: as above.
        let status = unsafe {
            carvel_hierarchy_rows(
                hierarchy,
                level,
                stage,
                out,
                vertices + 1,
                indices,
                weights,
                capacity,
                null_mut(),
                error,
            )
        };
        let done = self.answer(status);
        assert!(!done || capacity >= entries);
        let written = if done { [vertices + 1, entries] } else { [0, 0] };
        room[0].check_beyond::<u64>(written[0]);
        room[1].check_beyond::<u32>(written[1]);
        room[2].check_beyond::<f64>(written[1]);
        assert!(!done || room[0].entries::<u64>(vertices + 1) == offsets);
    }

    /// How records for a number of vertices lie in memory.
    fn view<T: Number>(&mut self, count: u64, width: u64) -> View {
        let size = size_of::<T>() as u64;
        let gap = self.bytes.below(4) as u64 * size;
        let stride = if self.rarely() {
            match self.number(64) {
                // One that would be followed must be refused, or lead nowhere.
                absurd if absurd > 1 << 12 => absurd | 1 << 62,
                stride => stride,
            }
        } else if gap == 0 && self.bytes.byte() & 1 == 0 {
            0
        } else {
            width * size + gap
        };
        let pointer = match (self.rarely(), self.bytes.byte()) {
            (true, 0..60) => Pointer::Null,
            (true, 60..120) => Pointer::Misaligned,
            _ => Pointer::Right,
        };
        View { first: 0, count, width, stride, pointer }
    }

    /// Memory of the exact size for records, with something in it.
    fn room<T: Number>(&mut self, views: &[View]) -> Room<T> {
        let size = views.iter().map(View::end::<T>).max().unwrap_or(0);
        let mut memory = vec![T::default(); size].into_boxed_slice();
        for value in &mut memory {
            *value = T::number(if self.bytes.is_empty() { 1 } else { self.bytes.byte() });
        }
        let before = memory.iter().map(|value| value.bits()).collect();
        Room { memory, before }
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
        let given_view = self.view::<T>(counts.vertices + more, 3 - narrower);
        let positions = self.room::<T>(&[given_view]);
        let width = self.bytes.below(10) as u64;
        let attribute_view = self.view::<T>(counts.vertices, width);
        let attributes = self.room::<T>(&[attribute_view]);
        let attribute_count = self.bytes.below(2) as u64;
        let inputs = [attributes.input(&attribute_view)];
        let input = RefineInput::<T> {
            struct_size: self.size_of::<RefineInput<T>>(),
            levels,
            mesh,
            scheme,
            positions: positions.input(&given_view),
            attributes: if self.rarely() { null() } else { inputs.as_ptr() },
            attribute_count,
        };
        let fewer = wrong(self) / 2;
        let mut views = [
            self.view::<T>((last.vertices + 1).saturating_sub(2 * fewer), 3),
            self.view::<T>(last.vertices, width),
        ];
        // Records of both between each other, or, a place too near, into each other.
        let interleaved = width > 0 && self.bytes.byte() & 3 == 0;
        let mut too_near = false;
        let mut rooms = if interleaved {
            too_near = self.rarely();
            views[1].first = if too_near { 2 } else { 3 };
            let stride = (3 + width + self.bytes.below(3) as u64) * size_of::<T>() as u64;
            views.iter_mut().for_each(|view| view.stride = stride);
            vec![self.room::<T>(&views)]
        } else {
            vec![self.room::<T>(&views[..1]), self.room::<T>(&views[1..])]
        };
        let point_values = rooms[0].output(&views[0]);
        let outputs = [rooms.last_mut().expect("a room").output(&views[1])];
        let needed = [last.faces, last.faces + 1, last.corners, last.faces];
        let mut indices = needed.map(|n| {
            let n = (n + 1).saturating_sub(wrong(self));
            vec![FILL; n as usize].into_boxed_slice()
        });
        let (given, absent) = (self.bytes.byte(), self.rarely());
        let mut index = 0;
        let [face_sizes, face_offsets, face_vertices, face_sources] =
            indices.each_mut().map(|list| {
                index += 1;
                let wanted = given >> index & 1 != 0;
                let data = if wanted { list.as_mut_ptr() } else { null_mut() };
                // Without a pointer there is nothing to count.
                carvel_indices { data, count: if wanted || absent { list.len() as u64 } else { 0 } }
            });
        // Outputs that overlap each other must be refused.
        let overlap = self.rarely();
        let mut output = RefineOutput::<T> {
            struct_size: self.size_of::<RefineOutput<T>>(),
            anchored: -1,
            face_sizes,
            face_offsets,
            face_vertices: if overlap { face_sizes } else { face_vertices },
            face_sources,
            positions: point_values,
            attributes: outputs.as_ptr(),
            attribute_count,
        };
        let before = output;
        let error = self.error();
        // SAFETY: every buffer has its capacity, or is refused.
        let status =
            unsafe { T::REFINE(refiner, context, &raw const input, &raw mut output, error) };
        let done = self.answer(status);
        // SAFETY: the context lives, or is NULL.
        assert!(!done || unsafe { carvel_context_is_cancelled(context) } == 0);
        assert!(status != CARVEL_STATUS_OVERLAP || overlap || too_near);
        let whole = output.struct_size as usize == size_of::<RefineOutput<T>>();
        let same = RefineOutput { anchored: output.anchored, ..before };
        assert!(bytes_of(&output) == bytes_of(&same) && (done || output.anchored == -1));
        if done {
            assert!(matches!(output.anchored, 0 | 1));
            assert!(!(overlap && whole) || face_sizes.data.is_null() || last.faces == 0);
            assert!(!(too_near && whole && attribute_count == 1) || last.vertices == 0);
        }
        for (list, (index, needed)) in indices.iter().zip(needed.into_iter().enumerate()) {
            let wanted = given >> (index + 1) & 1 != 0;
            let written = if is_decided_early(status) || !wanted { 0 } else { needed };
            let beyond = list.get(written as usize..).unwrap_or_default();
            assert!(beyond.iter().all(|&x| x == FILL));
        }
        let count = if attribute_count == 1 { 2 } else { 1 };
        let written = if is_decided_early(status) { &[] } else { &views[..count] };
        match &rooms[..] {
            [both] => both.check_beside(written, last.vertices),
            [points, others] => {
                points.check_beside(written.get(..1).unwrap_or_default(), last.vertices);
                others.check_beside(written.get(1..).unwrap_or_default(), last.vertices);
            }
            _ => unreachable!("one room or two"),
        }
        if done && interleaved && whole {
            self.check_interleaved(&input, &rooms[0], &views[..count], last.vertices);
        }
    }

    /// The same values as in arrays of their own, by a refiner of its own.
    fn check_interleaved<T: Number>(
        &mut self,
        input: &RefineInput<T>,
        room: &Room<T>,
        views: &[View],
        count: u64,
    ) {
        let tight = |width| View { first: 0, count, width, stride: 0, pointer: Pointer::Right };
        let mut rooms: Vec<Room<T>> =
            views.iter().map(|view| self.room(&[tight(view.width)])).collect();
        let mut outputs = rooms.iter_mut().zip(views).map(|(r, v)| r.output(&tight(v.width)));
        let mut output = zeroed::<RefineOutput<T>>();
        output.struct_size = size_of::<RefineOutput<T>>() as u32;
        output.positions = outputs.next().expect("positions");
        let outputs: Vec<Values<T>> = outputs.collect();
        (output.attributes, output.attribute_count) = (outputs.as_ptr(), outputs.len() as u64);
        let mut refiner = null_mut();
        // SAFETY: buffers have their capacities; the input was good just now.
        let status = unsafe {
            assert_eq!(carvel_refiner_create(&raw mut refiner, self.error), 0);
            let status = T::REFINE(refiner, null(), input, &raw mut output, self.error);
            carvel_refiner_destroy(refiner);
            status
        };
        assert!(self.answer(status));
        for (tight, view) in rooms.iter().zip(views) {
            let width = view.width as usize;
            for (record, at) in tight.memory.chunks(width).zip(view.places::<T>(count)) {
                let bits = |values: &[T]| values.iter().map(|v| v.bits()).collect::<Vec<_>>();
                assert_eq!(bits(record), bits(&room.memory[at..at + width]));
            }
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
        let needed = sizes[1].vertices;
        let views = [self.view::<T>(sizes[0].vertices, width), self.view::<T>(needed, width)];
        let values = self.room::<T>(&views[..1]);
        let mut out = self.room::<T>(&views[1..]);
        let (input, output) = (values.input(&views[0]), out.output(&views[1]));
        let error = self.error();
        // SAFETY: every buffer has its capacity, or is refused.
        let status = unsafe {
            T::REFINE_LEVEL(hierarchy, context, level, &raw const input, &raw const output, error)
        };
        let done = self.answer(status);
        // SAFETY: the context lives, or is NULL.
        assert!(!done || unsafe { carvel_context_is_cancelled(context) } == 0);
        out.check_beside(if is_decided_early(status) { &[] } else { &views[1..] }, needed);
    }
}

/// Whether a call was refused for what it was given.
fn is_refusal(status: carvel_status) -> bool {
    matches!(status, CARVEL_STATUS_PARAMETER_OUT_OF_RANGE | CARVEL_STATUS_TOO_LARGE)
}

/// The bytes of a struct of the interface; none has gaps.
fn bytes_of<T: Copy>(value: &T) -> &[u8] {
    // SAFETY: all bytes of the value are initialised.
    unsafe { std::slice::from_raw_parts(std::ptr::from_ref(value).cast(), size_of::<T>()) }
}

/// A buffer of entries of numbers, filled with a pattern; of its exact size.
struct Buffer {
    memory: *mut u8,
    layout: Layout,
}

impl Buffer {
    fn of<E>(entries: u64) -> Self {
        let layout = Layout::array::<E>(entries as usize).expect("a small array");
        let layout = layout.align_to(8).expect("an alignment");
        if layout.size() == 0 {
            return Self { memory: std::ptr::without_provenance_mut(64), layout };
        }
        // SAFETY: the size is not 0; all of it is written.
        let memory = unsafe {
            let memory = alloc(layout);
            assert!(!memory.is_null());
            memory.write_bytes(0xa5, layout.size());
            memory
        };
        Self { memory, layout }
    }

    fn start<E>(&mut self) -> *mut E {
        self.memory.cast()
    }

    fn bytes(&self) -> &[u8] {
        // SAFETY: the memory is there, and all of it was written.
        unsafe { std::slice::from_raw_parts(self.memory, self.layout.size()) }
    }

    /// Nothing was written after so many entries.
    fn check_beyond<E>(&self, entries: u64) {
        let beyond = &self.bytes()[entries as usize * size_of::<E>()..];
        assert!(beyond.iter().all(|&byte| byte == 0xa5));
    }

    fn entries<E: Copy>(&self, count: u64) -> Vec<E> {
        assert!(count as usize * size_of::<E>() <= self.layout.size());
        // SAFETY: so many are there, aligned, and entries are numbers.
        (0..count as usize).map(|i| unsafe { self.memory.cast::<E>().add(i).read() }).collect()
    }
}

impl Drop for Buffer {
    fn drop(&mut self) {
        if self.layout.size() > 0 {
            // SAFETY: had from there, with this layout.
            unsafe { dealloc(self.memory, self.layout) };
        }
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

#[derive(Clone, Copy, PartialEq)]
enum Pointer {
    Right,
    Null,
    Misaligned,
}

/// Records in memory, as a caller describes them.
#[derive(Clone, Copy)]
struct View {
    /// The place of the first value, counted in values.
    first: usize,
    count: u64,
    width: u64,
    stride: u64,
    pointer: Pointer,
}

impl View {
    /// Values from record to record.
    fn step<T>(&self) -> usize {
        if self.stride == 0 { self.width as usize } else { self.stride as usize / size_of::<T>() }
    }

    /// The place of every record of so many.
    fn places<T>(&self, count: u64) -> impl Iterator<Item = usize> + use<T> {
        let (first, step) = (self.first, self.step::<T>());
        (0..count as usize).map(move |i| first + i * step)
    }

    /// The end of the last record. What is absurd is refused, and never followed.
    fn end<T>(&self) -> usize {
        let width = self.width as usize;
        match self.count {
            0 => 0,
            count if self.stride < 1 << 13 => {
                let last =
                    (count - 1) as usize * self.stride.div_ceil(size_of::<T>() as u64) as usize;
                self.first + last.max((count - 1) as usize * self.step::<T>()) + width
            }
            _ => self.first + width,
        }
    }

    fn place<T>(&self, start: *const T) -> *const T {
        match self.pointer {
            Pointer::Right => start.wrapping_add(self.first),
            Pointer::Null => null(),
            Pointer::Misaligned => start.wrapping_add(self.first).wrapping_byte_add(1),
        }
    }
}

/// Memory of records, and what was in it.
struct Room<T> {
    memory: Box<[T]>,
    before: Vec<u64>,
}

impl<T: Number> Room<T> {
    fn input(&self, view: &View) -> ConstValues<T> {
        let View { count, width, stride, .. } = *view;
        ConstValues { data: view.place(self.memory.as_ptr()), count, width, stride }
    }

    fn output(&mut self, view: &View) -> Values<T> {
        let View { count, width, stride, .. } = *view;
        let data = view.place(self.memory.as_mut_ptr().cast_const()).cast_mut();
        Values { data, count, width, stride }
    }

    /// Nothing was written but to so many records of these.
    fn check_beside(&self, views: &[View], count: u64) {
        let mut own = vec![false; self.memory.len()];
        for view in views {
            let count = if view.stride < 1 << 13 { count.min(view.count) } else { count.min(1) };
            for at in view.places::<T>(count) {
                let end = (at + view.width as usize).min(own.len());
                own[at.min(end)..end].fill(true);
            }
        }
        let beside = own.iter().zip(self.memory.iter().zip(&self.before));
        assert!(beside.filter(|(own, _)| !**own).all(|(_, (now, then))| now.bits() == *then));
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
    fn bits(self) -> u64;
}

impl Number for f32 {
    const REFINE: Refine<Self> = carvel_refiner_refine_f32;
    const REFINE_LEVEL: RefineLevel<Self> = carvel_hierarchy_refine_f32;
    fn number(byte: u8) -> Self {
        [f32::NAN, f32::MAX].get(usize::from(byte)).copied().unwrap_or(f32::from(byte))
    }
    fn bits(self) -> u64 {
        self.to_bits().into()
    }
}

impl Number for f64 {
    const REFINE: Refine<Self> = carvel_refiner_refine_f64;
    const REFINE_LEVEL: RefineLevel<Self> = carvel_hierarchy_refine_f64;
    fn number(byte: u8) -> Self {
        [f64::NAN, f64::MAX].get(usize::from(byte)).copied().unwrap_or(f64::from(byte))
    }
    fn bits(self) -> u64 {
        self.to_bits()
    }
}
