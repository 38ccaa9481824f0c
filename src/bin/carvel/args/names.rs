//! The words that options take, and what they mean to the library and in files.

use carvel::io::{BoundaryTag, CreasingTag, FaceVaryingTag, TriangleTag};
use carvel::scheme::{Creasing, Extraordinary, LoopWeights, TriangleRule};
use carvel::{Boundary, CornerRule, FaceVaryingMode};
use clap::ValueEnum;
use clap::builder::{EnumValueParser, PossibleValue, TypedValueParser};
use clap::error::{ContextKind, ContextValue};
use std::ffi::OsStr;

/// The names of schemes.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
pub(super) enum Name {
    /// The three-point family; w = 1/32 is C2, w = 0 Doo-Sabin, w = 1/16 quartic
    #[default]
    ThreePoint,
    /// Doo and Sabin's biquadratic B-splines
    DooSabin,
    /// Biquartic B-splines
    Quartic,
    /// Catmull and Clark's bicubic B-splines, with creases and holes
    CatmullClark,
    /// Loop's scheme for triangles, with creases and holes
    Loop,
    /// No smoothing: midpoints of edges and means of faces
    Bilinear,
    /// Tensor-product B-splines of a --degree
    Bspline,
    /// A --split followed by smoothing --passes
    Averaging,
}

/// What may stand for a scheme.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum SchemeName {
    /// A scheme on meshes.
    Mesh(Name),
    /// A mask of the catalogue, with its parameters.
    Mask(String),
}

/// Where an error of clap keeps the name that is near.
const SUGGESTION: ContextKind = ContextKind::SuggestedValue;

/// Reads a scheme; of two with one name that on meshes.
#[derive(Debug, Clone)]
pub(super) struct SchemeParser;

impl TypedValueParser for SchemeParser {
    type Value = SchemeName;

    fn parse_ref(
        &self,
        command: &clap::Command,
        arg: Option<&clap::Arg>,
        value: &OsStr,
    ) -> Result<SchemeName, clap::Error> {
        let on_meshes = EnumValueParser::<Name>::new().parse_ref(command, arg, value);
        on_meshes.map(SchemeName::Mesh).or_else(|mut unknown| {
            let text = value.to_str().unwrap_or_default();
            if super::mask::is_family(text) {
                return Ok(SchemeName::Mask(text.to_owned()));
            }
            // clap knows the schemes on meshes alone.
            let near = super::mask::near(text).map(|name| ContextValue::String(name.to_owned()));
            if let Some(near) = near.filter(|_| unknown.get(SUGGESTION).is_none()) {
                unknown.insert(SUGGESTION, near);
            }
            Err(unknown)
        })
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        let all = Name::value_variants().iter().filter_map(ValueEnum::to_possible_value);
        Some(Box::new(all))
    }
}

/// How faces are split.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
pub(super) enum Split {
    /// A vertex for every corner of a face
    #[default]
    Dual,
    /// A quad for every corner of a face
    Primal,
}

/// Corner operators.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
pub(super) enum Rule {
    /// Doo and Sabin's cosine weights
    #[default]
    Cosine,
    /// Mean of vertex, edge midpoints and centroid
    Average,
}

/// Boundary rules.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
pub(super) enum Edges {
    /// The surface ends inside: dual schemes add nothing there, Catmull-Clark and Loop
    /// make holes of the faces at the boundary
    None,
    /// The boundary becomes the curve of its polygon
    Edge,
    /// Likewise, and vertices of a single face stay
    #[default]
    EdgeCorner,
}

/// How sharpness goes down.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
pub(super) enum Method {
    /// By 1 at every level
    #[default]
    Uniform,
    /// Likewise, and averaged along the crease
    Chaikin,
}

/// Weights beside triangles.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
pub(super) enum Triangles {
    /// Those of all other faces
    #[default]
    CatmullClark,
    /// Weights that make triangles smoother
    Smooth,
}

/// Weights at extraordinary vertices of triangles.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
pub(super) enum Beta {
    /// Loop's own
    #[default]
    Loop,
    /// Warren's, simpler
    Warren,
}

/// Weights around faces that are no quads.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
pub(super) enum Around {
    /// Those of the scheme
    #[default]
    Default,
    /// Those that keep curvature bounded and away from zero
    Tuned,
}

/// Texture coordinates along seams.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
pub(super) enum Uv {
    /// Everything smooth, corners of islands are rounded
    Smooth,
    /// Corners of islands stay
    Corners,
    /// And where three or more islands meet (the default of USD)
    #[default]
    CornersPlus1,
    /// And ends of seams and concave corners
    CornersPlus2,
    /// Outlines of islands are straight
    Boundaries,
    /// Everything is linear
    All,
}

/// What a word is on the command line.
pub(super) fn spelled(value: &impl ValueEnum) -> String {
    value.to_possible_value().map(|value| value.get_name().to_owned()).unwrap_or_default()
}

impl From<Rule> for CornerRule {
    fn from(rule: Rule) -> Self {
        match rule {
            Rule::Cosine => Self::Cosine,
            Rule::Average => Self::Average,
        }
    }
}

impl From<Edges> for Boundary {
    fn from(edges: Edges) -> Self {
        match edges {
            Edges::None => Self::None,
            Edges::Edge => Self::Edge,
            Edges::EdgeCorner => Self::EdgeAndCorner,
        }
    }
}

impl From<BoundaryTag> for Edges {
    fn from(tag: BoundaryTag) -> Self {
        match tag {
            BoundaryTag::None => Self::None,
            BoundaryTag::Edge => Self::Edge,
            BoundaryTag::EdgeAndCorner => Self::EdgeCorner,
        }
    }
}

impl From<Method> for Creasing {
    fn from(method: Method) -> Self {
        match method {
            Method::Uniform => Self::Uniform,
            Method::Chaikin => Self::Chaikin,
        }
    }
}

impl From<CreasingTag> for Method {
    fn from(tag: CreasingTag) -> Self {
        match tag {
            CreasingTag::Uniform => Self::Uniform,
            CreasingTag::Chaikin => Self::Chaikin,
        }
    }
}

impl From<Triangles> for TriangleRule {
    fn from(triangles: Triangles) -> Self {
        match triangles {
            Triangles::CatmullClark => Self::CatmullClark,
            Triangles::Smooth => Self::Smooth,
        }
    }
}

impl From<TriangleTag> for Triangles {
    fn from(tag: TriangleTag) -> Self {
        match tag {
            TriangleTag::CatmullClark => Self::CatmullClark,
            TriangleTag::Smooth => Self::Smooth,
        }
    }
}

impl From<Around> for Extraordinary {
    fn from(around: Around) -> Self {
        match around {
            Around::Default => Self::Default,
            Around::Tuned => Self::Tuned,
        }
    }
}

impl From<Beta> for LoopWeights {
    fn from(beta: Beta) -> Self {
        match beta {
            Beta::Loop => Self::Loop,
            Beta::Warren => Self::Warren,
        }
    }
}

impl From<Uv> for FaceVaryingMode {
    fn from(uv: Uv) -> Self {
        match uv {
            Uv::Smooth => Self::Smooth,
            Uv::Corners => Self::Corners,
            Uv::CornersPlus1 => Self::CornersPlus1,
            Uv::CornersPlus2 => Self::CornersPlus2,
            Uv::Boundaries => Self::Boundaries,
            Uv::All => Self::All,
        }
    }
}

impl From<FaceVaryingTag> for Uv {
    fn from(tag: FaceVaryingTag) -> Self {
        match tag {
            FaceVaryingTag::None => Self::Smooth,
            FaceVaryingTag::CornersOnly => Self::Corners,
            FaceVaryingTag::CornersPlus1 => Self::CornersPlus1,
            FaceVaryingTag::CornersPlus2 => Self::CornersPlus2,
            FaceVaryingTag::Boundaries => Self::Boundaries,
            FaceVaryingTag::All => Self::All,
        }
    }
}

impl From<Edges> for BoundaryTag {
    fn from(edges: Edges) -> Self {
        match edges {
            Edges::None => Self::None,
            Edges::Edge => Self::Edge,
            Edges::EdgeCorner => Self::EdgeAndCorner,
        }
    }
}

impl From<Method> for CreasingTag {
    fn from(method: Method) -> Self {
        match method {
            Method::Uniform => Self::Uniform,
            Method::Chaikin => Self::Chaikin,
        }
    }
}

impl From<Triangles> for TriangleTag {
    fn from(triangles: Triangles) -> Self {
        match triangles {
            Triangles::CatmullClark => Self::CatmullClark,
            Triangles::Smooth => Self::Smooth,
        }
    }
}

impl From<Uv> for FaceVaryingTag {
    fn from(uv: Uv) -> Self {
        match uv {
            Uv::Smooth => Self::None,
            Uv::Corners => Self::CornersOnly,
            Uv::CornersPlus1 => Self::CornersPlus1,
            Uv::CornersPlus2 => Self::CornersPlus2,
            Uv::Boundaries => Self::Boundaries,
            Uv::All => Self::All,
        }
    }
}
