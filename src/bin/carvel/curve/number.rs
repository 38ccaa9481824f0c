//! Coordinates as text.

use carvel::ErrorKind;
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
        rational::parse(text).map_err(|e| match e.kind() {
            ErrorKind::ParameterOutOfRange => Wrong::Value,
            // No number, or an infinite one.
            _ => double(text).err().unwrap_or(Wrong::Text),
        })
    }

    fn text(&self) -> String {
        self.to_string()
    }
}
