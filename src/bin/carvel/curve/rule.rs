//! What a step does: a mask, or rules that change.

use crate::args::{MaskSource, check_name, family_name};
use crate::exit::{Doing, Failure};
use carvel::analysis::mask::contractivity;
use carvel::curve::{Coordinate, Mask, Polygon, Tension, rational};
use carvel::{Context, ErrorKind, Result as Made};

/// A scheme for polygons.
#[derive(Debug, Clone)]
pub enum Rule {
    /// The same mask at each level.
    Stationary(Mask),
    /// One tension for all edges.
    Tension(Tension),
    /// One for each edge.
    Local(Vec<f64>),
    /// Lengths of edges to this power are intervals of the parameter.
    NonUniform(f64),
}

impl Rule {
    /// The rule of a mask, or of a name of the catalogue.
    ///
    /// # Errors
    /// A usage error.
    pub fn of(source: MaskSource) -> Result<Self, Failure> {
        let MaskSource::Named(text) = source else { return source.mask().map(Self::Stationary) };
        check_name(text)?;
        let numbers = |default: f64| {
            let numbers = numbers(text).map_err(|e| Failure::from_error(&e, Doing::Asking))?;
            Ok(if numbers.is_empty() { vec![default] } else { numbers })
        };
        let one = |default: f64| match numbers(default)?[..] {
            [one] => Ok(one),
            _ => Err(Failure::usage(format!("{} takes one number", family_name(text)))),
        };
        match family_name(text) {
            "tension-four-point" => match numbers(1.0)? {
                all if all.len() == 1 => Ok(Self::Tension(Tension::FourPoint(all[0]))),
                all => Ok(Self::Local(all)),
            },
            "tension-ternary-four-point" => {
                one(2.0).map(|tension| Self::Tension(Tension::TernaryFourPoint(tension)))
            }
            "non-uniform-four-point" => one(0.5).map(Self::NonUniform),
            _ => source.mask().map(Self::Stationary),
        }
    }

    /// Its mask, if it has one.
    pub fn mask(&self) -> Option<&Mask> {
        match self {
            Self::Stationary(mask) => Some(mask),
            _ => None,
        }
    }

    /// A polygon after some steps.
    ///
    /// # Errors
    /// As the library's refinements.
    pub fn refine<T: Coordinate>(
        &self,
        context: &Context,
        polygon: &Polygon<T>,
        steps: u32,
    ) -> Made<Polygon<T>> {
        match self {
            Self::Stationary(mask) => polygon.refine(context, mask, steps),
            Self::Tension(tension) => polygon.refine_with_tension(context, *tension, steps),
            Self::Local(tensions) => polygon.refine_with_local_tension(context, tensions, steps),
            Self::NonUniform(power) => {
                polygon.refine_non_uniform(context, &polygon.parameters(*power)?, steps)
            }
        }
    }

    /// The points of the limit that belong to a polygon's; none where there is no mask, or it is
    /// not proved to converge.
    ///
    /// # Errors
    /// As [`Polygon::limit`].
    pub fn limit<T: Coordinate>(
        &self,
        context: &Context,
        polygon: &Polygon<T>,
    ) -> Made<Option<Polygon<T>>> {
        /// Powers that a proof of convergence may take.
        const LONGEST: u32 = 12;
        let Some(mask) = self.mask() else { return Ok(None) };
        if contractivity(context, mask, 0, LONGEST)?.is_none() {
            return Ok(None);
        }
        match polygon.limit(context, mask, 0) {
            Err(e) if e.kind() == ErrorKind::Unsupported => Ok(None),
            limit => limit.map(Some),
        }
    }
}

/// The numbers behind a name.
fn numbers(text: &str) -> Made<Vec<f64>> {
    let list = text.split_once(':').map_or("", |(_, list)| list);
    let fields = list.split(',').filter(|_| !list.trim().is_empty());
    let number = |field: &str| match field.trim().parse::<f64>() {
        Ok(value) => Ok(value),
        Err(_) => rational::parse(field).map(|value| rational::to_f64(&value)),
    };
    fields.map(number).collect()
}
