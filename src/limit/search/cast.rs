//! Where a ray first meets the surface: nearest first, down to parts that it meets once at most.
//!
//! In coordinates x and y across the ray a meeting is a root of two functions. Let J be their
//! derivatives at one point of a cell and J′ at another. Where hulls of coefficients show that
//! J⁻¹J′ is near the unit matrix for all of them, there is one root at most, and Newton's method,
//! moved back into the cell after every step, comes to it if there is one.

use super::cell::{corners, middle, within};
use super::jet::{Hodograph, Jet};
use super::minimise::minimise;
use super::part::{Bounds, Form, Part};
use super::queue::{Place, Queue};
use super::{ABSOLUTE, Inside, Visits};
use crate::base::Result;
use crate::limit::tessellate::Fit;
use glam::{DMat2, DVec2, DVec3};

/// By what bounds from points of a part alone are multiplied.
const SAFETY: f64 = 2.0;
/// How far from the unit matrix J⁻¹J′ may be.
const UNLIKE: f64 = 0.2;
/// How much nearer a meeting is looked for, in units of what counts as met: a few times what is
/// taken for a point.
const ALIKE: f64 = 8.0;
/// Newton steps at most.
const STEPS: u32 = 40;

/// Where a ray meets the surface.
#[derive(Debug, Clone, Copy)]
pub(super) struct Meeting {
    pub(super) root: u32,
    pub(super) at: [f64; 2],
    /// Along the ray, in units of length.
    pub(super) z: f64,
}

/// A ray with a unit direction and what is across it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Line {
    pub(super) origin: DVec3,
    pub(super) along: DVec3,
    across: [DVec3; 2],
    range: [f64; 2],
    /// How near counts as met.
    tolerance: f64,
}

impl Line {
    pub(super) fn new(origin: DVec3, along: DVec3, range: [f64; 2]) -> Self {
        let (x, y) = along.any_orthonormal_pair();
        let tolerance = ABSOLUTE + 4.0 * f64::EPSILON * origin.abs().max_element();
        Self { origin, along, across: [x, y], range, tolerance }
    }

    fn across(&self, q: DVec3) -> DVec2 {
        let [x, y] = self.across;
        DVec2::new(q.dot(x), q.dot(y))
    }

    /// A point in coordinates across and along.
    fn place(&self, q: DVec3) -> DVec3 {
        let q = q - self.origin;
        self.across(q).extend(q.dot(self.along))
    }

    /// Where the ray comes into a box, if it does.
    fn enters(&self, bounds: &Bounds) -> Option<f64> {
        let slack = DVec3::splat(self.tolerance);
        let (low, high) = (bounds.low - slack - self.origin, bounds.high + slack - self.origin);
        let [mut first, mut last] = self.range;
        for axis in 0..3 {
            let step = self.along[axis];
            if step == 0.0 {
                if low[axis] > 0.0 || high[axis] < 0.0 {
                    return None;
                }
                continue;
            }
            let ends = [low[axis] / step, high[axis] / step];
            let [near, far] = if step > 0.0 { ends } else { [ends[1], ends[0]] };
            // Room for rounding of the quotients.
            let more = 4.0 * f64::EPSILON * near.abs().max(far.abs());
            (first, last) = (first.max(near - more), last.min(far + more));
        }
        (first <= last).then_some(first)
    }
}

/// A query on its way.
struct Cast<'a> {
    inside: Inside<'a>,
    line: Line,
    best: Option<Meeting>,
}

/// The first point of the surface on a ray.
///
/// # Errors
/// As [`super::Search::intersect`].
pub(super) fn cast(inside: Inside<'_>, line: Line, queue: &mut Queue) -> Result<Option<Meeting>> {
    let (mut query, mut visits) = (Cast { inside, line, best: None }, Visits::default());
    queue.clear();
    if let Some(bound) = inside.tree.0.first().and_then(|root| line.enters(&root.bounds)) {
        queue.push(bound, Place::Branch(0))?;
    }
    while let Some((bound, place)) = queue.pop() {
        if bound > query.farthest() {
            break;
        }
        if visits.add(inside.context, queue)? {
            query.line.tolerance *= 2.0;
        }
        match place {
            Place::Branch(branch) => query.branch(branch, bound, queue)?,
            Place::First(part) => query.visit(&inside.parts[part as usize], queue)?,
            Place::Made(part) => {
                let part = queue.take(part)?;
                query.visit(&part, queue)?;
            }
        }
    }
    Ok(query.best)
}

/// A part seen along the ray.
struct Seen {
    low: DVec3,
    high: DVec3,
}

impl Cast<'_> {
    fn limit(&self) -> f64 {
        self.best.as_ref().map_or(self.line.range[1], |best| best.z)
    }

    /// What is farther along the ray need not be looked at.
    fn farthest(&self) -> f64 {
        let alike = |best: &Meeting| best.z - ALIKE * self.line.tolerance;
        self.best.as_ref().map_or(self.line.range[1], alike)
    }

    fn branch(&self, branch: u32, bound: f64, queue: &mut Queue) -> Result<()> {
        for child in self.inside.children(branch) {
            let enters = match child {
                Place::Branch(i) => self.line.enters(&self.inside.tree.0[i as usize].bounds),
                _ => Some(bound),
            };
            if let Some(bound) = enters.filter(|&bound| bound <= self.farthest()) {
                queue.push(bound, child)?;
            }
        }
        Ok(())
    }

    /// The extent of a part across and along the ray, if that may meet it.
    fn seen(&self, part: &Part) -> Option<Seen> {
        let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let mut ends = [[DVec2::ZERO; 2]; 2];
        for q in part.points() {
            let q = self.line.place(q);
            for (axis, [least, most]) in ends.iter_mut().enumerate() {
                if q[axis] < low[axis] {
                    *least = q.truncate();
                }
                if q[axis] > high[axis] {
                    *most = q.truncate();
                }
            }
            (low, high) = (low.min(q), high.max(q));
        }
        let slack = part.slack + self.line.tolerance;
        let widest = usize::from(high.y - low.y > high.x - low.x);
        let [least, most] = ends[widest];
        (low, high) = (low - slack, high + slack);
        let meets = low.truncate().max_element() <= 0.0 && high.truncate().min_element() >= 0.0;
        let [first, _] = self.line.range;
        let is_there = meets && high.z >= first && low.z <= self.farthest();
        (is_there && self.is_in_strip(part, most - least, slack)).then_some(Seen { low, high })
    }

    /// Whether a part, seen along the ray, is on both sides of it, looking in a direction. What is
    /// seen at a small angle is narrow, but the box around it is not.
    fn is_in_strip(&self, part: &Part, direction: DVec2, slack: f64) -> bool {
        let Some(across) = direction.perp().try_normalize() else {
            return true;
        };
        let [x, y] = self.line.across;
        let across = across.x * x + across.y * y;
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for q in part.points() {
            let off = (q - self.line.origin).dot(across);
            (low, high) = (low.min(off), high.max(off));
        }
        low <= slack && high >= -slack
    }

    fn visit(&mut self, part: &Part, queue: &mut Queue) -> Result<()> {
        let Some(Seen { low, high }) = self.seen(part) else {
            return Ok(());
        };
        let is_point = (high - low).max_element() <= 4.0 * self.line.tolerance;
        if is_point || part.cell.is_smallest() {
            return self.offer_any(part);
        }
        match &part.form {
            Form::Exact(fit) if self.meets_once(fit, 1.0) => {
                let point = |at| Ok(Jet::of(fit, at));
                return self.solve(part, fit, point);
            }
            Form::Sampled(fit) if self.meets_once(fit, SAFETY) => {
                let Inside { field, memory, .. } = self.inside;
                let point = |at| {
                    let mut jet = Jet::of(fit, at);
                    jet.0[0] = field.point(memory, part, at)?;
                    Ok(jet)
                };
                return self.solve(part, fit, point);
            }
            _ => {}
        }
        for child in self.inside.field.children(self.inside.memory, part)? {
            if let Some(seen) = self.seen(&child) {
                queue.push_part(seen.low.z.max(self.line.range[0]), child)?;
            }
        }
        Ok(())
    }

    /// True if a part, seen along the ray, does not fold, nor is so narrow that it may be on the ray
    /// for long.
    fn meets_once(&self, fit: &Fit, safety: f64) -> bool {
        let hodograph = Hodograph::of(fit);
        let means = [0, 1].map(|axis| self.line.across(hodograph.spread(axis).0));
        let slopes = DMat2::from_cols(means[0], means[1]);
        let longest = means[0].length().max(means[1].length());
        if slopes.determinant().abs() <= 8.0 * self.line.tolerance * longest {
            return false;
        }
        let inverse = slopes.inverse();
        let mut unlike = 0.0;
        for axis in [0, 1] {
            let mut most = 0.0_f64;
            hodograph.first(axis, |d| {
                let off = inverse * (self.line.across(d) - means[axis]);
                // What is no number is not near.
                let off = off.abs().max_element();
                most = if off.is_nan() { f64::INFINITY } else { most.max(off) };
            });
            unlike += most;
        }
        inverse.is_finite() && safety * unlike <= UNLIKE
    }

    /// Newton's method within the cell of a part.
    fn solve(
        &mut self,
        part: &Part,
        fit: &Fit,
        point: impl Fn([f64; 2]) -> Result<Jet>,
    ) -> Result<()> {
        let mut at = middle(fit.shape);
        for _ in 0..STEPS {
            let Jet([q, s, t, ..]) = point(at)?;
            let off = self.line.place(q).truncate();
            let derivatives = DMat2::from_cols(self.line.across(s), self.line.across(t));
            let step = derivatives.inverse() * off;
            if !step.is_finite() {
                break;
            }
            let next = within(fit.shape, [at[0] - step.x, at[1] - step.y]);
            let moved = (next[0] - at[0]).abs().max((next[1] - at[1]).abs());
            at = next;
            if moved <= 1e-15 {
                break;
            }
        }
        // A root just beyond the border, seen at a small angle, may be far from where it was moved
        // to: what counts is the point of the border that is nearest to the ray.
        at = minimise(fit.shape, at, |at| {
            let Jet([q, s, t, ..]) = point(at)?;
            let off = self.line.place(q).truncate();
            let (s, t) = (self.line.across(s), self.line.across(t));
            let first = [s.dot(s), s.dot(t), t.dot(t)];
            Ok((off.length_squared(), [off.dot(s), off.dot(t)], first, [0.0; 3]))
        })?
        .at;
        let q = self.seen_at(part, at)?;
        let near = 2.0 * self.line.tolerance;
        if q.truncate().abs().max_element() > near {
            return Ok(());
        }
        let [first, last] = self.line.range;
        if q.z >= first - near && q.z <= last + near {
            self.offer(part, at, q.z);
            return Ok(());
        }
        // At a small angle the ray is near for long, and may be so where its range ends.
        let end = self.line.origin + q.z.clamp(first, last) * self.line.along;
        at = minimise(fit.shape, at, |at| {
            let Jet([q, s, t, ..]) = point(at)?;
            let off = q - end;
            let first = [s.dot(s), s.dot(t), t.dot(t)];
            Ok((off.length_squared(), [off.dot(s), off.dot(t)], first, [0.0; 3]))
        })?
        .at;
        let q = self.seen_at(part, at)?;
        let beyond = q.z - q.z.clamp(first, last);
        if q.truncate().abs().max_element().max(beyond.abs()) <= near {
            self.offer(part, at, q.z);
        }
        Ok(())
    }

    /// Takes the corner or the middle of a part, which is as good as a point, that is nearest
    /// to the ray.
    fn offer_any(&mut self, part: &Part) -> Result<()> {
        let shape = self.inside.field.shape(part);
        let mut nearest = (f64::INFINITY, middle(shape), 0.0);
        for at in corners(shape).iter().copied().chain([middle(shape)]) {
            let q = self.seen_at(part, at)?;
            let off = q.truncate().length_squared();
            if off < nearest.0 {
                nearest = (off, at, q.z);
            }
        }
        self.offer(part, nearest.1, nearest.2);
        Ok(())
    }

    /// A point of a part in coordinates across and along the ray.
    fn seen_at(&self, part: &Part, at: [f64; 2]) -> Result<DVec3> {
        let q = match &part.form {
            Form::Exact(fit) => Jet::of(fit, at).0[0],
            _ => self.inside.field.point(self.inside.memory, part, at)?,
        };
        Ok(self.line.place(q))
    }

    /// Takes a point on the ray if that is within its range, and the first.
    fn offer(&mut self, part: &Part, at: [f64; 2], z: f64) {
        let ([first, _], limit, slack) = (self.line.range, self.limit(), 4.0 * self.line.tolerance);
        if z >= first - slack && z <= limit + slack {
            let z = z.clamp(first, limit);
            self.best = Some(Meeting { root: part.root, at: part.cell.place(at), z });
        }
    }
}
