//! Points that several faces, or sectors of one, have in common, by one name from all sides.

use super::cell::{Point, Root, Shape, UNIT};
use crate::mesh::Mesh;

/// A point on the border of a face or sector.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Shared {
    /// A vertex of the control mesh.
    Vertex(u32),
    /// On the edge of a corner, the smaller of its two: so far from the corner's vertex, of 2 ·
    /// [`UNIT`].
    Edge(u32, i32),
    /// Between the sector of a corner and the next: so far from the middle of the edge between.
    Spoke(u32, i32),
    /// The middle of the face that begins at a corner.
    Middle(u32),
}

impl Shared {
    /// The name of a point; none inside.
    pub(super) fn of(mesh: &Mesh, root: &Root, [u, v]: Point) -> Option<Self> {
        let c = root.corner;
        match root.shape {
            Shape::Quad | Shape::Triangle if v == 0 => Some(on_edge(mesh, c, 2 * u)),
            Shape::Quad if u == UNIT => Some(on_edge(mesh, mesh.next(c), 2 * v)),
            Shape::Quad if v == UNIT => {
                Some(on_edge(mesh, mesh.next(mesh.next(c)), 2 * (UNIT - u)))
            }
            Shape::Triangle if u + v == UNIT => Some(on_edge(mesh, mesh.next(c), 2 * v)),
            Shape::Quad | Shape::Triangle if u == 0 => {
                Some(on_edge(mesh, mesh.prev(c), 2 * (UNIT - v)))
            }
            Shape::Sector if v == 0 => Some(on_edge(mesh, c, u)),
            Shape::Sector if u == 0 => Some(on_edge(mesh, mesh.prev(c), 2 * UNIT - v)),
            Shape::Sector if u == UNIT && v == UNIT => {
                Some(Self::Middle(mesh.layout.face_around(c).start))
            }
            Shape::Sector if u == UNIT => Some(Self::Spoke(c, v)),
            Shape::Sector if v == UNIT => Some(Self::Spoke(mesh.prev(c), u)),
            Shape::Quad | Shape::Triangle | Shape::Sector => None,
        }
    }

    /// True on the edges of the control mesh.
    pub(super) fn is_on_edge(self) -> bool {
        matches!(self, Self::Vertex(_) | Self::Edge(..))
    }
}

/// So far along the outgoing edge of a corner.
fn on_edge(mesh: &Mesh, corner: u32, t: i32) -> Shared {
    let first = mesh.first_of_edge(corner);
    match t {
        0 => Shared::Vertex(mesh.vert[corner as usize]),
        _ if t == 2 * UNIT => Shared::Vertex(mesh.vert[mesh.next(corner) as usize]),
        _ if first == corner => Shared::Edge(first, t),
        _ => Shared::Edge(first, 2 * UNIT - t),
    }
}
