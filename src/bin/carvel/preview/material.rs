//! The look of a surface: a matt blue-grey front, a warm back, studio light.
//!
//! Light comes from a dome (brighter above than below, fixed to the world), a
//! key light over the viewer's left shoulder and a dim one from the right, both
//! fixed to the viewer so that no side of an object is ever dark; a soft
//! highlight and a rim that lifts the outline complete it.
//!
//! Or reflection lines: stripes of light far away all around, from the viewer's left to the right
//! like long lamps. Where the surface has a tangent plane they are unbroken, where its curvature is
//! continuous they have no corners (Klass, *Correction of local surface irregularities using
//! reflection lines*, CAD 12, 1980).

use glam::Vec3;

/// Colours are amounts of light.
const FRONT: Vec3 = Vec3::new(0.27, 0.36, 0.49);
const BACK: Vec3 = Vec3::new(0.60, 0.24, 0.11);
const SKY: Vec3 = Vec3::new(0.42, 0.46, 0.52);
const GROUND: Vec3 = Vec3::new(0.10, 0.09, 0.085);
const KEY: Vec3 = Vec3::new(1.12, 1.07, 1.0);
const FILL: Vec3 = Vec3::new(0.12, 0.14, 0.18);
const RIM: Vec3 = Vec3::new(0.16, 0.19, 0.23);
const GLOSS: f32 = 0.14;
/// What the gap between two stripes leaves of a colour.
const GAP: f32 = 0.08;

/// The lights, ready for one camera.
pub struct Material {
    sky: Vec3,
    key: Vec3,
    half: Vec3,
    fill: Vec3,
    stripes: u32,
}

impl Material {
    /// Lights for a camera that sees the up axis in a direction, with so many stripes.
    pub fn new(sky: Vec3, stripes: u32) -> Self {
        let key = Vec3::new(-0.55, 0.7, 0.5).normalize();
        Self {
            sky,
            key,
            half: (key + Vec3::Z).normalize(),
            fill: Vec3::new(0.8, 0.1, 0.45).normalize(),
            stripes,
        }
    }

    /// The light that a surface sends to the viewer.
    ///
    /// `normal` is in view coordinates, on the viewer's side, of any length.
    pub fn shade(&self, normal: Vec3, back: bool) -> Vec3 {
        let n = normal.try_normalize().unwrap_or(Vec3::Z);
        let color = if back { BACK } else { FRONT };
        let dome = GROUND.lerp(SKY, 0.5 + 0.5 * n.dot(self.sky));
        let key = ((n.dot(self.key) + 0.1) / 1.1).max(0.0);
        let fill = n.dot(self.fill).max(0.0);
        let edge = 1.0 - n.z.clamp(0.0, 1.0);
        let rim = edge * edge * edge * (0.5 + 0.5 * n.dot(self.sky));
        let light = color * (dome + key * KEY + fill * FILL) + rim * RIM;
        if self.stripes > 0 {
            return if self.is_gap(n) { light * GAP } else { light + GLOSS };
        }
        light + GLOSS * self.highlight(n)
    }

    /// True if the ray from the viewer is reflected in between two stripes.
    fn is_gap(&self, n: Vec3) -> bool {
        let ray = 2.0 * n.z * n - Vec3::Z;
        let turn = libm::atan2f(ray.y, ray.z) / std::f32::consts::TAU + 0.5;
        (turn * 2.0 * self.stripes as f32) as u32 % 2 == 1
    }

    fn highlight(&self, n: Vec3) -> f32 {
        let cosine = n.dot(self.half).max(0.0);
        // The 32nd power, by squaring: the same on every machine.
        (0..5).fold(cosine, |power, _| power * power)
    }
}
