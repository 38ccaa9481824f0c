//! A point of the surface: down from cell to cell to a regular patch, or on to where a cell's
//! points become one.

use super::box_spline;
use super::nodes::Node;
use super::univariate::Univariate;
use crate::base::{Error, ErrorKind, Result, memory};

/// Steps after which points that do not come together are given up.
const MOST_STEPS: u32 = 4000;
/// How far apart points that are one may be, of what they were.
const TOGETHER: f64 = 1.0 / (1_u64 << 54) as f64;

/// The derivatives by s and t of each number of a record, in order.
pub(super) const PARTIALS: [[usize; 2]; 6] = [[0, 0], [1, 0], [0, 1], [2, 0], [1, 1], [0, 2]];

/// What evaluation needs of a surface.
#[derive(Clone, Copy)]
pub(super) struct Patches<'a> {
    pub(super) nodes: &'a [Node],
    pub(super) univariate: Option<&'a Univariate>,
    pub(super) window: [i32; 2],
}

/// Where to begin.
#[derive(Clone, Copy)]
pub(super) struct Start {
    pub(super) node: u32,
    pub(super) at: [f64; 2],
    /// Derivatives of cell coordinates by those asked for.
    pub(super) jacobian: [[f64; 2]; 2],
}

/// Memory of a thread.
#[derive(Default)]
pub(super) struct Scratch {
    /// The points of a cell, and those of the next.
    pub(super) points: Vec<f64>,
    next: Vec<f64>,
    origin: Vec<f64>,
    taps: [[Vec<f64>; 3]; 2],
    weights: Vec<f64>,
}

fn unsupported(message: &str) -> Error {
    Error::new(ErrorKind::Unsupported, message)
}

impl Patches<'_> {
    /// Writes the position and derivatives of a point: as many records of `width` numbers as
    /// `out` holds, in the order of [`PARTIALS`]. The points of the first cell are in `scratch`.
    pub(super) fn evaluate(
        &self,
        start: Start,
        width: usize,
        scratch: &mut Scratch,
        out: &mut [f64],
    ) -> Result<()> {
        let Start { mut node, mut at, mut jacobian } = start;
        out.fill(0.0);
        scratch.origin.clear();
        memory::extend(&mut scratch.origin, std::iter::repeat_n(0.0, width))?;
        let mut first_spread = None;
        for _ in 0..MOST_STEPS {
            match &self.nodes[node as usize] {
                Node::Refused(why) => return Err(unsupported(why)),
                Node::Grid(extent) => {
                    self.grid(*extent, at, width, scratch, out)?;
                    return finish(jacobian, width, &scratch.origin, out);
                }
                Node::Triangle => {
                    triangle(at, width, &scratch.points, out);
                    return finish(jacobian, width, &scratch.origin, out);
                }
                Node::Split { kind, children } => {
                    let (place, map) = kind.child(at);
                    let child = children[place].as_ref();
                    let child = child.ok_or_else(|| unsupported("there is no surface"))?;
                    let there = map.apply(at);
                    let stays =
                        child.node == node && (0..2).all(|k| there[k].to_bits() == at[k].to_bits());
                    if stays && out.len() > width {
                        return Err(unsupported("derivatives do not exist at a feature"));
                    }
                    child.points(&scratch.points, width, &mut scratch.next)?;
                    std::mem::swap(&mut scratch.points, &mut scratch.next);
                    let spread = scratch.recentre(width);
                    let before = *first_spread.get_or_insert(spread);
                    if stays && spread <= before * TOGETHER {
                        return finish(jacobian, width, &scratch.origin, out);
                    }
                    jacobian = map.after(jacobian);
                    (node, at) = (child.node, there);
                }
            }
        }
        Err(unsupported("points do not converge"))
    }

    /// The tensor product over the points of a grid.
    fn grid(
        &self,
        extent: [[i32; 2]; 2],
        at: [f64; 2],
        width: usize,
        scratch: &mut Scratch,
        out: &mut [f64],
    ) -> Result<()> {
        let univariate = self
            .univariate
            .ok_or_else(|| Error::new(ErrorKind::BrokenInvariant, "a grid without a mask"))?;
        let records = out.len() / width;
        let orders = PARTIALS[records - 1][1];
        if orders > univariate.derivatives() {
            return Err(unsupported("the scheme has no such derivatives"));
        }
        // Under dual schemes a cell is the second half of an interval about its vertex.
        let is_dual = self.window[0] + self.window[1] == 0;
        for axis in 0..2 {
            let x = if is_dual { 0.5 + 0.5 * at[axis] } else { at[axis] };
            let mut scale = 1.0;
            for order in 0..=orders {
                let taps = &mut scratch.taps[axis][order];
                univariate.taps(x, order, taps);
                fold(taps, self.window[0], extent[axis]);
                for weight in taps.iter_mut() {
                    *weight *= scale;
                }
                scale *= if is_dual { 0.5 } else { 1.0 };
            }
        }
        for (by, sums) in PARTIALS.iter().zip(out.chunks_exact_mut(width)) {
            let [along, across] = [&scratch.taps[0][by[0]], &scratch.taps[1][by[1]]];
            scratch.weights.clear();
            for y in across {
                scratch.weights.extend(along.iter().map(|x| x * y));
            }
            sum(&scratch.weights, &scratch.points, sums);
        }
        Ok(())
    }
}

impl Scratch {
    /// Makes the first point the origin of the others, so that their differences keep their
    /// digits; returns the largest coordinate.
    fn recentre(&mut self, width: usize) -> f64 {
        let mut spread: f64 = 0.0;
        let (first, rest) = self.points.split_at_mut(width);
        for point in rest.chunks_exact_mut(width) {
            for (x, origin) in point.iter_mut().zip(&*first) {
                *x -= origin;
                spread = spread.max(x.abs());
            }
        }
        for (sum, x) in self.origin.iter_mut().zip(first) {
            *sum += *x;
            *x = 0.0;
        }
        spread
    }
}

/// Turns weights of the points of a window into weights of those in a range, the others being
/// p₋ⱼ = 2p₀ − pⱼ beyond either end.
fn fold(taps: &mut Vec<f64>, lowest: i32, [first, last]: [i32; 2]) {
    let place = |x: i32| (x - lowest) as usize;
    let highest = lowest + taps.len() as i32 - 1;
    // The farthest first: an image may lie beyond the other end, but less far.
    let farthest = (first - lowest).max(highest - last);
    for distance in (1..=farthest).rev() {
        for (x, end) in [(first - distance, first), (last + distance, last)] {
            if x < lowest || x > highest {
                continue;
            }
            let weight = taps[place(x)];
            taps[place(x)] = 0.0;
            taps[place(end)] += 2.0 * weight;
            taps[place(2 * end - x)] -= weight;
        }
    }
    taps.truncate(place(last) + 1);
    taps.drain(..place(first));
}

/// Adds up points with weights.
fn sum(weights: &[f64], points: &[f64], sums: &mut [f64]) {
    for (weight, point) in weights.iter().zip(points.chunks_exact(sums.len())) {
        sums.iter_mut().zip(point).for_each(|(sum, x)| *sum += weight * x);
    }
}

fn triangle(at: [f64; 2], width: usize, points: &[f64], out: &mut [f64]) {
    for (by, sums) in PARTIALS.iter().zip(out.chunks_exact_mut(width)) {
        sum(&box_spline::taps(at[0], at[1], *by), points, sums);
    }
}

/// Derivatives by cell coordinates become those by the coordinates asked for.
fn finish(j: [[f64; 2]; 2], width: usize, origin: &[f64], out: &mut [f64]) -> Result<()> {
    let records = out.len() / width;
    for k in 0..width {
        out[k] += origin[k];
        if records >= 3 {
            let [s, t] = [out[width + k], out[2 * width + k]];
            out[width + k] = s * j[0][0] + t * j[1][0];
            out[2 * width + k] = s * j[0][1] + t * j[1][1];
        }
        if records == 6 {
            let [ss, st, tt] = [3, 4, 5].map(|record| out[record * width + k]);
            let second = |a: usize, b: usize| {
                ss * j[0][a] * j[0][b]
                    + st * (j[0][a] * j[1][b] + j[1][a] * j[0][b])
                    + tt * j[1][a] * j[1][b]
            };
            (out[3 * width + k], out[4 * width + k], out[5 * width + k]) =
                (second(0, 0), second(0, 1), second(1, 1));
        }
    }
    if out.iter().all(|x| x.is_finite()) {
        return Ok(());
    }
    Err(Error::new(ErrorKind::NotFinite, "a value there, or a derivative, is not finite"))
}
