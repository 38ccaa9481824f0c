//! In which state memory is when a call begins.

use carvel_peers::heap;
use serde_json::{Value, json};
use std::fs;
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Command, Stdio};

use crate::args::Args;
use crate::part::Part;
use crate::row::Row;
use crate::{cases, memory, table};

/// A state of memory.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub enum Regime {
    /// A fresh process: large arrays come from pages that nobody has touched.
    Default,
    /// As before, with transparent huge pages asked for by the C library for all that
    /// it allocates.
    Huge,
    /// A second identical call: caller's buffers for carvel, a warmed heap for the peer.
    ReUsed,
}

impl Regime {
    /// All.
    pub const ALL: [Self; 3] = [Self::Default, Self::Huge, Self::ReUsed];

    /// The name on the command line, in the table and in the file.
    pub fn name(self) -> &'static str {
        match self {
            Self::Default => "default",
            Self::Huge => "huge",
            Self::ReUsed => "re-used",
        }
    }

    /// Brings this process into the state.
    fn enter(self) -> Result<(), String> {
        match self {
            Self::Default => heap::fresh(),
            Self::Huge => {
                heap::fresh();
                memory::check_huge_pages()?;
            }
            Self::ReUsed => heap::keep(),
        }
        Ok(())
    }
}

/// Runs every regime of every part in a process of its own, prints the tables and writes
/// the file.
pub fn run_all(args: &Args) -> Result<(), String> {
    // Said here once, and not by every child.
    if let Some(path) = &args.mesh {
        cases::read(path)?;
    }
    let mut rows = Vec::new();
    for &part in args.parts() {
        table::print_head(part);
        let asked = |it: &&Regime| args.regimes.is_empty() || args.regimes.contains(it);
        for &regime in part.regimes().iter().filter(asked) {
            child(part, regime, args, &mut rows)?;
        }
    }
    write(&args.out, &rows)
}

/// Starts a process for a regime and takes its rows as they come.
fn child(part: Part, regime: Regime, args: &Args, rows: &mut Vec<Row>) -> Result<(), String> {
    let program = std::env::current_exe().map_err(|e| format!("this program: {e}"))?;
    let mut command = Command::new(program);
    command.args(["--child", regime.name(), "--runs", &args.runs.to_string()]);
    if let Some(mesh) = &args.mesh {
        command.arg("--mesh").arg(mesh).args(["--level", &args.level.to_string()]);
    } else {
        command.args(["--part", part.name()]).args(args.large.then_some("--large"));
    }
    if regime == Regime::Huge {
        // Read by the C library before main begins.
        command.env("GLIBC_TUNABLES", "glibc.malloc.hugetlb=1");
    }
    let failed = |e| format!("the process for regime {}: {e}", regime.name());
    let mut process = command.stdout(Stdio::piped()).spawn().map_err(failed)?;
    let lines = process.stdout.take().into_iter().flat_map(|out| BufReader::new(out).lines());
    for line in lines {
        take(part, &line.map_err(failed)?, rows)?;
    }
    let status = process.wait().map_err(failed)?;
    if status.success() { Ok(()) } else { Err(format!("regime {}: {status}", regime.name())) }
}

/// A line of a child: a row, or a note as a string.
fn take(part: Part, line: &str, rows: &mut Vec<Row>) -> Result<(), String> {
    let value: Value = serde_json::from_str(line).map_err(|e| format!("{line}: {e}"))?;
    if let Value::String(note) = value {
        println!("{note}");
        return Ok(());
    }
    let row: Row = serde_json::from_value(value).map_err(|e| format!("{line}: {e}"))?;
    table::print_row(part, &row);
    rows.push(row);
    Ok(())
}

fn write(path: &Path, rows: &[Row]) -> Result<(), String> {
    let failed = |e: std::io::Error| format!("{}: {e}", path.display());
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder).map_err(failed)?;
    }
    let text = serde_json::to_string_pretty(rows).map_err(|e| e.to_string())?;
    fs::write(path, text + "\n").map_err(failed)?;
    println!("{} rows in {}", rows.len(), path.display());
    Ok(())
}

/// Measures everything in this process, in one regime, and prints rows as JSON lines.
pub fn run_here(regime: Regime, args: &Args) -> Result<(), String> {
    regime.enter()?;
    let mut emit = |row: Result<Row, String>| {
        // Rows are numbers and strings, which JSON has.
        let line = row.map_or_else(|note| json!(note), |row| json!(row));
        println!("{line}");
    };
    args.parts().iter().try_for_each(|part| part.run(regime, args, &mut emit))
}
