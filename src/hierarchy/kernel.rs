//! The inner loops: regular quads, four children at a time.
//!
//! A quad whose vertices are interior of valence 4, among quads only, has its
//! four children in one 4×4 grid of values; a tensor product of three taps gives
//! all of them. Whether a face is such a one is found out while gathering, which
//! costs less than keeping lists of those that are not.

use crate::base::{NONE, Scalar};
use crate::mesh::{Mesh, turn_in_quad};
use crate::scheme::Taps;

/// A value of `W` lanes.
pub(super) type Value<T, const W: usize> = [T; W];

/// Four lanes, which compilers turn into vector registers; narrower values are
/// padded with zeros on the way in.
type Wide<T> = [T; 4];

#[inline(always)]
fn widen<T: Scalar, const W: usize>(value: &Value<T, W>) -> Wide<T> {
    std::array::from_fn(|lane| if lane < W { value[lane] } else { T::default() })
}

#[inline(always)]
fn narrow<T: Scalar, const W: usize>(value: Wide<T>) -> Value<T, W> {
    std::array::from_fn(|lane| value[lane])
}

/// Σ wᵢ·xᵢ, lane by lane, in order.
#[inline(always)]
fn combine<T: Scalar, const N: usize>(weights: [T; N], values: [Wide<T>; N]) -> Wide<T> {
    std::array::from_fn(|lane| {
        let mut sum = weights[0] * values[0][lane];
        for i in 1..N {
            sum = sum + weights[i] * values[i][lane];
        }
        sum
    })
}

/// The univariate cut towards either end of an edge; `cut` is (near, far).
#[inline(always)]
fn cut_edge<T: Scalar>(cut: [T; 2], a: Wide<T>, b: Wide<T>) -> [Wide<T>; 2] {
    [combine(cut, [a, b]), combine(cut, [b, a])]
}

/// The corner operator on a quad, all four corners: the tensor square of the
/// univariate cut.
#[inline(always)]
pub(super) fn quad_corners<T: Scalar, const W: usize>(
    cut: [T; 2],
    x: [&Value<T, W>; 4],
) -> [Value<T, W>; 4] {
    let [x0, x1, x2, x3] = x.map(widen);
    let low = cut_edge(cut, x0, x1);
    let high = cut_edge(cut, x3, x2);
    let left = cut_edge(cut, low[0], high[0]);
    let right = cut_edge(cut, low[1], high[1]);
    [left[0], right[0], right[1], left[1]].map(narrow)
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

/// Corner arithmetic among the quads of a mesh.
#[derive(Debug, Clone, Copy)]
pub(super) struct Quads<'a> {
    pub(super) mesh: &'a Mesh,
    first: u32,
    count: u32,
}

impl<'a> Quads<'a> {
    pub(super) fn new(mesh: &'a Mesh) -> Self {
        let first = mesh.layout.first_quad_corner();
        Self { mesh, first, count: mesh.layout.corners() - first }
    }

    #[inline(always)]
    fn holds(self, corner: u32) -> bool {
        // NONE and irregular corners both fail this one comparison.
        corner.wrapping_sub(self.first) < self.count
    }

    #[inline(always)]
    fn turn(self, corner: u32, by: u32) -> u32 {
        turn_in_quad(self.first, corner, by)
    }

    /// The first corner of the quad that a corner belongs to.
    #[inline(always)]
    pub(super) fn face_start(self, corner: u32) -> u32 {
        self.first + ((corner - self.first) & !3)
    }

    /// True if an edge of the quad at this corner is a boundary edge.
    #[inline(always)]
    pub(super) fn touches_rim(self, corner: u32) -> bool {
        let c = corner as usize;
        self.mesh.twin[c..c + 4].contains(&NONE)
    }

    /// The vertices of the quad that starts at `corner`.
    #[inline(always)]
    pub(super) fn vertices(self, corner: u32) -> [u32; 4] {
        let c = corner as usize;
        let quad: &[u32; 4] = self.mesh.vert[c..c + 4].try_into().expect("four corners");
        *quad
    }

    /// The corners around a regular quad that starts at `corner`: beyond edge i
    /// and beyond vertex i. `None` if it is not regular.
    #[inline(always)]
    fn ring(self, corner: u32) -> Option<([u32; 4], [u32; 4])> {
        let twin = &self.mesh.twin;
        let c = corner as usize;
        let across: &[u32; 4] = twin[c..c + 4].try_into().expect("four corners");
        if !across.iter().all(|&t| self.holds(t)) {
            return None;
        }
        let mut diagonal = [0; 4];
        for i in 0..4 {
            // Two steps either way around vertex i meet if its valence is 4 (or
            // 2, when they meet at the corner itself).
            let left = twin[self.turn(across[(i + 3) % 4], 3) as usize];
            let right = twin[self.turn(across[i], 1) as usize];
            let own = corner + i as u32;
            if !self.holds(left) || !self.holds(right) || self.turn(right, 1) != left || left == own
            {
                return None;
            }
            diagonal[i] = left;
        }
        Some((*across, diagonal))
    }

    /// The grid of the mesh's vertices around a regular quad. With `mirrors`, a
    /// quad next to one on the boundary is not regular: that one's split points
    /// follow another rule.
    #[inline(always)]
    pub(super) fn vertex_grid(self, corner: u32, mirrors: bool) -> Option<Grid> {
        let (across, diagonal) = self.ring(corner)?;
        let on_rim = |c: &u32| self.touches_rim(self.face_start(*c));
        if mirrors && (across.iter().any(on_rim) || diagonal.iter().any(on_rim)) {
            return None;
        }
        let at = |corner: u32, by: u32| self.mesh.vert[self.turn(corner, by) as usize];
        Some(Grid {
            own: self.vertices(corner),
            near: across.map(|t| at(t, 2)),
            far: across.map(|t| at(t, 3)),
            beyond: diagonal.map(|d| at(d, 2)),
        })
    }

    /// The grid of corners, which are the vertices of the split mesh.
    #[inline(always)]
    pub(super) fn corner_grid(self, corner: u32) -> Option<Grid> {
        let (across, diagonal) = self.ring(corner)?;
        Some(Grid {
            own: std::array::from_fn(|i| corner + i as u32),
            near: across.map(|t| self.turn(t, 1)),
            far: across,
            beyond: diagonal,
        })
    }
}

/// The tensor product of three taps at the four inner places of a grid.
#[inline(always)]
pub(super) fn grid_children<T: Scalar, const W: usize>(
    taps: Taps<T>,
    grid: &Grid,
    values: &[Value<T, W>],
) -> [Value<T, W>; 4] {
    let at = |i: u32| widen(&values[i as usize]);
    let Grid { own, near, far, beyond } = grid;
    // Rows of the grid, vertex 0 lower left, counter-clockwise.
    let rows = [
        [at(beyond[0]), at(near[0]), at(far[0]), at(beyond[1])],
        [at(far[3]), at(own[0]), at(own[1]), at(near[1])],
        [at(near[3]), at(own[3]), at(own[2]), at(far[1])],
        [at(beyond[3]), at(far[2]), at(near[2]), at(beyond[2])],
    ];
    let left = rows.map(|r| combine(taps, [r[0], r[1], r[2]]));
    let right = rows.map(|r| combine(taps, [r[3], r[2], r[1]]));
    let low = |x: &[Wide<T>; 4]| narrow(combine(taps, [x[0], x[1], x[2]]));
    let high = |x: &[Wide<T>; 4]| narrow(combine(taps, [x[3], x[2], x[1]]));
    [low(&left), low(&right), high(&right), high(&left)]
}
