//! Memory as callers have it: of its exact size, with gaps, filled with a pattern.

use carvel::capi::*;
use std::alloc::{Layout, alloc, dealloc};
use std::ptr::null;

/// The bytes of a struct of the interface; none has gaps.
pub fn bytes_of<T: Copy>(value: &T) -> &[u8] {
    // SAFETY: all bytes of the value are initialised.
    unsafe { std::slice::from_raw_parts(std::ptr::from_ref(value).cast(), size_of::<T>()) }
}

/// A buffer of entries of numbers, filled with a pattern; of its exact size.
pub struct Buffer {
    pub memory: *mut u8,
    pub layout: Layout,
}

impl Buffer {
    pub fn of<E>(entries: u64) -> Self {
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

    pub fn start<E>(&mut self) -> *mut E {
        self.memory.cast()
    }

    pub fn bytes(&self) -> &[u8] {
        // SAFETY: the memory is there, and all of it was written.
        unsafe { std::slice::from_raw_parts(self.memory, self.layout.size()) }
    }

    /// Nothing was written after so many entries.
    pub fn check_beyond<E>(&self, entries: u64) {
        let beyond = &self.bytes()[entries as usize * size_of::<E>()..];
        assert!(beyond.iter().all(|&byte| byte == 0xa5));
    }

    pub fn entries<E: Copy>(&self, count: u64) -> Vec<E> {
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

/// What buffers hold before a call.
pub const FILL: u32 = 0xa5a5_a5a5;

/// A struct of numbers and pointers that is all zero.
pub fn zeroed<T: Copy>() -> T {
    // SAFETY: only used for the interface's structs, for which zero is a value.
    unsafe { std::mem::zeroed() }
}

#[derive(Clone, Copy, PartialEq)]
pub enum Pointer {
    Right,
    Null,
    Misaligned,
}

/// Records in memory, as a caller describes them.
#[derive(Clone, Copy)]
pub struct View {
    /// The place of the first value, counted in values.
    pub first: usize,
    pub count: u64,
    pub width: u64,
    pub stride: u64,
    pub pointer: Pointer,
}

impl View {
    /// Values from record to record.
    pub fn step<T>(&self) -> usize {
        if self.stride == 0 { self.width as usize } else { self.stride as usize / size_of::<T>() }
    }

    /// The place of every record of so many.
    pub fn places<T>(&self, count: u64) -> impl Iterator<Item = usize> + use<T> {
        let (first, step) = (self.first, self.step::<T>());
        (0..count as usize).map(move |i| first + i * step)
    }

    /// The end of the last record. What is absurd is refused, and never followed.
    pub fn end<T>(&self) -> usize {
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

    pub fn place<T>(&self, start: *const T) -> *const T {
        match self.pointer {
            Pointer::Right => start.wrapping_add(self.first),
            Pointer::Null => null(),
            Pointer::Misaligned => start.wrapping_add(self.first).wrapping_byte_add(1),
        }
    }
}

/// Memory of records, and what was in it.
pub struct Room<T> {
    pub memory: Box<[T]>,
    pub before: Vec<u64>,
}

impl<T: Number> Room<T> {
    pub fn input(&self, view: &View) -> ConstValues<T> {
        let View { count, width, stride, .. } = *view;
        ConstValues { data: view.place(self.memory.as_ptr()), count, width, stride }
    }

    pub fn output(&mut self, view: &View) -> Values<T> {
        let View { count, width, stride, .. } = *view;
        let data = view.place(self.memory.as_mut_ptr().cast_const()).cast_mut();
        Values { data, count, width, stride }
    }

    /// Nothing was written but to so many records of these.
    pub fn check_beside(&self, views: &[View], count: u64) {
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

pub type Refine<T> = unsafe extern "C" fn(
    *mut carvel_refiner,
    *const carvel_context,
    *const RefineInput<T>,
    *mut RefineOutput<T>,
    *mut carvel_error,
) -> carvel_status;
pub type Interpolate<T> = unsafe extern "C" fn(
    *const carvel_hierarchy,
    *const carvel_context,
    u32,
    i32,
    *const ConstValues<T>,
    *const Values<T>,
    *mut carvel_error,
) -> carvel_status;
pub type RefineLevel<T> = unsafe extern "C" fn(
    *const carvel_hierarchy,
    *const carvel_context,
    u32,
    *const ConstValues<T>,
    *const Values<T>,
    *mut carvel_error,
) -> carvel_status;

pub trait Number: Copy + Default {
    const REFINE: Refine<Self>;
    const REFINE_LEVEL: RefineLevel<Self>;
    const INTERPOLATE: Interpolate<Self>;
    fn number(byte: u8) -> Self;
    fn bits(self) -> u64;
}

impl Number for f32 {
    const REFINE: Refine<Self> = carvel_refiner_refine_f32;
    const REFINE_LEVEL: RefineLevel<Self> = carvel_hierarchy_refine_f32;
    const INTERPOLATE: Interpolate<Self> = carvel_hierarchy_interpolate_f32;
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
    const INTERPOLATE: Interpolate<Self> = carvel_hierarchy_interpolate_f64;
    fn number(byte: u8) -> Self {
        [f64::NAN, f64::MAX].get(usize::from(byte)).copied().unwrap_or(f64::from(byte))
    }
    fn bits(self) -> u64 {
        self.to_bits()
    }
}
