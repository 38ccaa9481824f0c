//! Writes OBJ: vertices, texture coordinates, normals, the faces, then their tags.

use super::tag;
use crate::base::{NONE, Result};
use crate::io::mesh_file::bad_name;
use crate::io::sink::Sink;
use crate::io::{Labels, MeshFile, VertexColors};
use std::io::Write;

pub(in crate::io) fn write<W: Write>(sink: &mut Sink<'_, W>, mesh: &MeshFile) -> Result<()> {
    check_names(mesh)?;
    for library in &mesh.material_libraries {
        statement(sink, "mtllib", library);
        sink.pause()?;
    }
    vertices(sink, mesh)?;
    records(sink, "vt", mesh.uvs.iter().map(|uv| &uv[..]))?;
    records(sink, "vn", mesh.normals.iter().map(|normal| &normal[..]))?;
    faces(sink, mesh)?;
    tag::write(sink, mesh)
}

/// A backslash at the end of a line would join the next one to the name.
fn check_names(mesh: &MeshFile) -> Result<()> {
    let labels = mesh.labels().into_iter().flat_map(|(_, labels)| &labels.names);
    let mut names = labels.chain(&mesh.material_libraries);
    names.find(|name| name.ends_with('\\')).map_or(Ok(()), |name| Err(bad_name(name)))
}

fn statement<W: Write>(sink: &mut Sink<'_, W>, keyword: &str, rest: &str) {
    sink.put(keyword);
    if !rest.is_empty() {
        sink.put(b" ");
        sink.put(rest);
    }
    sink.put(b"\n");
}

fn records<'m, W: Write>(
    sink: &mut Sink<'_, W>,
    keyword: &str,
    values: impl Iterator<Item = &'m [f64]>,
) -> Result<()> {
    for value in values {
        sink.put(keyword);
        sink.put_floats(value)?;
        sink.put(b"\n");
        sink.pause()?;
    }
    Ok(())
}

fn vertices<W: Write>(sink: &mut Sink<'_, W>, mesh: &MeshFile) -> Result<()> {
    let Some(VertexColors { width, values, .. }) = &mesh.colors else {
        return records(sink, "v", mesh.positions.iter().map(|position| &position[..]));
    };
    for (position, color) in mesh.positions.iter().zip(values.chunks_exact(*width)) {
        sink.put(b"v");
        sink.put_floats(position)?;
        sink.put_floats(color)?;
        sink.put(b"\n");
        sink.pause()?;
    }
    Ok(())
}

fn faces<W: Write>(sink: &mut Sink<'_, W>, mesh: &MeshFile) -> Result<()> {
    let mut states = [
        State::new("o", "", &mesh.objects),
        State::new("g", "", &mesh.groups),
        State::new("usemtl", "", &mesh.materials),
        State::new("s", "off", &mesh.smoothing),
    ];
    let (uvs, normals) = (mesh.face_uvs.as_deref(), mesh.face_normals.as_deref());
    let mut corner = 0;
    for (i, face) in mesh.faces().enumerate() {
        for state in &mut states {
            state.go_to(sink, i);
        }
        sink.put(b"f");
        for &vertex in face {
            sink.put(b" ");
            sink.put_integer(u64::from(vertex) + 1);
            attributes(sink, at(uvs, corner), at(normals, corner));
            corner += 1;
        }
        sink.put(b"\n");
        sink.pause()?;
    }
    Ok(())
}

#[inline]
fn at(indices: Option<&[u32]>, corner: usize) -> Option<u32> {
    indices.map(|indices| indices[corner]).filter(|&index| index != NONE)
}

#[inline]
fn attributes<W: Write>(sink: &mut Sink<'_, W>, uv: Option<u32>, normal: Option<u32>) {
    if uv.is_some() || normal.is_some() {
        sink.put(b"/");
    }
    if let Some(uv) = uv {
        sink.put_integer(u64::from(uv) + 1);
    }
    if let Some(normal) = normal {
        sink.put(b"/");
        sink.put_integer(u64::from(normal) + 1);
    }
}

/// A statement that holds until the next of its kind.
struct State<'m> {
    keyword: &'static str,
    /// What the statement says when there is no name.
    unset: &'static str,
    labels: &'m Labels,
    current: u32,
}

impl<'m> State<'m> {
    fn new(keyword: &'static str, unset: &'static str, labels: &'m Labels) -> Self {
        Self { keyword, unset, labels, current: NONE }
    }

    /// Writes the statement if the face has another name than the one before.
    #[inline]
    fn go_to<W: Write>(&mut self, sink: &mut Sink<'_, W>, face: usize) {
        let Some(&label) = self.labels.of_face.get(face) else { return };
        if label != self.current {
            let name = self.labels.get(face).unwrap_or(self.unset);
            statement(sink, self.keyword, name);
            self.current = label;
        }
    }
}
