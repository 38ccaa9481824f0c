//! Records of any width as blocks of four numbers, and weighted sums of points made of them.

use super::evaluation::PARTIALS;
use crate::base::simd::InnerLoop;

/// Numbers of a block.
pub(super) const LANES: usize = 4;

/// Some numbers of a record; beyond its end there are zeros.
pub(super) type Block = [f64; LANES];

pub(super) const ZERO: Block = [0.0; LANES];

/// Blocks of a record.
pub(super) fn blocks(width: usize) -> usize {
    width.div_ceil(LANES)
}

/// A sum with a multiple of a block added.
#[inline(always)]
pub(super) fn plus(sum: Block, weight: f64, block: &Block) -> Block {
    [
        sum[0] + weight * block[0],
        sum[1] + weight * block[1],
        sum[2] + weight * block[2],
        sum[3] + weight * block[3],
    ]
}

/// A tensor product over a grid of points, row by row.
pub(super) struct Tensor<'a> {
    /// Weights along each axis for the position and derivatives.
    pub(super) taps: [[&'a [f64]; 3]; 2],
    pub(super) points: &'a [Block],
    /// Of the position and derivatives, one record after the other: 1, 3 or 6.
    pub(super) sums: &'a mut [Block],
    /// Of a record.
    pub(super) blocks: usize,
}

impl InnerLoop for Tensor<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        // Loops of a known length are unrolled, and their weights kept in registers.
        match self.taps[0][0].len() {
            3 => self.by_blocks::<3>(),
            4 => self.by_blocks::<4>(),
            5 => self.by_blocks::<5>(),
            _ => self.by_blocks::<0>(),
        }
    }
}

impl Tensor<'_> {
    /// Rows of `N` points, or of any number for 0.
    #[inline(always)]
    fn by_blocks<const N: usize>(self) {
        match (self.sums.len() / self.blocks, self.blocks) {
            (1, 1) => self.records::<1, 1, N>(1),
            (3, 1) => self.records::<3, 2, N>(1),
            (1, blocks) => self.records::<1, 1, N>(blocks),
            (3, blocks) => self.records::<3, 2, N>(blocks),
            (_, blocks) => self.records::<6, 3, N>(blocks),
        }
    }

    /// So many records, of derivatives of fewer than `ORDERS`.
    #[inline(always)]
    fn records<const R: usize, const ORDERS: usize, const N: usize>(self, blocks: usize) {
        let [along, across] = self.taps;
        let n = if N == 0 { along[0].len() } else { N };
        let mut kept = [[0.0; N]; ORDERS];
        for order in 0..ORDERS {
            kept[order].copy_from_slice(&along[order][..N]);
        }
        for block in 0..blocks {
            let mut sums = [ZERO; R];
            for (y, row) in self.points.chunks_exact(n * blocks).enumerate() {
                let mut rows = [ZERO; ORDERS];
                for x in 0..n {
                    let point = &row[x * blocks + block];
                    for order in 0..ORDERS {
                        let weight = if N == 0 { along[order][x] } else { kept[order][x] };
                        rows[order] = plus(rows[order], weight, point);
                    }
                }
                for record in 0..R {
                    let [by_x, by_y] = PARTIALS[record];
                    sums[record] = plus(sums[record], across[by_y][y], &rows[by_x]);
                }
            }
            for record in 0..R {
                self.sums[record * blocks + block] = sums[record];
            }
        }
    }
}
