//! Regular triangles of Loop's scheme: the quartic box spline with its twelve points.
//!
//! In barycentric coordinates a, b, c the polynomials are of three kinds, each symmetric: of a
//! corner, of the vertex across an edge, and of the two others beside a corner (Stam 1998,
//! "Evaluation of Loop subdivision surfaces"). They are short since a + b + c = 1.

use super::lanes::{Block, ZERO, plus};
use crate::base::NONE;
use crate::base::simd::{InnerLoop, Number};
use crate::mesh::{INFINITE, Mesh};
use crate::scheme::Scheme;

/// A regular triangle with its twelve points at (u, v).
pub(super) struct Triangle<'a, const R: usize> {
    pub(super) at: [f64; 2],
    pub(super) points: &'a [Block],
    /// Of the position and derivatives.
    pub(super) sums: &'a mut [Block],
    /// Of a record.
    pub(super) blocks: usize,
}

impl<const R: usize> InnerLoop for Triangle<'_, R> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let mut weights = [[0.0; 12]; R];
        taps::<f64, R>(self.at[0], self.at[1], |record, i, weight| weights[record][i] = weight);
        for block in 0..self.blocks {
            let mut sums = [ZERO; R];
            for (i, point) in self.points.chunks_exact(self.blocks).take(12).enumerate() {
                for record in 0..R {
                    sums[record] = plus(sums[record], weights[record][i], &point[block]);
                }
            }
            for record in 0..R {
                self.sums[record * self.blocks + block] = sums[record];
            }
        }
    }
}

/// A polynomial in the coordinates a, b, c of a corner and the two after it, its derivatives by
/// them as if they were independent, and those by aa, ab, ac, bb, bc, cc.
type Polynomial<N> = [N; 10];

/// Where it has its second derivative by two coordinates.
const SECOND: [[usize; 3]; 3] = [[4, 5, 6], [5, 7, 8], [6, 8, 9]];

/// Twelve times the weights of a corner, the vertex across the edge opposite to it, and the two
/// beside it on the sides of b and c. What is not asked for the compiler leaves out.
///
/// With a + b + c = 1, q = bc and p = b + c they are 1 + 4a + 6a² − 4a³ − a⁴ +
/// 2q(1 + 4a + a² + q), p³(1 + a) + 2q(p² + q), a³(a + 2b) and a³(a + 2c).
#[inline(always)]
fn polynomials<N: Number>(a: N, b: N, c: N) -> [Polynomial<N>; 4] {
    let zero = N::all(0.0);
    let (aa, q, p) = (a * a, b * c, b + c);
    let (aaa, pp) = (aa * a, p * p);
    let even = a * 4.0 + 1.0 + aa;
    let by_q = even * 2.0 + q * 4.0;
    let by_a = (a + 2.0) * 4.0;
    let corner = [
        even + aa * 5.0 - aaa * (a + 4.0) + q * 2.0 * (even + q),
        (a - aa) * 12.0 + 4.0 - aaa * 4.0 + q * by_a,
        by_q * c,
        by_q * b,
        (a * 2.0 + aa + -1.0) * -12.0 + q * 4.0,
        c * by_a,
        b * by_a,
        c * c * 4.0,
        by_q + q * 4.0,
        b * b * 4.0,
    ];
    let (ppp, by_q) = (pp * p, pp * 2.0 + q * 4.0);
    let by_p = pp * 3.0 * (a + 1.0) + q * 4.0 * p;
    let by_pp = p * 6.0 * (a + 1.0) + q * 4.0;
    let across = [
        ppp * (a + 1.0) + q * 2.0 * (pp + q),
        ppp,
        by_p + by_q * c,
        by_p + by_q * b,
        zero,
        pp * 3.0,
        pp * 3.0,
        by_pp + c * 4.0 * (p * 2.0 + c),
        by_pp + pp * 6.0 + q * 8.0,
        by_pp + b * 4.0 * (p * 2.0 + b),
    ];
    let (by_side, by_both) = (aaa * 2.0, aa * 6.0);
    let [(first, by_first, by_firsts), (last, by_last, by_lasts)] =
        [beside(a, aa, aaa, b), beside(a, aa, aaa, c)];
    [
        corner,
        across,
        [first, by_first, by_side, zero, by_firsts, by_both, zero, zero, zero, zero],
        [last, by_last, zero, by_side, by_lasts, zero, by_both, zero, zero, zero],
    ]
}

/// a³(a + 2b) and its derivatives by a and aa.
#[inline(always)]
fn beside<N: Number>(a: N, aa: N, aaa: N, b: N) -> (N, N, N) {
    (aaa * (a + b * 2.0), aa * (a * 4.0 + b * 6.0), a * 12.0 * (a + b))
}

/// Hands over weights of the twelve points, in the order of [`points`], for `R` records, by record
/// and point: the position and derivatives by u and v, at barycentric coordinates
/// (1 − u − v, u, v).
#[inline(always)]
pub(super) fn taps<N: Number, const R: usize>(u: N, v: N, mut take: impl FnMut(usize, usize, N)) {
    let coordinates = [N::all(1.0) - u - v, u, v];
    for k in 0..3 {
        let [a, b, c] = [coordinates[k], coordinates[(k + 1) % 3], coordinates[(k + 2) % 3]];
        let of = polynomials(a, b, c);
        // What is across the edge opposite to a corner follows the corner after it.
        let points = [k, 3 + (k + 1) % 3, 6 + k, 9 + k];
        // The three coordinates as the corner counts them.
        let [o, x, y] = [(3 - k) % 3, (4 - k) % 3, (5 - k) % 3];
        for kind in 0..4 {
            let (of, point) = (&of[kind], points[kind]);
            take(0, point, of[0] * (1.0 / 12.0));
            if R >= 3 {
                take(1, point, (of[1 + x] - of[1 + o]) * (1.0 / 12.0));
                take(2, point, (of[1 + y] - of[1 + o]) * (1.0 / 12.0));
            }
            if R >= 6 {
                let (first, by_x, by_y) = (of[SECOND[o][o]], of[SECOND[o][x]], of[SECOND[o][y]]);
                let [xx, xy, yy] = [of[SECOND[x][x]], of[SECOND[x][y]], of[SECOND[y][y]]];
                take(3, point, (xx - by_x * 2.0 + first) * (1.0 / 12.0));
                take(4, point, (xy - by_x - by_y + first) * (1.0 / 12.0));
                take(5, point, (yy - by_y * 2.0 + first) * (1.0 / 12.0));
            }
        }
    }
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
