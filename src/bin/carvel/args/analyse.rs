//! What can be asked of `carvel analyse`.

use super::mask::MaskSource;
use super::names::{SchemeName, SchemeParser};
use super::{MaskArgs, SchemeArgs};
use crate::exit;
use carvel::analysis::surface::Feature;
use clap::{Args, ValueEnum};
use std::path::PathBuf;
use std::str::FromStr;

/// Options of `carvel analyse`.
#[derive(Debug, Args)]
#[command(after_help = exit::HELP)]
pub struct AnalyseArgs {
    /// The scheme; the same as --scheme.
    #[arg(value_parser = SchemeParser, value_name = "SCHEME",
          conflicts_with_all = ["scheme", "mask"])]
    name: Option<SchemeName>,
    /// Faces around a vertex, or sides of a face: numbers and ranges such as 3..8,12
    /// [default: 3..12].
    #[arg(long, value_name = "N,...", conflicts_with = "mask")]
    valence: Option<Valences>,
    /// Where [default: interior].
    #[arg(long, value_enum, value_name = "FEATURE", conflicts_with = "mask")]
    feature: Option<FeatureName>,
    /// The scheme and its parameters.
    #[command(flatten)]
    scheme: SchemeArgs,
    /// A mask of curves and grids rather than a scheme.
    #[command(flatten)]
    pub mask: MaskArgs,
    /// Also draw, as SVG or PNG: eigenvalues, natural configuration and characteristic map for
    /// each valence; of a mask the limit function, its derivatives, frequencies and the ranges.
    #[arg(long, value_name = "FILE")]
    pub plot: Option<PathBuf>,
    /// Print JSON, with all eigenvalues and the weights of limits and tangents.
    #[arg(long, help_heading = "Run")]
    pub json: bool,
    /// Print neither notes nor progress, only the table and errors.
    #[arg(short, long, help_heading = "Run")]
    pub quiet: bool,
}

impl AnalyseArgs {
    /// The scheme.
    ///
    /// # Errors
    /// A usage error, as of other commands; no scheme or two.
    pub fn choose(&self) -> Result<super::Chosen, exit::Failure> {
        self.scheme.choose_named(self.name.as_ref())
    }

    /// Prints the table, unless the plot has the standard output.
    ///
    /// # Errors
    /// An output error.
    pub fn print(&self, text: &str) -> Result<exit::Exit, exit::Failure> {
        if self.plot.as_deref().is_some_and(crate::places::is_stream) {
            return Ok(exit::Exit::Success);
        }
        crate::report::print(text)
    }

    /// Numbers of faces.
    pub fn valences(&self) -> Vec<usize> {
        self.valence.as_ref().map_or_else(|| (3..=12).collect(), |valence| valence.0.clone())
    }

    /// Where.
    pub fn feature(&self) -> FeatureName {
        self.feature.unwrap_or_default()
    }

    /// The mask, if one is asked for rather than a scheme on meshes.
    ///
    /// # Errors
    /// A usage error for an option of the other kind.
    pub fn mask_source(&self) -> Result<Option<MaskSource<'_>>, exit::Failure> {
        let MaskArgs { curve, arity, offset, range, .. } = &self.mask;
        let positional = match &self.name {
            Some(SchemeName::Mask(text)) => Some(text.as_str()),
            _ => None,
        };
        let coefficients = self.scheme.mask.as_deref().map(|text| MaskSource::Coefficients {
            text,
            arity: arity.unwrap_or(2),
            offset: *offset,
        });
        let named = curve.as_deref().or(positional).or(self.scheme.named_mask());
        // A name of both is that of the curve where only curves have what is asked.
        let both = range.as_ref().and_then(|_| self.scheme.curve_of(self.name.as_ref()));
        let source = coefficients.or(named.or(both).map(MaskSource::Named));
        if source.is_none() && range.is_some() {
            let message = "--range needs a name of the catalogue, such as --scheme four-point";
            return Err(exit::Failure::usage(message));
        }
        let of_meshes =
            self.valence.is_some() || self.feature.is_some() || self.scheme.has_options();
        if source.is_some() && of_meshes {
            let message =
                "valence, feature and options of schemes on meshes mean nothing to a mask";
            return Err(exit::Failure::usage(message));
        }
        Ok(source)
    }
}

/// A kind of place where the surface is not regular.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
pub enum FeatureName {
    /// A vertex or face inside the mesh
    #[default]
    Interior,
    /// A vertex on the boundary with so many faces
    Boundary,
    /// A vertex on the boundary that is interpolated
    Corner,
    /// Two creases that meet, with half of the faces on either side; for catmull-clark, loop
    Crease,
    /// A crease that ends; for catmull-clark and loop
    Dart,
}

impl FeatureName {
    /// The feature with so many faces.
    pub fn of(self, faces: usize) -> Feature {
        match self {
            Self::Interior => Feature::Interior { valence: faces },
            Self::Boundary => Feature::Boundary { faces },
            Self::Corner => Feature::Corner { faces },
            Self::Crease => Feature::Crease { faces: [faces / 2, faces - faces / 2] },
            Self::Dart => Feature::Dart { valence: faces },
        }
    }
}

/// Numbers of faces, ascending.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Valences(pub Vec<usize>);

impl FromStr for Valences {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        /// No feature with more is analysed.
        const MOST: usize = 512;
        let number = |text: &str| -> Result<usize, String> {
            let wrong = |_| format!("`{text}` is no number; such as 5, 3..8 or 3..8,12 is meant");
            text.trim().parse().map_err(wrong)
        };
        let mut list = Vec::new();
        for part in text.split(',') {
            let (first, last) = match part.split_once("..") {
                Some((first, last)) => (number(first)?, number(last.trim_start_matches('='))?),
                None => (number(part)?, number(part)?),
            };
            if first > last {
                return Err(format!("{first}..{last} is empty: the smaller number comes first"));
            }
            if last > MOST {
                return Err(format!("{last}: up to {MOST} faces are analysed"));
            }
            list.extend(first..=last);
        }
        list.sort_unstable();
        list.dedup();
        Ok(Self(list))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn valences_are_numbers_and_ranges() {
        for (text, list) in [
            ("5", vec![5]),
            ("3..5", vec![3, 4, 5]),
            ("12, 3..4,4..5", vec![3, 4, 5, 12]),
            ("3..=4", vec![3, 4]),
        ] {
            assert_eq!(text.parse::<Valences>().unwrap().0, list, "{text}");
        }
        for text in ["", ",", "5..3", "a", "3..", "1..1000000000000", "-1", "3..4..5"] {
            assert!(text.parse::<Valences>().is_err(), "{text}");
        }
    }
}
