//! The scheme: a name, the parameters that belong to it, and nothing else.

use crate::exit::{Doing, Failure};
use carvel::{Boundary, CornerRule, Fraction, Scheme};
use clap::{Args, ValueEnum};
use std::str::FromStr;

/// Options that choose a scheme.
#[derive(Debug, Args)]
#[command(next_help_heading = "Scheme")]
pub struct SchemeArgs {
    /// The scheme.
    #[arg(short, long, value_enum, default_value_t, value_name = "NAME")]
    scheme: Name,
    /// For three-point: the parameter w, from 0 to 1/16 [default: 1/32].
    #[arg(long, value_name = "W", allow_hyphen_values = true)]
    w: Option<Fraction>,
    /// For bspline: the degree, an even number from 2 to 64.
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    degree: Option<u32>,
    /// For averaging: the split [default: dual].
    #[arg(long, value_enum, value_name = "SPLIT")]
    split: Option<Split>,
    /// For averaging: the smoothing passes, such as 1/2,0 or "" [default: none].
    #[arg(long, value_name = "T,...", allow_hyphen_values = true)]
    passes: Option<Passes>,
    /// How corners of faces that are no quads are cut.
    #[arg(long, value_enum, default_value_t, value_name = "RULE")]
    corner_rule: Rule,
    /// What happens along boundaries.
    #[arg(long, value_enum, default_value_t, value_name = "MODE")]
    boundary: Edges,
}

/// The names of schemes.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
enum Name {
    /// The three-point family; w = 1/32 is C2, w = 0 Doo-Sabin, w = 1/16 quartic
    #[default]
    ThreePoint,
    /// Doo and Sabin's biquadratic B-splines
    DooSabin,
    /// Biquartic B-splines
    Quartic,
    /// Tensor-product B-splines of an even --degree
    Bspline,
    /// A --split followed by smoothing --passes
    Averaging,
}

/// How faces are split.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Split {
    /// A vertex for every corner of a face
    Dual,
    /// A quad for every corner of a face
    Primal,
}

/// Corner operators.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
enum Rule {
    /// Doo and Sabin's cosine weights
    #[default]
    Cosine,
    /// Mean of vertex, edge midpoints and centroid
    Average,
}

/// Boundary rules.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
enum Edges {
    /// Nothing is added: the surface ends inside the boundary
    None,
    /// The boundary becomes the curve of its polygon
    Edge,
    /// Likewise, and vertices of a single face stay
    #[default]
    EdgeCorner,
}

/// A list of passes in one argument.
#[derive(Debug, Clone, PartialEq, Eq)]
struct Passes(Vec<Fraction>);

impl FromStr for Passes {
    type Err = carvel::Error;

    fn from_str(text: &str) -> carvel::Result<Self> {
        if text.trim().is_empty() {
            return Ok(Self(Vec::new()));
        }
        text.split(',').map(str::parse).collect::<carvel::Result<_>>().map(Self)
    }
}

/// A scheme and what it is called.
#[derive(Debug, Clone)]
pub struct Chosen {
    /// The name on the command line.
    pub name: &'static str,
    /// The scheme.
    pub scheme: Scheme,
    /// The corner rule on the command line.
    pub rule: &'static str,
    /// The boundary rule on the command line.
    pub boundary: &'static str,
}

impl SchemeArgs {
    /// The scheme asked for.
    ///
    /// # Errors
    /// A usage error for an option of another scheme, a missing one, or a value
    /// out of range.
    pub fn choose(&self) -> Result<Chosen, Failure> {
        self.refuse_strangers()?;
        let scheme = self.preset()?.with_rule(self.rule()).with_boundary(self.boundary());
        Ok(Chosen {
            name: self.scheme.name(),
            scheme,
            rule: match self.corner_rule {
                Rule::Cosine => "cosine",
                Rule::Average => "average",
            },
            boundary: match self.boundary {
                Edges::None => "none",
                Edges::Edge => "edge",
                Edges::EdgeCorner => "edge-corner",
            },
        })
    }

    /// Refuses options that belong to another scheme.
    fn refuse_strangers(&self) -> Result<(), Failure> {
        let options = [
            ("--w", self.w.is_some(), Name::ThreePoint),
            ("--degree", self.degree.is_some(), Name::Bspline),
            ("--split", self.split.is_some(), Name::Averaging),
            ("--passes", self.passes.is_some(), Name::Averaging),
        ];
        let stranger = options.iter().find(|(_, given, of)| *given && *of != self.scheme);
        stranger.map_or(Ok(()), |(option, _, of)| {
            let (of, scheme) = (of.name(), self.scheme.name());
            let message = format!("{option} belongs to --scheme {of}, not to {scheme}");
            Err(Failure::usage(message))
        })
    }

    fn preset(&self) -> Result<Scheme, Failure> {
        let scheme = match self.scheme {
            Name::ThreePoint => match self.w {
                Some(w) => Scheme::three_point(w),
                None => Fraction::new(1, 32).and_then(Scheme::three_point),
            },
            Name::DooSabin => Ok(Scheme::doo_sabin()),
            Name::Quartic => Ok(Scheme::quartic()),
            Name::Bspline => Scheme::b_spline(self.degree()?),
            Name::Averaging => Scheme::dual(self.dual_passes()?),
        };
        scheme.map_err(|e| Failure::from_error(&e, Doing::Asking))
    }

    fn degree(&self) -> Result<u32, Failure> {
        let message = "--scheme bspline needs --degree, an even number from 2 to 64";
        self.degree.ok_or_else(|| Failure::usage(message))
    }

    fn dual_passes(&self) -> Result<&[Fraction], Failure> {
        if self.split == Some(Split::Primal) {
            return Err(Failure::usage("--split primal is not available yet; dual is"));
        }
        Ok(self.passes.as_ref().map_or(&[], |passes| &passes.0))
    }

    fn rule(&self) -> CornerRule {
        match self.corner_rule {
            Rule::Cosine => CornerRule::Cosine,
            Rule::Average => CornerRule::Average,
        }
    }

    fn boundary(&self) -> Boundary {
        match self.boundary {
            Edges::None => Boundary::None,
            Edges::Edge => Boundary::Edge,
            Edges::EdgeCorner => Boundary::EdgeAndCorner,
        }
    }
}

impl Name {
    fn name(self) -> &'static str {
        match self {
            Self::ThreePoint => "three-point",
            Self::DooSabin => "doo-sabin",
            Self::Quartic => "quartic",
            Self::Bspline => "bspline",
            Self::Averaging => "averaging",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn passes_are_a_list_that_may_be_empty() {
        let fraction = |n, d| Fraction::new(n, d).unwrap();
        for (text, passes) in [
            ("", vec![]),
            (" ", vec![]),
            ("1/2,0", vec![fraction(1, 2), Fraction::ZERO]),
            ("-1/2, 0.25", vec![fraction(-1, 2), fraction(1, 4)]),
        ] {
            assert_eq!(text.parse::<Passes>().unwrap().0, passes, "{text}");
        }
        for text in [",", "1/2,", "1/0", "a", "1;2"] {
            assert!(text.parse::<Passes>().is_err(), "{text}");
        }
    }
}
