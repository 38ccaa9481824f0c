//! What every scheme of the catalogue makes of a closed and of an open polygon.

use super::curve::{Refined, panel};
use super::figure::{Figure, Panel};
use carvel::curve::catalogue::{FAMILIES, NON_STATIONARY, mask};
use carvel::curve::{Ends, Mask, Polygon, Tension, limit_stencil, rational};
use carvel::{Context, Result};

/// New points for each old one, at most.
const FINE: usize = 32;

/// The polygons that are refined: the first is closed, the second open.
const POLYGONS: [&[f64]; 2] = [
    &[0.0, 0.0, 3.0, 0.0, 3.0, 2.0, 2.0, 2.0, 1.5, 0.8, 1.0, 2.0, 0.0, 2.0],
    &[0.0, 0.0, 0.6, 1.6, 1.4, 0.2, 2.0, 0.2, 2.0, 1.8, 3.0, 1.8, 3.0, 0.6],
];

/// A row of four panels for every two schemes: the closed and the open polygon.
///
/// # Errors
/// As [`Polygon::refine`].
pub fn figure(context: &Context) -> Result<Figure> {
    let mut panels = Vec::new();
    for family in &FAMILIES {
        let mask = mask(family.name)?;
        panels.extend(pair(family.name, |polygon| stationary(context, &mask, polygon))?);
    }
    for family in &NON_STATIONARY {
        panels.extend(pair(family.name, |polygon| changing(context, family.name, polygon))?);
    }
    Ok(Figure { panels, columns: 8, size: [190, 160] })
}

fn pair(
    name: &str,
    refined: impl Fn(&Polygon<f64>) -> Result<[Polygon<f64>; 2]>,
) -> Result<Vec<Panel>> {
    let of = |(points, closed): (&[f64], bool)| {
        let ends = if closed { Ends::Closed } else { Ends::Kept };
        let control = Polygon::new(points.to_vec(), 2, ends);
        let [refined, limit] = refined(&control)?;
        let shown =
            Refined { control: plane(&control), curve: plane(&refined), limit: plane(&limit) };
        let title = if closed { name.to_owned() } else { String::from(" ") };
        Ok(panel(title, &[shown]))
    };
    POLYGONS.into_iter().zip([true, false]).map(of).collect()
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
            control.refine_with_tension(context, Tension::FourPoint(0.5), steps(2))
        }
        "tension-ternary-four-point" => {
            control.refine_with_tension(context, Tension::TernaryFourPoint(0.5), steps(3))
        }
        _ => control.refine_non_uniform(context, &control.parameters(0.5)?, steps(2)),
    };
    Ok([refined?, nothing()])
}

fn plane(polygon: &Polygon<f64>) -> Vec<[f64; 2]> {
    let closed = (polygon.ends == Ends::Closed).then_some(0);
    let all = (0..polygon.len()).chain(closed);
    all.map(|i| [polygon.point(i)[0], polygon.point(i)[1]]).collect()
}
