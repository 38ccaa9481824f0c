//! The C programs, and what they call.

use std::collections::BTreeSet;
use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::compiler::Compiler;
use crate::program::{self, Limit};
use crate::{c_directory, work_directory};

/// What every program is linked with.
const SHARED: [&str; 3] = ["check", "fixture", "reading"];

/// The programs' names: every source that is neither linked with all of them nor
/// for an installed library.
pub fn programs() -> Vec<String> {
    let entries = std::fs::read_dir(c_directory()).expect("the C programs can be listed");
    let paths = entries.map(|e| e.expect("a directory entry").path());
    let sources = paths.filter(|p| p.extension().is_some_and(|e| e == "c"));
    let stem = |p: PathBuf| p.file_stem().and_then(OsStr::to_str).map(str::to_owned);
    let mut names: Vec<String> = sources.filter_map(stem).collect();
    names.retain(|n| !SHARED.contains(&n.as_str()) && !n.starts_with("install_"));
    names.sort();
    names
}

/// Compiles a program and what it is linked with; its own object comes first.
#[track_caller]
pub fn objects(program: &str, compiler: &Compiler, directory: &Path) -> Vec<PathBuf> {
    let sources = [program].into_iter().chain(SHARED);
    let path = |name: &str| c_directory().join(format!("{name}.c"));
    sources.map(|name| compiler.compile(&path(name), directory)).collect()
}

/// Every function of the library that the C programs call: what their objects
/// leave undefined.
pub fn called_functions() -> BTreeSet<String> {
    let directory = work_directory("called");
    let compile = |name: String| objects(&name, &Compiler::usual(), &directory).swap_remove(0);
    let mut nm = Command::new("nm");
    nm.arg("--undefined-only").args(programs().into_iter().map(compile));
    let out = program::run(&mut nm, Limit::TOOL);
    let symbols = out.stdout.lines().filter_map(|l| l.trim().strip_prefix("U "));
    symbols.filter(|s| s.starts_with("carvel_")).map(str::to_owned).collect()
}
