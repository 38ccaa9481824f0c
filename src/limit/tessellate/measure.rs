//! How far triangles on a cell's points are from the surface, or how long they are on a screen.
//!
//! Interpolation: let a point of a triangle have barycentric weights λᵢ, and let dᵢ lead from it
//! to the corners. The linear interpolant is off by ½ Σ λᵢ |D²f(dᵢ, dᵢ)| at most, each at some
//! point of the cell. The dᵢ have mean 0 and lie in a box of sides w and h, so that Σ λᵢ du² is w²/4
//! at most, and the sum (w² |f_uu| + 2wh |f_uv| + h² |f_vv|)/8, whatever triangles of a square it is
//! (Filip, Magedson and Markot 1986 for two right ones). For a triangle let M bound |D²f(e, e)| for
//! its sides e: the interpolant is off by Mλ₁(1 − λ₁)/2 at most where the parallel to a side through
//! a point meets the others, and by Mλ₂λ₃/2 more along it, in all by
//! M(λ₁λ₂ + λ₂λ₃ + λ₃λ₁)/2, a sixth of M at most. The sides of the triangles that a cell is cut
//! into are its own, halves of them, lines between their middles, and medians, for which 5/4 of
//! the largest is a bound: 5/24 of it in all.
//!
//! Hull: a surface lies in the hull of its coefficients, and distance from a convex set is largest
//! at one of them. So flat cells are found in which points only move within the plane.

use super::cell::Shape;
use super::fit::{Fit, places};
use glam::DVec3;
use std::ops::Range;

/// What is measured of cells.
#[derive(Debug, Clone, Copy)]
pub(super) enum Measure {
    /// Distance from the surface.
    Chord,
    /// Lengths in pixels.
    Screen {
        /// By rows, from (x, y, z, 1) to clip coordinates.
        matrix: [[f64; 4]; 4],
        /// Half the width and height of the viewport.
        half: [f64; 2],
    },
}

impl Measure {
    /// The measure of the triangles of a cell; where it exceeds the limit it may be larger
    /// than need be.
    pub(super) fn of(&self, fit: &Fit, limit: f64) -> f64 {
        match self {
            Self::Chord => match interpolation(fit) {
                bound if bound <= limit => bound,
                bound => bound.min(hull(fit, limit)),
            },
            Self::Screen { matrix, half } => longest(&Projection { matrix, half: *half }, fit),
        }
    }
}

/// The longest edge of triangles on a screen, of what is in view.
pub(super) fn longest_in_view(
    (matrix, half): (&[[f64; 4]; 4], [f64; 2]),
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
) -> f64 {
    let projection = Projection { matrix, half };
    let clip = |v: u32| projection.clip(DVec3::from(positions[v as usize]));
    let lengths = triangles.iter().flat_map(|&[a, b, c]| {
        let [a, b, c] = [a, b, c].map(clip);
        [[a, b], [b, c], [c, a]].map(|[a, b]| projection.length(a, b, 0..SIDES))
    });
    most(lengths)
}

/// The largest length; one that is no number is too long.
fn most(lengths: impl Iterator<Item = f64>) -> f64 {
    lengths.fold(0.0, |most, x| if x.is_nan() { f64::INFINITY } else { most.max(x) })
}

/// The bound by second derivatives, which are those of coefficients' differences.
fn interpolation(fit: &Fit) -> f64 {
    let largest = |[a, b]: [[usize; 2]; 2]| {
        // Of D²f(a, b) but for a factor.
        let difference = |[i, j]: [usize; 2]| {
            let at = |k: usize, l: usize| fit.at(i + k * a[0] + l * b[0], j + k * a[1] + l * b[1]);
            (at(1, 1) - at(1, 0) - at(0, 1) + at(0, 0)).length_squared()
        };
        let fits = |[i, j]: [usize; 2]| {
            let far = [i + a[0] + b[0], j + a[1] + b[1]];
            if fit.shape == Shape::Triangle {
                far[0] + far[1] <= 4
            } else {
                far.iter().all(|&x| x <= 4)
            }
        };
        places(fit.shape).filter(|&place| fits(place)).map(difference).fold(0.0, f64::max).sqrt()
    };
    let (u, v) = ([1, 0], [0, 1]);
    match fit.shape {
        Shape::Triangle => {
            let across = |[i, j]: [usize; 2]| {
                (fit.at(i + 2, j) - 2.0 * fit.at(i + 1, j + 1) + fit.at(i, j + 2)).length_squared()
            };
            let inner = places(fit.shape).filter(|[i, j]| i + j <= 2);
            let third = inner.map(across).fold(0.0, f64::max).sqrt();
            12.0 * 5.0 / 24.0 * largest([u, u]).max(largest([v, v])).max(third)
        }
        _ => (12.0 * (largest([u, u]) + largest([v, v])) + 32.0 * largest([u, v])) / 8.0,
    }
}

/// The bound by the hull of coefficients, or infinity where it exceeds a limit.
///
/// Coefficients within d of a cell's triangles, and those of its sides within d of their chords,
/// put the surface within d of the corners' hull, which is within the distance t of both
/// diagonals of either pair of triangles. Points of sides that neighbours add are off by d again.
fn hull(fit: &Fit, limit: f64) -> f64 {
    let corners = match fit.shape {
        Shape::Triangle => [fit.at(0, 0), fit.at(4, 0), fit.at(0, 4), fit.at(0, 4)],
        _ => [fit.at(0, 0), fit.at(4, 0), fit.at(4, 4), fit.at(0, 4)],
    };
    let [a, b, c, d] = corners;
    let thickness = if fit.shape == Shape::Triangle { 0.0 } else { between([a, c], [b, d]) };
    let mut farthest: f64 = 0.0;
    let sides = fit.side_lines().flat_map(|line| {
        let chord = [line[0], line[4]];
        [1, 2, 3].map(|k| from_segment(line[k], chord))
    });
    let inner = fit.all().map(|p| from_triangle(p, [a, b, c]).min(from_triangle(p, [a, c, d])));
    for distance in sides.chain(inner) {
        farthest = farthest.max(distance);
        let bound = 2.0 * farthest + thickness;
        if bound.is_nan() || bound > limit {
            return f64::INFINITY;
        }
    }
    2.0 * farthest + thickness
}

fn from_segment(p: DVec3, [a, b]: [DVec3; 2]) -> f64 {
    let along = b - a;
    let square = along.length_squared();
    let t = if square > 0.0 { ((p - a).dot(along) / square).clamp(0.0, 1.0) } else { 0.0 };
    p.distance(a + t * along)
}

/// The distance from a triangle: from its plane above it, else from its sides.
fn from_triangle(p: DVec3, [a, b, c]: [DVec3; 3]) -> f64 {
    let normal = (b - a).cross(c - a);
    let is_inside = |from: DVec3, to: DVec3| (to - from).cross(p - from).dot(normal) >= 0.0;
    let length = normal.length();
    if length > 0.0 && is_inside(a, b) && is_inside(b, c) && is_inside(c, a) {
        return ((p - a).dot(normal) / length).abs();
    }
    [[a, b], [b, c], [c, a]]
        .map(|side| from_segment(p, side))
        .into_iter()
        .fold(f64::INFINITY, f64::min)
}

/// At least the distance between two segments.
fn between([a, c]: [DVec3; 2], [b, d]: [DVec3; 2]) -> f64 {
    let (along, across, apart) = (c - a, d - b, b - a);
    let [aa, ab, bb] = [along.length_squared(), along.dot(across), across.length_squared()];
    let determinant = aa * bb - ab * ab;
    let s = if determinant > 0.0 {
        ((bb * apart.dot(along) - ab * apart.dot(across)) / determinant).clamp(0.0, 1.0)
    } else {
        0.5
    };
    from_segment(a + s * along, [b, d])
}

/// From space to pixels.
struct Projection<'a> {
    matrix: &'a [[f64; 4]; 4],
    half: [f64; 2],
}

impl Projection<'_> {
    fn clip(&self, p: DVec3) -> [f64; 4] {
        self.matrix.map(|[x, y, z, w]| x * p.x + y * p.y + z * p.z + w)
    }

    /// The length of what lies within some sides of the view of a segment between points in clip
    /// coordinates.
    fn length(&self, a: [f64; 4], b: [f64; 4], sides: Range<usize>) -> f64 {
        let (mut first, mut last) = (0.0_f64, 1.0_f64);
        for (from, to) in inside(a)[sides.clone()].iter().zip(&inside(b)[sides]) {
            match (*from < 0.0, *to < 0.0) {
                (true, true) => return 0.0,
                (true, false) => first = first.max(from / (from - to)),
                (false, true) => last = last.min(from / (from - to)),
                (false, false) => {}
            }
        }
        if first >= last {
            return 0.0;
        }
        let pixel = |t: f64| {
            let at = |k: usize| a[k] + t * (b[k] - a[k]);
            [0, 1].map(|k| at(k) / at(3) * self.half[k])
        };
        let [from, to] = [pixel(first), pixel(last)];
        ((from[0] - to[0]) * (from[0] - to[0]) + (from[1] - to[1]) * (from[1] - to[1])).sqrt()
    }

    /// True if all of a cell lies beyond one side of the view, since its coefficients do.
    fn is_out_of_view(&self, fit: &Fit) -> bool {
        let mut outside = [true; SIDES];
        for p in fit.all() {
            for (all, inside) in outside.iter_mut().zip(inside(self.clip(p))) {
                *all &= inside < 0.0;
            }
        }
        outside.contains(&true)
    }
}

/// Of a view: left, right, below, above and in front of the viewer.
const SIDES: usize = 5;
/// The last of them.
const NEAR: usize = 4;

/// Below 0 beyond a side of the view.
fn inside([x, y, z, w]: [f64; 4]) -> [f64; SIDES] {
    [w + x, w - x, w + y, w - y, w + z]
}

/// The longest of the lines between points at halves of a cell's sides that triangles may have, of
/// what is in front of the viewer; 0 if all of the cell is out of view.
///
/// Lines are not cut at the other sides of the view: what is between them may be in view where
/// they are not.
fn longest(projection: &Projection, fit: &Fit) -> f64 {
    const SQUARE: [[[usize; 2]; 3]; 8] = [
        [[0, 0], [1, 0], [2, 0]],
        [[0, 1], [1, 1], [2, 1]],
        [[0, 2], [1, 2], [2, 2]],
        [[0, 0], [0, 1], [0, 2]],
        [[1, 0], [1, 1], [1, 2]],
        [[2, 0], [2, 1], [2, 2]],
        [[0, 0], [1, 1], [2, 2]],
        [[2, 0], [1, 1], [0, 2]],
    ];
    /// From the middle of a side to the corners across.
    const ACROSS: [[[usize; 2]; 2]; 8] = [
        [[1, 0], [0, 2]],
        [[1, 0], [2, 2]],
        [[2, 1], [0, 0]],
        [[2, 1], [0, 2]],
        [[1, 2], [0, 0]],
        [[1, 2], [2, 0]],
        [[0, 1], [2, 0]],
        [[0, 1], [2, 2]],
    ];
    const TRIANGLE: [[[usize; 2]; 3]; 3] =
        [[[0, 0], [1, 0], [2, 0]], [[2, 0], [1, 1], [0, 2]], [[0, 2], [0, 1], [0, 0]]];
    /// Medians, and the lines between middles of sides.
    const INSIDE: [[[usize; 2]; 2]; 6] = [
        [[0, 0], [1, 1]],
        [[2, 0], [0, 1]],
        [[0, 2], [1, 0]],
        [[1, 0], [1, 1]],
        [[1, 1], [0, 1]],
        [[0, 1], [1, 0]],
    ];
    if projection.is_out_of_view(fit) {
        return 0.0;
    }
    let points = fit.points().map(|row| row.map(|p| projection.clip(p)));
    let mut halves = places(fit.shape).filter(|place| place.iter().all(|k| k % 2 == 0));
    if halves.all(|[i, j]| inside(points[j / 2][i / 2])[NEAR] < 0.0) {
        // Something in between is in front.
        return f64::INFINITY;
    }
    let length = |[a, b]: [[usize; 2]; 2]| {
        projection.length(points[a[1]][a[0]], points[b[1]][b[0]], NEAR..SIDES)
    };
    // By way of the middle, lest a line that comes back looks short.
    let bent = |[a, b, c]: [[usize; 2]; 3]| length([a, c]).max(length([a, b]) + length([b, c]));
    match fit.shape {
        Shape::Triangle => most(TRIANGLE.map(bent).into_iter().chain(INSIDE.map(length))),
        _ => most(SQUARE.map(bent).into_iter().chain(ACROSS.map(length))),
    }
}
