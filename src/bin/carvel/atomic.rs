//! Small files in one stroke: whole, or as they were.
//!
//! Meshes are streamed by the library, which does the same for them.

use carvel::{Error, Result};
use std::fs;
use std::io::{self, Write, stdout};
use std::path::Path;

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

fn to_stdout(bytes: &[u8]) -> io::Result<()> {
    let mut out = stdout().lock();
    out.write_all(bytes)?;
    out.flush()
}

fn replace(path: &Path, permissions: Option<fs::Permissions>, bytes: &[u8]) -> io::Result<()> {
    // Through a symbolic link to the file itself, which must be writable.
    let path = &if permissions.is_some() { fs::canonicalize(path)? } else { path.to_path_buf() };
    if permissions.is_some() {
        fs::OpenOptions::new().write(true).open(path)?;
    }
    let directory = path.parent().filter(|p| !p.as_os_str().is_empty());
    let mut builder = tempfile::Builder::new();
    builder.prefix(".carvel-").suffix(".tmp");
    if let Some(wanted) = permissions.or_else(ordinary) {
        builder.permissions(wanted);
    }
    // The reason alone, without the temporary name that tempfile adds.
    let bare = |e: io::Error| io::Error::from(e.kind());
    let mut file = builder.tempfile_in(directory.unwrap_or(Path::new("."))).map_err(bare)?;
    file.write_all(bytes)?;
    file.persist(path).map(drop).map_err(|e| e.error)
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
