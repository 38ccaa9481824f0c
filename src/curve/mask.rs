//! The mask of a stationary scheme of any arity.
//!
//! A scheme of arity m with mask a refines a polygon p to q,
//!
//! qᵢ = Σⱼ a₍ᵢ₋ₘⱼ₎ pⱼ,
//!
//! so that there is one rule for each residue of i mod m (Dyn, *Subdivision schemes in
//! computer-aided geometric design*, 1992; for m = 2 this is equation 2 of the founding paper).
//! The rules reproduce constants: Σⱼ a₍ₑ₊ₘⱼ₎ = 1 for every residue e, without which no
//! scheme converges.

use std::str::FromStr;

use num_traits::{One, Zero};

use super::laurent::Laurent;
use super::rational::{self, Rational, ratio};
use crate::base::{Error, ErrorKind, Result};

/// The most coefficients of a mask.
pub const MOST_COEFFICIENTS: usize = 1024;
/// The largest arity.
pub const LARGEST_ARITY: usize = 64;
/// The largest absolute offset.
const LARGEST_OFFSET: i64 = 1 << 20;

/// Where new points lie with respect to old ones, by the shift τ.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Parametrisation {
    /// τ is an integer: a new point belongs to every old one.
    Primal,
    /// τ is an odd multiple of ½: new points lie on both sides of an old one.
    Dual,
    /// Any other τ.
    Other,
}

impl Parametrisation {
    /// `primal`, `dual` or `other`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Primal => "primal",
            Self::Dual => "dual",
            Self::Other => "other",
        }
    }
}

/// One term of a rule: new point m·t + e takes `weight` of old point t + `shift`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Tap {
    /// The weight.
    pub weight: Rational,
    /// The old point, counted from t.
    pub shift: i64,
}

/// A mask that satisfies the sum rule of order 1; see the module's text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Mask {
    arity: usize,
    symbol: Laurent,
}

impl Mask {
    /// The mask with aₖ = `coefficients[k − offset]`. Zeros at both ends are taken off.
    ///
    /// # Errors
    /// [`ErrorKind::ParameterOutOfRange`] for an arity outside of 2..=64, no coefficients,
    /// an offset beyond ±2²⁰, or coefficients that do not sum to 1 for each residue;
    /// [`ErrorKind::TooLarge`] for more than 1024 coefficients or one of more than 4096 bits.
    pub fn new(arity: usize, offset: i64, coefficients: Vec<Rational>) -> Result<Self> {
        if !(2..=LARGEST_ARITY).contains(&arity) {
            return Err(out_of_range(format!("arity {arity} is not within 2..={LARGEST_ARITY}")));
        }
        check_length(coefficients.len())?;
        if offset.abs() > LARGEST_OFFSET {
            return Err(out_of_range(format!("offset {offset} is not within ±{LARGEST_OFFSET}")));
        }
        coefficients.iter().try_for_each(rational::check_size)?;
        Self::from_symbol(arity, Laurent::new(offset, coefficients))
    }

    /// The mask with its middle at 0, or for an even number of coefficients at −½.
    ///
    /// # Errors
    /// As [`Mask::new`].
    pub fn centred(arity: usize, coefficients: Vec<Rational>) -> Result<Self> {
        let offset = -(coefficients.len() as i64 / 2);
        Self::new(arity, offset, coefficients)
    }

    /// Reads coefficients separated by commas, such as `1/4,3/4,3/4,1/4` or, over one
    /// denominator, `[1,3,3,1]/4`; without an offset the mask is centred. If all but the last are
    /// integers, which alone are no mask, its denominator, as written, is that of all: `1,3,3,1/4`,
    /// `2,6,6,2/8`.
    ///
    /// # Errors
    /// As [`rational::parse`] for a coefficient that is no number; as [`Mask::new`].
    pub fn parse(text: &str, arity: usize, offset: Option<i64>) -> Result<Self> {
        let (list, over) = common_denominator(text)?;
        check_length(list.split(',').count())?;
        if list.trim().is_empty() {
            let message = "no coefficients: a list such as 1/4,3/4,3/4,1/4 or [1,3,3,1]/4 is meant";
            return Err(Error::new(ErrorKind::InvalidText, message));
        }
        let mut coefficients = list.split(',').map(coefficient).collect::<Result<Vec<_>>>()?;
        for coefficient in &mut coefficients {
            *coefficient /= &over;
        }
        let offset = offset.unwrap_or(-(coefficients.len() as i64 / 2));
        // Integers and one fraction break the sum rule, unless its denominator is that of all.
        if let Some((last, others)) = coefficients.split_last_mut()
            && !text.contains('[')
            && others.iter().all(Rational::is_integer)
        {
            // As it is written: 2/8 is in lowest terms by now.
            let written = list.rsplit_once('/').and_then(|(_, over)| rational::parse(over).ok());
            let shared = written.unwrap_or_else(|| Rational::from(last.denom().clone()));
            for other in others {
                *other /= &shared;
            }
        }
        Self::new(arity, offset, coefficients)
    }

    pub(crate) fn from_symbol(arity: usize, symbol: Laurent) -> Result<Self> {
        let mut sums = vec![Rational::zero(); arity];
        for (k, c) in (symbol.lowest()..).zip(symbol.coefficients()) {
            sums[k.rem_euclid(arity as i64) as usize] += c;
        }
        if sums.iter().all(One::is_one) {
            return Ok(Self { arity, symbol });
        }
        Err(out_of_range(broken_sum_rule(&sums)))
    }

    /// The number of new points per old one, m.
    pub fn arity(&self) -> usize {
        self.arity
    }

    /// The index of the first coefficient.
    pub fn offset(&self) -> i64 {
        self.symbol.lowest()
    }

    /// All coefficients.
    pub fn coefficients(&self) -> &[Rational] {
        self.symbol.coefficients()
    }

    /// a(z) = Σ aₖ zᵏ.
    pub fn symbol(&self) -> &Laurent {
        &self.symbol
    }

    /// True if the mask reads the same from both ends.
    pub fn is_symmetric(&self) -> bool {
        self.symbol.is_symmetric()
    }

    /// The shift of the parametrisation, τ = a′(1)/m (Dyn, Hormann, Sabin and Shen, 2008):
    /// new point i of level k+1 belongs to the parameter (i − τ)/m in intervals of level k,
    /// if old point j belongs to j.
    pub fn tau(&self) -> Rational {
        self.symbol.derivative_at_one(1) / ratio(self.arity as i64, 1)
    }

    /// Primal, dual or other, by τ.
    pub fn parametrisation(&self) -> Parametrisation {
        let tau = self.tau();
        if tau.is_integer() {
            Parametrisation::Primal
        } else if (tau * ratio(2, 1)).is_integer() {
            Parametrisation::Dual
        } else {
            Parametrisation::Other
        }
    }

    /// True if every old point is kept: some residue's rule is a single 1.
    pub fn is_interpolating(&self) -> bool {
        (0..self.arity).any(|residue| {
            let taps = self.taps(residue);
            taps.len() == 1
        })
    }

    /// The terms of new points m·t + `residue`, by ascending shift; no weight is 0.
    pub fn taps(&self, residue: usize) -> Vec<Tap> {
        let (m, e) = (self.arity as i64, residue as i64);
        let exponents = (self.symbol.lowest()..=self.symbol.highest()).rev();
        let of_rule = exponents.filter(|k| (e - k).rem_euclid(m) == 0);
        let taps = of_rule.map(|k| Tap { weight: self.symbol.at(k), shift: (e - k).div_euclid(m) });
        taps.filter(|tap| !tap.weight.is_zero()).collect()
    }

    /// Twice the middle of the mask: an even number where new points lie over old ones.
    pub(crate) fn twice_centre(&self) -> i64 {
        self.symbol.lowest() + self.symbol.highest()
    }
}

impl FromStr for Mask {
    type Err = Error;

    /// Reads a binary mask, centred; see [`Mask::parse`].
    fn from_str(text: &str) -> Result<Self> {
        Self::parse(text, 2, None)
    }
}

/// The list in `[1,3,3,1]/4` and its denominator; a list without brackets as it is.
fn common_denominator(text: &str) -> Result<(&str, Rational)> {
    let Some(inside) = text.trim().strip_prefix('[') else { return Ok((text, Rational::one())) };
    let split = inside.split_once(']').map(|(list, rest)| (list, rest.trim()));
    let denominator = |rest: &str| match rest {
        "" => Some(Rational::one()),
        _ => rational::parse(rest.strip_prefix('/')?).ok().filter(|d| !d.is_zero()),
    };
    let found = split.and_then(|(list, rest)| Some((list, denominator(rest)?)));
    found.ok_or_else(|| {
        let shown: String = text.chars().take(40).collect();
        let message = format!("'{shown}' is not a list such as [1,3,3,1]/4");
        Error::new(ErrorKind::InvalidText, message)
    })
}

/// One coefficient of a list; other marks than commas are what is mistaken most.
fn coefficient(text: &str) -> Result<Rational> {
    let apart = text.trim().contains([' ', ';', '\t']) && !text.contains('/');
    rational::parse(text).map_err(|e| {
        if !apart {
            return e;
        }
        Error::new(e.kind(), format!("{e}; commas stand between coefficients"))
    })
}

/// What is wrong with the sums of some rules, and what would mend it.
fn broken_sum_rule(sums: &[Rational]) -> String {
    /// Rules that are told.
    const MOST: usize = 4;
    let arity = sums.len();
    let wrong = sums.iter().enumerate().filter(|(_, sum)| !sum.is_one());
    let one = |(i, (e, sum)): (usize, (usize, &Rational))| {
        let index = if i == 0 { format!("those of index {e} mod {arity}") } else { e.to_string() };
        format!("{index} sum to {}", shown(sum))
    };
    let mut list: Vec<_> = wrong.clone().take(MOST).enumerate().map(one).collect();
    let left = wrong.count() - list.len();
    if left > 0 {
        list.push(format!("{left} more do not either"));
    }
    let (list, first) = (list.join(", "), &sums[0]);
    let mut advice = String::new();
    if sums.iter().all(|sum| sum == first) && !first.is_zero() {
        advice = format!("; all divided by {} make a mask, as in [1,3,3,1]/4", shown(first));
    }
    format!("sum rule: the coefficients of each of the {arity} rules must sum to 1; {list}{advice}")
}

pub(crate) fn check_length(length: usize) -> Result<()> {
    if length == 0 {
        return Err(out_of_range("a mask without coefficients".to_owned()));
    }
    if length > MOST_COEFFICIENTS {
        let message = format!("{length} coefficients: the limit is {MOST_COEFFICIENTS}");
        return Err(Error::new(ErrorKind::TooLarge, message));
    }
    Ok(())
}

/// A number for a message, short whatever its size.
fn shown(value: &Rational) -> String {
    let text = value.to_string();
    match rational::to_f64(value) {
        _ if text.len() <= 40 => text,
        near if near.is_finite() => format!("about {near:e}"),
        _ => format!("a number of {} digits", value.to_integer().to_string().len()),
    }
}

pub(crate) fn out_of_range(message: String) -> Error {
    Error::new(ErrorKind::ParameterOutOfRange, message)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rules_of_chaikin() {
        let mask: Mask = "1/4,3/4,3/4,1/4".parse().unwrap();
        let rule = |e| mask.taps(e).into_iter().map(|t| (t.weight, t.shift)).collect::<Vec<_>>();
        assert_eq!(mask.offset(), -2);
        assert_eq!(rule(0), [(ratio(3, 4), 0), (ratio(1, 4), 1)]);
        assert_eq!(rule(1), [(ratio(1, 4), 0), (ratio(3, 4), 1)]);
        assert_eq!(mask.tau(), ratio(-1, 2));
        assert_eq!(mask.parametrisation(), Parametrisation::Dual);
    }

    #[test]
    fn one_denominator_for_all() {
        let mask: Mask = "1/4,3/4,3/4,1/4".parse().unwrap();
        for text in [
            "[1,3,3,1]/4",
            " [ 1, 3,3,1 ] / 4",
            "1,3,3,1/4",
            "2,6,6,2/8",
            "4/4,3,3,1/4",
            "[1/2,3/2,3/2,1/2]/2",
        ] {
            assert_eq!(text.parse::<Mask>().unwrap(), mask, "{text}");
        }
        let plain = Mask::parse("1,1", 2, None).unwrap();
        assert_eq!(plain.coefficients(), [ratio(1, 1), ratio(1, 1)]);
    }

    #[test]
    fn what_is_no_mask_is_told_with_what_would_be_one() {
        for (text, arity, words) in [
            ("", 2, "no coefficients: a list such as"),
            ("[]/2", 2, "no coefficients"),
            ("1 3 3 1", 2, "commas stand between"),
            ("1/0,1", 2, "'1/0' has the denominator 0"),
            ("1/4,3/4,3/4", 2, "must sum to 1; those of index 1 mod 2 sum to 3/4"),
            ("1,2", 2, "those of index 1 mod 2 sum to 2"),
            ("1,2,2,1", 2, "0 mod 2 sum to 3, 1 sum to 3; all divided by 3 make a mask"),
            ("1,1", 8, "0 mod 8 sum to 0, 1 sum to 0, 2 sum to 0, 3 sum to 0, 2 more do not"),
        ] {
            let message = Mask::parse(text, arity, Some(6)).unwrap_err().to_string();
            assert!(message.contains(words), "{text}: {message}");
        }
        let exact = Mask::parse("25e-2,7.5e-1,75E-2,0.25", 2, None).unwrap();
        assert_eq!(exact, "[1,3,3,1]/4".parse().unwrap());
    }

    #[test]
    fn what_is_no_mask_is_refused() {
        let kind = |text: &str, arity| Mask::parse(text, arity, None).unwrap_err().kind();
        assert_eq!(kind("", 2), ErrorKind::InvalidText);
        assert_eq!(kind("1/2,,1/2", 2), ErrorKind::InvalidText);
        assert_eq!(kind("1,1e400", 2), ErrorKind::ParameterOutOfRange);
        assert_eq!(kind("1,1e401", 2), ErrorKind::ParameterOutOfRange);
        assert_eq!(kind("1/2,1,1/3", 2), ErrorKind::ParameterOutOfRange);
        for text in ["[1,3,3,1", "[1,3,3,1]4", "[1,3,3,1]/0", "[1,3,3,1]/x", "[]/2", "[1,1]]"] {
            assert_eq!(kind(text, 2), ErrorKind::InvalidText, "{text}");
        }
        assert_eq!(kind("1,3,3,1/5", 2), ErrorKind::ParameterOutOfRange);
        assert_eq!(kind("0", 2), ErrorKind::ParameterOutOfRange);
        for arity in [0, 1, 65] {
            assert_eq!(kind("1,1", arity), ErrorKind::ParameterOutOfRange);
        }
        assert_eq!(kind(&"1,".repeat(5000), 2), ErrorKind::TooLarge);
        let empty = Mask::new(2, 0, Vec::new()).unwrap_err();
        assert_eq!(empty.kind(), ErrorKind::ParameterOutOfRange);
        let far = Mask::new(2, i64::MIN + 1, vec![ratio(1, 1), ratio(1, 1)]).unwrap_err();
        assert_eq!(far.kind(), ErrorKind::ParameterOutOfRange);
        let huge = Rational::from(num_bigint::BigInt::from(1) << 5000);
        let huge = Mask::new(2, 0, vec![huge.clone(), huge]).unwrap_err();
        assert_eq!(huge.kind(), ErrorKind::TooLarge);
    }
}
