//! Curves: subdivision of polygons and grids by exact masks of any arity.
//!
//! ```
//! use carvel::Context;
//! use carvel::curve::{Ends, Polygon, catalogue};
//! let mask = catalogue::mask("three-point:1/32")?;
//! let square = Polygon::new(vec![0.0, 0.0, 1.0, 0.0, 1.0, 1.0, 0.0, 1.0], 2, Ends::Closed);
//! let curve = square.refine(&Context::serial(), &mask, 5)?;
//! assert_eq!(curve.len(), 4 * 32);
//! # Ok::<(), carvel::Error>(())
//! ```
//!
//! A [`Mask`] is exact; points are `f32`, `f64` or [`Rational`]s. How smooth the limit is, is for
//! `analysis` to say. Surfaces of arbitrary topology are no business of this module: what a mask
//! means on meshes, if anything, [`Factors`] tells.

pub mod catalogue;
mod coordinate;
mod ends;
mod factor;
mod grid;
mod lattice;
mod laurent;
mod limit;
mod linear;
mod mask;
mod non_uniform;
pub mod rational;
mod refine;
mod roots;
mod rules;
mod scheme;
mod step;
mod tension;

pub use coordinate::Coordinate;
pub use ends::Ends;
pub use factor::{CurveSplit, Factors};
pub use grid::{Grid, GridMask};
pub use laurent::Laurent;
pub use limit::{LimitStencil, limit_stencil, sample_derivative, sample_limit};
pub use mask::{LARGEST_ARITY, MOST_COEFFICIENTS, Mask, Parametrisation, Tap};
pub use rational::Rational;
pub use refine::Polygon;
pub use scheme::CurveScheme;
pub use tension::Tension;
