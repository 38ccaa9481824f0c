//! The least value of a function over the unit square or triangle: Newton's method, along the
//! border where it wants to leave, and never uphill.

use super::cell::{corners, within};
use crate::base::Result;
use crate::limit::tessellate::Shape;

/// Steps at most; what is not done then is divided.
const STEPS: u32 = 20;
/// Halvings of a step.
const HALVINGS: u32 = 6;
/// How near to a border of the cell a point is taken to be on it.
const ON_BORDER: f64 = 1e-14;

/// A function's value F at a point, the gradient of F/2, and the second derivatives of F/2
/// by ss, st and tt in two parts, of which the first is never negative.
pub(super) type Value = (f64, [f64; 2], [f64; 3], [f64; 3]);

/// Where the search for the least value ended.
#[derive(Debug, Clone, Copy)]
pub(super) struct Minimum {
    pub(super) at: [f64; 2],
    pub(super) value: f64,
    /// By how much the tangent plane of F/2 falls within the cell; 0 or less.
    pub(super) fall: f64,
}

impl Minimum {
    /// A bound on the values of F, if that is convex.
    pub(super) fn lower(&self) -> f64 {
        (self.value + 2.0 * self.fall).max(0.0)
    }
}

fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

/// By how much a plane with a gradient falls from a point to the lowest corner.
fn fall(shape: Shape, at: [f64; 2], gradient: [f64; 2]) -> f64 {
    let to = |corner: &[f64; 2]| dot(gradient, [corner[0] - at[0], corner[1] - at[1]]);
    corners(shape).iter().map(to).fold(f64::INFINITY, f64::min).min(0.0)
}

/// A multiple of a direction downhill by second derivatives, if they are of use.
fn along(direction: [f64; 2], gradient: [f64; 2], second: [f64; 3]) -> Option<[f64; 2]> {
    let [x, y] = direction;
    let bend = second[0] * x * x + 2.0 * second[1] * x * y + second[2] * y * y;
    let step = -dot(direction, gradient) / bend;
    (bend > 0.0 && step.is_finite()).then_some([step * x, step * y])
}

/// Newton's step, if it leads downhill.
fn newton([g, h]: [f64; 2], [ss, st, tt]: [f64; 3]) -> Option<[f64; 2]> {
    let determinant = ss * tt - st * st;
    let step = [(st * h - tt * g) / determinant, (st * g - ss * h) / determinant];
    let is_downhill = ss > 0.0 && determinant > 0.0 && dot(step, [g, h]) < 0.0;
    (is_downhill && step.iter().all(|x| x.is_finite())).then_some(step)
}

/// The directions along the borders that a point lies on, if downhill is outside.
fn borders(shape: Shape, [s, t]: [f64; 2], [g, h]: [f64; 2]) -> Vec2 {
    let mut found = Vec2::default();
    let on = |x: f64| x.abs() <= ON_BORDER;
    if (on(s) && g > 0.0) || (shape != Shape::Triangle && on(1.0 - s) && g < 0.0) {
        found.add([0.0, 1.0]);
    }
    if (on(t) && h > 0.0) || (shape != Shape::Triangle && on(1.0 - t) && h < 0.0) {
        found.add([1.0, 0.0]);
    }
    if shape == Shape::Triangle && on(1.0 - s - t) && g + h < 0.0 {
        found.add([1.0, -1.0]);
    }
    found
}

/// Some directions.
#[derive(Default)]
struct Vec2 {
    items: [[f64; 2]; 3],
    count: usize,
}

impl Vec2 {
    fn add(&mut self, item: [f64; 2]) {
        self.items[self.count] = item;
        self.count += 1;
    }

    fn all(&self) -> &[[f64; 2]] {
        &self.items[..self.count]
    }
}

/// Steps to try, the best first: Newton's, that without second derivatives of the surface,
/// down the slope; along a border only where downhill is beyond one.
fn steps(
    shape: Shape,
    at: [f64; 2],
    gradient: [f64; 2],
    first: [f64; 3],
    second: [f64; 3],
) -> impl Iterator<Item = [f64; 2]> {
    let whole: [f64; 3] = std::array::from_fn(|k| first[k] + second[k]);
    let on = borders(shape, at, gradient);
    let mut found = [None; 6];
    if on.count == 0 {
        found[0] = newton(gradient, whole).or_else(|| newton(gradient, first));
        found[1] = along(gradient, gradient, first);
    }
    for (k, &direction) in on.all().iter().enumerate() {
        found[2 + k] =
            along(direction, gradient, whole).or_else(|| along(direction, gradient, first));
    }
    found.into_iter().flatten()
}

/// Goes down from a point as far as it leads.
///
/// # Errors
/// Those of the function.
pub(super) fn minimise(
    shape: Shape,
    start: [f64; 2],
    of: impl Fn([f64; 2]) -> Result<Value>,
) -> Result<Minimum> {
    let mut at = start;
    let mut here = of(at)?;
    for _ in 0..STEPS {
        let (value, gradient, first, second) = here;
        if fall(shape, at, gradient) >= -1e-16 * value {
            break;
        }
        let mut next = None;
        'tried: for step in steps(shape, at, gradient, first, second) {
            let mut part = 1.0;
            for _ in 0..HALVINGS {
                let there = within(shape, [at[0] + part * step[0], at[1] + part * step[1]]);
                let then = of(there)?;
                if then.0 < value {
                    next = Some((there, then));
                    break 'tried;
                }
                part *= 0.5;
            }
        }
        let Some((there, then)) = next else {
            break;
        };
        (at, here) = (there, then);
    }
    let (value, gradient, ..) = here;
    Ok(Minimum { at, value, fall: fall(shape, at, gradient) })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A parabola's least value, inside, on borders and at corners.
    #[test]
    fn finds_the_least_value_of_parabolas() {
        for shape in [Shape::Quad, Shape::Triangle] {
            for (a, b) in [(0.3, 0.2), (-1.0, 0.4), (2.0, 3.0), (0.5, -0.1), (0.9, 0.8)] {
                let value = |[s, t]: [f64; 2]| {
                    let (x, y) = (s - a, t - b);
                    let second = [1.0, 0.3, 2.0];
                    let gradient = [x + 0.3 * y, 0.3 * x + 2.0 * y];
                    (x * x + 0.6 * x * y + 2.0 * y * y, gradient, second, [0.0; 3])
                };
                let found = minimise(shape, [0.3, 0.3], |at| Ok(value(at))).unwrap();
                let mut least = f64::INFINITY;
                for i in 0..=400 {
                    for j in 0..=400 {
                        let at = [i, j].map(|k| f64::from(k) / 400.0);
                        if shape != Shape::Triangle || i + j <= 400 {
                            least = least.min(value(at).0);
                        }
                    }
                }
                assert!(found.value <= least + 1e-12, "{shape:?} ({a}, {b}): {found:?}, {least}");
                assert!(found.lower() <= least + 1e-12, "{shape:?} ({a}, {b})");
                assert!(found.lower() >= found.value - 1e-12, "{shape:?} ({a}, {b}): {found:?}");
            }
        }
    }
}
