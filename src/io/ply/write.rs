//! Writes PLY: a table of vertices with all their attributes, one of faces.

use super::vertex::{COLOR_NAMES, NORMAL_NAMES, POSITION_NAMES, UV_NAMES};
use crate::base::{ErrorKind, Result};
use crate::io::mesh_file::{ColorType, MeshFile};
use crate::io::sink::Sink;
use crate::io::{Encoding, NumberType, Precision};
use std::io::Write;

/// A column of the vertex table: every vertex's value at a stride.
struct Column<'m> {
    name: &'m str,
    kind: NumberType,
    values: &'m [f64],
    stride: usize,
    scale: f64,
}

pub(in crate::io) fn write<W: Write>(
    sink: &mut Sink<'_, W>,
    mesh: &MeshFile,
    encoding: Encoding,
) -> Result<()> {
    let columns = columns(sink, mesh)?;
    let list = List::new(mesh);
    let header = header(mesh, &columns, &list, encoding);
    if encoding != Encoding::Ascii {
        let row: u64 = columns.iter().map(|column| column.kind.bytes()).sum();
        let lists = mesh.face_sizes.len() as u64 * list.count.bytes();
        let indices = mesh.face_vertices.len() as u64 * list.item.bytes();
        sink.expect(header.len() as u64 + mesh.positions.len() as u64 * row + lists + indices);
    }
    sink.put(header);
    for vertex in 0..mesh.positions.len() {
        for column in &columns {
            put(sink, encoding, column.kind, column.values[vertex * column.stride] * column.scale)?;
        }
        end_row(sink, encoding)?;
    }
    for face in mesh.faces() {
        put(sink, encoding, list.count, face.len() as f64)?;
        for &vertex in face {
            put(sink, encoding, list.item, f64::from(vertex))?;
        }
        end_row(sink, encoding)?;
    }
    Ok(())
}

/// The smallest usual types for the faces' lists.
struct List {
    count: NumberType,
    item: NumberType,
}

impl List {
    fn new(mesh: &MeshFile) -> Self {
        let short = mesh.face_sizes.iter().all(|&size| u8::try_from(size).is_ok());
        let signed = i32::try_from(mesh.positions.len()).is_ok();
        Self {
            count: if short { NumberType::U8 } else { NumberType::U32 },
            // Many readers know signed indices only.
            item: if signed { NumberType::I32 } else { NumberType::U32 },
        }
    }
}

fn header(mesh: &MeshFile, columns: &[Column<'_>], list: &List, encoding: Encoding) -> String {
    let format = match encoding {
        Encoding::Ascii => "ascii",
        Encoding::Binary => "binary_little_endian",
        Encoding::BinaryBigEndian => "binary_big_endian",
    };
    let (vertices, faces) = (mesh.positions.len(), mesh.face_sizes.len());
    let mut lines = vec![format!("ply\nformat {format} 1.0\nelement vertex {vertices}")];
    lines.extend(columns.iter().map(|c| format!("property {} {}", c.kind.name(), c.name)));
    lines.push(format!("element face {faces}"));
    let (count, item) = (list.count.name(), list.item.name());
    lines.push(format!("property list {count} {item} vertex_indices\nend_header\n"));
    lines.join("\n")
}

fn columns<'m, W: Write>(sink: &Sink<'_, W>, mesh: &'m MeshFile) -> Result<Vec<Column<'m>>> {
    let real = match sink.precision() {
        Precision::F32 => NumberType::F32,
        Precision::F64 => NumberType::F64,
    };
    let mut columns = Vec::new();
    let mut add = |names: &[&'m str], kind, values: &'m [f64], scale| {
        for (i, name) in names.iter().enumerate() {
            let values = values.get(i..).unwrap_or_default();
            columns.push(Column { name, kind, values, stride: names.len(), scale });
        }
    };
    add(&POSITION_NAMES, real, mesh.positions.as_flattened(), 1.0);
    if let Some(normals) = mesh.vertex_normals() {
        add(&NORMAL_NAMES, real, normals.as_flattened(), 1.0);
    }
    if let Some(colors) = &mesh.colors {
        let (kind, scale) = match colors.kind {
            ColorType::U8 => (NumberType::U8, 255.0),
            ColorType::Float => (real, 1.0),
        };
        add(&COLOR_NAMES[..colors.width], kind, &colors.values, scale);
    }
    if let Some(uvs) = mesh.vertex_uvs() {
        let taken = |name: &&str| mesh.attributes.iter().any(|a| a.name == **name);
        let free = UV_NAMES.iter().find(|names| !names.iter().any(&taken));
        add(free.unwrap_or(&UV_NAMES[0]), real, uvs.as_flattened(), 1.0);
    }
    for attribute in &mesh.attributes {
        add(&[attribute.name.as_str()], attribute.kind, &attribute.values, 1.0);
    }
    check_names(sink, &columns)?;
    Ok(columns)
}

fn check_names<W: Write>(sink: &Sink<'_, W>, columns: &[Column<'_>]) -> Result<()> {
    let mut names: Vec<_> = columns.iter().map(|column| column.name).collect();
    names.sort_unstable();
    match names.windows(2).find(|pair| pair[0] == pair[1]) {
        None => Ok(()),
        Some(pair) => {
            let reason = format!("two vertex properties are called {}", pair[0]);
            Err(sink.error(ErrorKind::InvalidText, reason))
        }
    }
}

/// Writes a number in a type; integers are rounded and clamped.
#[inline]
#[expect(clippy::cast_sign_loss, reason = "saturating is what is meant")]
fn put<W: Write>(
    sink: &mut Sink<'_, W>,
    encoding: Encoding,
    kind: NumberType,
    value: f64,
) -> Result<()> {
    if kind == NumberType::F32 && (value as f32).is_infinite() {
        return Err(sink.overflow(value));
    }
    if encoding == Encoding::Ascii {
        return put_text(sink, kind, value);
    }
    let whole = if kind.is_float() { value } else { value.round() };
    match kind {
        NumberType::I8 => put_bytes(sink, encoding, (whole as i8).to_le_bytes()),
        NumberType::U8 => put_bytes(sink, encoding, [whole as u8]),
        NumberType::I16 => put_bytes(sink, encoding, (whole as i16).to_le_bytes()),
        NumberType::U16 => put_bytes(sink, encoding, (whole as u16).to_le_bytes()),
        NumberType::I32 => put_bytes(sink, encoding, (whole as i32).to_le_bytes()),
        NumberType::U32 => put_bytes(sink, encoding, (whole as u32).to_le_bytes()),
        NumberType::F32 => put_bytes(sink, encoding, (value as f32).to_le_bytes()),
        NumberType::F64 => put_bytes(sink, encoding, value.to_le_bytes()),
    }
    Ok(())
}

#[inline]
fn put_bytes<W: Write, const N: usize>(
    sink: &mut Sink<'_, W>,
    encoding: Encoding,
    mut little: [u8; N],
) {
    if encoding == Encoding::BinaryBigEndian {
        little.reverse();
    }
    sink.put(little);
}

/// Writes a number and a blank.
fn put_text<W: Write>(sink: &mut Sink<'_, W>, kind: NumberType, value: f64) -> Result<()> {
    match kind.range() {
        Some((least, greatest)) => {
            let whole = (value.round() as i64).clamp(least, greatest);
            if whole < 0 {
                sink.put(b"-");
            }
            sink.put_integer(whole.unsigned_abs());
        }
        None if kind == NumberType::F32 => sink.put_float_as(Precision::F32, value)?,
        None => sink.put_float_as(Precision::F64, value)?,
    }
    sink.put(b" ");
    Ok(())
}

fn end_row<W: Write>(sink: &mut Sink<'_, W>, encoding: Encoding) -> Result<()> {
    if encoding == Encoding::Ascii {
        sink.end_line();
    }
    sink.pause()
}
