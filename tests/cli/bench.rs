//! A work bench: a fresh directory, the command, and what it said.

use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use tempfile::TempDir;

/// The cow's control mesh.
pub const COW: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/assets/spot/spot_control_mesh.obj");

/// A cube.
pub const CUBE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 0 0 1\nv 1 0 1\nv 0 1 1\nv 1 1 1\n\
    f 1 2 4 3\nf 5 7 8 6\nf 1 5 6 2\nf 3 4 8 7\nf 1 3 7 5\nf 2 6 8 4\n";

/// Two quads side by side, open.
pub const STRIP: &str = "v 0 0 0\nv 1 0 0\nv 2 0 1\nv 0 1 0\nv 1 1 0\nv 2 1 0\n\
    f 1 2 5 4\nf 2 3 6 5\n";

/// A fresh directory in which the command runs.
pub struct Bench(TempDir);

/// What a run left behind.
pub struct Run {
    /// The exit code.
    pub code: i32,
    /// The standard output.
    pub out: Vec<u8>,
    /// The standard error stream.
    pub err: String,
}

impl Bench {
    pub fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    pub fn path(&self) -> &Path {
        self.0.path()
    }

    /// Puts a file there.
    pub fn put(&self, name: &str, content: impl AsRef<[u8]>) -> &Self {
        fs::write(self.path().join(name), content).unwrap();
        self
    }

    pub fn get(&self, name: &str) -> Vec<u8> {
        fs::read(self.path().join(name)).unwrap_or_else(|e| panic!("{name}: {e}"))
    }

    pub fn mesh(&self, name: &str) -> carvel::io::MeshFile {
        let path = self.path().join(name);
        carvel::io::read(&path, &carvel::io::ReadOptions::default()).unwrap()
    }

    /// All files, hidden ones included, in order.
    pub fn files(&self) -> Vec<String> {
        list(self.path())
    }

    /// The command with arguments separated by blanks.
    pub fn command(&self, args: &str) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_carvel"));
        command.args(args.split_whitespace()).current_dir(self.path());
        command
    }

    pub fn run(&self, args: &str) -> Run {
        Run::of(self.command(args).stdin(Stdio::null()).output().unwrap())
    }

    /// Runs with arguments that may be empty.
    pub fn run_list(&self, args: &[&str]) -> Run {
        Run::of(self.command("").args(args).stdin(Stdio::null()).output().unwrap())
    }

    pub fn run_with_input(&self, args: &str, input: &[u8]) -> Run {
        let mut command = self.command(args);
        command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut child = command.spawn().unwrap();
        // A child that refuses early closes its end.
        let _ = child.stdin.take().unwrap().write_all(input);
        Run::of(child.wait_with_output().unwrap())
    }
}

fn list(directory: &Path) -> Vec<String> {
    let entries = fs::read_dir(directory).unwrap().map(|e| e.unwrap().path());
    let mut names: Vec<String> = entries.map(|path: PathBuf| name(&path)).collect();
    names.sort();
    names
}

fn name(path: &Path) -> String {
    path.file_name().unwrap().to_string_lossy().into_owned()
}

impl Run {
    fn of(output: Output) -> Self {
        Self {
            code: output.status.code().expect("the command was not killed"),
            out: output.stdout,
            err: String::from_utf8(output.stderr).unwrap(),
        }
    }

    /// The run went well.
    #[track_caller]
    pub fn ok(self) -> Self {
        assert_eq!(self.code, 0, "{}", self.err);
        self
    }

    /// The run failed with a code and one line that holds some words.
    #[track_caller]
    pub fn fails(self, code: i32, words: &str) -> Self {
        assert_eq!(self.code, code, "{}", self.err);
        let line = self.err.strip_suffix('\n').unwrap_or("no line");
        assert!(line.starts_with("carvel: ") && !line.contains('\n'), "{line}");
        assert!(line.contains(words), "{line}");
        self
    }

    pub fn out_text(&self) -> &str {
        std::str::from_utf8(&self.out).unwrap()
    }

    pub fn json(&self) -> serde_json::Value {
        serde_json::from_slice(&self.out).unwrap_or_else(|e| panic!("{e}: {}", self.out_text()))
    }
}

/// The faces of a mesh from their smallest vertex on, in order.
pub fn faces_by_vertex(mesh: &carvel::io::MeshFile) -> Vec<Vec<u32>> {
    let turned = |face: &[u32]| {
        let first = (0..face.len()).min_by_key(|&i| face[i]).unwrap();
        [&face[first..], &face[..first]].concat()
    };
    let mut faces: Vec<_> = mesh.faces().map(turned).collect();
    faces.sort_unstable();
    faces
}
