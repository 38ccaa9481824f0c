//! Reads PLY, table by table and row by row.

use super::header::{self, ElementType, Header, Kind};
use super::values::{Binary, Text, Values};
use super::vertex::{Layout, Slot};
use crate::base::{Error, NONE, Result};
use crate::io::bytes::Bytes;
use crate::io::lines::Lines;
use crate::io::place::Place;
use crate::io::watch::Watch;
use crate::io::{ColorType, Encoding, MeshFile, NumberType};
use std::io::BufRead;

pub(in crate::io) fn read(reader: impl BufRead, name: &str, watch: Watch<'_>) -> Result<MeshFile> {
    let mut lines = Lines::new(reader, name, watch);
    let header = header::read(&mut lines)?;
    let place = lines.place();
    match header.encoding {
        Encoding::Ascii => tables(Text::new(lines), &header, place),
        Encoding::Binary | Encoding::BinaryBigEndian => {
            let (reader, watch) = lines.into_parts();
            let bytes = Bytes::new(reader, name, watch);
            let big_endian = header.encoding == Encoding::BinaryBigEndian;
            tables(Binary::new(bytes, big_endian), &header, place)
        }
    }
}

fn tables(values: impl Values, header: &Header, place: Place<'_>) -> Result<MeshFile> {
    let vertices = header.elements.iter().find(|element| element.name == "vertex");
    let count = vertices.map_or(0, |element| element.count);
    let mut parser = Parser { values, mesh: MeshFile::default(), vertices: count };
    for element in &header.elements {
        match element.name.as_str() {
            "vertex" => parser.vertices(element, place)?,
            "face" => parser.faces(element, place)?,
            _ => parser.skip(element)?,
        }
    }
    parser.finish()
}

struct Parser<V> {
    values: V,
    mesh: MeshFile,
    /// The number of vertices that the header promises.
    vertices: u64,
}

impl<V: Values> Parser<V> {
    fn vertices(&mut self, element: &ElementType, place: Place<'_>) -> Result<()> {
        let layout = Layout::new(element, place, &mut self.mesh)?;
        for row in 0..element.count {
            self.begin_row(element, row, true)?;
            self.vertex(element, row, &layout)?;
            self.values.end_row()?;
        }
        Ok(())
    }

    fn vertex(&mut self, element: &ElementType, row: u64, layout: &Layout) -> Result<()> {
        let (mut position, mut normal, mut color, mut uv) =
            ([0.0; 3], [0.0; 3], [0.0; 4], [0.0; 2]);
        for (property, &slot) in element.properties.iter().zip(&layout.slots) {
            let Kind::Scalar(kind) = property.kind else {
                self.skip_property(element, row, property.kind)?;
                continue;
            };
            let value = self.number(element, row, kind)?;
            match slot {
                Slot::Position(i) => position[i] = value,
                Slot::Normal(i) => normal[i] = value,
                Slot::Color(i) => color[i] = value,
                Slot::Uv(i) => uv[i] = value,
                Slot::Attribute(i) => self.mesh.attributes[i].values.push(value),
                Slot::Dropped => {}
            }
        }
        self.mesh.positions.push(position);
        if layout.normals {
            self.mesh.normals.push(normal);
        }
        if layout.uvs {
            self.mesh.uvs.push(uv);
        }
        if let (Some(colors), Some((width, kind))) = (&mut self.mesh.colors, layout.colors) {
            let scale = if kind == ColorType::U8 { 255.0 } else { 1.0 };
            colors.values.extend(color[..width].iter().map(|value| value / scale));
        }
        Ok(())
    }

    fn faces(&mut self, element: &ElementType, place: Place<'_>) -> Result<()> {
        let is_index = |name: &str| matches!(name, "vertex_indices" | "vertex_index");
        let column = element.properties.iter().position(|p| is_index(&p.name));
        let list = column.map(|column| element.properties[column].kind);
        let (count, item) = match list {
            Some(Kind::List { count, item }) if !item.is_float() => (count, item),
            _ if element.count == 0 => return Ok(()),
            _ => return Err(place.syntax("the faces have no list vertex_indices of integers")),
        };
        for row in 0..element.count {
            self.begin_row(element, row, false)?;
            for (i, property) in element.properties.iter().enumerate() {
                if Some(i) == column {
                    self.corners(element, row, count, item)?;
                } else {
                    self.skip_property(element, row, property.kind)?;
                }
            }
            self.values.end_row()?;
        }
        let others = element.properties.iter().filter(|p| !is_index(&p.name));
        let note = |name: &str| format!("the face property {name} was dropped");
        self.mesh.notes.extend(others.map(|p| note(&p.name)));
        Ok(())
    }

    fn corners(
        &mut self,
        element: &ElementType,
        row: u64,
        count: NumberType,
        item: NumberType,
    ) -> Result<()> {
        let size = self.length(element, row, count)?;
        if size < 3 {
            return Err(self.values.place().too_small(row, 0, u64::from(size)));
        }
        for _ in 0..size {
            let index = self.number(element, row, item)?;
            // NONE is beyond any number of vertices, so it may pass here.
            if index < 0.0 || index >= self.vertices as f64 || index >= f64::from(NONE) {
                let (place, index) = (self.values.place(), index as i64);
                return Err(place.out_of_range(row, 0, "vertex", index, self.vertices));
            }
            self.mesh.face_vertices.push(natural(index));
        }
        self.values.place().check_count(self.mesh.face_vertices.len(), "face corners")?;
        self.mesh.face_sizes.push(size);
        Ok(())
    }

    /// Reads over a table that has no place in a mesh.
    fn skip(&mut self, element: &ElementType) -> Result<()> {
        let ElementType { name, count, properties } = element;
        if *count > 0 {
            self.mesh.notes.push(format!("{count} elements {name} were dropped"));
        }
        // Rows without properties take no room, however many are claimed.
        if properties.is_empty() {
            return Ok(());
        }
        for row in 0..*count {
            self.begin_row(element, row, false)?;
            for property in properties {
                self.skip_property(element, row, property.kind)?;
            }
            self.values.end_row()?;
        }
        Ok(())
    }

    fn skip_property(&mut self, element: &ElementType, row: u64, kind: Kind) -> Result<()> {
        match kind {
            Kind::Scalar(kind) => self.number(element, row, kind).map(drop),
            Kind::List { count, item } => {
                let length = self.length(element, row, count)?;
                (0..length).try_for_each(|_| self.number(element, row, item).map(drop))
            }
        }
    }

    /// Starts a row; text files have its line kept where there is a table for it.
    fn begin_row(&mut self, element: &ElementType, row: u64, vertex: bool) -> Result<()> {
        let Some(place) = self.values.begin_row()? else {
            return Err(self.early(element, row));
        };
        let line = place.line_number();
        if line > 0 && vertex {
            self.mesh.vertex_lines.push(line);
        } else if line > 0 && element.name == "face" {
            self.mesh.face_lines.push(line);
        }
        Ok(())
    }

    #[inline]
    fn number(&mut self, element: &ElementType, row: u64, kind: NumberType) -> Result<f64> {
        self.values.number(kind)?.ok_or_else(|| self.early(element, row))
    }

    fn length(&mut self, element: &ElementType, row: u64, kind: NumberType) -> Result<u32> {
        let length = self.number(element, row, kind)?;
        if length < 0.0 {
            return Err(self.values.place().syntax(format!("a list of {length} numbers")));
        }
        Ok(natural(length))
    }

    #[cold]
    fn early(&self, element: &ElementType, row: u64) -> Error {
        let ElementType { name, count, .. } = element;
        let reason =
            format!("the header promises {count} elements {name}, the file ends after {row}");
        self.values.place().syntax(reason)
    }

    fn finish(mut self) -> Result<MeshFile> {
        if self.values.finish()? {
            self.mesh.notes.push("what follows the last element was dropped".to_owned());
        }
        let mesh = &mut self.mesh;
        let per_corner = |some: bool| some.then(|| mesh.face_vertices.clone());
        let uvs = per_corner(!mesh.uvs.is_empty());
        let normals = per_corner(!mesh.normals.is_empty());
        (mesh.face_uvs, mesh.face_normals) = (uvs, normals);
        Ok(self.mesh)
    }
}

/// A number that was read from an integer type and is not negative.
#[expect(clippy::cast_sign_loss, reason = "the callers have checked the sign")]
fn natural(value: f64) -> u32 {
    value as u32
}
