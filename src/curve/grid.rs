//! Grids: tensor products of two masks, and any bivariate mask.
//!
//! A bivariate mask of arities m and n refines a grid p to q_ij = Σ a_(i−mk, j−nl) p_kl, one rule
//! for each pair of residues: for m = n = 2 the four parity rules of the founding paper (its
//! equation 3).

use num_traits::{One, Zero};

use super::coordinate::Coordinate;
use super::ends::{Ends, Extent, check_steps, predict};
use super::mask::{LARGEST_ARITY, MOST_COEFFICIENTS, Mask, out_of_range};
use super::rational::{self, Rational};
use super::refine::{check_overflow, check_points, check_total};
use super::rules::Rules;
use super::step::{Source, step};
use crate::base::{Context, Error, ErrorKind, Result, memory};

/// A grid of points, row by row; the first direction goes from row to row, the second along.
#[derive(Debug, Clone, PartialEq)]
pub struct Grid<T> {
    /// All coordinates.
    pub points: Vec<T>,
    /// Points per row, at least 1.
    pub columns: usize,
    /// Coordinates per point, at least 1.
    pub width: usize,
    /// The ends of either direction.
    pub ends: [Ends; 2],
}

/// A bivariate mask: coefficients a_ij of arities and offsets in both directions, each rule
/// summing to 1.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct GridMask {
    arity: [usize; 2],
    offset: [i64; 2],
    columns: usize,
    coefficients: Vec<Rational>,
}

impl GridMask {
    /// The mask with a_(offset₀ + r, offset₁ + c) = `coefficients[r · columns + c]`.
    ///
    /// # Errors
    /// [`ErrorKind::ParameterOutOfRange`] for an arity outside of 2..=64, coefficients that
    /// are no full rows, an offset beyond ±2²⁰, or rules that do not sum to 1;
    /// [`ErrorKind::TooLarge`] for more than 2²⁰ coefficients, or one of more than 4096 bits.
    pub fn new(
        arity: [usize; 2],
        offset: [i64; 2],
        columns: usize,
        coefficients: Vec<Rational>,
    ) -> Result<Self> {
        if arity.iter().any(|m| !(2..=LARGEST_ARITY).contains(m)) {
            return Err(out_of_range(format!("arities {arity:?} are not within 2..=64")));
        }
        Self::check_count(coefficients.len())?;
        if coefficients.is_empty() || columns == 0 || !coefficients.len().is_multiple_of(columns) {
            let message = format!("{} coefficients in rows of {columns}", coefficients.len());
            return Err(out_of_range(message));
        }
        if offset.iter().any(|o| o.unsigned_abs() > 1 << 20) {
            return Err(out_of_range(format!("offsets {offset:?} are not within ±2^20")));
        }
        coefficients.iter().try_for_each(rational::check_size)?;
        let it = Self { arity, offset, columns, coefficients };
        it.check_sums()?;
        Ok(it)
    }

    /// a(z₁)·b(z₂).
    ///
    /// # Errors
    /// [`ErrorKind::TooLarge`] as [`GridMask::new`].
    pub fn tensor(a: &Mask, b: &Mask) -> Result<Self> {
        let row = |x: &Rational| b.coefficients().iter().map(|y| x * y).collect::<Vec<_>>();
        let coefficients = a.coefficients().iter().flat_map(row).collect();
        let columns = b.coefficients().len();
        Self::new([a.arity(), b.arity()], [a.offset(), b.offset()], columns, coefficients)
    }

    /// Refuses more coefficients than a mask has.
    ///
    /// # Errors
    /// [`ErrorKind::TooLarge`].
    pub(crate) fn check_count(count: usize) -> Result<()> {
        const MOST: usize = MOST_COEFFICIENTS * MOST_COEFFICIENTS;
        if count > MOST {
            let message = format!("{count} coefficients: the limit is {MOST}");
            return Err(Error::new(ErrorKind::TooLarge, message));
        }
        Ok(())
    }

    /// The rows and columns of a grid of so many, with such ends, after `steps` steps.
    ///
    /// # Errors
    /// As [`Grid::refine_by`], without those of points.
    pub fn predict(&self, ends: [Ends; 2], size: [usize; 2], steps: u32) -> Result<[usize; 2]> {
        check_ends(ends)?;
        let predicted = |k: usize| predict(&self.profile(k), ends[k], size[k], steps);
        Ok([predicted(0)?.0, predicted(1)?.0])
    }

    /// The arities of both directions.
    pub fn arity(&self) -> [usize; 2] {
        self.arity
    }

    /// Exponents and coefficients of the symbol, zeros left out.
    pub fn terms(&self) -> impl Iterator<Item = ([i64; 2], &Rational)> {
        let columns = self.columns;
        let terms = self.coefficients.iter().enumerate().filter(|(_, c)| !c.is_zero());
        terms.map(move |(at, c)| {
            let place = [(at / columns) as i64, (at % columns) as i64];
            ([self.offset[0] + place[0], self.offset[1] + place[1]], c)
        })
    }

    fn check_sums(&self) -> Result<()> {
        let [m, n] = self.arity;
        for (e, f) in (0..m).flat_map(|e| (0..n).map(move |f| (e, f))) {
            let sum: Rational = self.taps(e, f).map(|(w, _)| w).sum();
            if !sum.is_one() {
                let message =
                    format!("sum rule: the rule of residues ({e}, {f}) sums to {sum}, not to 1");
                return Err(out_of_range(message));
            }
        }
        Ok(())
    }

    /// Weights and shifts in both directions of the rule of two residues.
    fn taps(&self, e: usize, f: usize) -> impl Iterator<Item = (&Rational, [i64; 2])> {
        let first = |k: usize, residue: usize| {
            (residue as i64 - self.offset[k]).rem_euclid(self.arity[k] as i64) as usize
        };
        let [rows, columns] = [self.coefficients.len() / self.columns, self.columns];
        let places = (first(0, e)..rows).step_by(self.arity[0]).flat_map(move |row| {
            (first(1, f)..columns).step_by(self.arity[1]).map(move |column| [row, column])
        });
        let shift = move |k: usize, residue: usize, at: usize| {
            (residue as i64 - self.offset[k] - at as i64).div_euclid(self.arity[k] as i64)
        };
        places.filter_map(move |[row, column]| {
            let weight = &self.coefficients[row * columns + column];
            (!weight.is_zero()).then(|| (weight, [shift(0, e, row), shift(1, f, column)]))
        })
    }

    /// All rules, residues of the second direction running first.
    fn rules<T: Coordinate>(&self) -> Vec<Vec<(T, [i64; 2])>> {
        let rule = |e, f| self.taps(e, f).map(|(w, shift)| (T::from_rational(w), shift)).collect();
        let [m, n] = self.arity;
        (0..m).flat_map(|e| (0..n).map(move |f| (e, f))).map(|(e, f)| rule(e, f)).collect()
    }

    /// How far rules reach in one direction, as rules of that direction alone.
    fn profile(&self, direction: usize) -> Rules<f64> {
        let [m, n] = self.arity;
        let pairs = |e: usize| {
            let others = 0..if direction == 0 { n } else { m };
            others.map(move |f| if direction == 0 { (e, f) } else { (f, e) })
        };
        let shifts = |e: usize| {
            let taps = pairs(e).flat_map(|(e, f)| self.taps(e, f));
            taps.map(|(_, shift)| (0.0, shift[direction])).collect::<Vec<_>>()
        };
        Rules::of_reach((0..self.arity[direction]).map(shifts).collect())
    }
}

/// Refuses ends that only tensor products have.
fn check_ends(ends: [Ends; 2]) -> Result<()> {
    if ends.iter().any(|ends| matches!(ends, Ends::Kept | Ends::Anchored)) {
        let message = "ends stay under tensor products only".to_owned();
        return Err(Error::new(ErrorKind::Unsupported, message));
    }
    Ok(())
}

impl<T: Coordinate> Grid<T> {
    /// The number of rows.
    pub fn rows(&self) -> usize {
        self.points.len() / (self.columns * self.width).max(1)
    }

    /// The grid after `steps` steps of a tensor product: mask `a` from row to row, `b` along.
    ///
    /// # Errors
    /// As [`super::Polygon::refine`], points counted row by row.
    pub fn refine(&self, context: &Context, [a, b]: [&Mask; 2], steps: u32) -> Result<Self> {
        self.check()?;
        let (a, b) = (Rules::new(a), Rules::new(b));
        let (rows, _) = predict(&a, self.ends[0], self.rows(), steps)?;
        let (columns, _) = predict(&b, self.ends[1], self.columns, steps)?;
        check_total(context, rows.saturating_mul(columns), self.width, T::BYTES)?;
        let mut grid = self.copied()?;
        for step in 0..steps {
            context.report(f64::from(step) / f64::from(steps))?;
            grid = grid.tensor_step(context, &a, &b)?;
        }
        Ok(grid)
    }

    fn tensor_step(&self, context: &Context, a: &Rules<T>, b: &Rules<T>) -> Result<Self> {
        // A row is one point of many coordinates to the mask that goes from row to row.
        let wide = self.columns * self.width;
        let down = Extent::of(a, self.ends[0], self.rows())?;
        let along = Extent::of(b, self.ends[1], self.columns)?;
        let mut rows = T::zeros(down.points() * wide)?;
        let source = Source { points: &self.points, width: wide, ends: self.ends[0] };
        step(context, a, &source, &down, &mut rows)?;
        let made = along.points() * self.width;
        let mut points = T::zeros(down.points() * made)?;
        for (row, out) in rows.chunks_exact(wide).zip(points.chunks_exact_mut(made)) {
            let source = Source { points: row, width: self.width, ends: self.ends[1] };
            step(context, b, &source, &along, out)?;
        }
        check_overflow(&self.points, a.norm() * b.norm(), &points, self.width)?;
        let ends = [down.ends, along.ends];
        Ok(Self { points, columns: along.points(), width: self.width, ends })
    }

    fn copied(&self) -> Result<Self> {
        let mut points = memory::reserved(self.points.len())?;
        points.extend_from_slice(&self.points);
        Ok(Self { points, ..*self })
    }

    /// The grid after `steps` steps of any bivariate mask; both directions are closed, or
    /// drop what is incomplete.
    ///
    /// # Errors
    /// As [`Grid::refine`]; [`ErrorKind::Unsupported`] for ends that stay: what a mask that
    /// is no tensor product does along them is not said by the mask.
    pub fn refine_by(&self, context: &Context, mask: &GridMask, steps: u32) -> Result<Self> {
        self.check()?;
        check_steps(steps)?;
        check_ends(self.ends)?;
        let mut grid = self.copied()?;
        for step in 0..steps {
            context.report(f64::from(step) / f64::from(steps))?;
            grid = grid.refined_once(context, mask)?;
        }
        Ok(grid)
    }

    fn check(&self) -> Result<()> {
        if self.columns == 0 || !self.points.len().is_multiple_of(self.columns * self.width.max(1))
        {
            let message = format!("{} coordinates in rows of {}", self.points.len(), self.columns);
            return Err(Error::new(ErrorKind::LengthMismatch, message));
        }
        check_points(&self.points, self.width)
    }

    fn refined_once(&self, context: &Context, mask: &GridMask) -> Result<Self> {
        let profiles = [mask.profile(0), mask.profile(1)];
        let down = Extent::of(&profiles[0], self.ends[0], self.rows())?;
        let along = Extent::of(&profiles[1], self.ends[1], self.columns)?;
        check_total(context, down.made.saturating_mul(along.made), self.width, T::BYTES)?;
        let rules = mask.rules::<T>();
        let wide = along.made * self.width;
        let mut points = T::zeros(down.made * wide)?;
        context.fill(&mut points, wide, |first, part| {
            for (row, out) in (down.first + first as i64..).zip(part.chunks_exact_mut(wide)) {
                for (column, point) in (along.first..).zip(out.chunks_exact_mut(self.width)) {
                    self.combine(mask.arity, &rules, [row, column], point);
                }
            }
        })?;
        let norm = rules.iter().map(|rule| rule.iter().map(|(w, _)| w.to_f64().abs()).sum());
        check_overflow(&self.points, norm.fold(1.0, f64::max), &points, self.width)?;
        Ok(Self { points, columns: along.made, width: self.width, ends: [down.ends, along.ends] })
    }

    /// Makes the new point of a row and column.
    fn combine(
        &self,
        arity: [usize; 2],
        rules: &[Vec<(T, [i64; 2])>],
        [row, column]: [i64; 2],
        point: &mut [T],
    ) {
        let [m, n] = arity.map(|m| m as i64);
        let rule = &rules[(row.rem_euclid(m) * n + column.rem_euclid(n)) as usize];
        let (t, s) = (row.div_euclid(m), column.div_euclid(n));
        point.fill(T::from_f64(0.0));
        for (w, shift) in rule {
            // Open directions never ask for what would wrap.
            let k = (t + shift[0]).rem_euclid(self.rows() as i64) as usize;
            let l = (s + shift[1]).rem_euclid(self.columns as i64) as usize;
            let old = &self.points[(k * self.columns + l) * self.width..][..self.width];
            point.iter_mut().zip(old).for_each(|(value, x)| value.add_product(w, x));
        }
    }
}
