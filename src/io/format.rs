//! The file formats and how they are recognised.

use super::place;
use crate::base::{Error, ErrorKind, Result};
use std::fmt;
use std::path::Path;
use std::str::FromStr;

/// A mesh file format.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Format {
    /// Wavefront OBJ: polygons, face-varying data, labels.
    Obj,
    /// Geomview's object file format: polygons, vertex colours and normals.
    Off,
    /// Stanford PLY, text or binary: polygons and any vertex attributes.
    Ply,
    /// Stereolithography, text or binary: loose triangles.
    Stl,
}

impl Format {
    /// All formats.
    pub const ALL: [Self; 4] = [Self::Obj, Self::Off, Self::Ply, Self::Stl];

    /// The format that a path's extension names, in either case.
    ///
    /// # Errors
    /// [`ErrorKind::Unsupported`] if there is no extension or an unknown one.
    pub fn from_path(path: &Path) -> Result<Self> {
        let name = place::one_line(&path.display().to_string());
        let Some(extension) = path.extension() else {
            return Err(Error::new(
                ErrorKind::Unsupported,
                format!("{name}: no extension says which format this is ({KNOWN})"),
            ));
        };
        extension.to_string_lossy().parse().map_err(|e: Error| e.in_context(name))
    }

    /// The extension and name of the format, in lower case.
    pub fn name(self) -> &'static str {
        match self {
            Self::Obj => "obj",
            Self::Off => "off",
            Self::Ply => "ply",
            Self::Stl => "stl",
        }
    }
}

const KNOWN: &str = "obj, off, ply or stl";

impl FromStr for Format {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self> {
        let known = Self::ALL.into_iter().find(|f| f.name().eq_ignore_ascii_case(text));
        known.ok_or_else(|| {
            let shown = place::quote(text.as_bytes());
            Error::new(ErrorKind::Unsupported, format!("{shown} is not a known format ({KNOWN})"))
        })
    }
}

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
