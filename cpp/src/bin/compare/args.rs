//! The command line.

use clap::Parser;
use std::path::PathBuf;
use std::process::ExitCode;

use crate::part::Part;
use crate::regime::Regime;

/// Compares carvel with OpenSubdiv, OpenMesh and CGAL: answers first, then times and
/// memory, in single precision, on one thread unless said otherwise.
#[derive(Debug, Parser)]
#[command(name = "compare")]
pub struct Args {
    /// A mesh file (OBJ, OFF, PLY, STL) in place of the built-in meshes; part `refine`
    /// only.
    #[arg(long, conflicts_with = "parts")]
    pub mesh: Option<PathBuf>,

    /// The level to refine the file's mesh to.
    #[arg(long, default_value_t = 3, requires = "mesh", value_parser = clap::value_parser!(u32).range(1..=10))]
    pub level: u32,

    /// Timed calls of each side.
    #[arg(long, default_value_t = 5, value_parser = clap::value_parser!(u32).range(1..=1000))]
    pub runs: u32,

    /// Where the rows go.
    #[arg(long, default_value = "out/compare.json")]
    pub out: PathBuf,

    /// Only these memory regimes.
    #[arg(long = "regime", value_name = "REGIME")]
    pub regimes: Vec<Regime>,

    /// Only these parts.
    #[arg(long = "part", value_name = "PART")]
    pub parts: Vec<Part>,

    /// Also 100 M faces in part `linear`: 6 GB of memory.
    #[arg(long)]
    pub large: bool,

    /// Runs one regime in this process and prints its rows as JSON.
    #[arg(long, hide = true)]
    pub child: Option<Regime>,
}

impl Args {
    /// The parts asked for.
    pub fn parts(&self) -> &[Part] {
        match (&self.mesh, &self.parts[..]) {
            (Some(_), _) => &[Part::Refine],
            (None, []) => &Part::ALL,
            (None, parts) => parts,
        }
    }

    /// Reads the command line; a mistake is answered in one line.
    pub fn read() -> Result<Self, ExitCode> {
        Self::try_parse().map_err(|error| {
            if !error.use_stderr() {
                print!("{error}");
                return ExitCode::SUCCESS;
            }
            let text = error.to_string();
            let line = text.lines().next().unwrap_or_default();
            eprintln!("compare: {}", line.trim_start_matches("error: "));
            ExitCode::from(2)
        })
    }
}
