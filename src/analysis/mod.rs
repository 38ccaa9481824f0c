//! How good schemes are.
//!
//! | module | its one idea |
//! |---|---|
//! | `mask` | curves and grids, exactly, from the mask alone |
//! | `surface` | surfaces around extraordinary points, by their eigenvalues |

pub mod mask;
#[cfg(feature = "spectra")]
pub mod surface;
