//! Mesh files: OBJ, OFF, PLY and STL, read and written as streams.
//!
//! A reader returns a [`MeshFile`]: what the file says, with every index
//! checked against the arrays and every number finite, and one line in
//! [`MeshFile::notes`] for each thing that could not be kept. Comments are the
//! only thing that goes without a note. Whether the polygons form a surface is
//! the mesh layer's business.
//!
//! Errors are one line, `file:line: reason` for text and `file: byte n: reason`
//! for binary data. Their text counts as the format does (OBJ from 1, the
//! others from 0); their [`Element`](crate::Element)s always count from 0.
//!
//! Creases, sharp vertices, holes and what belongs to the scheme are read from OBJ
//! and written back, as the statement `t` of OpenSubdiv's shape files: `t crease
//! 2/1/0 4 7 2.5`, `t corner 1/1/0 3 10`, `t hole 1/0/0 5`. The three counts are
//! those of the integers, numbers and words that follow; vertices and faces count
//! from 0 there. `src/io/obj/tag/mod.rs` lists all forms.
//!
//! Nothing is reserved on the word of a header: memory grows with the data that
//! arrives, so a hostile file costs a multiple of its own size at most.

mod bytes;
mod format;
mod labels;
mod lines;
mod losses;
mod mesh_file;
mod number;
mod obj;
mod off;
mod options;
mod place;
mod ply;
mod sink;
mod stl;
mod stream;
mod tags;
mod target;
mod watch;

pub use format::Format;
pub use labels::Labels;
pub use losses::losses;
pub use mesh_file::{ColorType, MeshFile, NumberType, VertexAttribute, VertexColors};
pub use options::{Encoding, Precision, Progress, ReadOptions, WriteOptions};
pub use tags::{BoundaryTag, CreasingTag, FaceVaryingTag, SchemeTags, TriangleTag};

use crate::base::{Error, Result};
use sink::Sink;
use std::fs::File;
use std::io::{BufRead, BufReader, Write, stdin, stdout};
use std::path::Path;
use watch::Watch;

/// Bytes asked of the system at a time, in both directions.
const BUFFER: usize = 256 * 1024;

/// Reads a mesh; the format is the option's, else the extension's.
///
/// The path `-` is the standard input, then OBJ unless the option says
/// otherwise.
///
/// # Errors
/// [`ErrorKind::Io`](crate::ErrorKind::Io) if the file cannot be read,
/// [`Unsupported`](crate::ErrorKind::Unsupported) for an unknown extension or
/// variant, [`Syntax`](crate::ErrorKind::Syntax) where the content breaks its
/// format, [`IndexOutOfRange`](crate::ErrorKind::IndexOutOfRange) and
/// [`FaceTooSmall`](crate::ErrorKind::FaceTooSmall) for such faces,
/// [`NotFinite`](crate::ErrorKind::NotFinite) and
/// [`Overflow`](crate::ErrorKind::Overflow) for such numbers,
/// [`InvalidTag`](crate::ErrorKind::InvalidTag) for a negative sharpness or a crease
/// from a vertex to itself,
/// [`TooLarge`](crate::ErrorKind::TooLarge) for more elements than an index can
/// name, [`Cancelled`](crate::ErrorKind::Cancelled) if the progress hook says so.
pub fn read(path: &Path, options: &ReadOptions<'_>) -> Result<MeshFile> {
    if is_standard_stream(path) {
        let format = options.format.unwrap_or(Format::Obj);
        let watch = Watch::new(options.progress, None);
        return read_stream(stdin().lock(), format, "standard input", watch);
    }
    let name = place::one_line(&path.display().to_string());
    let format = options.format.map_or_else(|| Format::from_path(path), Ok)?;
    let io_error = |e| Error::io(&name, e);
    let file = File::open(path).map_err(io_error)?;
    let meta = file.metadata().map_err(io_error)?;
    if meta.is_dir() {
        return Err(io_error(std::io::ErrorKind::IsADirectory.into()));
    }
    let total = meta.is_file().then_some(meta.len());
    let reader = BufReader::with_capacity(BUFFER, file);
    read_stream(reader, format, &name, Watch::new(options.progress, total))
}

/// Reads a mesh from a stream; `name` stands for the file in messages.
///
/// # Errors
/// As [`read()`].
pub fn read_from(reader: impl BufRead, format: Format, name: &str) -> Result<MeshFile> {
    read_stream(reader, format, &place::one_line(name), Watch::new(None, None))
}

fn read_stream(
    reader: impl BufRead,
    format: Format,
    name: &str,
    watch: Watch<'_>,
) -> Result<MeshFile> {
    match format {
        Format::Obj => obj::read(reader, name, watch),
        Format::Off => off::read(reader, name, watch),
        Format::Ply => ply::read(reader, name, watch),
        Format::Stl => stl::read(reader, name, watch),
    }
}

/// Writes a mesh; the format is the option's, else the extension's.
///
/// The data goes to a temporary file beside the target, which replaces the
/// target at the end: a failed or interrupted call leaves what was there. An
/// existing file keeps its permissions, a symbolic link is followed, and
/// devices and pipes are written directly. The path `-` is the standard
/// output, then OBJ unless the option says otherwise.
///
/// # Errors
/// As [`write_to`], and [`ErrorKind::Io`](crate::ErrorKind::Io) if the target
/// cannot be written.
pub fn write(path: &Path, mesh: &MeshFile, options: &WriteOptions<'_>) -> Result<()> {
    if is_standard_stream(path) {
        let format = options.format.unwrap_or(Format::Obj);
        return write_stream(stdout().lock(), format, "standard output", mesh, options);
    }
    let name = place::one_line(&path.display().to_string());
    let format = options.format.map_or_else(|| Format::from_path(path), Ok)?;
    // Checked first, so that a bad mesh does not touch the directory.
    mesh.check()?;
    target::replace(path, &name, |file| write_stream(file, format, &name, mesh, options))
}

/// Writes a file whole, or leaves what was there, as [`write()`] does: `fill` writes to a new file
/// beside the target, which takes its place at the end. For what is no mesh.
///
/// # Errors
/// Those of `fill`; [`ErrorKind::Io`](crate::ErrorKind::Io) if the target cannot be written.
pub fn replace_file(path: &Path, fill: impl FnOnce(&mut File) -> Result<()>) -> Result<()> {
    let name = place::one_line(&path.display().to_string());
    target::replace(path, &name, fill)
}

/// Writes a mesh to a stream, buffered here.
///
/// # Errors
/// Those of [`MeshFile::check`]; [`ErrorKind::Overflow`](crate::ErrorKind) if a
/// number does not fit the precision asked for,
/// [`Unsupported`](crate::ErrorKind::Unsupported) for an encoding that the
/// format lacks, [`Io`](crate::ErrorKind::Io), and
/// [`Cancelled`](crate::ErrorKind::Cancelled) if the progress hook says so.
pub fn write_to(
    writer: impl Write,
    format: Format,
    mesh: &MeshFile,
    options: &WriteOptions<'_>,
) -> Result<()> {
    mesh.check()?;
    write_stream(writer, format, "output", mesh, options)
}

fn write_stream(
    writer: impl Write,
    format: Format,
    name: &str,
    mesh: &MeshFile,
    options: &WriteOptions<'_>,
) -> Result<()> {
    let mut sink = Sink::new(writer, name, options);
    match format {
        Format::Obj => obj::write(&mut sink, mesh)?,
        Format::Off => off::write(&mut sink, mesh)?,
        Format::Ply => ply::write(&mut sink, mesh, options.encoding)?,
        Format::Stl => stl::write(&mut sink, mesh, options.encoding)?,
    }
    sink.finish()
}

fn is_standard_stream(path: &Path) -> bool {
    path.as_os_str() == "-"
}
