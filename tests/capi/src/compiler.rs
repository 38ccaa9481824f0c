//! C and C++ compilers with every warning an error.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;

use crate::library::{Library, native_libraries, rustc};
use crate::program::{self, Limit};
use crate::{c_directory, root, work_directory};

/// What every source is held to.
const WARNINGS: [&str; 6] =
    ["-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Wshadow", "-Werror"];

/// A compiler, a language standard and flags.
#[derive(Clone, Debug)]
pub struct Compiler {
    /// `gcc` or `clang`.
    pub name: &'static str,
    /// `c99`, `c++17` and the like.
    pub standard: &'static str,
    /// Further flags, for compiling and linking.
    pub flags: Vec<&'static str>,
}

/// Which library a program is linked with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Linkage {
    /// `libcarvel.so`, found at run time where it was built.
    Shared,
    /// `libcarvel.a` and what Rust needs from the system.
    Static,
}

impl Linkage {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Shared, Self::Static];
}

impl Compiler {
    /// GCC as the programs are usually compiled: C99 with POSIX threads.
    pub fn usual() -> Self {
        Self::new("gcc", "c99", &["-pthread"])
    }

    /// A compiler with its flags.
    pub fn new(name: &'static str, standard: &'static str, flags: &[&'static str]) -> Self {
        Self { name, standard, flags: flags.to_vec() }
    }

    /// The command without files.
    pub fn command(&self) -> Command {
        // `cc` knows what this machine's compilers are called and need; out of a
        // build script it must be told what Cargo would tell it.
        let mut build = cc::Build::new();
        build.target(host()).host(host()).opt_level(0).debug(true);
        build.out_dir(work_directory("probes")).cargo_metadata(false).warnings(false);
        build.compiler(self.name);
        let mut command = build.get_compiler().to_command();
        let language = if self.standard.starts_with("c++") { "c++" } else { "c" };
        command.args(["-x", language]).arg(format!("-std={}", self.standard));
        command.args(WARNINGS).args(&self.flags);
        command.arg("-I").arg(root().join("include")).arg("-I").arg(c_directory());
        command
    }

    /// Compiles a source to an object in a directory.
    #[track_caller]
    pub fn compile(&self, source: &Path, directory: &Path) -> PathBuf {
        let stem = source.file_stem().and_then(OsStr::to_str).expect("a source with a name");
        let object = directory.join(format!("{stem}-{}-{}.o", self.name, self.standard));
        let mut command = self.command();
        command.arg("-c").arg(source).arg("-o").arg(&object);
        program::run(&mut command, Limit::PROGRAM);
        object
    }

    /// Links objects to a program in their directory.
    #[track_caller]
    pub fn link(&self, objects: &[PathBuf], library: &Library, linkage: Linkage) -> PathBuf {
        let program = objects[0].with_extension(format!("{linkage:?}").to_lowercase());
        let mut command = Command::new(self.name);
        command.args(&self.flags).args(objects).arg("-o").arg(&program);
        command.args(link_arguments(library, linkage));
        program::run(&mut command, Limit::PROGRAM);
        program
    }
}

fn link_arguments(library: &Library, linkage: Linkage) -> Vec<String> {
    let directory = library.directory.display();
    match linkage {
        Linkage::Shared => {
            vec![format!("-L{directory}"), format!("-Wl,-rpath,{directory}"), "-lcarvel".into()]
        }
        Linkage::Static => {
            let archive = library.directory.join("libcarvel.a").display().to_string();
            // Each program would carry a hundred megabytes of the library's lines.
            let plain = ["-Wl,--strip-debug".to_owned(), archive];
            plain.into_iter().chain(native_libraries().iter().cloned()).collect()
        }
    }
}

/// The machine that tests run on, as Rust names it.
pub fn host() -> &'static str {
    static HOST: OnceLock<String> = OnceLock::new();
    HOST.get_or_init(|| {
        let out = program::run(rustc().arg("-vV"), Limit::TOOL);
        let line = out.stdout.lines().find_map(|l| l.strip_prefix("host: "));
        line.unwrap_or_else(|| panic!("rustc names no host:\n{}", out.stdout)).to_owned()
    })
}
