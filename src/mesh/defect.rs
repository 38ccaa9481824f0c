//! What can be wrong with a polygon soup, one defect per mistake.

use crate::base::{Element, Error, ErrorKind};
use std::fmt;

/// One reason why a soup is no orientable 2-manifold.
///
/// Faces are numbered in the caller's order.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub enum Defect {
    /// A face has fewer than three vertices.
    FaceTooSmall {
        /// The face.
        face: u64,
        /// Its size.
        size: u32,
    },
    /// A face names a vertex that does not exist.
    IndexOutOfRange {
        /// The face.
        face: u64,
        /// The index.
        vertex: u64,
        /// The number of vertices.
        vertices: u64,
    },
    /// A vertex occurs twice in a face.
    RepeatedVertex {
        /// The face.
        face: u64,
        /// The vertex.
        vertex: u64,
    },
    /// Two faces run through an edge in the same direction.
    InconsistentOrientation {
        /// The edge's vertices.
        edge: (u64, u64),
        /// The two faces.
        faces: Vec<u64>,
    },
    /// More than two faces share an edge.
    NonManifoldEdge {
        /// The edge's vertices.
        edge: (u64, u64),
        /// The faces.
        faces: Vec<u64>,
    },
    /// The faces around a vertex form more than one fan.
    NonManifoldVertex {
        /// The vertex.
        vertex: u64,
    },
}

impl Defect {
    /// The kind of error that this defect is.
    pub fn kind(&self) -> ErrorKind {
        match self {
            Self::FaceTooSmall { .. } => ErrorKind::FaceTooSmall,
            Self::IndexOutOfRange { .. } => ErrorKind::IndexOutOfRange,
            Self::RepeatedVertex { .. } => ErrorKind::RepeatedVertex,
            Self::InconsistentOrientation { .. } => ErrorKind::InconsistentOrientation,
            Self::NonManifoldEdge { .. } => ErrorKind::NonManifoldEdge,
            Self::NonManifoldVertex { .. } => ErrorKind::NonManifoldVertex,
        }
    }

    /// The elements concerned: the vertex or edge first, then the faces.
    pub fn elements(&self) -> Vec<Element> {
        (0..self.element_count()).filter_map(|i| self.element(i)).collect()
    }

    /// The number of elements concerned.
    pub fn element_count(&self) -> usize {
        match self {
            Self::FaceTooSmall { .. } | Self::NonManifoldVertex { .. } => 1,
            Self::IndexOutOfRange { .. } | Self::RepeatedVertex { .. } => 2,
            Self::InconsistentOrientation { faces, .. } | Self::NonManifoldEdge { faces, .. } => {
                1 + faces.len()
            }
        }
    }

    /// One of the elements, in the order of [`Self::elements`].
    pub fn element(&self, i: usize) -> Option<Element> {
        match (self, i) {
            (Self::FaceTooSmall { face, .. }, 0)
            | (Self::IndexOutOfRange { face, .. } | Self::RepeatedVertex { face, .. }, 1) => {
                Some(Element::Face(*face))
            }
            (
                Self::IndexOutOfRange { vertex, .. }
                | Self::RepeatedVertex { vertex, .. }
                | Self::NonManifoldVertex { vertex },
                0,
            ) => Some(Element::Vertex(*vertex)),
            (
                Self::InconsistentOrientation { edge, faces }
                | Self::NonManifoldEdge { edge, faces },
                i,
            ) => match i.checked_sub(1) {
                None => Some(Element::Edge(edge.0, edge.1)),
                Some(i) => faces.get(i).map(|&face| Element::Face(face)),
            },
            _ => None,
        }
    }
}

impl fmt::Display for Defect {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::FaceTooSmall { face, size } => {
                write!(f, "face {face} has {size} vertices, at least 3 are needed")
            }
            Self::IndexOutOfRange { face, vertex, vertices } => {
                write!(f, "face {face} names vertex {vertex}, but there are {vertices}")
            }
            Self::RepeatedVertex { face, vertex } => {
                write!(f, "face {face} contains vertex {vertex} twice")
            }
            Self::InconsistentOrientation { edge, faces } => write!(
                f,
                "edge {}-{}: faces {} run through it in the same direction",
                edge.0,
                edge.1,
                list(faces)
            ),
            Self::NonManifoldEdge { edge, faces } => {
                write!(f, "edge {}-{} has {} faces: {}", edge.0, edge.1, faces.len(), list(faces))
            }
            Self::NonManifoldVertex { vertex } => {
                write!(f, "the faces around vertex {vertex} form more than one fan")
            }
        }
    }
}

/// Face numbers for people; a hub with a thousand faces stays one line.
fn list(faces: &[u64]) -> String {
    const SHOWN: usize = 8;
    let shown: Vec<String> = faces.iter().take(SHOWN).map(u64::to_string).collect();
    let rest = if faces.len() > SHOWN { ", …" } else { "" };
    shown.join(", ") + rest
}

/// Why a mesh could not be built: every defect found, or a limit exceeded.
#[derive(Debug)]
pub enum Defects {
    /// The defects of the soup, at least one. If a face cannot be used at all,
    /// the fans of vertices are not judged, since they would lack that face.
    Soup(Vec<Defect>),
    /// The arguments or the sizes are unusable as a whole.
    Call(Error),
}

impl From<Error> for Defects {
    fn from(error: Error) -> Self {
        Self::Call(error)
    }
}

impl From<Defects> for Error {
    /// The first defect, and how many more there are.
    fn from(defects: Defects) -> Self {
        let list = match defects {
            Defects::Call(error) => return error,
            Defects::Soup(list) => list,
        };
        let first = &list[0];
        Self::new(first.kind(), summary(&list)).with_elements(first.elements())
    }
}

/// The first of some defects, and how many more there are.
pub(crate) fn summary(list: &[Defect]) -> String {
    let first = &list[0];
    match list.len() {
        1 => first.to_string(),
        2 => format!("{first} (1 more defect)"),
        n => format!("{first} ({} more defects)", n - 1),
    }
}
