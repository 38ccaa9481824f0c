//! From refined vertices to the surface that they approach.

use crate::memory::zeroed;
use crate::refine::Work;
use carvel::io::MeshFile;
use carvel::limit::Limits;
use carvel::{Context, Hierarchy, Records, RecordsMut, Result};

/// What to make of the vertices of the last level.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Wanted {
    /// Moves them to their limits.
    pub positions: bool,
    /// Gives them the surface's normals.
    pub normals: bool,
}

/// Moves the vertices of a refined mesh to the limit surface, gives them its normals, or both.
///
/// # Errors
/// As [`Limits::new`].
pub fn finish(context: &Context, work: &Work, file: &mut MeshFile) -> Result<()> {
    let Wanted { positions, normals } = work.limit;
    if !positions && !normals {
        return Ok(());
    }
    // A mesh without positions: its data share it.
    let (mesh, scheme) = (work.built.mesh.clone(), &work.chosen.scheme);
    let hierarchy = Hierarchy::new(context, mesh, scheme.clone(), work.levels)?;
    let mesh = hierarchy.shared_mesh(work.levels)?;
    drop(hierarchy);
    let limits = Limits::<f64>::new(context, &mesh, scheme)?;
    if normals {
        let mut found = zeroed([0.0; 3], file.positions.len() as u64)?;
        limits.normals(context, file.positions.as_flattened(), found.as_flattened_mut())?;
        file.normals = found;
        file.face_normals = Some(file.face_vertices.clone());
    }
    if positions {
        let mut moved = zeroed([0.0; 3], file.positions.len() as u64)?;
        let before = Records::packed(file.positions.as_flattened(), 3);
        let after = RecordsMut::packed(moved.as_flattened_mut(), 3);
        limits.position().apply(context, before, after)?;
        file.positions = moved;
    }
    Ok(())
}
