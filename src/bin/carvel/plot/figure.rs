//! A figure as plain data: panels of lines, dots and polygons.

/// Panels in rows from the top left.
#[derive(Debug, Clone)]
pub struct Figure {
    /// All panels.
    pub panels: Vec<Panel>,
    /// Panels in a row.
    pub columns: usize,
    /// Width and height of a panel in pixels.
    pub size: [u32; 2],
}

/// One coordinate system with what is drawn in it, back to front.
#[derive(Debug, Clone)]
pub struct Panel {
    /// The line above it.
    pub title: String,
    /// Its axes.
    pub axes: Axes,
    /// What is drawn.
    pub parts: Vec<Part>,
}

/// The axes of a panel.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Axes {
    /// None, and one scale for both directions: a shape.
    Shape,
    /// Both, with their names, each scale as the data ask for.
    Graph {
        /// What goes from left to right.
        x: Axis,
        /// What goes up.
        y: Axis,
    },
}

/// An axis by its name.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Axis {
    /// Of any numbers.
    Real(&'static str),
    /// Of integers.
    Count(&'static str),
}

impl Axis {
    /// The name, which may be empty.
    pub fn name(self) -> &'static str {
        match self {
            Self::Real(name) | Self::Count(name) => name,
        }
    }
}

/// Points, and how they are shown. None, or points that are not finite, show nothing.
#[derive(Debug, Clone)]
pub struct Part {
    /// How.
    pub mark: Mark,
    /// In the panel's coordinates.
    pub points: Vec<[f64; 2]>,
    /// The colour.
    pub color: Color,
    /// The name in the panel's key.
    pub name: Option<String>,
}

/// How points are shown.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Mark {
    /// Joined by a line so many pixels wide.
    Line(f64),
    /// Each by a dot of such a radius.
    Dots(f64),
    /// The inside of their polygon, and a thin outline.
    Face,
    /// Not at all, but the panel has room for them.
    Nothing,
}

/// Red, green and blue.
pub type Color = [u8; 3];

/// What is given: control polygons and meshes.
pub const CONTROL: Color = [150, 150, 150];
/// What comes of it.
pub const RESULT: Color = [20, 90, 170];
/// What stands out.
pub const MARKED: Color = [200, 60, 30];
/// The inside of faces.
pub const FACES: Color = [150, 190, 225];
/// Colours of things that are told apart.
pub const DISTINCT: [Color; 4] = [RESULT, MARKED, [30, 130, 60], [125, 70, 150]];

impl Part {
    /// A line.
    pub fn line(width: f64, color: Color, points: Vec<[f64; 2]>) -> Self {
        Self { mark: Mark::Line(width), points, color, name: None }
    }

    /// Dots.
    pub fn dots(radius: f64, color: Color, points: Vec<[f64; 2]>) -> Self {
        Self { mark: Mark::Dots(radius), points, color, name: None }
    }

    /// A face.
    pub fn face(points: Vec<[f64; 2]>) -> Self {
        Self { mark: Mark::Face, points, color: FACES, name: None }
    }

    /// The same with a name in the key.
    #[must_use]
    pub fn named(self, name: impl Into<String>) -> Self {
        Self { name: Some(name.into()), ..self }
    }
}

impl Panel {
    /// The smallest and largest coordinates, with a margin; [0, 1] where there are none.
    pub fn bounds(&self) -> [[f64; 2]; 2] {
        let mut bounds = [[f64::INFINITY, f64::NEG_INFINITY]; 2];
        let finite = |point: &&[f64; 2]| point.iter().all(|x| x.is_finite());
        for point in self.parts.iter().flat_map(|part| &part.points).filter(finite) {
            for ([low, high], x) in bounds.iter_mut().zip(point) {
                (*low, *high) = (low.min(*x), high.max(*x));
            }
        }
        bounds.map(|[low, high]| match high - low {
            width if width > 0.0 && width.is_finite() => [low - width / 20.0, high + width / 20.0],
            _ if low.is_finite() => {
                let margin = (low.abs() / 10.0).max(1.0);
                [low - margin, low + margin]
            }
            _ => [0.0, 1.0],
        })
    }
}

/// `bounds` made larger in one direction, so that a picture of `size` has one scale for both.
pub fn equalised([x, y]: [[f64; 2]; 2], size: [u32; 2]) -> [[f64; 2]; 2] {
    let [width, height] = size.map(|n| f64::from(n.max(1)));
    let unit = ((x[1] - x[0]) / width).max((y[1] - y[0]) / height);
    let about = |[low, high]: [f64; 2], n: f64| {
        let middle = f64::midpoint(low, high);
        [middle - unit * n / 2.0, middle + unit * n / 2.0]
    };
    [about(x, width), about(y, height)]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn panel(points: Vec<[f64; 2]>) -> Panel {
        let parts = vec![Part::line(1.0, RESULT, points)];
        Panel { title: String::new(), axes: Axes::Shape, parts }
    }

    #[test]
    fn bounds_hold_all_points_and_are_never_empty() {
        assert_eq!(panel(vec![[0.0, 1.0], [20.0, 3.0]]).bounds(), [[-1.0, 21.0], [0.9, 3.1]]);
        assert_eq!(panel(vec![]).bounds(), [[0.0, 1.0]; 2]);
        assert_eq!(panel(vec![[f64::NAN, 0.0]]).bounds(), [[0.0, 1.0]; 2]);
        assert_eq!(panel(vec![[100.0, 0.0]]).bounds(), [[90.0, 110.0], [-1.0, 1.0]]);
    }

    #[test]
    fn one_scale_for_both_directions() {
        let [x, y] = equalised([[0.0, 2.0], [0.0, 1.0]], [100, 200]);
        assert_eq!((x, y), ([0.0, 2.0], [-1.5, 2.5]));
    }
}
