//! The inner loops of the primal schemes, for what follows the smooth rules.
//!
//! On the boundary, where there is nothing across, a corner stands for its own twin; the
//! caller writes those edges again.

use super::kernel::{Value, narrow, widen};
use crate::base::{NONE, Scalar, Summand};
use crate::mesh::{Mesh, VertexSet, next_in_triangle, prev_in_triangle, turn_in_quad};
use crate::refine::{Pieces, PrimalSplit};
use crate::scheme::{SmoothMasks, VertexMask};
use std::ops::Mul;

// The regular rules, for one lane or several. Their sums are the same wherever one
// starts around a vertex or a face and whichever side of an edge one comes from, so that
// every path through the library gives the same bits.

/// The mean of a quad's vertices.
#[inline(always)]
pub(super) fn face_mean<T: Scalar, V: Summand + Mul<T, Output = V>>([a, b, c, d]: [V; 4]) -> V {
    ((a + c) + (b + d)) * T::from_f64(0.25)
}

/// The new vertex of an edge; `weights` are those of an end and of a side.
#[inline(always)]
pub(super) fn mix_edge<T: Scalar, V: Summand + Mul<T, Output = V>>(
    weights: [T; 2],
    ends: [V; 2],
    sides: [V; 2],
) -> V {
    (ends[0] + ends[1]) * weights[0] + (sides[0] + sides[1]) * weights[1]
}

/// An old vertex from itself and from the sums over its neighbours and its faces.
#[inline(always)]
pub(super) fn mix_vertex<T: Scalar, V: Summand + Mul<T, Output = V>>(
    weights: [T; 3],
    own: V,
    near: V,
    faces: V,
) -> V {
    own * weights[0] + near * weights[1] + faces * weights[2]
}

/// The sum over what surrounds a regular vertex, in order.
#[inline(always)]
pub(super) fn regular_sum<V: Summand, const N: usize>(around: [V; N]) -> V {
    let opposite = |i: usize| around[i] + around[i + N / 2];
    if N == 4 {
        return opposite(0) + opposite(1);
    }
    // Three numbers can be added in three ways; the largest result does not depend on
    // which of them came first.
    let [a, b, c] = [opposite(0), opposite(1), opposite(2)];
    ((a + b) + c).larger((b + c) + a).larger((c + a) + b)
}

/// The new vertices of faces, from a face on: means of their vertices.
pub(super) fn face_values<T: Scalar, const W: usize>(
    split: &PrimalSplit,
    values: &[Value<T, W>],
    first: u32,
    out: &mut [Value<T, W>],
) {
    let parent = split.parent();
    let layout = &parent.layout;
    let odd = if layout.side() == 4 { layout.irregular_faces() } else { layout.faces() };
    let (others, quads) = out.split_at_mut((odd.saturating_sub(first) as usize).min(out.len()));
    for (face, slot) in (first..).zip(others) {
        let corners = layout.face(face);
        let vertices = &parent.vert[corners.start as usize..corners.end as usize];
        *slot = mean(values, vertices);
    }
    let start = layout.irregular_corners() + 4 * (first.max(odd) - odd);
    let vertices = parent.vert[start.min(layout.corners()) as usize..].as_chunks::<4>().0;
    for (slot, quad) in quads.iter_mut().zip(vertices) {
        let quad = quad.map(|v| widen::<T, W>(&values[v as usize]));
        *slot = narrow::<T, W>(face_mean(quad));
    }
}

/// The mean of some vertices.
fn mean<T: Scalar, const W: usize>(values: &[Value<T, W>], vertices: &[u32]) -> Value<T, W> {
    let mut sum = [T::default(); W];
    for &v in vertices {
        add(&mut sum, &values[v as usize]);
    }
    let share = T::from_f64(1.0 / vertices.len() as f64);
    sum.map(|x| x * share)
}

/// Smooth new vertices of edges.
pub(super) struct EdgeKernel<'v, T, const W: usize> {
    mesh: &'v Mesh,
    pieces: Pieces,
    values: &'v [Value<T, W>],
    faces: &'v [Value<T, W>],
    weights: [T; 2],
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
            weights: [mask.end, mask.beside].map(T::from_f64),
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
            _ if self.linear => each(corners, out, |c| self.midpoint(c)),
            Pieces::Quads if quads => each(corners, out, |c| self.among_quads(c)),
            Pieces::Quads => each(corners, out, |c| self.among_faces(c)),
            Pieces::Triangles => each(corners, out, |c| self.among_triangles(c)),
        }
        true
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
            mix_edge(self.weights, ends.map(|it| it[lane]), sides.map(|it| it[lane]))
        })
    }

    fn midpoint(&self, corner: u32) -> Value<T, W> {
        let (a, b) = (self.at(corner), self.at(self.mesh.next(corner)));
        std::array::from_fn(|lane| (a[lane] + b[lane]) * self.weights[0])
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
        let opposite = |corner: u32| self.at(prev_in_triangle(corner));
        let ends = [self.at(corner), self.at(next_in_triangle(corner))];
        self.mix(ends, [opposite(corner), opposite(self.twin(corner))])
    }
}

#[inline(always)]
fn each<V>(corners: &[u32], out: &mut [V], value: impl Fn(u32) -> V) {
    for (slot, &corner) in out.iter_mut().zip(corners) {
        *slot = value(corner);
    }
}

/// Smooth old vertices.
///
/// Around a regular vertex all corners are found in two directions at once, so that few
/// loads wait for each other; around others one goes from corner to corner. Sums are taken
/// lane by lane: values of three lanes would have to be put together before every addition.
pub(super) struct VertexKernel<'v, T, const W: usize> {
    mesh: &'v Mesh,
    pieces: Pieces,
    values: &'v [Value<T, W>],
    faces: &'v [Value<T, W>],
    masks: SmoothMasks<f64>,
    /// The weights of the regular valence.
    regular: [T; 3],
}

impl<'v, T: Scalar, const W: usize> VertexKernel<'v, T, W> {
    pub(super) fn new(
        split: &'v PrimalSplit<'v>,
        masks: &SmoothMasks<f64>,
        values: &'v [Value<T, W>],
        faces: &'v [Value<T, W>],
    ) -> Self {
        let (mut masks, pieces) = (masks.clone(), split.pieces());
        let regular = weights(&masks.vertex(pieces.valence()));
        Self { mesh: split.parent(), pieces, values, faces, masks, regular }
    }

    /// Writes the old vertices from one on, but for those of a set.
    pub(super) fn run(&mut self, first: u32, out: &mut [Value<T, W>], except: &VertexSet) {
        let layout = &self.mesh.layout;
        let quads = layout.side() == 4 && layout.irregular_corners() == 0;
        match self.pieces {
            Pieces::Quads if quads => self.each(first, out, except, Self::in_quads),
            Pieces::Quads => self.each(first, out, except, |_, _, _, _| None),
            Pieces::Triangles => self.each(first, out, except, Self::in_triangles),
        }
    }

    #[inline(always)]
    fn each(
        &mut self,
        first: u32,
        out: &mut [Value<T, W>],
        except: &VertexSet,
        regular: impl Fn(&Self, u32, u32, &Value<T, W>) -> Option<Value<T, W>>,
    ) {
        let starts = &self.mesh.start[first as usize..];
        let values = &self.values[first as usize..];
        for (((v, slot), &start), own) in (first..).zip(out).zip(starts).zip(values) {
            if except.contains(v) {
                continue;
            }
            if start == NONE {
                *slot = *own;
                continue;
            }
            *slot = match regular(self, v, start, own) {
                Some(value) => value,
                None => self.any(own, start),
            };
        }
    }

    /// A vertex of any valence in any mesh.
    #[cold]
    #[inline(never)]
    fn any(&mut self, own: &Value<T, W>, start: u32) -> Value<T, W> {
        let (mut near, mut faces) = ([T::default(); W], [T::default(); W]);
        let mut valence = 0;
        for corner in self.mesh.fan_from(start) {
            add(&mut near, self.at(self.mesh.next(corner)));
            if self.pieces == Pieces::Quads {
                add(&mut faces, &self.faces[self.mesh.layout.face_of(corner) as usize]);
            }
            valence += 1;
        }
        let weights = weights(&self.masks.vertex(valence));
        std::array::from_fn(|lane| mix_vertex(weights, own[lane], near[lane], faces[lane]))
    }

    #[inline(always)]
    fn at(&self, corner: u32) -> &'v Value<T, W> {
        &self.values[self.mesh.vert[corner as usize] as usize]
    }

    /// A vertex of valence 4 in a mesh of quads only.
    #[inline(always)]
    fn in_quads(&self, vertex: u32, start: u32, own: &Value<T, W>) -> Option<Value<T, W>> {
        if self.mesh.special_set.contains(vertex) {
            return None;
        }
        let twin = |corner: u32| self.mesh.twin[corner as usize];
        let turn = |corner: u32, by| turn_in_quad(0, corner, by);
        let clockwise = turn(twin(start), 1);
        let around = twin(turn(start, 3));
        let across = twin(turn(around, 3));
        let corners = [start, around, across, clockwise];
        let near = corners.map(|corner| self.at(turn(corner, 1)));
        let faces = corners.map(|corner| &self.faces[(corner / 4) as usize]);
        Some(std::array::from_fn(|lane| {
            let near = regular_sum(near.map(|value| value[lane]));
            let faces = regular_sum(faces.map(|value| value[lane]));
            mix_vertex(self.regular, own[lane], near, faces)
        }))
    }

    /// A vertex of valence 6 in a mesh of triangles only; faces have no weight.
    #[inline(always)]
    fn in_triangles(&self, _: u32, start: u32, own: &Value<T, W>) -> Option<Value<T, W>> {
        let twin = |corner: u32| self.mesh.twin[corner as usize];
        let ccw = |corner: u32| twin(prev_in_triangle(corner));
        let cw = |corner: u32| next_in_triangle(twin(corner));
        let (left, right) = (ccw(start), cw(start));
        let (far_left, far_right) = (ccw(left), cw(right));
        let across = ccw(far_left);
        // Closed after six corners, and not after three or two, twice or thrice.
        if ccw(across) != far_right || far_left == start || across == start {
            return None;
        }
        let corners = [start, left, far_left, across, far_right, right];
        let near = corners.map(|corner| self.at(next_in_triangle(corner)));
        Some(std::array::from_fn(|lane| {
            let near = regular_sum(near.map(|value| value[lane]));
            mix_vertex(self.regular, own[lane], near, T::default())
        }))
    }
}

pub(super) fn weights<T: Scalar>(mask: &VertexMask<f64>) -> [T; 3] {
    [mask.own, mask.near, mask.face].map(T::from_f64)
}

fn add<T: Scalar, const W: usize>(sum: &mut Value<T, W>, value: &Value<T, W>) {
    for (sum, &x) in sum.iter_mut().zip(value) {
        *sum = *sum + x;
    }
}
