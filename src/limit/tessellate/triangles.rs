//! What triangles a cell becomes, with the points that finer cells beside it have on its sides.

use super::cell::{Cell, Point, Shape};
use super::net::middle;

/// The middle of a square.
const CENTRE: [i32; 2] = [2, 2];

/// The number of triangles of a cell.
pub(super) fn count(shape: Shape, cuts: [bool; 4]) -> usize {
    let cuts = cuts.iter().filter(|cut| **cut).count();
    match (shape, cuts) {
        (Shape::Triangle, _) => 1 + cuts,
        (_, 0 | 1) => 2 + cuts,
        _ => 4 + cuts,
    }
}

/// The points of a cell besides its corners: where sides are cut, and the middle that more than
/// one cut asks for.
pub(super) fn further(shape: Shape, cell: Cell, cuts: [bool; 4]) -> impl Iterator<Item = Point> {
    let corners = Cell::corners(shape);
    let middles = (0..corners.len()).filter(move |&i| cuts[i]).map(|i| middle(corners, i));
    let several = cuts.iter().filter(|cut| **cut).count() > 1;
    let centre = (shape != Shape::Triangle && several).then_some(CENTRE);
    middles.chain(centre).map(move |at| cell.quarters(at))
}

/// Gives the triangles of a cell, counter-clockwise. `first_diagonal` tells of four points in
/// order whether they are to be cut from the first to the third.
pub(super) fn triangles(
    shape: Shape,
    cell: Cell,
    cuts: [bool; 4],
    first_diagonal: impl Fn([Point; 4]) -> bool,
    mut give: impl FnMut([Point; 3]),
) {
    let corners = Cell::corners(shape);
    let sides = corners.len();
    let around = (0..sides).flat_map(|i| {
        let cut = cuts[i].then(|| middle(corners, i));
        std::iter::once(corners[i]).chain(cut).map(|at| cell.quarters(at))
    });
    let mut polygon = [[0; 2]; 8];
    let mut len = 0;
    for point in around {
        polygon[len] = point;
        len += 1;
    }
    let mut quad = |[a, b, c, d]: [Point; 4], give: &mut dyn FnMut([Point; 3])| {
        if first_diagonal([a, b, c, d]) {
            give([a, b, c]);
            give([a, c, d]);
        } else {
            give([a, b, d]);
            give([b, c, d]);
        }
    };
    // From a point on a side, where there is one.
    let start = (0..sides).find(|&i| cuts[i]).map_or(0, |i| i + 1);
    polygon[..len].rotate_left(start);
    let p = polygon;
    match (shape, len) {
        (_, 3) => give([p[0], p[1], p[2]]),
        (Shape::Triangle, 4) => {
            give([p[0], p[1], p[2]]);
            give([p[0], p[2], p[3]]);
        }
        (Shape::Triangle, 5) => two_cuts(p, &mut quad, &mut give),
        (Shape::Triangle, _) => {
            // p[0], p[2] and p[4] are the points on sides.
            give([p[0], p[2], p[4]]);
            (0..3).for_each(|i| give([p[2 * i], p[2 * i + 1], p[(2 * i + 2) % 6]]));
        }
        (_, 4) => quad([p[0], p[1], p[2], p[3]], &mut give),
        (_, 5) => (1..4).for_each(|i| give([p[0], p[i], p[i + 1]])),
        _ => {
            let middle = cell.quarters(CENTRE);
            (0..len).for_each(|i| give([middle, p[i], p[(i + 1) % len]]));
        }
    }
}

/// A triangle with points on two sides, the first of five points being one of them.
fn two_cuts(
    p: [Point; 8],
    quad: &mut impl FnMut([Point; 4], &mut dyn FnMut([Point; 3])),
    give: &mut impl FnMut([Point; 3]),
) {
    // Side, corner, side, corner, corner; or side, corner, corner, side, corner.
    let is_middle = |i: usize| {
        let [before, after] = [p[(i + 4) % 5], p[(i + 1) % 5]];
        (0..2).all(|k| 2 * p[i][k] == before[k] + after[k])
    };
    if is_middle(2) {
        give([p[0], p[1], p[2]]);
        quad([p[0], p[2], p[3], p[4]], give);
    } else {
        give([p[3], p[4], p[0]]);
        quad([p[0], p[1], p[2], p[3]], give);
    }
}
