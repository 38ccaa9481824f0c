//! Faces that are no quads, level by level: their vertices follow from their own of the
//! level before and from nothing else.

use super::kernel::{Value, widen};
use crate::base::{Context, Fraction, Result, Scalar, memory};
use crate::refine::Tiles;
use crate::scheme::{CornerWeights, Scheme};

/// The vertices of the faces that are no quads.
pub(super) struct TileCentres<T: Scalar> {
    /// By level, from the first on, and by corner.
    levels: Vec<Vec<T::Lanes>>,
}

impl<T: Scalar> TileCentres<T> {
    /// Follows the faces through all levels of the tiles.
    pub(super) fn new<const W: usize>(
        context: &Context,
        tiles: &Tiles,
        scheme: &Scheme,
        values: &[Value<T, W>],
    ) -> Result<Self> {
        let mesh = tiles.parent();
        let count = tiles.sectors() as usize;
        let own = mesh.vert[..count].iter().map(|&v| widen::<T, W>(&values[v as usize]));
        let mut levels = memory::collect([memory::collect(own)?])?;
        for level in 0..tiles.depth() as usize {
            let mut next = memory::filled(T::lanes([T::default(); 4]), count)?;
            let before = &levels[level];
            context.fill(&mut next, 1, |first, part| {
                let mut weights = CornerWeights::<f64>::new(scheme.rule(), Fraction::HALF);
                for (corner, slot) in (first as u32..).zip(part) {
                    let face = mesh.layout.face(mesh.layout.face_of(corner));
                    let weights = weights.of(face.len()).iter();
                    // From the own corner on around the face, as rows are sent.
                    let around = (corner..face.end).chain(face.start..corner);
                    let zero = T::lanes([T::default(); 4]);
                    let add = |sum, (c, &w): (u32, &f64)| sum + before[c as usize] * T::from_f64(w);
                    *slot = around.zip(weights).fold(zero, add);
                }
            })?;
            memory::extend(&mut levels, [next])?;
        }
        Ok(Self { levels })
    }

    /// The vertex of a corner after some splits.
    #[inline]
    pub(super) fn at(&self, level: u32, corner: u32) -> T::Lanes {
        self.levels[level as usize][corner as usize]
    }

    /// All of the last level.
    pub(super) fn last(&self) -> &[T::Lanes] {
        self.levels.last().map_or(&[], Vec::as_slice)
    }
}
