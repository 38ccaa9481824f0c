//! How good schemes are.
//!
//! | module | its one idea |
//! |---|---|
//! | `surface` | surfaces around extraordinary points, by their eigenvalues |

pub mod surface;
