//! A buffered, counting writer that formats numbers.

use super::watch::Watch;
use super::{BUFFER, Precision, WriteOptions, place};
use crate::base::{Error, ErrorKind, Result};
use std::io::Write;

/// Where a writer puts its bytes.
pub(super) struct Sink<'a, W> {
    writer: W,
    watch: Watch<'a>,
    name: String,
    precision: Precision,
    buffer: Vec<u8>,
    digits: ryu::Buffer,
}

impl<'a, W: Write> Sink<'a, W> {
    pub fn new(writer: W, name: &str, options: &WriteOptions<'a>) -> Self {
        Self {
            writer,
            watch: Watch::new(options.progress, None),
            name: place::one_line(name),
            precision: options.precision,
            buffer: Vec::with_capacity(BUFFER),
            digits: ryu::Buffer::new(),
        }
    }

    /// The number type that was asked for.
    pub fn precision(&self) -> Precision {
        self.precision
    }

    /// Tells the progress hook how much there will be.
    pub fn expect(&mut self, total: u64) {
        self.watch.set_total(total);
    }

    /// An error about what is being written.
    #[cold]
    pub fn error(&self, kind: ErrorKind, reason: impl std::fmt::Display) -> Error {
        Error::new(kind, format!("{}: {reason}", self.name))
    }

    /// Appends bytes as they are.
    #[inline]
    pub fn put(&mut self, bytes: impl AsRef<[u8]>) {
        self.buffer.extend_from_slice(bytes.as_ref());
    }

    /// Appends a number in decimal.
    #[inline]
    pub fn put_integer(&mut self, mut value: u64) {
        let mut digits = [0; 20];
        let mut at = digits.len();
        loop {
            at -= 1;
            digits[at] = b'0' + (value % 10) as u8;
            value /= 10;
            if value == 0 {
                break;
            }
        }
        self.put(&digits[at..]);
    }

    /// Appends the shortest digits that read back as the same number of the
    /// precision asked for; whole numbers without a point.
    #[inline]
    pub fn put_float(&mut self, value: f64) -> Result<()> {
        let text = format(&mut self.digits, self.precision, value);
        let Some(text) = text else { return Err(self.overflow(value)) };
        let text = text.strip_suffix(".0").unwrap_or(text);
        self.buffer.extend_from_slice(text.as_bytes());
        Ok(())
    }

    /// Like [`Self::put_float`], but never without point or exponent.
    pub fn put_pointed(&mut self, value: f64) -> Result<()> {
        let text = format(&mut self.digits, self.precision, value);
        let Some(text) = text else { return Err(self.overflow(value)) };
        self.buffer.extend_from_slice(text.as_bytes());
        Ok(())
    }

    /// Like [`Self::put_float`], in another precision for once.
    pub fn put_float_as(&mut self, precision: Precision, value: f64) -> Result<()> {
        let usual = std::mem::replace(&mut self.precision, precision);
        let result = self.put_float(value);
        self.precision = usual;
        result
    }

    /// Ends a line, in place of the blank that the last number left.
    pub fn end_line(&mut self) {
        if self.buffer.last() == Some(&b' ') {
            self.buffer.pop();
        }
        self.buffer.push(b'\n');
    }

    /// Appends numbers, each after a blank.
    #[inline]
    pub fn put_floats(&mut self, values: &[f64]) -> Result<()> {
        values.iter().try_for_each(|&value| {
            self.put(b" ");
            self.put_float(value)
        })
    }

    /// The error of a number that single precision cannot hold.
    #[cold]
    pub fn overflow(&self, value: f64) -> Error {
        self.error(ErrorKind::Overflow, format!("{value:e} is too large for single precision"))
    }

    /// To be called between records: passes a full buffer on.
    #[inline]
    pub fn pause(&mut self) -> Result<()> {
        if self.buffer.len() < BUFFER - 4096 { Ok(()) } else { self.flush() }
    }

    /// Writes what is left.
    pub fn finish(mut self) -> Result<()> {
        self.flush()?;
        self.writer.flush().map_err(|e| Error::io(&self.name, e))?;
        self.watch.report(&self.name)
    }

    fn flush(&mut self) -> Result<()> {
        self.writer.write_all(&self.buffer).map_err(|e| Error::io(&self.name, e))?;
        let bytes = self.buffer.len() as u64;
        self.buffer.clear();
        self.watch.advance(bytes, &self.name)
    }
}

/// The shortest digits; `None` if the precision cannot hold the number.
#[inline]
fn format(digits: &mut ryu::Buffer, precision: Precision, value: f64) -> Option<&str> {
    match precision {
        Precision::F64 => Some(digits.format_finite(value)),
        Precision::F32 => {
            let single = value as f32;
            single.is_finite().then(|| digits.format_finite(single))
        }
    }
}
