//! Regular triangles of Loop's scheme: the quartic box spline with its twelve points.
//!
//! In barycentric coordinates a, b, c the polynomials are of three kinds, each symmetric: of a
//! corner, of the vertex across an edge, and of the two others beside a corner (Stam 1998,
//! "Evaluation of Loop subdivision surfaces").

use crate::base::NONE;
use crate::mesh::{INFINITE, Mesh};
use crate::scheme::Scheme;

/// A factor and the exponents of three coordinates.
type Term = (f64, [i32; 3]);

/// At the corner of the first coordinate.
const CORNER: [Term; 15] = [
    (6.0, [4, 0, 0]),
    (24.0, [3, 1, 0]),
    (24.0, [3, 0, 1]),
    (24.0, [2, 2, 0]),
    (60.0, [2, 1, 1]),
    (24.0, [2, 0, 2]),
    (8.0, [1, 3, 0]),
    (36.0, [1, 2, 1]),
    (36.0, [1, 1, 2]),
    (8.0, [1, 0, 3]),
    (1.0, [0, 4, 0]),
    (6.0, [0, 3, 1]),
    (12.0, [0, 2, 2]),
    (6.0, [0, 1, 3]),
    (1.0, [0, 0, 4]),
];
/// Across the edge between the first two.
const ACROSS: [Term; 9] = [
    (1.0, [4, 0, 0]),
    (6.0, [3, 1, 0]),
    (12.0, [2, 2, 0]),
    (6.0, [1, 3, 0]),
    (1.0, [0, 4, 0]),
    (2.0, [3, 0, 1]),
    (2.0, [0, 3, 1]),
    (6.0, [2, 1, 1]),
    (6.0, [1, 2, 1]),
];
/// Beside the first corner, on the side of the second.
const BESIDE: [Term; 2] = [(1.0, [4, 0, 0]), (2.0, [3, 1, 0])];

/// Weights of the twelve points, in the order of [`points`], for a derivative by u and v, so
/// many times each, at barycentric coordinates (1 − u − v, u, v).
pub(super) fn taps(u: f64, v: f64, by: [usize; 2]) -> [f64; 12] {
    let at = [1.0 - u - v, u, v];
    let value = |terms: &[Term], order: [usize; 3]| {
        let sum = |sum: f64, term: &Term| sum + derived(*term, order, at, by);
        terms.iter().fold(0.0, sum) / 12.0
    };
    let kind = |i: usize| match i {
        0..3 => value(&CORNER, [i, (i + 1) % 3, (i + 2) % 3]),
        3..6 => value(&ACROSS, [i % 3, (i + 1) % 3, (i + 2) % 3]),
        6..9 => value(&BESIDE, [i % 3, (i + 1) % 3, (i + 2) % 3]),
        _ => value(&BESIDE, [i % 3, (i + 2) % 3, (i + 1) % 3]),
    };
    std::array::from_fn(kind)
}

/// A derivative of a term whose coordinates are named in an order.
fn derived(term: Term, order: [usize; 3], at: [f64; 3], by: [usize; 2]) -> f64 {
    let (factor, exponents) = term;
    let Some(axis) = (0..2).find(|&axis| by[axis] > 0) else {
        let power = |i: usize| (0..exponents[i]).fold(1.0, |power, _| power * at[order[i]]);
        return factor * power(0) * power(1) * power(2);
    };
    let mut less = by;
    less[axis] -= 1;
    // With u or v the first coordinate falls and their own rises.
    let part = |coordinate: usize, sign: f64| {
        let i = (0..3).find(|&i| order[i] == coordinate).unwrap_or(0);
        if exponents[i] == 0 {
            return 0.0;
        }
        let mut lower = exponents;
        lower[i] -= 1;
        derived((sign * factor * f64::from(exponents[i]), lower), order, at, less)
    };
    part(axis + 1, 1.0) + part(0, -1.0)
}

/// Vertices with factors.
pub(super) type Row = Vec<(u32, f64)>;

/// The twelve points of a triangle whose corners are of valence 6, or half of that on a
/// boundary or an edge that is sharp for ever: the corners, those across the edges, and beside
/// each corner those next to the edge that leaves it and next to the one that comes to it.
pub(super) fn points(scheme: &Scheme, mesh: &Mesh, corner: u32) -> Option<[Row; 12]> {
    let corners = [corner, mesh.next(corner), mesh.prev(corner)];
    let mut points: [Row; 12] = Default::default();
    for (i, &c) in corners.iter().enumerate() {
        let [.., third, fourth, fifth] = ring(scheme, mesh, c)?;
        points[i] = vec![(mesh.vert[c as usize], 1.0)];
        (points[3 + i], points[6 + i], points[9 + i]) = (fifth, fourth, third);
    }
    Some(points)
}

/// The points around the vertex of a corner, counter-clockwise from the end of its edge.
///
/// Beyond a boundary they are those that make a parallelogram of each triangle there and
/// its image, b + c − a: then the smooth rules come to those of the boundary.
fn ring(scheme: &Scheme, mesh: &Mesh, corner: u32) -> Option<[Row; 6]> {
    let v = mesh.vert[corner as usize];
    let (mut sharp, mut passing) = (0, scheme.vertex_sharpness(mesh, v) > 0.0);
    mesh.each_edge_at(v, |_, sharpness| {
        sharp += usize::from(sharpness >= INFINITE);
        passing |= sharpness > 0.0 && sharpness < INFINITE;
    });
    let end = |c: u32| mesh.vert[mesh.next(c) as usize];
    match sharp {
        _ if passing => None,
        0 => {
            let mut fan = mesh.fan_from(corner);
            let mut ring: [Row; 6] = Default::default();
            for slot in &mut ring {
                slot.push((end(fan.next()?), 1.0));
            }
            fan.next().is_none().then_some(ring)
        }
        2 => {
            let is_end = |c: u32| {
                let twin = mesh.twin[c as usize];
                twin == NONE || mesh.sharpness.edge(mesh.first_of_edge(c)) >= INFINITE
            };
            let back = |&c: &u32| (!is_end(c)).then(|| mesh.cw(c));
            let way: Vec<u32> = std::iter::successors(Some(corner), back).take(4).collect();
            let first = *way.last()?;
            let side: Vec<u32> = mesh.fan_from(first).take(3).collect();
            let &[_, second, third] = &side[..] else { return None };
            let last = mesh.prev(third);
            if !is_end(first) || is_end(second) || is_end(third) || !is_end(last) {
                return None;
            }
            let near = [end(first), end(second), end(third), mesh.vert[last as usize]];
            let beyond = |a: usize, b: usize| vec![(near[a], 1.0), (v, 1.0), (near[b], -1.0)];
            let [a, b, c, d] = near.map(|v| vec![(v, 1.0)]);
            let mut ring = [a, b, c, d, beyond(3, 2), beyond(0, 1)];
            ring.rotate_left(way.len() - 1);
            Some(ring)
        }
        _ => None,
    }
}
