//! The command `analyse`.

use crate::args::{AnalyseArgs, Chosen};
use crate::exit::{Doing, Exit, Failure};
use crate::session::Session;
use crate::{mask, plot, report};
use carvel::Scheme;
use carvel::analysis::surface::{
    CharacteristicMap, CupsAndSaddles, Eigenvalue, Feature, LimitWeights, LocalMatrix, Smoothness,
    Spectrum, Tangent, VertexWeights,
};
use serde_json::{Value, json};
use std::fmt::Write as _;

/// Steps of cups and saddles.
const STEPS: u32 = 8;
/// Valences in one plot.
const MOST_PLOTTED: usize = 12;

/// Analyses a scheme at some features.
pub fn run(args: &AnalyseArgs) -> Result<Exit, Failure> {
    if let Some(source) = args.mask_source()? {
        return mask::analyse(args, source);
    }
    let chosen = args.choose()?;
    let kind = args.plot.as_deref().map(plot::kind_of).transpose()?;
    let session = Session::new(1, None, args.quiet || args.json)?;
    let valences = args.valences();
    if kind.is_some() && valences.len() > MOST_PLOTTED {
        let message =
            format!("a plot shows {MOST_PLOTTED} valences at most, not {}", valences.len());
        return Err(Failure::usage(message));
    }
    let mut found = Vec::new();
    for (done, &faces) in valences.iter().enumerate() {
        session.refuse_if_cancelled()?;
        session.console.phase("analysing", &chosen.name);
        session.console.part(done as f64 / valences.len() as f64);
        let feature = args.feature().of(faces);
        let analysis = Analysis::new(&chosen.scheme, feature);
        found.push(analysis.map_err(|e| Failure::from_error(&e, Doing::Asking))?);
    }
    if let (Some(path), Some(kind)) = (&args.plot, kind) {
        let shown: Vec<_> = found.iter().map(Analysis::shown).collect();
        plot::save(&session, path, kind, &plot::surface::figure(&shown))?;
    }
    session.console.clear();
    if args.json {
        let list = found.iter().map(|analysis| analysis.json(&chosen)).collect();
        return args.print(&report::document(&Value::Array(list)));
    }
    args.print(&table(&chosen, &found))
}

/// All that is said about one feature.
struct Analysis {
    spectrum: Spectrum,
    /// Absent where points do not converge.
    weights: Option<LimitWeights>,
    map: Option<CharacteristicMap>,
    smoothness: Smoothness,
    /// Around interior features with a tangent plane.
    curved: Option<CupsAndSaddles>,
}

impl Analysis {
    fn new(scheme: &Scheme, feature: Feature) -> carvel::Result<Self> {
        let matrix = LocalMatrix::new(scheme, feature)?;
        let spectrum = Spectrum::new(&matrix)?;
        let weights = match LimitWeights::new(&matrix, &spectrum) {
            Err(e) if e.kind() == carvel::ErrorKind::Unsupported => None,
            weights => Some(weights?),
        };
        let map = CharacteristicMap::new(scheme, &spectrum)?;
        let smoothness = Smoothness::of(&spectrum, map.as_ref());
        let is_curved = map.is_some() && matches!(feature, Feature::Interior { .. });
        let curved = is_curved.then(|| CupsAndSaddles::new(&matrix, STEPS)).transpose()?;
        Ok(Self { spectrum, weights, map, smoothness, curved })
    }

    fn shown(&self) -> plot::surface::Shown<'_> {
        plot::surface::Shown {
            faces: self.faces(),
            spectrum: &self.spectrum,
            map: self.map.as_ref(),
            curved: self.curved.as_ref(),
        }
    }

    fn faces(&self) -> usize {
        self.spectrum.feature().faces()
    }

    fn json(&self, chosen: &Chosen) -> Value {
        let verdict = &self.smoothness;
        let c1 = match verdict.tangent {
            Tangent::Continuous => json!(true),
            Tangent::Sharp => Value::Null,
            _ => json!(false),
        };
        let weights = |weights: &VertexWeights| json!(weights.orbits());
        let tangents = self.weights.as_ref().and_then(|w| w.tangents.as_ref());
        json!({
            "scheme": report::scheme(chosen),
            "feature": feature_name(self.spectrum.feature()),
            "valence": self.faces(),
            "lambda": verdict.lambda,
            "mu": verdict.mu,
            "mu_over_lambda_squared": verdict.ratio,
            "eigenvalues": self.spectrum.all().map(number).collect::<Vec<_>>(),
            "modes": self.spectrum.eigenvalues().iter().map(|e| json!({
                "mode": e.mode,
                "eigenvalue": number(*e),
                "copies": e.copies,
                "vectors": e.vectors,
            })).collect::<Vec<_>>(),
            "limit_weights": self.weights.as_ref().map(|w| weights(&w.position)),
            "tangent_weights": tangents.map(|pair| pair.iter().map(weights).collect::<Vec<_>>()),
            "c1": c1,
            "tangent": verdict.tangent.to_string(),
            "curvature": verdict.curvature.map(|c| c.to_string()),
            "map": self.map.as_ref().map(|map| json!({
                "least_jacobian": map.least_jacobian,
                "samples": map.samples,
                "injective": map.injective,
            })),
        })
    }
}

/// A real number, or real and imaginary part.
fn number(eigenvalue: Eigenvalue) -> Value {
    match eigenvalue.value {
        [real, 0.0] => json!(real),
        parts => json!(parts),
    }
}

fn feature_name(feature: Feature) -> &'static str {
    match feature {
        Feature::Interior { .. } => "interior",
        Feature::Boundary { .. } => "boundary",
        Feature::Corner { .. } => "corner",
        Feature::Crease { .. } => "crease",
        Feature::Dart { .. } => "dart",
        _ => "other",
    }
}

fn table(chosen: &Chosen, found: &[Analysis]) -> String {
    let feature = found.first().map_or("", |a| feature_name(a.spectrum.feature()));
    let mut text = format!("{}, {feature}\n", chosen.name);
    text.push_str("faces      lambda          mu   mu/lambda^2   least J  verdict\n");
    for analysis in found {
        let verdict = &analysis.smoothness;
        let map = analysis.map.as_ref();
        let least = map.map_or("-".to_owned(), |map| format!("{:.3}", map.least_jacobian));
        let ratio = verdict.ratio.map_or("-".to_owned(), |ratio| format!("{ratio:.8}"));
        let curvature = verdict.curvature.map(|c| format!(", curvature {c}")).unwrap_or_default();
        // Writing to a string does not fail.
        let _ = writeln!(
            text,
            "{:5}  {:.8}  {:.8}  {ratio:>12}  {least:>8}  {}{curvature}",
            analysis.faces(),
            verdict.lambda,
            verdict.mu,
            verdict.tangent,
        );
    }
    text.push_str(
        "Eigenvalues are computed from the scheme's own rows; least J is the smallest Jacobian of\n\
         the characteristic map over its mean, at the samples of one ring of faces.\n",
    );
    text
}
