//! What a scheme does around a feature: eigenvalues, natural configuration, characteristic map,
//! curvature.

use super::figure::{Axes, Axis, CONTROL, Figure, MARKED, Panel, Part, RESULT};
use carvel::analysis::surface::{CharacteristicMap, CupsAndSaddles, Spectrum};

/// What is drawn of a feature.
#[derive(Debug, Clone, Copy)]
pub struct Shown<'a> {
    /// The faces around it.
    pub faces: usize,
    /// Its eigenvalues.
    pub spectrum: &'a Spectrum,
    /// The map, if there is one.
    pub map: Option<&'a CharacteristicMap>,
    /// Curvatures, around interior features.
    pub curved: Option<&'a CupsAndSaddles>,
}

/// One row of panels for each valence.
pub fn figure(found: &[Shown]) -> Figure {
    // A row has as many panels as any other.
    let columns = if found.iter().all(|shown| shown.curved.is_some()) { 4 } else { 3 };
    let row = |shown: &Shown| {
        let Shown { faces, spectrum, map, curved } = *shown;
        let first = [eigenvalues(faces, spectrum), control(faces, map), sampled(faces, map)];
        let last = curved.map(|curved| curvature(faces, curved));
        first.into_iter().chain(last).take(columns)
    };
    let panels = found.iter().flat_map(row).collect();
    Figure { panels, columns, size: [340, 300] }
}

/// Sizes of curvatures: where they settle the line becomes level.
fn curvature(faces: usize, curved: &CupsAndSaddles) -> Panel {
    let line = |name: &str, values: &[f64], color| {
        let point = |(step, k): (usize, &f64)| [step as f64, k.abs().log10()];
        let points = values.iter().enumerate().map(point).collect();
        Part::line(2.0, color, points).named(name)
    };
    let parts = vec![line("cup", &curved.cup, RESULT), line("saddle", &curved.saddle, MARKED)];
    let axes = Axes::Graph { x: Axis::Count("step"), y: Axis::Real("log10 of Gauss curvature") };
    Panel { title: format!("{faces} faces: curvature"), axes, parts }
}

/// Sizes of eigenvalues by mode, with λ and λ².
fn eigenvalues(faces: usize, spectrum: &Spectrum) -> Panel {
    let all = spectrum.eigenvalues();
    let sizes = all.iter().map(|e| [e.mode as f64, e.size()]).collect();
    let jordan = all.iter().filter(|e| e.vectors < e.copies);
    let jordan: Vec<_> = jordan.map(|e| [e.mode as f64, e.size()]).collect();
    let most = all.iter().map(|e| e.mode).max().unwrap_or(0).max(1) as f64;
    let level = |y: f64| Part::line(1.0, CONTROL, vec![[0.0, y], [most, y]]);
    let lambda = spectrum.lambda();
    let blocks = Part::dots(4.0, MARKED, jordan.clone());
    let blocks = if jordan.is_empty() { blocks } else { blocks.named("Jordan block") };
    let parts = vec![
        level(lambda).named("lambda, its square"),
        level(lambda * lambda),
        blocks,
        Part::dots(2.5, RESULT, sizes),
    ];
    let axes = Axes::Graph { x: Axis::Count("mode"), y: Axis::Real("size of eigenvalue") };
    Panel { title: format!("{faces} faces: spectrum"), axes, parts }
}

fn control(faces: usize, map: Option<&CharacteristicMap>) -> Panel {
    let polygons = map.map_or(&[][..], |map| &map.control);
    let outline = |polygon: &Vec<[f64; 2]>| {
        let closed = polygon.iter().chain(polygon.first()).copied().collect();
        [Part::line(1.0, RESULT, closed), Part::dots(2.0, MARKED, polygon.clone())]
    };
    let title = format!("{faces} faces: natural configuration");
    Panel { title, axes: Axes::Shape, parts: polygons.iter().flat_map(outline).collect() }
}

fn sampled(faces: usize, map: Option<&CharacteristicMap>) -> Panel {
    let title = match map {
        Some(_) => format!("{faces} faces: characteristic map"),
        None => format!("{faces} faces: no characteristic map"),
    };
    let ring = map.map_or(&[][..], |map| &map.ring).iter();
    let inside = map.map_or(&[][..], |map| &map.inside).iter();
    let lighter = |part: Part| Part { color: part.color.map(|c| c / 2 + 127), ..part };
    let parts = inside.map(|face| lighter(Part::face(face.clone())));
    let parts = parts.chain(ring.map(|face| Part::face(face.clone()))).collect();
    Panel { title, axes: Axes::Shape, parts }
}
