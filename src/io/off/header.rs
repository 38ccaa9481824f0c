//! The header word and the counts.

use crate::base::{ErrorKind, Result};
use crate::io::number::count;
use crate::io::place::{Place, quote};
use crate::io::stream::Stream;
use std::io::BufRead;

/// What the header promises.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(super) struct Header {
    pub uvs: bool,
    pub colors: bool,
    pub normals: bool,
    pub vertices: u32,
    pub faces: u32,
}

pub(super) fn read<R: BufRead>(stream: &mut Stream<'_, R>) -> Result<Header> {
    if !stream.seek()? {
        return Err(stream.place().syntax("the file is empty, the header OFF is expected"));
    }
    let place = stream.place();
    let mut header = word(place, stream.take())?;
    if !stream.seek()? {
        return Err(stream.place().syntax("the file ends before the counts"));
    }
    let place = stream.place();
    let first = stream.take();
    if first == b"BINARY" {
        return Err(place.error(ErrorKind::Unsupported, "binary OFF is not supported"));
    }
    header.vertices = count(place, first, "vertices")?;
    if !stream.seek()? {
        return Err(stream.place().syntax("the file ends before the number of faces"));
    }
    let place = stream.place();
    header.faces = count(place, stream.take(), "faces")?;
    // The number of edges says nothing new and is sometimes left out.
    if stream.on_word() {
        count(place, stream.take(), "edges")?;
    }
    if stream.on_word() {
        return Err(place.unexpected(stream.take(), "the end of the counts"));
    }
    Ok(header)
}

fn word(place: Place<'_>, word: &[u8]) -> Result<Header> {
    let mut header = Header::default();
    let mut rest = word;
    for (prefix, flag) in
        [(&b"ST"[..], &mut header.uvs), (b"C", &mut header.colors), (b"N", &mut header.normals)]
    {
        if let Some(after) = rest.strip_prefix(prefix) {
            *flag = true;
            rest = after;
        }
    }
    match rest {
        b"OFF" => Ok(header),
        b"4OFF" | b"nOFF" | b"4nOFF" => Err(place.error(
            ErrorKind::Unsupported,
            format!("{}: only three-dimensional OFF is supported", quote(word)),
        )),
        _ => Err(place.unexpected(word, "the header OFF, COFF, NOFF or STOFF")),
    }
}
