//! Colours: names and hexadecimal text, and the sRGB curve.

use carvel::{Error, ErrorKind, Result};

/// Reads `#rgb`, `#rrggbb` or `#rrggbbaa` (the `#` may be left out), `white`,
/// `black`, `grey`, `gray` or `transparent`, in any case.
///
/// # Errors
/// `InvalidText` for anything else.
pub fn parse_color(text: &str) -> Result<[u8; 4]> {
    let lower = text.trim().to_ascii_lowercase();
    let color = match lower.as_str() {
        "white" => Some([255; 4]),
        "black" => Some([0, 0, 0, 255]),
        "grey" | "gray" => Some([128, 128, 128, 255]),
        "transparent" => Some([0; 4]),
        hex => from_hex(hex.strip_prefix('#').unwrap_or(hex)),
    };
    color.ok_or_else(|| {
        Error::new(
            ErrorKind::InvalidText,
            format!("'{text}' is not a colour such as #a0b4cc, #a0b4ccff, white or transparent"),
        )
    })
}

fn from_hex(digits: &str) -> Option<[u8; 4]> {
    let nibbles: Vec<u8> =
        digits.chars().map(|c| c.to_digit(16).map(|d| d as u8)).collect::<Option<_>>()?;
    let byte = |i: usize| 16 * nibbles[i] + nibbles[i + 1];
    match nibbles[..] {
        [r, g, b] => Some([17 * r, 17 * g, 17 * b, 255]),
        [_, _, _, _, _, _] => Some([byte(0), byte(2), byte(4), 255]),
        [_, _, _, _, _, _, _, _] => Some([byte(0), byte(2), byte(4), byte(6)]),
        _ => None,
    }
}

/// The light of an sRGB byte, from 0 to 1.
pub fn to_linear(byte: u8) -> f32 {
    let c = f32::from(byte) / 255.0;
    if c <= 0.04045 { c / 12.92 } else { libm::powf((c + 0.055) / 1.055, 2.4) }
}

/// The sRGB curve as a table, from light to bytes.
///
/// 16384 steps: where the curve is steepest one step is a fifth of a byte.
pub struct Encoder(Vec<u8>);

impl Encoder {
    const STEPS: usize = 16384;

    /// Tabulates the curve.
    pub fn new() -> Self {
        let encode = |i: usize| {
            let light = i as f32 / Self::STEPS as f32;
            let c = if light <= 0.003_130_8 {
                12.92 * light
            } else {
                1.055 * libm::powf(light, 1.0 / 2.4) - 0.055
            };
            (255.0 * c + 0.5) as u8
        };
        Self((0..=Self::STEPS).map(encode).collect())
    }

    /// The byte of an amount of light; what lies outside [0, 1] is clamped.
    pub fn encode(&self, light: f32) -> u8 {
        self.0[(light.clamp(0.0, 1.0) * Self::STEPS as f32 + 0.5) as usize]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_names_and_hexadecimal() {
        for (text, color) in [
            ("#ff8000", [255, 128, 0, 255]),
            ("FF800040", [255, 128, 0, 64]),
            ("#18f", [17, 136, 255, 255]),
            (" White ", [255; 4]),
            ("black", [0, 0, 0, 255]),
            ("transparent", [0; 4]),
        ] {
            assert_eq!(parse_color(text).unwrap(), color, "{text}");
        }
    }

    #[test]
    fn refuses_what_is_no_color() {
        for text in
            ["", "#", "#12345", "#1234567", "red-ish", "##123456", "+12345", "é12345", "١٢٣"]
        {
            let err = parse_color(text).unwrap_err();
            assert_eq!(err.kind(), ErrorKind::InvalidText, "{text}");
        }
    }

    #[test]
    fn the_curve_gives_every_byte_back() {
        let encoder = Encoder::new();
        for byte in 0..=255 {
            assert_eq!(encoder.encode(to_linear(byte)), byte);
        }
        assert_eq!((encoder.encode(-1.0), encoder.encode(9.0)), (0, 255));
    }
}
