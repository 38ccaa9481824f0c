//! Exact rational numbers as masks and analyses use them.

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{ToPrimitive, Zero};

use crate::base::{Error, ErrorKind, Fraction, Result};

/// An exact rational of any size, in lowest terms.
pub type Rational = BigRational;

/// The most digits of a number in a text.
const MOST_DIGITS: usize = 1000;
/// The most bits of a numerator or denominator of a coefficient.
pub(crate) const MOST_BITS: u64 = 4096;

/// `num / den`.
///
/// # Panics
/// If `den` is 0.
pub fn ratio(num: i64, den: i64) -> Rational {
    Rational::new(num.into(), den.into())
}

/// A parameter as a rational.
pub fn from_fraction(fraction: Fraction) -> Rational {
    ratio(fraction.numerator(), fraction.denominator())
}

/// A rational as a parameter; `None` if a term does not fit 64 bits.
pub fn to_fraction(value: &Rational) -> Option<Fraction> {
    Fraction::new(value.numer().to_i64()?, value.denom().to_i64()?).ok()
}

/// Reads `3`, `-1/32` or a decimal such as `0.03125`, exactly; blanks around terms are let be.
///
/// # Errors
/// [`ErrorKind::InvalidText`] for anything else: exponents, a denominator 0, more than
/// 1000 digits.
pub fn parse(text: &str) -> Result<Rational> {
    let shown: String = text.chars().take(40).collect();
    read(text.trim()).ok_or_else(|| {
        let message = format!("'{shown}' is not a number such as 1/32, 0.5 or 3");
        Error::new(ErrorKind::InvalidText, message)
    })
}

fn read(text: &str) -> Option<Rational> {
    if text.len() > 2 * MOST_DIGITS {
        return None;
    }
    if let Some((num, den)) = text.split_once('/') {
        let (num, den) = (integer(num)?, integer(den)?);
        return (!den.is_zero()).then(|| Rational::new(num, den));
    }
    let Some((whole, digits)) = text.split_once('.') else {
        return integer(text).map(Rational::from);
    };
    let unsigned = whole.strip_prefix(['-', '+']).unwrap_or(whole);
    if digits.is_empty() || !unsigned.bytes().chain(digits.bytes()).all(|b| b.is_ascii_digit()) {
        return None;
    }
    let value = integer(&format!("0{unsigned}{digits}"))?;
    let value = if whole.starts_with('-') { -value } else { value };
    Some(Rational::new(value, BigInt::from(10).pow(digits.len() as u32)))
}

fn integer(text: &str) -> Option<BigInt> {
    let text = text.trim();
    let digits = text.strip_prefix(['-', '+']).unwrap_or(text);
    let plain = !digits.is_empty() && digits.bytes().all(|b| b.is_ascii_digit());
    if plain && digits.len() <= MOST_DIGITS { text.parse().ok() } else { None }
}

/// Refuses a coefficient whose terms are too long to reckon with.
///
/// # Errors
/// [`ErrorKind::TooLarge`].
pub(crate) fn check_size(value: &Rational) -> Result<()> {
    let bits = value.numer().bits().max(value.denom().bits());
    if bits > MOST_BITS {
        let message = format!("a number of {bits} bits: the limit is {MOST_BITS}");
        return Err(Error::new(ErrorKind::TooLarge, message));
    }
    Ok(())
}

/// The nearest double; one beyond the range is infinite.
pub fn to_f64(value: &Rational) -> f64 {
    value.to_f64().unwrap_or(f64::NAN)
}

/// The exact value of a finite double, or `None`.
pub fn from_f64(value: f64) -> Option<Rational> {
    Rational::from_float(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_what_is_a_number_and_nothing_else() {
        for (text, num, den) in
            [("1/32", 1, 32), (" -2 / 4 ", -1, 2), ("0.03125", 1, 32), ("-.5", -1, 2), ("+7", 7, 1)]
        {
            assert_eq!(parse(text).unwrap(), ratio(num, den), "{text}");
        }
        let long = "1".repeat(MOST_DIGITS + 1);
        for text in ["", "1/0", "1e9", "a", "1.", "1/2/3", "--1", "1_0", "0.-1", "nan", &long] {
            assert_eq!(parse(text).unwrap_err().kind(), ErrorKind::InvalidText, "{text}");
        }
    }
}
