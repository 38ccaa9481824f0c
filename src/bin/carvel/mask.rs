//! The analysis of masks of curves and grids, a part of `analyse`.

use crate::args::{AnalyseArgs, MaskArgs, MaskSource};
use crate::exit::{Doing, Exit, Failure};
use crate::session::Session;
use crate::{plot, report};
use carvel::ErrorKind;
use carvel::analysis::mask::{
    AffineFamily, Analysis, Certificate, Effort, ParameterRange, Response,
};
use carvel::curve::rational::{ratio, to_f64};
use carvel::curve::{CurveSplit, Factors, Mask, Rational};
use serde_json::{Value, json};
use std::fmt::Write as _;

/// Points per period for which shrink and artifact are printed.
const WAVE: f64 = 6.0;

/// Analyses a mask.
pub fn analyse(args: &AnalyseArgs, source: MaskSource) -> Result<Exit, Failure> {
    let options = &args.mask;
    let mask = source.mask()?;
    let family = options.range.as_deref().map(|parameter| source.family(parameter)).transpose()?;
    let kind = args.plot.as_deref().map(plot::kind_of).transpose()?;
    let session = Session::new(1, None, args.quiet || args.json)?;
    session.console.phase("analysing", "the mask");
    let failed = |e| Failure::from_error(&e, Doing::Asking);
    let effort = Effort::default();
    let found = Analysis::of(&session.context, &mask, effort).map_err(failed)?;
    let ranges = family.map(|family| ranges(&session, &family, options)).transpose()?;
    let wave = wave(&mask).map_err(failed)?;
    if let (Some(path), Some(kind)) = (&args.plot, kind) {
        let ranges = options.range.as_deref().zip(ranges.as_deref());
        let figure = plot::mask::figure(&session.context, &mask, found.continuity, ranges);
        plot::save(&session, path, kind, &figure.map_err(failed)?)?;
    }
    session.console.clear();
    if args.json {
        let mut document = document(&mask, &found, wave);
        if let Some(ranges) = &ranges {
            document["ranges"] = ranges_document(ranges);
        }
        return args.print(&report::document(&document));
    }
    args.print(&text(&mask, &found, wave, options, ranges.as_deref()))
}

/// Shrink and artifact; none where doubles do not hold them.
fn wave(mask: &Mask) -> carvel::Result<Option<Response>> {
    match Response::of(mask, WAVE) {
        Err(e) if e.kind() == ErrorKind::Overflow => Ok(None),
        wave => wave.map(Some),
    }
}

/// For each order the values for which the family is smooth, up to the first without any.
fn ranges(
    session: &Session,
    family: &AffineFamily,
    args: &MaskArgs,
) -> Result<Vec<Vec<ParameterRange>>, Failure> {
    let [low, high] = &args.within;
    let tolerance = (high - low) / ratio(1_000_000, 1);
    let mut all = Vec::new();
    for k in 0.. {
        let found = family.continuity_range(&session.context, k, [low, high], &tolerance);
        let found = found.map_err(|e| Failure::from_error(&e, Doing::Asking))?;
        if found.is_empty() {
            break;
        }
        all.push(found);
    }
    Ok(all)
}

fn strings(values: &[Rational]) -> Value {
    values.iter().map(ToString::to_string).collect()
}

fn document(mask: &Mask, found: &Analysis, wave: Option<Response>) -> Value {
    let proof = found.contractivity.as_ref();
    let radius = &found.holder.radius;
    json!({
        "arity": mask.arity(),
        "offset": mask.offset(),
        "mask": strings(mask.coefficients()),
        "parametrisation": found.parametrisation.name(),
        "symmetric": found.is_symmetric,
        "interpolating": found.is_interpolating,
        "continuity": found.continuity,
        "contractivity": proof.map(|proof| json!({
            "k": proof.continuity,
            "L": proof.power,
            "norm": proof.norm.to_string(),
        })),
        "holder": [found.holder.low, found.holder.high],
        "joint_spectral_radius": {
            "exact": radius.exact.as_ref().map(ToString::to_string),
            "low": radius.low,
            "high": radius.high,
            "word": radius.word,
            "certificate": radius.certificate.name(),
        },
        "smoothing_factors": found.smoothing.factors,
        "kernel": strings(found.smoothing.kernel.coefficients()),
        "support": found.support.to_string(),
        "generation_degree": found.degrees.generation,
        "reproduction_degree": found.degrees.reproduction,
        "tau": found.tau.to_string(),
        "factors": factors_document(mask),
        "wave": {
            "points": WAVE,
            "shrink": wave.map(|wave| wave.shrink),
            "artifact": wave.map(|wave| wave.artifact),
        },
    })
}

/// Split and passes, or why there are none.
fn factors_document(mask: &Mask) -> Value {
    match Factors::of(mask) {
        Ok(factors) => json!({
            "split": split_name(factors.split),
            "passes": factors.passes.iter().map(ToString::to_string).collect::<Vec<_>>(),
        }),
        Err(reason) => json!({ "none": reason.to_string() }),
    }
}

fn split_name(split: CurveSplit) -> &'static str {
    match split {
        CurveSplit::Dual => "dual",
        CurveSplit::Primal => "primal",
    }
}

fn ranges_document(ranges: &[Vec<ParameterRange>]) -> Value {
    let outside = |value: &Option<Rational>| value.as_ref().map(ToString::to_string);
    let range = |range: &ParameterRange| match range {
        ParameterRange::Single(w) => json!({ "single": w.to_string() }),
        ParameterRange::Interval { low, high } => json!({
            "low": { "inside": low.inside.to_string(), "outside": outside(&low.outside) },
            "high": { "inside": high.inside.to_string(), "outside": outside(&high.outside) },
        }),
    };
    ranges.iter().map(|list| list.iter().map(range).collect::<Value>()).collect()
}

fn text(
    mask: &Mask,
    found: &Analysis,
    wave: Option<Response>,
    args: &MaskArgs,
    ranges: Option<&[Vec<ParameterRange>]>,
) -> String {
    let mut lines = vec![
        ("mask", format!("{} from {}, arity {}", list(mask), mask.offset(), mask.arity())),
        ("continuity", found.continuity.map_or("none proved".to_owned(), |k| format!("C^{k}"))),
        (
            "contractivity",
            found.contractivity.as_ref().map_or("-".to_owned(), |proof| {
                let (k, power) = (proof.continuity, proof.power);
                format!("C^{k}: |S^{power}| = {} < 1, L = {power}", short(&proof.norm))
            }),
        ),
        ("Hoelder exponent", exponent(found)),
        ("parametrisation", format!("{}, tau = {}", found.parametrisation.name(), found.tau)),
        ("support", found.support.to_string()),
        ("polynomials", {
            let degrees = found.degrees;
            format!("degree {} generated, {} reproduced", degrees.generation, degrees.reproduction)
        }),
        ("6 points a period", {
            wave.map_or("beyond the range of doubles".to_owned(), |wave| {
                format!("shrink {}, artifact {:.2e}", fixed(wave.shrink, 6), wave.artifact)
            })
        }),
        ("on meshes", on_meshes(mask)),
    ];
    let name = args.range.as_deref().unwrap_or_default();
    let proved = |(k, list): (usize, &Vec<_>)| (format!("C^{k}"), range_text(name, list));
    let ranges: Option<Vec<_>> = ranges.map(|all| all.iter().enumerate().map(proved).collect());
    let none = ranges.as_ref().is_some_and(Vec::is_empty);
    let [low, high] = &args.within;
    let none = none.then(|| ("C^0", format!("no {name} found from {low} to {high}")));
    let ranges = ranges.unwrap_or_default();
    lines.extend(ranges.iter().map(|(k, text)| (k.as_str(), text.clone())));
    lines.extend(none);
    let mut text = String::new();
    for (label, value) in lines {
        // Writing to a string does not fail.
        let _ = writeln!(text, "{label:18} {value}");
    }
    text
}

fn list(mask: &Mask) -> String {
    let coefficients: Vec<_> = mask.coefficients().iter().map(ToString::to_string).collect();
    coefficients.join(",")
}

/// A fraction, and its value if the fraction is long.
fn short(value: &Rational) -> String {
    let text = value.to_string();
    if text.len() <= 24 { text } else { format!("{:.12}", to_f64(value)) }
}

/// A number with some digits behind the point; what is rounded to 0 has no sign.
fn fixed(value: f64, digits: usize) -> String {
    let text = format!("{value:.digits$}");
    let is_zero = text.bytes().all(|b| matches!(b, b'-' | b'0' | b'.'));
    if is_zero { text.trim_start_matches('-').to_owned() } else { text }
}

fn exponent(found: &Analysis) -> String {
    let (holder, radius) = (&found.holder, &found.holder.radius);
    match (&radius.exact, radius.certificate) {
        (Some(exact), _) => {
            format!("{} (radius {exact})", f64::midpoint(holder.low, holder.high))
        }
        (None, Certificate::Polytope(n)) => {
            format!("{} to {} (invariant polytope, {n} vertices)", holder.low, holder.high)
        }
        (None, other) => format!("{} to {} ({})", holder.low, holder.high, other.name()),
    }
}

fn on_meshes(mask: &Mask) -> String {
    match Factors::of(mask) {
        Ok(factors) => {
            let passes: Vec<_> = factors.passes.iter().map(ToString::to_string).collect();
            let split = split_name(factors.split);
            format!("--scheme averaging --split {split} --passes \"{}\"", passes.join(","))
        }
        Err(reason) => reason.to_string(),
    }
}

fn range_text(name: &str, list: &[ParameterRange]) -> String {
    let open =
        |end: &carvel::analysis::mask::End| if end.outside.is_some() { "" } else { " or beyond" };
    let range = |range: &ParameterRange| match range {
        ParameterRange::Single(w) => format!("{name} = {w} alone"),
        ParameterRange::Interval { low, high } => format!(
            "{name} from {}{} to {}{}",
            fixed(low.middle(), 5),
            open(low),
            fixed(high.middle(), 5),
            open(high),
        ),
    };
    list.iter().map(range).collect::<Vec<_>>().join(", ")
}
