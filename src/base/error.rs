//! One opaque error: a kind to branch on, the elements concerned, a sentence.

use std::fmt;

/// The result of every fallible call in this crate.
pub type Result<T, E = Error> = std::result::Result<T, E>;

/// What went wrong, for programs; the numbers are stable and never reused.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[non_exhaustive]
#[repr(i32)]
pub enum ErrorKind {
    /// A face names a vertex that does not exist.
    IndexOutOfRange = 1,
    /// A face has fewer than three vertices.
    FaceTooSmall = 2,
    /// A vertex occurs twice in one face.
    RepeatedVertex = 3,
    /// Two faces run through an edge in the same direction.
    InconsistentOrientation = 4,
    /// More than two faces share an edge.
    NonManifoldEdge = 5,
    /// The faces around a vertex form more than one fan.
    NonManifoldVertex = 6,
    /// A size does not fit the index type.
    TooLarge = 7,
    /// A mesh marked *anchored* does not have the shape that a dual step leaves.
    NotAnchored = 8,
    /// A tag names an element that cannot carry it.
    InvalidTag = 9,
    /// A slice has another length than the mesh asks for.
    LengthMismatch = 10,
    /// A coordinate is NaN or infinite.
    NotFinite = 11,
    /// A finite coordinate left the range of the number type on the way.
    Overflow = 12,
    /// A parameter lies outside its documented range.
    ParameterOutOfRange = 13,
    /// A text is not a number, a fraction or a known name.
    InvalidText = 14,
    /// The work would need more memory than the ceiling allows.
    MemoryCeiling = 15,
    /// The system refused memory or threads.
    OutOfResources = 16,
    /// The progress callback or the cancel flag asked to stop.
    Cancelled = 17,
    /// A file could not be opened, read or written.
    Io = 18,
    /// A file's content breaks its format.
    Syntax = 19,
    /// A file format, or something in a file, is not supported.
    Unsupported = 20,
    /// A stored invariant does not hold: a defect of this library.
    BrokenInvariant = 21,
}

/// An element that an error speaks of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[non_exhaustive]
pub enum Element {
    /// A vertex, by index.
    Vertex(u64),
    /// A face, by its index in the caller's order.
    Face(u64),
    /// An edge, by its two vertices.
    Edge(u64, u64),
    /// A line of a text file, counted from 1.
    Line(u64),
    /// A position in a binary file, in bytes.
    Byte(u64),
}

impl fmt::Display for Element {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Vertex(v) => write!(f, "vertex {v}"),
            Self::Face(i) => write!(f, "face {i}"),
            Self::Edge(a, b) => write!(f, "edge {a}-{b}"),
            Self::Line(n) => write!(f, "line {n}"),
            Self::Byte(n) => write!(f, "byte {n}"),
        }
    }
}

/// An error: kind, elements, and one line for people.
#[derive(Debug, thiserror::Error)]
#[error("{message}")]
pub struct Error {
    kind: ErrorKind,
    elements: Vec<Element>,
    message: String,
    #[source]
    source: Option<std::io::Error>,
}

impl Error {
    /// An error of a kind with one line of explanation.
    pub fn new(kind: ErrorKind, message: impl Into<String>) -> Self {
        Self { kind, elements: Vec::new(), message: message.into(), source: None }
    }

    /// The same error, naming the elements concerned.
    #[must_use]
    pub fn with_elements(mut self, elements: impl IntoIterator<Item = Element>) -> Self {
        self.elements.extend(elements);
        self
    }

    /// The same error with a prefix such as a file name: `prefix: message`.
    #[must_use]
    pub fn in_context(mut self, prefix: impl fmt::Display) -> Self {
        self.message = format!("{prefix}: {}", self.message);
        self
    }

    /// An input or output error with the system's own reason.
    pub fn io(what: impl fmt::Display, source: std::io::Error) -> Self {
        Self {
            kind: ErrorKind::Io,
            elements: Vec::new(),
            message: format!("{what}: {source}"),
            source: Some(source),
        }
    }

    /// What went wrong, for programs.
    pub fn kind(&self) -> ErrorKind {
        self.kind
    }

    /// The elements concerned; empty where the error is about none.
    pub fn elements(&self) -> &[Element] {
        &self.elements
    }
}
