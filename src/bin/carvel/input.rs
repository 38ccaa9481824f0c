//! Reads an input and knows how its file counts.

use crate::exit::{Doing, Exit, Failure};
use crate::session::Session;
use crate::text::path_name;
use carvel::ErrorKind;
use carvel::io::{self, Format, MeshFile, ReadOptions};
use std::path::Path;

/// A mesh file that was read.
#[derive(Debug)]
pub struct Input {
    /// The file's name for messages, on one line.
    pub name: String,
    /// Its format.
    pub format: Format,
    /// Its content.
    pub file: MeshFile,
}

impl Input {
    /// Reads a mesh file; - is the standard input.
    pub fn read(session: &Session, path: &Path, forced: Option<Format>) -> Result<Self, Failure> {
        let fail = |e: &carvel::Error| Failure::from_error(e, Doing::Reading);
        let name = path_name(path);
        session.console.phase("reading", &name);
        let format = match forced {
            Some(format) => format,
            None if path.as_os_str() == "-" => Format::Obj,
            None => Format::from_path(path).map_err(|e| fail(&e))?,
        };
        let hook = session.bytes_hook();
        let options = ReadOptions { format: Some(format), progress: Some(&hook) };
        let file = session.on_path(path, || io::read(path, &options)).map_err(|e| fail(&e))?;
        Ok(Self { name, format, file })
    }

    /// The number of the first vertex and face where people count.
    pub fn base(&self) -> u64 {
        u64::from(self.format == Format::Obj)
    }

    /// Refuses a mesh without a face: there is no surface.
    pub fn require_faces(&self) -> Result<(), Failure> {
        if !self.file.face_sizes.is_empty() {
            return Ok(());
        }
        Err(Failure::new(Exit::Mesh, format!("{}: {}", self.name, self.no_faces())))
    }

    /// What to say about a file without faces.
    pub fn no_faces(&self) -> &'static str {
        if self.file.positions.is_empty() { "the file holds no mesh" } else { "there are no faces" }
    }
}

/// True if the whole run, not one input, came to its end.
pub fn ends_the_run(failure: &Failure) -> bool {
    failure.silent || failure.kind == Some(ErrorKind::Cancelled)
}
