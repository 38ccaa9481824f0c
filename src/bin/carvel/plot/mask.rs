//! What a mask makes: its limit function, derivatives, frequencies, and ranges of a parameter.

use super::figure::{Axes, Axis, DISTINCT, Figure, Panel, Part, RESULT};
use carvel::analysis::mask::{FrequencyResponse, ParameterRange};
use carvel::curve::rational::to_f64;
use carvel::curve::{Mask, sample_derivative};
use carvel::{Context, Result};
use std::f64::consts::PI;

/// Samples of a limit function, about.
const SAMPLES: usize = 600;
/// The highest derivative that is drawn.
const HIGHEST: usize = 3;

/// All panels of a mask whose limit is C^`continuity`, and of ranges where there are some.
///
/// # Errors
/// As [`sample_derivative`].
pub fn figure(
    context: &Context,
    mask: &Mask,
    continuity: Option<usize>,
    ranges: Option<(&str, &[Vec<ParameterRange>])>,
) -> Result<Figure> {
    let highest = continuity.map(|k| k.min(HIGHEST));
    let mut panels = Vec::new();
    for derivative in highest.into_iter().flat_map(|highest| 0..=highest) {
        panels.push(limit(context, mask, derivative)?);
    }
    panels.push(frequencies(mask));
    panels.extend(ranges.filter(|(_, all)| !all.is_empty()).map(|(name, all)| bars(name, all)));
    Ok(Figure { columns: panels.len().min(2), panels, size: [420, 300] })
}

fn limit(context: &Context, mask: &Mask, derivative: usize) -> Result<Panel> {
    let width = mask.coefficients().len().div_ceil(mask.arity() - 1).max(1);
    let levels = (SAMPLES / width).max(1).ilog(mask.arity()) + 1;
    let (first, values) = sample_derivative(context, mask, derivative, levels)?;
    let scale = (mask.arity() as f64).powi(levels as i32);
    let at = |(i, value): (i64, _)| [i as f64 / scale, to_f64(value)];
    let mut points: Vec<_> = (first..).zip(&values).map(at).collect();
    // Outside of its support the limit is 0.
    let ends = [first - 1, first + values.len() as i64].map(|i| [i as f64 / scale, 0.0]);
    points.insert(0, ends[0]);
    points.push(ends[1]);
    let title = match derivative {
        0 => "limit function".to_owned(),
        1 => "its derivative".to_owned(),
        k => format!("derivative {k}"),
    };
    let parts = vec![Part::line(1.5, RESULT, points)];
    Ok(Panel { title, axes: Axes::Graph { x: Axis::Real("parameter"), y: Axis::Real("") }, parts })
}

fn frequencies(mask: &Mask) -> Panel {
    let response = FrequencyResponse::new(mask);
    let sample = |f: &dyn Fn(f64) -> f64| {
        let at = |i: i32| f64::from(i) / 200.0;
        (0..=400).map(at).map(|x| [x, f(PI * x)]).collect::<Vec<_>>()
    };
    let of_mask = sample(&|omega| response.mask(omega));
    let of_limit = sample(&|omega| response.limit(omega));
    Panel {
        title: "magnitude of frequencies".to_owned(),
        axes: Axes::Graph { x: Axis::Real("frequency / pi"), y: Axis::Real("") },
        parts: vec![
            Part::line(1.5, DISTINCT[0], of_mask).named("mask"),
            Part::line(1.5, DISTINCT[1], of_limit).named("limit function"),
        ],
    }
}

/// A bar for every range of every order.
fn bars(name: &str, ranges: &[Vec<ParameterRange>]) -> Panel {
    let bar = |(k, range): (usize, &ParameterRange)| {
        let (y, color) = (k as f64, DISTINCT[k % DISTINCT.len()]);
        match range {
            ParameterRange::Single(w) => Part::dots(4.0, color, vec![[to_f64(w), y]]),
            ParameterRange::Interval { low, high } => {
                Part::line(6.0, color, vec![[low.middle(), y], [high.middle(), y]])
            }
        }
    };
    let all = ranges.iter().enumerate().flat_map(|(k, list)| list.iter().map(move |r| (k, r)));
    Panel {
        title: format!("{name} for which it is proved C^k"),
        axes: Axes::Graph { x: Axis::Real("parameter"), y: Axis::Count("k") },
        parts: all.map(bar).collect(),
    }
}
