//! The inner loops: regular quads, four children at a time.
//!
//! A quad whose vertices are interior of valence 4, among quads only, has its
//! four children in one 4×4 grid of values, which gives all of them
//! (`regular_rule`). Whether a face is such a one is found out while gathering, which
//! costs less than keeping lists of those that are not.

use super::regular_rule::RegularRule;
use crate::base::{Fraction, NONE, Scalar};
use crate::mesh::QuadWalker;
use crate::scheme::{CornerWeights, Scheme};

/// A value of `W` lanes.
pub(super) type Value<T, const W: usize> = [T; W];

/// Narrower values are padded with zeros on the way into four lanes.
#[inline(always)]
pub(super) fn widen<T: Scalar, const W: usize>(value: &Value<T, W>) -> T::Lanes {
    T::lanes(std::array::from_fn(|lane| if lane < W { value[lane] } else { T::default() }))
}

#[inline(always)]
pub(super) fn narrow<T: Scalar, const W: usize>(lanes: T::Lanes) -> Value<T, W> {
    let lanes = T::unlaned(lanes);
    std::array::from_fn(|lane| lanes[lane])
}

/// The corner operator of a scheme's split on quads.
#[derive(Debug, Clone, Copy)]
pub(super) struct QuadWeights<T> {
    own: T,
    beside: T,
    across: T,
}

impl<T: Scalar> QuadWeights<T> {
    pub(super) fn new(scheme: &Scheme) -> Self {
        let mut weights = CornerWeights::<f64>::new(scheme.rule(), Fraction::HALF);
        let at = weights.of(4);
        let [own, beside, across] = [at[0], at[1], at[2]].map(T::from_f64);
        Self { own, beside, across }
    }
}

/// What the corners of a quad become. The additions do not depend on where the quad starts,
/// so that quads of one shape give the same bits whoever refines them. Weighed before they are
/// added, values near the limit stay in range.
#[inline(always)]
pub(super) fn quad_children<T: Scalar>(weights: QuadWeights<T>, x: [T::Lanes; 4]) -> [T::Lanes; 4] {
    let part = x.map(|value| value * weights.beside);
    let beside = [part[1] + part[3], part[0] + part[2]];
    let child = |i: usize| x[i] * weights.own + beside[i % 2] + x[(i + 2) % 4] * weights.across;
    [child(0), child(1), child(2), child(3)]
}

/// The same for stored values.
#[inline(always)]
pub(super) fn quad_corners<T: Scalar, const W: usize>(
    weights: QuadWeights<T>,
    x: [&Value<T, W>; 4],
) -> [Value<T, W>; 4] {
    quad_children::<T>(weights, x.map(widen::<T, W>)).map(narrow::<T, W>)
}

/// The grid around a quad: the corners of its face, in order, and for each
/// corner `i` what lies beyond its edge near either end, and beyond its vertex.
#[derive(Debug, Clone, Copy)]
pub(super) struct Grid {
    /// At vertex i.
    pub(super) own: [u32; 4],
    /// Beyond edge i, next to vertex i.
    pub(super) near: [u32; 4],
    /// Beyond edge i, next to vertex i + 1.
    pub(super) far: [u32; 4],
    /// Diagonally beyond vertex i.
    pub(super) beyond: [u32; 4],
}

impl Grid {
    /// Row by row, vertex 0 lower left, counter-clockwise.
    #[inline(always)]
    pub(super) fn rows(&self) -> [[u32; 4]; 4] {
        let Self { own, near, far, beyond } = self;
        [
            [beyond[0], near[0], far[0], beyond[1]],
            [far[3], own[0], own[1], near[1]],
            [near[3], own[3], own[2], far[1]],
            [beyond[3], far[2], near[2], beyond[2]],
        ]
    }
}

/// True if an edge of the quad at this corner is a boundary edge.
#[inline(always)]
pub(super) fn touches_rim(quads: QuadWalker, corner: u32) -> bool {
    quads.twins(corner).contains(&NONE)
}

/// The grid of the mesh's vertices around a regular quad. With `mirrors`, a quad
/// next to one on the boundary is not regular: that one's split points follow
/// another rule.
#[inline(always)]
pub(super) fn vertex_grid(quads: QuadWalker, corner: u32, mirrors: bool) -> Option<Grid> {
    let ring = quads.ring(corner)?;
    let on_rim = |c: &u32| touches_rim(quads, quads.face_start(*c));
    if mirrors && (ring.across.iter().any(on_rim) || ring.beyond.iter().any(on_rim)) {
        return None;
    }
    let at = |corner: u32, by: u32| quads.mesh.vert[quads.turn(corner, by) as usize];
    Some(Grid {
        own: quads.vertices(corner),
        near: ring.across.map(|t| at(t, 2)),
        far: ring.across.map(|t| at(t, 3)),
        beyond: ring.beyond.map(|d| at(d, 2)),
    })
}

/// The grid of corners, which are the vertices of the split mesh.
#[inline(always)]
pub(super) fn corner_grid(quads: QuadWalker, corner: u32) -> Option<Grid> {
    let ring = quads.ring(corner)?;
    Some(Grid {
        own: std::array::from_fn(|i| corner + i as u32),
        near: ring.across.map(|t| quads.turn(t, 1)),
        far: ring.across,
        beyond: ring.beyond,
    })
}

/// What the corners of a quad become, from the grid around it.
#[inline(always)]
pub(super) fn grid_children<T: Scalar, const W: usize>(
    rule: RegularRule<T>,
    grid: &Grid,
    values: &[Value<T, W>],
) -> [Value<T, W>; 4] {
    let rows = grid.rows();
    let at = |x: usize, y: usize| widen::<T, W>(&values[rows[y][x] as usize]);
    let row = |y: usize| [at(0, y), at(1, y), at(2, y), at(3, y)];
    rule.around_quad([row(0), row(1), row(2), row(3)]).map(narrow::<T, W>)
}

/// The vertices around the vertex of a corner, row by row with the corner's face to the upper
/// right, if the vertex is interior of valence 4 among quads; `mirrors` as in [`vertex_grid`].
pub(super) fn star(quads: QuadWalker, corner: u32, mirrors: bool) -> Option<[[u32; 3]; 3]> {
    let vert = |corner: u32| quads.mesh.vert[corner as usize];
    let regular = |c: u32| quads.holds(c) && !(mirrors && touches_rim(quads, quads.face_start(c)));
    if !quads.holds(corner) || quads.mesh.special_set.contains(vert(corner)) {
        return None;
    }
    let mut corners = [corner; 4];
    for i in 0..4 {
        if !regular(corners[i]) {
            return None;
        }
        if i < 3 {
            corners[i + 1] = quads.mesh.twin[quads.turn(corners[i], 3) as usize];
        }
    }
    let [e, n, w, s] = corners.map(|c| vert(quads.turn(c, 1)));
    let [ne, nw, sw, se] = corners.map(|c| vert(quads.turn(c, 2)));
    Some([[sw, s, se], [w, vert(corner), e], [nw, n, ne]])
}
