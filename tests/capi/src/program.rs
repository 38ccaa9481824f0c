//! Runs programs within a time limit, and tells all when one fails.

use std::io::{ErrorKind, Read};
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
    /// Cargo, and programs under valgrind.
    pub const BUILD: Self = Self(Duration::from_secs(900));
}

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

/// Runs a program whatever it comes to.
///
/// # Panics
/// If it cannot be started or does not end in time.
#[track_caller]
pub fn attempt(command: &mut Command, limit: Limit) -> Output {
    // Cargo's would come before the place that a program was linked to look in.
    if command.get_envs().all(|(name, _)| name != "LD_LIBRARY_PATH") {
        command.env_remove("LD_LIBRARY_PATH");
    }
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

/// Waits, and ends what takes too long.
fn wait(child: &mut Child, limit: Limit) -> Option<ExitStatus> {
    let begun = Instant::now();
    while begun.elapsed() < limit.0 {
        if let Some(status) = child.try_wait().expect("a child") {
            return Some(status);
        }
        std::thread::sleep(Duration::from_millis(5));
    }
    let _ = child.kill();
    None
}
