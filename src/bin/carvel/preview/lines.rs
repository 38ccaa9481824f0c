//! The wireframe: polygon edges as anti-aliased lines with a depth test.
//!
//! Lines leave the surface untouched: each sample keeps the largest opacity of
//! the lines over it, so that edges shared by two faces, drawn twice, look as
//! if drawn once, in any order. Edges of faces that are only a few pixels wide
//! fade out; a fine mesh is seen as a surface, not as a black shape.

use super::camera::{Camera, Point, SUBSAMPLE};
use super::raster::Band;
use super::scene::Scene;
use super::view::View;
use glam::Vec2;

/// The width of a line in pixels, in a picture of up to `THIN_UNTIL` pixels.
const WIDTH: f32 = 1.3;
/// From this side on, lines grow with the picture.
const THIN_UNTIL: f32 = 1200.0;
/// The width in pixels of faces whose edges vanish, and of those whose edges
/// are drawn in full.
const FADE: (f32, f32) = (1.5, 7.0);
/// The opacity left to long edges of thin faces: of those seen edge-on.
const EDGE_ON: f32 = 0.3;
/// How much nearer than the surface a line is taken to be: half its width
/// times the slope of the face, within these limits.
const SLOPES: (f32, f32) = (1.0, 6.0);

/// Draws the edges of all faces into a band that has been filled.
pub fn draw(scene: &Scene<'_>, camera: &Camera, view: &View, band: &mut Band) {
    let growth = (view.width.min(view.height) as f32 / THIN_UNTIL).max(1.0);
    let pixel = growth * view.supersample as f32;
    let pen = Pen { pixel, half_width: 0.5 * WIDTH * pixel };
    for face in scene.faces() {
        if pen.touches(scene, face, band) {
            pen.outline(scene, camera, face, band);
        }
    }
}

/// How lines are drawn, in samples.
struct Pen {
    /// A pixel, or what counts as one in a picture so large that lines grow.
    pixel: f32,
    half_width: f32,
}

impl Pen {
    /// Whether lines around a face may reach the band.
    fn touches(&self, scene: &Scene<'_>, face: &[u32], band: &Band) -> bool {
        let reach = (self.half_width + 1.0) as i32 + 1;
        let (low, high) = face.iter().fold((i32::MAX, i32::MIN), |(low, high), &v| {
            let y = scene.point(v).y;
            (low.min(y), high.max(y))
        });
        let rows = band.rows();
        low / SUBSAMPLE <= rows.end + reach && high / SUBSAMPLE >= rows.start - reach
    }

    /// Draws the edges of one face.
    fn outline(&self, scene: &Scene<'_>, camera: &Camera, face: &[u32], band: &mut Band) {
        let edges = || edges(face).map(|(a, b)| (scene.point(a), scene.point(b)));
        let shape = Shape::of(edges());
        let solid = fade(shape.thickness / self.pixel);
        if solid.max(fade(shape.longest / self.pixel)) <= 0.0 {
            return;
        }
        let rise = slope(scene, face) * (self.half_width + 0.5);
        for (a, b) in edges() {
            let length = place(a).distance(place(b));
            let opacity = solid.max(EDGE_ON * fade(length / self.pixel));
            let w = a.inverse_depth.max(b.inverse_depth);
            let bias = rise * camera.sample_size(w) * w * w;
            Line { a, b, half_width: self.half_width, opacity, bias }.draw(band);
        }
    }
}

/// The directed edges of a polygon.
fn edges(face: &[u32]) -> impl Iterator<Item = (u32, u32)> {
    let next = face.iter().cycle().skip(1);
    face.iter().copied().zip(next.copied())
}

/// A place on the screen in samples.
fn place(p: Point) -> Vec2 {
    Vec2::new(p.x as f32, p.y as f32) / SUBSAMPLE as f32
}

/// How large a polygon appears, in samples.
struct Shape {
    /// The side of a square, the lesser side of other faces or less.
    thickness: f32,
    /// The longest edge.
    longest: f32,
}

impl Shape {
    fn of(edges: impl Iterator<Item = (Point, Point)>) -> Self {
        let (mut double_area, mut length, mut longest) = (0.0, 0.0, 0.0_f32);
        let mut first = None;
        for (a, b) in edges {
            let (a, b) = (place(a), place(b));
            let origin = *first.get_or_insert(a);
            let edge = a.distance(b);
            double_area += (a - origin).perp_dot(b - origin);
            length += edge;
            longest = longest.max(edge);
        }
        let thickness = if length > 0.0 { 2.0 * double_area.abs() / length } else { 0.0 };
        Self { thickness, longest }
    }
}

/// Opacity of the edges of faces of a width in pixels.
fn fade(width: f32) -> f32 {
    let t = ((width - FADE.0) / (FADE.1 - FADE.0)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// How steeply a face recedes, within limits.
fn slope(scene: &Scene<'_>, face: &[u32]) -> f32 {
    let normal = scene.face_normal(face);
    let slope = normal.truncate().length() / normal.z.abs().max(1e-3);
    slope.clamp(SLOPES.0, SLOPES.1)
}

/// One edge on the screen.
struct Line {
    a: Point,
    b: Point,
    /// In samples.
    half_width: f32,
    opacity: f32,
    /// What is added to the inverse depth before it is compared.
    bias: f32,
}

impl Line {
    fn draw(&self, band: &mut Band) {
        if self.opacity <= 0.0 {
            return;
        }
        let (a, b) = (place(self.a), place(self.b));
        let reach = self.half_width + 0.5;
        let held = band.rows();
        for y in within(a.y.min(b.y) - reach, a.y.max(b.y) + reach, held.start, held.end) {
            let (from, to) = row_interval(a, b, y as f32 + 0.5, reach);
            for x in within(from, to, 0, band.width()) {
                self.touch(Vec2::new(x as f32 + 0.5, y as f32 + 0.5), x, y, band);
            }
        }
    }

    /// Draws one sample, if the line is there and nothing is before it.
    fn touch(&self, at: Vec2, x: i32, y: i32, band: &mut Band) {
        let (a, b) = (place(self.a), place(self.b));
        let along = b - a;
        let t = ((at - a).dot(along) / along.length_squared().max(1e-6)).clamp(0.0, 1.0);
        let coverage = (self.half_width + 0.5 - at.distance(a + t * along)).clamp(0.0, 1.0);
        let (near, far) = (self.a.inverse_depth, self.b.inverse_depth);
        let inverse_depth = near + t * (far - near) + self.bias;
        let sample = &mut band.row_mut(y)[x as usize];
        if inverse_depth >= sample.inverse_depth {
            let opacity = (255.0 * coverage * self.opacity + 0.5) as u8;
            sample.line = sample.line.max(opacity);
        }
    }
}

/// The samples in [from, to) whose middle lies in an interval.
fn within(low: f32, high: f32, from: i32, to: i32) -> std::ops::Range<i32> {
    let first = (low - 0.5).ceil() as i32;
    let end = ((high - 0.5).floor() as i32).saturating_add(1);
    first.max(from)..end.min(to)
}

/// Where a row cuts the strip of points no further than `reach` from a line.
fn row_interval(a: Vec2, b: Vec2, y: f32, reach: f32) -> (f32, f32) {
    let (low, high) = (a.x.min(b.x) - reach, a.x.max(b.x) + reach);
    let along = b - a;
    let flat = along.y.abs() < 1e-3 * along.length();
    if flat || along == Vec2::ZERO {
        return (low, high);
    }
    let x = a.x + (y - a.y) * along.x / along.y;
    let spread = reach * along.length() / along.y.abs();
    (low.max(x - spread), high.min(x + spread))
}
