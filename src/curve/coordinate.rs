//! The numbers that points are made of: `f32`, `f64` and exact rationals.

use std::fmt::Debug;

use num_traits::Zero;

use super::rational::{self, Rational};
use crate::base::{Result, memory};

/// A coordinate of a point.
pub trait Coordinate: Clone + Debug + PartialEq + Send + Sync + 'static {
    /// The bytes of one, without what a rational keeps elsewhere.
    const BYTES: u64 = size_of::<Self>() as u64;

    /// The nearest number to an exact one.
    fn from_rational(value: &Rational) -> Self;

    /// The nearest number to a double.
    fn from_f64(value: f64) -> Self;

    /// The nearest double.
    fn to_f64(&self) -> f64;

    /// Adds `weight · x`, product and sum rounded one after the other.
    fn add_product(&mut self, weight: &Self, x: &Self);

    /// `weight · x`.
    fn product(weight: &Self, x: &Self) -> Self;

    /// The point image of `x` in `centre`: 2·centre − x.
    fn mirrored(centre: &Self, x: &Self) -> Self;

    /// True unless NaN or infinite.
    fn is_finite(&self) -> bool;

    /// The largest finite number as a double; infinite where there is none.
    fn largest() -> f64;

    /// An array of zeros.
    ///
    /// # Errors
    /// [`crate::ErrorKind::OutOfResources`] if the system refuses the memory.
    fn zeros(len: usize) -> Result<Vec<Self>>;
}

macro_rules! floats {
    ($($type:ident),*) => {$(
        impl Coordinate for $type {
            fn from_rational(value: &Rational) -> Self {
                Self::from_f64(rational::to_f64(value))
            }

            fn from_f64(value: f64) -> Self {
                value as $type
            }

            fn to_f64(&self) -> f64 {
                f64::from(*self)
            }

            #[inline(always)]
            fn add_product(&mut self, weight: &Self, x: &Self) {
                *self += weight * x;
            }

            #[inline(always)]
            fn product(weight: &Self, x: &Self) -> Self {
                weight * x
            }

            fn mirrored(centre: &Self, x: &Self) -> Self {
                2.0 * centre - x
            }

            #[inline(always)]
            fn is_finite(&self) -> bool {
                $type::is_finite(*self)
            }

            fn largest() -> f64 {
                f64::from($type::MAX)
            }

            fn zeros(len: usize) -> Result<Vec<Self>> {
                memory::zeroed(len)
            }
        }
    )*};
}

floats!(f32, f64);

/// Exact; the memory of long numerators and denominators comes from the global allocator.
impl Coordinate for Rational {
    fn from_rational(value: &Rational) -> Self {
        value.clone()
    }

    /// Exact; NaN and infinities become 0.
    fn from_f64(value: f64) -> Self {
        rational::from_f64(value).unwrap_or_else(Self::zero)
    }

    fn to_f64(&self) -> f64 {
        rational::to_f64(self)
    }

    fn add_product(&mut self, weight: &Self, x: &Self) {
        *self += weight * x;
    }

    fn product(weight: &Self, x: &Self) -> Self {
        weight * x
    }

    fn mirrored(centre: &Self, x: &Self) -> Self {
        centre + centre - x
    }

    fn is_finite(&self) -> bool {
        true
    }

    fn largest() -> f64 {
        f64::INFINITY
    }

    fn zeros(len: usize) -> Result<Vec<Self>> {
        let mut list = memory::reserved(len)?;
        list.resize(len, Self::zero());
        Ok(list)
    }
}
