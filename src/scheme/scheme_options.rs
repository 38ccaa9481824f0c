//! What can be chosen about a scheme beside its weights.

/// What happens along a boundary, in OpenSubdiv's vocabulary.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
#[non_exhaustive]
pub enum Boundary {
    /// Dual schemes add no points, so that the surface ends half a cell inside;
    /// Catmull–Clark and Loop make holes of all faces at the boundary.
    None,
    /// The boundary curve is the univariate curve of the boundary polygon;
    /// tagged corners are interpolated.
    Edge,
    /// Also interpolates the boundary vertices with a single face.
    #[default]
    EdgeAndCorner,
}

/// What Catmull–Clark does with the triangles of a control mesh.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
#[non_exhaustive]
pub enum TriangleRule {
    /// The same as with other faces.
    #[default]
    CatmullClark,
    /// Other weights for edges beside triangles, found by optimisation
    /// (Stam and Loop 2003 in spirit; OpenSubdiv's `TRI_SUB_SMOOTH`).
    Smooth,
}

/// What the paper's three-point scheme does around faces that are no quads.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
#[non_exhaustive]
pub enum Extraordinary {
    /// Split and pass, as everywhere.
    #[default]
    Default,
    /// Stencils that keep the curvature in the middle of such a face bounded and away from
    /// zero; see [`Scheme::with_extraordinary`](crate::Scheme::with_extraordinary).
    Tuned,
}

/// The weights of Loop's scheme at extraordinary vertices.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
#[non_exhaustive]
pub enum LoopWeights {
    /// Loop's own: β = (5/8 − (3/8 + cos(2π/n)/4)²)/n.
    #[default]
    Loop,
    /// Warren's: β = 3/(8n), 3/16 at n = 3.
    Warren,
}
