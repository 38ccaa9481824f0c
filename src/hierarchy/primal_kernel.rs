//! The inner loops of the primal schemes, for what follows the smooth rules.
//!
//! Which corner leads an edge is hard to foresee. So the quads and triangles compute the
//! new vertex at every corner and keep it where the corner leads: a wasted sum costs less
//! than a wrong guess. On the boundary, where there is nothing across, the corner stands
//! for its own twin; the caller writes those edges again.

use super::kernel::{Value, narrow, widen};
use crate::base::{NONE, Scalar};
use crate::mesh::{Mesh, VertexSet, turn_in_quad};
use crate::refine::{Pieces, PrimalSplit};
use crate::scheme::{SmoothMasks, VertexMask};
use std::ops::Range;

/// The new vertices of faces, from a face on: means of their vertices.
pub(super) fn face_values<T: Scalar, const W: usize>(
    split: &PrimalSplit,
    values: &[Value<T, W>],
    first: u32,
    out: &mut [Value<T, W>],
) {
    let parent = split.parent();
    let quads = parent.layout.irregular_faces();
    let at = |v: u32| widen::<T, W>(&values[v as usize]);
    let quarter = T::from_f64(0.25);
    for (face, slot) in (first..).zip(out) {
        let corners = parent.layout.face(face);
        let vertices = &parent.vert[corners.start as usize..corners.end as usize];
        *slot = match *vertices {
            [a, b, c, d] if face >= quads => {
                narrow::<T, W>(((at(a) + at(b)) + (at(c) + at(d))) * quarter)
            }
            _ => {
                let sum = vertices[1..].iter().fold(at(vertices[0]), |sum, &v| sum + at(v));
                narrow::<T, W>(sum * T::from_f64(1.0 / vertices.len() as f64))
            }
        };
    }
}

/// Smooth new vertices of edges.
pub(super) struct EdgeKernel<'v, T, const W: usize> {
    split: &'v PrimalSplit<'v>,
    values: &'v [Value<T, W>],
    faces: &'v [Value<T, W>],
    end: T,
    beside: T,
    /// Neighbours across matter.
    linear: bool,
    /// The corners that the kernel is for.
    bulk: Range<u32>,
}

impl<'v, T: Scalar, const W: usize> EdgeKernel<'v, T, W> {
    pub(super) fn new(
        split: &'v PrimalSplit<'v>,
        masks: &SmoothMasks<f64>,
        values: &'v [Value<T, W>],
        faces: &'v [Value<T, W>],
    ) -> Self {
        let (parent, mask) = (split.parent(), masks.edge(0));
        let layout = &parent.layout;
        // Faces of one size, one mask for all, and no edge with more than two sides.
        let several = masks.minds_triangles() && layout.irregular_faces() > 0;
        let bulk = match (split.pieces(), layout.side()) {
            (Pieces::Quads, 4) | (Pieces::Triangles, 3)
                if parent.joints.sides.is_empty() && !several =>
            {
                layout.irregular_corners()..layout.corners()
            }
            _ => 0..0,
        };
        let (end, beside) = (T::from_f64(mask.end), T::from_f64(mask.beside));
        Self { split, values, faces, end, beside, linear: masks.is_linear(), bulk }
    }

    /// Writes the edges that a run of corners leads; false if the kernel cannot.
    pub(super) fn run(&self, corners: Range<u32>, out: &mut [Value<T, W>]) -> bool {
        if corners.start < self.bulk.start || corners.end > self.bulk.end {
            return false;
        }
        let mut out = Leading { out, place: 0 };
        match self.split.pieces() {
            Pieces::Quads => self.quads(corners, &mut out),
            Pieces::Triangles => self.triangles(corners, &mut out),
        }
        true
    }

    #[inline(always)]
    fn at(&self, vertex: u32) -> T::Lanes {
        widen::<T, W>(&self.values[vertex as usize])
    }

    #[inline(always)]
    fn mix(&self, ends: T::Lanes, sides: T::Lanes) -> Value<T, W> {
        narrow::<T, W>(ends * self.end + sides * self.beside)
    }

    fn quads(&self, corners: Range<u32>, out: &mut Leading<Value<T, W>>) {
        let parent = self.split.parent();
        let layout = &parent.layout;
        let (first_quad, first_face) = (layout.irregular_corners(), layout.irregular_faces());
        let range = corners.start as usize..corners.end as usize;
        let verts = parent.vert[range.clone()].as_chunks::<4>().0;
        let twins = parent.twin[range].as_chunks::<4>().0;
        let faces = &self.faces[first_face as usize..];
        for ((first, v), twins) in (corners.start..).step_by(4).zip(verts).zip(twins) {
            let x = v.map(|v| self.at(v));
            if self.linear {
                for i in 0..4 {
                    let ends = x[i] + x[(i + 1) % 4];
                    out.push(narrow::<T, W>(ends * self.end), first + (i as u32) < twins[i]);
                }
                continue;
            }
            let own = widen::<T, W>(&faces[((first - first_quad) / 4) as usize]);
            for i in 0..4 {
                let corner = first + i as u32;
                let twin = if twins[i] == NONE { corner } else { twins[i] };
                let across = match twin.checked_sub(first_quad) {
                    Some(local) => &faces[(local / 4) as usize],
                    None => &self.faces[layout.face_of(twin) as usize],
                };
                let sides = own + widen::<T, W>(across);
                out.push(self.mix(x[i] + x[(i + 1) % 4], sides), corner <= twin);
            }
        }
    }

    fn triangles(&self, corners: Range<u32>, out: &mut Leading<Value<T, W>>) {
        let parent = self.split.parent();
        let range = corners.start as usize..corners.end as usize;
        let verts = parent.vert[range.clone()].as_chunks::<3>().0;
        let twins = parent.twin[range].as_chunks::<3>().0;
        let faces = (corners.start..).step_by(3);
        for (first, (v, twins)) in faces.zip(verts.iter().zip(twins)) {
            let x = v.map(|v| self.at(v));
            for i in 0..3 {
                let corner = first + i as u32;
                let twin = if twins[i] == NONE { corner } else { twins[i] };
                let across = self.at(parent.vert[before_in_triangle(twin) as usize]);
                let ends = x[i] + x[(i + 1) % 3];
                out.push(self.mix(ends, x[(i + 2) % 3] + across), corner <= twin);
            }
        }
    }
}

#[inline(always)]
fn before_in_triangle(corner: u32) -> u32 {
    if corner.is_multiple_of(3) { corner + 2 } else { corner - 1 }
}

#[inline(always)]
fn after_in_triangle(corner: u32) -> u32 {
    if corner % 3 == 2 { corner - 2 } else { corner + 1 }
}

/// Values being written one after the other; each stays only if its corner leads.
struct Leading<'o, V> {
    out: &'o mut [V],
    place: usize,
}

impl<V> Leading<'_, V> {
    #[inline(always)]
    fn push(&mut self, value: V, leads: bool) {
        if let Some(slot) = self.out.get_mut(self.place) {
            *slot = value;
            self.place += usize::from(leads);
        }
    }
}

/// Smooth old vertices: a walk around each.
///
/// Sums are taken lane by lane: values of three lanes would have to be put together
/// before every addition.
pub(super) struct VertexKernel<'v, T, const W: usize> {
    mesh: &'v Mesh,
    pieces: Pieces,
    values: &'v [Value<T, W>],
    faces: &'v [Value<T, W>],
    masks: SmoothMasks<f64>,
    /// The mask of the regular valence.
    regular: (usize, [T; 3]),
}

impl<'v, T: Scalar, const W: usize> VertexKernel<'v, T, W> {
    pub(super) fn new(
        split: &'v PrimalSplit<'v>,
        masks: &SmoothMasks<f64>,
        values: &'v [Value<T, W>],
        faces: &'v [Value<T, W>],
    ) -> Self {
        let (mut masks, pieces) = (masks.clone(), split.pieces());
        let valence = match pieces {
            Pieces::Quads => 4,
            Pieces::Triangles => 6,
        };
        let regular = (valence, weights(&masks.vertex(valence)));
        Self { mesh: split.parent(), pieces, values, faces, masks, regular }
    }

    /// Writes the old vertices from one on, but for those of a set.
    pub(super) fn run(&mut self, first: u32, out: &mut [Value<T, W>], except: &VertexSet) {
        match (self.pieces, self.mesh.layout.irregular_corners()) {
            (Pieces::Quads, 0) if self.mesh.layout.side() == 4 => {
                self.each(first, out, except, Self::among_quads);
            }
            (Pieces::Quads, _) => self.each(first, out, except, Self::among_faces),
            (Pieces::Triangles, _) => self.each(first, out, except, Self::among_triangles),
        }
    }

    #[inline(always)]
    fn each(
        &mut self,
        first: u32,
        out: &mut [Value<T, W>],
        except: &VertexSet,
        around: impl Fn(&Self, u32) -> Ring<T, W>,
    ) {
        let starts = &self.mesh.start[first as usize..];
        let values = &self.values[first as usize..];
        for (((v, slot), &start), own) in (first..).zip(out).zip(starts).zip(values) {
            if except.contains(v) {
                continue;
            }
            *slot = *own;
            if start != NONE {
                let ring = around(self, start);
                let (valence, regular) = &self.regular;
                let [w, u, f] = if ring.valence == *valence {
                    *regular
                } else {
                    weights(&self.masks.vertex(ring.valence))
                };
                for lane in 0..W {
                    slot[lane] = own[lane] * w + ring.near[lane] * u + ring.faces[lane] * f;
                }
            }
        }
    }

    /// In a mesh of quads only.
    #[inline(always)]
    fn among_quads(&self, start: u32) -> Ring<T, W> {
        let (vert, twin) = (&self.mesh.vert[..], &self.mesh.twin[..]);
        let mut ring = Ring::default();
        let mut corner = start;
        loop {
            ring.add_near(&self.values[vert[turn_in_quad(0, corner, 1) as usize] as usize]);
            ring.add_face(&self.faces[(corner / 4) as usize]);
            corner = twin[turn_in_quad(0, corner, 3) as usize];
            if corner == start {
                return ring;
            }
        }
    }

    /// In any mesh.
    fn among_faces(&self, start: u32) -> Ring<T, W> {
        let mut ring = Ring::default();
        for corner in self.mesh.fan_from(start) {
            let near = self.mesh.vert[self.mesh.next(corner) as usize];
            ring.add_near(&self.values[near as usize]);
            ring.add_face(&self.faces[self.mesh.layout.face_of(corner) as usize]);
        }
        ring
    }

    /// In a mesh of triangles only; faces have no weight.
    #[inline(always)]
    fn among_triangles(&self, start: u32) -> Ring<T, W> {
        let (vert, twin) = (&self.mesh.vert[..], &self.mesh.twin[..]);
        let mut ring = Ring::default();
        let mut corner = start;
        loop {
            ring.add_near(&self.values[vert[after_in_triangle(corner) as usize] as usize]);
            corner = twin[before_in_triangle(corner) as usize];
            if corner == start {
                return ring;
            }
        }
    }
}

fn weights<T: Scalar>(mask: &VertexMask<f64>) -> [T; 3] {
    [mask.own, mask.near, mask.face].map(T::from_f64)
}

/// Sums over the neighbours and the faces of a vertex.
struct Ring<T, const W: usize> {
    near: Value<T, W>,
    faces: Value<T, W>,
    valence: usize,
}

impl<T: Scalar, const W: usize> Default for Ring<T, W> {
    fn default() -> Self {
        Self { near: [T::default(); W], faces: [T::default(); W], valence: 0 }
    }
}

impl<T: Scalar, const W: usize> Ring<T, W> {
    #[inline(always)]
    fn add_near(&mut self, value: &Value<T, W>) {
        self.valence += 1;
        for (sum, &x) in self.near.iter_mut().zip(value) {
            *sum = *sum + x;
        }
    }

    #[inline(always)]
    fn add_face(&mut self, value: &Value<T, W>) {
        for (sum, &x) in self.faces.iter_mut().zip(value) {
            *sum = *sum + x;
        }
    }
}
