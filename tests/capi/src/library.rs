//! Builds the library once per process, and lays it out as an installation does.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;

use serde_json::Value;

use crate::program::{self, Limit};
use crate::root;

/// The library, built with the C interface alone.
#[derive(Debug, Clone)]
pub struct Library {
    /// Holds `libcarvel.so`, the link of its soname, and `libcarvel.a`.
    pub directory: PathBuf,
    /// The shared library as Cargo built it.
    pub shared: PathBuf,
    /// The static library.
    pub archive: PathBuf,
    /// The Rust library.
    pub rlib: PathBuf,
    /// The name that programs record.
    pub soname: String,
}

/// All of the debug information, in one unit: without it interfaces compare as equal to anything.
pub const DESCRIBED: [&str; 2] = [
    "--config=profile.dev.package.carvel.debug=2",
    "--config=profile.dev.package.carvel.codegen-units=1",
];

/// The library, in the profile of the running test; described, if that is the one for
/// development.
pub fn library() -> &'static Library {
    static LIBRARY: OnceLock<Library> = OnceLock::new();
    LIBRARY.get_or_init(|| {
        let extra: &[&str] = if cfg!(debug_assertions) { &DESCRIBED } else { &["--release"] };
        build(&target_directory(), "cargo", extra, &[])
    })
}

/// The compiler that builds the library.
pub fn rustc() -> Command {
    Command::new(std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into()))
}

/// What a Rust static library needs from the system, as the compiler tells.
pub fn native_libraries() -> &'static [String] {
    static NATIVE: OnceLock<Vec<String>> = OnceLock::new();
    NATIVE.get_or_init(|| {
        // An empty crate needs what every crate needs. The output is a file of our
        // own: rustc replaces what it is told to write, devices included.
        let directory = target_directory().join("native");
        std::fs::create_dir_all(&directory).expect("a folder for an empty crate");
        let source = directory.join("empty.rs");
        std::fs::write(&source, "").expect("a place for an empty crate");
        let args = ["--crate-type=staticlib", "--print=native-static-libs", "--out-dir"];
        let out = program::run(rustc().args(args).arg(&directory).arg(source), Limit::BUILD);
        let line = out.stderr.lines().find_map(|l| l.split("native-static-libs: ").nth(1));
        let line = line.unwrap_or_else(|| panic!("rustc names no libraries:\n{}", out.stderr));
        line.split_whitespace().map(str::to_owned).collect()
    })
}

/// Where this process's library and programs go: a folder of its own beside the
/// tests', or the two builds, with other features, would undo each other.
pub fn target_directory() -> PathBuf {
    let test = std::env::current_exe().expect("a test knows where it is");
    // target/debug/deps/test-0123
    test.ancestors().nth(3).expect("tests lie three below the target").join("capi")
}

/// Builds the library with a Cargo command and further arguments and variables.
pub fn build(target: &Path, cargo: &str, extra: &[&str], vars: &[(&str, &str)]) -> Library {
    let mut command = Command::new(cargo.split(' ').next().unwrap_or(cargo));
    command.args(cargo.split(' ').skip(1)).current_dir(root());
    command.args(["build", "--locked", "--package=carvel", "--lib", "--no-default-features"]);
    command.args(["--features=capi", "--message-format=json-render-diagnostics"]);
    command.arg("--target-dir").arg(target).args(extra);
    command.envs(vars.iter().copied());
    let out = program::run(&mut command, Limit::BUILD);
    let files = artifacts(&out.stdout);
    let find = |extension: &str| {
        let found = files.iter().find(|f| f.extension().is_some_and(|e| e == extension));
        found.unwrap_or_else(|| panic!("cargo built no {extension}: {files:?}")).clone()
    };
    stage(find("so"), find("a"), find("rlib"))
}

/// The files of the crate, from Cargo's messages.
fn artifacts(messages: &str) -> Vec<PathBuf> {
    let messages = messages.lines().filter_map(|l| serde_json::from_str::<Value>(l).ok());
    let of_carvel =
        |m: &Value| m["reason"] == "compiler-artifact" && m["target"]["name"] == "carvel";
    let files = messages.filter(of_carvel).map(|m| m["filenames"].clone());
    let paths = files.flat_map(|f| f.as_array().cloned().unwrap_or_default());
    paths.filter_map(|p| p.as_str().map(PathBuf::from)).collect()
}

fn stage(shared: PathBuf, archive: PathBuf, rlib: PathBuf) -> Library {
    let soname = soname(&shared);
    let directory = shared.with_file_name("staged");
    std::fs::create_dir_all(&directory).expect("a folder for the libraries");
    link(&shared, &directory.join(&soname));
    link(&shared, &directory.join("libcarvel.so"));
    link(&archive, &directory.join("libcarvel.a"));
    Library { directory, shared, archive, rlib, soname }
}

/// Points a link at a file, at once for whoever looks.
fn link(file: &Path, at: &Path) {
    let own = at.with_extension(std::process::id().to_string());
    std::os::unix::fs::symlink(file, &own).expect("a symbolic link");
    std::fs::rename(&own, at).expect("a link in place");
}

/// The name that a shared library gives itself.
pub fn soname(shared: &Path) -> String {
    let mut names = dynamic(shared, "(SONAME)");
    assert_eq!(names.len(), 1, "{} has not one soname: {names:?}", shared.display());
    names.swap_remove(0)
}

/// What a shared library or a program records under a tag: its name, what it needs.
pub fn dynamic(file: &Path, tag: &str) -> Vec<String> {
    let table = program::run(Command::new("readelf").arg("-dW").arg(file), Limit::TOOL);
    let lines = table.stdout.lines().filter(|line| line.contains(tag));
    lines.filter_map(|line| Some(line.split(['[', ']']).nth(1)?.to_owned())).collect()
}

/// The names that an `nm` with these arguments finds.
pub fn symbols(arguments: &[&str], file: &Path) -> BTreeSet<String> {
    let table = program::run(Command::new("nm").args(arguments).arg(file), Limit::TOOL);
    let lines = table.stdout.lines();
    lines.filter_map(|line| Some(line.rsplit_once(' ')?.1.to_owned())).collect()
}
