//! Regular triangles of Loop's scheme: the quartic box spline with its twelve points.
//!
//! In barycentric coordinates a, b, c the polynomials are of three kinds, each symmetric: of a
//! corner, of the vertex across an edge, and of the two others beside a corner (Stam 1998,
//! "Evaluation of Loop subdivision surfaces"). They are short since a + b + c = 1.

use super::lanes::{Block, ZERO, plus};
use crate::base::NONE;
use crate::base::simd::InnerLoop;
use crate::mesh::{INFINITE, Mesh};
use crate::scheme::Scheme;

/// A value at each of the three corners, and its derivatives: `R` records of them, in the order
/// of [`super::evaluation::PARTIALS`]. The fourth is there for the sake of the processor.
#[derive(Clone, Copy)]
struct Jet<const R: usize>([[f64; 4]; R]);

impl<const R: usize> Jet<R> {
    /// Numbers that are the same everywhere.
    #[inline(always)]
    fn constant(x: f64) -> Self {
        let mut jet = Self([[0.0; 4]; R]);
        jet.0[0] = [x; 4];
        jet
    }

    /// The barycentric coordinates of the corners 0, 1, 2.
    #[inline(always)]
    fn coordinates(u: f64, v: f64) -> Self {
        let mut jet = Self([[0.0; 4]; R]);
        jet.0[0] = [1.0 - u - v, u, v, 0.0];
        if R >= 3 {
            jet.0[1] = [-1.0, 1.0, 0.0, 0.0];
            jet.0[2] = [-1.0, 0.0, 1.0, 0.0];
        }
        jet
    }

    /// What the next corner has.
    #[inline(always)]
    fn next(self) -> Self {
        let mut next = self;
        for [a, b, c, _] in &mut next.0 {
            (*a, *b, *c) = (*b, *c, *a);
        }
        next
    }

    #[inline(always)]
    fn plus(self, other: Self) -> Self {
        let mut sum = self;
        for (record, other) in sum.0.iter_mut().zip(other.0) {
            for k in 0..4 {
                record[k] += other[k];
            }
        }
        sum
    }

    #[inline(always)]
    fn scaled(self, factor: f64) -> Self {
        let mut scaled = self;
        for record in &mut scaled.0 {
            for k in 0..4 {
                record[k] *= factor;
            }
        }
        scaled
    }

    /// By Leibniz's rule.
    #[inline(always)]
    fn times(self, other: Self) -> Self {
        let (a, b) = (&self.0, &other.0);
        let mut product = Self([[0.0; 4]; R]);
        for k in 0..4 {
            product.0[0][k] = a[0][k] * b[0][k];
            for by in 1..R.min(3) {
                product.0[by][k] = a[by][k] * b[0][k] + a[0][k] * b[by][k];
            }
            for by in 3..R {
                let [one, other] = [[1, 1], [1, 2], [2, 2]][by - 3];
                product.0[by][k] = a[by][k] * b[0][k]
                    + a[one][k] * b[other][k]
                    + a[other][k] * b[one][k]
                    + a[0][k] * b[by][k];
            }
        }
        product
    }
}

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
        let weights = taps::<R>(self.at[0], self.at[1]);
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

/// The same for points of one block.
#[inline(always)]
pub(super) fn triangle<const R: usize>(at: [f64; 2], points: &[Block; 12]) -> [Block; R] {
    let weights = taps::<R>(at[0], at[1]);
    let mut sums = [ZERO; R];
    for i in 0..12 {
        for record in 0..R {
            sums[record] = plus(sums[record], weights[record][i], &points[i]);
        }
    }
    sums
}

/// A polynomial in the coordinates a, b, c of a corner and the two after it, and its derivatives
/// by them as if they were independent.
type Polynomial = [f64; 4];

/// Twelve times the weights of a corner, the vertex across the edge opposite to it, and the two
/// beside it on the sides of b and c. What is not asked for the compiler leaves out.
#[inline(always)]
fn polynomials(a: f64, b: f64, c: f64) -> [Polynomial; 4] {
    let (aa, q, p) = (a * a, b * c, b + c);
    let (aaa, pp) = (aa * a, p * p);
    let even = 1.0 + 4.0 * a + aa;
    let by_both = 2.0 * even + 4.0 * q;
    let corner = [
        even + 5.0 * aa - aaa * (a + 4.0) + 2.0 * q * (even + q),
        4.0 + 12.0 * (a - aa) - 4.0 * aaa + 4.0 * q * (2.0 + a),
        by_both * c,
        by_both * b,
    ];
    let (ppp, by_q) = (pp * p, 2.0 * pp + 4.0 * q);
    let by_p = 3.0 * pp * (1.0 + a) + 4.0 * q * p;
    let across = [ppp * (1.0 + a) + 2.0 * q * (pp + q), ppp, by_p + by_q * c, by_p + by_q * b];
    [
        corner,
        across,
        [aaa * (a + 2.0 * b), aa * (4.0 * a + 6.0 * b), 2.0 * aaa, 0.0],
        [aaa * (a + 2.0 * c), aa * (4.0 * a + 6.0 * c), 0.0, 2.0 * aaa],
    ]
}

/// Weights of the twelve points for the position and first derivatives, in their order.
#[inline(always)]
fn first_taps<const R: usize>(u: f64, v: f64) -> [[f64; 12]; R] {
    let coordinates = [1.0 - u - v, u, v];
    let mut taps = [[0.0; 12]; R];
    for k in 0..3 {
        let [a, b, c] = [coordinates[k], coordinates[(k + 1) % 3], coordinates[(k + 2) % 3]];
        let of = polynomials(a, b, c);
        // The vertex across the edge after the corner after this one.
        let places = [k, 3 + (k + 1) % 3, 6 + k, 9 + k];
        for i in 0..4 {
            taps[0][places[i]] = of[i][0] * (1.0 / 12.0);
            if R >= 3 {
                // Those by the three coordinates in their own order.
                let one = of[i][1 + (3 - k) % 3];
                let two = of[i][1 + (4 - k) % 3];
                let three = of[i][1 + (5 - k) % 3];
                taps[1][places[i]] = (two - one) * (1.0 / 12.0);
                taps[2][places[i]] = (three - one) * (1.0 / 12.0);
            }
        }
    }
    taps
}

/// Weights of the twelve points, in the order of [`points`], for the position and derivatives by
/// u and v, at barycentric coordinates (1 − u − v, u, v).
///
/// For a corner with coordinate a, the others being b and c: 12 times its weight is
/// 1 + 4a + 6a² − 4a³ − a⁴ + 2bc(1 + 4a + a² + bc); of the vertex across the edge between the
/// coordinates b and c it is p³(1 + a) + 2bc(p² + bc) with p = b + c; and beside a corner, on the
/// side of b, a³(a + 2b).
#[inline(always)]
fn taps<const R: usize>(u: f64, v: f64) -> [[f64; 12]; R] {
    let mut taps = first_taps::<R>(u, v);
    if R <= 3 {
        return taps;
    }
    let one = Jet::<R>::constant(1.0);
    let a = Jet::coordinates(u, v);
    let (b, c) = (a.next(), a.next().next());
    let (square, both, sum) = (a.times(a), b.times(c), b.plus(c));
    let cube = a.times(square);
    let even = one.plus(a.scaled(4.0)).plus(square);
    let corner = even
        .plus(square.scaled(5.0))
        .plus(cube.times(a.plus(one.scaled(4.0))).scaled(-1.0))
        .plus(both.times(even.plus(both)).scaled(2.0));
    let opposite = sum.times(sum);
    let across =
        opposite.times(sum.times(one.plus(a))).plus(both.times(opposite.plus(both)).scaled(2.0));
    // Across the edge after each corner, which the corner before it is opposite to.
    let across = across.next().next();
    let beside = [cube.times(a.plus(b.scaled(2.0))), cube.times(a.plus(c.scaled(2.0)))];
    for record in 3..R {
        for k in 0..3 {
            taps[record][k] = corner.0[record][k] * (1.0 / 12.0);
            taps[record][3 + k] = across.0[record][k] * (1.0 / 12.0);
            taps[record][6 + k] = beside[0].0[record][k] * (1.0 / 12.0);
            taps[record][9 + k] = beside[1].0[record][k] * (1.0 / 12.0);
        }
    }
    taps
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
