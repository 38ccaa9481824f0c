//! Catmull–Clark, Loop and bilinear against OpenSubdiv, by the parents of its vertices:
//! the same faces, the same holes, positions within rounding, in both precisions.
//! Beside them the limits of vertices, and the surface between them.
//!
//! What differs by design is listed in `carvel_peers::normalise`; nothing else may.

mod against;
mod creases;
mod face_varying;
mod features;
mod limits;
mod meshes;
mod surface;
mod values;
