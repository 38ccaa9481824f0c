//! The values of several dual steps at once, tile by tile.

use super::dual_step::DualStep;
use super::kernel::{QuadWeights, Value, narrow};
use super::regular_rule::RegularRule;
use super::step::Scratch;
use super::tile_centres::TileCentres;
use super::tile_kernel::TileKernel;
use super::tile_rings::TileRings;
use super::tile_smoothing::SmoothTileKernel;
use crate::base::simd::{InnerLoop, with_widest};
use crate::base::{Context, Result, Scalar, memory};
use crate::refine::{Anchor, CornerSplit, Tiles};
use crate::scheme::Scheme;
use std::ops::Range;

/// Some dual steps of a scheme with one pass or none on one mesh, ready to be applied to values.
pub(super) struct TileStep<'a> {
    tiles: &'a Tiles<'a>,
    scheme: &'a Scheme,
}

/// The inner loops of a thread.
pub(super) trait TileLoop<T, const W: usize> {
    /// Writes the vertices of a tile and returns the rest.
    fn tile<'o>(
        &mut self,
        tile: usize,
        out: &'o mut [[Value<T, W>; 4]],
    ) -> &'o mut [[Value<T, W>; 4]];

    /// Writes the vertices of the quads around a sector, from the front of each run.
    fn sector(&mut self, sector: u32, runs: &mut [&mut [[Value<T, W>; 4]]]);
}

/// Tiles that follow each other.
struct TileRun<'o, L, V> {
    kernel: L,
    tiles: Range<usize>,
    out: &'o mut [[V; 4]],
}

impl<T, const W: usize, L: TileLoop<T, W>> InnerLoop for TileRun<'_, L, Value<T, W>> {
    type Output = ();

    #[inline(always)]
    fn run(mut self) {
        let mut out = self.out;
        for tile in self.tiles {
            out = self.kernel.tile(tile, out);
        }
    }
}

impl<'a> TileStep<'a> {
    pub(super) fn new(scheme: &'a Scheme, tiles: &'a Tiles<'a>) -> Self {
        Self { tiles, scheme }
    }

    /// The number of vertices of the last level.
    pub(super) fn children(&self) -> usize {
        self.tiles.counts.vertices as usize
    }

    /// The values of all vertices of the last level.
    pub(super) fn apply<T: Scalar, const W: usize>(
        &self,
        context: &Context,
        values: &[Value<T, W>],
        out: &mut [Value<T, W>],
        scratch: &mut Scratch<T, W>,
    ) -> Result<()> {
        let (tiles, scheme) = (self.tiles, self.scheme);
        let isolated = &tiles.parent().special;
        let (children, last) = out.split_at_mut(out.len() - isolated.len());
        for (slot, &vertex) in last.iter_mut().zip(isolated) {
            *slot = values[vertex as usize];
        }
        let (own, quads) = children.split_at_mut(tiles.sectors() as usize);
        let Some(taps) = scheme.fused_taps() else {
            let centres = TileCentres::new(context, tiles, scheme, values)?;
            for (slot, &value) in own.iter_mut().zip(centres.last()) {
                *slot = narrow::<T, W>(value);
            }
            let kernel = || TileKernel::new(tiles, QuadWeights::new(scheme), values, &centres);
            return self.quads(context, quads, kernel);
        };
        // What one level after the other makes of the first one.
        let split = CornerSplit::new(context, tiles.parent(), Anchor::Keep)?;
        let mut first = std::mem::take(&mut scratch.stage);
        memory::resize(&mut first, split.counts.vertices as usize)?;
        DualStep::new(scheme, &split).apply(context, values, &mut first, scratch)?;
        let rings = TileRings::new(context, tiles, scheme, &first)?;
        for (slot, ring) in own.iter_mut().zip(rings.last()) {
            *slot = narrow::<T, W>(ring[0]);
        }
        let rule = RegularRule::new(taps);
        self.quads(context, quads, || SmoothTileKernel::new(tiles, rule, &first, &rings))?;
        scratch.stage = first;
        Ok(())
    }

    /// The vertices of all quads.
    fn quads<T: Scalar, const W: usize, L: TileLoop<T, W>>(
        &self,
        context: &Context,
        quads: &mut [Value<T, W>],
        kernel: impl Fn() -> Result<L> + Sync + Send,
    ) -> Result<()> {
        let tiles = self.tiles;
        let (around, mut rest) =
            quads.as_chunks_mut::<4>().0.split_at_mut(tiles.quads_around(tiles.depth() - 1));
        let parts = tiles.cut_sectors(context, tiles.depth() - 1, around)?;
        let done = context.map(parts, |(sectors, mut runs)| {
            let mut kernel = kernel()?;
            sectors.for_each(|sector| kernel.sector(sector, &mut runs));
            Ok(())
        })?;
        done.into_iter().collect::<Result<()>>()?;
        let mut parts = memory::reserved(tiles.chunks().len())?;
        for chunk in tiles.chunks() {
            let (part, later) = rest.split_at_mut(chunk.vertices / 4);
            parts.push((chunk.tiles.clone(), part));
            rest = later;
        }
        let done = context.map(parts, |(range, part)| {
            with_widest(TileRun { kernel: kernel()?, tiles: range, out: part });
            Ok(())
        })?;
        done.into_iter().collect()
    }
}
