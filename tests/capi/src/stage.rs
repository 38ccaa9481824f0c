//! carvel installed into a temporary folder, with `make install` in a copy of the
//! sources; spaces in every path.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;

use tempfile::TempDir;

use crate::program::{self, Limit, printed};
use crate::{c_directory, root, work_directory};

/// A stage, removed when it is dropped.
#[derive(Debug)]
pub struct Stage {
    /// Room for the tests beside the stage.
    pub room: TempDir,
    /// A folder without spaces in its name.
    pub plain: TempDir,
    /// What was given to make.
    variables: Vec<(&'static str, PathBuf)>,
}

impl Stage {
    /// Nothing installed: `prefix` below a DESTDIR, or relative, and then a folder of
    /// its own without one.
    pub fn new(prefix: &str, more: &[(&'static str, &str)]) -> Self {
        let room = TempDir::with_prefix("carvel stage ").expect("a temporary folder");
        let mut variables = vec![("PREFIX", room.path().join(prefix))];
        if prefix.starts_with('/') {
            variables.push(("DESTDIR", room.path().join("the stage")));
        }
        variables.extend(more.iter().map(|(name, value)| (*name, PathBuf::from(value))));
        let plain = TempDir::with_prefix("carvel-plain-").expect("a temporary folder");
        Self { room, plain, variables }
    }

    /// With everything installed.
    pub fn installed(prefix: &str, more: &[(&'static str, &str)]) -> Self {
        let stage = Self::new(prefix, more);
        printed(&mut stage.make("install"));
        stage
    }

    /// `make` in the copy of the sources. What is built is only installed: cargo would fail.
    pub fn make(&self, goal: &str) -> Command {
        let mut make = make();
        make.args([goal, "CARGO=false"]);
        for (name, value) in &self.variables {
            make.arg(format!("{name}={}", value.display()));
        }
        make
    }

    /// Where `path` below the prefix really is.
    pub fn at(&self, path: &str) -> PathBuf {
        let prefix = &self.variables[0].1;
        let below = prefix.strip_prefix("/").expect("an absolute prefix");
        self.destdir().map_or_else(|| prefix.clone(), |destdir| destdir.join(below)).join(path)
    }

    /// DESTDIR.
    pub fn destdir(&self) -> Option<&Path> {
        let place = self.variables.iter().find(|(name, _)| *name == "DESTDIR");
        place.map(|(_, path)| path.as_path())
    }

    /// A program compiled with `flags`, which a shell reads, and run; gives what it prints.
    pub fn program(&self, compiler: &str, source: &str, flags: &str, name: &str) -> String {
        let program = self.room.path().join(name);
        let script = format!("exec {compiler} -Wall -Wextra -Werror \"$1\" -o \"$2\" {flags}");
        printed(
            Command::new("sh")
                .args(["-c", &script, "sh"])
                .arg(c_directory().join(source))
                .arg(&program),
        );
        printed(Command::new(&program).env("LD_LIBRARY_PATH", self.at("lib")))
    }
}

/// The whole tree, relative and sorted; folders end in `/`.
pub fn tree(root: &Path) -> Vec<String> {
    let mut found = Vec::new();
    let mut folders = vec![root.to_path_buf()];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder).expect("a folder").map(|entry| entry.expect("an entry"))
        {
            let name = entry.path().strip_prefix(root).expect("below").display().to_string();
            if entry.file_type().expect("a type").is_dir() {
                folders.push(entry.path());
                found.push(name + "/");
            } else {
                found.push(name);
            }
        }
    }
    found.sort();
    found
}

/// `make` in a copy of the sources, both libraries built.
fn make() -> Command {
    static COPY: OnceLock<PathBuf> = OnceLock::new();
    let copy = COPY.get_or_init(|| {
        let copy = work_directory("a copy of carvel");
        copy_sources(&copy);
        program::run(&mut make_in(&copy, "lib"), Limit::BUILD);
        copy
    });
    make_in(copy, "--silent")
}

fn make_in(copy: &Path, argument: &str) -> Command {
    let mut make = Command::new("make");
    make.arg("-C").arg(copy).arg(argument).env("CARGO_TARGET_DIR", copy.join("target"));
    let profile = std::env::var("INSTALL_PROFILE").unwrap_or_else(|_| "dev".to_owned());
    make.arg(format!("PROFILE={profile}"));
    make
}

/// Copies what is built and installed. What has not changed keeps its date, so that a
/// second run builds nothing.
fn copy_sources(copy: &Path) {
    for folder in ["benches", "cpp", "docs", "include", "packaging", "src", "tests"] {
        copy_folder(&root().join(folder), &copy.join(folder));
    }
    let files = ["Makefile", "Cargo.toml", "Cargo.lock", "build.rs", "README.md"];
    for file in files.into_iter().chain(["LICENSE-APACHE", "LICENSE-MIT"]) {
        copy_file(&root().join(file), &copy.join(file));
    }
}

fn copy_folder(from: &Path, to: &Path) {
    fs::create_dir_all(to).expect("a folder");
    for old in names(to) {
        if !from.join(&old).exists() {
            let old = to.join(old);
            let removed =
                if old.is_dir() { fs::remove_dir_all(&old) } else { fs::remove_file(&old) };
            removed.expect("an old file goes");
        }
    }
    for name in names(from) {
        let (from, to) = (from.join(&name), to.join(&name));
        if from.is_dir() { copy_folder(&from, &to) } else { copy_file(&from, &to) }
    }
}

fn copy_file(from: &Path, to: &Path) {
    let content = fs::read(from).expect("a source file");
    if fs::read(to).ok().as_ref() != Some(&content) {
        fs::copy(from, to).expect("a copy");
    }
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("a folder");
    entries.map(|entry| entry.expect("an entry").file_name().into_string().expect("text")).collect()
}
