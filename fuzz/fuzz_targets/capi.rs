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

#[path = "capi/hierarchies.rs"]
mod hierarchies;
#[path = "capi/memory.rs"]
mod memory;
#[path = "capi/meshes.rs"]
mod meshes;
#[path = "capi/refining.rs"]
mod refining;
#[path = "capi/schemes.rs"]
mod schemes;
mod soup;

use carvel::capi::*;
use memory::Buffer;
use soup::Bytes;
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
    channels: Vec<*mut carvel_channel>,
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
    matches!(status, 0..=17 | CARVEL_STATUS_UNSUPPORTED | 101..=107)
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
            self.channels.iter().for_each(|&channel| carvel_channel_destroy(channel));
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
        let (channels, refiners, hierarchies) = (Vec::new(), Vec::new(), Vec::new());
        let given = Given::Error;
        Self { bytes, error, given, contexts, schemes, meshes, channels, refiners, hierarchies }
    }

    fn step(&mut self) {
        match self.bytes.below(22) {
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
            18 => self.list_holes(),
            19 | 20 => self.channel(),
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
            match self.bytes.below(7) {
                0 => carvel_context_destroy(any(&mut self.bytes, &mut self.contexts)),
                1 => carvel_scheme_destroy(any(&mut self.bytes, &mut self.schemes)),
                2 | 3 => carvel_mesh_destroy(any(&mut self.bytes, &mut self.meshes)),
                4 => carvel_channel_destroy(any(&mut self.bytes, &mut self.channels)),
                5 => carvel_refiner_destroy(any(&mut self.bytes, &mut self.refiners)),
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
}

/// Whether a call was refused for what it was given.
fn is_refusal(status: carvel_status) -> bool {
    matches!(status, CARVEL_STATUS_PARAMETER_OUT_OF_RANGE | CARVEL_STATUS_TOO_LARGE)
}
