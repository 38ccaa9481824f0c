//! A vertex of a face that is no quad, with quads alone around it otherwise.

use crate::base::NONE;
use crate::mesh::{Mesh, QuadWalker};
use std::ops::Range;

/// The only face that is no quad around an interior vertex of valence 4, seen from one of the
/// vertex's corners.
#[derive(Debug, Clone)]
pub(crate) struct IsolatedFace {
    /// The corners of the vertex, counter-clockwise from the one in the face.
    corners: [u32; 4],
    /// Which of them one looks from.
    pub(crate) child: usize,
    /// The corners of the face.
    face: Range<u32>,
}

impl IsolatedFace {
    /// The face around the vertex of a corner. With `mirrored`, faces with a boundary edge are
    /// not what they seem, and a vertex beside one has none.
    pub(crate) fn around(mesh: &Mesh, corner: u32, mirrored: bool) -> Option<Self> {
        if mesh.special_set.contains(mesh.vert[corner as usize]) {
            return None;
        }
        let quads = QuadWalker::new(mesh);
        let mut corners = [corner; 4];
        for i in 1..4 {
            corners[i] = mesh.ccw(corners[i - 1]);
        }
        let at = corners.iter().position(|&c| !quads.holds(c))?;
        corners.rotate_left(at);
        if !corners[1..].iter().all(|&c| quads.holds(c)) {
            return None;
        }
        let face_of = |c: u32| mesh.layout.face(mesh.layout.face_of(c));
        let open = |c: &u32| face_of(*c).any(|c| mesh.twin[c as usize] == NONE);
        if mirrored && corners.iter().any(open) {
            return None;
        }
        Some(Self { corners, child: (4 - at) % 4, face: face_of(corners[0]) })
    }

    /// The number of its sides.
    pub(crate) fn sides(&self) -> usize {
        self.face.len()
    }

    /// The vertices around: counter-clockwise those outside of the face, from the one next to the
    /// vertex and not in the face, and then those of the face from the vertex on.
    pub(crate) fn vertices<'m>(&self, mesh: &'m Mesh) -> impl Iterator<Item = u32> + use<'m> {
        let [own, before, across, after] = self.corners;
        let opposite = |c: u32| mesh.next(mesh.next(c));
        let outside = [
            mesh.next(across),
            opposite(before),
            opposite(across),
            opposite(after),
            mesh.next(after),
        ];
        let face = (own..self.face.end).chain(self.face.start..own);
        outside.into_iter().chain(face).map(|c| mesh.vert[c as usize])
    }
}
