//! Holes: faces that are refined like others and then left out of the file.

use crate::records::Kept;
use carvel::io::{Labels, MeshFile};
use carvel::{Mesh, Result, Scheme};

/// True for every refined face that is a hole, if any is: `faces` gives the control face
/// of each, in the mesh's order.
///
/// # Errors
/// As [`Scheme::holes`].
pub fn find(mesh: &Mesh, scheme: &Scheme, faces: &[u32]) -> Result<Option<Vec<bool>>> {
    let holes = scheme.holes(mesh)?;
    if holes.is_empty() {
        return Ok(None);
    }
    Ok(Some(faces.iter().map(|face| holes.binary_search(face).is_ok()).collect()))
}

/// Tags faces as holes.
pub fn tag(file: &mut MeshFile, hole: &[bool]) {
    file.holes = (0..).zip(hole).filter(|(_, hole)| **hole).map(|(face, _)| face).collect();
}

/// Takes faces out of a file, with the vertices, texture coordinates, normals and tags that
/// no other face uses. (What no face used before stays.)
///
/// The file is a refined one: the crease between two holes has a vertex in its middle, and
/// so goes with that.
pub fn leave_out(file: &mut MeshFile, hole: &[bool]) {
    let corners = file.face_sizes.iter().zip(hole);
    let corner_stays: Vec<bool> =
        corners.flat_map(|(&size, &hole)| std::iter::repeat_n(!hole, size as usize)).collect();
    drop_vertices(file, &corner_stays);
    if let Some(indices) = &mut file.face_uvs {
        let kept = drop_corners(indices, file.uvs.len(), &corner_stays);
        kept.keep(&mut file.uvs, 1);
    }
    if let Some(indices) = &mut file.face_normals {
        let kept = drop_corners(indices, file.normals.len(), &corner_stays);
        kept.keep(&mut file.normals, 1);
    }
    let face_stays: Vec<bool> = hole.iter().map(|hole| !hole).collect();
    filter(&mut file.face_sizes, &face_stays);
    for labels in [&mut file.objects, &mut file.groups, &mut file.materials, &mut file.smoothing] {
        drop_labels(labels, &face_stays);
    }
}

/// Takes corners out, and the vertices that go with them.
fn drop_vertices(file: &mut MeshFile, stays: &[bool]) {
    let kept = drop_corners(&mut file.face_vertices, file.positions.len(), stays);
    kept.keep(&mut file.positions, 1);
    if let Some(colors) = &mut file.colors {
        kept.keep(&mut colors.values, colors.width);
    }
    for attribute in &mut file.attributes {
        kept.keep(&mut attribute.values, 1);
    }
    file.sharp_vertices.retain_mut(|tag| match kept.number(tag.vertex) {
        Some(number) => {
            tag.vertex = number;
            true
        }
        None => false,
    });
    file.creases.retain_mut(|crease| match crease.vertices.map(|v| kept.number(v)) {
        [Some(a), Some(b)] => {
            crease.vertices = [a, b];
            true
        }
        _ => false,
    });
}

/// Takes corners out; returns which records of theirs stay.
fn drop_corners(corners: &mut Vec<u32>, records: usize, stays: &[bool]) -> Kept {
    let kept = Kept::of(records, corners, |corner| stays[corner]);
    filter(corners, stays);
    kept.renumber(corners);
    kept
}

fn filter(list: &mut Vec<u32>, stays: &[bool]) {
    let mut stays = stays.iter();
    list.retain(|_| stays.next().is_none_or(|stays| *stays));
}

fn drop_labels(labels: &mut Labels, stays: &[bool]) {
    if !labels.is_empty() {
        filter(&mut labels.of_face, stays);
    }
}
