//! Subdivision tags of a mesh in a file: those of the scheme, and checks of all.

use super::MeshFile;
use crate::base::{Crease, Element, Error, ErrorKind, Result, SharpVertex};

/// What a file asks of the scheme as a whole; `None` where it says nothing.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct SchemeTags {
    /// How the boundary is interpolated.
    pub boundary: Option<BoundaryTag>,
    /// How the sharpness of creases goes down.
    pub creasing: Option<CreasingTag>,
    /// Catmull–Clark's weights on triangles.
    pub triangles: Option<TriangleTag>,
    /// Where face-varying data is interpolated linearly.
    pub face_varying: Option<FaceVaryingTag>,
}

/// How a boundary is interpolated.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum BoundaryTag {
    /// Not at all: faces at the boundary are holes.
    None,
    /// Edges and the vertices with one face.
    EdgeAndCorner,
    /// Edges alone.
    Edge,
}

/// How the sharpness of creases goes down from level to level.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum CreasingTag {
    /// By 1.
    Uniform,
    /// By 1, after averaging along the crease.
    Chaikin,
}

/// Catmull–Clark's weights on triangles.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum TriangleTag {
    /// Those of all other faces.
    CatmullClark,
    /// Weights that make triangles smoother.
    Smooth,
}

/// Where face-varying data is interpolated linearly; OpenSubdiv's modes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum FaceVaryingTag {
    /// Nowhere.
    None,
    /// At corners of its regions.
    CornersOnly,
    /// There, and where many regions meet.
    CornersPlus1,
    /// There, and at darts and concave corners.
    CornersPlus2,
    /// Along all boundaries of regions.
    Boundaries,
    /// Everywhere.
    All,
}

/// Checks that every tag names elements of the mesh and has a fit sharpness.
pub(super) fn check(mesh: &MeshFile) -> Result<()> {
    let (vertices, faces) = (mesh.positions.len(), mesh.face_sizes.len());
    mesh.creases.iter().try_for_each(|crease| check_crease(crease, vertices))?;
    mesh.sharp_vertices.iter().try_for_each(|&sharp| check_sharp_vertex(sharp, vertices))?;
    let beyond = mesh.holes.iter().find(|&&face| face as usize >= faces);
    beyond.map_or(Ok(()), |face| {
        let reason = format!("face {face} is tagged as a hole, there are {faces}");
        Err(invalid(ErrorKind::IndexOutOfRange, reason, Element::Face(u64::from(*face))))
    })
}

fn check_crease(crease: &Crease, vertices: usize) -> Result<()> {
    let [a, b] = crease.vertices;
    let edge = Element::Edge(u64::from(a), u64::from(b));
    if let Some(vertex) = [a, b].into_iter().find(|&v| v as usize >= vertices) {
        let reason = format!("the crease {a}-{b} names vertex {vertex}, there are {vertices}");
        return Err(invalid(ErrorKind::IndexOutOfRange, reason, edge));
    }
    if a == b {
        let reason = format!("a crease from vertex {a} to itself");
        return Err(invalid(ErrorKind::InvalidTag, reason, edge));
    }
    check_sharpness(crease.sharpness, &format!("crease {a}-{b}"), edge)
}

fn check_sharp_vertex(sharp: SharpVertex, vertices: usize) -> Result<()> {
    let vertex = sharp.vertex;
    let element = Element::Vertex(u64::from(vertex));
    if vertex as usize >= vertices {
        let reason = format!("vertex {vertex} is tagged sharp, there are {vertices}");
        return Err(invalid(ErrorKind::IndexOutOfRange, reason, element));
    }
    check_sharpness(sharp.sharpness, &format!("vertex {vertex}"), element)
}

fn check_sharpness(sharpness: f32, what: &str, element: Element) -> Result<()> {
    if !sharpness.is_finite() {
        let reason =
            format!("the sharpness of {what} is {sharpness}, which is not a finite number");
        return Err(invalid(ErrorKind::NotFinite, reason, element));
    }
    if sharpness < 0.0 {
        let reason = format!("the sharpness of {what} is {sharpness}, which is negative");
        return Err(invalid(ErrorKind::InvalidTag, reason, element));
    }
    Ok(())
}

fn invalid(kind: ErrorKind, reason: String, element: Element) -> Error {
    Error::new(kind, reason).with_elements([element])
}
