//! Reads records of a binary stream.

use super::place::Place;
use super::watch::Watch;
use crate::base::{Error, Result};
use std::io::{BufRead, ErrorKind};

/// The bytes of a binary file, or of the binary part of one.
pub(super) struct Bytes<'a, R> {
    reader: R,
    watch: Watch<'a>,
    name: &'a str,
}

impl<'a, R: BufRead> Bytes<'a, R> {
    pub fn new(reader: R, name: &'a str, watch: Watch<'a>) -> Self {
        Self { reader, watch, name }
    }

    /// The next `N` bytes; `None` if the file ends before.
    #[inline]
    pub fn array<const N: usize>(&mut self) -> Result<Option<[u8; N]>> {
        let mut out = [0; N];
        match self.reader.read_exact(&mut out) {
            Ok(()) => self.watch.advance(N as u64, self.name).map(|()| Some(out)),
            Err(e) if e.kind() == ErrorKind::UnexpectedEof => Ok(None),
            Err(e) => Err(Error::io(self.name, e)),
        }
    }

    /// Where the next byte stands in the file.
    pub fn place(&self) -> Place<'a> {
        Place::byte(self.name, self.watch.done())
    }

    /// Reads to the end and tells how much there was.
    pub fn finish(&mut self) -> Result<u64> {
        let mut left = 0;
        loop {
            let n = match self.reader.fill_buf() {
                Ok(chunk) => chunk.len(),
                Err(e) if e.kind() == ErrorKind::Interrupted => continue,
                Err(e) => return Err(Error::io(self.name, e)),
            };
            if n == 0 {
                self.watch.report(self.name)?;
                return Ok(left);
            }
            self.reader.consume(n);
            self.watch.advance(n as u64, self.name)?;
            left += n as u64;
        }
    }
}
