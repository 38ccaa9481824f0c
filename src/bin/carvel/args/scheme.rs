//! The scheme: a name, the parameters that belong to it, and nothing else.

use super::mask::MaskSource;
use super::names::{
    Around, Beta, Edges, Method, Name, Rule, SchemeName, SchemeParser, Split, Triangles, Uv,
    spelled,
};
use super::owners::{AVERAGING, FEATURED, refuse_strangers};
use crate::exit::{Doing, Failure};
use carvel::curve::{CurveSplit, Factors};
use carvel::io::SchemeTags;
use carvel::scheme::SplitKind;
use carvel::{FaceVaryingMode, Fraction, Scheme};
use clap::Args;
use std::str::FromStr;

/// Options that choose a scheme.
#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "Scheme")]
pub struct SchemeArgs {
    /// The scheme; or a mask of `carvel catalogue` with its parameters, such as
    /// dyn-floater-hormann:1/128, as for --mask.
    #[arg(short, long, value_parser = SchemeParser, default_value = "three-point",
          value_name = "NAME")]
    scheme: SchemeName,
    /// A mask by its coefficients, such as 1/4,3/4,3/4,1/4 or [1,3,3,1]/4. On meshes: the scheme
    /// of the averaging family whose regular rule is its tensor square.
    #[arg(long, value_name = "A,...", allow_hyphen_values = true, conflicts_with = "scheme")]
    pub mask: Option<String>,
    /// For three-point: the parameter w, from 0 to 1/16 [default: 1/32].
    #[arg(long, value_name = "W", allow_hyphen_values = true)]
    w: Option<Fraction>,
    /// For bspline: the degree, from 1 to 65; even ones are dual, odd ones primal.
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    degree: Option<u32>,
    /// For averaging: the split [default: dual].
    #[arg(long, value_enum, value_name = "SPLIT")]
    split: Option<Split>,
    /// For averaging: the smoothing passes, such as 1/2,0 or "" [default: none].
    #[arg(long, value_name = "T,...", allow_hyphen_values = true)]
    passes: Option<Passes>,
    /// How corners of faces that are no quads are cut; for all schemes but catmull-clark,
    /// loop and bilinear [default: cosine].
    #[arg(long, value_enum, value_name = "RULE")]
    corner_rule: Option<Rule>,
    /// What happens along boundaries; catmull-clark and loop follow what the file says,
    /// other primal schemes do not ask [default: edge-corner].
    #[arg(long, value_enum, value_name = "MODE")]
    boundary: Option<Edges>,
    /// How the sharpness of creases goes down; for catmull-clark, loop and bilinear
    /// [default: what the file says, or uniform].
    #[arg(long, value_enum, value_name = "METHOD")]
    creasing: Option<Method>,
    /// For catmull-clark: the weights beside triangles of the control mesh
    /// [default: what the file says, or catmull-clark].
    #[arg(long, value_enum, value_name = "RULE")]
    triangle_rule: Option<Triangles>,
    /// For loop: the weights at vertices of other than six faces [default: loop].
    #[arg(long, value_enum, value_name = "WEIGHTS")]
    loop_weights: Option<Beta>,
    /// For three-point with w = 1/32: the weights around faces that are no quads, from the
    /// second step on [default: default].
    #[arg(long, value_enum, value_name = "WEIGHTS")]
    extraordinary: Option<Around>,
    /// Where texture coordinates are refined linearly, along seams and boundaries; for
    /// catmull-clark, loop and bilinear [default: what the file says, or corners-plus1].
    #[arg(long, value_enum, value_name = "MODE")]
    uv: Option<Uv>,
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
    pub name: String,
    /// The scheme.
    pub scheme: Scheme,
    /// Where texture coordinates are refined linearly.
    pub uv: FaceVaryingMode,
    /// The options that the scheme asks for, as on the command line.
    pub options: Vec<(&'static str, String)>,
    /// What the file asks of the scheme, and was followed.
    pub followed: SchemeTags,
}

impl Chosen {
    /// True if creases, sharp vertices, holes and seams mean something.
    pub fn has_features(&self) -> bool {
        self.scheme.split() != SplitKind::Corner && self.scheme.passes().is_empty()
    }

    /// The split's name on the command line.
    pub fn split(&self) -> String {
        let dual = self.scheme.split() == SplitKind::Corner;
        spelled(if dual { &Split::Dual } else { &Split::Primal })
    }
}

impl SchemeArgs {
    /// The scheme asked for; what a file says counts where no option says otherwise, and
    /// only with schemes that have creases.
    ///
    /// # Errors
    /// A usage error for an option of another scheme, a missing one, or a value
    /// out of range.
    pub fn choose(&self, file: SchemeTags) -> Result<Chosen, Failure> {
        self.refuse_strangers()?;
        let preset = self.preset()?;
        let name = self.name();
        let featured = FEATURED.contains(&name);
        let tags = if featured { file } else { SchemeTags::default() };
        let rule = self.corner_rule.unwrap_or_default();
        let boundary = self.boundary.or(tags.boundary.map(Into::into)).unwrap_or_default();
        let creasing = self.creasing.or(tags.creasing.map(Into::into)).unwrap_or_default();
        let triangles = self.triangle_rule.or(tags.triangles.map(Into::into)).unwrap_or_default();
        let beta = self.loop_weights.unwrap_or_default();
        let around = self.extraordinary.unwrap_or_default();
        let uv = self.uv.or(tags.face_varying.map(Into::into)).unwrap_or_default();
        let scheme = preset
            .with_rule(rule.into())
            .with_boundary(boundary.into())
            .with_creasing(creasing.into())
            .with_triangle_rule(triangles.into())
            .with_loop_weights(beta.into())
            .with_extraordinary(around.into())
            .map_err(|e| Failure::from_error(&e, Doing::Asking))?;
        let options = [
            ("corner_rule", spelled(&rule), AVERAGING.contains(&name)),
            ("boundary", spelled(&boundary), true),
            ("creasing", spelled(&creasing), featured),
            ("triangle_rule", spelled(&triangles), name == Name::CatmullClark),
            ("loop_weights", spelled(&beta), name == Name::Loop),
            ("extraordinary", spelled(&around), name == Name::ThreePoint),
            ("uv", spelled(&uv), featured),
        ];
        let asked = options.into_iter().filter(|(.., asked)| *asked);
        Ok(Chosen {
            name: spelled(&name),
            scheme,
            uv: uv.into(),
            options: asked.map(|(option, word, _)| (option, word)).collect(),
            followed: self.followed(tags),
        })
    }

    /// The options as tags of a file.
    pub fn asked(&self) -> SchemeTags {
        SchemeTags {
            boundary: self.boundary.map(Into::into),
            creasing: self.creasing.map(Into::into),
            triangles: self.triangle_rule.map(Into::into),
            face_varying: self.uv.map(Into::into),
        }
    }

    /// The scheme asked for, by a name that stands for the option.
    ///
    /// # Errors
    /// As [`SchemeArgs::choose`].
    pub(super) fn choose_named(&self, name: Option<&SchemeName>) -> Result<Chosen, Failure> {
        let scheme = name.unwrap_or(&self.scheme).clone();
        Self { scheme, ..self.clone() }.choose(SchemeTags::default())
    }

    /// The mask of the catalogue that stands for the scheme.
    pub(super) fn named_mask(&self) -> Option<&str> {
        match &self.scheme {
            SchemeName::Mask(text) => Some(text),
            SchemeName::Mesh(_) => None,
        }
    }

    /// The name of the scheme; masks are of the averaging family.
    fn name(&self) -> Name {
        match (&self.mask, &self.scheme) {
            (None, SchemeName::Mesh(name)) => *name,
            _ => Name::Averaging,
        }
    }

    /// The name in the catalogue of the curves that a scheme on meshes is named after.
    pub(super) fn curve_of(&self, given: Option<&SchemeName>) -> Option<&'static str> {
        match given.unwrap_or(&self.scheme) {
            SchemeName::Mesh(Name::ThreePoint) => Some("three-point"),
            _ => None,
        }
    }

    /// Split and passes of a mask, if one is given.
    fn factors(&self) -> Result<Option<Factors>, Failure> {
        let source = match (&self.mask, &self.scheme) {
            (Some(text), _) => MaskSource::Coefficients { text, arity: 2, offset: None },
            (None, SchemeName::Mask(text)) => MaskSource::Named(text),
            (None, SchemeName::Mesh(_)) => return Ok(None),
        };
        let factors = Factors::of(&source.mask()?);
        factors.map(Some).map_err(|e| Failure::from_error(&e, Doing::Asking))
    }

    /// True if an option is given that says something about meshes.
    pub(super) fn has_options(&self) -> bool {
        self.strangers().iter().any(|(_, given, _)| *given) || self.boundary.is_some()
    }

    /// The tags that no option overrules.
    fn followed(&self, tags: SchemeTags) -> SchemeTags {
        SchemeTags {
            boundary: tags.boundary.filter(|_| self.boundary.is_none()),
            creasing: tags.creasing.filter(|_| self.creasing.is_none()),
            triangles: tags.triangles.filter(|_| self.triangle_rule.is_none()),
            face_varying: tags.face_varying.filter(|_| self.uv.is_none()),
        }
    }

    /// Refuses options that belong to another scheme.
    fn refuse_strangers(&self) -> Result<(), Failure> {
        let given = self.split.is_some() || self.passes.is_some();
        if given && (self.mask.is_some() || self.named_mask().is_some()) {
            let message = "--split and --passes of a mask follow from it";
            return Err(Failure::usage(message));
        }
        refuse_strangers(self.name(), &self.strangers())
    }

    /// The options that belong to some schemes: whether they are given, and to which.
    fn strangers(&self) -> [(&'static str, bool, &'static [Name]); 10] {
        [
            ("--w", self.w.is_some(), &[Name::ThreePoint]),
            ("--degree", self.degree.is_some(), &[Name::Bspline]),
            ("--split", self.split.is_some(), &[Name::Averaging]),
            ("--passes", self.passes.is_some(), &[Name::Averaging]),
            ("--corner-rule", self.corner_rule.is_some(), AVERAGING),
            ("--creasing", self.creasing.is_some(), FEATURED),
            ("--triangle-rule", self.triangle_rule.is_some(), &[Name::CatmullClark]),
            ("--loop-weights", self.loop_weights.is_some(), &[Name::Loop]),
            ("--extraordinary", self.extraordinary.is_some(), &[Name::ThreePoint]),
            ("--uv", self.uv.is_some(), FEATURED),
        ]
    }

    /// Refuses an option outside of this group unless the scheme has creases and holes.
    ///
    /// # Errors
    /// A usage error.
    pub fn require_features(&self, option: &str, given: bool) -> Result<(), Failure> {
        refuse_strangers(self.name(), &[(option, given, FEATURED)])
    }

    fn preset(&self) -> Result<Scheme, Failure> {
        if let Some(Factors { split, passes }) = self.factors()? {
            let scheme = match split {
                CurveSplit::Dual => Scheme::dual(&passes),
                CurveSplit::Primal => Scheme::primal(&passes),
            };
            return scheme.map_err(|e| Failure::from_error(&e, Doing::Asking));
        }
        let passes = self.passes.as_ref().map_or(&[][..], |passes| &passes.0);
        let scheme = match self.name() {
            Name::ThreePoint => match self.w {
                Some(w) => Scheme::three_point(w),
                None => Fraction::new(1, 32).and_then(Scheme::three_point),
            },
            Name::DooSabin => Ok(Scheme::doo_sabin()),
            Name::Quartic => Ok(Scheme::quartic()),
            Name::CatmullClark => Ok(Scheme::catmull_clark()),
            Name::Loop => Ok(Scheme::loop_triangles()),
            Name::Bilinear => Ok(Scheme::bilinear()),
            Name::Bspline => Scheme::b_spline(self.degree()?),
            Name::Averaging => match self.split.unwrap_or_default() {
                Split::Dual => Scheme::dual(passes),
                Split::Primal => Scheme::primal(passes),
            },
        };
        scheme.map_err(|e| Failure::from_error(&e, Doing::Asking))
    }

    fn degree(&self) -> Result<u32, Failure> {
        let message = "--scheme bspline needs --degree, a number from 1 to 65";
        self.degree.ok_or_else(|| Failure::usage(message))
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
