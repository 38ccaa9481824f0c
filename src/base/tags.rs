//! Sharp features of a control mesh as plain data: what files carry and meshes take.

/// An edge that subdivision keeps sharp, by its two vertices in either order.
///
/// Sharpness counts refinement steps: each step takes 1 off, and the edge is smooth
/// where nothing is left. 10 and more never ends, as in OpenSubdiv.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Crease {
    /// The edge's ends.
    pub vertices: [u32; 2],
    /// Not negative; 0 is smooth.
    pub sharpness: f32,
}

/// A vertex that subdivision keeps sharp; sharpness as of a [`Crease`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SharpVertex {
    /// The vertex.
    pub vertex: u32,
    /// Not negative; 0 is smooth.
    pub sharpness: f32,
}
