//! The inner loops of the primal schemes, for what follows the smooth rules.
//!
//! Which corner leads an edge is hard to foresee. So the quads and triangles compute the
//! new vertex at every corner and keep it where the corner leads: a wasted sum costs less
//! than a wrong guess. On the boundary, where there is nothing across, the corner stands
//! for its own twin; the caller writes those edges again.

use super::kernel::{Value, narrow, widen};
use crate::base::{NONE, Scalar};
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
        let range = corners.start as usize..corners.end as usize;
        let verts = parent.vert[range.clone()].as_chunks::<4>().0;
        let twins = parent.twin[range].as_chunks::<4>().0;
        let faces = (corners.start..).step_by(4).zip(layout.face_of(corners.start)..);
        for ((first, face), (v, twins)) in faces.zip(verts.iter().zip(twins)) {
            let x = v.map(|v| self.at(v));
            if self.linear {
                for i in 0..4 {
                    let ends = x[i] + x[(i + 1) % 4];
                    out.push(narrow::<T, W>(ends * self.end), first + (i as u32) < twins[i]);
                }
                continue;
            }
            let own = widen::<T, W>(&self.faces[face as usize]);
            for i in 0..4 {
                let corner = first + i as u32;
                let twin = if twins[i] == NONE { corner } else { twins[i] };
                let across = widen::<T, W>(&self.faces[layout.face_of(twin) as usize]);
                out.push(self.mix(x[i] + x[(i + 1) % 4], own + across), corner <= twin);
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
pub(super) struct VertexKernel<'v, T, const W: usize> {
    split: &'v PrimalSplit<'v>,
    values: &'v [Value<T, W>],
    faces: &'v [Value<T, W>],
}

impl<'v, T: Scalar, const W: usize> VertexKernel<'v, T, W> {
    pub(super) fn new(
        split: &'v PrimalSplit<'v>,
        values: &'v [Value<T, W>],
        faces: &'v [Value<T, W>],
    ) -> Self {
        Self { split, values, faces }
    }

    /// The value of an interior vertex; an isolated one keeps its own.
    #[inline(always)]
    pub(super) fn value(&self, vertex: u32, masks: &mut SmoothMasks<f64>) -> Value<T, W> {
        let own = &self.values[vertex as usize];
        let start = self.split.parent().start[vertex as usize];
        if start == NONE {
            return *own;
        }
        match self.split.pieces() {
            Pieces::Quads => self.among_quads(own, start, masks),
            Pieces::Triangles => self.among_triangles(own, start, masks),
        }
    }

    #[inline(always)]
    fn among_quads(
        &self,
        own: &Value<T, W>,
        start: u32,
        masks: &mut SmoothMasks<f64>,
    ) -> Value<T, W> {
        let parent = self.split.parent();
        let zero = widen::<T, W>(&[T::default(); W]);
        let (mut near, mut faces, mut n, mut corner) = (zero, zero, 0, start);
        loop {
            near = near
                + widen::<T, W>(&self.values[parent.vert[parent.next(corner) as usize] as usize]);
            faces = faces + widen::<T, W>(&self.faces[parent.layout.face_of(corner) as usize]);
            n += 1;
            corner = parent.ccw(corner);
            if corner == start {
                break;
            }
        }
        let VertexMask { own: w, near: u, face: f } = masks.vertex(n);
        let [w, u, f] = [w, u, f].map(T::from_f64);
        narrow::<T, W>(widen::<T, W>(own) * w + near * u + faces * f)
    }

    #[inline(always)]
    fn among_triangles(
        &self,
        own: &Value<T, W>,
        start: u32,
        masks: &mut SmoothMasks<f64>,
    ) -> Value<T, W> {
        let parent = self.split.parent();
        let (mut near, mut n, mut corner) = (widen::<T, W>(&[T::default(); W]), 0, start);
        loop {
            let next = parent.vert[after_in_triangle(corner) as usize];
            near = near + widen::<T, W>(&self.values[next as usize]);
            n += 1;
            corner = parent.twin[before_in_triangle(corner) as usize];
            if corner == start {
                break;
            }
        }
        let VertexMask { own: w, near: u, .. } = masks.vertex(n);
        narrow::<T, W>(widen::<T, W>(own) * T::from_f64(w) + near * T::from_f64(u))
    }
}
