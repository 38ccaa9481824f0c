//! What the tests of the C interface share: the library as a host has it, C
//! compilers with every warning an error, and programs that run within a limit.
//!
//! A missing tool is a failure that says how to get it, never a skipped test.

pub mod agreement;
pub mod compiler;
pub mod header;
pub mod library;
pub mod program;
pub mod sources;
pub mod stage;
pub mod version;

use std::path::{Path, PathBuf};

/// The repository.
pub fn root() -> &'static Path {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    here.ancestors().nth(2).expect("tests/capi lies two below the root")
}

/// The directory of the C programs.
pub fn c_directory() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("c")
}

/// A directory for what a test builds, made if it is not there. Its path has a
/// space, so that nothing is tested without one.
pub fn work_directory(name: &str) -> PathBuf {
    let path = library::target_directory().join("c programs").join(name);
    std::fs::create_dir_all(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    path
}
