//! Where refinement goes: limits of vertices, and the surface itself.
//!
//! Around a feature a step repeats itself from the second on. Its rows form a small matrix, and
//! the left eigenvectors of that matrix are the weights of limit positions and tangents.
//!
//! | module | its one idea |
//! |---|---|
//! | `feature` | a place, and a mesh that shows it |
//! | `neighbourhood` | the same vertices around it before and after a step |
//! | `local` | the matrix between them |

mod feature;
mod local;
mod neighbourhood;

pub use feature::Feature;
pub use local::LocalMatrix;
#[cfg(feature = "analysis")]
pub(crate) use local::{Model, control_reach};
