//! Reads OFF. Line breaks matter only where the format needs them: a vertex
//! colour and a face colour end with their line.

use super::header::{self, Header};
use crate::base::{Error, Result};
use crate::io::number::{float, integer};
use crate::io::place::Place;
use crate::io::stream::Stream;
use crate::io::watch::Watch;
use crate::io::{ColorType, MeshFile, VertexColors};
use std::io::BufRead;

pub(in crate::io) fn read(reader: impl BufRead, name: &str, watch: Watch<'_>) -> Result<MeshFile> {
    let mut stream = Stream::new(reader, name, watch, true);
    let header = header::read(&mut stream)?;
    let mut parser =
        Parser { stream, header, mesh: MeshFile::default(), colors: Colors::default() };
    for _ in 0..header.vertices {
        parser.vertex()?;
    }
    let mut face_colors = 0_u64;
    for _ in 0..header.faces {
        parser.face()?;
        face_colors += u64::from(parser.face_color()?);
    }
    parser.finish(face_colors)
}

struct Parser<'a, R> {
    stream: Stream<'a, R>,
    header: Header,
    mesh: MeshFile,
    colors: Colors,
}

impl<R: BufRead> Parser<'_, R> {
    fn vertex(&mut self) -> Result<()> {
        if !self.stream.seek()? {
            return Err(self.early());
        }
        let place = self.stream.place();
        let position = self.numbers()?;
        self.mesh.positions.push(position);
        self.mesh.vertex_lines.push(place.line_number());
        if self.header.normals {
            let normal = self.numbers()?;
            self.mesh.normals.push(normal);
        }
        if self.header.colors {
            self.color()?;
        }
        if self.header.uvs {
            let uv = self.numbers()?;
            self.mesh.uvs.push(uv);
        }
        Ok(())
    }

    fn numbers<const N: usize>(&mut self) -> Result<[f64; N]> {
        let mut out = [0.0; N];
        for slot in &mut out {
            *slot = self.stream.number()?.ok_or_else(|| self.early())?;
        }
        Ok(out)
    }

    fn color(&mut self) -> Result<()> {
        let place = self.stream.place();
        let width = self.stream.words_left().saturating_sub(2 * usize::from(self.header.uvs));
        let fits = self.colors.width == 0 || width == self.colors.width;
        if !fits || !matches!(width, 3 | 4) {
            return Err(place.syntax(format!("a vertex colour of {width} numbers")));
        }
        self.colors.width = width;
        for _ in 0..width {
            let word = self.stream.take();
            self.colors.fractions |= !word.iter().all(u8::is_ascii_digit);
            self.colors.values.push(float(place, word)?);
        }
        Ok(())
    }

    fn face(&mut self) -> Result<()> {
        if !self.stream.seek()? {
            return Err(self.early());
        }
        let (place, face) = (self.stream.place(), self.mesh.face_sizes.len() as u64);
        let word = self.stream.take();
        let size = match integer(word).map(u32::try_from) {
            Some(Ok(size)) if size < u32::MAX => size,
            Some(Err(_)) if word[0] != b'-' => return Err(place.too_many("face corners")),
            _ => return Err(place.unexpected(word, "the number of vertices of a face")),
        };
        if size < 3 {
            return Err(place.too_small(face, 0, u64::from(size)));
        }
        for _ in 0..size {
            let vertex = self.index(face)?;
            self.mesh.face_vertices.push(vertex);
        }
        place.check_count(self.mesh.face_vertices.len(), "face corners")?;
        self.mesh.face_sizes.push(size);
        self.mesh.face_lines.push(place.line_number());
        Ok(())
    }

    fn index(&mut self, face: u64) -> Result<u32> {
        if !self.stream.seek()? {
            return Err(self.early());
        }
        let (place, count) = (self.stream.place(), self.header.vertices);
        let word = self.stream.take();
        match integer(word) {
            Some(index) => match u32::try_from(index) {
                Ok(index) if index < count => Ok(index),
                _ => Err(place.out_of_range(face, 0, "vertex", index, u64::from(count))),
            },
            None => Err(place.unexpected(word, "the index of a vertex")),
        }
    }

    /// Skips a face's colour: an index into a map, or up to four components.
    fn face_color(&mut self) -> Result<bool> {
        let place = self.stream.place();
        let words = self.stream.words_left();
        if words > 4 {
            return Err(place.syntax(format!("{words} numbers after the face: a colour has 4")));
        }
        for _ in 0..words {
            float(place, self.stream.take())?;
        }
        Ok(words > 0)
    }

    fn finish(mut self, face_colors: u64) -> Result<MeshFile> {
        if face_colors > 0 {
            self.mesh.notes.push(format!("the colours of {face_colors} faces were dropped"));
        }
        if self.stream.seek()? {
            let line = self.stream.place().line_number();
            self.mesh.notes.push(format!("what follows the last face (line {line}) was dropped"));
        }
        self.stream.finish()?;
        self.mesh.colors = self.colors.finish();
        let per_corner = |yes: bool| yes.then(|| self.mesh.face_vertices.clone());
        self.mesh.face_uvs = per_corner(self.header.uvs);
        self.mesh.face_normals = per_corner(self.header.normals);
        Ok(self.mesh)
    }

    /// The error of a file that ends before all is there.
    #[cold]
    fn early(&self) -> Error {
        let place: Place<'_> = self.stream.place();
        let (vertices, faces) = (self.mesh.positions.len(), self.mesh.face_sizes.len());
        let Header { vertices: v, faces: f, .. } = self.header;
        place.syntax(if vertices < v as usize {
            format!("the header promises {v} vertices, the file ends after {vertices}")
        } else {
            format!("the header promises {f} faces, the file ends after {faces}")
        })
    }
}

/// Vertex colours, whose type shows only when all are known.
#[derive(Debug, Default)]
struct Colors {
    width: usize,
    values: Vec<f64>,
    /// True once a component was not a plain natural number.
    fractions: bool,
}

impl Colors {
    /// Natural numbers beyond 1 are bytes, as all programs have it.
    fn finish(self) -> Option<VertexColors> {
        let Self { width, mut values, fractions } = self;
        let bytes =
            !fractions && values.iter().any(|&v| v > 1.0) && values.iter().all(|&v| v <= 255.0);
        if bytes {
            for value in &mut values {
                *value /= 255.0;
            }
        }
        let kind = if bytes { ColorType::U8 } else { ColorType::Float };
        (width > 0).then_some(VertexColors { width, values, kind })
    }
}
