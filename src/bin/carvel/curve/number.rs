//! Coordinates as text.

use carvel::curve::{Coordinate, Rational, rational};

/// Why a field is no coordinate.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Wrong {
    /// No number at all.
    Text,
    /// Not finite, or too large for the number type.
    Value,
}

/// A coordinate that can be read and written.
pub trait Number: Coordinate {
    /// Reads one.
    fn read(text: &str) -> Result<Self, Wrong>;

    /// The shortest text that is read as the same number.
    fn text(&self) -> String;
}

/// Reads a double: a decimal, with or without an exponent, or a fraction.
fn double(text: &str) -> Result<f64, Wrong> {
    let fraction = || rational::parse(text).ok().map(|value| rational::to_f64(&value));
    let value = text.parse().ok().or_else(fraction).ok_or(Wrong::Text)?;
    if f64::is_finite(value) { Ok(value) } else { Err(Wrong::Value) }
}

impl Number for f64 {
    fn read(text: &str) -> Result<Self, Wrong> {
        double(text)
    }

    fn text(&self) -> String {
        ryu::Buffer::new().format_finite(*self).to_owned()
    }
}

impl Number for f32 {
    fn read(text: &str) -> Result<Self, Wrong> {
        let value = double(text)? as Self;
        if value.is_finite() { Ok(value) } else { Err(Wrong::Value) }
    }

    fn text(&self) -> String {
        ryu::Buffer::new().format_finite(*self).to_owned()
    }
}

impl Number for Rational {
    fn read(text: &str) -> Result<Self, Wrong> {
        /// Decimal exponents of doubles, and some more.
        const LARGEST: i32 = 400;
        let (mantissa, exponent) = text.split_once(['e', 'E']).unwrap_or((text, "0"));
        let number = rational::parse(mantissa.strip_suffix('.').unwrap_or(mantissa));
        let exponent = exponent.parse::<i32>().map_err(|_| Wrong::Text);
        match (number, exponent) {
            (Ok(number), Ok(exponent)) if exponent.abs() <= LARGEST => {
                Ok(number * Self::from_integer(10.into()).pow(exponent))
            }
            (Ok(_), Ok(_)) => Err(Wrong::Value),
            // No number, or an infinite one.
            _ => Err(double(text).err().unwrap_or(Wrong::Text)),
        }
    }

    fn text(&self) -> String {
        self.to_string()
    }
}
