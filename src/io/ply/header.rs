//! The header: encoding, elements, properties.

use crate::base::{ErrorKind, Result};
use crate::io::lines::{Lines, Words};
use crate::io::number::integer;
use crate::io::place::{Place, quote};
use crate::io::{Encoding, NumberType};
use std::io::BufRead;

/// Tables, and columns of a table, that a header may have. No real file comes
/// near; without a bound the search for doubles would be quadratic.
const MOST: usize = 1024;
/// The longest name.
const LONGEST_NAME: usize = 255;

/// What follows the header.
#[derive(Debug)]
pub(super) struct Header {
    pub encoding: Encoding,
    pub elements: Vec<ElementType>,
}

/// A table: rows of properties.
#[derive(Debug)]
pub(super) struct ElementType {
    pub name: String,
    pub count: u64,
    pub properties: Vec<Property>,
}

/// A column of a table.
#[derive(Debug)]
pub(super) struct Property {
    pub name: String,
    pub kind: Kind,
}

/// What a property holds per row.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    Scalar(NumberType),
    List { count: NumberType, item: NumberType },
}

/// Reads up to and with the line `end_header`.
pub(super) fn read<R: BufRead>(lines: &mut Lines<'_, R>) -> Result<Header> {
    if !lines.advance()? || lines.text() != b"ply" {
        let place = lines.place();
        return Err(place.syntax(format!("{}: not a PLY file", quote(lines.text()))));
    }
    let (mut encoding, mut elements) = (None, Vec::<ElementType>::new());
    while lines.advance()? {
        let place = lines.place();
        let mut words = Words::new(lines.text());
        match words.next() {
            Some(b"comment" | b"obj_info") | None => {}
            Some(b"format") => encoding = Some(format(place, &mut words)?),
            Some(b"element") => push_element(place, &mut words, &mut elements)?,
            Some(b"property") => push_property(place, &mut words, &mut elements)?,
            Some(b"end_header") => {
                let encoding = encoding.ok_or_else(|| place.syntax("no format in the header"))?;
                return Ok(Header { encoding, elements });
            }
            Some(word) => return Err(place.unexpected(word, "a PLY header keyword")),
        }
    }
    Err(lines.place().syntax("the file ends within the header"))
}

fn format(place: Place<'_>, words: &mut Words<'_>) -> Result<Encoding> {
    let encoding = match words.next().unwrap_or_default() {
        b"ascii" => Encoding::Ascii,
        b"binary_little_endian" => Encoding::Binary,
        b"binary_big_endian" => Encoding::BinaryBigEndian,
        other => return Err(place.unexpected(other, "ascii or binary_..._endian")),
    };
    match words.next().unwrap_or_default() {
        b"1.0" => end(place, words, encoding),
        other => {
            let reason = format!("PLY version {} is not supported", quote(other));
            Err(place.error(ErrorKind::Unsupported, reason))
        }
    }
}

fn push_element(
    place: Place<'_>,
    words: &mut Words<'_>,
    elements: &mut Vec<ElementType>,
) -> Result<()> {
    let name = name(place, words, elements.len())?;
    let word = words.next().unwrap_or_default();
    let Some(count) = integer(word).and_then(|n| u64::try_from(n).ok()) else {
        return Err(place.unexpected(word, "the number of elements"));
    };
    if elements.iter().any(|element| element.name == name) {
        return Err(place.syntax(format!("a second element {}", quote(name.as_bytes()))));
    }
    if matches!(name, "vertex" | "face") && count >= u64::from(u32::MAX) {
        return Err(place.too_many(if name == "face" { "faces" } else { "vertices" }));
    }
    elements.push(ElementType { name: name.to_owned(), count, properties: Vec::new() });
    end(place, words, ())
}

fn push_property(
    place: Place<'_>,
    words: &mut Words<'_>,
    elements: &mut [ElementType],
) -> Result<()> {
    let Some(element) = elements.last_mut() else {
        return Err(place.syntax("a property before the first element"));
    };
    let first = words.next().unwrap_or_default();
    let kind = if first == b"list" {
        let count = number_type(place, words.next().unwrap_or_default())?;
        if count.is_float() {
            return Err(place.syntax(format!("a list whose length is a {}", count.name())));
        }
        Kind::List { count, item: number_type(place, words.next().unwrap_or_default())? }
    } else {
        Kind::Scalar(number_type(place, first)?)
    };
    let name = name(place, words, element.properties.len())?;
    if element.properties.iter().any(|property| property.name == name) {
        return Err(place.syntax(format!("{} is no new property", quote(name.as_bytes()))));
    }
    element.properties.push(Property { name: name.to_owned(), kind });
    end(place, words, ())
}

/// The name of a new table or column, of which there are `before` already.
fn name<'w>(place: Place<'_>, words: &mut Words<'w>, before: usize) -> Result<&'w str> {
    let word = words.next().unwrap_or_default();
    if word.is_empty() || word.len() > LONGEST_NAME {
        return Err(place.unexpected(word, "a name"));
    }
    if before >= MOST {
        let reason = format!("more than {MOST} elements or properties are not supported");
        return Err(place.error(ErrorKind::Unsupported, reason));
    }
    place.text(word)
}

fn number_type(place: Place<'_>, name: &[u8]) -> Result<NumberType> {
    NumberType::from_name(name).ok_or_else(|| place.unexpected(name, "a number type"))
}

fn end<T>(place: Place<'_>, words: &mut Words<'_>, value: T) -> Result<T> {
    match words.next() {
        None => Ok(value),
        Some(word) => Err(place.unexpected(word, "the end of the line")),
    }
}
