//! The 4-point scheme on parameters that are not equally spaced.
//!
//! A new point is the value, half-way between two parameters, of the cubic through the four points
//! around: Dubuc's scheme where they are equally spaced (Daubechies, Guskov and Sweldens 1999; by
//! local parameters Cai 1995, as cited by the founding paper). Chordal and centripetal
//! parameters are those of Dyn, Floater and Hormann (*Four-point curve subdivision based on
//! iterated chordal and centripetal parameterizations*, CAGD 26, 2009).

use super::coordinate::Coordinate;
use super::ends::{Ends, Extent, check_steps, predict};
use super::lattice::Lattice;
use super::mask::out_of_range;
use super::refine::{Polygon, check_overflow, check_points, check_total};
use super::rules::Rules;
use super::tension::{check_edges, edges};
use crate::base::{Context, Error, ErrorKind, Result, memory};

impl<T: Coordinate> Polygon<T> {
    /// The lengths of the edges to the power of `exponent`: 0 uniform, ½ centripetal, 1
    /// chordal parameters.
    ///
    /// # Errors
    /// [`ErrorKind::LengthMismatch`] and [`ErrorKind::NotFinite`] as [`Polygon::refine`];
    /// [`ErrorKind::ParameterOutOfRange`] for an exponent outside of 0..=1 or an edge of
    /// length 0 under an exponent above 0.
    pub fn parameters(&self, exponent: f64) -> Result<Vec<f64>> {
        check_points(&self.points, self.width)?;
        if !(0.0..=1.0).contains(&exponent) {
            return Err(out_of_range(format!("exponent {exponent} is not within 0..=1")));
        }
        let length = |i: usize| {
            let (p, q) = (self.point(i), self.point((i + 1) % self.len()));
            let squares = p.iter().zip(q).map(|(x, y)| (y.to_f64() - x.to_f64()).powi(2));
            libm::pow(squares.sum::<f64>(), exponent / 2.0)
        };
        let lengths = memory::collect((0..edges(self)).map(length))?;
        check_lengths(&lengths)?;
        Ok(lengths)
    }

    /// The polygon after `steps` steps of the non-uniform 4-point scheme; interval i of the
    /// parameter, `intervals[i]`, is that of the edge from point i to point i + 1, and each is
    /// halved by a step. Intervals go on beyond ends that stay as they are mirrored in them.
    ///
    /// # Errors
    /// As [`Polygon::refine`]; [`ErrorKind::LengthMismatch`] if there are not as many intervals
    /// as edges, [`ErrorKind::ParameterOutOfRange`] for one that is not positive and finite.
    pub fn refine_non_uniform(
        &self,
        context: &Context,
        intervals: &[f64],
        steps: u32,
    ) -> Result<Self> {
        check_points(&self.points, self.width)?;
        check_steps(steps)?;
        check_edges(self, intervals)?;
        check_lengths(intervals)?;
        let rules = Rules::<T>::four_point([1.0; 4]);
        let (points, _) = predict(&rules, self.ends, self.len(), steps)?;
        check_total(context, points, self.width, T::BYTES)?;
        let mut intervals = memory::copied(intervals)?;
        let mut polygon = self.copied()?;
        for step in 0..steps {
            context.report(f64::from(step) / f64::from(steps))?;
            let extent = Extent::of(&rules, polygon.ends, polygon.len())?;
            polygon = polygon.interpolated(&intervals, &rules, &extent)?;
            let half = |i: i64| intervals[i.div_euclid(2) as usize] / 2.0;
            let count = edges(&polygon);
            intervals = memory::collect((extent.first..).take(count).map(half))?;
        }
        Ok(polygon)
    }

    fn interpolated(&self, intervals: &[f64], rules: &Rules<T>, extent: &Extent) -> Result<Self> {
        let lattice = Lattice::new(&self.points, self.width, self.ends, rules, extent)?;
        let mut points = T::zeros(extent.made * self.width)?;
        let mut norm: f64 = 1.0;
        for (i, point) in (extent.first..).zip(points.chunks_exact_mut(self.width)) {
            let t = i.div_euclid(2);
            if i.rem_euclid(2) == 0 {
                point.clone_from_slice(lattice.point(t));
                continue;
            }
            let around = [-1, 0, 1].map(|s| interval(intervals, self.ends, t + s));
            let weights = cubic_weights(around);
            norm = norm.max(weights.iter().map(|w| w.abs()).sum());
            let weights = weights.map(T::from_f64);
            let others = weights[1..].iter().zip(t..);
            lattice.combine((&weights[0], t - 1), others, point);
        }
        check_overflow(&self.points, norm, &points, self.width)?;
        Ok(Self { points, width: self.width, ends: extent.ends })
    }
}

/// Interval `i`, wrapped or mirrored.
fn interval(intervals: &[f64], ends: Ends, i: i64) -> f64 {
    let n = intervals.len() as i64;
    if ends == Ends::Closed {
        return intervals[i.rem_euclid(n) as usize];
    }
    let i = if i < 0 { -1 - i } else { i };
    let i = if i >= n { 2 * n - 1 - i } else { i };
    intervals[i.clamp(0, n - 1) as usize]
}

/// Lagrange's weights in the middle of the second of three intervals.
fn cubic_weights([a, b, c]: [f64; 3]) -> [f64; 4] {
    let nodes = [-a, 0.0, b, b + c];
    let x = b / 2.0;
    std::array::from_fn(|i| {
        let others = (0..4).filter(|&j| j != i);
        others.map(|j| (x - nodes[j]) / (nodes[i] - nodes[j])).product()
    })
}

fn check_lengths(lengths: &[f64]) -> Result<()> {
    let bad = lengths.iter().position(|l| !(l.is_finite() && *l > 0.0));
    bad.map_or(Ok(()), |i| {
        let message = format!("the parameter interval of edge {i} is {}", lengths[i]);
        Err(Error::new(ErrorKind::ParameterOutOfRange, message))
    })
}
