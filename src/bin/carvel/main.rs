//! The `carvel` command: control meshes in, smooth surfaces out.
//!
//! | module | its one idea |
//! |---|---|
//! | `args` | what can be asked for |
//! | `exit` | exit codes, and which mistake has which |
//! | `session` | what all commands share: threads, limits, interruption |
//! | `interrupt`, `memory`, `atomic` | signals, what the system has, files replaced whole |
//! | `console` | every line and the progress bar on the standard error stream |
//! | `input`, `places` | what is read, and where results go |
//! | `faults` | mistakes in a mesh, as lines of its file |
//! | `subdivide`, `tessellate`, `info`, `picture`, `stencils`, `analyse` | the commands |
//! | `mask`, `catalogue` | masks of curves: a part of `analyse`, and what there is |
//! | `curve` | polygons and grids: files, refinement |
//! | `plot` | graphs, curves and maps as SVG and PNG |
//! | `topology`, `matrix` | control meshes as asked for; stencil tables as files |
//! | `refine`, `precise` | one refinement with all its data |
//! | `carry`, `seams` | vertex data, and names of faces |
//! | `texture`, `tags` | texture coordinates with seams; creases and sharp vertices |
//! | `holes`, `records` | faces that are left out, and what goes with them |
//! | `report`, `text` | JSON, numbers and names for people |
//! | `preview` | the renderer |

#![forbid(unsafe_code)]

mod analyse;
mod args;
mod atomic;
mod carry;
mod catalogue;
mod console;
mod curve;
mod exit;
mod faults;
mod holes;
mod info;
mod input;
mod interrupt;
mod limit;
mod mask;
mod matrix;
mod memory;
mod picture;
mod places;
mod plot;
mod precise;
mod preview;
mod records;
mod refine;
mod report;
mod seams;
mod session;
mod stencils;
mod subdivide;
mod tags;
mod tessellate;
mod text;
mod texture;
mod topology;

use args::{Cli, Command};
use clap::Parser;
use console::Console;
use exit::Exit;
use std::process::ExitCode;

/// What is said to someone who types `carvel` and nothing else.
const WELCOME: &str = "\
carvel turns a coarse mesh of any topology into a smooth subdivision surface.

  carvel subdivide cow.obj -o smooth.obj --levels 3 --preview smooth.png
  carvel info cow.obj
  carvel preview cow.obj -o cow.png --wireframe overlay

Reads and writes OBJ, OFF, PLY and STL. The default scheme is three-point
(w = 1/32), whose surfaces are smooth to the second order; Catmull-Clark, Loop and
five more are there.
Help: carvel --help, or carvel subdivide --help for schemes and boundaries.
";

fn main() -> ExitCode {
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(error) => return usage(&error),
    };
    let exit = match &cli.command {
        None => report::print(WELCOME),
        Some(Command::Subdivide(args)) => subdivide::run(args),
        Some(Command::Tessellate(args)) => tessellate::run(args),
        Some(Command::Info(args)) => info::run(args),
        Some(Command::Preview(args)) => picture::run(args),
        Some(Command::Stencils(args)) => stencils::run(args),
        Some(Command::Analyse(args)) => analyse::run(args),
        Some(Command::Curve(args)) => curve::run(args),
        Some(Command::Catalogue(args)) => catalogue::run(args),
    };
    exit.unwrap_or_else(|failure| Console::plain().failure(&failure)).into()
}

/// Prints clap's help, version or complaint.
fn usage(error: &clap::Error) -> ExitCode {
    // A closed stream is no reason for another complaint.
    let _ = error.print();
    if error.use_stderr() { Exit::Usage.into() } else { Exit::Success.into() }
}
