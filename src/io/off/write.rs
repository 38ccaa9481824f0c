//! Writes OFF, with vertex normals, colours and texture coordinates if any.

use crate::base::Result;
use crate::io::mesh_file::{ColorType, MeshFile, VertexColors};
use crate::io::sink::Sink;
use std::io::Write;

pub(in crate::io) fn write<W: Write>(sink: &mut Sink<'_, W>, mesh: &MeshFile) -> Result<()> {
    let (uvs, normals) = (mesh.vertex_uvs(), mesh.vertex_normals());
    let colors = mesh.colors.as_ref().map(|colors| (colors, as_bytes(colors)));
    for (prefix, wanted) in
        [("ST", uvs.is_some()), ("C", colors.is_some()), ("N", normals.is_some())]
    {
        sink.put(if wanted { prefix } else { "" });
    }
    sink.put(format!("OFF\n{} {} 0\n", mesh.positions.len(), mesh.face_sizes.len()));
    for (i, position) in mesh.positions.iter().enumerate() {
        sink.put_float(position[0])?;
        sink.put_floats(&position[1..])?;
        if let Some(normals) = normals {
            sink.put_floats(&normals[i])?;
        }
        if let Some((colors, bytes)) = colors {
            color(sink, &colors.values[i * colors.width..][..colors.width], bytes)?;
        }
        if let Some(uvs) = uvs {
            sink.put_floats(&uvs[i])?;
        }
        sink.put(b"\n");
        sink.pause()?;
    }
    for face in mesh.faces() {
        sink.put_integer(face.len() as u64);
        for &vertex in face {
            sink.put(b" ");
            sink.put_integer(u64::from(vertex));
        }
        sink.put(b"\n");
        sink.pause()?;
    }
    Ok(())
}

/// Whether bytes are written as such: if none is beyond 1 they would be taken
/// for numbers in [0, 1].
fn as_bytes(colors: &VertexColors) -> bool {
    colors.kind == ColorType::U8 && colors.values.iter().any(|&v| ColorType::byte(v) > 1)
}

fn color<W: Write>(sink: &mut Sink<'_, W>, color: &[f64], bytes: bool) -> Result<()> {
    for &value in color {
        sink.put(b" ");
        if bytes {
            sink.put_integer(u64::from(ColorType::byte(value)));
        } else {
            // The point tells 1.0 from the byte 1.
            sink.put_pointed(value)?;
        }
    }
    Ok(())
}
