//! Where the corners of a face are: irregular faces first, the rest closed-form.
//!
//! A corner is numbered by its place in the concatenated face-vertex array.
//! Faces of another size than the regular one come first and carry offsets; the
//! regular faces (quads, or triangles if there is nothing else) follow and need
//! none, so that the bulk of a refined mesh costs no memory and no look-up.

use crate::base::{Result, memory};
use std::ops::Range;

/// Face sizes and the corner ↔ face arithmetic of a mesh.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Layout {
    /// First corner of each irregular face, and their total at the end.
    offsets: Vec<u32>,
    /// Face of each irregular corner.
    face_of: Vec<u32>,
    /// Size of the regular faces: 3 or 4.
    side: u32,
    /// Number of corners in all.
    corners: u32,
    /// Corners from which on every face is a quad.
    first_quad: u32,
}

/// The corner `by` places further around its quad; quads begin at `first`.
#[inline(always)]
pub(crate) fn turn_in_quad(first: u32, corner: u32, by: u32) -> u32 {
    let local = corner.wrapping_sub(first);
    first.wrapping_add((local & !3) | (local.wrapping_add(by) & 3))
}

/// The next corner in a mesh of triangles only.
#[inline(always)]
pub(crate) fn next_in_triangle(corner: u32) -> u32 {
    if corner % 3 == 2 { corner - 2 } else { corner + 1 }
}

/// The previous corner in a mesh of triangles only.
#[inline(always)]
pub(crate) fn prev_in_triangle(corner: u32) -> u32 {
    if corner.is_multiple_of(3) { corner + 2 } else { corner - 1 }
}

impl Layout {
    /// A layout from the sizes of the irregular faces and a number of regular
    /// ones. The caller has checked that the corners fit the index type.
    pub(crate) fn new(
        irregular: impl Iterator<Item = u32>,
        side: u32,
        regular: u32,
    ) -> Result<Self> {
        debug_assert!(side == 3 || side == 4);
        let mut offsets = memory::collect([0])?;
        let mut face_of: Vec<u32> = Vec::new();
        for (face, size) in (0..).zip(irregular) {
            memory::extend(&mut face_of, std::iter::repeat_n(face, size as usize))?;
            memory::extend(&mut offsets, [face_of.len() as u32])?;
        }
        let corners = face_of.len() as u32 + side * regular;
        let first_quad = if side == 4 { face_of.len() as u32 } else { corners };
        Ok(Self { offsets, face_of, side, corners, first_quad })
    }

    /// A copy.
    pub(crate) fn try_clone(&self) -> Result<Self> {
        let (offsets, face_of) = (memory::copied(&self.offsets)?, memory::copied(&self.face_of)?);
        Ok(Self { offsets, face_of, ..*self })
    }

    pub(crate) fn corners(&self) -> u32 {
        self.corners
    }

    /// Corners of irregular faces; the first regular corner.
    pub(crate) fn irregular_corners(&self) -> u32 {
        self.face_of.len() as u32
    }

    /// Irregular faces; the first regular face.
    pub(crate) fn irregular_faces(&self) -> u32 {
        self.offsets.len() as u32 - 1
    }

    pub(crate) fn side(&self) -> u32 {
        self.side
    }

    pub(crate) fn faces(&self) -> u32 {
        self.irregular_faces() + (self.corners - self.irregular_corners()) / self.side
    }

    /// Corners from which on every face is a quad: the fast path's range.
    pub(crate) fn first_quad_corner(&self) -> u32 {
        self.first_quad
    }

    /// The corners of a face.
    pub(crate) fn face(&self, face: u32) -> Range<u32> {
        let n = self.irregular_faces();
        if face < n {
            self.offsets[face as usize]..self.offsets[face as usize + 1]
        } else {
            let start = self.irregular_corners() + self.side * (face - n);
            start..start + self.side
        }
    }

    /// The corners of the face of a corner.
    #[inline(always)]
    pub(crate) fn face_around(&self, corner: u32) -> Range<u32> {
        let first = self.irregular_corners();
        if corner < first {
            return self.face(self.face_of[corner as usize]);
        }
        let local = corner - first;
        let within = if self.side == 4 { local % 4 } else { local % 3 };
        corner - within..corner - within + self.side
    }

    #[inline]
    pub(crate) fn face_of(&self, corner: u32) -> u32 {
        let first = self.irregular_corners();
        if corner < first {
            self.face_of[corner as usize]
        } else if self.side == 4 {
            self.irregular_faces() + (corner - first) / 4
        } else {
            self.irregular_faces() + (corner - first) / 3
        }
    }

    /// The next corner of the same face.
    #[inline(always)]
    pub(crate) fn next(&self, corner: u32) -> u32 {
        let first = self.first_quad;
        if corner >= first { turn_in_quad(first, corner, 1) } else { self.next_irregular(corner) }
    }

    /// The previous corner of the same face.
    #[inline(always)]
    pub(crate) fn prev(&self, corner: u32) -> u32 {
        let first = self.first_quad;
        if corner >= first { turn_in_quad(first, corner, 3) } else { self.prev_irregular(corner) }
    }

    #[cold]
    #[inline(never)]
    fn next_irregular(&self, corner: u32) -> u32 {
        if self.face_of.is_empty() {
            return next_in_triangle(corner);
        }
        let face = self.face(self.face_of(corner));
        if corner + 1 == face.end { face.start } else { corner + 1 }
    }

    #[cold]
    #[inline(never)]
    fn prev_irregular(&self, corner: u32) -> u32 {
        if self.face_of.is_empty() {
            return prev_in_triangle(corner);
        }
        let face = self.face(self.face_of(corner));
        if corner == face.start { face.end - 1 } else { corner - 1 }
    }

    /// Bytes held.
    pub(crate) fn bytes(&self) -> u64 {
        4 * (self.offsets.capacity() + self.face_of.capacity()) as u64
    }

    /// True if the offsets, sizes and the reverse map agree.
    pub(crate) fn is_consistent(&self) -> bool {
        let irregular = (0..self.irregular_faces()).all(|f| {
            let size = self.face(f).len() as u32;
            size >= 3 && size != self.side && self.face(f).all(|c| self.face_of(c) == f)
        });
        let rest = self.corners.checked_sub(self.irregular_corners());
        irregular && rest.is_some_and(|rest| rest.is_multiple_of(self.side))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn next_and_prev_walk_every_face() {
        for (irregular, side, regular) in
            [(vec![5, 3, 7], 4, 3), (vec![], 4, 2), (vec![], 3, 4), (vec![3], 4, 0)]
        {
            let layout = Layout::new(irregular.into_iter(), side, regular).unwrap();
            assert!(layout.is_consistent());
            for f in 0..layout.faces() {
                let face = layout.face(f);
                for c in face.clone() {
                    assert_eq!(layout.face_of(c), f);
                    assert_eq!(layout.face_around(c), face);
                    let next = if c + 1 == face.end { face.start } else { c + 1 };
                    assert_eq!(layout.next(c), next);
                    assert_eq!(layout.prev(next), c);
                }
            }
        }
    }
}
