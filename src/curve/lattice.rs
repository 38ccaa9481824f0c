//! A polygon continued beyond its ends.

use super::coordinate::Coordinate;
use super::ends::{Ends, Extent};
use super::rules::Rules;
use crate::base::{Result, memory};

/// Old points by index, 0 the first that is no anchor, as far as rules reach.
pub(crate) struct Lattice<'a, T> {
    /// The points without anchors.
    pub points: &'a [T],
    pub width: usize,
    /// The number of points without anchors.
    pub n: i64,
    is_closed: bool,
    /// Points −1, −2, … of an open polygon.
    before: Vec<T>,
    /// Points n, n+1, … .
    behind: Vec<T>,
}

impl<'a, T: Coordinate> Lattice<'a, T> {
    /// Continues `polygon` as far as the rules need for the points of `extent`.
    pub fn new<W>(
        polygon: &'a [T],
        width: usize,
        ends: Ends,
        rules: &Rules<W>,
        extent: &Extent,
    ) -> Result<Self> {
        let anchors = if ends == Ends::Anchored { width } else { 0 };
        let points = &polygon[anchors..polygon.len() - anchors];
        let n = (points.len() / width) as i64;
        let (m, last) = (rules.arity(), extent.first + extent.made as i64 - 1);
        let low = rules.reaches().map(|(low, _)| low).min().unwrap_or(0);
        let high = rules.reaches().map(|(_, high)| high).max().unwrap_or(0);
        let left = (-(extent.first.div_euclid(m) + low)).max(0) as usize;
        let right = (last.div_euclid(m) + high - (n - 1)).max(0) as usize;
        let mirrored = matches!(ends, Ends::Kept | Ends::Anchored);
        let images = if mirrored { left.max(right) } else { 0 };
        let room = images.saturating_mul(width);
        let (before, behind) = (memory::reserved(room)?, memory::reserved(room)?);
        let mut it = Self { points, width, n, is_closed: ends == Ends::Closed, before, behind };
        let first = &polygon[..width];
        let end = &polygon[polygon.len() - width..];
        match ends {
            Ends::Closed | Ends::Dropped => {}
            Ends::Kept => it.mirror(images, first, end, 1),
            Ends::Anchored => it.mirror(images, first, end, 0),
        }
        Ok(it)
    }

    /// Adds `count` images on either side in turn, since an image may be that of an image.
    /// `skip` is 1 where the ends are points of the lattice, which have no image.
    fn mirror(&mut self, count: usize, first: &[T], end: &[T], skip: i64) {
        for k in 0..count as i64 {
            for (c, centre) in first.iter().enumerate() {
                let image = T::mirrored(centre, &self.point(k + skip)[c]);
                self.before.push(image);
            }
            for (c, centre) in end.iter().enumerate() {
                let image = T::mirrored(centre, &self.point(self.n - 1 - k - skip)[c]);
                self.behind.push(image);
            }
        }
    }

    /// The weighted sum of points: each term a weight and the index of a point, the first
    /// term apart.
    pub fn combine<'w>(
        &self,
        (w, j): (&T, i64),
        others: impl Iterator<Item = (&'w T, i64)>,
        out: &mut [T],
    ) {
        for (value, x) in out.iter_mut().zip(self.point(j)) {
            *value = T::product(w, x);
        }
        for (w, j) in others {
            out.iter_mut().zip(self.point(j)).for_each(|(value, x)| value.add_product(w, x));
        }
    }

    /// Point `j`.
    pub fn point(&self, j: i64) -> &[T] {
        let j = if self.is_closed { j.rem_euclid(self.n) } else { j };
        let (list, index) = if j < 0 {
            (&self.before[..], -1 - j)
        } else if j < self.n {
            (self.points, j)
        } else {
            (&self.behind[..], j - self.n)
        };
        &list[index as usize * self.width..][..self.width]
    }
}
