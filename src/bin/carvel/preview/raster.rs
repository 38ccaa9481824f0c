//! The rasteriser: triangles into depth and normals, one band of rows at a time.
//!
//! Coverage is decided in integers (points in steps of 1/256 sample, the
//! top-left rule): triangles that share an edge leave no gap and no sample
//! twice, on any machine.

use super::camera::{Point, SUBSAMPLE};
use super::view::View;
use carvel::{Error, ErrorKind, Result};
use glam::Vec3;

/// Samples that a band keeps, unless one row of pixels needs more.
pub const BAND_SAMPLES: usize = 1 << 22;
/// The largest component of a stored normal.
pub const NORMAL_SCALE: f32 = 32767.0;

/// What is seen at one sample.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    /// Inverse depth; 0 where nothing is.
    pub inverse_depth: f32,
    /// The normal in view coordinates, scaled, turned towards the viewer.
    pub normal: [i16; 3],
    /// Whether a face's back is seen.
    pub back: bool,
    /// Opacity of the lines drawn over the sample.
    pub line: u8,
}

impl Sample {
    const EMPTY: Self = Self { inverse_depth: 0.0, normal: [0; 3], back: false, line: 0 };
}

/// A corner of a triangle to fill.
#[derive(Debug, Clone, Copy)]
pub struct Corner {
    pub point: Point,
    /// A unit normal on the side from which the face is counter-clockwise.
    pub normal: Vec3,
}

/// The samples of some rows of the picture.
pub struct Band {
    samples: Vec<Sample>,
    /// Samples per row, rows in the picture, samples per pixel and axis.
    width: i32,
    height: i32,
    scale: u32,
    /// The most rows that fit; the rows kept now.
    capacity: i32,
    top: i32,
    rows: i32,
}

impl Band {
    /// Room for bands of a checked view's picture: rows of pixels that together
    /// have no more than `samples` samples, but at least one row.
    ///
    /// # Errors
    /// `OutOfResources` if there is no memory.
    pub fn new(view: &View, samples: usize) -> Result<Self> {
        let scale = view.supersample;
        let width = (view.width * scale) as usize;
        let pixel_row = width * scale as usize;
        let pixel_rows = (samples / pixel_row).clamp(1, view.height as usize);
        let mut samples = Vec::new();
        if samples.try_reserve_exact(pixel_rows * pixel_row).is_err() {
            let message = "no memory for the samples of a picture";
            return Err(Error::new(ErrorKind::OutOfResources, message));
        }
        Ok(Self {
            samples,
            width: width as i32,
            height: (view.height * scale) as i32,
            scale,
            capacity: (pixel_rows * scale as usize) as i32,
            top: 0,
            rows: 0,
        })
    }

    /// Clears the band and moves it to start at a row of pixels. Returns how
    /// many rows of pixels it holds there.
    pub fn start(&mut self, pixel_row: u32) -> u32 {
        self.top = (pixel_row * self.scale) as i32;
        self.rows = self.capacity.min(self.height - self.top);
        self.samples.clear();
        self.samples.resize((self.rows * self.width) as usize, Sample::EMPTY);
        self.rows as u32 / self.scale
    }

    /// Samples per row.
    pub fn width(&self) -> i32 {
        self.width
    }

    /// The rows of samples held, numbered from the top of the picture.
    pub fn rows(&self) -> std::ops::Range<i32> {
        self.top..self.top + self.rows
    }

    /// A row of samples, numbered from the top of the picture.
    pub fn row(&self, y: i32) -> &[Sample] {
        &self.samples[((y - self.top) * self.width) as usize..][..self.width as usize]
    }

    /// The same, to draw on.
    pub fn row_mut(&mut self, y: i32) -> &mut [Sample] {
        &mut self.samples[((y - self.top) * self.width) as usize..][..self.width as usize]
    }

    /// Whether the box around some points contains the middle of a sample held.
    pub fn touches(&self, points: impl IntoIterator<Item = Point>) -> bool {
        let (mut x, mut y) = (Interval::NONE, Interval::NONE);
        for p in points {
            x = x.including(p.x);
            y = y.including(p.y);
        }
        let (x, y) = (x.samples(0, self.width), y.samples(self.top, self.top + self.rows));
        !x.is_empty() && !y.is_empty()
    }

    /// Draws a triangle; of two at the same depth the first one stays.
    pub fn triangle(&mut self, corners: [Corner; 3]) {
        let Some(setup) = Setup::new(corners) else { return };
        let ys = setup.interval(|p| p.y).samples(self.top, self.top + self.rows);
        let xs = setup.interval(|p| p.x).samples(0, self.width);
        for y in ys {
            let Some((span, weights)) = setup.span(xs.clone(), y) else { continue };
            let row = &mut self.row_mut(y)[span.start as usize..span.end as usize];
            setup.fill(row, weights);
        }
    }
}

/// An interval of fixed-point coordinates, ends included.
struct Interval(i32, i32);

impl Interval {
    const NONE: Self = Self(i32::MAX, i32::MIN);

    fn including(self, x: i32) -> Self {
        Self(self.0.min(x), self.1.max(x))
    }

    /// The samples in [from, to) whose middle lies in the interval.
    fn samples(&self, from: i32, to: i32) -> std::ops::Range<i32> {
        let half = i64::from(SUBSAMPLE / 2);
        let step = i64::from(SUBSAMPLE);
        let first = (i64::from(self.0) - half + step - 1).div_euclid(step);
        let end = (i64::from(self.1) - half).div_euclid(step) + 1;
        first.max(from.into()) as i32..end.min(to.into()) as i32
    }
}

/// The fixed-point coordinate of a sample's middle.
fn middle(sample: i32) -> i64 {
    i64::from(sample) * i64::from(SUBSAMPLE) + i64::from(SUBSAMPLE / 2)
}

/// A side of a triangle as a linear function that is not negative inside.
struct Side {
    origin: Point,
    dx: i64,
    dy: i64,
    /// −1 on the sides that do not own the samples exactly on them.
    bias: i64,
}

impl Side {
    fn new(a: Point, b: Point) -> Self {
        let (dx, dy) = (i64::from(b.x) - i64::from(a.x), i64::from(b.y) - i64::from(a.y));
        let owns = dy < 0 || (dy == 0 && dx > 0);
        Self { origin: a, dx, dy, bias: if owns { 0 } else { -1 } }
    }

    /// Twice the area of the triangle that the side forms with a point.
    fn at(&self, x: i64, y: i64) -> i64 {
        self.dx * (y - i64::from(self.origin.y)) - self.dy * (x - i64::from(self.origin.x))
    }

    /// Narrows a row of samples to those inside.
    fn clip(&self, xs: std::ops::Range<i32>, y: i32) -> std::ops::Range<i32> {
        let value = self.at(middle(xs.start), middle(y)) + self.bias;
        let slope = -self.dy * i64::from(SUBSAMPLE);
        let (start, end) = (i64::from(xs.start), i64::from(xs.end));
        match slope {
            0 if value < 0 => xs.start..xs.start,
            0 => xs,
            1.. if value >= 0 => xs,
            1.. => (start + (slope - 1 - value) / slope).min(end) as i32..xs.end,
            _ if value < 0 => xs.start..xs.start,
            _ => xs.start..(start + value / -slope + 1).min(end) as i32,
        }
    }
}

/// A triangle made ready: counter-clockwise on the screen, not collapsed.
struct Setup {
    corners: [Corner; 3],
    sides: [Side; 3],
    back: bool,
    per_area: f32,
}

impl Setup {
    fn new(mut corners: [Corner; 3]) -> Option<Self> {
        let [a, b, c] = corners.map(|k| k.point);
        let area = Side::new(a, b).at(i64::from(c.x), i64::from(c.y));
        // Rows run downwards: what is counter-clockwise to the viewer is
        // negative here.
        let back = area > 0;
        if !back {
            corners.swap(1, 2);
        }
        let toward_viewer = if back { -NORMAL_SCALE } else { NORMAL_SCALE };
        for corner in &mut corners {
            corner.normal *= toward_viewer;
        }
        let [a, b, c] = corners.map(|k| k.point);
        let sides = [Side::new(b, c), Side::new(c, a), Side::new(a, b)];
        let per_area = 1.0 / area.abs() as f32;
        (area != 0).then_some(Self { corners, sides, back, per_area })
    }

    fn interval(&self, coordinate: impl Fn(Point) -> i32) -> Interval {
        self.corners.iter().fold(Interval::NONE, |i, c| i.including(coordinate(c.point)))
    }

    /// The samples of a row that the triangle covers, and the weights of the
    /// second and third corner at the first of them.
    fn span(&self, xs: std::ops::Range<i32>, y: i32) -> Option<(std::ops::Range<i32>, [f32; 2])> {
        let span = self.sides.iter().fold(xs, |span, side| side.clip(span, y));
        (!span.is_empty()).then(|| {
            let weight =
                |side: &Side| side.at(middle(span.start), middle(y)) as f32 * self.per_area;
            let weights = [weight(&self.sides[1]), weight(&self.sides[2])];
            (span, weights)
        })
    }

    /// Draws the samples of a row that are nearer than what is there.
    fn fill(&self, row: &mut [Sample], [u, v]: [f32; 2]) {
        let [a, b, c] = self.corners;
        let step = |side: &Side| (-side.dy * i64::from(SUBSAMPLE)) as f32 * self.per_area;
        let (du, dv) = (step(&self.sides[1]), step(&self.sides[2]));
        let depth = |k: Corner| k.point.inverse_depth;
        let (depth_u, depth_v) = (depth(b) - depth(a), depth(c) - depth(a));
        let (normal_u, normal_v) = (b.normal - a.normal, c.normal - a.normal);
        for (i, sample) in row.iter_mut().enumerate() {
            let (u, v) = (u + i as f32 * du, v + i as f32 * dv);
            let inverse_depth = depth(a) + u * depth_u + v * depth_v;
            if inverse_depth > sample.inverse_depth {
                let normal = (a.normal + u * normal_u + v * normal_v).to_array();
                sample.inverse_depth = inverse_depth;
                sample.normal = normal.map(|x| x as i16);
                sample.back = self.back;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn band(width: u32, height: u32) -> Band {
        let view = View { width, height, supersample: 1, ..View::default() };
        let mut band = Band::new(&view, BAND_SAMPLES).unwrap();
        assert_eq!(band.start(0), height);
        band
    }

    /// A corner at a place in whole samples.
    fn corner(x: f32, y: f32, inverse_depth: f32) -> Corner {
        let fixed = |x: f32| (x * SUBSAMPLE as f32) as i32;
        let point = Point { x: fixed(x), y: fixed(y), inverse_depth };
        Corner { point, normal: Vec3::Z }
    }

    fn covered(band: &Band) -> Vec<String> {
        let mark = |s: &Sample| if s.inverse_depth > 0.0 { '#' } else { '.' };
        band.rows().map(|y| band.row(y).iter().map(mark).collect()).collect()
    }

    #[test]
    fn a_triangle_covers_the_samples_whose_middle_it_contains() {
        let mut band = band(6, 5);
        band.triangle([corner(0.0, 0.0, 0.5), corner(0.0, 4.9, 0.5), corner(4.9, 0.0, 0.5)]);
        assert_eq!(covered(&band), ["####..", "###...", "##....", "#.....", "......"]);
        assert!(band.row(0)[..4].iter().all(|s| !s.back && (s.inverse_depth - 0.5).abs() < 1e-6));
    }

    #[test]
    fn clockwise_triangles_show_their_back() {
        let mut band = band(4, 4);
        band.triangle([corner(0.0, 0.0, 0.5), corner(4.0, 0.0, 0.5), corner(0.0, 4.0, 0.5)]);
        assert!(band.row(0)[0].back);
        assert_eq!(band.row(0)[0].normal, [0, 0, -32767]);
    }

    #[test]
    fn neighbours_share_no_sample_and_leave_none() {
        // A fan around a point on a sample's middle, all edges through middles.
        let ring = [(0.5, 0.5), (4.5, 0.5), (8.5, 0.5), (8.5, 4.5), (8.5, 8.5), (0.5, 8.5)];
        let mut count = vec![0; 81];
        for i in 0..ring.len() {
            let mut band = band(9, 9);
            let at = |(x, y)| corner(x, y, 0.5);
            band.triangle([at((4.5, 4.5)), at(ring[(i + 1) % ring.len()]), at(ring[i])]);
            for (k, s) in (0..9).flat_map(|y| band.row(y).to_vec()).enumerate() {
                count[k] += i32::from(s.inverse_depth > 0.0);
            }
        }
        // The square owns its top and left side, not the others.
        let expect = |k: usize| i32::from(k % 9 < 8 && k / 9 < 8);
        assert_eq!(count, (0..81).map(expect).collect::<Vec<_>>());
    }

    #[test]
    fn the_nearer_triangle_stays_in_any_order() {
        let near = [corner(0.0, 0.0, 0.6), corner(0.0, 9.0, 0.6), corner(9.0, 0.0, 0.6)];
        let far = [corner(0.0, 0.0, 0.4), corner(9.0, 0.0, 0.4), corner(0.0, 9.0, 0.4)];
        for order in [[near, far], [far, near]] {
            let mut band = band(4, 4);
            for triangle in order {
                band.triangle(triangle);
            }
            for y in 0..4 {
                assert!(band.row(y).iter().all(|s| !s.back && s.inverse_depth > 0.55));
            }
        }
    }

    #[test]
    fn triangles_beyond_the_band_are_cut_and_collapsed_ones_skipped() {
        let mut band = band(3, 3);
        let far = 60_000.0;
        band.triangle([
            corner(-far, -far, 0.5),
            corner(-far, far + 5.0, 0.5),
            corner(far + 5.0, -far, 0.5),
        ]);
        assert_eq!(covered(&band).concat(), "###".repeat(2) + "##.");
        let mut empty = self::band(3, 3);
        empty.triangle([corner(0.0, 0.0, 0.5), corner(1.0, 1.0, 0.5), corner(3.0, 3.0, 0.5)]);
        empty.triangle([corner(1.0, 1.0, 0.5); 3]);
        assert_eq!(covered(&empty), ["..."; 3]);
    }
}
