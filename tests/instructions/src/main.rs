//! Counts the instructions of the main paths under valgrind and holds them to the recorded
//! numbers, so that a regression is seen on a machine whose clock says nothing.
//!
//! `carvel-instructions` compares, `carvel-instructions --record` records. The program starts
//! itself under `valgrind --tool=callgrind` for one call and for two; the difference is what
//! a call costs once memory is there.

mod paths;

use paths::PATHS;
use serde_json::{Map, Value};
use std::collections::BTreeMap;
use std::path::Path;
use std::process::{Command, ExitCode};

/// By how much a count may grow: compilers change, and so does what the C library picks.
const BOUND: f64 = 0.15;

const RECORDED: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/recorded.json");

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let done = match arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        [] => compare(),
        ["--record"] => record(),
        ["--run", path, calls] => run(path, calls),
        _ => Err("usage: carvel-instructions [--record]".into()),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(reason) => {
            eprintln!("carvel-instructions: {reason}");
            ExitCode::FAILURE
        }
    }
}

/// Does what is counted and prints how many units a call makes.
fn run(path: &str, calls: &str) -> Result<(), String> {
    let number = |text: &str| text.parse::<u32>().map_err(|e| format!("{text}: {e}"));
    let (path, calls) = (number(path)?, number(calls)?);
    let (_, work) = PATHS.get(path as usize).ok_or_else(|| format!("no path {path}"))?;
    println!("{}", work(calls));
    Ok(())
}

/// Instructions of a process of `calls` calls, and units per call.
fn counted(path: usize, calls: u32) -> Result<(f64, f64), String> {
    let own = std::env::current_exe().map_err(|e| format!("this program: {e}"))?;
    let mut command = Command::new("valgrind");
    command.args(["--tool=callgrind", "--callgrind-out-file=/dev/null"]).arg(own);
    command.args(["--run", &path.to_string(), &calls.to_string()]);
    let out = command.output().map_err(|e| format!("valgrind: {e}"))?;
    let (said, told) = (String::from_utf8_lossy(&out.stdout), String::from_utf8_lossy(&out.stderr));
    let units = said.trim().parse().ok();
    let collected = told.lines().find_map(|line| line.split("Collected : ").nth(1)?.parse().ok());
    let both = collected.zip(units).filter(|_| out.status.success());
    both.ok_or_else(|| format!("path {path} under valgrind, {}:\n{told}", out.status))
}

/// Instructions per unit of every path.
fn count_all() -> Result<BTreeMap<&'static str, f64>, String> {
    let mut counts = BTreeMap::new();
    for (path, (name, _)) in PATHS.iter().enumerate() {
        let ((once, _), (twice, units)) = (counted(path, 1)?, counted(path, 2)?);
        counts.insert(*name, (twice - once) / units);
    }
    Ok(counts)
}

/// True if instructions can be counted here; says why not.
fn can_count() -> bool {
    let reason = if !cfg!(target_arch = "x86_64") {
        "the recorded numbers are those of x86-64"
    } else if Command::new("valgrind").arg("--version").output().is_err() {
        "valgrind is missing (apt-get install valgrind)"
    } else {
        return true;
    };
    println!("SKIPPED: instructions are not counted: {reason}");
    false
}

fn record() -> Result<(), String> {
    if !can_count() {
        return Err("nothing recorded".into());
    }
    let counts = count_all()?;
    let rounded = |count: &f64| Value::from((count * 10.0).round() / 10.0);
    let ordered = PATHS.iter().map(|(name, _)| ((*name).to_owned(), rounded(&counts[name])));
    let object: Map<String, Value> = ordered.collect();
    let text = serde_json::to_string_pretty(&object).map_err(|e| e.to_string())?;
    std::fs::write(Path::new(RECORDED), text + "\n").map_err(|e| format!("{RECORDED}: {e}"))
}

fn compare() -> Result<(), String> {
    if !can_count() {
        return Ok(());
    }
    let text = std::fs::read_to_string(RECORDED).map_err(|e| format!("{RECORDED}: {e}"))?;
    let recorded: BTreeMap<String, f64> =
        serde_json::from_str(&text).map_err(|e| format!("{RECORDED}: {e}"))?;
    let mut grown = Vec::new();
    println!("{:45} {:>9} {:>9}", "instructions", "recorded", "now");
    for (name, count) in count_all()? {
        let before = recorded.get(name).ok_or_else(|| format!("{name} is not recorded"))?;
        let change = count / before - 1.0;
        println!("{name:45} {before:>9.1} {count:>9.1} {:>+6.1} %", 100.0 * change);
        if change > BOUND {
            grown.push(name);
        }
    }
    if grown.is_empty() {
        return Ok(());
    }
    Err(format!(
        "more than {:.0} % more instructions than recorded: {}; if that is meant, \
         `make count-record` and say why",
        100.0 * BOUND,
        grown.join("; ")
    ))
}
