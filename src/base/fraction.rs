//! Parameters as exact fractions, so that 1/32 and 1/3 mean what they say.

use super::{Error, ErrorKind, Result};
use std::{fmt, str::FromStr};

/// An exact rational parameter in lowest terms, denominator positive.
///
/// Weights are computed from it in the working precision; exact tests turn it
/// into a big rational without loss.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Fraction {
    num: i64,
    den: i64,
}

impl Fraction {
    /// Zero.
    pub const ZERO: Self = Self { num: 0, den: 1 };
    /// One half.
    pub const HALF: Self = Self { num: 1, den: 2 };
    /// One.
    pub const ONE: Self = Self { num: 1, den: 1 };

    /// The fraction `num / den` in lowest terms.
    ///
    /// # Errors
    /// [`ErrorKind::InvalidText`] if `den` is 0 or a term is `i64::MIN`.
    pub fn new(num: i64, den: i64) -> Result<Self> {
        if den == 0 || num == i64::MIN || den == i64::MIN {
            return Err(Error::new(
                ErrorKind::InvalidText,
                format!("{num}/{den} is not a fraction"),
            ));
        }
        let g = gcd(num.unsigned_abs(), den.unsigned_abs()) as i64 * den.signum();
        Ok(Self { num: num / g, den: den / g })
    }

    /// The numerator; carries the sign.
    pub fn numerator(self) -> i64 {
        self.num
    }

    /// The denominator, at least 1.
    pub fn denominator(self) -> i64 {
        self.den
    }

    /// The nearest double.
    pub fn to_f64(self) -> f64 {
        self.num as f64 / self.den as f64
    }

    /// `a + b·self`, exactly; `None` if a term leaves 64 bits.
    pub(crate) fn affine(self, a: i64, b: i64) -> Option<Self> {
        let num = a.checked_mul(self.den)?.checked_add(b.checked_mul(self.num)?)?;
        Self::new(num, self.den).ok()
    }
}

fn gcd(a: u64, b: u64) -> u64 {
    if b == 0 { a } else { gcd(b, a % b) }
}

impl fmt::Display for Fraction {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.den == 1 {
            write!(f, "{}", self.num)
        } else {
            write!(f, "{}/{}", self.num, self.den)
        }
    }
}

impl FromStr for Fraction {
    type Err = Error;

    /// Reads `3`, `-1/32` or a decimal such as `0.03125`, exactly.
    fn from_str(text: &str) -> Result<Self> {
        parse(text.trim()).ok_or_else(|| {
            Error::new(
                ErrorKind::InvalidText,
                format!("'{text}' is not a number such as 1/32, 0.5 or 3"),
            )
        })
    }
}

fn parse(text: &str) -> Option<Fraction> {
    if let Some((num, den)) = text.split_once('/') {
        return Fraction::new(integer(num)?, integer(den)?).ok();
    }
    let Some((whole, digits)) = text.split_once('.') else {
        return Fraction::new(integer(text)?, 1).ok();
    };
    if digits.is_empty() || !digits.bytes().all(|b| b.is_ascii_digit()) {
        return None;
    }
    let unsigned = whole.strip_prefix(['-', '+']).unwrap_or(whole);
    let num = integer(&format!("0{unsigned}{digits}"))?;
    let den = 10_i64.checked_pow(u32::try_from(digits.len()).ok()?)?;
    Fraction::new(if whole.starts_with('-') { -num } else { num }, den).ok()
}

fn integer(text: &str) -> Option<i64> {
    text.trim().parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_fractions_and_decimals_exactly() {
        for (text, num, den) in [
            ("1/32", 1, 32),
            ("-2/-64", 1, 32),
            ("0.03125", 1, 32),
            ("-.5", -1, 2),
            ("+1.50", 3, 2),
            ("7", 7, 1),
            (" 3 / 6 ", 1, 2),
        ] {
            let f: Fraction = text.parse().unwrap();
            assert_eq!((f.numerator(), f.denominator()), (num, den), "{text}");
        }
    }

    #[test]
    fn refuses_what_is_no_number() {
        for text in
            ["", "1/0", "a", "1.", "1.x", "0.--5", "1e3", "1/2/3", "99999999999999999999", "-"]
        {
            assert_eq!(
                text.parse::<Fraction>().unwrap_err().kind(),
                ErrorKind::InvalidText,
                "{text}"
            );
        }
    }
}
