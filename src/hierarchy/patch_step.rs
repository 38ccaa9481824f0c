//! The values of several primal steps at once, patch by patch.

use super::kernel::Value;
use super::patch_fan_values::FanValues;
use super::patch_kernel::PatchKernel;
use super::step::Scratch;
use crate::base::{Context, NONE, Result, Scalar, memory};
use crate::refine::Patches;
use crate::scheme::SmoothMasks;

/// Some primal steps on one mesh, ready to be applied to values.
pub(super) struct PatchStep<'a> {
    patches: &'a Patches<'a>,
    masks: SmoothMasks<f64>,
}

impl<'a> PatchStep<'a> {
    pub(super) fn new(patches: &'a Patches<'a>, masks: SmoothMasks<f64>) -> Self {
        Self { patches, masks }
    }

    /// The number of vertices of the last level.
    pub(super) fn children(&self) -> usize {
        self.patches.counts.vertices as usize
    }

    /// The values of all vertices of the last level.
    pub(super) fn apply<T: Scalar, const W: usize>(
        &self,
        context: &Context,
        values: &[Value<T, W>],
        out: &mut [Value<T, W>],
        scratch: &mut Scratch<T, W>,
    ) -> Result<()> {
        let (patches, parent) = (self.patches, self.patches.parent());
        let fans = FanValues::new(context, patches, &self.masks, values)?;
        let (old, new) = out.split_at_mut(values.len());
        let ranges = patches.chunks(context);
        memory::resize(&mut scratch.corners, parent.corners())?;
        let (mut rest, mut parts) = (&mut scratch.corners[..], memory::reserved(ranges.len())?);
        for (range, runs) in ranges.iter().zip(patches.cut(new, &ranges)?) {
            let len = range.len() * patches.pieces().sides() as usize;
            let (corners, later) = rest.split_at_mut(len);
            parts.push((range.clone(), corners, runs));
            rest = later;
        }
        let done = context.map(parts, |(range, corners, mut runs)| {
            let mut kernel = PatchKernel::new(patches, &self.masks, values, &fans)?;
            let corners = corners.chunks_exact_mut(patches.pieces().sides() as usize);
            for (patch, corners) in range.zip(corners) {
                kernel.run(patch, corners, &mut runs);
            }
            Ok(())
        })?;
        done.into_iter().collect::<Result<()>>()?;
        // Every patch knows what its corners become; one of them stands for the vertex.
        let corners = &scratch.corners;
        context.fill(old, 1, |first, part| {
            let starts = parent.start[first..].iter().zip(&values[first..]);
            for (slot, (&start, own)) in part.iter_mut().zip(starts) {
                *slot = if start == NONE { *own } else { corners[start as usize] };
            }
        })
    }
}
