//! How large the children of a split are, without building them.

use super::Anchor;
use crate::base::{Error, ErrorKind, NONE, Result};
use crate::mesh::Mesh;

/// The size of a mesh at some level; see [`Counts::of`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub struct Counts {
    /// Vertices, isolated ones included.
    pub vertices: u64,
    /// Faces.
    pub faces: u64,
    /// Corners: the sum of the face sizes.
    pub corners: u64,
    /// Edges.
    pub edges: u64,
    /// Edges with one face only.
    pub boundary_edges: u64,
    /// Faces that are not regular (quads, or triangles if there is nothing else).
    pub irregular_faces: u64,
    /// Corners of those faces.
    pub irregular_corners: u64,
    isolated: u64,
    /// Corners at boundary vertices.
    rim_corners: u64,
    /// Interior vertices of valence 2 and 3.
    valence_two: u64,
    valence_three: u64,
    /// Interior vertices of other valences than 2, 3 and 4, and their corners:
    /// only a control mesh has them.
    other_vertices: u64,
    other_corners: u64,
    /// All faces are triangles: none of them stays regular.
    triangles: bool,
}

impl Counts {
    /// The sizes of a mesh without what only corner splits ask for.
    pub(crate) fn sizes_of(mesh: &Mesh) -> Self {
        Self {
            vertices: mesh.vertices() as u64,
            faces: mesh.faces() as u64,
            corners: mesh.corners() as u64,
            edges: mesh.edges() as u64,
            boundary_edges: mesh.boundary_edges() as u64,
            irregular_faces: mesh.irregular_faces() as u64,
            irregular_corners: u64::from(mesh.layout.irregular_corners()),
            isolated: 0,
            rim_corners: 0,
            valence_two: 0,
            valence_three: 0,
            other_vertices: 0,
            other_corners: 0,
            triangles: mesh.layout.side() == 3,
        }
    }

    /// The counts of a mesh.
    pub fn of(mesh: &Mesh) -> Self {
        let mut counts = Self::sizes_of(mesh);
        for &v in &mesh.special {
            let valence = mesh.fan(v).count() as u64;
            match valence {
                0 => counts.isolated += 1,
                _ if mesh.on_rim(v) => counts.rim_corners += valence,
                2 => counts.valence_two += 1,
                3 => counts.valence_three += 1,
                _ => {
                    counts.other_vertices += 1;
                    counts.other_corners += valence;
                }
            }
        }
        counts
    }

    /// The counts after a plain corner split; `None` past 64 bits.
    pub(crate) fn plain(&self) -> Option<Self> {
        let boundary = self.boundary_edges;
        let interior_corners = self.corners - self.rim_corners;
        let vertex_faces = self.vertices - self.isolated - boundary - self.valence_two;
        let children = Sizes {
            vertices: self.corners.checked_add(self.isolated)?,
            faces: self.faces.checked_add(self.edges - boundary)?.checked_add(vertex_faces)?,
            corners: self
                .corners
                .checked_mul(3)?
                .checked_sub(2 * boundary)?
                .checked_add(interior_corners - 2 * self.valence_two)?,
            boundary_edges: self.rim_corners,
            rim_corners: 3 * self.rim_corners - 2 * boundary,
        };
        Some(self.child(&children, (0, 0)))
    }

    /// The counts after the split of a mesh that is not anchored, laying the
    /// anchor row; `irregular` gives the number and the corners of the boundary
    /// vertex faces that are not quads.
    pub(crate) fn anchoring(&self, kappas: u64, irregular: (u64, u64)) -> Option<Self> {
        let boundary = self.boundary_edges;
        let children = Sizes {
            vertices: self.corners.checked_add(self.isolated + 2 * boundary + kappas)?,
            faces: self
                .faces
                .checked_add(self.edges)?
                .checked_add(self.vertices - self.isolated - self.valence_two)?,
            corners: self
                .corners
                .checked_mul(2)?
                .checked_add(4 * self.edges)?
                .checked_add(2 * boundary + kappas)?
                - 2 * self.valence_two,
            boundary_edges: 2 * boundary + kappas,
            rim_corners: 4 * boundary + kappas,
        };
        Some(self.child(&children, irregular))
    }

    /// The counts after a quad split; `None` past 64 bits.
    pub(crate) fn quads(&self) -> Option<Self> {
        let edges = self.edges.checked_mul(2)?.checked_add(self.corners)?;
        let vertices = self.vertices.checked_add(self.edges)?.checked_add(self.faces)?;
        self.primal_child(vertices, edges, self.corners, 4)
    }

    /// The counts after a triangle split; `None` past 64 bits.
    pub(crate) fn triangles(&self) -> Option<Self> {
        let edges = self.edges.checked_mul(2)?.checked_add(self.corners)?;
        let vertices = self.vertices.checked_add(self.edges)?;
        self.primal_child(vertices, edges, self.faces.checked_mul(4)?, 3)
    }

    /// Valences, which primal splits do not ask for, are not followed.
    fn primal_child(&self, vertices: u64, edges: u64, faces: u64, side: u64) -> Option<Self> {
        Some(Self {
            vertices,
            edges,
            faces,
            corners: faces.checked_mul(side)?,
            boundary_edges: 2 * self.boundary_edges,
            irregular_faces: 0,
            irregular_corners: 0,
            isolated: self.isolated,
            rim_corners: 0,
            valence_two: 0,
            valence_three: 0,
            other_vertices: 0,
            other_corners: 0,
            triangles: side == 3,
        })
    }

    fn child(&self, sizes: &Sizes, irregular: (u64, u64)) -> Self {
        let (faces, corners) = if self.triangles {
            (self.faces, self.corners)
        } else {
            (self.irregular_faces, self.irregular_corners)
        };
        Self {
            vertices: sizes.vertices,
            faces: sizes.faces,
            corners: sizes.corners,
            edges: u64::midpoint(sizes.corners, sizes.boundary_edges),
            boundary_edges: sizes.boundary_edges,
            irregular_faces: faces + self.valence_three + self.other_vertices + irregular.0,
            irregular_corners: corners + 3 * self.valence_three + self.other_corners + irregular.1,
            isolated: self.isolated,
            rim_corners: sizes.rim_corners,
            valence_two: 0,
            valence_three: 2 * self.valence_two,
            other_vertices: 0,
            other_corners: 0,
            triangles: false,
        }
    }

    /// True if every vertex has four faces around it, is isolated or lies on a boundary.
    pub(crate) fn has_regular_vertices(&self) -> bool {
        self.valence_two + self.valence_three + self.other_vertices == 0
    }

    /// True if all faces are triangles.
    pub(crate) fn has_triangles(&self) -> bool {
        self.triangles
    }

    /// Corners of faces that are no quads, whose split points a pass stores.
    pub(crate) fn stored_corners(&self) -> u64 {
        if self.triangles { self.corners } else { self.irregular_corners }
    }

    /// Refuses what does not fit 32-bit indices.
    ///
    /// # Errors
    /// [`ErrorKind::TooLarge`] with the sizes.
    pub fn check_index_type(&self) -> Result<()> {
        let limit = u64::from(NONE);
        if self.vertices < limit && self.corners < limit && self.edges < limit {
            return Ok(());
        }
        Err(Error::new(
            ErrorKind::TooLarge,
            format!("{} faces with {} corners do not fit 32-bit indices", self.faces, self.corners),
        ))
    }
}

struct Sizes {
    vertices: u64,
    faces: u64,
    corners: u64,
    boundary_edges: u64,
    rim_corners: u64,
}

/// The number and the corners of the boundary vertex faces of an anchoring step
/// that are not quads; part of what [`Counts::anchoring`] needs.
pub(crate) fn irregular_rim_faces(mesh: &Mesh, anchor: &Anchor) -> (u64, u64) {
    let boundary = mesh.special.iter().copied().filter(|&v| mesh.on_rim(v));
    let sizes = boundary.map(|v| anchor.rim_face_size(mesh, v));
    sizes.filter(|&size| size != 4).fold((0, 0), |(n, sum), size| (n + 1, sum + u64::from(size)))
}
