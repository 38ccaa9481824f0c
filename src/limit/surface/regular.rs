//! A regular patch of three numbers per point by the shortest way: what most samples come to.
//! Bits are those of [`super::evaluation`], which takes any patch of any width.

use super::box_spline::taps;
use super::cell::IDENTITY;
use super::evaluation::PARTIALS;
use super::lanes::{Block, LANES, ZERO};
use super::univariate::{ORDERS, cubic};
use crate::base::Scalar;
use crate::base::simd::Quad;

/// Numbers of a point.
pub(super) const WIDTH: usize = 3;

/// Samples whose weights are made together: for one they are as much work as for as many as the
/// processor takes at once.
pub(super) const GROUP: usize = 16;

/// A number of each.
pub(super) type Lane = [f64; GROUP];

/// Weights of a kind of patch with `N` points at the places of a group.
pub(super) trait Weights<const N: usize, const R: usize> {
    const NONE: Self;
    /// Whether the cells are triangles.
    const IS_TRIANGLE: bool;

    /// Makes those of so many places.
    fn fill<Q: Quad>(&mut self, at: &[Lane; 2], count: usize);

    /// The position and derivatives by cell coordinates, `R` of [`PARTIALS`], of one of them.
    fn sums<Q: Quad>(&self, which: usize, points: &impl Points<N>) -> [Q; R];
}

/// The points of a patch.
pub(super) trait Points<const N: usize> {
    /// One of them.
    fn point<Q: Quad>(&self, which: usize) -> Q;
}

impl<const N: usize> Points<N> for [Block; N] {
    #[inline(always)]
    fn point<Q: Quad>(&self, which: usize) -> Q {
        Q::new(self[which])
    }
}

/// Values of control vertices.
pub(super) struct Gathered<'a, T, const N: usize> {
    pub(super) vertices: &'a [u32; N],
    pub(super) values: &'a [[T; WIDTH]],
}

impl<T: Scalar, const N: usize> Points<N> for Gathered<'_, T, N> {
    #[inline(always)]
    fn point<Q: Quad>(&self, which: usize) -> Q {
        let [x, y, z] = self.values[self.vertices[which] as usize];
        Q::new([x.to_f64(), y.to_f64(), z.to_f64(), 0.0])
    }
}

/// The numbers of four after each other.
#[inline(always)]
fn quad_at<Q: Quad>(lane: &Lane, quad: usize) -> Q {
    Q::new(lane.as_chunks().0[quad])
}

#[inline(always)]
fn set_quad<Q: Quad>(lane: &mut Lane, quad: usize, numbers: Q) {
    lane.as_chunks_mut().0[quad] = numbers.numbers();
}

/// Four by four points of cubic B-splines: weights along both axes.
pub(super) struct Bicubic([[[Lane; 4]; ORDERS]; 2]);

impl<const R: usize> Weights<16, R> for Bicubic {
    const IS_TRIANGLE: bool = false;
    const NONE: Self = Self([[[[0.0; GROUP]; 4]; ORDERS]; 2]);

    #[inline(always)]
    fn fill<Q: Quad>(&mut self, at: &[Lane; 2], count: usize) {
        match R {
            1 => self.fill_orders::<Q, 1>(at, count),
            3 => self.fill_orders::<Q, 2>(at, count),
            _ => self.fill_orders::<Q, 3>(at, count),
        }
    }

    #[inline(always)]
    fn sums<Q: Quad>(&self, which: usize, points: &impl Points<16>) -> [Q; R] {
        match R {
            1 => self.sums_of::<Q, R, 1>(which, points),
            3 => self.sums_of::<Q, R, 2>(which, points),
            _ => self.sums_of::<Q, R, 3>(which, points),
        }
    }
}

impl Bicubic {
    #[inline(always)]
    fn fill_orders<Q: Quad, const N: usize>(&mut self, at: &[Lane; 2], count: usize) {
        for quad in 0..count.div_ceil(4).min(GROUP / 4) {
            for axis in 0..2 {
                let weights = cubic::<Q, N>(quad_at(&at[axis], quad));
                for order in 0..N {
                    for x in 0..4 {
                        set_quad(&mut self.0[axis][order][x], quad, weights[order][x]);
                    }
                }
            }
        }
    }

    /// So many records, of derivatives of fewer than `N`.
    #[inline(always)]
    fn sums_of<Q: Quad, const R: usize, const N: usize>(
        &self,
        which: usize,
        points: &impl Points<16>,
    ) -> [Q; R] {
        let [along, across] = &self.0;
        let which = which % GROUP;
        let zero = Q::all(0.0);
        let mut sums = [zero; R];
        for y in 0..4 {
            let mut rows = [zero; N];
            for x in 0..4 {
                let point: Q = points.point(4 * y + x);
                for order in 0..N {
                    rows[order] = rows[order] + point * along[order][x][which];
                }
            }
            for record in 0..R {
                let [by_x, by_y] = PARTIALS[record];
                sums[record] = sums[record] + rows[by_x] * across[by_y][y][which];
            }
        }
        sums
    }
}

/// Twelve points of the quartic box spline.
pub(super) struct Quartic<const R: usize>([[Lane; 12]; R]);

impl<const R: usize> Weights<12, R> for Quartic<R> {
    const IS_TRIANGLE: bool = true;
    const NONE: Self = Self([[[0.0; GROUP]; 12]; R]);

    #[inline(always)]
    fn fill<Q: Quad>(&mut self, [u, v]: &[Lane; 2], count: usize) {
        for quad in 0..count.div_ceil(4).min(GROUP / 4) {
            taps::<Q, R>(quad_at(u, quad), quad_at(v, quad), |record, point, weights| {
                set_quad(&mut self.0[record][point], quad, weights);
            });
        }
    }

    #[inline(always)]
    fn sums<Q: Quad>(&self, which: usize, points: &impl Points<12>) -> [Q; R] {
        let which = which % GROUP;
        let mut sums = [Q::all(0.0); R];
        for i in 0..12 {
            let point: Q = points.point(i);
            for record in 0..R {
                sums[record] = sums[record] + point * self.0[record][i][which];
            }
        }
        sums
    }
}

/// Writes sums as records; true unless one is infinite or NaN.
#[inline(always)]
pub(super) fn write<T: Scalar, const R: usize>(sums: &[Block; R], out: &mut [T]) -> bool {
    // In all lanes, so that they stay together.
    let mut zeros = ZERO;
    let (records, _) = out.as_chunks_mut::<WIDTH>();
    for (record, out) in sums.iter().zip(records) {
        let mut rounded = [T::from_f64(0.0); LANES];
        for k in 0..LANES {
            rounded[k] = T::from_f64(record[k]);
            // 0, or NaN.
            zeros[k] += 0.0 * rounded[k].to_f64();
        }
        out.copy_from_slice(&rounded[..WIDTH]);
    }
    zeros.iter().all(|zero| zero.is_finite())
}

/// Derivatives by cell coordinates become those by the coordinates asked for, as many as there
/// are records. `j` are derivatives of the former by the latter.
#[inline(always)]
pub(super) fn changed<Q: Quad, const R: usize>(j: &[[f64; 2]; 2], mut sums: [Q; R]) -> [Q; R] {
    if R < 3 || *j == IDENTITY.linear {
        return sums;
    }
    let (s, t) = (sums[1], sums[2]);
    sums[1] = s * j[0][0] + t * j[1][0];
    sums[2] = s * j[0][1] + t * j[1][1];
    if R >= 6 {
        let (ss, st, tt) = (sums[3], sums[4], sums[5]);
        for (record, a, b) in [(3, 0, 0), (4, 0, 1), (5, 1, 1)] {
            let mixed = j[0][a] * j[1][b] + j[1][a] * j[0][b];
            sums[record] = ss * j[0][a] * j[0][b] + st * mixed + tt * j[1][a] * j[1][b];
        }
    }
    sums
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::simd::{Plain, QuadLoop, with_quads};

    /// Numbers in [0, 1) that follow no pattern.
    fn noise(state: &mut u64) -> f64 {
        *state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        (*state >> 11) as f64 / (1_u64 << 53) as f64
    }

    struct Work<'a, W, const N: usize>(W, &'a [Lane; 2], &'a [Block; N]);

    impl<W: Weights<N, 6>, const N: usize> QuadLoop for Work<'_, W, N> {
        type Output = [[Block; 6]; GROUP];

        #[inline(always)]
        fn run<Q: Quad>(mut self) -> Self::Output {
            self.0.fill::<Q>(self.1, GROUP);
            let sums = |which| self.0.sums::<Q>(which, self.2);
            let turned = |sums| changed(&[[0.0, -2.0], [2.0, 0.5]], sums).map(Q::numbers);
            std::array::from_fn(|which| turned(sums(which)))
        }
    }

    fn check<W: Weights<N, 6>, const N: usize>() {
        let mut state = N as u64;
        let mut at = [[0.0; GROUP]; 2];
        at.as_flattened_mut().iter_mut().for_each(|x| *x = 0.5 * noise(&mut state));
        let mut points = [ZERO; N];
        points.as_flattened_mut().iter_mut().for_each(|x| *x = noise(&mut state) - 0.5);
        let plain = Work(W::NONE, &at, &points).run::<Plain>();
        let bits =
            |sums: [[Block; 6]; GROUP]| sums.map(|sums| sums.map(|sum| sum.map(f64::to_bits)));
        assert!(plain.as_flattened().iter().all(|sum| sum.iter().all(|&x| x != 0.0)));
        assert_eq!(bits(plain), bits(with_quads(Work(W::NONE, &at, &points))));
    }

    #[test]
    fn the_widest_registers_give_the_same_bits() {
        check::<Bicubic, 16>();
        check::<Quartic<6>, 12>();
    }
}
