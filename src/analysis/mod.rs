//! How good a scheme is: the surface around extraordinary points.
//!
//! Around a feature a step repeats itself from the second on; its rows form a small matrix
//! whose eigenvalues and eigenvectors say where the surface goes and how smooth it is
//! (Doo and Sabin 1978; Reif 1995; Peters and Reif, *Subdivision Surfaces*, 2008).

mod characteristic;
mod feature;
mod local;
mod neighbourhood;
mod smoothness;
mod spectrum;
mod weights;

pub use characteristic::CharacteristicMap;
pub use feature::Feature;
pub use local::LocalMatrix;
pub use smoothness::{Curvature, Smoothness, Tangent};
pub use spectrum::{Eigenvalue, Spectrum};
pub use weights::{LimitWeights, VertexWeights};
