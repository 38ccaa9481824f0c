//! A regular patch of three numbers per point by the shortest way: what most samples come to.
//! Bits are those of [`super::evaluation`], which takes any patch of any width.

use super::box_spline::triangle;
use super::cell::IDENTITY;
use super::evaluation::PARTIALS;
use super::lanes::{Block, ZERO, plus};
use super::univariate::cubic;
use crate::base::Scalar;
use crate::base::simd::InnerLoop;

/// Numbers of a point.
pub(super) const WIDTH: usize = 3;

/// The points of a patch.
pub(super) trait Shape {
    /// The position and derivatives by cell coordinates, `R` of [`PARTIALS`].
    fn sums<const R: usize>(&self, at: [f64; 2]) -> [Block; R];
}

/// Four by four points of cubic B-splines.
impl Shape for [Block; 16] {
    #[inline(always)]
    fn sums<const R: usize>(&self, at: [f64; 2]) -> [Block; R] {
        match R {
            1 => bicubic::<R, 1>(at, self),
            3 => bicubic::<R, 2>(at, self),
            _ => bicubic::<R, 3>(at, self),
        }
    }
}

/// Twelve points of the quartic box spline.
impl Shape for [Block; 12] {
    #[inline(always)]
    fn sums<const R: usize>(&self, at: [f64; 2]) -> [Block; R] {
        triangle(at, self)
    }
}

/// So many records, of derivatives of fewer than `ORDERS`.
#[inline(always)]
fn bicubic<const R: usize, const ORDERS: usize>(at: [f64; 2], points: &[Block; 16]) -> [Block; R] {
    let along = cubic::<ORDERS>(at[0]);
    let across = cubic::<ORDERS>(at[1]);
    let mut sums = [ZERO; R];
    for y in 0..4 {
        let mut rows = [ZERO; ORDERS];
        for x in 0..4 {
            for order in 0..ORDERS {
                rows[order] = plus(rows[order], along[order][x], &points[4 * y + x]);
            }
        }
        for record in 0..R {
            let [by_x, by_y] = PARTIALS[record];
            sums[record] = plus(sums[record], across[by_y][y], &rows[by_x]);
        }
    }
    sums
}

/// Control points, some of which are those of a patch.
#[derive(Clone, Copy)]
pub(super) struct Control<'a, T, const N: usize> {
    pub(super) vertices: &'a [u32; N],
    pub(super) values: &'a [[T; WIDTH]],
}

/// Points less an origin.
#[derive(Clone, Copy)]
pub(super) struct Remembered<'a, const N: usize> {
    pub(super) points: &'a [Block; N],
    pub(super) origin: Block,
}

/// Where the points of a patch are.
pub(super) trait Points {
    /// The sums, with the origin added to the position.
    fn sums<const R: usize>(&self, at: [f64; 2]) -> [Block; R];
}

impl<T: Scalar, const N: usize> Points for Control<'_, T, N>
where
    [Block; N]: Shape,
{
    #[inline(always)]
    fn sums<const R: usize>(&self, at: [f64; 2]) -> [Block; R] {
        let mut points = [ZERO; N];
        for i in 0..N {
            let [x, y, z] = self.values[self.vertices[i] as usize];
            points[i] = [x.to_f64(), y.to_f64(), z.to_f64(), 0.0];
        }
        points.sums(at)
    }
}

impl<const N: usize> Points for Remembered<'_, N>
where
    [Block; N]: Shape,
{
    #[inline(always)]
    fn sums<const R: usize>(&self, at: [f64; 2]) -> [Block; R] {
        let mut sums = self.points.sums::<R>(at);
        sums[0] = plus(sums[0], 1.0, &self.origin);
        sums
    }
}

/// A patch at a point.
pub(super) struct Patch<'a, P, const R: usize> {
    pub(super) points: P,
    // What was stored in parts a moment ago is slow to read as a whole: both stay where they are.
    pub(super) at: &'a [f64; 2],
    /// Derivatives of cell coordinates by those asked for.
    pub(super) jacobian: &'a [[f64; 2]; 2],
    // With all lanes written the compiler keeps them together in one register.
    pub(super) sums: &'a mut [Block; R],
}

impl<P: Points, const R: usize> InnerLoop for Patch<'_, P, R> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let mut sums = self.points.sums::<R>(*self.at);
        if R > 1 && *self.jacobian != IDENTITY.linear {
            change(*self.jacobian, &mut sums);
        }
        *self.sums = sums;
    }
}

/// Writes sums as records; true unless one is infinite or NaN.
#[inline(always)]
pub(super) fn write<T: Scalar, const R: usize>(sums: &[Block; R], out: &mut [T]) -> bool {
    let mut zeros = [0.0; WIDTH];
    let (records, _) = out.as_chunks_mut::<WIDTH>();
    for (record, out) in sums.iter().zip(records) {
        for k in 0..WIDTH {
            out[k] = T::from_f64(record[k]);
            // 0, or NaN.
            zeros[k] += 0.0 * out[k].to_f64();
        }
    }
    zeros.iter().all(|zero| zero.is_finite())
}

/// Derivatives by cell coordinates become those by the coordinates asked for, as many as there
/// are records.
#[inline(always)]
pub(super) fn change<const R: usize>(j: [[f64; 2]; 2], sums: &mut [Block; R]) {
    if R >= 3 {
        let (s, t) = (sums[1], sums[2]);
        for k in 0..ZERO.len() {
            sums[1][k] = s[k] * j[0][0] + t[k] * j[1][0];
            sums[2][k] = s[k] * j[0][1] + t[k] * j[1][1];
        }
    }
    if R >= 6 {
        for k in 0..ZERO.len() {
            let (ss, st, tt) = (sums[3][k], sums[4][k], sums[5][k]);
            for (record, a, b) in [(3, 0, 0), (4, 0, 1), (5, 1, 1)] {
                sums[record][k] = ss * j[0][a] * j[0][b]
                    + st * (j[0][a] * j[1][b] + j[1][a] * j[0][b])
                    + tt * j[1][a] * j[1][b];
            }
        }
    }
}
