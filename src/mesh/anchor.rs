//! The shape that a mesh must have to be marked *anchored*.
//!
//! A dual step with boundary leaves at most two faces at a boundary vertex, and
//! faces with at most one boundary edge, or two that meet at a single-face
//! vertex of a face with at least four vertices. The mirrored rules of the
//! anchored step are written for exactly these.

use super::Mesh;
use crate::base::{Element, Error, ErrorKind, NONE, Result};

/// Checks the shape.
pub(super) fn check(mesh: &Mesh) -> Result<()> {
    for &corner in &mesh.rim {
        let vertex = mesh.vert[corner as usize];
        if mesh.fan(vertex).take(3).count() > 2 {
            return Err(refusal(
                &format!("boundary vertex {vertex} has more than two faces"),
                Element::Vertex(u64::from(vertex)),
            ));
        }
        check_face(mesh, corner)?;
    }
    Ok(())
}

/// Checks the face of a boundary corner.
fn check_face(mesh: &Mesh, corner: u32) -> Result<()> {
    let face = mesh.layout.face_of(corner);
    let corners = mesh.layout.face(face);
    let size = corners.len();
    let open = |c: u32| mesh.twin[c as usize] == NONE;
    let at_one_vertex = open(mesh.next(corner)) || open(mesh.prev(corner));
    let allowed = match corners.filter(|&c| open(c)).count() {
        1 => true,
        2 => at_one_vertex && size >= 4,
        _ => false,
    };
    if allowed {
        return Ok(());
    }
    let source = mesh.face_source(face as usize) as u64;
    Err(refusal(
        &format!("face {source} has boundary edges that do not meet at a corner of a larger face"),
        Element::Face(source),
    ))
}

fn refusal(why: &str, element: Element) -> Error {
    Error::new(ErrorKind::NotAnchored, format!("the mesh cannot be anchored: {why}"))
        .with_elements([element])
}
