//! Curves of the dual family, and tensor products of them on grids, exactly.
//!
//! A value here is one coordinate: the schemes act on each alone.

use num_rational::BigRational;
use num_traits::Zero;

use super::number::ratio;

/// A rectangular array: `grid[row][column]`.
pub type Grid = Vec<Vec<BigRational>>;

/// What follows a curve's ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Curve {
    Closed,
    /// Both ends are control points.
    Open,
    /// Both ends are anchors, half an interval from their neighbours.
    Anchored,
}

impl Curve {
    /// What a step makes of it.
    pub fn refined(self) -> Self {
        match self {
            Self::Closed => Self::Closed,
            Self::Open | Self::Anchored => Self::Anchored,
        }
    }
}

/// The mask of the split and the passes: `[1, 3, 3, 1]/4` times one filter
/// `(a/2, 1 − a, a/2)`, `a = (1 − t)/2`, for each pass.
pub fn mask(passes: &[BigRational]) -> Vec<BigRational> {
    let chaikin = [1, 3, 3, 1].map(|k| ratio(k, 4)).to_vec();
    passes.iter().fold(chaikin, |mask, t| convolve(&mask, &filter(t)))
}

fn filter(t: &BigRational) -> Vec<BigRational> {
    let a = (ratio(1, 1) - t) / ratio(2, 1);
    vec![&a / ratio(2, 1), ratio(1, 1) - &a, a / ratio(2, 1)]
}

/// The product of two Laurent polynomials.
pub fn convolve(x: &[BigRational], y: &[BigRational]) -> Vec<BigRational> {
    let mut product = vec![BigRational::zero(); x.len() + y.len() - 1];
    for (i, a) in x.iter().enumerate() {
        for (j, b) in y.iter().enumerate() {
            product[i + j] += a * b;
        }
    }
    product
}

/// The point a quarter of the way from `p(j)` to `p(j + 1)` (`late` false) or
/// three quarters (`late` true), for a symmetric mask of even length.
fn rule(mask: &[BigRational], j: i64, late: bool, p: impl Fn(i64) -> BigRational) -> BigRational {
    // The middle pair of the mask is a₋₁ and a₀, so point 2j is the early one.
    let half = mask.len() as i64 / 2;
    let new = 2 * j + i64::from(late);
    let mut sum = BigRational::zero();
    for (k, w) in mask.iter().enumerate() {
        // q_new = Σ a_{new − 2i} p_i, and a_{k − half} = mask[k].
        let twice = new - (k as i64 - half);
        if twice % 2 == 0 {
            sum += w * p(twice.div_euclid(2));
        }
    }
    sum
}

/// One step of a curve.
pub fn step(points: &[BigRational], mask: &[BigRational], curve: Curve) -> Vec<BigRational> {
    let n = points.len() as i64;
    let new = |j: i64, late: bool| rule(mask, j, late, |i| extended(points, curve, i));
    if curve == Curve::Closed {
        return (0..n).flat_map(|j| [new(j, false), new(j, true)]).collect();
    }
    let mut out = vec![points[0].clone()];
    if curve == Curve::Open {
        out.extend((0..n - 1).flat_map(|j| [new(j, false), new(j, true)]));
    } else {
        // Between an anchor's two neighbours, one of them an image, only one
        // half counts.
        out.push(new(0, true));
        out.extend((1..n - 2).flat_map(|j| [new(j, false), new(j, true)]));
        out.push(new(n - 2, false));
    }
    out.push(points[points.len() - 1].clone());
    out
}

/// Point `i` of the curve continued beyond its ends by the odd extension
/// `p₋ⱼ = 2p₀ − pⱼ`. On an anchored curve the anchors are centres only: the
/// sequence is `…, 2A − q₁, q₁, …, q_m, 2B − q_m, …` with `q₁` at 1.
fn extended(points: &[BigRational], curve: Curve, i: i64) -> BigRational {
    let last = points.len() as i64 - 1;
    let image = |end: i64, j: i64| ratio(2, 1) * &points[end as usize] - extended(points, curve, j);
    match curve {
        Curve::Closed => points[i.rem_euclid(last + 1) as usize].clone(),
        Curve::Open if i < 0 => image(0, -i),
        Curve::Open if i > last => image(last, 2 * last - i),
        Curve::Anchored if i < 1 => image(0, 1 - i),
        Curve::Anchored if i > last - 1 => image(last, 2 * last - 1 - i),
        Curve::Open | Curve::Anchored => points[i as usize].clone(),
    }
}

/// One step of a grid: every row, then every column.
pub fn tensor_step(grid: &Grid, mask: &[BigRational], rows: Curve, columns: Curve) -> Grid {
    let along: Grid = grid.iter().map(|row| step(row, mask, rows)).collect();
    let turned = transpose(&along).iter().map(|column| step(column, mask, columns)).collect();
    transpose(&turned)
}

fn transpose(grid: &Grid) -> Grid {
    let column = |j: usize| grid.iter().map(|row| row[j].clone()).collect();
    (0..grid[0].len()).map(column).collect()
}

/// The faces of a grid whose points are numbered row by row; a closed direction
/// wraps.
pub fn grid_faces(
    row_count: usize,
    column_count: usize,
    rows: Curve,
    columns: Curve,
) -> Vec<Vec<usize>> {
    let cells = |count: usize, curve| if curve == Curve::Closed { count } else { count - 1 };
    let at = |i: usize, j: usize| (i % row_count) * column_count + j % column_count;
    let quad = |i: usize, j: usize| vec![at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)];
    let (height, width) = (cells(row_count, columns), cells(column_count, rows));
    (0..height).flat_map(|i| (0..width).map(move |j| quad(i, j))).collect()
}
