//! Running compilers and tools; a failure shows what they said.

use std::ffi::OsStr;
use std::io::ErrorKind;
use std::process::{Command, Output};

/// A command without what cargo and make put into the environment of the tests: it
/// would reach the library that is built, and the loader that looks for it.
pub fn command(program: impl AsRef<OsStr>) -> Command {
    let mut command = Command::new(program);
    for name in ["MAKEFLAGS", "MFLAGS", "MAKELEVEL", "LD_LIBRARY_PATH", "PROFILE"] {
        command.env_remove(name);
    }
    for name in ["PREFIX", "DESTDIR", "LIBDIR", "INCLUDEDIR", "STRIP_DEBUG"] {
        command.env_remove(name);
    }
    command
}

/// Runs to the end, whatever that is.
pub fn output(command: &mut Command) -> Output {
    match command.output() {
        Ok(output) => output,
        Err(error) if error.kind() == ErrorKind::NotFound => panic!(
            "{} is not installed; `make test-tools` installs what these tests need",
            command.get_program().display()
        ),
        Err(error) => panic!("{command:?}: {error}"),
    }
}

/// Runs and must succeed; gives what was printed, without the last line's end.
pub fn run(command: &mut Command) -> String {
    let output = output(command);
    assert!(
        output.status.success(),
        "{command:?}: {}\n{}{}",
        output.status,
        String::from_utf8_lossy(&output.stdout),
        String::from_utf8_lossy(&output.stderr)
    );
    String::from_utf8(output.stdout).expect("text").trim_end().to_owned()
}

/// Runs and must fail; gives what was said.
pub fn refused(command: &mut Command) -> String {
    let output = output(command);
    assert!(!output.status.success(), "{command:?} succeeded");
    String::from_utf8_lossy(&output.stderr).into_owned()
}
