//! A mask of curves and grids, given by its coefficients or its name.

use crate::exit::{Doing, Failure};
use carvel::analysis::mask::AffineFamily;
use carvel::curve::catalogue::{FAMILIES, NON_STATIONARY};
use carvel::curve::rational::ratio;
use carvel::curve::{Mask, Rational, catalogue, rational};
use clap::Args;

/// How a mask is given.
#[derive(Debug, Clone, Copy)]
pub enum MaskSource<'a> {
    /// Its coefficients.
    Coefficients {
        /// As typed.
        text: &'a str,
        /// New points per old one.
        arity: usize,
        /// The index of the first coefficient, unless the mask is centred.
        offset: Option<i64>,
    },
    /// A name of the catalogue, with parameters.
    Named(&'a str),
}

impl MaskSource<'_> {
    /// The mask.
    ///
    /// # Errors
    /// A usage error: no mask, no name of the catalogue, a parameter out of range.
    pub fn mask(self) -> Result<Mask, Failure> {
        let mask = match self {
            Self::Coefficients { text, arity, offset } => Mask::parse(text, arity, offset),
            Self::Named(name) => {
                check_name(name)?;
                check_mask(name)?;
                catalogue::mask(name)
            }
        };
        mask.map_err(|e| Failure::from_error(&e, Doing::Asking))
    }

    /// The family of the name with one parameter left open.
    ///
    /// # Errors
    /// A usage error: no name, or a parameter that the family does not have or that counts
    /// something.
    pub fn family(self, parameter: &str) -> Result<AffineFamily, Failure> {
        let Self::Named(name) = self else {
            return Err(Failure::usage(
                "--range needs a name of the catalogue, such as four-point",
            ));
        };
        check_name(name)?;
        check_mask(name)?;
        let asking = |e: carvel::Error| Failure::from_error(&e, Doing::Asking);
        let (family, parameters) = catalogue::parse(name).map_err(asking)?;
        let Some(index) = family.parameters.iter().position(|p| p.name == parameter) else {
            let names: Vec<_> = family.parameters.iter().map(|p| p.name).collect();
            let there = if names.is_empty() { "none".to_owned() } else { names.join(", ") };
            let parameter = crate::text::one_line(parameter);
            let name = family.name;
            let message = format!("{name} has no parameter '{parameter}'; its parameters: {there}");
            return Err(Failure::usage(message));
        };
        if !family.parameters[index].is_free {
            let message =
                format!("{parameter} of {} counts something: --range has no use", family.name);
            return Err(Failure::usage(message));
        }
        AffineFamily::of(family, &parameters, index).map_err(asking)
    }
}

/// Refuses the name of a scheme whose rules change.
fn check_mask(text: &str) -> Result<(), Failure> {
    let Some(found) = NON_STATIONARY.iter().find(|family| family.name == family_name(text)) else {
        return Ok(());
    };
    let (name, limit) = (found.name, found.limit);
    Err(Failure::usage(format!("the rules of {name} change: it has no mask; {limit} is near it")))
}

/// The names of the catalogue.
fn all_names() -> impl Iterator<Item = &'static str> {
    let stationary = FAMILIES.iter().map(|family| family.name);
    stationary.chain(NON_STATIONARY.iter().map(|family| family.name))
}

/// True if a text names a family of the catalogue, with or without parameters.
pub(super) fn is_family(text: &str) -> bool {
    all_names().any(|known| known == family_name(text))
}

/// The name of the catalogue that is nearest to a text, if it may have been meant.
pub(super) fn near(text: &str) -> Option<&'static str> {
    /// What clap takes to be a typing error.
    const NEAR: f64 = 0.7;
    let likeness = |known: &&str| strsim::jaro(family_name(text), known);
    let near = all_names().max_by(|a, b| likeness(a).total_cmp(&likeness(b)));
    near.filter(|known| likeness(known) > NEAR)
}

/// What stands before the parameters.
pub(super) fn family_name(text: &str) -> &str {
    text.split_once(':').map_or(text, |(name, _)| name).trim()
}

/// Refuses a name that the catalogue does not have, and says which one is near it.
///
/// # Errors
/// A usage error.
pub fn check_name(text: &str) -> Result<(), Failure> {
    if is_family(text) {
        return Ok(());
    }
    let all = || "carvel catalogue lists all".to_owned();
    let advice = near(text).map_or_else(all, |near| format!("'{near}' is near it"));
    let shown: String = family_name(text).chars().take(40).collect();
    let shown = crate::text::one_line(&shown);
    Err(Failure::usage(format!("there is no scheme '{shown}' in the catalogue; {advice}")))
}

/// What `analyse` is asked about a mask.
#[derive(Debug, Args)]
#[command(next_help_heading = "Mask of curves and grids")]
pub struct MaskArgs {
    /// Analyse a mask of the catalogue with its parameters, such as three-point:1/32, rather
    /// than a scheme on meshes; `carvel catalogue` lists all. --scheme takes it too, unless a
    /// scheme on meshes has the same name.
    #[arg(long, value_name = "NAME[:P,...]",
          conflicts_with_all = ["name", "scheme", "mask", "valence", "feature"])]
    pub curve: Option<String>,
    /// New points per old one [default: 2].
    #[arg(long, value_name = "M", requires = "mask")]
    pub arity: Option<usize>,
    /// The index of the first coefficient [default: that which centres the mask].
    #[arg(long, value_name = "K", requires = "mask", allow_negative_numbers = true)]
    pub offset: Option<i64>,
    /// With a name: the values of a parameter for which the schemes are C^0, C^1, ...
    #[arg(long, value_name = "PARAMETER")]
    pub range: Option<String>,
    /// Where --range looks.
    #[arg(long, value_name = "LOW..HIGH", requires = "range", default_value = "-1..1",
          allow_hyphen_values = true, value_parser = interval)]
    pub within: [Rational; 2],
}

/// Two numbers such as -1/2..0.3.
fn interval(text: &str) -> Result<[Rational; 2], String> {
    /// Far beyond any value for which schemes converge; the first look has 33 values.
    const MOST: i64 = 1_000_000;
    let (low, high) = text.split_once("..").ok_or("two numbers such as -1/2..0.3 are meant")?;
    let number = |text: &str| rational::parse(text).map_err(|e| e.to_string());
    let [low, high] = [number(low)?, number(high)?];
    let most = ratio(MOST, 1);
    if low < -&most || high > most {
        return Err(format!("{MOST} is the largest end of a search"));
    }
    if low >= high {
        return Err(format!("{low}..{high} is empty: the smaller number comes first"));
    }
    Ok([low, high])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn intervals_are_two_numbers() {
        assert_eq!(interval("-1/2..0.25"), Ok([ratio(-1, 2), ratio(1, 4)]));
        for text in ["", "..", "1", "1..", "a..b", "0..1/0", "1..0", "1/2..0.5", "0..1e7"] {
            assert!(interval(text).is_err(), "{text}");
        }
    }

    #[test]
    fn a_name_nearby_is_offered() {
        let said = |text: &str| check_name(text).unwrap_err().message;
        assert!(said("chakin").ends_with("'chaikin' is near it"), "{}", said("chakin"));
        assert!(said("fourpoint:1/16").ends_with("'four-point' is near it"));
        assert!(said("?").ends_with("lists all"));
        assert!(check_name("tension-four-point:1").is_ok() && check_name(" chaikin ").is_ok());
    }
}
