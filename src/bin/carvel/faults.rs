//! Mistakes in a mesh, as lines of the file that it was read from.

use crate::exit::{Doing, Exit, Failure};
use crate::input::Input;
use carvel::mesh::{Defect, Defects};
use carvel::{Element, Error, ErrorKind};
use serde_json::{Value, json};

/// A mistake: what and where.
#[derive(Debug, Clone)]
pub struct Fault {
    /// The library's kind of error, if the library found it.
    pub kind: Option<ErrorKind>,
    /// The line of the face or vertex concerned, where the reader knows it.
    pub line: Option<u32>,
    /// One line, vertices and faces numbered as the file's format does.
    pub message: String,
}

impl Fault {
    /// A defect of the mesh in a file.
    pub fn of_defect(input: &Input, defect: &Defect) -> Self {
        Self {
            kind: Some(defect.kind()),
            line: line_of(input, &defect.elements()),
            message: renumbered(defect, input.base()).to_string(),
        }
    }

    /// An error of the library about the mesh in a file.
    pub fn of_error(input: &Input, error: &Error) -> Self {
        let counted = !error.elements().is_empty() && input.base() != 0;
        let counting = if counted { " (counted from 0)" } else { "" };
        Self {
            kind: Some(error.kind()),
            line: line_of(input, error.elements()),
            message: format!("{error}{counting}"),
        }
    }

    /// The same with the line in front, if it is known.
    pub fn located(&self) -> String {
        let line = self.line.map(|line| format!("line {line}: ")).unwrap_or_default();
        line + &self.message
    }

    /// The same for programs.
    pub fn json(&self) -> Value {
        json!({
            "kind": self.kind.map(|kind| format!("{kind:?}")),
            "line": self.line,
            "message": self.message,
        })
    }

    /// The same with the file in front: `cow.obj:17: face 3 ...`.
    pub fn in_file(&self, input: &Input) -> String {
        match self.line {
            Some(line) => format!("{}:{line}: {}", input.name, self.message),
            None => format!("{}: {}", input.name, self.message),
        }
    }
}

/// The failure of a mesh that could not be built: its first defect.
pub fn failure(input: &Input, defects: &Defects) -> Failure {
    let list = match defects {
        Defects::Call(error) => return of_work(input, error),
        Defects::Soup(list) => list,
    };
    let Some(first) = list.first() else {
        return Failure::new(Exit::Mesh, format!("{}: a defective mesh", input.name));
    };
    let fault = Fault::of_defect(input, first);
    let more = match list.len() - 1 {
        0 => String::new(),
        1 => " (and one more defect: see carvel info)".to_owned(),
        n => format!(" (and {n} more defects: see carvel info)"),
    };
    Failure {
        exit: Exit::of(first.kind(), Doing::Working),
        message: fault.in_file(input) + &more,
        kind: fault.kind,
        silent: false,
    }
}

/// The failure of work on a mesh.
pub fn of_work(input: &Input, error: &Error) -> Failure {
    let fault = Fault::of_error(input, error);
    Failure { message: fault.in_file(input), ..Failure::from_error(error, Doing::Working) }
}

/// The line of the last face named (of two that quarrel the later one is the
/// likelier culprit), or else of the vertex.
fn line_of(input: &Input, elements: &[Element]) -> Option<u32> {
    let face = elements.iter().rev().find_map(|element| match element {
        Element::Face(face) => line(&input.file.face_lines, *face),
        _ => None,
    });
    face.or_else(|| {
        elements.iter().find_map(|element| match element {
            Element::Vertex(vertex) => line(&input.file.vertex_lines, *vertex),
            _ => None,
        })
    })
}

fn line(lines: &[u32], index: u64) -> Option<u32> {
    lines.get(usize::try_from(index).ok()?).copied()
}

/// The defect with its vertices and faces counted from `base`.
fn renumbered(defect: &Defect, base: u64) -> Defect {
    let all = |faces: &[u64]| faces.iter().map(|f| f + base).collect();
    let both = |edge: (u64, u64)| (edge.0 + base, edge.1 + base);
    match defect {
        Defect::FaceTooSmall { face, size } => {
            Defect::FaceTooSmall { face: face + base, size: *size }
        }
        Defect::IndexOutOfRange { face, vertex, vertices } => Defect::IndexOutOfRange {
            face: face + base,
            vertex: vertex + base,
            vertices: *vertices,
        },
        Defect::RepeatedVertex { face, vertex } => {
            Defect::RepeatedVertex { face: face + base, vertex: vertex + base }
        }
        Defect::InconsistentOrientation { edge, faces } => {
            Defect::InconsistentOrientation { edge: both(*edge), faces: all(faces) }
        }
        Defect::NonManifoldEdge { edge, faces } => {
            Defect::NonManifoldEdge { edge: both(*edge), faces: all(faces) }
        }
        Defect::NonManifoldVertex { vertex } => Defect::NonManifoldVertex { vertex: vertex + base },
        other => other.clone(),
    }
}
