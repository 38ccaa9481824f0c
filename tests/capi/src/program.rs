//! Runs programs within a time limit, and tells all when one fails.

use std::io::{ErrorKind, Read};
use std::os::unix::process::CommandExt;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

/// How long a program may take on a busy machine.
#[derive(Clone, Copy, Debug)]
pub struct Limit(pub Duration);

impl Limit {
    /// Programs that look at a file.
    pub const TOOL: Self = Self(Duration::from_secs(60));
    /// Compilers and test programs.
    pub const PROGRAM: Self = Self(Duration::from_secs(120));
    /// What runs many programs: CMake, `make install`, the compilers of a shell's line.
    pub const MAKE: Self = Self(Duration::from_secs(300));
    /// Cargo, and programs under valgrind.
    pub const BUILD: Self = Self(Duration::from_secs(900));
}

/// What cargo and make put into the environment of the tests, and what a packager may
/// have there: it would reach the library that is built, the program that is installed,
/// or come before the place that a program was linked to look in.
const INHERITED: [&str; 10] = [
    "LD_LIBRARY_PATH",
    "MAKEFLAGS",
    "MFLAGS",
    "MAKELEVEL",
    "PROFILE",
    "PREFIX",
    "DESTDIR",
    "LIBDIR",
    "INCLUDEDIR",
    "STRIP_DEBUG",
];

/// What a program left behind.
#[derive(Debug)]
pub struct Output {
    /// How it ended.
    pub status: ExitStatus,
    /// What it printed.
    pub stdout: String,
    /// What it complained of.
    pub stderr: String,
}

/// Runs a program that must succeed.
///
/// # Panics
/// If it does not, with the command line and everything it printed.
#[track_caller]
pub fn run(command: &mut Command, limit: Limit) -> Output {
    let output = attempt(command, limit);
    assert!(output.status.success(), "{}", report(command, &output));
    output
}

/// Runs a tool that must succeed; gives what it printed, without the last line's end.
///
/// # Panics
/// If it does not.
#[track_caller]
pub fn printed(command: &mut Command) -> String {
    run(command, Limit::MAKE).stdout.trim_end().to_owned()
}

/// Runs a tool that must fail; gives what it complained of.
///
/// # Panics
/// If it succeeds.
#[track_caller]
pub fn refused(command: &mut Command) -> String {
    let output = attempt(command, Limit::MAKE);
    assert!(!output.status.success(), "succeeded: {}", report(command, &output));
    output.stderr
}

/// Runs a program whatever it comes to, without the variables that tests inherit,
/// unless the command sets them itself.
///
/// # Panics
/// If it cannot be started or does not end in time.
#[track_caller]
pub fn attempt(command: &mut Command, limit: Limit) -> Output {
    for inherited in INHERITED {
        if command.get_envs().all(|(name, _)| name != inherited) {
            command.env_remove(inherited);
        }
    }
    // A group of its own, so that what it started can be ended with it.
    command.process_group(0);
    command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = command.spawn().unwrap_or_else(|e| panic!("{}", not_started(command, &e)));
    let stdout = drain(child.stdout.take().expect("a pipe"));
    let stderr = drain(child.stderr.take().expect("a pipe"));
    let ended = wait(&mut child, limit);
    let text = |pipe: JoinHandle<String>| pipe.join().expect("a reader");
    let status = ended.unwrap_or_else(|| child.wait().expect("a child"));
    let output = Output { status, stdout: text(stdout), stderr: text(stderr) };
    assert!(ended.is_some(), "not done in {:?}: {}", limit.0, report(command, &output));
    output
}

/// A command line with how it went.
pub fn report(command: &Command, output: &Output) -> String {
    let Output { status, stdout, stderr } = output;
    format!("{command:?}\n{status}\n--- stdout\n{stdout}\n--- stderr\n{stderr}")
}

fn not_started(command: &Command, error: &std::io::Error) -> String {
    let hint = match error.kind() {
        ErrorKind::NotFound => " (`make test` and assets/install.sh install what is needed)",
        _ => "",
    };
    format!("{command:?}: {error}{hint}")
}

fn drain(mut pipe: impl Read + Send + 'static) -> JoinHandle<String> {
    std::thread::spawn(move || {
        let mut bytes = Vec::new();
        // What came before an error is worth showing.
        let _ = pipe.read_to_end(&mut bytes);
        String::from_utf8_lossy(&bytes).into_owned()
    })
}

/// Waits, and ends what takes too long, with everything that it started: a compiler
/// that hangs below CMake would hold the pipes open.
fn wait(child: &mut Child, limit: Limit) -> Option<ExitStatus> {
    let begun = Instant::now();
    while begun.elapsed() < limit.0 {
        if let Some(status) = child.try_wait().expect("a child") {
            return Some(status);
        }
        std::thread::sleep(Duration::from_millis(5));
    }
    let group = format!("-{}", child.id());
    let killed = Command::new("kill").args(["-KILL", "--", &group]).status();
    if !killed.is_ok_and(|status| status.success()) {
        let _ = child.kill();
    }
    None
}

#[cfg(test)]
mod tests {
    use std::panic::catch_unwind;
    use std::process::Command;
    use std::time::{Duration, Instant};

    use super::{Limit, attempt};

    /// Not only the shell is ended: the program that it waits for holds its pipes.
    #[test]
    fn what_hangs_is_ended_with_what_it_started() {
        let begun = Instant::now();
        let hang = || {
            let mut shell = Command::new("sh");
            shell.args(["-c", "echo begun; sleep 60; echo done"]);
            attempt(&mut shell, Limit(Duration::from_millis(300)))
        };
        let said = *catch_unwind(hang).expect_err("a limit").downcast::<String>().expect("text");
        assert!(said.contains("not done in 300ms") && said.contains("begun"), "{said}");
        assert!(begun.elapsed() < Duration::from_secs(30), "{:?}", begun.elapsed());
    }
}
