//! The tuned rule of three-point(1/32) around a face of n ≠ 4 sides.
//!
//! Split and pass leave the curvature in the middle of such a face unbounded or zero. Here the
//! four children of a vertex v of the face have stencils of their own, on the same vertices:
//!
//! ```text
//!   o₊ ── e₊ ── d
//!   │  C  │  D  │       x₀ = v, x₁ … xₙ₋₁ counter-clockwise round the face
//!   x₁ ── v ─── e₋
//!   │  A  │  B  │
//!   x₂ … xₙ₋₁ ─ o₋
//! ```
//!
//! * A, in the face: Σ Aₖ xₖ + p(e₋ + e₊) + q(o₋ + o₊) + r d;
//! * B, in the quad across xₙ₋₁ v: Σ Bₖ xₖ + B₁ e₋ + B₂ o₊ + B₃ e₊ + B₄ o₋ + B₅ d;
//! * C, in the quad across v x₁: the mirror image of B;
//! * D, in the quad opposite: Σ Dₖ xₖ + D₁(e₋ + e₊) + D₂(o₋ + o₊) + D₃ d.
//!
//! All are non-negative and sum to 1. Eigenvalues around the face: 1, then ½ twice (modes ±1),
//! then ¼ in the modes 0 and ±2, in distinct Fourier blocks (for n = 3, where mode −2 is mode
//! 1, beside the ½ there), and everything else smaller: the surface is C¹ with bounded,
//! non-vanishing curvature. The shape is good up to n ≈ 8, fair to 12, and beyond that
//! curvature is bounded and no more. n = 4 is the regular stencil.
//!
//! It is this project's own; the conditions are those of Peters and Reif, *Subdivision
//! Surfaces* (2008), chapter 7. The weights are the decimals of `tuned_numbers.rs`, exactly
//! those in any number type.

use super::tuned_numbers::{NUMBERS, Numbers};
use crate::base::Weight;

/// One in the units of the numbers.
const ONE: i64 = 1_000_000_000_000_000;

/// The four rows of the children of a vertex, counter-clockwise from the one in the face: A, B,
/// D, C. Each has the weights of e₋, o₋, d, o₊, e₊ and then those of x₀ … xₙ₋₁.
pub(crate) type TunedRows<W> = [Vec<W>; 4];

/// The rows by n, made once each.
#[derive(Debug, Clone, Default)]
pub(crate) struct TunedWeights<W> {
    by_size: Vec<Option<Box<TunedRows<W>>>>,
}

impl<W: Weight> TunedWeights<W> {
    pub(crate) fn new() -> Self {
        Self { by_size: vec![None; NUMBERS.len()] }
    }

    /// The rows around a face of `n` sides; none for 4 sides and beyond 32.
    pub(crate) fn of(&mut self, n: usize) -> Option<&TunedRows<W>> {
        let place = n.checked_sub(3).filter(|_| n != 4)?;
        let slot = self.by_size.get_mut(place)?;
        Some(slot.get_or_insert_with(|| Box::new(rows(n, &NUMBERS[place]))))
    }
}

/// The rows around a face of `n` sides.
fn rows<W: Weight>(n: usize, numbers: &Numbers) -> TunedRows<W> {
    let [p, q, r, b1, b4, b5, b2, b3, d1, d2, d3] = numbers.outside;
    let mirrored = |half: &'static [i64]| (1..n).map(|k| half[k.min(n - k) - 1]);
    let beside = numbers.beside.iter().copied();
    [
        row([p, q, r, q, p], mirrored(numbers.own)),
        row([b1, b4, b5, b2, b3], beside.clone()),
        row([d1, d2, d3, d2, d1], mirrored(numbers.across)),
        row([b3, b2, b5, b4, b1], beside.rev()),
    ]
}

/// A row from what it has outside of the face and at the other vertices of the face.
fn row<W: Weight>(outside: [i64; 5], others: impl Iterator<Item = i64> + Clone) -> Vec<W> {
    let own = ONE - outside.into_iter().sum::<i64>() - others.clone().sum::<i64>();
    let numbers = outside.into_iter().chain([own]).chain(others);
    numbers.map(|number| W::ratio(number, ONE)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::Fraction;
    use crate::scheme::{Scheme, Taps};

    /// Places x from −1 to 1 and y from −1 to 1 around a vertex whose face is to the lower left,
    /// in the order of a row for n = 4, and those of its children.
    const PLACES: [[usize; 2]; 9] =
        [[2, 1], [2, 0], [2, 2], [0, 2], [1, 2], [1, 1], [0, 1], [0, 0], [1, 0]];
    const CHILDREN: [[bool; 2]; 4] = [[false, false], [true, false], [true, true], [false, true]];

    /// With four sides the numbers are those of split and pass: the tensor product of the taps.
    #[test]
    fn four_sides_give_the_regular_stencil() {
        let scheme = Scheme::three_point(Fraction::new(1, 32).unwrap()).unwrap();
        let [away, own, toward]: Taps<f64> = scheme.fused_taps().unwrap();
        let rows = rows::<f64>(4, &NUMBERS[1]);
        for (row, [right, up]) in rows.iter().zip(CHILDREN) {
            let tap = |place: usize, positive: bool| match place {
                1 => own,
                _ if (place == 2) == positive => toward,
                _ => away,
            };
            for (w, [x, y]) in row.iter().zip(PLACES) {
                let wanted = tap(x, right) * tap(y, up);
                assert!((w - wanted).abs() < 1e-16, "{w} for {wanted} at {x}, {y}");
            }
        }
    }

    #[test]
    fn weights_are_not_negative_and_sum_to_one() {
        for (n, numbers) in (3..).zip(&NUMBERS) {
            let half = n / 2;
            let lengths = [numbers.own.len(), numbers.beside.len(), numbers.across.len()];
            assert_eq!(lengths, [half, n - 1, half], "n = {n}");
            for row in rows::<f64>(n, numbers) {
                assert_eq!(row.len(), n + 5);
                assert!(row.iter().all(|&w| w >= 0.0), "n = {n}: {row:?}");
                assert!((row.iter().sum::<f64>() - 1.0).abs() < 1e-14, "n = {n}");
            }
        }
    }

    type Complex = [f64; 2];

    fn times(a: Complex, b: Complex) -> Complex {
        [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]]
    }

    fn turn(mode: usize, sector: usize, n: usize) -> Complex {
        let angle = std::f64::consts::TAU * ((mode * sector) % n) as f64 / n as f64;
        [angle.cos(), angle.sin()]
    }

    /// What the four children of a vertex are of those of all vertices before, on values that a
    /// turn by one corner of the face multiplies by e^{2πi·mode/n}.
    fn block(n: usize, mode: usize) -> Vec<Vec<Complex>> {
        let scaled = |w: f64, [re, im]: Complex| [w * re, w * im];
        let sum = |a: Complex, b: Complex| [a[0] + b[0], a[1] + b[1]];
        let (after, before) = (turn(mode, 1, n), turn(mode, n - 1, n));
        let block = rows::<f64>(n, &NUMBERS[n - 3]).map(|row| {
            let face = (0..n).map(|k| scaled(row[5 + k], turn(mode, k, n)));
            // e₋ is B, o₋ the C before, d is D, o₊ the B after, e₊ is C.
            vec![
                face.fold([0.0; 2], sum),
                sum([row[0], 0.0], scaled(row[3], after)),
                [row[2], 0.0],
                sum([row[4], 0.0], scaled(row[1], before)),
            ]
        });
        block.to_vec()
    }

    fn determinant(rows: &[Vec<Complex>]) -> Complex {
        let Some((first, rest)) = rows.split_first() else { return [1.0, 0.0] };
        first.iter().enumerate().fold([0.0; 2], |sum, (j, &entry)| {
            let without = |row: &Vec<Complex>| [&row[..j], &row[j + 1..]].concat();
            let minor = determinant(&rest.iter().map(without).collect::<Vec<_>>());
            let [re, im] = times(entry, minor);
            if j % 2 == 0 { [sum[0] + re, sum[1] + im] } else { [sum[0] - re, sum[1] - im] }
        })
    }

    /// The first entry of a block that makes a number an eigenvalue, the others being what they
    /// are.
    fn demanded(mut block: Vec<Vec<Complex>>, eigenvalue: f64) -> Complex {
        for (k, row) in block.iter_mut().enumerate() {
            row[k][0] -= eigenvalue;
        }
        // The determinant is linear in it.
        let [none, one] = [0.0, 1.0].map(|entry| {
            block[0][0] = [entry, 0.0];
            determinant(&block)
        });
        let slope = [one[0] - none[0], one[1] - none[1]];
        let size = slope[0] * slope[0] + slope[1] * slope[1];
        let [re, im] = times(none, [-slope[0] / size, slope[1] / size]);
        [re + eigenvalue, im]
    }

    /// ½ in mode 1, ¼ in the modes 2 and 0 decide the part of A in these modes.
    #[test]
    fn numbers_are_what_the_eigenvalues_demand() {
        for n in (3..=32).filter(|&n| n != 4) {
            let second = if n == 3 { 1 } else { 2 };
            for (mode, eigenvalue) in [(1, 0.5), (second, 0.25), (0, 0.25)] {
                let block = block(n, mode);
                let found = block[0][0];
                let wanted = demanded(block, eigenvalue);
                let apart = (found[0] - wanted[0]).hypot(found[1] - wanted[1]);
                // Optimisation ended some digits before the closed form does.
                let close = if n <= 16 { 1e-12 } else { 1e-10 };
                assert!(apart < close, "n = {n}, mode {mode}: {found:?} for {wanted:?}");
            }
        }
    }

    /// From 5 to 16 sides the modes beyond 2 are sums of a constant and one wave, for all n.
    #[test]
    fn higher_modes_follow_a_closed_form() {
        for n in 5..=16 {
            for mode in 3..=n / 2 {
                let [cos, sin] = turn(mode, 1, n);
                let block = block(n, mode);
                let wanted = [
                    [-0.0398 - 0.2302 * cos, 0.0],
                    [0.2555 + 0.0524 * cos, 0.1766 * sin],
                    [0.3988 - 0.0276 * cos, 0.0],
                    [0.2555 + 0.0524 * cos, -0.1766 * sin],
                ];
                for (row, wanted) in block.iter().zip(wanted) {
                    // The sign of sines is that of the direction around the face.
                    let apart = (row[0][0] - wanted[0]).hypot(row[0][1] + wanted[1]);
                    assert!(apart < 1e-13, "n = {n}, mode {mode}: {:?} for {wanted:?}", row[0]);
                }
            }
        }
    }

    #[test]
    fn quads_and_large_faces_have_none() {
        let mut weights = TunedWeights::<f64>::new();
        for n in [0, 1, 2, 4, 33, 1000] {
            assert!(weights.of(n).is_none(), "{n}");
        }
        assert!((3..=32).filter(|&n| n != 4).all(|n| weights.of(n).is_some()));
    }
}
