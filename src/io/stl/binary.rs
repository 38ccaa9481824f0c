//! Reads binary STL: 80 bytes of comment, a count, 50 bytes per triangle.

use super::weld::Welder;
use crate::base::{ErrorKind, Result};
use crate::io::MeshFile;
use crate::io::bytes::Bytes;
use crate::io::place::Place;
use crate::io::watch::Watch;
use std::io::BufRead;

/// The size of a file of `triangles`.
pub(super) fn size(triangles: u32) -> u64 {
    84 + 50 * u64::from(triangles)
}

pub(super) fn read(reader: impl BufRead, name: &str, watch: Watch<'_>) -> Result<MeshFile> {
    let mut bytes = Bytes::new(reader, name, watch);
    let start = bytes.place();
    let Some(head) = bytes.array::<84>()? else {
        return Err(start.syntax("neither a text STL (no solid) nor a binary one (84 bytes)"));
    };
    let count = u32::from_le_bytes([head[80], head[81], head[82], head[83]]);
    let mut welder = Welder::default();
    let mut marked = 0_u64;
    for i in 0..count {
        let place = bytes.place();
        let Some(record) = bytes.array::<50>()? else {
            let reason = format!("the header promises {count} triangles, the file ends after {i}");
            return Err(place.syntax(reason));
        };
        welder.triangle(place, triangle(place, &record)?, [place; 3])?;
        marked += u64::from(record[48..] != [0, 0]);
    }
    let left = bytes.finish()?;
    let mut mesh = welder.finish();
    if marked > 0 {
        mesh.notes.push(format!("the attribute bytes of {marked} triangles were dropped"));
    }
    if left > 0 {
        mesh.notes.push(format!("{left} bytes after the last triangle were dropped"));
    }
    Ok(mesh)
}

/// The vertices of a record, which follow the normal.
fn triangle(place: Place<'_>, record: &[u8; 50]) -> Result<[[f64; 3]; 3]> {
    let mut triangle = [[0.0; 3]; 3];
    let numbers = record[12..48].chunks_exact(4);
    for (x, bytes) in triangle.as_flattened_mut().iter_mut().zip(numbers) {
        let value = f32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]);
        if !value.is_finite() {
            let reason = format!("{value} in the triangle here is not a finite number");
            return Err(place.error(ErrorKind::NotFinite, reason));
        }
        *x = f64::from(value);
    }
    Ok(triangle)
}
