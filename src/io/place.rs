//! Where in a file something is, and errors and quotations that say so.

use crate::base::{Element, Error, ErrorKind, Result};
use std::fmt::Write as _;

/// Characters of an offending token that a message shows.
const QUOTED: usize = 40;

/// A position in a named file.
#[derive(Debug, Clone, Copy)]
pub(super) struct Place<'a> {
    name: &'a str,
    element: Element,
}

impl<'a> Place<'a> {
    pub fn line(name: &'a str, line: u64) -> Self {
        Self { name, element: Element::Line(line) }
    }

    pub fn byte(name: &'a str, byte: u64) -> Self {
        Self { name, element: Element::Byte(byte) }
    }

    /// The line, saturated; 0 in binary data.
    pub fn line_number(self) -> u32 {
        match self.element {
            Element::Line(line) => u32::try_from(line).unwrap_or(u32::MAX),
            _ => 0,
        }
    }

    /// An error at this place.
    #[cold]
    pub fn error(self, kind: ErrorKind, reason: impl AsRef<str>) -> Error {
        let (name, reason) = (self.name, reason.as_ref());
        let message = match self.element {
            Element::Line(line) => format!("{name}:{line}: {reason}"),
            other => format!("{name}: {other}: {reason}"),
        };
        Error::new(kind, message).with_elements([self.element])
    }

    /// A syntax error at this place.
    #[cold]
    pub fn syntax(self, reason: impl AsRef<str>) -> Error {
        self.error(ErrorKind::Syntax, reason)
    }

    /// A syntax error about a token.
    #[cold]
    pub fn unexpected(self, token: &[u8], wanted: &str) -> Error {
        self.syntax(format!("{} where {wanted} is expected", quote(token)))
    }

    /// A text, which must be UTF-8 without control characters.
    pub fn text(self, bytes: &[u8]) -> Result<&str> {
        match std::str::from_utf8(bytes) {
            Ok(text) if !text.chars().any(|c| c.is_control() && c != '\t') => Ok(text),
            _ => Err(self.syntax(format!("{} is not plain UTF-8 text", quote(bytes)))),
        }
    }

    /// The error of a face that names an element which does not exist.
    ///
    /// `shown` and `first` count as the format does, `face` from 0.
    #[cold]
    pub fn out_of_range(self, face: u64, first: u64, what: &str, shown: i64, count: u64) -> Error {
        let reason =
            format!("face {} names {what} {shown}, but the file has {count}", face + first);
        self.error(ErrorKind::IndexOutOfRange, reason).with_elements([Element::Face(face)])
    }

    /// The error of a face with fewer than three corners; numbers as above.
    #[cold]
    pub fn too_small(self, face: u64, first: u64, size: u64) -> Error {
        let plural = if size == 1 { "vertex" } else { "vertices" };
        let reason = format!("face {} has {size} {plural}, at least 3 are needed", face + first);
        self.error(ErrorKind::FaceTooSmall, reason).with_elements([Element::Face(face)])
    }

    /// The error of more elements than an index can name.
    #[cold]
    pub fn too_many(self, what: &str) -> Error {
        self.error(ErrorKind::TooLarge, format!("more {what} than a 32-bit index can name"))
    }

    /// Refuses a further element beyond the range of an index.
    #[inline]
    pub fn check_count(self, count: usize, what: &str) -> Result<()> {
        if count < u32::MAX as usize { Ok(()) } else { Err(self.too_many(what)) }
    }
}

/// A token as shown in messages: quoted, escaped, cut after 40 characters.
pub(super) fn quote(token: &[u8]) -> String {
    let mut out = String::from("'");
    let text = String::from_utf8_lossy(&token[..token.len().min(4 * QUOTED)]);
    for (i, c) in text.chars().enumerate() {
        if i == QUOTED {
            out.push_str("...");
            break;
        }
        push_escaped(&mut out, c);
    }
    out.push('\'');
    out
}

/// A file name as shown in messages: on one line whatever it holds.
pub(super) fn one_line(name: &str) -> String {
    name.chars().fold(String::with_capacity(name.len()), |mut out, c| {
        push_escaped(&mut out, c);
        out
    })
}

fn push_escaped(out: &mut String, c: char) {
    if c.is_control() {
        write!(out, "{}", c.escape_default()).expect("a String takes everything");
    } else {
        out.push(c);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quotations_are_short_and_on_one_line() {
        assert_eq!(quote(b"a\nb\0"), r"'a\nb\u{0}'");
        assert_eq!(quote(&[b'x'; 1000]).len(), 40 + 5);
        assert_eq!(quote(b"\xff"), "'\u{fffd}'");
        assert_eq!(one_line("a\nb"), r"a\nb");
    }
}
