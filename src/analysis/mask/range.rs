//! For which parameters the schemes of a family are C^k.
//!
//! The masks of the family are a + w·b. All of them have the smoothing factors that a and b have
//! in common; some single w may have one more. Below that number of factors the range of w is
//! found by sampling and by bisection. What is *certified* are the ends: on one side of each a w
//! whose scheme is proved C^k, on the other one whose exponent is proved to be k at most. That all
//! w between the ends are like those that were sampled is not proved.

use num_traits::{Zero, pow};

use super::contractivity::contractivity;
use super::joint_radius::{Side, side_of};
use super::sum_rules::Smoothing;
use crate::base::{Context, Error, ErrorKind, Result};
use crate::curve::catalogue::Family;
use crate::curve::rational::{ratio, to_f64};
use crate::curve::{Laurent, Mask, Rational};

/// Values of w that are looked at first.
const SAMPLES: i64 = 32;

/// Masks a + w·b of one arity, all satisfying the sum rule.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct AffineFamily {
    arity: usize,
    constant: Laurent,
    slope: Laurent,
}

/// Some w for which a family is C^k.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum ParameterRange {
    /// An interval. It begins between `low.outside` and `low.inside` and ends between
    /// `high.inside` and `high.outside`.
    Interval {
        /// The lower end.
        low: End,
        /// The upper end.
        high: End,
    },
    /// One value, which has a smoothing factor more than its neighbours.
    Single(Rational),
}

/// An end of an interval, between two certified values.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct End {
    /// Proved C^k.
    pub inside: Rational,
    /// Proved to have an exponent of k at most, so not to be C^k if the shifts of the limit
    /// function are stable; `None` if the search ended before.
    pub outside: Option<Rational>,
}

/// What is proved about one w.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Verdict {
    Smooth,
    NotSmooth,
    Open,
}

impl AffineFamily {
    /// The family with `at_zero` for w = 0 and `at_one` for w = 1.
    ///
    /// # Errors
    /// [`ErrorKind::ParameterOutOfRange`] for masks of different arities or the same mask.
    pub fn through(at_zero: &Mask, at_one: &Mask) -> Result<Self> {
        let slope = at_one.symbol() - at_zero.symbol();
        if at_zero.arity() != at_one.arity() || slope.is_zero() {
            let message = "a family needs two different masks of one arity".to_owned();
            return Err(Error::new(ErrorKind::ParameterOutOfRange, message));
        }
        Ok(Self { arity: at_zero.arity(), constant: at_zero.symbol().clone(), slope })
    }

    /// A family of the catalogue with its free parameter `index` left open, the others given.
    ///
    /// # Errors
    /// [`ErrorKind::ParameterOutOfRange`] if the parameter does not exist or is no free one;
    /// as [`Family::mask`].
    pub fn of(family: &Family, parameters: &[Rational], index: usize) -> Result<Self> {
        let parameter = family.parameters.get(index).filter(|parameter| parameter.is_free);
        if parameter.is_none() || parameters.len() != family.parameters.len() {
            let message = format!("{} has no free parameter number {index}", family.name);
            return Err(Error::new(ErrorKind::ParameterOutOfRange, message));
        }
        let at = |w: i64| {
            let mut all = parameters.to_vec();
            all[index] = ratio(w, 1);
            family.mask(&all)
        };
        Self::through(&at(0)?, &at(1)?)
    }

    /// The mask for a parameter.
    ///
    /// # Errors
    /// As [`Mask::new`].
    pub fn mask(&self, w: &Rational) -> Result<Mask> {
        let symbol = &self.constant + &self.slope.scaled(w);
        Mask::new(self.arity, symbol.lowest(), symbol.coefficients().to_vec())
    }

    /// The number of smoothing factors of all masks, and the w that has more, if one has.
    pub fn factors(&self) -> (usize, Option<Rational>) {
        let sigma = Laurent::sigma(self.arity);
        let (mut constant, mut slope, mut common) = (self.constant.clone(), self.slope.clone(), 0);
        while let (Some(a), Some(b)) = (constant.divided_by(&sigma), slope.divided_by(&sigma)) {
            if constant.is_zero() {
                break;
            }
            (constant, slope, common) = (a, b, common + 1);
        }
        (common, self.special(&constant, &slope))
    }

    /// The w for which constant + w·slope has the factor σ, whose class sums are all equal.
    fn special(&self, constant: &Laurent, slope: &Laurent) -> Option<Rational> {
        let (a, b) = (self.class_differences(constant), self.class_differences(slope));
        let pivot = b.iter().position(|difference| !difference.is_zero())?;
        let w = -(&a[pivot] / &b[pivot]);
        let all = a.iter().zip(&b).all(|(a, b)| (a + &w * b).is_zero());
        all.then_some(w)
    }

    /// Sums of the coefficients in residue classes, less that of class 0: what is left of
    /// the polynomial modulo z^m − 1 is a multiple of σ if they are 0.
    fn class_differences(&self, polynomial: &Laurent) -> Vec<Rational> {
        let m = self.arity as i64;
        let mut sums = vec![Rational::zero(); self.arity];
        for (k, c) in (polynomial.lowest()..).zip(polynomial.coefficients()) {
            sums[k.rem_euclid(m) as usize] += c;
        }
        sums[1..].iter().map(|sum| sum - &sums[0]).collect()
    }

    /// All w within `low..=high` for which the scheme is C^`k`, ends narrower than
    /// `tolerance` where both sides can be decided so close together.
    ///
    /// About a hundred comparisons of a joint spectral radius with m⁻ᵏ: about a second. Intervals
    /// narrower than a 32nd of the search may be missed.
    ///
    /// # Errors
    /// [`ErrorKind::ParameterOutOfRange`] for an empty search or a tolerance that is not
    /// positive; [`ErrorKind::Cancelled`]; as [`Mask::new`].
    pub fn continuity_range(
        &self,
        context: &Context,
        k: usize,
        [low, high]: [&Rational; 2],
        tolerance: &Rational,
    ) -> Result<Vec<ParameterRange>> {
        if low >= high || *tolerance <= Rational::zero() {
            let message = "an empty search, or a tolerance that is not positive".to_owned();
            return Err(Error::new(ErrorKind::ParameterOutOfRange, message));
        }
        let (factors, special) = self.factors();
        let special = special.filter(|w| low <= w && w <= high);
        if k >= factors {
            let mut singles = Vec::new();
            if let Some(w) = special
                && self.verdict(context, &w, k)? == Verdict::Smooth
            {
                singles.push(ParameterRange::Single(w));
            }
            return Ok(singles);
        }
        self.intervals(context, k, [low, high], tolerance)
    }

    fn intervals(
        &self,
        context: &Context,
        k: usize,
        [low, high]: [&Rational; 2],
        tolerance: &Rational,
    ) -> Result<Vec<ParameterRange>> {
        let step = (high - low) / ratio(SAMPLES, 1);
        let sample = |i: i64| low + &step * ratio(i, 1);
        let mut smooth = Vec::new();
        for i in 0..=SAMPLES {
            context.report(0.5 * i as f64 / SAMPLES as f64)?;
            smooth.push(self.verdict(context, &sample(i), k)? == Verdict::Smooth);
        }
        let mut ranges = Vec::new();
        let mut i = 0;
        while i < smooth.len() {
            let run = smooth[i..].iter().take_while(|is| **is).count();
            if run > 0 {
                context.report(0.5 + 0.5 * i as f64 / smooth.len() as f64)?;
                let before = (i > 0).then(|| sample(i as i64 - 1));
                let last = i + run - 1;
                let behind = (last + 1 < smooth.len()).then(|| sample(last as i64 + 1));
                let low = self.end(context, k, sample(i as i64), before, tolerance)?;
                let high = self.end(context, k, sample(last as i64), behind, tolerance)?;
                ranges.push(ParameterRange::Interval { low, high });
            }
            i += run.max(1);
        }
        Ok(ranges)
    }

    /// Narrows an end down.
    fn end(
        &self,
        context: &Context,
        k: usize,
        inside: Rational,
        beyond: Option<Rational>,
        tolerance: &Rational,
    ) -> Result<End> {
        let Some(beyond) = beyond else { return Ok(End { inside, outside: None }) };
        let far = self.verdict(context, &beyond, k)? == Verdict::NotSmooth;
        // First the edge of what is proved smooth, then that of what is proved not to be.
        let smooth = |verdict| verdict == Verdict::Smooth;
        let (inside, edge) =
            self.bisect(context, k, (inside, beyond.clone()), tolerance, smooth)?;
        let decided = |verdict| verdict != Verdict::NotSmooth;
        let outside = if self.verdict(context, &edge, k)? == Verdict::NotSmooth {
            Some(edge)
        } else if far {
            Some(self.bisect(context, k, (edge, beyond), tolerance, decided)?.1)
        } else {
            None
        };
        Ok(End { inside, outside })
    }

    /// Halves the distance of two values, the first of which fits, until it is small.
    fn bisect(
        &self,
        context: &Context,
        k: usize,
        (mut fits, mut fails): (Rational, Rational),
        tolerance: &Rational,
        fit: impl Fn(Verdict) -> bool,
    ) -> Result<(Rational, Rational)> {
        let two = ratio(2, 1);
        while num_traits::abs(&fits - &fails) > *tolerance {
            context.check_cancelled()?;
            let middle = (&fits + &fails) / &two;
            let place =
                if fit(self.verdict(context, &middle, k)?) { &mut fits } else { &mut fails };
            *place = middle;
        }
        Ok((fits, fails))
    }

    fn verdict(&self, context: &Context, w: &Rational, k: usize) -> Result<Verdict> {
        /// Powers that are tried before anything dearer.
        const CHEAP: u32 = 4;
        context.check_cancelled()?;
        let mask = self.mask(w)?;
        if contractivity(context, &mask, k, CHEAP)?.is_some() {
            return Ok(Verdict::Smooth);
        }
        let Smoothing { factors, kernel } = Smoothing::of(&mask);
        if k >= factors {
            return Ok(Verdict::Open);
        }
        // C^k asks for an exponent above k: a radius below m⁻ᵏ.
        let threshold = pow(ratio(1, self.arity as i64), k);
        Ok(match side_of(context, self.arity, &kernel, &threshold)? {
            Side::Below => Verdict::Smooth,
            Side::AtLeast => Verdict::NotSmooth,
            Side::Open => Verdict::Open,
        })
    }
}

impl End {
    /// Half-way between what is proved on both sides.
    pub fn middle(&self) -> f64 {
        let inside = to_f64(&self.inside);
        self.outside.as_ref().map_or(inside, |outside| f64::midpoint(inside, to_f64(outside)))
    }
}
