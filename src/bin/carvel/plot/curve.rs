//! Polygons, what comes of them, and points of the limit.

use super::figure::{Axes, CONTROL, Figure, MARKED, Panel, Part, RESULT};

/// A polygon and its refinement, in the plane.
#[derive(Debug, Clone, Default)]
pub struct Refined {
    /// Control points; the first once more at the end of a closed polygon.
    pub control: Vec<[f64; 2]>,
    /// Refined points, likewise.
    pub curve: Vec<[f64; 2]>,
    /// Points of the limit that belong to control points.
    pub limit: Vec<[f64; 2]>,
}

impl Refined {
    fn parts(&self) -> [Part; 4] {
        [
            Part::line(1.0, CONTROL, self.control.clone()),
            Part::dots(2.5, CONTROL, self.control.clone()),
            Part::line(1.5, RESULT, self.curve.clone()),
            Part::dots(2.0, MARKED, self.limit.clone()),
        ]
    }
}

/// A panel of several polygons.
pub fn panel(title: String, polygons: &[Refined]) -> Panel {
    Panel { title, axes: Axes::Shape, parts: polygons.iter().flat_map(Refined::parts).collect() }
}

/// One panel as a picture.
pub fn figure(title: String, polygons: &[Refined]) -> Figure {
    Figure { panels: vec![panel(title, polygons)], columns: 1, size: [640, 480] }
}
