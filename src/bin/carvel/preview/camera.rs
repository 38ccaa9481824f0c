//! The camera: a turntable view with a gentle perspective, fitted to the frame.
//!
//! Coordinates of any size are first brought into a sphere of radius 1 (in
//! doubles, so that 1e308 and 1e-308 work), then turned so that the viewer
//! looks along −z, then projected. The eye stands outside the sphere: depths
//! are positive and nothing is ever clipped.

use super::polygons::Checked;
use super::view::{Up, View};
use carvel::Result;
use glam::{DVec3, Mat3, Vec2, Vec3};

/// Distance of the eye from the centre, in radii: an opening of 25 degrees.
const EYE: f32 = 4.6;
/// Part of the frame left free on each side.
const MARGIN: f32 = 0.05;
/// The smallest extent that is blown up to fill the frame, in radii: an object
/// seen exactly along its only direction stays a speck.
const SMALLEST_EXTENT: f32 = 1e-3;
/// Steps of fixed-point screen coordinates per sample.
pub const SUBSAMPLE: i32 = 256;

/// A point on the screen, in steps of 1/256 sample from the top left, and the
/// inverse of its depth, which is linear on the screen and larger nearer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Point {
    pub x: i32,
    pub y: i32,
    pub inverse_depth: f32,
}

/// The sphere around the used vertices.
///
/// `unit` is the largest coordinate; the rest is in terms of it, so that no
/// difference or square overflows.
struct Sphere {
    unit: f64,
    center: DVec3,
    radius: f64,
}

impl Sphere {
    fn around(meshes: &[Checked<'_>]) -> Self {
        let vertices = || meshes.iter().flat_map(Checked::used_vertices).map(|(_, p)| p);
        let largest = vertices().flatten().fold(0.0, |m: f64, x| m.max(x.abs()));
        let unit = if largest > 0.0 { largest } else { 1.0 };
        let scaled = || vertices().map(|p| DVec3::from(p) / unit);
        let low = scaled().reduce(DVec3::min).unwrap_or_default();
        let high = scaled().reduce(DVec3::max).unwrap_or_default();
        let center = 0.5 * (low + high);
        let radius = scaled().map(|p| p.distance_squared(center)).fold(0.0, f64::max).sqrt();
        Self { unit, center, radius: if radius > 0.0 { radius } else { 1.0 } }
    }

    fn local(&self, p: [f64; 3]) -> Vec3 {
        ((DVec3::from(p) / self.unit - self.center) / self.radius).as_vec3()
    }
}

/// Everything between a vertex and its place on the screen.
pub struct Camera {
    sphere: Sphere,
    rotation: Mat3,
    sky: Vec3,
    /// Samples per unit of the image plane at distance 1.
    zoom: f32,
    /// Where the plane's origin lies on the screen, in samples.
    origin: Vec2,
}

impl Camera {
    /// The camera of a view that just contains all meshes.
    ///
    /// # Errors
    /// `ParameterOutOfRange` for a view outside its ranges.
    pub fn fit(meshes: &[Checked<'_>], view: &View) -> Result<Self> {
        view.check()?;
        let sphere = Sphere::around(meshes);
        let (rotation, sky) = turntable(view);
        let vertices = meshes.iter().flat_map(Checked::used_vertices);
        let plane = |p| on_plane(rotation * sphere.local(p));
        let (low, high) = vertices
            .map(|(_, p)| plane(p))
            .fold((Vec2::MAX, Vec2::MIN), |(low, high), q| (low.min(q), high.max(q)));
        let (low, high) = if low.x <= high.x { (low, high) } else { (Vec2::ZERO, Vec2::ZERO) };
        let frame = Vec2::new(view.width as f32, view.height as f32) * view.supersample as f32;
        let extent = (high - low).max(Vec2::splat(SMALLEST_EXTENT / EYE));
        let zoom = ((1.0 - 2.0 * MARGIN) * frame / extent).min_element();
        let middle = 0.5 * (low + high) * Vec2::new(1.0, -1.0);
        Ok(Self { sphere, rotation, sky, zoom, origin: 0.5 * frame - zoom * middle })
    }

    /// A vertex as the viewer sees it: x right, y up, z towards the viewer.
    pub fn to_view(&self, p: [f64; 3]) -> Vec3 {
        self.rotation * self.sphere.local(p)
    }

    /// Projects a point given in view coordinates.
    pub fn project(&self, p: Vec3) -> Point {
        let q = on_plane(p) * Vec2::new(1.0, -1.0) * self.zoom + self.origin;
        let fixed = |x: f32| libm::roundf(x * SUBSAMPLE as f32) as i32;
        Point { x: fixed(q.x), y: fixed(q.y), inverse_depth: 1.0 / (EYE - p.z) }
    }

    /// By rows, the matrix from (x, y, z, 1) to clip coordinates: from −w to w across the picture.
    pub fn matrix(&self, view: &View) -> [[f64; 4]; 4] {
        let Sphere { unit, center, radius } = self.sphere;
        let [x, y, z] = [0, 1, 2].map(|k| {
            let row = self.rotation.row(k).as_dvec3();
            let scaled = row / (unit * radius);
            [scaled.x, scaled.y, scaled.z, -row.dot(center) / radius]
        });
        let w = [-z[0], -z[1], -z[2], f64::from(EYE) - z[3]];
        let samples = f64::from(view.supersample);
        let zoom = f64::from(self.zoom);
        // On a side of n samples sample i lies at 2i/n − 1.
        let across = |along: [f64; 4], pixels: u32, origin: f32, sign: f64| {
            let half = f64::from(pixels) * samples / 2.0;
            let shift = (f64::from(origin) - half) / half;
            [0, 1, 2, 3].map(|k| zoom / half * along[k] + sign * shift * w[k])
        };
        let right = across(x, view.width, self.origin.x, 1.0);
        let up = across(y, view.height, self.origin.y, -1.0);
        [right, up, [0.0; 4], w]
    }

    /// The size of a sample at a depth, in view coordinates.
    pub fn sample_size(&self, inverse_depth: f32) -> f32 {
        1.0 / (self.zoom * inverse_depth)
    }

    /// The up direction in view coordinates.
    pub fn sky(&self) -> Vec3 {
        self.sky
    }
}

/// Projection onto the plane at distance 1 from the eye.
fn on_plane(p: Vec3) -> Vec2 {
    p.truncate() / (EYE - p.z)
}

/// The rotation into view coordinates, and where it takes the up axis.
fn turntable(view: &View) -> (Mat3, Vec3) {
    // In doubles and reduced first: huge angles are as good as small ones.
    let (sin_a, cos_a) = libm::sincos((f64::from(view.azimuth) % 360.0).to_radians());
    let (sin_e, cos_e) = libm::sincos((f64::from(view.elevation) % 360.0).to_radians());
    let (sin_a, cos_a) = (sin_a as f32, cos_a as f32);
    let (sin_e, cos_e) = (sin_e as f32, cos_e as f32);
    let turn =
        Mat3::from_cols(Vec3::new(cos_a, 0.0, sin_a), Vec3::Y, Vec3::new(-sin_a, 0.0, cos_a));
    let tilt =
        Mat3::from_cols(Vec3::X, Vec3::new(0.0, cos_e, sin_e), Vec3::new(0.0, -sin_e, cos_e));
    let upright = match view.up {
        Up::Y => Mat3::IDENTITY,
        Up::Z => Mat3::from_cols(Vec3::X, Vec3::NEG_Z, Vec3::Y),
    };
    let rotation = tilt * turn * upright;
    let sky = match view.up {
        Up::Y => rotation.y_axis,
        Up::Z => rotation.z_axis,
    };
    (rotation, sky)
}

#[cfg(test)]
mod tests {
    use super::super::polygons::Polygons;
    use super::*;

    fn camera(positions: &[[f64; 3]], view: &View) -> Camera {
        let mesh = Polygons { positions, face_sizes: &[3], face_vertices: &[0, 1, 2] };
        Camera::fit(&[mesh.check().unwrap()], view).unwrap()
    }

    #[test]
    fn the_sky_is_where_the_up_axis_points() {
        let corners = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        for (up, axis) in [(Up::Y, [0.0, 1.0, 0.0]), (Up::Z, [0.0, 0.0, 1.0])] {
            for elevation in [-90.0, -20.0, 0.0, 50.0, 90.0] {
                let camera = camera(&corners, &View { elevation, up, ..View::default() });
                let above = camera.to_view(axis) - camera.to_view([0.0; 3]);
                assert!(camera.sky().distance(above.normalize()) < 1e-6, "{up:?} {elevation}");
                assert!(elevation.abs() > 80.0 || camera.sky().y > 0.5);
            }
        }
    }

    #[test]
    fn coinciding_points_lie_in_the_middle() {
        let view = View { width: 30, height: 20, supersample: 1, ..View::default() };
        for point in [[0.0; 3], [1e308; 3], [1e-320, 0.0, 5.0]] {
            let camera = camera(&[point; 3], &view);
            let middle = Point { x: 15 * SUBSAMPLE, y: 10 * SUBSAMPLE, inverse_depth: 1.0 / EYE };
            assert_eq!(camera.project(camera.to_view(point)), middle);
        }
    }
}
