//! Creases, sharp vertices and holes on their way from file to file.

use crate::refine::Work;
use carvel::hierarchy::{creases_by_angle, creases_left};
use carvel::io::{MeshFile, SchemeTags};
use carvel::mesh::{BuildOptions, Built};
use carvel::{Crease, Result, SharpVertex};
use std::collections::BTreeSet;

/// The tags of a file as options of its mesh; `creases` are the file's and others.
pub fn build_options<'a>(file: &'a MeshFile, creases: &'a [Crease]) -> BuildOptions<'a> {
    BuildOptions {
        creases,
        sharp_vertices: &file.sharp_vertices,
        holes: &file.holes,
        ..BuildOptions::default()
    }
}

/// The creases of a file and those by angle, which give way; in the file's vertices.
///
/// # Errors
/// As [`creases_by_angle`].
pub fn with_creases_by_angle(
    file: &MeshFile,
    built: &Built,
    positions: &[[f64; 3]],
    degrees: f64,
    sharpness: f32,
) -> Result<Vec<Crease>> {
    let by_angle = creases_by_angle(&built.mesh, positions.as_flattened(), degrees, sharpness)?;
    let sorted = |[a, b]: [u32; 2]| (a.min(b), a.max(b));
    let known: BTreeSet<_> = file.creases.iter().map(|crease| sorted(crease.vertices)).collect();
    let in_file = |v: u32| built.vertex_source.as_ref().map_or(v, |source| source[v as usize]);
    let named =
        by_angle.iter().map(|crease| Crease { vertices: crease.vertices.map(in_file), ..*crease });
    let new = named.filter(|crease| !known.contains(&sorted(crease.vertices)));
    Ok(file.creases.iter().copied().chain(new).collect())
}

/// Writes into a refined file what is left of sharpness.
///
/// # Errors
/// As [`creases_left`].
pub fn unload(work: &Work, file: &mut MeshFile) -> Result<()> {
    let Work { built, chosen, levels, control, .. } = *work;
    file.creases = creases_left(&built.mesh, &chosen.scheme, levels, &file.face_vertices)?;
    let tagged: BTreeSet<_> = control.sharp_vertices.iter().map(|tag| tag.vertex).collect();
    let origin = |v: u32| built.vertex_source.as_ref().map_or(v, |source| source[v as usize]);
    // Where a mesh is not manifold, policy `sharpen` finds so again.
    let own = built.mesh.sharp_vertices().filter(|tag| tagged.contains(&origin(tag.vertex)));
    let left = own.map(|tag| SharpVertex { sharpness: left(tag.sharpness, levels), ..tag });
    file.sharp_vertices = left.filter(|tag| tag.sharpness > 0.0).collect();
    file.scheme = chosen.followed;
    Ok(())
}

/// What some levels leave of the sharpness of a vertex, 10 being infinite.
fn left(sharpness: f32, levels: u32) -> f32 {
    if sharpness >= 10.0 {
        return sharpness;
    }
    (0..levels).fold(sharpness, |s, _| (s - 1.0).max(0.0))
}

/// One line about the tags of a file that mean nothing to a scheme, if there are any.
pub fn ignored(file: &MeshFile, scheme: &str) -> Option<String> {
    let counted = [
        (file.creases.len(), "crease", "creases"),
        (file.sharp_vertices.len(), "sharp vertex", "sharp vertices"),
        (file.holes.len(), "hole", "holes"),
    ];
    let some = counted.into_iter().filter(|(n, ..)| *n > 0);
    let some = some.map(|(n, one, many)| format!("{n} {}", if n == 1 { one } else { many }));
    let mut ignored: Vec<_> = some.collect();
    if file.scheme != SchemeTags::default() {
        ignored.push("the tags of the scheme".to_owned());
    }
    (!ignored.is_empty()).then(|| {
        let ignored = ignored.join(", ");
        format!("left out {ignored}: {scheme} has none, catmull-clark, loop and bilinear have")
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sharpness_ends_or_never_does() {
        for (sharpness, levels, expected) in
            [(10.0, 5, 10.0_f32), (9.5, 5, 4.5), (2.5, 3, 0.0), (0.3, 1, 0.0)]
        {
            assert_eq!(left(sharpness, levels).to_bits(), expected.to_bits());
        }
    }
}
