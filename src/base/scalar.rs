//! Number types: what coordinates are stored in, what weights are computed in.

use super::Fraction;
use std::fmt::Debug;
use std::ops::{Add, Mul, Sub};

/// A number in which a scheme's weights can be computed.
///
/// `f64` in production; tests use big rationals, which is why a weight is made
/// of the four operations below and nothing else. Cosines come from `libm`, so
/// that they are the same on every platform.
pub trait Weight:
    Clone + Debug + PartialEq + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self>
{
    /// The weight `num / den`.
    fn ratio(num: i64, den: i64) -> Self;

    /// cos(2π·j/n). Exact types support the rational cases only (n = 1, 2, 3, 4, 6).
    fn cos_turn(j: usize, n: usize) -> Self;

    /// The weight of a sharpness, which is a number in single precision from 0 to 10.
    /// Exact types may round to a multiple of 2⁻⁴⁰.
    fn from_sharpness(sharpness: f32) -> Self {
        const STEPS: i64 = 1 << 40;
        Self::ratio((f64::from(sharpness) * STEPS as f64).round() as i64, STEPS)
    }

    /// The weight of an exact parameter.
    fn from_fraction(f: Fraction) -> Self {
        Self::ratio(f.numerator(), f.denominator())
    }
}

impl Weight for f64 {
    fn ratio(num: i64, den: i64) -> Self {
        num as f64 / den as f64
    }

    fn from_sharpness(sharpness: f32) -> Self {
        f64::from(sharpness)
    }

    fn cos_turn(j: usize, n: usize) -> Self {
        // The multiples of a right angle and of 60 degrees are exact, as they
        // are in rational arithmetic.
        let j = j % n;
        match (12 * j).checked_rem(n) {
            Some(0) if (12 * j / n).is_multiple_of(2) || (12 * j / n).is_multiple_of(3) => {
                [1.0, 0.0, 0.5, 0.0, -0.5, 0.0, -1.0, 0.0, -0.5, 0.0, 0.5, 0.0][12 * j / n]
            }
            _ => libm::cos(std::f64::consts::TAU * j as f64 / n as f64),
        }
    }
}

/// What can be added up and compared, a number or several side by side.
pub trait Summand: Copy + Add<Output = Self> {
    /// The larger one, for each lane.
    #[must_use]
    fn larger(self, other: Self) -> Self;
}

macro_rules! summands {
    ($($type:ty),*) => {$(
        impl Summand for $type {
            #[inline(always)]
            fn larger(self, other: Self) -> Self {
                self.max(other)
            }
        }
    )*};
}

summands!(f32, f64, glam::Vec4, glam::DVec4);

/// A number in which coordinates are stored: `f32` or `f64`.
pub trait Scalar:
    Summand
    + Default
    + Debug
    + PartialEq
    + Send
    + Sync
    + 'static
    + bytemuck::Zeroable
    + Sub<Output = Self>
    + Mul<Output = Self>
{
    /// Four values side by side, in vector registers where the processor has
    /// them. Multiplications and additions stay separate, so that every
    /// processor gives the same bits.
    type Lanes: Summand + Mul<Self, Output = Self::Lanes> + Send + Sync;

    /// Size in bytes.
    const BYTES: u64;

    /// Puts four values side by side.
    fn lanes(values: [Self; 4]) -> Self::Lanes;

    /// Takes them apart again.
    fn unlaned(lanes: Self::Lanes) -> [Self; 4];

    /// The nearest value; overflows to infinity.
    fn from_f64(value: f64) -> Self;

    /// The same value as a double.
    fn to_f64(self) -> f64;

    /// True unless NaN or infinite.
    fn is_finite(self) -> bool;
}

impl Scalar for f32 {
    type Lanes = glam::Vec4;

    const BYTES: u64 = 4;

    #[inline(always)]
    fn lanes(values: [Self; 4]) -> Self::Lanes {
        glam::Vec4::from_array(values)
    }

    #[inline(always)]
    fn unlaned(lanes: Self::Lanes) -> [Self; 4] {
        lanes.to_array()
    }

    #[inline(always)]
    fn from_f64(value: f64) -> Self {
        value as f32
    }

    fn to_f64(self) -> f64 {
        f64::from(self)
    }

    fn is_finite(self) -> bool {
        self.is_finite()
    }
}

impl Scalar for f64 {
    type Lanes = glam::DVec4;

    const BYTES: u64 = 8;

    #[inline(always)]
    fn lanes(values: [Self; 4]) -> Self::Lanes {
        glam::DVec4::from_array(values)
    }

    #[inline(always)]
    fn unlaned(lanes: Self::Lanes) -> [Self; 4] {
        lanes.to_array()
    }

    #[inline(always)]
    fn from_f64(value: f64) -> Self {
        value
    }

    fn to_f64(self) -> f64 {
        self
    }

    fn is_finite(self) -> bool {
        self.is_finite()
    }
}
