//! Options of `carvel tessellate`.

use super::{CreaseArgs, FileArgs, NumberType, Policy, SchemeArgs, ViewArgs};
use crate::exit::{self, Failure};
use crate::memory;
use carvel::io::SchemeTags;
use clap::{ArgGroup, Args};
use std::path::PathBuf;

/// Options of `carvel tessellate`.
#[derive(Debug, Args)]
#[command(after_help = exit::HELP)]
#[command(group(ArgGroup::new("fineness").required(true).args(["tolerance", "relative", "pixels"])))]
pub struct TessellateArgs {
    /// Mesh files; - is the standard input.
    #[arg(required = true, value_name = "IN")]
    pub inputs: Vec<PathBuf>,
    /// The result: a file, - for the standard output, or a directory in which
    /// the inputs' names are kept (always so for several inputs).
    #[arg(short, long, value_name = "OUT")]
    pub output: PathBuf,
    /// How far the surface may be from the triangles, in the file's units.
    #[arg(
        short,
        long,
        value_name = "LENGTH",
        help_heading = "Fineness",
        allow_negative_numbers = true
    )]
    pub tolerance: Option<f64>,
    /// The same as a part of the diagonal of the control mesh's bounding box.
    #[arg(long, value_name = "PART", help_heading = "Fineness", allow_negative_numbers = true)]
    pub relative: Option<f64>,
    /// How long edges may be on the picture that the options below describe, in pixels; no
    /// picture need be drawn.
    #[arg(long, value_name = "N", help_heading = "Fineness", allow_negative_numbers = true)]
    pub pixels: Option<f64>,
    /// How often the sides of a face are halved at most.
    #[arg(long, value_name = "N", default_value_t = 20, help_heading = "Fineness",
          allow_negative_numbers = true, value_parser = clap::value_parser!(u32).range(0..=24))]
    pub max_levels: u32,
    /// The most triangles; if more are needed nothing is written.
    #[arg(long, value_name = "N", default_value_t = 100_000_000, help_heading = "Fineness")]
    pub max_triangles: u64,
    /// The scheme and its parameters.
    #[command(flatten)]
    pub scheme: SchemeArgs,
    /// Creases besides those of the file.
    #[command(flatten)]
    pub creases: CreaseArgs,
    /// Where files come from and how they are written.
    #[command(flatten)]
    pub files: FileArgs,
    /// The number type that is written.
    #[arg(long, value_enum, default_value_t, value_name = "TYPE", help_heading = "Output")]
    pub precision: NumberType,
    /// Also draw the result as a PNG picture (a directory for several inputs).
    #[arg(long, value_name = "PNG", help_heading = "Picture")]
    pub preview: Option<PathBuf>,
    /// How pictures are drawn, and what --pixels means.
    #[command(flatten)]
    pub view: ViewArgs,
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

impl TessellateArgs {
    /// Refuses options that do not go with the scheme, and lengths that are none.
    ///
    /// # Errors
    /// A usage error.
    pub fn check(&self) -> Result<(), Failure> {
        self.scheme.choose(SchemeTags::default())?;
        self.scheme.require_features("--crease-angle", self.creases.angle().is_some())?;
        self.creases.check()?;
        if self.non_manifold == Policy::Sharpen {
            let message = "--non-manifold sharpen: the surface of such a mesh is not evaluated; \
                           --non-manifold cut cuts it open";
            return Err(Failure::usage(message));
        }
        let lengths = [
            ("--tolerance", self.tolerance),
            ("--relative", self.relative),
            ("--pixels", self.pixels),
        ];
        for (option, length) in lengths {
            if let Some(length) = length.filter(|x| !(x.is_finite() && *x > 0.0)) {
                let message = format!("{option} {length}: it must be finite and above 0");
                return Err(Failure::usage(message));
            }
        }
        Ok(())
    }
}
