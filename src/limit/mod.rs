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
//! | `weights` | its left eigenvectors |
//! | `rule` | a limit, and the way to the vertices that it is made of |
//! | `centres` | which rule holds where |
//! | `part` | a part of a mesh |
//! | `rows` | the limits of all vertices, whatever is near them |
//! | `limits` | positions, tangents, normals |
//! | `surface` | any point, between vertices too |
//! | `tessellate` | triangles within a tolerance of it |
//! | `search` | its point nearest to another, and where rays meet it |

mod centres;
mod feature;
mod limits;
mod local;
mod neighbourhood;
mod part;
mod rows;
mod rule;
mod search;
mod surface;
mod tessellate;
mod weights;

pub use feature::Feature;
pub use limits::Limits;
pub use local::LocalMatrix;
#[cfg(feature = "spectra")]
pub(crate) use local::{Model, control_reach};
pub use search::{Closest, Hit, Ray, Search};
pub use surface::{Derivatives, Sample, Surface, SurfaceWeight};
pub use tessellate::{Fineness, Screen, TessellateOptions, Tessellation, tessellate};
