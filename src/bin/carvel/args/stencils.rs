//! What can be asked of `carvel stencils`.

use super::{CreaseArgs, NumberType, Policy, SchemeArgs};
use crate::{exit, memory};
use carvel::io::{Format, SchemeTags};
use carvel::scheme::SplitKind;
use clap::{Args, ValueEnum};
use std::path::{Path, PathBuf};

/// Options of `carvel stencils`.
#[derive(Debug, Args)]
#[command(after_help = exit::HELP)]
#[expect(clippy::struct_excessive_bools, reason = "one for each switch on the command line")]
pub struct StencilArgs {
    /// A mesh file; - is the standard input. Positions are not looked at, but for
    /// --crease-angle.
    #[arg(value_name = "IN")]
    pub input: PathBuf,
    /// The matrix: a file, or - for the standard output.
    #[arg(short, long, value_name = "OUT")]
    pub output: PathBuf,
    /// The level whose vertices are the rows; columns are the vertices of the input.
    #[arg(short, long, value_name = "N", default_value_t = 2,
          allow_negative_numbers = true, value_parser = clap::value_parser!(u32).range(0..=64))]
    pub levels: u32,
    /// The scheme and its parameters.
    #[command(flatten)]
    pub scheme: SchemeArgs,
    /// Creases besides those of the file.
    #[command(flatten)]
    pub creases: CreaseArgs,
    /// Only the last of the steps: columns are the vertices of the level before.
    #[arg(long, help_heading = "Matrix")]
    pub step: bool,
    /// Linear rows, for data that varies linearly; for primal schemes.
    #[arg(long, help_heading = "Matrix")]
    pub varying: bool,
    /// Rows for these vertices of the level only, counted from 0, in this order.
    #[arg(long, value_name = "V,...", value_delimiter = ',', help_heading = "Matrix")]
    pub vertices: Option<Vec<u32>>,
    /// The number type of the weights, which are computed in double precision.
    #[arg(long, value_enum, default_value_t, value_name = "TYPE", help_heading = "Matrix")]
    pub precision: NumberType,
    /// The output's format, whatever its extension says.
    #[arg(long, value_enum, value_name = "FORMAT", help_heading = "Matrix")]
    pub format: Option<MatrixFormat>,
    /// The input's format (obj, off, ply, stl), whatever its extension says.
    #[arg(long, value_name = "FORMAT", help_heading = "Input")]
    pub input_format: Option<Format>,
    /// For dual schemes: the input is the result of an earlier run with a boundary;
    /// continue it.
    #[arg(long, help_heading = "Input")]
    pub anchored: bool,
    /// What to do with edges of more than two faces, faces that are turned
    /// against their neighbours, and vertices with several fans of faces.
    #[arg(long, value_enum, default_value_t, value_name = "POLICY", help_heading = "Input")]
    pub non_manifold: Policy,
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

/// How a matrix is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum MatrixFormat {
    /// A compressed sparse row matrix for scipy.sparse.load_npz
    Npz,
    /// Matrix Market text, coordinates counted from 1
    Mtx,
    /// The library's own file, with a checksum
    Carvel,
}

impl MatrixFormat {
    /// The name on the command line, which is the extension.
    pub fn name(self) -> &'static str {
        match self {
            Self::Npz => "npz",
            Self::Mtx => "mtx",
            Self::Carvel => "carvel",
        }
    }

    fn of(path: &Path) -> Option<Self> {
        let extension = path.extension()?;
        let all = [Self::Npz, Self::Mtx, Self::Carvel];
        all.into_iter().find(|format| extension.eq_ignore_ascii_case(format.name()))
    }
}

impl StencilArgs {
    /// Refuses options that do not go with the scheme, and an output of no known format.
    ///
    /// # Errors
    /// A usage error.
    pub fn check(&self) -> Result<MatrixFormat, exit::Failure> {
        let chosen = self.scheme.choose(SchemeTags::default())?;
        let sharpen = self.non_manifold == Policy::Sharpen;
        self.scheme.require_features("--non-manifold sharpen", sharpen)?;
        self.scheme.require_features("--crease-angle", self.creases.angle().is_some())?;
        self.creases.check()?;
        let dual = chosen.scheme.split() == SplitKind::Corner;
        let name = &chosen.name;
        if self.anchored && !dual {
            let message = format!("--anchored belongs to dual schemes, not to {name}");
            return Err(exit::Failure::usage(message));
        }
        if self.varying && dual {
            let message = format!("--varying belongs to primal schemes, not to {name}");
            return Err(exit::Failure::usage(message));
        }
        if self.step && self.levels == 0 {
            return Err(exit::Failure::usage("--step: no step leads to level 0"));
        }
        self.format.or_else(|| MatrixFormat::of(&self.output)).ok_or_else(|| {
            let output = crate::text::path_name(&self.output);
            let message =
                format!("{output}: matrices are npz, mtx or carvel; --format chooses one");
            exit::Failure::usage(message)
        })
    }
}
