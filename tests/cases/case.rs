//! One case: a small OBJ file, with its purpose and what is expected in its comments.
//!
//! ```text
//! # A cube divided by a wall: three faces at two edges.      the purpose
//! # expect: error NonManifoldEdge                            or: ok
//! # expect cut: ok                                           under another policy
//! ```
//!
//! `expect` is about topology and positions. Where something else happens with `cut`,
//! with `sharpen`, in `f32`, to its `tags` when a mesh is built, or when the file is
//! `read`, a line of its own says so. `may fail: Kind` allows an error that depends on
//! the scheme.
//!
//! This reader takes the statements as they stand, wrong indices and all, and uses
//! nothing of the library: the same data goes to Rust, C and the command.

#![allow(dead_code, reason = "those who read the cases take different parts")]

use std::collections::BTreeMap;
use std::path::Path;

/// A coordinate index that a corner does not have.
pub const NONE: u32 = u32::MAX;

/// What should come of a case: an error is named as in `ErrorKind`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Outcome {
    Ok,
    Error(String),
}

#[derive(Clone, Debug, Default)]
pub struct Case {
    /// Folder and file, without the extension.
    pub name: String,
    pub purpose: String,
    expected: BTreeMap<String, Outcome>,
    /// The kind of error that some schemes may answer.
    pub may_fail: Option<String>,
    pub positions: Vec<[f64; 3]>,
    pub sizes: Vec<u32>,
    pub indices: Vec<u32>,
    pub uvs: Vec<[f64; 2]>,
    /// Per corner, [`NONE`] where it has none.
    pub uv_indices: Vec<u32>,
    pub creases: Vec<([u32; 2], f32)>,
    pub sharp_vertices: Vec<(u32, f32)>,
    pub holes: Vec<u32>,
}

impl Case {
    fn read(name: &str, text: &str) -> Self {
        let mut case = Self { name: name.to_owned(), ..Self::default() };
        for line in text.lines() {
            match line.strip_prefix('#') {
                Some(comment) => case.comment(comment.trim()),
                None => case.statement(line),
            }
        }
        assert!(!case.purpose.is_empty(), "{name} has no purpose");
        assert!(case.expected.contains_key(""), "{name} does not say what is expected");
        case
    }

    /// What is expected in a situation: `""`, or one of the module's list.
    pub fn expected(&self, situation: &str) -> &Outcome {
        self.expected.get(situation).unwrap_or(&self.expected[""])
    }

    /// What is expected where a situation has a line of its own.
    pub fn special(&self, situation: &str) -> Option<&Outcome> {
        self.expected.get(situation)
    }

    /// True if all faces are triangles.
    pub fn is_triangles(&self) -> bool {
        self.sizes.iter().all(|&size| size == 3)
    }

    /// True if a face is a triangle.
    pub fn has_triangles(&self) -> bool {
        self.sizes.contains(&3)
    }

    /// True if an edge, a vertex or a face is tagged.
    pub fn is_tagged(&self) -> bool {
        !self.creases.is_empty() || !self.sharp_vertices.is_empty() || !self.holes.is_empty()
    }

    /// True if an interior edge or a vertex is sharp.
    pub fn is_sharp(&self) -> bool {
        self.sharp_vertices.iter().any(|&(_, sharpness)| sharpness > 0.0)
            || self.creases.iter().any(|&(ends, sharpness)| sharpness > 0.0 && self.sides(ends) > 1)
    }

    /// The number of times that faces run along an edge.
    fn sides(&self, [a, b]: [u32; 2]) -> usize {
        let mut rest = &self.indices[..];
        let along = |&size: &u32| {
            let (face, later) = rest.split_at(size as usize);
            rest = later;
            let next = face.iter().cycle().skip(1);
            face.iter().zip(next).filter(|&(&x, &y)| [x, y] == [a, b] || [x, y] == [b, a]).count()
        };
        self.sizes.iter().map(along).sum()
    }

    fn comment(&mut self, comment: &str) {
        if let Some((key, outcome)) = comment.split_once(": ") {
            if let Some(situation) = key.strip_prefix("expect") {
                let known = ["", " cut", " sharpen", " f32", " tags", " read"];
                assert!(known.contains(&situation), "{}: {comment}", self.name);
                let old = self.expected.insert(situation.trim().to_owned(), parse(outcome));
                return assert!(old.is_none(), "{}: twice {key}", self.name);
            }
            if key == "may fail" {
                self.may_fail = Some(outcome.to_owned());
                return;
            }
        }
        let space = if self.purpose.is_empty() { "" } else { " " };
        self.purpose += space;
        self.purpose += comment;
    }

    fn statement(&mut self, line: &str) {
        let words: Vec<&str> = line.split_whitespace().collect();
        match words[..] {
            ["v", x, y, z] => self.positions.push([x, y, z].map(number)),
            ["vt", u, v] => self.uvs.push([u, v].map(number)),
            ["f", ref corners @ ..] => self.face(corners),
            ["t", "crease", "2/1/0", a, b, s] => {
                self.creases.push(([a, b].map(number), number(s)));
            }
            ["t", "corner", "1/1/0", v, s] => self.sharp_vertices.push((number(v), number(s))),
            ["t", "hole", _, ref faces @ ..] => {
                self.holes.extend(faces.iter().map(|f| number::<u32>(f)));
            }
            // What belongs to the scheme is the reader's business alone.
            ["t", ..] => {}
            _ => panic!("{}: {line}", self.name),
        }
    }

    fn face(&mut self, corners: &[&str]) {
        self.sizes.push(u32::try_from(corners.len()).expect("a small face"));
        for corner in corners {
            let (vertex, uv) = corner.split_once('/').unwrap_or((corner, "0"));
            self.indices.push(from_zero(vertex));
            self.uv_indices.push(from_zero(uv));
        }
    }
}

/// OBJ counts from 1; 0 stands for nothing, which is out of every range.
fn from_zero(index: &str) -> u32 {
    number::<u32>(index).wrapping_sub(1)
}

#[track_caller]
fn number<T: std::str::FromStr>(word: &str) -> T {
    word.parse().unwrap_or_else(|_| panic!("'{word}' is no number here"))
}

fn parse(outcome: &str) -> Outcome {
    if let Some(kind) = outcome.strip_prefix("error ") {
        return Outcome::Error(kind.to_owned());
    }
    assert_eq!(outcome, "ok");
    Outcome::Ok
}

/// All cases below a folder, in the order of their names.
pub fn all(folder: &Path) -> Vec<Case> {
    let mut cases: Vec<Case> = entries(folder).iter().flat_map(|group| group_of(group)).collect();
    cases.sort_by(|a, b| a.name.cmp(&b.name));
    cases
}

fn group_of(folder: &Path) -> Vec<Case> {
    let group = folder.file_name().expect("a name").to_string_lossy().into_owned();
    let is_case = |path: &&std::path::PathBuf| path.extension().is_some_and(|e| e == "obj");
    let files = if folder.is_dir() { entries(folder) } else { Vec::new() };
    let read = |path: &std::path::PathBuf| {
        let name = format!("{group}/{}", path.file_stem().expect("a name").to_string_lossy());
        let text = std::fs::read_to_string(path).expect("a case can be read");
        Case::read(&name, &text)
    };
    files.iter().filter(is_case).map(read).collect()
}

fn entries(folder: &Path) -> Vec<std::path::PathBuf> {
    let entries = std::fs::read_dir(folder).expect("a folder of cases");
    entries.map(|entry| entry.expect("an entry").path()).collect()
}
