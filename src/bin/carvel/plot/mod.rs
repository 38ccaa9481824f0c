//! Plots: figures as plain data, and what draws them.
//!
//! | module | its one idea |
//! |---|---|
//! | `figure` | panels, lines, dots, faces |
//! | `draw` | the same as SVG and PNG |
//! | `curve`, `mask`, `surface` | what is plotted |
//! | `sheet` | the catalogue |

pub mod curve;
mod draw;
mod figure;
pub mod mask;
pub mod sheet;
pub mod surface;

use crate::exit::{Doing, Failure};
use crate::places;
use crate::session::Session;
use crate::{atomic, text};
pub use draw::{Kind, render};
use figure::Figure;
use std::path::Path;

/// The format of a plot by its name; what has no name is SVG.
///
/// # Errors
/// A usage error for any other extension, an output error for a directory that is not there.
pub fn kind_of(path: &Path) -> Result<Kind, Failure> {
    let is = |name: &str| path.extension().is_some_and(|e| e.eq_ignore_ascii_case(name));
    if is("svg") || places::is_stream(path) {
        return places::require_parent(path).map(|()| Kind::Svg);
    }
    if is("png") {
        return places::require_parent(path).map(|()| Kind::Png);
    }
    let name = text::one_line(&path.display().to_string());
    Err(Failure::usage(format!("{name}: plots are SVG or PNG, so call it something.svg")))
}

/// Draws a figure and writes it whole.
///
/// # Errors
/// As [`render`]; an output error.
pub fn save(session: &Session, path: &Path, kind: Kind, figure: &Figure) -> Result<(), Failure> {
    session.console.phase("drawing", &text::path_name(path));
    let bytes = render(figure, kind).map_err(|e| Failure::from_error(&e, Doing::Working))?;
    session.refuse_if_cancelled()?;
    let written = session.on_path(path, || atomic::write(path, &bytes));
    written.map_err(|e| Failure::from_error(&e, Doing::Writing))
}
