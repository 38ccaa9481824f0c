//! Reads a text stream line by line into one reused buffer.

use super::place::Place;
use super::watch::Watch;
use crate::base::{Error, ErrorKind, Result};
use std::io::{BufRead, Read};

/// The longest line, continuations included: room for a face of a million
/// corners, not for a file without line ends.
const LONGEST_LINE: usize = 16 << 20;

/// The lines of a text file, without their ends.
pub(super) struct Lines<'a, R> {
    reader: R,
    watch: Watch<'a>,
    name: &'a str,
    line: u64,
    /// Lines that the buffer holds; more than one after a continuation.
    held: u64,
    buffer: Vec<u8>,
}

impl<'a, R: BufRead> Lines<'a, R> {
    pub fn new(reader: R, name: &'a str, watch: Watch<'a>) -> Self {
        Self { reader, watch, name, line: 0, held: 1, buffer: Vec::new() }
    }

    /// Goes to the next line; false at the end of the file.
    pub fn advance(&mut self) -> Result<bool> {
        self.line += self.held;
        self.held = 1;
        self.buffer.clear();
        let some = self.append()?;
        if self.line == 1 && self.buffer.starts_with(b"\xef\xbb\xbf") {
            self.buffer.drain(..3);
        }
        Ok(some)
    }

    /// Like [`Self::advance`], joining lines that end with a backslash.
    pub fn advance_joined(&mut self) -> Result<bool> {
        let some = self.advance()?;
        while self.buffer.last() == Some(&b'\\') {
            // The backslash separates words, as the line end does.
            self.buffer.pop();
            self.buffer.push(b' ');
            if !self.append()? {
                break;
            }
            self.held += 1;
        }
        Ok(some)
    }

    /// The current line.
    pub fn text(&self) -> &[u8] {
        &self.buffer
    }

    /// The current line's place; after the end, that of the last line.
    pub fn place(&self) -> Place<'a> {
        Place::line(self.name, self.line)
    }

    /// Ends the reading of lines, for a file that goes on in binary.
    pub fn into_parts(self) -> (R, Watch<'a>) {
        (self.reader, self.watch)
    }

    /// Reports the end to the progress hook.
    pub fn finish(&mut self) -> Result<()> {
        self.watch.report(self.name)
    }

    /// Adds a line of the file to the buffer, without its end.
    fn append(&mut self) -> Result<bool> {
        let before = self.buffer.len();
        let room = LONGEST_LINE.saturating_sub(before);
        // One byte more tells a line that is too long from one that just fits.
        let mut limited = self.reader.by_ref().take(room as u64 + 1);
        let n = limited.read_until(b'\n', &mut self.buffer).map_err(|e| Error::io(self.name, e))?;
        self.watch.advance(n as u64, self.name)?;
        if n > room {
            let reason = format!("the line is longer than {LONGEST_LINE} bytes");
            return Err(self.place().error(ErrorKind::Syntax, reason));
        }
        if n == 0 && before == 0 {
            self.line = self.line.saturating_sub(1).max(1);
        }
        for end in [b'\n', b'\r'] {
            if self.buffer.len() > before && self.buffer.last() == Some(&end) {
                self.buffer.pop();
            }
        }
        Ok(n > 0)
    }
}

/// The words of a line, separated by blanks and tabs.
#[derive(Clone)]
pub(super) struct Words<'a>(&'a [u8]);

impl<'a> Words<'a> {
    pub fn new(line: &'a [u8]) -> Self {
        Self(line)
    }

    /// What is left, without blanks at either end.
    pub fn rest(&self) -> &'a [u8] {
        self.0.trim_ascii()
    }

    /// Bytes left, blanks included.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// True if no word is left.
    pub fn is_empty(&self) -> bool {
        self.0.iter().all(|&b| is_blank(b))
    }
}

impl<'a> Iterator for Words<'a> {
    type Item = &'a [u8];

    #[inline]
    fn next(&mut self) -> Option<&'a [u8]> {
        let start = self.0.iter().position(|&b| !is_blank(b))?;
        let word = &self.0[start..];
        let end = word.iter().position(|&b| is_blank(b)).unwrap_or(word.len());
        let (word, rest) = word.split_at(end);
        self.0 = rest;
        Some(word)
    }
}

#[inline]
pub(super) fn is_blank(b: u8) -> bool {
    matches!(b, b' ' | b'\t' | b'\x0b' | b'\x0c')
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lines(data: &[u8], joined: bool) -> Vec<(u32, String)> {
        let mut lines = Lines::new(data, "t", Watch::new(None, None));
        let mut out = Vec::new();
        while if joined { lines.advance_joined() } else { lines.advance() }.unwrap() {
            let text = String::from_utf8(lines.text().to_vec()).unwrap();
            out.push((lines.place().line_number(), text));
        }
        out
    }

    #[test]
    fn line_ends_and_the_byte_order_mark_are_removed() {
        let got = lines(b"\xef\xbb\xbfa\r\n\nb", false);
        assert_eq!(got, [(1, "a".into()), (2, String::new()), (3, "b".into())]);
    }

    #[test]
    fn continued_lines_keep_the_numbers_right() {
        let got = lines(b"a\\\r\nb\\\nc\nd\\", true);
        assert_eq!(got, [(1, "a b c".into()), (4, "d ".into())]);
    }

    #[test]
    fn a_line_without_end_is_refused() {
        let endless = std::io::BufReader::new(std::io::repeat(b'x'));
        let mut lines = Lines::new(endless, "t", Watch::new(None, None));
        assert_eq!(lines.advance().unwrap_err().kind(), ErrorKind::Syntax);
    }

    #[test]
    fn words_are_split_at_blanks() {
        let words: Vec<_> = Words::new(b"  a\tbc  d ").collect();
        assert_eq!(words, [&b"a"[..], b"bc", b"d"]);
    }
}
