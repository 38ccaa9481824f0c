//! The one table of tolerances. All are relative to the largest coordinate of
//! what is expected, unless the reason says otherwise.
//!
//! | name | value | oracle | reason |
//! |---|---|---|---|
//! | [`GOLDEN`] | 1e-12 | golden files, f64 | they are exact to double rounding |
//! | [`GOLDEN_SINGLE`] | 2e-6 | golden files, f32 | some ten roundings of 6e-8 per level |
//! | [`ROUNDING`] | 1e-13 | the same sums in another order | weights that sum to 1, few terms |
//! | [`STEEP`] | 1e-11 | the same, for passes beyond 1 | row norms reach hundreds, squared |
//! | [`ROW`] | 1e-15 | exact rows, absolute | one weight: some roundings of at most 1 |
//! | [`FOUR_DIGITS`] | 6e-5 | the specification, absolute | it gives four digits |

/// Coordinates against the golden files in f64.
pub const GOLDEN: f64 = 1e-12;
/// Coordinates against the golden files in f32.
pub const GOLDEN_SINGLE: f64 = 2e-6;
/// Two orders of summation of the same doubles.
pub const ROUNDING: f64 = 1e-13;
/// Two orders of summation where passes with |t| > 1 cancel.
pub const STEEP: f64 = 1e-11;
/// A weight in doubles against the exact one.
pub const ROW: f64 = 1e-15;
/// Eigenvalues that the specification gives to four digits.
pub const FOUR_DIGITS: f64 = 6e-5;
