//! Values of any width at any stride.

use crate::base::{Error, ErrorKind, Result};

/// The most values of a record.
const WIDEST: usize = 1 << 16;

/// Records to be read: `width` values each, the first ones `stride` values apart.
#[derive(Debug, Clone, Copy)]
pub struct Records<'a, T> {
    /// The values; what lies between records is not looked at.
    pub values: &'a [T],
    /// Values per record, 1 to 65536.
    pub width: usize,
    /// Values from a record to the next, at least the width.
    pub stride: usize,
}

impl<'a, T> Records<'a, T> {
    /// Records without gaps.
    pub fn packed(values: &'a [T], width: usize) -> Self {
        Self { values, width, stride: width }
    }

    pub(super) fn check(&self, records: usize) -> Result<()> {
        check("values", self.values.len(), self.width, self.stride, records)
    }
}

/// Records to be written: `width` values each, the first ones `stride` values apart.
#[derive(Debug)]
pub struct RecordsMut<'a, T> {
    /// The values; what lies between records stays as it is.
    pub values: &'a mut [T],
    /// Values per record, 1 to 65536.
    pub width: usize,
    /// Values from a record to the next, at least the width.
    pub stride: usize,
}

impl<'a, T> RecordsMut<'a, T> {
    /// Records without gaps.
    pub fn packed(values: &'a mut [T], width: usize) -> Self {
        Self { values, width, stride: width }
    }

    pub(super) fn check(&self, records: usize) -> Result<()> {
        check("output", self.values.len(), self.width, self.stride, records)
    }
}

/// The number of values that records take, `None` past the address space.
pub(super) fn span(width: usize, stride: usize, records: usize) -> Option<usize> {
    let Some(before) = records.checked_sub(1) else { return Some(0) };
    before.checked_mul(stride)?.checked_add(width)
}

/// Refuses records of different widths.
pub(super) fn check_widths(read: usize, written: usize) -> Result<()> {
    if read == written {
        return Ok(());
    }
    let message = format!("values of width {read}, output of width {written}");
    Err(Error::new(ErrorKind::ParameterOutOfRange, message))
}

fn check(name: &str, len: usize, width: usize, stride: usize, records: usize) -> Result<()> {
    if !(1..=WIDEST).contains(&width) || stride < width {
        let message = format!("{name}: width {width} at stride {stride}");
        return Err(Error::new(ErrorKind::ParameterOutOfRange, message));
    }
    // Packed records must fit to the value; behind the last one with a gap there may be one.
    let exact = records.checked_mul(stride);
    if span(width, stride, records) == Some(len) || exact == Some(len) {
        return Ok(());
    }
    let message =
        format!("{name}: {len} values for {records} records of {width} at stride {stride}");
    Err(Error::new(ErrorKind::LengthMismatch, message))
}
