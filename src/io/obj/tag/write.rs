//! Writes `t` statements, one element each, as OpenSubdiv's shape files have them.

use super::{BOUNDARIES, CREASINGS, FACE_VARYING, TRIANGLES};
use crate::base::Result;
use crate::io::sink::Sink;
use crate::io::{MeshFile, Precision};
use std::io::Write;

pub(in crate::io::obj) fn write<W: Write>(sink: &mut Sink<'_, W>, mesh: &MeshFile) -> Result<()> {
    for crease in &mesh.creases {
        let [a, b] = crease.vertices;
        sink.put("t crease 2/1/0 ");
        sink.put_integer(u64::from(a));
        sink.put(" ");
        sink.put_integer(u64::from(b));
        sharpness(sink, crease.sharpness)?;
    }
    for sharp in &mesh.sharp_vertices {
        sink.put("t corner 1/1/0 ");
        sink.put_integer(u64::from(sharp.vertex));
        sharpness(sink, sharp.sharpness)?;
    }
    for &face in &mesh.holes {
        number(sink, "hole", u64::from(face));
        sink.pause()?;
    }
    scheme(sink, mesh);
    Ok(())
}

fn sharpness<W: Write>(sink: &mut Sink<'_, W>, value: f32) -> Result<()> {
    sink.put(" ");
    sink.put_float_as(Precision::F32, f64::from(value))?;
    sink.put("\n");
    sink.pause()
}

fn scheme<W: Write>(sink: &mut Sink<'_, W>, mesh: &MeshFile) {
    let tags = &mesh.scheme;
    let place = |found: Option<usize>| found.expect("every tag has its number") as u64;
    if let Some(tag) = tags.boundary {
        let found = BOUNDARIES.iter().position(|&known| known == tag);
        number(sink, "interpolateboundary", place(found));
    }
    if let Some(tag) = tags.face_varying {
        let found = FACE_VARYING.iter().position(|&known| known == tag);
        number(sink, "facevaryinginterpolateboundary", place(found));
    }
    let creasing = CREASINGS.iter().find(|(_, known)| tags.creasing == Some(*known));
    let triangles = TRIANGLES.iter().find(|(_, known)| tags.triangles == Some(*known));
    word(sink, "creasemethod", creasing.map(|(word, _)| *word));
    word(sink, "smoothtriangles", triangles.map(|(word, _)| *word));
}

/// A tag with one integer.
fn number<W: Write>(sink: &mut Sink<'_, W>, name: &str, value: u64) {
    sink.put("t ");
    sink.put(name);
    sink.put(" 1/0/0 ");
    sink.put_integer(value);
    sink.put("\n");
}

/// A tag with one word, if there is one.
fn word<W: Write>(sink: &mut Sink<'_, W>, name: &str, value: Option<&str>) {
    let Some(value) = value else { return };
    for part in ["t ", name, " 0/0/1 ", value, "\n"] {
        sink.put(part);
    }
}
