//! A scheme of polygons of any kind: a mask, or rules that change from level to level or from
//! edge to edge.

use super::coordinate::Coordinate;
use super::ends::{Ends, predict};
use super::mask::{Mask, out_of_range};
use super::refine::Polygon;
use super::rules::Rules;
use super::tension::Tension;
use super::{catalogue, rational};
use crate::base::{Context, Error, ErrorKind, Result};

/// A scheme of polygons.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum CurveScheme {
    /// The same mask at each level.
    Stationary(Mask),
    /// One tension for all edges.
    Tension(Tension),
    /// The binary 4-point scheme with a tension for each edge.
    LocalTension(Vec<f64>),
    /// The non-uniform 4-point scheme: the lengths of edges to this power, within 0..=1, are
    /// intervals of the parameter.
    NonUniform(f64),
}

impl CurveScheme {
    /// The scheme of a name of the catalogue with its parameters: `chaikin`,
    /// `three-point:1/32`, `tension-four-point:0.5`, the same with a number for each edge, or
    /// `non-uniform-four-point:0.5`.
    ///
    /// # Errors
    /// As [`catalogue::mask`]; [`ErrorKind::ParameterOutOfRange`] for a number too many. A
    /// tension or a power out of range is found by [`CurveScheme::refine`].
    pub fn named(text: &str) -> Result<Self> {
        let (name, list) = text.trim().split_once(':').unwrap_or((text.trim(), ""));
        let one = |default: f64| match numbers(list)?[..] {
            [] => Ok(default),
            [one] => Ok(one),
            ref more => {
                Err(out_of_range(format!("too many parameters, {}: {name} has 1", more.len())))
            }
        };
        match name.trim_end() {
            "tension-four-point" => match numbers(list)? {
                all if all.len() > 1 => Ok(Self::LocalTension(all)),
                all => Ok(Self::Tension(Tension::FourPoint(all.first().map_or(1.0, |v| *v)))),
            },
            "tension-ternary-four-point" => Ok(Self::Tension(Tension::TernaryFourPoint(one(2.0)?))),
            "non-uniform-four-point" => Ok(Self::NonUniform(one(0.5)?)),
            _ => catalogue::mask(text).map(Self::Stationary),
        }
    }

    /// Its mask, if it has one.
    pub fn mask(&self) -> Option<&Mask> {
        match self {
            Self::Stationary(mask) => Some(mask),
            _ => None,
        }
    }

    /// Its mask.
    ///
    /// # Errors
    /// [`ErrorKind::Unsupported`] if it has none.
    pub fn stationary(&self) -> Result<&Mask> {
        let none = "the rules of the scheme change: it has no mask";
        self.mask().ok_or_else(|| Error::new(ErrorKind::Unsupported, none))
    }

    /// The number of points, and the ends, after `steps` steps.
    ///
    /// # Errors
    /// As [`Polygon::predict`].
    pub fn predict(&self, points: usize, ends: Ends, steps: u32) -> Result<(usize, Ends)> {
        let rules = match self {
            Self::Stationary(mask) => Rules::<f64>::new(mask),
            Self::Tension(tension) => tension.rules(),
            Self::LocalTension(_) | Self::NonUniform(_) => Rules::four_point([1.0; 4]),
        };
        predict(&rules, ends, points, steps)
    }

    /// A polygon after some steps.
    ///
    /// # Errors
    /// As [`Polygon::refine`], [`Polygon::refine_with_tension`],
    /// [`Polygon::refine_with_local_tension`], [`Polygon::parameters`] and
    /// [`Polygon::refine_non_uniform`].
    pub fn refine<T: Coordinate>(
        &self,
        context: &Context,
        polygon: &Polygon<T>,
        steps: u32,
    ) -> Result<Polygon<T>> {
        match self {
            Self::Stationary(mask) => polygon.refine(context, mask, steps),
            Self::Tension(tension) => polygon.refine_with_tension(context, *tension, steps),
            Self::LocalTension(list) => polygon.refine_with_local_tension(context, list, steps),
            Self::NonUniform(power) => {
                polygon.refine_non_uniform(context, &polygon.parameters(*power)?, steps)
            }
        }
    }
}

/// The numbers of a list, decimals or fractions.
fn numbers(list: &str) -> Result<Vec<f64>> {
    let fields = list.split(',').filter(|_| !list.trim().is_empty());
    let number = |field: &str| match field.trim().parse::<f64>() {
        Ok(value) => Ok(value),
        Err(_) => rational::parse(field).map(|value| rational::to_f64(&value)),
    };
    fields.map(number).collect()
}
