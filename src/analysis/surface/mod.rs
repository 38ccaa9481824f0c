//! The surface around extraordinary points.
//!
//! Around a feature a step repeats itself from the second on; its rows form a small matrix
//! whose eigenvalues and eigenvectors say where the surface goes and how smooth it is
//! (Doo and Sabin 1978; Reif 1995; Peters and Reif, *Subdivision Surfaces*, 2008). Rows are the
//! scheme's own. Eigenvalues are computed in double precision, and not to the same last bit on
//! every processor.
//!
//! ```
//! use carvel::Scheme;
//! use carvel::analysis::surface::{Curvature, Feature, LocalMatrix, Smoothness, Spectrum};
//! let scheme = Scheme::catmull_clark();
//! let matrix = LocalMatrix::new(&scheme, Feature::Interior { valence: 5 })?;
//! let spectrum = Spectrum::new(&matrix)?;
//! assert!((spectrum.lambda() - 0.549988).abs() < 1e-6);
//! let verdict = Smoothness::new(&scheme, &spectrum)?;
//! assert_eq!(verdict.curvature, Some(Curvature::Unbounded));
//! # Ok::<(), carvel::Error>(())
//! ```
//!
//! | module | its one idea |
//! |---|---|
//! | `spectrum` | its eigenvalues, mode by mode |
//! | `weights` | limits and tangents: left eigenvectors |
//! | `characteristic` | the map of right eigenvectors, sampled |
//! | `smoothness` | the verdict |
//! | `cups` | curvature, step by step |

mod characteristic;
mod cups;
mod smoothness;
mod spectrum;
mod weights;

pub use characteristic::CharacteristicMap;
pub use cups::CupsAndSaddles;
pub use smoothness::{Curvature, Smoothness, Tangent};
pub use spectrum::{Eigenvalue, Spectrum};
pub use weights::{LimitWeights, VertexWeights};

pub use crate::limit::{Feature, LocalMatrix};
