//! Samples into pixels: shading, lines and background, averaged as light.

use super::color::{Encoder, to_linear};
use super::image::Image;
use super::material::Material;
use super::raster::{Band, Sample};
use super::view::{View, Wireframe};
use glam::{Vec3, Vec4};

/// Lines on surfaces and on light backgrounds, and lines on dark ones.
const DARK_LINE: Vec3 = Vec3::new(0.010, 0.013, 0.020);
const LIGHT_LINE: Vec3 = Vec3::new(0.75, 0.80, 0.88);
/// The opacity of lines over a shaded surface.
const OVERLAY_OPACITY: f32 = 0.8;

/// Colours of a picture's parts, in light, multiplied by their opacity.
pub struct Resolver {
    material: Material,
    encoder: Encoder,
    background: Vec4,
    background_bytes: [u8; 4],
    line: Vec3,
    line_opacity: f32,
    shaded: bool,
    scale: u32,
}

impl Resolver {
    /// Prepares for a view whose camera sees the up axis in a direction.
    pub fn new(view: &View, sky: Vec3) -> Self {
        let [r, g, b, a] = view.background;
        let light = Vec3::new(to_linear(r), to_linear(g), to_linear(b));
        let opacity = f32::from(a) / 255.0;
        let shaded = view.wireframe != Wireframe::Only;
        let on_dark = !shaded && a >= 128 && light.dot(Vec3::new(0.21, 0.72, 0.07)) < 0.18;
        Self {
            material: Material::new(sky, view.stripes),
            encoder: Encoder::new(),
            background: (light * opacity).extend(opacity),
            background_bytes: view.background,
            line: if on_dark { LIGHT_LINE } else { DARK_LINE },
            line_opacity: if shaded { OVERLAY_OPACITY } else { 1.0 } / 255.0,
            shaded,
            scale: view.supersample,
        }
    }

    /// Turns a band into `rows` rows of pixels from `top` on.
    pub fn resolve(&self, band: &Band, top: u32, rows: u32, image: &mut Image) {
        for y in top..top + rows {
            for (x, pixel) in image.row_mut(y).iter_mut().enumerate() {
                *pixel = self.pixel(band, x, y);
            }
        }
    }

    fn pixel(&self, band: &Band, x: usize, y: u32) -> [u8; 4] {
        let n = self.scale as usize;
        let rows = (y * self.scale..(y + 1) * self.scale).map(|row| band.row(row as i32));
        let samples = rows.flat_map(|row| &row[x * n..(x + 1) * n]);
        if samples.clone().all(|s| self.is_background(s)) {
            return self.background_bytes;
        }
        let sum = samples.map(|s| self.color(s)).sum::<Vec4>();
        self.encode(sum / (n * n) as f32)
    }

    fn is_background(&self, sample: &Sample) -> bool {
        sample.line == 0 && !(self.shaded && sample.inverse_depth > 0.0)
    }

    /// The colour of a sample, multiplied by its opacity.
    fn color(&self, sample: &Sample) -> Vec4 {
        let under = if self.shaded && sample.inverse_depth > 0.0 {
            let normal = Vec3::from(sample.normal.map(f32::from));
            let light = self.material.shade(normal, sample.back);
            light.clamp(Vec3::ZERO, Vec3::ONE).extend(1.0)
        } else {
            self.background
        };
        under.lerp(self.line.extend(1.0), f32::from(sample.line) * self.line_opacity)
    }

    fn encode(&self, color: Vec4) -> [u8; 4] {
        let light = color.truncate() / color.w.max(1e-6);
        let [r, g, b] = light.to_array().map(|x| self.encoder.encode(x));
        [r, g, b, (255.0 * color.w.clamp(0.0, 1.0) + 0.5) as u8]
    }
}
