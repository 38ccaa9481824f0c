//! What can be asked of `carvel curve`.

use super::mask::MaskSource;
use crate::exit::Failure;
use crate::{exit, memory};
use carvel::curve::Ends;
use clap::{Args, ValueEnum};
use std::path::{Path, PathBuf};

/// Options of `carvel curve`.
#[derive(Debug, Args)]
#[command(after_help = exit::HELP)]
#[expect(clippy::struct_excessive_bools, reason = "one for each switch on the command line")]
pub struct CurveArgs {
    /// Control polygons; - is the standard input. CSV: a point in each line, of any
    /// dimension, an empty line before another polygon. OBJ: lines (l) of vertices.
    #[arg(value_name = "IN")]
    pub input: PathBuf,
    /// The result: CSV or OBJ, or a picture, SVG or PNG; - is the standard output.
    #[arg(short, long, value_name = "OUT")]
    pub output: PathBuf,
    /// The number of steps.
    #[arg(short = 'n', long, value_name = "N", default_value_t = 4,
          allow_negative_numbers = true, value_parser = clap::value_parser!(u32).range(0..=64))]
    pub steps: u32,
    /// A scheme of the catalogue with its parameters; `carvel catalogue` lists all.
    /// tension-four-point takes one tension, or one for each edge; tension-ternary-four-point
    /// one; non-uniform-four-point the power of the edges' lengths, from 0 to 1.
    #[arg(
        short,
        long,
        value_name = "NAME[:P,...]",
        default_value = "three-point:1/32",
        conflicts_with = "mask",
        help_heading = "Scheme"
    )]
    pub scheme: String,
    /// A mask by its coefficients, such as 1/4,3/4,3/4,1/4 or [1,3,3,1]/4.
    #[arg(long, value_name = "A,...", allow_hyphen_values = true, help_heading = "Scheme")]
    mask: Option<String>,
    /// New points per old one [default: 2].
    #[arg(long, value_name = "M", requires = "mask", help_heading = "Scheme")]
    arity: Option<usize>,
    /// The index of the first coefficient [default: that which centres the mask].
    #[arg(
        long,
        value_name = "K",
        requires = "mask",
        allow_negative_numbers = true,
        help_heading = "Scheme"
    )]
    offset: Option<i64>,
    /// All polygons are closed: the first point follows the last. Otherwise those of an OBJ
    /// file that come back to their first vertex are, and none of a CSV file.
    #[arg(long, conflicts_with = "open", help_heading = "Ends")]
    pub closed: bool,
    /// All polygons are open, and this is what happens at their ends [default: kept].
    #[arg(long, value_enum, value_name = "ENDS", help_heading = "Ends")]
    open: Option<OpenEnds>,
    /// The polygons, all of the same number of points, are the rows of a grid, refined in
    /// both directions; OBJ then gets faces.
    #[arg(long)]
    pub grid: bool,
    /// Move the points of the last level to the limit.
    #[arg(long)]
    pub limit: bool,
    /// The numbers that are computed with and written.
    #[arg(long, value_enum, default_value_t, value_name = "TYPE", help_heading = "Output")]
    pub precision: CurveNumbers,
    /// The input's format, whatever its extension says.
    #[arg(long, value_enum, value_name = "FORMAT", help_heading = "Input")]
    input_format: Option<PolygonFormat>,
    /// The output's format, whatever its extension says.
    #[arg(long, value_enum, value_name = "FORMAT", help_heading = "Output")]
    format: Option<CurveFormat>,
    /// Threads to use; 0 is all cores. The result does not depend on it.
    #[arg(long, value_name = "N", default_value_t = 0, help_heading = "Run")]
    pub threads: usize,
    /// The most memory to use, such as 2G; by default what the system has left.
    #[arg(long, value_name = "BYTES", value_parser = memory::parse, help_heading = "Run")]
    pub memory: Option<u64>,
    /// Print a report as JSON on the standard output (on the standard error
    /// stream, without notes, if the standard output is taken).
    #[arg(long, help_heading = "Run")]
    pub json: bool,
    /// Print neither notes nor progress nor summaries, only errors.
    #[arg(short, long, help_heading = "Run")]
    pub quiet: bool,
}

impl CurveArgs {
    /// How the mask is given.
    pub fn source(&self) -> MaskSource<'_> {
        let coefficients = self.mask.as_deref().map(|text| MaskSource::Coefficients {
            text,
            arity: self.arity.unwrap_or(2),
            offset: self.offset,
        });
        coefficients.unwrap_or(MaskSource::Named(&self.scheme))
    }

    /// The ends of a polygon that its file says to be closed, or not.
    pub fn ends(&self, closed: bool) -> Ends {
        match self.open {
            Some(OpenEnds::Dropped) => Ends::Dropped,
            Some(OpenEnds::Anchored) => Ends::Anchored,
            None if self.closed || closed => Ends::Closed,
            Some(OpenEnds::Kept) | None => Ends::Kept,
        }
    }

    /// The format of the input; CSV from a stream.
    ///
    /// # Errors
    /// A usage error if the extension is none that is known.
    pub fn input_format(&self) -> Result<PolygonFormat, Failure> {
        format(self.input_format, &self.input, PolygonFormat::Csv, "--input-format")
    }

    /// The format of the output; CSV to a stream.
    ///
    /// # Errors
    /// A usage error if the extension is none that is known.
    pub fn format(&self) -> Result<CurveFormat, Failure> {
        format(self.format, &self.output, CurveFormat::Csv, "--format")
    }
}

fn format<F: ValueEnum>(
    forced: Option<F>,
    path: &Path,
    of_stream: F,
    option: &str,
) -> Result<F, Failure> {
    if let Some(format) = forced {
        return Ok(format);
    }
    if path.as_os_str() == "-" {
        return Ok(of_stream);
    }
    let extension = path.extension().and_then(|e| e.to_str()).unwrap_or_default();
    F::from_str(extension, true).map_err(|_| {
        let names: Vec<_> = F::value_variants().iter().map(super::names::spelled).collect();
        let (path, names) = (crate::text::path_name(path), names.join(", "));
        Failure::usage(format!("{path}: the format is none of {names}; {option} chooses one"))
    })
}

/// What happens at the ends of an open polygon.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum OpenEnds {
    /// They stay where they are; for symmetric masks
    Kept,
    /// Points whose rule reaches beyond them are left out
    Dropped,
    /// They stay, half an interval from their neighbours: to go on from a dual scheme
    Anchored,
}

/// The numbers of coordinates.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
pub enum CurveNumbers {
    /// Single precision
    F32,
    /// Double precision
    #[default]
    F64,
    /// Fractions without any rounding, in and out
    Exact,
}

/// How control polygons come.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum PolygonFormat {
    /// A point in each line
    #[value(alias = "txt", alias = "dat", alias = "tsv")]
    Csv,
    /// Vertices and lines
    Obj,
}

/// How refined polygons are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum CurveFormat {
    /// A point in each line
    #[value(alias = "txt", alias = "dat")]
    Csv,
    /// Vertices and lines, or faces of a grid
    Obj,
    /// A picture: control polygon, refined polygon, points of the limit
    Svg,
    /// The same in pixels
    Png,
}

impl CurveFormat {
    /// The name on the command line.
    pub fn name(self) -> String {
        super::names::spelled(&self)
    }
}

impl CurveNumbers {
    /// The name on the command line.
    pub fn name(self) -> String {
        super::names::spelled(&self)
    }
}
