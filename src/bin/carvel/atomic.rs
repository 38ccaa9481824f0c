//! Small files in one stroke: whole, or as they were.
//!
//! Meshes are streamed by the library, which does the same for them.

use carvel::{Error, Result};
use std::fs;
use std::io::{self, BufWriter, Cursor, Seek, Write, stdout};
use std::path::{Path, PathBuf};
use tempfile::NamedTempFile;

/// Writes bytes to a path: `-` is the standard output, devices and pipes are
/// written directly, anything else is replaced when the new file is complete.
pub fn write(path: &Path, bytes: &[u8]) -> Result<()> {
    let result = match fs::metadata(path) {
        _ if path.as_os_str() == "-" => to_stdout(bytes),
        Ok(meta) if !meta.is_file() => fs::OpenOptions::new()
            .write(true)
            .open(path)
            .and_then(|mut device| device.write_all(bytes)),
        Ok(meta) => replace(path, Some(meta.permissions()), bytes),
        Err(_) => replace(path, None, bytes),
    };
    result.map_err(|e| Error::io(crate::text::one_line(&path.display().to_string()), e))
}

/// Anything that a matrix can be written to.
pub trait Sink: Write + Seek {}

impl<S: Write + Seek> Sink for S {}

/// The same for what is too large to be made first: only streams and devices are written
/// from memory.
pub fn write_with(path: &Path, fill: impl FnOnce(&mut dyn Sink) -> Result<()>) -> Result<()> {
    let meta = fs::metadata(path);
    if path.as_os_str() == "-" || meta.as_ref().is_ok_and(|meta| !meta.is_file()) {
        let mut bytes = Cursor::new(Vec::new());
        fill(&mut bytes)?;
        return write(path, bytes.get_ref());
    }
    let name = || crate::text::one_line(&path.display().to_string());
    let place = beside(path, meta.ok().map(|meta| meta.permissions()));
    let (file, path) = place.map_err(|e| Error::io(name(), e))?;
    let mut out = BufWriter::new(file);
    fill(&mut out)?;
    let file = out.into_inner().map_err(|e| Error::io(name(), e.into_error()))?;
    file.persist(path).map(drop).map_err(|e| Error::io(name(), e.error))
}

fn to_stdout(bytes: &[u8]) -> io::Result<()> {
    let mut out = stdout().lock();
    out.write_all(bytes)?;
    out.flush()
}

fn replace(path: &Path, permissions: Option<fs::Permissions>, bytes: &[u8]) -> io::Result<()> {
    let (mut file, path) = beside(path, permissions)?;
    file.write_all(bytes)?;
    file.persist(path).map(drop).map_err(|e| e.error)
}

/// A new file that can take the place of one, and that place.
fn beside(
    path: &Path,
    permissions: Option<fs::Permissions>,
) -> io::Result<(NamedTempFile, PathBuf)> {
    // Through a symbolic link to the file itself, which must be writable.
    let path = if permissions.is_some() { fs::canonicalize(path)? } else { path.to_path_buf() };
    if permissions.is_some() {
        fs::OpenOptions::new().write(true).open(&path)?;
    }
    let directory = path.parent().filter(|p| !p.as_os_str().is_empty());
    let mut builder = tempfile::Builder::new();
    builder.prefix(".carvel-").suffix(".tmp");
    if let Some(wanted) = permissions.or_else(ordinary) {
        builder.permissions(wanted);
    }
    // The reason alone, without the temporary name that tempfile adds.
    let bare = |e: io::Error| io::Error::from(e.kind());
    let file = builder.tempfile_in(directory.unwrap_or(Path::new("."))).map_err(bare)?;
    Ok((file, path))
}

/// What a file created without further ado would get; the user's mask applies.
#[cfg(unix)]
#[expect(clippy::unnecessary_wraps, reason = "other systems have no such default")]
fn ordinary() -> Option<fs::Permissions> {
    use std::os::unix::fs::PermissionsExt;
    Some(fs::Permissions::from_mode(0o666))
}

#[cfg(not(unix))]
fn ordinary() -> Option<fs::Permissions> {
    None
}
