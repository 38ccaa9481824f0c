//! A mask of curves and grids, given by its coefficients or its name.

use crate::exit::{Doing, Failure};
use carvel::analysis::mask::AffineFamily;
use carvel::curve::{Mask, Rational, catalogue, rational};
use clap::Args;

/// Options that choose a mask.
#[derive(Debug, Args)]
#[command(next_help_heading = "Mask of curves and grids")]
pub struct MaskArgs {
    /// Analyse a mask rather than a scheme on meshes: its coefficients, such as
    /// 1/4,3/4,3/4,1/4.
    #[arg(long, value_name = "A,...", allow_hyphen_values = true,
          conflicts_with_all = ["curve", "name", "scheme", "valence", "feature"])]
    mask: Option<String>,
    /// The same for a mask of the catalogue with its parameters, such as three-point:1/32;
    /// `carvel catalogue` lists all.
    #[arg(long, value_name = "NAME[:P,...]",
          conflicts_with_all = ["name", "scheme", "valence", "feature"])]
    curve: Option<String>,
    /// New points per old one [default: 2].
    #[arg(long, value_name = "M", requires = "mask")]
    arity: Option<usize>,
    /// The index of the first coefficient [default: that which centres the mask].
    #[arg(long, value_name = "K", requires = "mask", allow_negative_numbers = true)]
    offset: Option<i64>,
    /// With --curve: the values of a parameter for which the schemes are C^0, C^1, ...
    #[arg(long, value_name = "PARAMETER", requires = "curve")]
    pub range: Option<String>,
    /// Where --range looks.
    #[arg(long, value_name = "LOW..HIGH", requires = "range", default_value = "-1..1",
          allow_hyphen_values = true, value_parser = interval)]
    pub within: [Rational; 2],
}

impl MaskArgs {
    /// True if a mask is asked for.
    pub fn is_given(&self) -> bool {
        self.mask.is_some() || self.curve.is_some()
    }

    /// The mask.
    ///
    /// # Errors
    /// A usage error: no mask, no name of the catalogue, a parameter out of range.
    pub fn choose(&self) -> Result<Mask, Failure> {
        let mask = match (&self.mask, &self.curve) {
            (Some(text), _) => Mask::parse(text, self.arity.unwrap_or(2), self.offset),
            (None, name) => catalogue::mask(name.as_deref().unwrap_or_default()),
        };
        mask.map_err(|e| Failure::from_error(&e, Doing::Asking))
    }

    /// The family whose parameter is left open by --range.
    ///
    /// # Errors
    /// A usage error: a parameter that the family does not have, or that counts something.
    pub fn family(&self) -> Result<Option<AffineFamily>, Failure> {
        let (Some(parameter), Some(curve)) = (&self.range, &self.curve) else { return Ok(None) };
        let found = open_family(curve, parameter);
        found.map(Some).map_err(|e| Failure::from_error(&e, Doing::Asking))
    }
}

fn open_family(curve: &str, parameter: &str) -> carvel::Result<AffineFamily> {
    let (family, parameters) = catalogue::parse(curve)?;
    let index = family.parameters.iter().position(|p| p.name == parameter);
    // One that does not exist is refused as one that is no free one.
    AffineFamily::of(family, &parameters, index.unwrap_or(usize::MAX))
}

/// Two numbers such as -1/2..0.3.
fn interval(text: &str) -> Result<[Rational; 2], String> {
    let (low, high) = text.split_once("..").ok_or("two numbers such as -1/2..0.3 are meant")?;
    let number = |text: &str| rational::parse(text).map_err(|e| e.to_string());
    Ok([number(low)?, number(high)?])
}

#[cfg(test)]
mod tests {
    use super::*;
    use carvel::curve::rational::ratio;

    #[test]
    fn intervals_are_two_numbers() {
        assert_eq!(interval("-1/2..0.25"), Ok([ratio(-1, 2), ratio(1, 4)]));
        for text in ["", "..", "1", "1..", "a..b", "0..1/0"] {
            assert!(interval(text).is_err(), "{text}");
        }
    }
}
