//! Polygons into triangles, for filling only.
//!
//! A quadrilateral is cut along a diagonal that lies inside it, a larger
//! polygon into a fan around its centroid. A polygon that its centroid does not
//! see (a concave one) is cut by ears. What no rule fits, because the polygon
//! crosses itself or has collapsed, is filled somehow; that it is filled
//! without failing is all that is promised.

use glam::Vec3;

/// Above this size a concave polygon is filled as a fan: ears cost O(n²).
const MOST_EARS: usize = 256;
/// How much shorter the second diagonal must be to be preferred; keeps the
/// choice the same over a regular grid in spite of rounding.
const SHORTER: f32 = 0.98;

/// Triangles of one polygon, and room to find them.
#[derive(Default)]
pub struct Triangulator {
    triangles: Vec<[usize; 3]>,
    ring: Vec<usize>,
}

impl Triangulator {
    /// Cuts a polygon with a normal of any length. Triangles name corners by
    /// number; the number `corners.len()` stands for the centroid.
    pub fn cut(&mut self, corners: &[Vec3], normal: Vec3) -> &[[usize; 3]] {
        self.triangles.clear();
        match corners.len() {
            0..=2 => {}
            3 => self.triangles.push([0, 1, 2]),
            4 => self.triangles.extend(cut_quad(corners, normal)),
            n if n > MOST_EARS || sees_all(centroid(corners), corners, normal) => self.fan(n),
            _ => self.ears(corners, normal),
        }
        &self.triangles
    }

    fn fan(&mut self, n: usize) {
        self.triangles.extend((0..n).map(|i| [i, (i + 1) % n, n]));
    }

    fn ears(&mut self, corners: &[Vec3], normal: Vec3) {
        self.ring.clear();
        self.ring.extend(0..corners.len());
        while self.ring.len() > 3 {
            let n = self.ring.len();
            // A polygon that crosses itself may have no ear: then any corner.
            let at = (0..n).find(|&i| is_ear(&self.ring, i, corners, normal)).unwrap_or(0);
            self.triangles.push(tip(&self.ring, at));
            self.ring.remove(at);
        }
        self.triangles.push([self.ring[0], self.ring[1], self.ring[2]]);
    }
}

/// The mean of the corners.
pub fn centroid(corners: &[Vec3]) -> Vec3 {
    corners.iter().sum::<Vec3>() / corners.len().max(1) as f32
}

/// Twice the area of a triangle seen along the normal, times its length.
fn area(a: Vec3, b: Vec3, c: Vec3, normal: Vec3) -> f32 {
    (b - a).cross(c - a).dot(normal)
}

fn cut_quad(corners: &[Vec3], normal: Vec3) -> [[usize; 3]; 2] {
    let area = |[a, b, c]: [usize; 3]| area(corners[a], corners[b], corners[c], normal);
    let first = [[0, 1, 2], [0, 2, 3]];
    let second = [[0, 1, 3], [1, 2, 3]];
    let worst = |cut: &[[usize; 3]; 2]| area(cut[0]).min(area(cut[1]));
    let (w0, w1) = (worst(&first), worst(&second));
    let prefer_second = if w0 > 0.0 && w1 > 0.0 {
        corners[1].distance(corners[3]) < SHORTER * corners[0].distance(corners[2])
    } else {
        w1 > w0
    };
    if prefer_second { second } else { first }
}

/// Whether the fan around a point covers each place once.
fn sees_all(point: Vec3, corners: &[Vec3], normal: Vec3) -> bool {
    let next = corners.iter().cycle().skip(1);
    normal == Vec3::ZERO || corners.iter().zip(next).all(|(&a, &b)| area(a, b, point, normal) > 0.0)
}

/// The triangle that corner `i` of the ring forms with its neighbours.
fn tip(ring: &[usize], i: usize) -> [usize; 3] {
    let n = ring.len();
    [ring[(i + n - 1) % n], ring[i], ring[(i + 1) % n]]
}

fn is_ear(ring: &[usize], i: usize, corners: &[Vec3], normal: Vec3) -> bool {
    let [a, b, c] = tip(ring, i).map(|k| corners[k]);
    let inside =
        |p| [(a, b), (b, c), (c, a)].into_iter().all(|(from, to)| area(from, to, p, normal) >= 0.0);
    let blocks = |k: usize| !tip(ring, i).contains(&k) && inside(corners[k]);
    area(a, b, c, normal) > 0.0 && !ring.iter().any(|&k| blocks(k))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn flat(points: &[[f32; 2]]) -> Vec<Vec3> {
        points.iter().map(|&[x, y]| Vec3::new(x, y, 0.0)).collect()
    }

    /// Twice the area of the polygon, and that all its triangles turn its way.
    fn check_cover(points: &[[f32; 2]], double_area: f32) {
        let mut corners = flat(points);
        let middle = centroid(&corners);
        let triangles = Triangulator::default().cut(&corners, Vec3::Z).to_vec();
        corners.push(middle);
        let areas: Vec<f32> = triangles
            .iter()
            .map(|t| area(corners[t[0]], corners[t[1]], corners[t[2]], Vec3::Z))
            .collect();
        assert!(areas.iter().all(|&a| a > 0.0), "{triangles:?}: {areas:?}");
        assert!((areas.iter().sum::<f32>() - double_area).abs() < 1e-5, "{triangles:?}");
    }

    #[test]
    fn a_dart_is_cut_at_its_notch() {
        let dart = [[0.0, 0.0], [2.0, -1.0], [1.0, 0.0], [2.0, 1.0]];
        for turn in 0..4 {
            let mut points = dart;
            points.rotate_left(turn);
            check_cover(&points, 2.0);
        }
    }

    #[test]
    fn a_pentagon_becomes_a_fan_around_its_centroid() {
        let house = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [1.0, 3.0], [0.0, 2.0]];
        check_cover(&house, 10.0);
        let mut cutter = Triangulator::default();
        assert_eq!(cutter.cut(&flat(&house), Vec3::Z).len(), 5);
    }

    #[test]
    fn a_concave_polygon_is_cut_by_ears() {
        let u = [[0., 0.], [3., 0.], [3., 3.], [2., 3.], [2., 1.], [1., 1.], [1., 3.], [0., 3.]];
        for turn in 0..8 {
            let mut points = u;
            points.rotate_left(turn);
            check_cover(&points, 14.0);
        }
    }

    #[test]
    fn collapsed_and_crossing_polygons_end() {
        let star: Vec<_> = (0..7).map(|i| [(3 * i % 7) as f32, (5 * i % 7) as f32]).collect();
        let line: Vec<_> = (0..300).map(|i| [i as f32, 0.0]).collect();
        for points in [&star[..], &line[..], &line[..9], &[[1.0, 1.0]; 6]] {
            for normal in [Vec3::Z, Vec3::ZERO, Vec3::X] {
                let n = points.len();
                let mut cutter = Triangulator::default();
                let triangles = cutter.cut(&flat(points), normal);
                assert!(triangles.len() >= n - 2);
                assert!(triangles.iter().flatten().all(|&k| k <= n));
            }
        }
    }

    #[test]
    fn a_square_grid_keeps_one_diagonal() {
        let square = flat(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.000_01], [0.0, 1.0]]);
        assert_eq!(Triangulator::default().cut(&square, Vec3::Z), [[0, 1, 2], [0, 2, 3]]);
        let kite = flat(&[[-2.0, 0.0], [0.0, -1.0], [2.0, 0.0], [0.0, 1.0]]);
        assert_eq!(Triangulator::default().cut(&kite, Vec3::Z), [[0, 1, 3], [1, 2, 3]]);
    }
}
