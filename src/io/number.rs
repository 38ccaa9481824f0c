//! Numbers in text.

use super::place::{Place, quote};
use crate::base::{Error, ErrorKind, Result};

/// A finite number; anything else is an error at `place`.
#[inline]
pub(super) fn float(place: Place<'_>, word: &[u8]) -> Result<f64> {
    let parsed = std::str::from_utf8(word).ok().and_then(|text| text.parse::<f64>().ok());
    match parsed {
        Some(value) if value.is_finite() => Ok(value),
        other => Err(bad_float(place, word, other)),
    }
}

#[cold]
fn bad_float(place: Place<'_>, word: &[u8], parsed: Option<f64>) -> Error {
    match parsed {
        None => place.unexpected(word, "a number"),
        Some(_) if word.iter().any(u8::is_ascii_digit) => {
            place.error(ErrorKind::Overflow, format!("{} is too large for a double", quote(word)))
        }
        Some(_) => {
            place.error(ErrorKind::NotFinite, format!("{} is not a finite number", quote(word)))
        }
    }
}

/// An integer, saturated at the ends of the range; `None` if it is none.
#[inline]
pub(super) fn integer(word: &[u8]) -> Option<i64> {
    let (negative, digits) = match word {
        [b'-', rest @ ..] => (true, rest),
        [b'+', rest @ ..] | rest => (false, rest),
    };
    if digits.is_empty() {
        return None;
    }
    let mut value = 0_i64;
    for &digit in digits {
        let digit = digit.wrapping_sub(b'0');
        if digit > 9 {
            return None;
        }
        value = value.saturating_mul(10).saturating_add(i64::from(digit));
    }
    Some(if negative { -value } else { value })
}

/// A count of elements, as headers have it.
pub(super) fn count(place: Place<'_>, word: &[u8], what: &str) -> Result<u32> {
    match integer(word) {
        Some(n) if n >= 0 => match u32::try_from(n) {
            Ok(n) if n < u32::MAX => Ok(n),
            _ => Err(place.too_many(what)),
        },
        _ => Err(place.unexpected(word, &format!("the number of {what}"))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn kind(text: &str) -> ErrorKind {
        float(Place::line("t", 1), text.as_bytes()).unwrap_err().kind()
    }

    #[test]
    fn numbers_that_are_none() {
        for text in ["", "x", "1,5", "0x10", "1e", "--1", "1.#INF", "\u{663}"] {
            assert_eq!(kind(text), ErrorKind::Syntax, "{text}");
        }
        for text in ["nan", "NaN", "-nan", "inf", "-Infinity"] {
            assert_eq!(kind(text), ErrorKind::NotFinite, "{text}");
        }
        assert_eq!(kind("1e999"), ErrorKind::Overflow);
        assert_eq!(kind("-2e308"), ErrorKind::Overflow);
    }

    #[test]
    fn integers_saturate() {
        assert_eq!(integer(b"-12"), Some(-12));
        assert_eq!(integer(b"+7"), Some(7));
        assert_eq!(integer(b"99999999999999999999"), Some(i64::MAX));
        for text in ["", "-", "1.0", "1e3", "a"] {
            assert_eq!(integer(text.as_bytes()), None, "{text}");
        }
    }
}
