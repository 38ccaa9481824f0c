//! Non-stationary schemes: rules that change from level to level.
//!
//! Beccari, Casciola and Romani's interpolating 4-point scheme with tension (*A non-stationary
//! uniform tension controlled interpolating 4-point scheme reproducing conics*, CAGD 24, 2007)
//! has mask [−w, 0, ½ + w, 1, ½ + w, 0, −w] with
//!
//! w = 1 / (8 v′ (1 + v′)), v′ = √((1 + v)/2)
//!
//! on a level with tension v, and v′ is the tension of the next. With v = cos θ points on a circle
//! θ apart go to points on it, v = 1 is Dubuc's scheme and keeps cubics, v = cosh s keeps
//! hyperbolas. Each edge may have its own tension, which its two halves inherit.

use super::coordinate::Coordinate;
use super::ends::{Ends, Extent, check_steps, predict};
use super::lattice::Lattice;
use super::mask::out_of_range;
use super::refine::{Polygon, check_overflow, check_points, check_total};
use super::rules::Rules;
use crate::base::{Context, Error, ErrorKind, Result, memory};

/// A family of rules with a number that changes from level to level.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Tension {
    /// The binary 4-point scheme above; v > −1.
    FourPoint(f64),
    /// The ternary 4-point scheme with tension of the same authors (2007): β ≥ −2 but not
    /// −1, βₖ₊₁ = √(2 + βₖ), g = 1/(3(β′² − 1)(1 + β′)) and weights
    /// (−90g − 1, 90g + 43, 90g + 17, 1 − 90g)/60 of t−1 … t+2 on 3t+1. The mask is from
    /// memory, the update of β is not confirmed by a source.
    TernaryFourPoint(f64),
}

impl Tension {
    /// The tension whose points `n` to a full turn lie on a circle: cos(2π/n).
    pub fn circle(n: usize) -> Self {
        Self::FourPoint(libm::cos(std::f64::consts::TAU / n.max(1) as f64))
    }

    fn check(self) -> Result<()> {
        let (value, fine) = match self {
            Self::FourPoint(v) => (v, v > -1.0),
            Self::TernaryFourPoint(b) => (b, b >= -2.0 && next_ternary(b) > 1.0),
        };
        if fine && value.is_finite() {
            return Ok(());
        }
        Err(out_of_range(format!("tension {value} is out of range: it must be above -1")))
    }

    /// The tension of the next level.
    #[must_use]
    pub fn next(self) -> Self {
        match self {
            Self::FourPoint(v) => Self::FourPoint(next_binary(v)),
            Self::TernaryFourPoint(b) => Self::TernaryFourPoint(next_ternary(b)),
        }
    }

    pub(super) fn rules<T: Coordinate>(self) -> Rules<T> {
        match self {
            Self::FourPoint(v) => Rules::four_point(binary_weights(v)),
            Self::TernaryFourPoint(b) => {
                let b = next_ternary(b);
                let g = 90.0 / (3.0 * (b * b - 1.0) * (1.0 + b));
                let sixtieths = [-g - 1.0, g + 43.0, g + 17.0, 1.0 - g];
                Rules::ternary_four_point(sixtieths.map(|w| w / 60.0))
            }
        }
    }
}

fn next_binary(v: f64) -> f64 {
    f64::midpoint(1.0, v).sqrt()
}

fn next_ternary(b: f64) -> f64 {
    (2.0 + b).sqrt()
}

/// The weights of t−1 … t+2 on the point between t and t+1.
fn binary_weights(v: f64) -> [f64; 4] {
    let next = next_binary(v);
    let w = 1.0 / (8.0 * next * (1.0 + next));
    [-w, 0.5 + w, 0.5 + w, -w]
}

impl<T: Coordinate> Polygon<T> {
    /// The polygon after `steps` steps with one tension for all edges; that of level 0 is
    /// given.
    ///
    /// # Errors
    /// As [`Polygon::refine`]; [`ErrorKind::ParameterOutOfRange`] for a tension out of range.
    pub fn refine_with_tension(
        &self,
        context: &Context,
        tension: Tension,
        steps: u32,
    ) -> Result<Self> {
        tension.check()?;
        let at = |level| (0..level).fold(tension, |tension, _| tension.next());
        self.refine_by_levels(context, steps, |level| Ok(at(level).rules::<T>()))
    }

    /// The polygon after `steps` steps of the binary 4-point scheme, with a tension v > −1 for
    /// each edge (that of edge i is between points i and i + 1) of level 0.
    ///
    /// # Errors
    /// As [`Polygon::refine_with_tension`]; [`ErrorKind::LengthMismatch`] if there are not as
    /// many tensions as edges.
    pub fn refine_with_local_tension(
        &self,
        context: &Context,
        tensions: &[f64],
        steps: u32,
    ) -> Result<Self> {
        check_points(&self.points, self.width)?;
        check_steps(steps)?;
        check_edges(self, tensions)?;
        tensions.iter().try_for_each(|&v| Tension::FourPoint(v).check())?;
        let rules = Rules::<T>::four_point(binary_weights(1.0));
        let (points, _) = predict(&rules, self.ends, self.len(), steps)?;
        check_total(context, points, self.width, T::BYTES)?;
        let mut tensions = memory::copied(tensions)?;
        let mut polygon = self.copied()?;
        for step in 0..steps {
            context.report(f64::from(step) / f64::from(steps))?;
            let extent = Extent::of(&rules, polygon.ends, polygon.len())?;
            polygon = polygon.locally_refined(&tensions, &rules, &extent)?;
            tensions = halved(&tensions, &extent, edges(&polygon))?;
        }
        Ok(polygon)
    }

    fn locally_refined(&self, tensions: &[f64], rules: &Rules<T>, extent: &Extent) -> Result<Self> {
        let lattice = Lattice::new(&self.points, self.width, self.ends, rules, extent)?;
        let mut points = T::zeros(extent.made * self.width)?;
        for (i, point) in (extent.first..).zip(points.chunks_exact_mut(self.width)) {
            let t = i.div_euclid(2);
            if i.rem_euclid(2) == 0 {
                point.clone_from_slice(lattice.point(t));
                continue;
            }
            let weights = binary_weights(tensions[t as usize]).map(T::from_f64);
            let others = weights[1..].iter().zip(t..);
            lattice.combine((&weights[0], t - 1), others, point);
        }
        let norm = tensions.iter().map(|&v| binary_weights(v).iter().map(|w| w.abs()).sum());
        check_overflow(&self.points, norm.fold(1.0, f64::max), &points, self.width)?;
        Ok(Self { points, width: self.width, ends: extent.ends })
    }
}

/// The number of edges.
pub(crate) fn edges<T: Coordinate>(polygon: &Polygon<T>) -> usize {
    polygon.len() - usize::from(polygon.ends != Ends::Closed)
}

pub(crate) fn check_edges<T: Coordinate>(polygon: &Polygon<T>, values: &[f64]) -> Result<()> {
    if polygon.ends == Ends::Anchored {
        let message = "an anchored polygon does not come from this scheme".to_owned();
        return Err(Error::new(ErrorKind::Unsupported, message));
    }
    if values.len() != edges(polygon) {
        let message = format!("{} values for {} edges", values.len(), edges(polygon));
        return Err(Error::new(ErrorKind::LengthMismatch, message));
    }
    Ok(())
}

/// The tensions of the edges of the next level: each edge's two halves have the next one.
fn halved(tensions: &[f64], extent: &Extent, count: usize) -> Result<Vec<f64>> {
    let of = |i: i64| next_binary(tensions[i.div_euclid(2) as usize]);
    memory::collect((extent.first..).take(count).map(of))
}
