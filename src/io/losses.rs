//! What a format cannot keep of a mesh.

use super::{Format, MeshFile, SchemeTags};

/// One line for each thing in the mesh that the format cannot hold, for the
/// user to know before it is gone.
pub fn losses(mesh: &MeshFile, format: Format) -> Vec<String> {
    let mut lost = match format {
        Format::Obj => Vec::new(),
        Format::Off | Format::Ply => corner_data(mesh),
        Format::Stl => triangles(mesh),
    };
    if format != Format::Obj {
        lost.extend(names(mesh, format));
        lost.extend(tags(mesh));
    }
    if format != Format::Ply {
        lost.extend(mesh.attributes.iter().map(|a| format!("the vertex attribute {}", a.name)));
    }
    lost.into_iter().map(|what| format!("{what}: {format} cannot hold that")).collect()
}

/// Texture coordinates and normals, where they do not go by vertex.
fn corner_data(mesh: &MeshFile) -> Vec<String> {
    let mut lost = Vec::new();
    if !mesh.uvs.is_empty() && mesh.vertex_uvs().is_none() {
        lost.push(format!("{} texture coordinates that go by corner", mesh.uvs.len()));
    }
    if !mesh.normals.is_empty() && mesh.vertex_normals().is_none() {
        lost.push(format!("{} normals that go by corner", mesh.normals.len()));
    }
    lost
}

fn triangles(mesh: &MeshFile) -> Vec<String> {
    let mut lost = vec!["the numbering of the vertices".to_owned()];
    let polygons = mesh.face_sizes.iter().filter(|&&size| size > 3).count();
    let mut used = vec![false; mesh.positions.len()];
    for &vertex in &mesh.face_vertices {
        if let Some(used) = used.get_mut(vertex as usize) {
            *used = true;
        }
    }
    let isolated = used.iter().filter(|&&used| !used).count();
    let single = |x: &f64| f64::from(*x as f32).to_bits() == x.to_bits();
    let double = mesh.positions.iter().filter(|p| !p.iter().all(single)).count();
    let counted = [
        (double, "positions in double precision (unless written as text)"),
        (polygons, "faces of more than three sides (cut into triangles)"),
        (isolated, "vertices without faces"),
        (mesh.uvs.len(), "texture coordinates"),
        (mesh.normals.len(), "normals"),
        (mesh.colors.as_ref().map_or(0, |_| mesh.positions.len()), "vertex colours"),
    ];
    lost.extend(counted.iter().filter(|(n, _)| *n > 0).map(|(n, what)| format!("{n} {what}")));
    lost
}

/// The names of faces; text STL keeps objects as solids, but binary does not.
fn names(mesh: &MeshFile, format: Format) -> Vec<String> {
    let some = mesh.labels().into_iter().filter(|(_, labels)| !labels.is_empty());
    let mut lost: Vec<_> = some
        .map(|(what, _)| match what {
            "objects" if format == Format::Stl => "the objects (unless written as text)".to_owned(),
            what => format!("the {what} of the faces"),
        })
        .collect();
    if !mesh.material_libraries.is_empty() {
        lost.push("the names of material libraries".to_owned());
    }
    lost
}

/// Sharp features and what the file asks of the scheme.
fn tags(mesh: &MeshFile) -> Vec<String> {
    let counted = [
        (mesh.creases.len(), "creases"),
        (mesh.sharp_vertices.len(), "sharp vertices"),
        (mesh.holes.len(), "holes"),
    ];
    let some = counted.iter().filter(|(n, _)| *n > 0);
    let mut lost: Vec<_> = some.map(|(n, what)| format!("{n} {what}")).collect();
    if mesh.scheme != SchemeTags::default() {
        lost.push("the tags of the scheme".to_owned());
    }
    lost
}
