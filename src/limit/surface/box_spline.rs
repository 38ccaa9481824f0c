//! Regular triangles of Loop's scheme: the quartic box spline with its twelve points.
//!
//! In barycentric coordinates a, b, c the polynomials are of three kinds, each symmetric: of a
//! corner, of the vertex across an edge, and of the two others beside a corner (Stam 1998,
//! "Evaluation of Loop subdivision surfaces").

use crate::base::NONE;
use crate::mesh::Mesh;
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

/// The twelve vertices of a triangle whose corners are interior, smooth and of valence 6:
/// the corners, those across the edges, and beside each corner those next to the edge that
/// leaves it and next to the one that comes to it.
pub(super) fn points(scheme: &Scheme, mesh: &Mesh, corner: u32) -> Option<Vec<u32>> {
    let corners = [corner, mesh.next(corner), mesh.prev(corner)];
    let mut points = vec![0; 12];
    for (i, &c) in corners.iter().enumerate() {
        let mut ring = [0; 6];
        let mut fan = mesh.fan_from(c);
        for slot in &mut ring {
            let at = fan.next()?;
            if mesh.twin[at as usize] == NONE || mesh.sharpness.edge(mesh.first_of_edge(at)) > 0.0 {
                return None;
            }
            *slot = mesh.vert[mesh.next(at) as usize];
        }
        let v = mesh.vert[c as usize];
        if fan.next().is_some() || scheme.vertex_sharpness(mesh, v) > 0.0 {
            return None;
        }
        points[i] = v;
        points[3 + i] = ring[5];
        points[6 + i] = ring[4];
        points[9 + i] = ring[3];
    }
    Some(points)
}
