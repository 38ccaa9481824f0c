//! OpenSubdiv, OpenMesh and CGAL beside carvel.
//!
//! Each library is a [`Peer`]: a control mesh goes in as flat arrays, is refined by the
//! library's ordinary call, and comes out as flat arrays. [`normalise`] lists what two
//! libraries may legitimately answer differently; everything else must agree.

#[expect(unused_qualifications, reason = "cxx writes paths out")]
mod bridge;
mod cgal;
mod control;
pub mod heap;
pub mod lineage;
pub mod normalise;
mod openmesh;
mod opensubdiv;
pub mod ours;
mod peer;
mod run;
pub mod shapes;
mod stencils;
mod surface;

pub use cgal::Cgal;
pub use control::{Boundary, Creasing, FaceVarying, Triangles};
pub use control::{Channel, Control, Crease, Options, SharpVertex};
pub use normalise::Comparison;
pub use openmesh::OpenMesh;
pub use opensubdiv::{Level, OpenSubdiv, Refinement, Values, VertexLimits};
pub use peer::{PEERS, Peer, PeerMesh, Precision, Result, Scheme, Task};
pub use run::Run;
pub use stencils::Stencils;
pub use surface::{Patches, Place};
