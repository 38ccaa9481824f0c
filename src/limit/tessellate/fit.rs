//! The polynomial of degree 4 through points of a cell at quarters of its sides.
//!
//! It is the surface itself where that is a polynomial. Coefficients are those of Bernstein, so
//! that they bound what they are coefficients of, and those of a part of the cell follow by
//! halving (de Casteljau; on triangles the blossom of Ramshaw 1987).

use super::cell::Shape;
use glam::DVec3;

/// Along a side.
const N: usize = 5;

/// The coefficient of i parts of the second corner and j of the last stands at i + 5j; in
/// triangles i + j is at most 4.
#[derive(Debug, Clone, Copy)]
pub(in crate::limit) struct Fit {
    pub(in crate::limit) shape: Shape,
    coefficients: [DVec3; N * N],
}

/// The places of coefficients, and of the points that they are found from, in order.
pub(in crate::limit) fn places(shape: Shape) -> impl Iterator<Item = [usize; 2]> {
    let most = move |j: usize| if shape == Shape::Triangle { N - j } else { N };
    (0..N).flat_map(move |j| (0..most(j)).map(move |i| [i, j]))
}

/// The number of [`places`].
pub(in crate::limit) fn count(shape: Shape) -> usize {
    if shape == Shape::Triangle { N * (N + 1) / 2 } else { N * N }
}

/// Coefficients along a line from values at its quarters.
fn interpolate(f: [DVec3; N]) -> [DVec3; N] {
    let beside = |f: [DVec3; N]| {
        (-13.0 * f[0] + 48.0 * f[1] - 36.0 * f[2] + 16.0 * f[3] - 3.0 * f[4]) / 12.0
    };
    let middle = (13.0 * (f[0] + f[4]) - 64.0 * (f[1] + f[3]) + 120.0 * f[2]) / 18.0;
    let mut turned = f;
    turned.reverse();
    [f[0], beside(f), middle, beside(turned), f[4]]
}

/// The coefficients of both halves of a line.
fn halves(mut b: [DVec3; N]) -> [[DVec3; N]; 2] {
    let mut halves = [[DVec3::ZERO; N]; 2];
    for k in 0..N {
        halves[0][k] = b[0];
        halves[1][N - 1 - k] = b[N - 1 - k];
        for i in 0..N - 1 - k {
            b[i] = 0.5 * (b[i] + b[i + 1]);
        }
    }
    halves
}

impl Fit {
    /// From points in the order of [`places`].
    pub(in crate::limit) fn new(shape: Shape, points: &[[f64; 3]]) -> Self {
        let mut fit = Self { shape, coefficients: [DVec3::ZERO; N * N] };
        for ([i, j], &point) in places(shape).zip(points) {
            fit.coefficients[i + N * j] = DVec3::from(point);
        }
        match shape {
            Shape::Triangle => fit.interpolate_triangle(),
            _ => fit.interpolate_square(),
        }
        fit
    }

    pub(in crate::limit) fn at(&self, i: usize, j: usize) -> DVec3 {
        self.coefficients[i + N * j]
    }

    /// All coefficients.
    pub(in crate::limit) fn all(&self) -> impl Iterator<Item = DVec3> + '_ {
        places(self.shape).map(|[i, j]| self.at(i, j))
    }

    /// Coefficients from one place on, in steps.
    fn line(&self, [i, j]: [usize; 2], step: [isize; 2]) -> [DVec3; N] {
        let place =
            |from: usize, step: isize, k: usize| from.wrapping_add_signed(step * k as isize);
        std::array::from_fn(|k| self.at(place(i, step[0], k), place(j, step[1], k)))
    }

    fn set_line(&mut self, [i, j]: [usize; 2], step: [isize; 2], line: [DVec3; N]) {
        for (k, value) in line.into_iter().enumerate() {
            let place = |from: usize, step: isize| from.wrapping_add_signed(step * k as isize);
            self.coefficients[place(i, step[0]) + N * place(j, step[1])] = value;
        }
    }

    fn interpolate_square(&mut self) {
        for j in 0..N {
            self.set_line([0, j], [1, 0], interpolate(self.line([0, j], [1, 0])));
        }
        for i in 0..N {
            self.set_line([i, 0], [0, 1], interpolate(self.line([i, 0], [0, 1])));
        }
    }

    fn interpolate_triangle(&mut self) {
        const INNER: [[usize; 2]; 3] = [[1, 1], [2, 1], [1, 2]];
        for &(from, step) in Self::sides(Shape::Triangle) {
            self.set_line(from, step, interpolate(self.line(from, step)));
        }
        // What the sides leave of the points inside, whose coefficients have the weights
        // 2, 1, 1 over 32/3 there.
        let rest = INNER.map(|[i, j]| {
            let at = [4 - i - j, i, j].map(|x| x as f64 / 4.0);
            let sides = places(Shape::Triangle).filter(|place| !INNER.contains(place));
            let sum =
                sides.fold(DVec3::ZERO, |sum, [i, j]| sum + weight(at, [i, j]) * self.at(i, j));
            self.at(i, j) - sum
        });
        let sum = rest[0] + rest[1] + rest[2];
        for ([i, j], rest) in INNER.into_iter().zip(rest) {
            self.coefficients[i + N * j] = 8.0 / 3.0 * (4.0 * rest - sum);
        }
    }

    /// Where the sides start, and their steps, counter-clockwise.
    fn sides(shape: Shape) -> &'static [([usize; 2], [isize; 2])] {
        match shape {
            Shape::Triangle => &[([0, 0], [1, 0]), ([4, 0], [-1, 1]), ([0, 4], [0, -1])],
            _ => &[([0, 0], [1, 0]), ([4, 0], [0, 1]), ([4, 4], [-1, 0]), ([0, 4], [0, -1])],
        }
    }

    /// The coefficients along each side.
    pub(in crate::limit) fn side_lines(&self) -> impl Iterator<Item = [DVec3; N]> + '_ {
        Self::sides(self.shape).iter().map(|&(from, step)| self.line(from, step))
    }

    /// Those of the parts, in the order of [`super::cell::Cell::children`].
    pub(in crate::limit) fn children(&self) -> [Self; 4] {
        if self.shape == Shape::Triangle {
            self.triangle_children()
        } else {
            self.square_children()
        }
    }

    fn square_children(&self) -> [Self; 4] {
        let mut children = [*self; 4];
        for j in 0..N {
            for (i, half) in halves(self.line([0, j], [1, 0])).into_iter().enumerate() {
                children[i].set_line([0, j], [1, 0], half);
            }
        }
        let [low, high] = [children[0], children[1]];
        for (i, part) in [low, high].iter().enumerate() {
            for column in 0..N {
                let [below, above] = halves(part.line([column, 0], [0, 1]));
                children[i].set_line([column, 0], [0, 1], below);
                children[2 + i].set_line([column, 0], [0, 1], above);
            }
        }
        children
    }

    fn triangle_children(&self) -> [Self; 4] {
        let (a, b, c) = ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]);
        let (ab, bc, ca) = ([0.5, 0.5, 0.0], [0.0, 0.5, 0.5], [0.5, 0.0, 0.5]);
        [[a, ab, ca], [ab, b, bc], [ca, bc, c], [bc, ca, ab]].map(|corners| {
            let mut child = *self;
            for [i, j] in places(self.shape) {
                let kind = |k: usize| if k < i { 1 } else { 2 * usize::from(k < i + j) };
                let arguments = [0, 1, 2, 3].map(|k| corners[kind(k)]);
                child.coefficients[i + N * j] = self.blossom(arguments);
            }
            child
        })
    }

    /// The symmetric form of four points, in barycentric coordinates, that is the polynomial
    /// where they are one.
    fn blossom(&self, arguments: [[f64; 3]; 4]) -> DVec3 {
        let mut b = self.coefficients;
        for (k, [x, y, z]) in arguments.into_iter().enumerate() {
            let most = N - 2 - k;
            for j in 0..=most {
                for i in 0..=most - j {
                    let at = i + N * j;
                    b[at] = x * b[at] + y * b[at + 1] + z * b[at + N];
                }
            }
        }
        b[0]
    }

    /// The points at halves of the sides; in triangles those with a sum of 2 at most.
    pub(in crate::limit) fn points(&self) -> [[DVec3; 3]; 3] {
        let three =
            |b: [DVec3; N]| [b[0], (b[0] + b[4] + 4.0 * (b[1] + b[3]) + 6.0 * b[2]) / 16.0, b[4]];
        if self.shape == Shape::Triangle {
            let mut points = [[DVec3::ZERO; 3]; 3];
            [points[0][0], points[0][1], points[0][2]] = three(self.line([0, 0], [1, 0]));
            [_, points[1][1], points[2][0]] = three(self.line([4, 0], [-1, 1]));
            [_, points[1][0], _] = three(self.line([0, 4], [0, -1]));
            return points;
        }
        let across: [[DVec3; 3]; N] = std::array::from_fn(|j| three(self.line([0, j], [1, 0])));
        let columns = [0, 1, 2].map(|i| three(across.map(|row| row[i])));
        std::array::from_fn(|j| columns.map(|column| column[j]))
    }
}

/// The Bernstein polynomial of a place of a triangle at barycentric coordinates.
fn weight(at: [f64; 3], [i, j]: [usize; 2]) -> f64 {
    let exponents = [4 - i - j, i, j];
    let factorial = |n: usize| (1..=n).product::<usize>() as f64;
    let power = |k: usize| (0..exponents[k]).fold(1.0, |power, _| power * at[k]);
    let parts = exponents.iter().fold(24.0, |rest, &n| rest / factorial(n));
    parts * power(0) * power(1) * power(2)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A polynomial of degree 4 in all.
    fn polynomial([x, y]: [f64; 2]) -> DVec3 {
        let (xx, yy) = (x * x, y * y);
        DVec3::new(
            1.0 + x - 2.0 * y + xx * yy,
            xx * x - x * y * yy,
            yy * yy - 3.0 * xx * xx + x * y,
        )
    }

    fn fit(shape: Shape, at: [f64; 2], side: f64) -> Fit {
        let point = |[i, j]: [usize; 2]| {
            let [x, y] = [i, j].map(|k| side * k as f64 / 4.0);
            polynomial([at[0] + x, at[1] + y]).to_array()
        };
        Fit::new(shape, &places(shape).map(point).collect::<Vec<_>>())
    }

    #[test]
    fn parts_of_a_fit_are_fits_of_the_parts() {
        for shape in [Shape::Quad, Shape::Triangle] {
            let whole = fit(shape, [0.25, -0.5], 1.0);
            for (child, cell) in
                whole.children().iter().zip(super::super::cell::Cell::WHOLE.children(shape))
            {
                let place = |x: i32| f64::from(x) / f64::from(super::super::cell::UNIT);
                let at = [0.25 + place(cell.at[0]), place(cell.at[1]) - 0.5];
                let expected = fit(shape, at, place(cell.side));
                for [i, j] in places(shape) {
                    let apart = child.at(i, j).distance(expected.at(i, j));
                    assert!(apart < 1e-13, "{shape:?} ({i}, {j}): {apart}");
                }
            }
            for (i, j) in [(0, 0), (1, 0), (2, 0), (0, 1), (1, 1), (0, 2)] {
                let at = [0.25 + 0.5 * f64::from(i), 0.5 * f64::from(j) - 0.5];
                let point = whole.points()[j as usize][i as usize];
                assert!(point.distance(polynomial(at)) < 1e-13, "{shape:?} ({i}, {j})");
            }
        }
    }
}
