//! Small files in one stroke: whole, or as they were.
//!
//! Meshes are streamed by the library; it is its function that replaces all of them.

use carvel::io::replace_file;
use carvel::{Error, Result};
use std::fs;
use std::io::{self, BufWriter, Cursor, Seek, Write, stdout};
use std::path::Path;

/// Writes bytes to a path: `-` is the standard output, devices and pipes are
/// written directly, anything else is replaced when the new file is complete.
pub fn write(path: &Path, bytes: &[u8]) -> Result<()> {
    let failed = |e| Error::io(name(path), e);
    if crate::places::is_stream(path) {
        return to_stdout(bytes).map_err(failed);
    }
    replace_file(path, |file| file.write_all(bytes).map_err(failed))
}

/// Anything that a matrix can be written to.
pub trait Sink: Write + Seek {}

impl<S: Write + Seek> Sink for S {}

/// The same for what is too large to be made first: only streams and devices are written
/// from memory.
pub fn write_with(path: &Path, fill: impl FnOnce(&mut dyn Sink) -> Result<()>) -> Result<()> {
    let is_device = fs::metadata(path).is_ok_and(|meta| !meta.is_file());
    if crate::places::is_stream(path) || is_device {
        let mut bytes = Cursor::new(Vec::new());
        fill(&mut bytes)?;
        return write(path, bytes.get_ref());
    }
    replace_file(path, |file| {
        let mut out = BufWriter::new(file);
        fill(&mut out)?;
        out.flush().map_err(|e| Error::io(name(path), e))
    })
}

fn name(path: &Path) -> String {
    crate::text::one_line(&path.display().to_string())
}

fn to_stdout(bytes: &[u8]) -> io::Result<()> {
    let mut out = stdout().lock();
    out.write_all(bytes)?;
    out.flush()
}
