//! Refinement of a polygon, any number of steps.

use super::coordinate::Coordinate;
use super::ends::{Ends, Extent, predict};
use super::mask::Mask;
use super::rules::Rules;
use super::step::{Source, step};
use crate::base::{Context, Element, Error, ErrorKind, Result, memory};

/// The points of an open or closed polygon, `width` coordinates each, one after the other.
#[derive(Debug, Clone, PartialEq)]
pub struct Polygon<T> {
    /// All coordinates.
    pub points: Vec<T>,
    /// Coordinates per point, at least 1.
    pub width: usize,
    /// Open or closed, and what a step does at the ends.
    pub ends: Ends,
}

impl<T: Coordinate> Polygon<T> {
    /// A polygon.
    pub fn new(points: Vec<T>, width: usize, ends: Ends) -> Self {
        Self { points, width, ends }
    }

    /// The number of points.
    pub fn len(&self) -> usize {
        self.points.len() / self.width.max(1)
    }

    /// True for a polygon without points.
    pub fn is_empty(&self) -> bool {
        self.points.is_empty()
    }

    /// Point `i`.
    ///
    /// # Panics
    /// If there is none.
    pub fn point(&self, i: usize) -> &[T] {
        &self.points[i * self.width..][..self.width]
    }

    /// The polygon after `steps` steps of a stationary scheme; n steps at once give the same
    /// as one step n times.
    ///
    /// A new point is the sum of its rule's terms by ascending index of the old points, in
    /// the points' own number type. A million points in three dimensions take some
    /// milliseconds; `benches/README.md` has figures. Rationals grow with every step.
    ///
    /// # Errors
    /// [`ErrorKind::LengthMismatch`] for no points, too few of them (see [`Ends`]), or
    /// coordinates that are no multiple of the width; [`ErrorKind::NotFinite`],
    /// [`ErrorKind::Overflow`], naming a point; [`ErrorKind::Unsupported`] for
    /// ends that stay under a mask that is not symmetric; [`ErrorKind::TooLarge`],
    /// [`ErrorKind::MemoryCeiling`], [`ErrorKind::OutOfResources`],
    /// [`ErrorKind::ParameterOutOfRange`] for more than 64 steps, [`ErrorKind::Cancelled`].
    pub fn refine(&self, context: &Context, mask: &Mask, steps: u32) -> Result<Self> {
        let rules = Rules::new(mask);
        self.refine_by_levels(context, steps, |_| Ok(&rules))
    }

    /// The number of points, and the ends, after `steps` steps.
    ///
    /// # Errors
    /// As [`Polygon::refine`], without those of coordinates and memory.
    pub fn predict(mask: &Mask, points: usize, ends: Ends, steps: u32) -> Result<(usize, Ends)> {
        predict(&Rules::<f64>::new(mask), ends, points, steps)
    }

    /// The polygon after `steps` steps, the rules of each level (0 first) given by `rules`;
    /// all have the same arity and reach.
    pub(crate) fn refine_by_levels<R: std::borrow::Borrow<Rules<T>>>(
        &self,
        context: &Context,
        steps: u32,
        rules: impl Fn(u32) -> Result<R>,
    ) -> Result<Self> {
        check_points(&self.points, self.width)?;
        context.report(0.0)?;
        let mut polygon: Option<Self> = None;
        if steps > 0 {
            let (points, _) = predict(rules(0)?.borrow(), self.ends, self.len(), steps)?;
            check_total(context, points, self.width, T::BYTES)?;
        }
        for level in 0..steps {
            let old = polygon.as_ref().unwrap_or(self);
            polygon = Some(old.refined_once(context, rules(level)?.borrow())?);
            context.report(f64::from(level + 1) / f64::from(steps))?;
        }
        polygon.map_or_else(|| self.copied(), Ok)
    }

    fn refined_once(&self, context: &Context, rules: &Rules<T>) -> Result<Self> {
        let extent = Extent::of(rules, self.ends, self.len())?;
        let mut points = T::zeros(extent.points() * self.width)?;
        self.step_into(context, rules, &extent, &mut points)?;
        Ok(Self { points, width: self.width, ends: extent.ends })
    }

    pub(crate) fn source(&self) -> Source<'_, T> {
        Source { points: &self.points, width: self.width, ends: self.ends }
    }

    fn step_into(
        &self,
        context: &Context,
        rules: &Rules<T>,
        extent: &Extent,
        out: &mut [T],
    ) -> Result<()> {
        step(context, rules, &self.source(), extent, out)?;
        check_overflow(&self.points, rules.norm(), out, self.width)
    }

    /// One step into memory of the caller's, which must have the exact size that
    /// [`Polygon::predict`] gives; the ends of the result are returned.
    ///
    /// # Errors
    /// As [`Polygon::refine`]; after [`ErrorKind::Overflow`] the memory holds numbers that
    /// are not finite, after [`ErrorKind::Cancelled`] any.
    pub fn refine_into(&self, context: &Context, mask: &Mask, out: &mut [T]) -> Result<Ends> {
        let rules = Rules::new(mask);
        check_points(&self.points, self.width)?;
        let extent = Extent::of(&rules, self.ends, self.len())?;
        let size = extent.points().saturating_mul(self.width);
        if out.len() != size {
            let message = format!("room for {} coordinates, there are {size}", out.len());
            return Err(Error::new(ErrorKind::LengthMismatch, message));
        }
        self.step_into(context, &rules, &extent, out)?;
        Ok(extent.ends)
    }

    pub(crate) fn copied(&self) -> Result<Self> {
        let mut points = memory::reserved(self.points.len())?;
        points.extend_from_slice(&self.points);
        Ok(Self { points, ..*self })
    }
}

/// Refuses coordinates that are no points, or not finite.
pub(crate) fn check_points<T: Coordinate>(points: &[T], width: usize) -> Result<()> {
    if width == 0 || !points.len().is_multiple_of(width) {
        let message = format!("{} coordinates are no points of {width} each", points.len());
        return Err(Error::new(ErrorKind::LengthMismatch, message));
    }
    if points.is_empty() {
        return Err(Error::new(ErrorKind::LengthMismatch, "a polygon without points"));
    }
    refuse_first(points, width, ErrorKind::NotFinite)
}

/// Names the first point with a coordinate that is not finite.
pub(crate) fn refuse_first<T: Coordinate>(
    points: &[T],
    width: usize,
    kind: ErrorKind,
) -> Result<()> {
    // Most lists are all finite, and that is quickly seen many at a time.
    let all = points.chunks(1024).all(|part| part.iter().fold(true, |all, x| all & x.is_finite()));
    let Some(at) = (!all).then(|| points.iter().position(|x| !x.is_finite())).flatten() else {
        return Ok(());
    };
    let point = (at / width) as u64;
    let what = if kind == ErrorKind::Overflow { "leaves the range" } else { "is not finite" };
    let message = format!("coordinate {} of point {point} {what}", at % width);
    Err(Error::new(kind, message).with_elements([Element::Vertex(point)]))
}

/// Refuses results beyond the range of the number type; looks at them only where the
/// mask's norm leaves it open.
pub(crate) fn check_overflow<T: Coordinate>(
    old: &[T],
    norm: f64,
    new: &[T],
    width: usize,
) -> Result<()> {
    /// An image in an end is at most three times as far away; an image of it 5, and so on.
    const MIRROR: f64 = 1e6;
    if T::largest().is_infinite() {
        return Ok(());
    }
    let largest = old.iter().map(|x| x.to_f64().abs()).fold(0.0, f64::max);
    if largest * norm * MIRROR < T::largest() {
        return Ok(());
    }
    refuse_first(new, width, ErrorKind::Overflow)
}

/// Refuses what does not fit memory, before it is asked for.
pub(crate) fn check_total(
    context: &Context,
    points: usize,
    width: usize,
    bytes: u64,
) -> Result<()> {
    let too_large = || Error::new(ErrorKind::TooLarge, format!("{points} points of {width}"));
    let total = points.checked_mul(width).and_then(|total| (total as u64).checked_mul(bytes));
    let total = total.filter(|&total| isize::try_from(total).is_ok()).ok_or_else(too_large)?;
    // The last level and the one before it, which is at most as large.
    context.check_memory(total.saturating_mul(2))
}
