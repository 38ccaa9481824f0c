//! The catalogue: families of schemes with names, authors, parameters and masks.
//!
//! A family's mask is made from its formula; nothing is listed coefficient by coefficient.
//! What is known about a family, exactly, is computed by `analysis`. How sure the
//! attribution of a formula to its authors is, is said by [`Attribution`].

mod formulas;
mod table;

use super::mask::{Mask, out_of_range};
use super::rational::{self, Rational};
use crate::base::{Error, ErrorKind, Result};

pub use table::{FAMILIES, NON_STATIONARY};

/// How sure it is that the formula is the one its authors published.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Attribution {
    /// Found in textbooks and many papers.
    Textbook,
    /// Derived from a published definition.
    Derived,
    /// From memory; the paper was not at hand.
    Memory,
    /// Put together from special cases that are sure; the published formula was not seen
    /// and may have further parameters.
    Reconstructed,
}

impl Attribution {
    /// `textbook`, `derived`, `memory` or `reconstructed`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Textbook => "textbook",
            Self::Derived => "derived",
            Self::Memory => "memory",
            Self::Reconstructed => "reconstructed",
        }
    }
}

/// A parameter of a family.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Parameter {
    /// Its name.
    pub name: &'static str,
    /// What it does and which values make sense.
    pub range: &'static str,
    /// The value that is taken if none is given; a number as [`rational::parse`] reads it.
    pub default: &'static str,
    /// True if the mask is a polynomial of degree 1 in it, and any rational is a value.
    pub is_free: bool,
}

/// A family of stationary schemes.
#[derive(Debug, Clone, Copy)]
pub struct Family {
    /// The name, lower case with hyphens.
    pub name: &'static str,
    /// One line about it.
    pub summary: &'static str,
    /// The authors.
    pub authors: &'static str,
    /// The year of publication.
    pub year: &'static str,
    /// The formula of the mask or its symbol.
    pub formula: &'static str,
    /// The parameters, in the order in which they are given.
    pub parameters: &'static [Parameter],
    /// How sure the attribution is.
    pub attribution: Attribution,
    make: fn(&[Rational]) -> Result<Mask>,
}

/// A family whose rules change from level to level or from edge to edge.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct NonStationary {
    /// The name, lower case with hyphens.
    pub name: &'static str,
    /// One line about it.
    pub summary: &'static str,
    /// The authors.
    pub authors: &'static str,
    /// The year of publication.
    pub year: &'static str,
    /// The formula of the rules.
    pub formula: &'static str,
    /// How sure the attribution is.
    pub attribution: Attribution,
    /// The stationary scheme it becomes or equals where nothing changes, as [`mask`] reads it.
    pub limit: &'static str,
}

impl Family {
    /// The mask for some parameters; for those that are missing the defaults.
    ///
    /// # Errors
    /// [`ErrorKind::ParameterOutOfRange`] for too many parameters, or one that the formula
    /// has no mask for; [`ErrorKind::TooLarge`] for a mask of more than 1024 coefficients.
    pub fn mask(&self, parameters: &[Rational]) -> Result<Mask> {
        (self.make)(&self.completed(parameters)?)
    }

    /// The parameters given, and the defaults of the others.
    fn completed(&self, parameters: &[Rational]) -> Result<Vec<Rational>> {
        if parameters.len() > self.parameters.len() {
            let (given, most) = (parameters.len(), self.parameters.len());
            return Err(out_of_range(format!(
                "too many parameters, {given}: {} has {most}",
                self.name
            )));
        }
        let missing = &self.parameters[parameters.len()..];
        let defaults = missing.iter().map(|parameter| rational::parse(parameter.default));
        let all = parameters.iter().cloned().map(Ok).chain(defaults);
        all.collect()
    }
}

/// The family of a name.
///
/// # Errors
/// [`ErrorKind::InvalidText`] if there is none.
pub fn family(name: &str) -> Result<&'static Family> {
    FAMILIES.iter().find(|family| family.name == name).ok_or_else(|| {
        let shown: String = name.chars().take(40).collect();
        let message = format!("there is no scheme '{shown}' in the catalogue");
        Error::new(ErrorKind::InvalidText, message)
    })
}

/// The mask of a name with parameters, such as `chaikin`, `three-point:1/32` or
/// `b-spline:3,2`.
///
/// # Errors
/// [`ErrorKind::InvalidText`] for an unknown name; as [`rational::parse`] for what is no number;
/// as [`Family::mask`].
pub fn mask(text: &str) -> Result<Mask> {
    let (family, parameters) = parse(text)?;
    family.mask(&parameters)
}

/// The family of a name and all its parameters, defaults for those that are not given.
///
/// # Errors
/// [`ErrorKind::InvalidText`] for an unknown name or what is no number;
/// [`ErrorKind::ParameterOutOfRange`] for too many parameters.
pub fn parse(text: &str) -> Result<(&'static Family, Vec<Rational>)> {
    let (name, parameters) = text.trim().split_once(':').unwrap_or((text.trim(), ""));
    let family = family(name)?;
    let given = parameters.split(',').filter(|_| !parameters.trim().is_empty());
    // One more than any family has is enough to be refused.
    let values = given.take(8).map(rational::parse).collect::<Result<Vec<_>>>()?;
    Ok((family, family.completed(&values)?))
}
