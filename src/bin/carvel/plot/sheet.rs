//! What every scheme of the catalogue makes of a closed and of an open polygon.

use super::curve::{Refined, panel};
use super::figure::{CONTROL, Figure, Mark, Panel, Part};
use carvel::curve::catalogue::{FAMILIES, NON_STATIONARY, Parameter, mask};
use carvel::curve::{Ends, Mask, Polygon, Tension, limit_stencil, rational};
use carvel::{Context, Result};

/// New points for each old one, at most.
const FINE: usize = 32;
/// The tension that those with one are shown with.
const TENSION: f64 = 0.5;
/// The power of the edges' lengths that parameters are taken from.
const POWER: f64 = 0.5;

/// The polygons that are refined: the first is closed, the second open.
const POLYGONS: [&[f64]; 2] = [
    &[0.0, 0.0, 3.0, 0.0, 3.0, 2.0, 2.0, 2.0, 1.5, 0.8, 1.0, 2.0, 0.0, 2.0],
    &[0.0, 0.0, 0.6, 1.6, 1.4, 0.2, 2.0, 0.2, 2.0, 1.8, 3.0, 1.8, 3.0, 0.6],
];

/// What all curves are in.
const FRAME: [[f64; 2]; 2] = [[-0.6, -0.6], [3.6, 2.5]];

/// A row of four panels for every two schemes: the closed and the open polygon.
///
/// # Errors
/// As [`Polygon::refine`].
pub fn figure(context: &Context) -> Result<Figure> {
    let mut panels = Vec::new();
    for family in &FAMILIES {
        let mask = mask(family.name)?;
        let value = |p: &Parameter| format!("{} = {}", p.name, p.default);
        let values: Vec<_> = family.parameters.iter().map(value).collect();
        let titles = [family.name, &values.join(", ")];
        panels.extend(pair(titles, |polygon| stationary(context, &mask, polygon))?);
    }
    for family in &NON_STATIONARY {
        let value = match family.name {
            "non-uniform-four-point" => format!("power = {POWER}"),
            _ => format!("tension = {TENSION}"),
        };
        let titles = [family.name, &value];
        panels.extend(pair(titles, |polygon| changing(context, family.name, polygon))?);
    }
    Ok(Figure { panels, columns: 8, size: [180, 165] })
}

/// The closed polygon under the name of the scheme, the open one under its parameters.
fn pair(
    [name, parameters]: [&str; 2],
    refined: impl Fn(&Polygon<f64>) -> Result<[Polygon<f64>; 2]>,
) -> Result<Vec<Panel>> {
    let of = |(points, closed): (&[f64], bool)| {
        let ends = if closed { Ends::Closed } else { Ends::Kept };
        let control = Polygon::new(points.to_vec(), 2, ends);
        let [refined, limit] = refined(&control)?;
        let shown =
            Refined { control: plane(&control), curve: plane(&refined), limit: plane(&limit) };
        // A blank keeps the height of the others.
        let title = [name, if parameters.is_empty() { " " } else { parameters }];
        let mut panel = panel(title[usize::from(!closed)].to_owned(), &[shown]);
        panel.parts.push(frame());
        Ok(panel)
    };
    POLYGONS.into_iter().zip([true, false]).map(of).collect()
}

/// Corners around all curves, so that panels have one scale and polygons the same place.
fn frame() -> Part {
    Part { mark: Mark::Nothing, ..Part::dots(0.0, CONTROL, FRAME.to_vec()) }
}

fn steps(arity: usize) -> u32 {
    FINE.ilog(arity).max(1)
}

/// The refined polygon and the limit of the control points. Ends that cannot stay are dropped.
fn stationary(context: &Context, mask: &Mask, control: &Polygon<f64>) -> Result<[Polygon<f64>; 2]> {
    let steps = steps(mask.arity());
    let mut control = control.clone();
    if control.ends == Ends::Kept && !mask.is_symmetric() {
        control.ends = Ends::Dropped;
    }
    let refined = control.refine(context, mask, steps)?;
    let has_limit = limit_stencil(context, mask, &rational::ratio(0, 1), 0).is_ok();
    let limit = if has_limit { control.limit(context, mask, 0)? } else { nothing() };
    Ok([refined, limit])
}

fn nothing() -> Polygon<f64> {
    Polygon::new(Vec::new(), 2, Ends::Dropped)
}

/// Schemes whose rules change: with a tension of one half, and centripetal parameters.
fn changing(context: &Context, name: &str, control: &Polygon<f64>) -> Result<[Polygon<f64>; 2]> {
    let refined = match name {
        "tension-four-point" => {
            control.refine_with_tension(context, Tension::FourPoint(TENSION), steps(2))
        }
        "tension-ternary-four-point" => {
            control.refine_with_tension(context, Tension::TernaryFourPoint(TENSION), steps(3))
        }
        _ => control.refine_non_uniform(context, &control.parameters(POWER)?, steps(2)),
    };
    Ok([refined?, nothing()])
}

fn plane(polygon: &Polygon<f64>) -> Vec<[f64; 2]> {
    let closed = (polygon.ends == Ends::Closed).then_some(0);
    let all = (0..polygon.len()).chain(closed);
    all.map(|i| [polygon.point(i)[0], polygon.point(i)[1]]).collect()
}
