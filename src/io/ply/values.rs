//! The numbers of the rows, from text or bytes.

use crate::base::{Error, ErrorKind, Result};
use crate::io::NumberType;
use crate::io::bytes::Bytes;
use crate::io::lines::{Lines, Words};
use crate::io::number::{float, integer};
use crate::io::place::{Place, quote};
use std::io::BufRead;

/// A source of rows of numbers.
pub(super) trait Values {
    /// Goes to the next row; `None` at the end of the file.
    fn begin_row(&mut self) -> Result<Option<Place<'_>>>;

    /// The next number of the row, which is finite; `None` if the file ends.
    fn number(&mut self, kind: NumberType) -> Result<Option<f64>>;

    /// Checks that the row has no further numbers.
    fn end_row(&mut self) -> Result<()>;

    /// Where the reading is.
    fn place(&self) -> Place<'_>;

    /// Reads to the end; true if there was something left.
    fn finish(&mut self) -> Result<bool>;
}

/// Rows of text, one a line.
pub(super) struct Text<'a, R> {
    lines: Lines<'a, R>,
    at: usize,
}

impl<'a, R: BufRead> Text<'a, R> {
    pub fn new(lines: Lines<'a, R>) -> Self {
        Self { lines, at: 0 }
    }

    fn words(&self) -> Words<'_> {
        Words::new(&self.lines.text()[self.at..])
    }
}

impl<R: BufRead> Values for Text<'_, R> {
    fn begin_row(&mut self) -> Result<Option<Place<'_>>> {
        self.at = 0;
        while self.lines.advance()? {
            if !self.words().is_empty() {
                return Ok(Some(self.lines.place()));
            }
        }
        Ok(None)
    }

    fn number(&mut self, kind: NumberType) -> Result<Option<f64>> {
        let place = self.lines.place();
        let mut words = self.words();
        let Some(word) = words.next() else {
            return Err(place.syntax("the line ends before all properties are there"));
        };
        let value = match kind.range() {
            Some(range) => whole(place, word, kind, range)?,
            None if kind == NumberType::F32 => single(place, word)?,
            None => float(place, word)?,
        };
        self.at = self.lines.text().len() - words.len();
        Ok(Some(value))
    }

    fn end_row(&mut self) -> Result<()> {
        match self.words().next() {
            None => Ok(()),
            Some(word) => Err(self.lines.place().unexpected(word, "the end of the line")),
        }
    }

    fn place(&self) -> Place<'_> {
        self.lines.place()
    }

    fn finish(&mut self) -> Result<bool> {
        let left = self.begin_row()?.is_some();
        self.lines.finish()?;
        Ok(left)
    }
}

fn whole(place: Place<'_>, word: &[u8], kind: NumberType, range: (i64, i64)) -> Result<f64> {
    match integer(word) {
        Some(value) if (range.0..=range.1).contains(&value) => Ok(value as f64),
        Some(_) => Err(place.syntax(format!("{} does not fit a {}", quote(word), kind.name()))),
        None => Err(place.unexpected(word, "a whole number")),
    }
}

/// Rounded to single precision as the header has it, so that text and binary
/// files with the same content read the same.
fn single(place: Place<'_>, word: &[u8]) -> Result<f64> {
    let parsed = std::str::from_utf8(word).ok().and_then(|text| text.parse::<f32>().ok());
    match parsed {
        Some(value) if value.is_finite() => Ok(f64::from(value)),
        // Either this says what is wrong or the number is beyond single only.
        _ => float(place, word).and_then(|_| {
            let reason = format!("{} is too large for a float", quote(word));
            Err(place.error(ErrorKind::Overflow, reason))
        }),
    }
}

/// Rows of bytes, one after another.
pub(super) struct Binary<'a, R> {
    bytes: Bytes<'a, R>,
    big_endian: bool,
}

impl<'a, R: BufRead> Binary<'a, R> {
    pub fn new(bytes: Bytes<'a, R>, big_endian: bool) -> Self {
        Self { bytes, big_endian }
    }

    /// The next `N` bytes, the least significant first.
    #[inline]
    fn little<const N: usize>(&mut self) -> Result<Option<[u8; N]>> {
        let mut array = self.bytes.array::<N>()?;
        if self.big_endian
            && let Some(array) = &mut array
        {
            array.reverse();
        }
        Ok(array)
    }
}

impl<R: BufRead> Values for Binary<'_, R> {
    fn begin_row(&mut self) -> Result<Option<Place<'_>>> {
        Ok(Some(self.bytes.place()))
    }

    #[inline]
    fn number(&mut self, kind: NumberType) -> Result<Option<f64>> {
        let value = match kind {
            NumberType::I8 => self.little()?.map(i8::from_le_bytes).map(f64::from),
            NumberType::U8 => self.little()?.map(u8::from_le_bytes).map(f64::from),
            NumberType::I16 => self.little()?.map(i16::from_le_bytes).map(f64::from),
            NumberType::U16 => self.little()?.map(u16::from_le_bytes).map(f64::from),
            NumberType::I32 => self.little()?.map(i32::from_le_bytes).map(f64::from),
            NumberType::U32 => self.little()?.map(u32::from_le_bytes).map(f64::from),
            NumberType::F32 => self.little()?.map(f32::from_le_bytes).map(f64::from),
            NumberType::F64 => self.little()?.map(f64::from_le_bytes),
        };
        match value {
            Some(value) if !value.is_finite() => Err(not_finite(self.bytes.place(), value)),
            value => Ok(value),
        }
    }

    fn end_row(&mut self) -> Result<()> {
        Ok(())
    }

    fn place(&self) -> Place<'_> {
        self.bytes.place()
    }

    fn finish(&mut self) -> Result<bool> {
        self.bytes.finish().map(|left| left > 0)
    }
}

#[cold]
fn not_finite(place: Place<'_>, value: f64) -> Error {
    place.error(ErrorKind::NotFinite, format!("{value} before here is not a finite number"))
}
