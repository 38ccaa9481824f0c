//! C_t on a face seen with its mirror image across the boundary.
//!
//! On an anchored mesh a boundary row lies half an interval from its
//! neighbours. A face with one boundary edge (a, b) and other vertices x₁ … x_m
//! is completed by their images x*_i = 2s_i − x_i, with s_i on the edge, to the
//! 2m-gon x₁ … x_m, x*_m … x*₁; a face with two boundary edges that meet at a
//! corner κ has κ replaced by 4κ − 2β₁ − 2β₂ + o and each β by 2β − y (o the mean
//! of the other vertices, y the neighbour of β away from κ). Folding the images
//! back gives a row on the face's own vertices.

use super::{CornerWeights, RowSink};
use crate::base::Weight;
use crate::refine::{Cycle, Side};

/// Emits `scale` times the row of C_t at place 0 of a cycle.
pub(super) fn cycle_row<W: Weight>(
    cycle: &Cycle,
    corner: &mut CornerWeights<W>,
    scale: &W,
    sink: &mut impl RowSink<W>,
) {
    let vertices = &cycle.vertices;
    let n = vertices.len();
    match cycle.side {
        Side::Inside => {
            for (&v, w) in vertices.iter().zip(corner.of(n)) {
                sink.add(v, scale.clone() * w.clone());
            }
        }
        Side::Edge(a) => {
            let row = edge_row(n, a, corner.of(2 * (n - 2)));
            emit(vertices, row, scale, sink);
        }
        Side::Corner(kappa) => {
            let row = corner_row(n, kappa, corner.of(n));
            emit(vertices, row, scale, sink);
        }
    }
}

fn emit<W: Weight>(vertices: &[u32], row: Vec<W>, scale: &W, sink: &mut impl RowSink<W>) {
    for (&v, w) in vertices.iter().zip(row) {
        sink.add(v, scale.clone() * w);
    }
}

/// One boundary edge, from place `a` to the next.
fn edge_row<W: Weight>(n: usize, a: usize, weights: &[W]) -> Vec<W> {
    let m = n - 2;
    let place = |i: usize| (a + 2 + i) % n;
    // Which of x₁ … x_m is place 0.
    let own = (2 * n - a - 2) % n;
    let at = |i: usize| weights[(i + 2 * m - own) % (2 * m)].clone();
    let mut row = vec![W::ratio(0, 1); n];
    let (mut to_a, mut to_b) = (W::ratio(0, 1), W::ratio(0, 1));
    for i in 0..m {
        let image = at(2 * m - 1 - i);
        let (toward_a, toward_b) = match m {
            1 => (W::ratio(1, 2), W::ratio(1, 2)),
            _ => (W::ratio(i as i64, m as i64 - 1), W::ratio((m - 1 - i) as i64, m as i64 - 1)),
        };
        let twice = W::ratio(2, 1) * image.clone();
        row[place(i)] = at(i) - image;
        to_a = to_a + twice.clone() * toward_a;
        to_b = to_b + twice * toward_b;
    }
    row[a] = to_a;
    row[(a + 1) % n] = to_b;
    row
}

/// Two boundary edges that meet at place `kappa`; n ≥ 4.
fn corner_row<W: Weight>(n: usize, kappa: usize, weights: &[W]) -> Vec<W> {
    let place = |offset: usize| (kappa + offset) % n;
    let (after, before) = (place(1), place(n - 1));
    let of_kappa = weights[kappa].clone();
    let mut row = weights.to_vec();
    let twice = |w: &W| W::ratio(2, 1) * w.clone();
    row[kappa] = W::ratio(4, 1) * of_kappa.clone();
    for beta in [after, before] {
        row[beta] = twice(&weights[beta]) - twice(&of_kappa);
    }
    let share = W::ratio(1, n as i64 - 3) * of_kappa;
    for other in (2..n - 1).map(place) {
        row[other] = row[other].clone() + share.clone();
    }
    for (beta, inward) in [(after, place(2)), (before, place(n - 2))] {
        row[inward] = row[inward].clone() - weights[beta].clone();
    }
    row
}
