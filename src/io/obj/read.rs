//! Reads OBJ statement by statement.

use super::corner::{self, OptionalIndices};
use super::tag::Tags;
use super::vertex::{ColorBuilder, numbers};
use crate::base::{Error, ErrorKind, Result};
use crate::io::MeshFile;
use crate::io::labels::LabelBuilder;
use crate::io::lines::{Lines, Words};
use crate::io::place::{Place, quote};
use crate::io::watch::Watch;
use std::collections::BTreeMap;
use std::io::BufRead;

/// Different unknown keywords that are counted one by one.
const MOST_KEYWORDS: usize = 32;

pub(in crate::io) fn read(reader: impl BufRead, name: &str, watch: Watch<'_>) -> Result<MeshFile> {
    let mut lines = Lines::new(reader, name, watch);
    let mut parser = Parser::new(name);
    while lines.advance_joined()? {
        parser.statement(lines.place(), lines.text())?;
    }
    lines.finish()?;
    parser.finish()
}

/// The mesh so far and what has to be remembered until its end.
struct Parser<'a> {
    name: &'a str,
    mesh: MeshFile,
    face_uvs: OptionalIndices,
    face_normals: OptionalIndices,
    /// One more than the highest vertex named.
    vertices_named: usize,
    colors: ColorBuilder,
    objects: LabelBuilder,
    groups: LabelBuilder,
    materials: LabelBuilder,
    smoothing: LabelBuilder,
    weights: u64,
    depths: u64,
    tags: Tags,
    dropped: BTreeMap<String, u64>,
}

impl<'a> Parser<'a> {
    fn new(name: &'a str) -> Self {
        Self {
            name,
            mesh: MeshFile::default(),
            face_uvs: OptionalIndices::default(),
            face_normals: OptionalIndices::default(),
            vertices_named: 0,
            colors: ColorBuilder::default(),
            objects: LabelBuilder::new(),
            groups: LabelBuilder::new(),
            materials: LabelBuilder::new(),
            smoothing: LabelBuilder::new(),
            weights: 0,
            depths: 0,
            tags: Tags::default(),
            dropped: BTreeMap::new(),
        }
    }

    fn statement(&mut self, place: Place<'_>, line: &[u8]) -> Result<()> {
        let mut words = Words::new(line);
        let Some(keyword) = words.next() else { return Ok(()) };
        match keyword {
            b"v" => self.vertex(place, words),
            b"f" => self.face(place, words),
            b"vt" => self.uv(place, words),
            b"vn" => self.normal(place, words),
            b"o" => set(&mut self.objects, place, &words),
            b"g" => set(&mut self.groups, place, &words),
            b"usemtl" => set(&mut self.materials, place, &words),
            b"s" => self.smoothing(place, &words),
            b"t" => self.tag(place, &words),
            b"mtllib" => self.library(place, &words),
            [b'#', ..] => comment(place, line),
            _ => self.drop_statement(place, keyword, &words),
        }
    }

    fn vertex(&mut self, place: Place<'_>, words: Words<'_>) -> Result<()> {
        let (n, len) = numbers::<7>(place, words)?;
        let color = match len {
            3 | 4 => &[],
            6 | 7 => &n[3..len],
            _ => return Err(place.syntax(format!("a vertex of {len} numbers: 3, 4, 6 or 7 fit"))),
        };
        place.check_count(self.mesh.positions.len(), "vertices")?;
        // Adding 0.0 would lose the sign of zero; only an exact 1 is no weight.
        self.weights += u64::from(len == 4 && n[3].to_bits() != 1_f64.to_bits());
        self.colors.push(self.mesh.positions.len(), color);
        self.mesh.positions.push([n[0], n[1], n[2]]);
        self.mesh.vertex_lines.push(place.line_number());
        Ok(())
    }

    fn uv(&mut self, place: Place<'_>, words: Words<'_>) -> Result<()> {
        let (n, len) = numbers::<3>(place, words)?;
        if len == 0 {
            return Err(place.syntax("a texture coordinate without numbers"));
        }
        place.check_count(self.mesh.uvs.len(), "texture coordinates")?;
        self.depths += u64::from(n[2].abs() > 0.0);
        self.mesh.uvs.push([n[0], n[1]]);
        Ok(())
    }

    fn normal(&mut self, place: Place<'_>, words: Words<'_>) -> Result<()> {
        let (n, len) = numbers::<3>(place, words)?;
        if len != 3 {
            return Err(place.syntax(format!("a normal of {len} numbers, 3 are needed")));
        }
        place.check_count(self.mesh.normals.len(), "normals")?;
        self.mesh.normals.push(n);
        Ok(())
    }

    fn face(&mut self, place: Place<'_>, words: Words<'_>) -> Result<()> {
        let first = self.mesh.face_vertices.len();
        for word in words.take_while(|word| word[0] != b'#') {
            self.corner(place, word)?;
        }
        let face = self.mesh.face_sizes.len();
        let size = self.mesh.face_vertices.len() - first;
        if size < 3 {
            return Err(place.too_small(face as u64, 1, size as u64));
        }
        place.check_count(face, "faces")?;
        place.check_count(self.mesh.face_vertices.len(), "face corners")?;
        self.mesh.face_sizes.push(size as u32);
        self.mesh.face_lines.push(place.line_number());
        for labels in
            [&mut self.objects, &mut self.groups, &mut self.materials, &mut self.smoothing]
        {
            labels.push_face(face);
        }
        Ok(())
    }

    #[inline]
    fn corner(&mut self, place: Place<'_>, word: &[u8]) -> Result<()> {
        let Some(written) = corner::parse(word) else {
            return Err(place.unexpected(word, "a face corner such as 7, 7/2 or 7/2/1"));
        };
        let mesh = &mut self.mesh;
        let face = mesh.face_sizes.len();
        let resolve = |written, count: usize, what| {
            corner::resolve(written, count).ok_or_else(|| beyond(place, face, what, written, count))
        };
        let vertex = resolve(written.vertex, mesh.positions.len(), "vertex")?;
        let uv = written.uv.map(|uv| resolve(uv, mesh.uvs.len(), "texture coordinate"));
        let normal = written.normal.map(|normal| resolve(normal, mesh.normals.len(), "normal"));
        let number = mesh.face_vertices.len();
        self.face_uvs.push(number, uv.transpose()?);
        self.face_normals.push(number, normal.transpose()?);
        self.vertices_named = self.vertices_named.max(vertex as usize + 1);
        mesh.face_vertices.push(vertex);
        Ok(())
    }

    fn smoothing(&mut self, place: Place<'_>, words: &Words<'_>) -> Result<()> {
        match name(place, words)? {
            "off" | "0" => self.smoothing.set(""),
            name => self.smoothing.set(name),
        }
        Ok(())
    }

    fn library(&mut self, place: Place<'_>, words: &Words<'_>) -> Result<()> {
        let name = name(place, words)?;
        if !name.is_empty() {
            self.mesh.material_libraries.push(name.to_owned());
        }
        Ok(())
    }

    fn tag(&mut self, place: Place<'_>, words: &Words<'_>) -> Result<()> {
        if self.tags.statement(place, words.clone())? {
            return Ok(());
        }
        place.text(words.rest())?;
        let name = words.clone().next().filter(|name| is_keyword(name));
        let name = name.and_then(|name| std::str::from_utf8(name).ok()).unwrap_or_default();
        self.count_dropped(format!("t {name}").trim_end());
        Ok(())
    }

    /// Counts a statement that is none of ours, if it is a statement at all.
    fn drop_statement(
        &mut self,
        place: Place<'_>,
        keyword: &[u8],
        words: &Words<'_>,
    ) -> Result<()> {
        if !is_keyword(keyword) {
            return Err(place.unexpected(keyword, "an OBJ keyword"));
        }
        let keyword = place.text(keyword)?;
        place.text(words.rest())?;
        self.count_dropped(keyword);
        Ok(())
    }

    fn count_dropped(&mut self, keyword: &str) {
        if let Some(n) = self.dropped.get_mut(keyword) {
            *n += 1;
        } else {
            let full = self.dropped.len() >= MOST_KEYWORDS;
            let keyword = if full { "of other kinds" } else { keyword };
            *self.dropped.entry(keyword.to_owned()).or_default() += 1;
        }
    }

    fn finish(mut self) -> Result<MeshFile> {
        self.check_forward_references()?;
        self.note_losses();
        let unused = [
            finish(self.objects, &mut self.mesh.objects),
            finish(self.groups, &mut self.mesh.groups),
            finish(self.materials, &mut self.mesh.materials),
            finish(self.smoothing, &mut self.mesh.smoothing),
        ];
        let unused: u64 = unused.into_iter().sum();
        if unused > 0 {
            let note = format!("{unused} o, g, usemtl or s statements without faces were dropped");
            self.mesh.notes.push(note);
        }
        self.mesh.colors = self.colors.finish();
        self.mesh.face_uvs = self.face_uvs.finish();
        self.mesh.face_normals = self.face_normals.finish();
        self.tags.finish(self.name, &mut self.mesh)?;
        Ok(self.mesh)
    }

    /// Faces may name elements that follow them: only now all are known.
    fn check_forward_references(&self) -> Result<()> {
        let mesh = &self.mesh;
        let count = mesh.positions.len();
        if self.vertices_named > count {
            let beyond = |&v: &u32| v as usize >= count;
            if let Some(corner) = mesh.face_vertices.iter().position(beyond) {
                return Err(self.late(corner, "vertex", mesh.face_vertices[corner], count));
            }
        }
        let optional = [
            (&self.face_uvs, "texture coordinate", mesh.uvs.len()),
            (&self.face_normals, "normal", mesh.normals.len()),
        ];
        for (indices, what, count) in optional {
            if let Some(corner) = indices.first_beyond(count) {
                return Err(self.late(corner, what, indices.get(corner), count));
            }
        }
        Ok(())
    }

    #[cold]
    fn late(&self, corner: usize, what: &str, index: u32, count: usize) -> Error {
        let mut end = 0;
        let has_corner = |&size: &u32| {
            end += size as usize;
            corner < end
        };
        let face = self.mesh.face_sizes.iter().position(has_corner).unwrap_or_default();
        let place = Place::line(self.name, u64::from(self.mesh.face_lines[face]));
        place.out_of_range(face as u64, 1, what, i64::from(index) + 1, count as u64)
    }

    fn note_losses(&mut self) {
        let counted = [
            (self.weights, "rational weights (the 4th number of v) were dropped"),
            (self.depths, "third texture coordinates (the 3rd number of vt) were dropped"),
            (self.colors.completed, "vertices without colour or opacity became opaque white"),
        ];
        let notes = &mut self.mesh.notes;
        notes.extend(counted.iter().filter(|(n, _)| *n > 0).map(|(n, what)| format!("{n} {what}")));
        notes.extend(self.dropped.iter().map(|(keyword, n)| match keyword.as_str() {
            "p" => format!("{n} point elements (p) were dropped"),
            "l" => format!("{n} line elements (l) were dropped"),
            _ => format!("{n} statements {keyword} were dropped"),
        }));
    }
}

fn is_keyword(word: &[u8]) -> bool {
    let plain = |b: &u8| b.is_ascii_alphanumeric() || matches!(b, b'_' | b'-' | b'.');
    word[0].is_ascii_alphabetic() && word.iter().all(plain) && word.len() <= 40
}

#[cold]
fn beyond(place: Place<'_>, face: usize, what: &str, written: i64, count: usize) -> Error {
    if written == 0 {
        let reason = format!("face {} names {what} 0, but OBJ counts from 1", face + 1);
        let error = place.error(ErrorKind::IndexOutOfRange, reason);
        return error.with_elements([crate::base::Element::Face(face as u64)]);
    }
    let what = if written < 0 { format!("{what} (from the end)") } else { what.to_owned() };
    place.out_of_range(face as u64, 1, &what, written, count as u64)
}

fn set(labels: &mut LabelBuilder, place: Place<'_>, words: &Words<'_>) -> Result<()> {
    labels.set(name(place, words)?);
    Ok(())
}

/// A name is all that is left of the line. One that ends with a backslash (and
/// blanks, else the next line would belong to it) could not be written back.
fn name<'w>(place: Place<'_>, words: &Words<'w>) -> Result<&'w str> {
    let name = place.text(words.rest())?;
    if name.ends_with('\\') {
        return Err(place.syntax("blanks between a backslash and the end of the line"));
    }
    Ok(name)
}

fn finish(builder: LabelBuilder, into: &mut crate::io::Labels) -> u64 {
    let (labels, unused) = builder.finish();
    *into = labels;
    unused
}

/// A comment may be in any encoding, but must not hide what is no comment.
fn comment(place: Place<'_>, line: &[u8]) -> Result<()> {
    if line.contains(&b'\0') {
        return Err(place.syntax(format!("a NUL byte in the comment {}", quote(line))));
    }
    if line.contains(&b'\r') {
        return Err(place.syntax("a carriage return without line feed"));
    }
    Ok(())
}
