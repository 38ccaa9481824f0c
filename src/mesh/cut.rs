//! Policy `cut`: every extra fan of a vertex gets its own copy of it.
//!
//! The fan with the smallest corner, in the mesh's own order of faces, keeps the
//! vertex; the others get new
//! numbers after the old ones, by vertex and then by smallest corner.

use super::Mesh;
use crate::base::{NONE, Result, memory};

/// Separates the fans of the given vertices (ascending). Returns the source of
/// every vertex if any was copied.
pub(super) fn separate_fans(mesh: &mut Mesh, split: &[u32]) -> Result<Option<Vec<u32>>> {
    if split.is_empty() {
        return Ok(None);
    }
    let corners = corners_of(mesh, split)?;
    let mut source = memory::collect(0..mesh.start.len() as u32)?;
    for group in corners.chunk_by(|a, b| a.0 == b.0) {
        let old = group[0].0;
        for (i, fan) in fans(mesh, group)?.into_iter().enumerate() {
            let id = if i == 0 { old } else { source.len() as u32 };
            if i > 0 {
                memory::extend(&mut source, [old])?;
                memory::extend(&mut mesh.start, [NONE])?;
            }
            mesh.start[id as usize] = fan[0];
            for corner in fan {
                mesh.vert[corner as usize] = id;
            }
        }
    }
    Ok(Some(source))
}

/// The corners of the given vertices (ascending), sorted by vertex.
pub(super) fn corners_of(mesh: &Mesh, vertices: &[u32]) -> Result<Vec<(u32, u32)>> {
    let corners = (0..).zip(&mesh.vert).filter(|(_, v)| vertices.binary_search(v).is_ok());
    let mut corners = memory::collect(corners.map(|(corner, &v)| (v, corner)))?;
    corners.sort_unstable();
    Ok(corners)
}

/// The fans of one vertex, by smallest corner; each starts where a fan starts.
pub(super) fn fans(mesh: &Mesh, corners: &[(u32, u32)]) -> Result<Vec<Vec<u32>>> {
    let mut fans = Vec::new();
    let mut seen = memory::filled(false, corners.len())?;
    for i in 0..corners.len() {
        if seen[i] {
            continue;
        }
        let start = fan_start(mesh, corners[i].1);
        let mut fan = vec![start];
        let mut corner = mesh.ccw(start);
        while corner != NONE && corner != start {
            memory::extend(&mut fan, [corner])?;
            corner = mesh.ccw(corner);
        }
        for corner in &fan {
            let at = corners.binary_search_by_key(corner, |&(_, c)| c);
            seen[at.expect("a fan stays at its vertex")] = true;
        }
        memory::extend(&mut fans, [fan])?;
    }
    Ok(fans)
}

/// Clockwise to the boundary, or back to the corner itself, which is then the
/// smallest of its fan.
fn fan_start(mesh: &Mesh, corner: u32) -> u32 {
    let mut at = corner;
    loop {
        match mesh.cw(at) {
            NONE => return at,
            next if next == corner => return corner,
            next => at = next,
        }
    }
}
