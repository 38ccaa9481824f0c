//! The nearest point: best first, down to parts over which the distance is convex.
//!
//! Half the squared distance f(s, t) = ½|S − p|² has the second derivatives Sₐ·S_b + (S − p)·S_ab.
//! Where hulls of coefficients show them to be positive definite over all of a cell, f lies above
//! its tangent planes: a minimum that Newton's method finds is *the* minimum, and what the
//! tangent plane at another point says of the cell's corners is a bound.

use super::cell::{corners, middle};
use super::jet::{Hodograph, Jet};
use super::minimise::{Minimum, minimise};
use super::part::{Form, Part};
use super::queue::{Place, Queue};
use super::{ABSOLUTE, Inside, RELATIVE, Visits};
use crate::base::Result;
use crate::limit::tessellate::Fit;
use glam::DVec3;

/// By what bounds from points of a part alone are multiplied.
const SAFETY: f64 = 2.0;

/// A point of the surface with its distance.
#[derive(Debug, Clone, Copy)]
pub(super) struct Near {
    pub(super) root: u32,
    pub(super) at: [f64; 2],
    pub(super) distance: f64,
}

/// A query on its way.
struct Nearest<'a> {
    inside: Inside<'a>,
    p: DVec3,
    reach: f64,
    best: Option<Near>,
    absolute: f64,
    /// What is given up beside, in a query that takes long.
    given_up: f64,
}

/// The point of the surface nearest to p, if one is within reach.
///
/// # Errors
/// As [`super::Search::closest`].
pub(super) fn nearest(
    inside: Inside<'_>,
    p: DVec3,
    reach: f64,
    queue: &mut Queue,
) -> Result<Option<Near>> {
    let absolute = ABSOLUTE + 4.0 * f64::EPSILON * p.abs().max_element();
    let mut query = Nearest { inside, p, reach, best: None, absolute, given_up: 0.0 };
    let mut visits = Visits::default();
    queue.clear();
    if let Some(root) = inside.tree.0.first() {
        queue.push(root.bounds.distance(p), Place::Branch(0))?;
    }
    while let Some((bound, place)) = queue.pop() {
        if bound > query.limit() {
            break;
        }
        if visits.add(inside.context, queue)? {
            query.given_up = 2.0 * query.given_up.max(absolute);
        }
        match place {
            Place::Branch(branch) => query.branch(branch, queue)?,
            Place::First(part) => query.visit(&inside.parts[part as usize], queue)?,
            Place::Made(part) => {
                let part = queue.take(part)?;
                query.visit(&part, queue)?;
            }
        }
    }
    Ok(query.best)
}

impl Nearest<'_> {
    /// What is farther than this need not be looked at.
    fn limit(&self) -> f64 {
        match self.best {
            Some(Near { distance, .. }) => {
                distance - self.given_up - self.absolute.max(RELATIVE * distance)
            }
            None => self.reach + self.absolute - self.given_up,
        }
    }

    fn branch(&self, branch: u32, queue: &mut Queue) -> Result<()> {
        let (tree, limit) = (&self.inside.tree.0, self.limit());
        for child in self.inside.children(branch) {
            let (bound, place) = match child {
                Place::Branch(child) => (tree[child as usize].bounds.distance(self.p), child),
                other => {
                    let bound = tree[branch as usize].bounds.distance(self.p);
                    queue.push(bound, other)?;
                    continue;
                }
            };
            if bound <= limit {
                queue.push(bound, Place::Branch(place))?;
            }
        }
        Ok(())
    }

    /// Takes a point if it is nearer than those before.
    fn offer(&mut self, part: &Part, at: [f64; 2], distance: f64) {
        let nearer = self
            .best
            .as_ref()
            .map_or(distance <= self.reach + self.absolute, |b| distance < b.distance);
        if nearer {
            self.best = Some(Near { root: part.root, at: part.cell.place(at), distance });
        }
    }

    fn visit(&mut self, part: &Part, queue: &mut Queue) -> Result<()> {
        if self.bound(part) > self.limit() || self.look(part)? > self.limit() {
            return Ok(());
        }
        if part.cell.is_smallest() {
            return Ok(());
        }
        for child in self.inside.field.children(self.inside.memory, part)? {
            let bound = child.bounds().distance(self.p).max(self.bound(&child));
            if bound <= self.limit() {
                queue.push_part(bound, child)?;
            }
        }
        Ok(())
    }

    /// The distance of the hull's points along the line to their middle.
    fn bound(&self, part: &Part) -> f64 {
        let (sum, count) = part.points().fold((DVec3::ZERO, 0.0), |(s, n), q| (s + q, n + 1.0));
        let Some(along) = (sum / count - self.p).try_normalize() else {
            return 0.0;
        };
        let nearest = part.points().map(|q| (q - self.p).dot(along)).fold(f64::INFINITY, f64::min);
        nearest - part.slack
    }

    /// Looks for a near point in a part, and returns a bound on how near others in it may be.
    fn look(&mut self, part: &Part) -> Result<f64> {
        let (p, shape) = (self.p, self.inside.field.shape(part));
        match &part.form {
            Form::Hull(_) => {
                for &at in corners(shape) {
                    let distance =
                        self.inside.field.point(self.inside.memory, part, at)?.distance(p);
                    self.offer(part, at, distance);
                }
                Ok(0.0)
            }
            Form::Exact(fit) => {
                let least = self.minimise(fit, |at| Ok(Jet::of(fit, at)))?;
                self.offer(part, least.at, least.value.sqrt());
                Ok(if is_convex(fit, p, 1.0) { least.lower().sqrt() } else { 0.0 })
            }
            Form::Sampled(fit) => {
                let Inside { field, memory, .. } = self.inside;
                let least = self.minimise(fit, |at| {
                    let mut jet = Jet::of(fit, at);
                    jet.0[0] = field.point(memory, part, at)?;
                    Ok(jet)
                })?;
                self.offer(part, least.at, least.value.sqrt());
                Ok(if is_convex(fit, p, SAFETY) { least.lower().sqrt() } else { 0.0 })
            }
        }
    }

    fn minimise(&self, fit: &Fit, jet: impl Fn([f64; 2]) -> Result<Jet>) -> Result<Minimum> {
        let p = self.p;
        minimise(fit.shape, middle(fit.shape), |at| {
            let Jet([s, su, sv, suu, suv, svv]) = jet(at)?;
            let r = s - p;
            let gradient = [r.dot(su), r.dot(sv)];
            let first = [su.dot(su), su.dot(sv), sv.dot(sv)];
            let second = [r.dot(suu), r.dot(suv), r.dot(svv)];
            Ok((r.length_squared(), gradient, first, second))
        })
    }
}

/// True if the squared distance from p is shown to be convex over all of a fit's cell.
fn is_convex(fit: &Fit, p: DVec3, safety: f64) -> bool {
    let (sum, count) = fit.all().fold((DVec3::ZERO, 0.0), |(s, n), q| (s + q, n + 1.0));
    let centre = sum / count;
    let radius = fit.all().map(|q| q.distance_squared(centre)).fold(0.0, f64::max).sqrt();
    let away = centre - p;
    let hodograph = Hodograph::of(fit);
    let [(s, far_s), (t, far_t)] = [0, 1].map(|axis| hodograph.spread(axis));
    let (far_s, far_t) = (safety * far_s, safety * far_t);
    // The least of (S − p)·D over all S and D, and the largest size.
    let along = |axes: [usize; 2]| {
        let (mut least, mut most, mut size) = (f64::INFINITY, f64::NEG_INFINITY, 0.0_f64);
        hodograph.second(axes, |d| {
            let x = away.dot(d);
            (least, most) = (least.min(x), most.max(x));
            size = size.max(d.length_squared());
        });
        let more = radius * size.sqrt();
        [safety * (least - more).min(0.0) + (least - more).max(0.0), most.max(-least) + more]
    };
    let ss = square(s.length() - far_s) + along([0, 0])[0];
    let tt = square(t.length() - far_t) + along([1, 1])[0];
    let mixed = s.dot(t).abs() + far_s * t.length() + far_t * s.length() + far_s * far_t;
    let st = mixed + safety * along([0, 1])[1];
    ss > 0.0 && tt > 0.0 && ss * tt > st * st
}

/// The square of what is above 0.
fn square(x: f64) -> f64 {
    x.max(0.0) * x.max(0.0)
}
