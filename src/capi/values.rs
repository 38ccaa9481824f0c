//! Records with a stride: in place where they lie one after the other, through a
//! copy where they do not.

use super::buffer::{Name, Span, check_capacity, check_extent, check_pointer};
use super::status::{
    CARVEL_STATUS_INVALID_STRIDE, CARVEL_STATUS_LENGTH_MISMATCH, CARVEL_STATUS_MISALIGNED, Fault,
    Result,
};
use crate::base::{Scalar, memory};
use crate::hierarchy::{Interpolation, WIDEST};
use crate::sparse;

#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct ConstValues<T> {
    pub data: *const T,
    pub count: u64,
    pub width: u64,
    pub stride: u64,
}

#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct Values<T> {
    pub data: *mut T,
    pub count: u64,
    pub width: u64,
    pub stride: u64,
}

pub type carvel_const_values_f32 = ConstValues<f32>;
pub type carvel_const_values_f64 = ConstValues<f64>;
pub type carvel_values_f32 = Values<f32>;
pub type carvel_values_f64 = Values<f64>;

pub const CARVEL_INTERPOLATION_VERTEX: i32 = 0;
pub const CARVEL_INTERPOLATION_VARYING: i32 = 1;

pub(super) fn interpolation(kind: i32) -> Result<Interpolation> {
    match kind {
        CARVEL_INTERPOLATION_VERTEX => Ok(Interpolation::Vertex),
        CARVEL_INTERPOLATION_VARYING => Ok(Interpolation::Varying),
        other => Err(Fault::out_of_range(format!("there is no interpolation {other}"))),
    }
}

#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct carvel_indices {
    pub data: *mut u32,
    pub count: u64,
}

/// Records of the caller's whose pointer, size and stride have been checked.
#[derive(Clone, Copy)]
pub(super) struct Records<P> {
    data: P,
    /// The number that is read or written.
    count: usize,
    pub(super) width: usize,
    /// In bytes.
    stride: usize,
    name: Name,
}

impl<T: Scalar> ConstValues<T> {
    /// Checks the records of an input with one for each of `vertices`.
    pub(super) fn check(&self, vertices: u64, name: Name) -> Result<Records<*const T>> {
        if self.count != vertices {
            return Err(Fault::new(
                CARVEL_STATUS_LENGTH_MISMATCH,
                format!("{name}: {} records for {vertices} vertices", self.count),
            ));
        }
        check_width(self.width, name)?;
        let stride = check_records::<T>(self.data, self.count, self.width, self.stride, name)?;
        let (count, width) = (self.count as usize, self.width as usize);
        Ok(Records { data: self.data, count, width, stride, name })
    }

    /// Checks the positions of vertices.
    pub(super) fn check_positions(&self, vertices: u64, name: Name) -> Result<Records<*const T>> {
        let records = self.check(vertices, name)?;
        if records.width == 3 {
            return Ok(records);
        }
        let message = format!("{name}: the width is {}, not 3", records.width);
        Err(Fault::new(CARVEL_STATUS_LENGTH_MISMATCH, message))
    }
}

impl<T: Scalar> Values<T> {
    /// Bytes that a copy of `needed` records takes, if they have gaps.
    pub(super) fn copy_bytes(&self, needed: u64) -> u64 {
        let record = self.width.saturating_mul(T::BYTES);
        let has_gaps = self.stride != 0 && self.stride != record;
        if has_gaps { record.saturating_mul(needed) } else { 0 }
    }

    /// Checks the records of an output that takes `needed` of a width.
    pub(super) fn check(&self, needed: u64, width: usize, name: Name) -> Result<Records<*mut T>> {
        if self.width != width as u64 {
            return Err(Fault::new(
                CARVEL_STATUS_LENGTH_MISMATCH,
                format!("{name}: the width is {}, that of the input is {width}", self.width),
            ));
        }
        check_capacity(self.count, needed, name)?;
        let stride = check_records::<T>(self.data, needed, self.width, self.stride, name)?;
        Ok(Records { data: self.data, count: needed as usize, width, stride, name })
    }
}

fn check_width(width: u64, name: Name) -> Result<()> {
    if (1..=WIDEST as u64).contains(&width) {
        return Ok(());
    }
    Err(Fault::out_of_range(format!("{name}: the width {width} is not within 1 and {WIDEST}")))
}

/// Checks pointer, stride and extent; returns the stride in bytes.
fn check_records<T>(
    data: *const T,
    count: u64,
    width: u64,
    stride: u64,
    name: Name,
) -> Result<usize> {
    let record = width * size_of::<T>() as u64;
    let stride = if stride == 0 { record } else { stride };
    if stride < record {
        return Err(Fault::new(
            CARVEL_STATUS_INVALID_STRIDE,
            format!("{name}: a stride of {stride} bytes for records of {record}"),
        ));
    }
    if !stride.is_multiple_of(align_of::<T>() as u64) {
        return Err(Fault::new(
            CARVEL_STATUS_MISALIGNED,
            format!("{name}: a stride of {stride} is no multiple of {}", align_of::<T>()),
        ));
    }
    if count > 0 {
        check_pointer(data, name)?;
        check_extent(data.addr(), count, stride, name)?;
    }
    Ok(stride as usize)
}

impl<P> Records<P> {
    /// Values from the first record to the end of the last, gaps counted in.
    fn reach<T>(&self) -> usize {
        let before = self.count.saturating_sub(1) * (self.stride / size_of::<T>());
        if self.count == 0 { 0 } else { before + self.width }
    }

    /// The stride in values, of which it need not be a multiple where doubles are
    /// aligned to four bytes.
    fn stride_in_values<T>(&self) -> Result<usize> {
        if self.stride.is_multiple_of(size_of::<T>()) {
            return Ok(self.stride / size_of::<T>());
        }
        Err(Fault::new(
            CARVEL_STATUS_MISALIGNED,
            format!("{}: a stride of {} is no multiple of a value", self.name, self.stride),
        ))
    }

    fn len(&self) -> usize {
        self.count * self.width
    }

    fn record_bytes<T>(&self) -> usize {
        self.width * size_of::<T>()
    }

    fn is_tight<T>(&self) -> bool {
        self.count == 0 || self.stride == self.record_bytes::<T>()
    }

    /// Bytes that a copy takes, if one is needed.
    pub(super) fn copy_bytes<T>(&self) -> u64 {
        if self.is_tight::<T>() { 0 } else { (self.len() * size_of::<T>()) as u64 }
    }

    fn span<T>(&self, start: usize, written: bool) -> Span {
        let (record, period) = (self.record_bytes::<T>(), self.stride);
        Span { start, record, period, count: self.count, written, name: self.name }
    }
}

/// Values to read: the caller's, or a copy without gaps.
pub(super) enum Source<'a, T> {
    Lent(&'a [T]),
    Copied(Vec<T>),
}

impl<T> Source<'_, T> {
    pub(super) fn values(&self) -> &[T] {
        match self {
            Self::Lent(values) => values,
            Self::Copied(values) => values,
        }
    }
}

impl<T: Scalar> Records<*const T> {
    pub(super) fn read_span(&self) -> Span {
        self.span::<T>(self.data.addr(), false)
    }

    /// The values, one record after the other.
    ///
    /// # Safety
    /// The records can be read, and are not written, as long as the result lives.
    pub(super) unsafe fn read<'a>(&self) -> Result<Source<'a, T>> {
        if self.count == 0 {
            return Ok(Source::Lent(&[]));
        }
        if self.is_tight::<T>() {
            // SAFETY: checked by `check`; the rest is the contract.
            return Ok(Source::Lent(unsafe { std::slice::from_raw_parts(self.data, self.len()) }));
        }
        let mut values = memory::zeroed::<T>(self.len())?;
        for (i, record) in values.chunks_exact_mut(self.width).enumerate() {
            // SAFETY: record i is within what `check` has checked; aligned, since
            // the pointer and the stride are.
            let from = unsafe {
                std::slice::from_raw_parts(self.data.byte_add(i * self.stride), self.width)
            };
            record.copy_from_slice(from);
        }
        Ok(Source::Copied(values))
    }
}

impl<T: Scalar> Records<*const T> {
    /// The records where they are, gaps and all.
    ///
    /// # Safety
    /// Everything from the first record to the last can be read, and is not written, as
    /// long as the result lives.
    pub(super) unsafe fn strided<'a>(&self) -> Result<sparse::Records<'a, T>> {
        let (stride, width, len) = (self.stride_in_values::<T>()?, self.width, self.reach::<T>());
        if len == 0 {
            return Ok(sparse::Records { values: &[], width, stride });
        }
        // SAFETY: checked by `check`; the rest is the contract.
        let values = unsafe { std::slice::from_raw_parts(self.data, len) };
        Ok(sparse::Records { values, width, stride })
    }
}

impl<T: Scalar> Records<*mut T> {
    /// The records where they are, gaps and all.
    ///
    /// # Safety
    /// Everything from the first record to the last can be written, and is not used
    /// otherwise, as long as the result lives.
    pub(super) unsafe fn strided<'a>(&self) -> Result<sparse::RecordsMut<'a, T>> {
        let (stride, width, len) = (self.stride_in_values::<T>()?, self.width, self.reach::<T>());
        if len == 0 {
            return Ok(sparse::RecordsMut { values: &mut [], width, stride });
        }
        // SAFETY: checked by `check`; the rest is the contract.
        let values = unsafe { std::slice::from_raw_parts_mut(self.data, len) };
        Ok(sparse::RecordsMut { values, width, stride })
    }
}

/// Where values go: the caller's buffer, or a copy that is spread out at the end.
pub(super) enum Sink<'a, T> {
    Lent(&'a mut [T]),
    Copied(Vec<T>, Records<*mut T>),
}

impl<T: Scalar> Records<*mut T> {
    pub(super) fn write_span(&self) -> Span {
        self.span::<T>(self.data.addr(), true)
    }

    /// Prepares the buffer for writing.
    ///
    /// # Safety
    /// The records can be written, and are not used otherwise, as long as the
    /// result lives.
    pub(super) unsafe fn sink<'a>(self) -> Result<Sink<'a, T>> {
        if self.count == 0 {
            return Ok(Sink::Lent(&mut []));
        }
        if self.is_tight::<T>() {
            // SAFETY: checked by `check`; the rest is the contract.
            let values = unsafe { std::slice::from_raw_parts_mut(self.data, self.len()) };
            return Ok(Sink::Lent(values));
        }
        Ok(Sink::Copied(memory::zeroed::<T>(self.len())?, self))
    }
}

impl<T: Scalar> Sink<'_, T> {
    /// The values, one record after the other.
    pub(super) fn values(&mut self) -> &mut [T] {
        match self {
            Self::Lent(values) => values,
            Self::Copied(values, _) => values,
        }
    }

    /// Spreads a copy out; the bytes between records stay as they are.
    ///
    /// # Safety
    /// As [`Records::sink`].
    pub(super) unsafe fn finish(self) {
        let Self::Copied(values, to) = self else { return };
        for (i, record) in values.chunks_exact(to.width).enumerate() {
            // SAFETY: as in `Records::read`; records may lie between those of
            // another output, so no slice spans more than one of them.
            unsafe {
                let out = to.data.byte_add(i * to.stride);
                out.copy_from_nonoverlapping(record.as_ptr(), to.width);
            }
        }
    }
}
