//! The values of several dual steps at once, tile by tile.

use super::kernel::{QuadWeights, Value, narrow};
use super::tile_centres::TileCentres;
use super::tile_kernel::TileKernel;
use crate::base::{Context, Result, Scalar, memory};
use crate::refine::Tiles;
use crate::scheme::Scheme;

/// Some dual steps of a scheme without passes on one mesh, ready to be applied to values.
pub(super) struct TileStep<'a> {
    tiles: &'a Tiles<'a>,
    scheme: &'a Scheme,
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
    ) -> Result<()> {
        let tiles = self.tiles;
        let centres = TileCentres::new(context, tiles, self.scheme, values)?;
        let isolated = &tiles.parent().special;
        let (children, last) = out.split_at_mut(out.len() - isolated.len());
        for (slot, &vertex) in last.iter_mut().zip(isolated) {
            *slot = values[vertex as usize];
        }
        let (own, quads) = children.split_at_mut(centres.last().len());
        for (slot, &value) in own.iter_mut().zip(centres.last()) {
            *slot = narrow::<T, W>(value);
        }
        let kernel = || TileKernel::new(tiles, QuadWeights::new(self.scheme), values, &centres);
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
            let mut kernel = kernel()?;
            range.fold(part, |part, tile| kernel.tile(tile, part));
            Ok(())
        })?;
        done.into_iter().collect()
    }
}
