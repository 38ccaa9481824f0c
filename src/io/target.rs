//! Replaces a file in one stroke, or leaves it as it was.

use crate::base::{Error, Result};
use std::fs::{self, File, OpenOptions};
use std::io;
use std::path::{Path, PathBuf};

/// Symbolic links that are followed before a loop is suspected.
const MOST_LINKS: usize = 40;

/// Runs `work` on a new file and puts that file at `path` if it succeeds.
pub(super) fn replace(
    path: &Path,
    name: &str,
    work: impl FnOnce(&mut File) -> Result<()>,
) -> Result<()> {
    let io_error = |e| Error::io(name, e);
    let path = follow_links(path).map_err(io_error)?;
    match fs::metadata(&path) {
        Ok(meta) if meta.is_dir() => Err(io_error(io::ErrorKind::IsADirectory.into())),
        Ok(meta) if !meta.is_file() => {
            // A device or a pipe is written to, not replaced.
            work(&mut OpenOptions::new().write(true).open(&path).map_err(io_error)?)
        }
        Ok(meta) => {
            // Renaming needs no leave to write the file itself; ask for it.
            OpenOptions::new().write(true).open(&path).map_err(io_error)?;
            through_temporary(&path, name, Some(meta.permissions()), work)
        }
        Err(e) if e.kind() == io::ErrorKind::NotFound => through_temporary(&path, name, None, work),
        Err(e) => Err(io_error(e)),
    }
}

fn through_temporary(
    path: &Path,
    name: &str,
    permissions: Option<fs::Permissions>,
    work: impl FnOnce(&mut File) -> Result<()>,
) -> Result<()> {
    let io_error = |e| Error::io(name, e);
    let directory = match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    };
    let mut builder = tempfile::Builder::new();
    builder.prefix(".carvel-").suffix(".tmp");
    let ordinary = ordinary_permissions();
    if let Some(ordinary) = &ordinary {
        builder.permissions(ordinary.clone());
    }
    let mut temporary = builder.tempfile_in(directory).map_err(|e| io_error(bare(e)))?;
    if let Some(permissions) = permissions {
        temporary.as_file().set_permissions(permissions).map_err(io_error)?;
    }
    work(temporary.as_file_mut())?;
    temporary.persist(path).map(drop).map_err(|e| io_error(e.error))
}

/// The reason alone, without the temporary name that tempfile adds.
fn bare(error: io::Error) -> io::Error {
    let text = error.to_string();
    match text.split_once(" at path ") {
        Some((reason, _)) => io::Error::new(error.kind(), reason),
        None => error,
    }
}

/// The file that a path leads to in the end, which need not exist yet.
fn follow_links(path: &Path) -> io::Result<PathBuf> {
    let mut path = path.to_path_buf();
    for _ in 0..MOST_LINKS {
        match fs::read_link(&path) {
            Ok(link) => path = path.parent().unwrap_or(Path::new("")).join(link),
            // Not a link, or nothing there: whoever opens it will say.
            Err(_) => return Ok(path),
        }
    }
    Err(io::Error::other("too many symbolic links"))
}

/// What a file created without further ado would get; the user's mask applies.
#[cfg(unix)]
#[expect(clippy::unnecessary_wraps, reason = "other systems have no such default")]
fn ordinary_permissions() -> Option<fs::Permissions> {
    use std::os::unix::fs::PermissionsExt;
    Some(fs::Permissions::from_mode(0o666))
}

#[cfg(not(unix))]
fn ordinary_permissions() -> Option<fs::Permissions> {
    None
}
