//! Exact rational numbers as masks and analyses use them.

use num_bigint::BigInt;
use num_integer::Integer as _;
use num_rational::BigRational;
use num_traits::{One, ToPrimitive, Zero};

use crate::base::{Error, ErrorKind, Fraction, Result};

/// An exact rational of any size, in lowest terms.
pub type Rational = BigRational;

/// The most digits of a number in a text.
const MOST_DIGITS: usize = 1000;
/// The largest decimal exponent in a text: those of doubles, and some more.
const LARGEST_EXPONENT: u32 = 400;
/// The most bits of a numerator or denominator of a coefficient.
pub(crate) const MOST_BITS: u64 = 4096;

/// `num / den`.
///
/// # Panics
/// If `den` is 0.
pub fn ratio(num: i64, den: i64) -> Rational {
    Rational::new(num.into(), den.into())
}

/// Numbers as integers over the least common denominator, which is the second result.
pub(crate) fn over_common<'a>(
    list: impl Iterator<Item = &'a Rational> + Clone,
) -> (Vec<BigInt>, BigInt) {
    let least = |d: BigInt, c: &Rational| {
        // Much cheaper than looking for common factors.
        if (&d % c.denom()).is_zero() { d } else { d.lcm(c.denom()) }
    };
    let common = list.clone().fold(BigInt::one(), least);
    let whole = list.map(|c| c.numer() * (&common / c.denom())).collect();
    (whole, common)
}

/// A parameter as a rational.
pub fn from_fraction(fraction: Fraction) -> Rational {
    ratio(fraction.numerator(), fraction.denominator())
}

/// A rational as a parameter; `None` if a term does not fit 64 bits.
pub fn to_fraction(value: &Rational) -> Option<Fraction> {
    Fraction::new(value.numer().to_i64()?, value.denom().to_i64()?).ok()
}

/// Reads `3`, `-1/32`, or a decimal such as `0.03125` or `5e-1`, exactly; blanks around terms are
/// let be.
///
/// # Errors
/// [`ErrorKind::InvalidText`] for anything else, a denominator 0, more than 1000 digits;
/// [`ErrorKind::ParameterOutOfRange`] for a decimal exponent beyond ±400.
pub fn parse(text: &str) -> Result<Rational> {
    let shown: String = text.chars().take(40).collect();
    read(text.trim()).map_err(|wrong| match wrong {
        Wrong::Text if text.trim().is_empty() => {
            let message = "a number such as 1/32, 0.5, 5e-1 or 3 is missing";
            Error::new(ErrorKind::InvalidText, message)
        }
        Wrong::Text => {
            let message = format!("'{shown}' is not a number such as 1/32, 0.5, 5e-1 or 3");
            Error::new(ErrorKind::InvalidText, message)
        }
        Wrong::Denominator => {
            Error::new(ErrorKind::InvalidText, format!("'{shown}' has the denominator 0"))
        }
        Wrong::Exponent => {
            let message = format!("'{shown}' has an exponent beyond ±{LARGEST_EXPONENT}");
            Error::new(ErrorKind::ParameterOutOfRange, message)
        }
    })
}

/// Why a text is no number.
enum Wrong {
    Text,
    Denominator,
    Exponent,
}

fn read(text: &str) -> std::result::Result<Rational, Wrong> {
    if text.len() > 2 * MOST_DIGITS {
        return Err(Wrong::Text);
    }
    let term = |text| integer(text).ok_or(Wrong::Text);
    if let Some((num, den)) = text.split_once('/') {
        let (num, den) = (term(num)?, term(den)?);
        return if den.is_zero() { Err(Wrong::Denominator) } else { Ok(Rational::new(num, den)) };
    }
    let Some((mantissa, exponent)) = text.split_once(['e', 'E']) else {
        return decimal(text).ok_or(Wrong::Text);
    };
    let mantissa = decimal(mantissa).ok_or(Wrong::Text)?;
    // An exponent of many digits is one that is too large.
    let large = |exponent: &BigInt| exponent.magnitude() > &LARGEST_EXPONENT.into();
    let plain = !exponent.contains(char::is_whitespace);
    let exponent = integer(exponent).filter(|_| plain).ok_or(Wrong::Text)?;
    let power = exponent.to_i32().filter(|_| !large(&exponent)).ok_or(Wrong::Exponent)?;
    Ok(mantissa * Rational::from_integer(10.into()).pow(power))
}

/// An integer, or digits with a point.
fn decimal(text: &str) -> Option<Rational> {
    let Some((whole, digits)) = text.split_once('.') else {
        return integer(text).map(Rational::from);
    };
    let unsigned = whole.strip_prefix(['-', '+']).unwrap_or(whole);
    let mut all = unsigned.bytes().chain(digits.bytes()).peekable();
    if all.peek().is_none() || !all.all(|b| b.is_ascii_digit()) {
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
        for (text, num, den) in [
            ("5e-1", 1, 2),
            ("-1.25E+2", -125, 1),
            ("1e9", 1_000_000_000, 1),
            ("1.", 1, 1),
            ("0e400", 0, 1),
        ] {
            assert_eq!(parse(text).unwrap(), ratio(num, den), "{text}");
        }
        let huge = parse("1e400").unwrap() * parse("1e-400").unwrap();
        assert_eq!(huge, ratio(1, 1));
        for text in ["1e401", "1e-401", "0e99999999999999999999"] {
            assert_eq!(parse(text).unwrap_err().kind(), ErrorKind::ParameterOutOfRange, "{text}");
        }
        let long = "1".repeat(MOST_DIGITS + 1);
        for text in [
            "", ".", "1/0", "e9", "1e", "1e+", "1e 9", "1e1.5", "1/2e3", "a", "1/2/3", "--1",
            "1_0", "0.-1", "nan", &long,
        ] {
            assert_eq!(parse(text).unwrap_err().kind(), ErrorKind::InvalidText, "{text}");
        }
    }
}
