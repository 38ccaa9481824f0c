//! What can be asked for on the command line.

mod analyse;
mod crease;
mod curve;
mod mask;
mod names;
mod owners;
mod scheme;
mod stencils;
mod tessellate;
mod view;

pub use analyse::AnalyseArgs;
pub use crease::CreaseArgs;
pub use curve::{CurveArgs, CurveFormat, CurveNumbers, PolygonFormat};
pub use mask::{MaskArgs, MaskSource, check_name};
pub use scheme::{Chosen, SchemeArgs};
pub use stencils::{MatrixFormat, StencilArgs};
pub use tessellate::TessellateArgs;
pub use view::ViewArgs;

use crate::{exit, memory};
use carvel::io::{Encoding, Format, Precision, SchemeTags};
use carvel::mesh::NonManifold;
use carvel::scheme::SplitKind;
use clap::{Args, Parser, Subcommand, ValueEnum};
use std::path::PathBuf;

/// Subdivision surfaces: control meshes in, smooth surfaces out.
#[derive(Debug, Parser)]
#[command(name = "carvel", version, after_help = exit::HELP)]
pub struct Cli {
    /// What to do.
    #[command(subcommand)]
    pub command: Option<Command>,
}

/// The commands.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Refine meshes by a subdivision scheme, or convert them (--levels 0).
    Subdivide(Box<SubdivideArgs>),
    /// Cut limit surfaces into triangles within a tolerance, or short on a screen.
    Tessellate(Box<TessellateArgs>),
    /// Describe meshes: counts, topology, attributes, defects.
    Info(InfoArgs),
    /// Draw meshes as PNG pictures; several side by side, by one camera.
    Preview(PreviewArgs),
    /// Write the weights of refined vertices on control vertices as a sparse matrix.
    Stencils(Box<StencilArgs>),
    /// Say how smooth a scheme's surfaces are around extraordinary points.
    Analyse(Box<AnalyseArgs>),
    /// Refine polygons and grids by a mask of any arity; draw them.
    Curve(Box<CurveArgs>),
    /// List the schemes of curves, and draw what they do.
    Catalogue(CatalogueArgs),
}

/// Options of `carvel subdivide`.
#[derive(Debug, Args)]
#[command(after_help = exit::HELP)]
#[expect(clippy::struct_excessive_bools, reason = "one for each switch on the command line")]
pub struct SubdivideArgs {
    /// Mesh files; - is the standard input.
    #[arg(required = true, value_name = "IN")]
    pub inputs: Vec<PathBuf>,
    /// The result: a file, - for the standard output, or a directory in which
    /// the inputs' names are kept (always so for several inputs).
    #[arg(short, long, value_name = "OUT")]
    pub output: PathBuf,
    /// The number of refinement steps; 0 is a plain conversion that keeps all
    /// that the output's format can hold.
    #[arg(short, long, value_name = "N", default_value_t = 2,
          allow_negative_numbers = true, value_parser = clap::value_parser!(u32).range(0..=64))]
    pub levels: u32,
    /// The scheme and its parameters.
    #[command(flatten)]
    pub scheme: SchemeArgs,
    /// Creases besides those of the file.
    #[command(flatten)]
    pub creases: CreaseArgs,
    /// For dual schemes: the input is the result of an earlier run with a boundary;
    /// continue it.
    #[arg(long, help_heading = "Input")]
    pub anchored: bool,
    /// What to do with edges of more than two faces, faces that are turned
    /// against their neighbours, and vertices with several fans of faces.
    #[arg(long, value_enum, default_value_t, value_name = "POLICY", help_heading = "Input")]
    pub non_manifold: Policy,
    /// Where files come from and how they are written.
    #[command(flatten)]
    pub files: FileArgs,
    /// Write the faces that are holes, tagged as such, rather than leaving them out with
    /// the vertices that only they use; for catmull-clark, loop and bilinear.
    #[arg(long, help_heading = "Output")]
    pub keep_holes: bool,
    /// The number type that is computed in and written.
    #[arg(long, value_enum, default_value_t, value_name = "TYPE", help_heading = "Output")]
    pub precision: NumberType,
    /// Move the vertices of the last level to their limits on the surface.
    #[arg(long, help_heading = "Output")]
    pub limit: bool,
    /// Write the normals of the limit surface at the vertices of the last level, in place of
    /// normals that the input has; for OBJ, PLY and OFF.
    #[arg(long, help_heading = "Output")]
    pub normals: bool,
    /// Also draw the result as a PNG picture (a directory for several inputs).
    #[arg(long, value_name = "PNG", help_heading = "Picture")]
    pub preview: Option<PathBuf>,
    /// How pictures are drawn.
    #[command(flatten)]
    pub view: ViewArgs,
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

impl SubdivideArgs {
    /// Refuses options that do not go with the scheme.
    ///
    /// # Errors
    /// A usage error.
    pub fn check(&self) -> Result<(), exit::Failure> {
        let chosen = self.scheme.choose(SchemeTags::default())?;
        let sharpen = self.non_manifold == Policy::Sharpen;
        self.scheme.require_features("--non-manifold sharpen", sharpen)?;
        self.scheme.require_features("--keep-holes", self.keep_holes)?;
        self.scheme.require_features("--crease-angle", self.creases.angle().is_some())?;
        self.creases.check()?;
        if self.levels == 0 && (self.limit || self.normals) {
            let message = "--limit and --normals come after one level at least, not after a \
                           plain conversion (--levels 0)";
            return Err(exit::Failure::usage(message));
        }
        if self.anchored && chosen.scheme.split() != SplitKind::Corner {
            let message = format!("--anchored belongs to dual schemes, not to {}", chosen.name);
            return Err(exit::Failure::usage(message));
        }
        Ok(())
    }
}

/// Options about file formats.
#[derive(Debug, Args)]
pub struct FileArgs {
    /// The inputs' format (obj, off, ply, stl), whatever their extension says.
    #[arg(long, value_name = "FORMAT", help_heading = "Input")]
    pub input_format: Option<Format>,
    /// The output's format (obj, off, ply, stl), whatever its extension says.
    #[arg(long, value_name = "FORMAT", help_heading = "Output")]
    pub format: Option<Format>,
    /// Write PLY and STL as text rather than binary.
    #[arg(long, help_heading = "Output")]
    pub ascii: bool,
}

impl FileArgs {
    /// How PLY and STL are written.
    pub fn encoding(&self) -> Encoding {
        if self.ascii { Encoding::Ascii } else { Encoding::Binary }
    }
}

/// Options of `carvel info`.
#[derive(Debug, Args)]
#[command(after_help = exit::HELP)]
pub struct InfoArgs {
    /// Mesh files; - is the standard input.
    #[arg(required = true, value_name = "IN")]
    pub inputs: Vec<PathBuf>,
    /// The inputs' format (obj, off, ply, stl), whatever their extension says.
    #[arg(long, value_name = "FORMAT")]
    pub input_format: Option<Format>,
    /// Print JSON, with every defect.
    #[arg(long)]
    pub json: bool,
}

/// Options of `carvel preview`.
#[derive(Debug, Args)]
#[command(after_help = exit::HELP)]
pub struct PreviewArgs {
    /// Mesh files, drawn from left to right; - is the standard input.
    #[arg(required = true, value_name = "IN")]
    pub inputs: Vec<PathBuf>,
    /// The picture; - is the standard output.
    #[arg(short, long, value_name = "PNG")]
    pub output: PathBuf,
    /// The inputs' format (obj, off, ply, stl), whatever their extension says.
    #[arg(long, value_name = "FORMAT")]
    pub input_format: Option<Format>,
    /// Print neither notes nor progress, only errors.
    #[arg(short, long)]
    pub quiet: bool,
    /// How pictures are drawn.
    #[command(flatten)]
    pub view: ViewArgs,
}

/// Options of `carvel catalogue`.
#[derive(Debug, Args)]
#[command(after_help = exit::HELP)]
pub struct CatalogueArgs {
    /// Draw what each scheme makes of a closed and of an open polygon, as SVG or PNG.
    #[arg(long, value_name = "FILE")]
    pub plot: Option<PathBuf>,
    /// Print JSON.
    #[arg(long)]
    pub json: bool,
}

/// What to do with a mesh that is not manifold.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
pub enum Policy {
    /// Refuse it
    #[default]
    Error,
    /// Cut it open there
    Cut,
    /// Keep it, infinitely sharp there; for catmull-clark, loop and bilinear
    Sharpen,
}

impl From<Policy> for NonManifold {
    fn from(policy: Policy) -> Self {
        match policy {
            Policy::Error => Self::Error,
            Policy::Cut => Self::Cut,
            Policy::Sharpen => Self::Sharpen,
        }
    }
}

/// The number type of coordinates.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
pub enum NumberType {
    /// Single precision
    F32,
    /// Double precision
    #[default]
    F64,
}

impl NumberType {
    /// The name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::F32 => "f32",
            Self::F64 => "f64",
        }
    }
}

impl From<NumberType> for Precision {
    fn from(number: NumberType) -> Self {
        match number {
            NumberType::F32 => Self::F32,
            NumberType::F64 => Self::F64,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn the_definition_is_sound() {
        Cli::command().debug_assert();
    }
}
