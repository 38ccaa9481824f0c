//! The inner loops of the primal schemes, for what follows the smooth rules.
//!
//! On the boundary, where there is nothing across, a corner stands for its own twin; the
//! caller writes those edges again.

use super::kernel::{Value, narrow, widen};
use crate::base::{NONE, Scalar};
use crate::mesh::{Mesh, VertexSet, turn_in_quad};
use crate::refine::{Pieces, PrimalSplit};
use crate::scheme::{SmoothMasks, VertexMask};

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
    mesh: &'v Mesh,
    pieces: Pieces,
    values: &'v [Value<T, W>],
    faces: &'v [Value<T, W>],
    end: T,
    beside: T,
    /// Nothing but midpoints.
    linear: bool,
    /// Every edge has the same mask.
    uniform: bool,
}

impl<'v, T: Scalar, const W: usize> EdgeKernel<'v, T, W> {
    pub(super) fn new(
        split: &'v PrimalSplit<'v>,
        masks: &SmoothMasks<f64>,
        values: &'v [Value<T, W>],
        faces: &'v [Value<T, W>],
    ) -> Self {
        let (mesh, mask) = (split.parent(), masks.edge(0));
        let triangles = mesh.layout.side() == 3 || mesh.layout.irregular_faces() > 0;
        Self {
            mesh,
            pieces: split.pieces(),
            values,
            faces,
            end: T::from_f64(mask.end),
            beside: T::from_f64(mask.beside),
            linear: masks.is_linear(),
            uniform: !(masks.minds_triangles() && triangles),
        }
    }

    /// Writes the new vertices on the edges with some first corners; false if the kernel
    /// cannot.
    pub(super) fn run(&self, corners: &[u32], out: &mut [Value<T, W>]) -> bool {
        let layout = &self.mesh.layout;
        let quads = layout.side() == 4 && layout.irregular_corners() == 0;
        match self.pieces {
            _ if !self.uniform => return false,
            _ if self.linear => self.each(corners, out, |c| self.midpoint(c)),
            Pieces::Quads if quads => self.each(corners, out, |c| self.among_quads(c)),
            Pieces::Quads => self.each(corners, out, |c| self.among_faces(c)),
            Pieces::Triangles => self.each(corners, out, |c| self.among_triangles(c)),
        }
        true
    }

    #[inline(always)]
    fn each(&self, corners: &[u32], out: &mut [Value<T, W>], value: impl Fn(u32) -> Value<T, W>) {
        for (slot, &corner) in out.iter_mut().zip(corners) {
            *slot = value(corner);
        }
    }

    #[inline(always)]
    fn at(&self, corner: u32) -> &Value<T, W> {
        &self.values[self.mesh.vert[corner as usize] as usize]
    }

    #[inline(always)]
    fn twin(&self, corner: u32) -> u32 {
        match self.mesh.twin[corner as usize] {
            NONE => corner,
            twin => twin,
        }
    }

    #[inline(always)]
    fn mix(&self, ends: [&Value<T, W>; 2], sides: [&Value<T, W>; 2]) -> Value<T, W> {
        std::array::from_fn(|lane| {
            (ends[0][lane] + ends[1][lane]) * self.end
                + (sides[0][lane] + sides[1][lane]) * self.beside
        })
    }

    fn midpoint(&self, corner: u32) -> Value<T, W> {
        let (a, b) = (self.at(corner), self.at(self.mesh.next(corner)));
        std::array::from_fn(|lane| (a[lane] + b[lane]) * self.end)
    }

    /// In a mesh of quads only.
    #[inline(always)]
    fn among_quads(&self, corner: u32) -> Value<T, W> {
        let face = |corner: u32| &self.faces[(corner / 4) as usize];
        let ends = [self.at(corner), self.at(turn_in_quad(0, corner, 1))];
        self.mix(ends, [face(corner), face(self.twin(corner))])
    }

    /// In any mesh.
    fn among_faces(&self, corner: u32) -> Value<T, W> {
        let face = |corner: u32| &self.faces[self.mesh.layout.face_of(corner) as usize];
        let ends = [self.at(corner), self.at(self.mesh.next(corner))];
        self.mix(ends, [face(corner), face(self.twin(corner))])
    }

    /// In a mesh of triangles only.
    #[inline(always)]
    fn among_triangles(&self, corner: u32) -> Value<T, W> {
        let opposite = |corner: u32| self.at(before_in_triangle(corner));
        let ends = [self.at(corner), self.at(after_in_triangle(corner))];
        self.mix(ends, [opposite(corner), opposite(self.twin(corner))])
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
