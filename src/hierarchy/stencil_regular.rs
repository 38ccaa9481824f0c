//! Rows of vertices inside regular quads, which are the same for all of them.
//!
//! What a quad split makes inside a quad whose four vertices are interior, of valence four
//! and smooth depends on the sixteen vertices around it alone. Those rows are made once,
//! on a small regular mesh and by the same rows as all others, and copied for each such
//! quad. A child face is a parent corner, so the place of a refined face in its control
//! face can be read off its number.

use super::stencils::StencilTask;
use super::{Hierarchy, Interpolation};
use crate::base::{Context, Error, ErrorKind, NONE, Result, Scalar, memory};
use crate::mesh::{Mesh, VertexSet};
use crate::refine::{EdgeNumbers, Pieces, PrimalChild, PrimalSplit};
use crate::scheme::Scheme;
use crate::sparse::StencilTable;

/// Regular faces from which on the patterns are worth making.
const FEWEST: usize = 16;
/// Steps up to which they are few.
const DEEPEST: u32 = 6;
/// The middle of a face, its four edges, its four vertices.
const KINDS: u32 = 9;
/// Quads along a side of the regular mesh: more than any two rows have in common.
const SIDE: u32 = 8;

/// The vertices of a regular quad and of the quads around it.
type Ring = [u32; 16];

/// Where the rows of a task can be copied from.
pub(super) struct Regular<'a> {
    base: &'a Mesh,
    parent: &'a Mesh,
    split: &'a PrimalSplit<'a>,
    depth: u32,
    /// By face of the base mesh; the first is `NONE` where it is not regular.
    rings: Vec<Ring>,
    /// Entries by pattern: places in a ring, and weights.
    patterns: StencilTable<f64>,
}

impl<'a> Regular<'a> {
    /// The patterns of a task; nothing where they are not worth it. The decision does not
    /// depend on which vertices are asked for, so that neither do the rows.
    pub(super) fn new(
        context: &Context,
        hierarchy: &'a Hierarchy,
        task: &StencilTask,
        split: &'a PrimalSplit<'a>,
    ) -> Result<Option<Self>> {
        let (base, scheme) = (hierarchy.mesh(task.from), hierarchy.scheme());
        let depth = task.to - task.from;
        let quads = split.pieces() == Pieces::Quads && base.layout.side() == 4;
        if !quads || !scheme.passes().is_empty() || depth > DEEPEST {
            return Ok(None);
        }
        let rings = rings(scheme, base)?;
        if rings.iter().filter(|ring| ring[0] != NONE).count() < FEWEST {
            return Ok(None);
        }
        let patterns = patterns(context, scheme, task.interpolation, depth)?;
        Ok(Some(Self { base, parent: split.parent(), split, depth, rings, patterns }))
    }

    /// The ring and the pattern of a vertex, if it lies in a regular face.
    #[inline]
    pub(super) fn find(&self, vertex: u32) -> Option<(&Ring, usize)> {
        let (face, kind) = match self.split.child(vertex) {
            PrimalChild::Face(face) => (face, 0),
            PrimalChild::Edge(edge) => {
                let (face, place) = self.place(self.split.edges.first[edge as usize]);
                (face, 1 + place)
            }
            PrimalChild::Vertex(v) => {
                let start = self.parent.start[v as usize];
                if start == NONE {
                    return None;
                }
                let (face, place) = self.place(start);
                (face, 5 + place)
            }
        };
        let (base, inner) = origin(self.base, self.depth, face);
        let ring = &self.rings[base as usize];
        (ring[0] != NONE).then_some((ring, (inner * KINDS + kind) as usize))
    }

    /// The face of a corner of the parent, and its place there.
    fn place(&self, corner: u32) -> (u32, u32) {
        let face = self.parent.layout.face_of(corner);
        (face, corner - self.parent.layout.face(face).start)
    }

    /// The columns and weights of a pattern on a ring.
    #[inline]
    pub(super) fn row<'r, T: Scalar>(
        &'r self,
        (ring, pattern): (&'r Ring, usize),
    ) -> (impl ExactSizeIterator<Item = u32> + 'r, impl ExactSizeIterator<Item = T> + 'r) {
        let (places, weights) = self.patterns.row(pattern);
        let columns = places.iter().map(|&place| ring[place as usize % ring.len()]);
        (columns, weights.iter().map(|&weight| T::from_f64(weight)))
    }
}

/// The base face that a face of the parent lies in, and its number inside: refined faces
/// count through the corners of their parents.
fn origin(base: &Mesh, depth: u32, face: u32) -> (u32, u32) {
    if depth == 1 {
        return (face, 0);
    }
    let shift = 2 * (depth - 2);
    let corner = face >> shift;
    let origin = base.layout.face_of(corner);
    (origin, face - (base.layout.face(origin).start << shift))
}

/// The rings of all faces of a mesh.
fn rings(scheme: &Scheme, mesh: &Mesh) -> Result<Vec<Ring>> {
    let mut ruled = memory::collect(scheme.ruled_vertices(mesh))?;
    ruled.sort_unstable();
    ruled.dedup();
    let ruled = VertexSet::new(mesh.vertices(), &ruled)?;
    let faces = 0..mesh.faces() as u32;
    memory::collect(faces.map(|face| ring(mesh, &ruled, face).unwrap_or([NONE; 16])))
}

/// The ring of a face: its vertices, the two beyond each of its edges, the one beyond
/// each of its corners. Nothing if it is not regular or a vertex comes twice.
fn ring(mesh: &Mesh, ruled: &VertexSet, face: u32) -> Option<Ring> {
    let first = mesh.layout.first_quad_corner();
    let corners = mesh.layout.face(face);
    if corners.start < first {
        return None;
    }
    let mut ring = [NONE; 16];
    for (k, corner) in corners.enumerate() {
        let v = mesh.vert[corner as usize];
        if ruled.contains(v) || mesh.special_set.contains(v) {
            return None;
        }
        let across = mesh.twin[corner as usize];
        let spoke = mesh.next(across);
        let beyond = mesh.twin[spoke as usize];
        if [across, beyond].iter().any(|&c| c == NONE || c < first) {
            return None;
        }
        let vert = |c: u32| mesh.vert[c as usize];
        (ring[k], ring[12 + k]) = (v, vert(mesh.prev(beyond)));
        (ring[4 + 2 * k], ring[5 + 2 * k]) = (vert(mesh.next(spoke)), vert(mesh.prev(across)));
    }
    let mut sorted = ring;
    sorted.sort_unstable();
    sorted.is_sorted_by(|a, b| a < b).then_some(ring)
}

/// The rows inside a face of a regular mesh, by places in its ring.
fn patterns(
    context: &Context,
    scheme: &Scheme,
    interpolation: Interpolation,
    depth: u32,
) -> Result<StencilTable<f64>> {
    let serial = Context::serial();
    let hierarchy = Hierarchy::new(&serial, torus()?, scheme.clone(), depth - 1)?;
    let (base, parent) = (hierarchy.mesh(0), hierarchy.mesh(depth - 1));
    let split = hierarchy.split(&serial, depth - 1, &mut EdgeNumbers::default())?;
    let Some(split) = split.primal().next() else {
        return Err(Error::new(ErrorKind::BrokenInvariant, "a split without edges"));
    };
    let mut vertices = Vec::new();
    for face in (0..parent.faces() as u32).filter(|&face| origin(base, depth, face).0 == 0) {
        let corners = 4 * face..4 * face + 4;
        vertices.push(split.face_vertex(face));
        vertices.extend(corners.clone().map(|c| split.edge_vertex(c)));
        vertices.extend(corners.map(|c| parent.vert[c as usize]));
    }
    let task = StencilTask { from: 0, to: depth, interpolation, vertices: Some(&vertices) };
    let table: StencilTable<f64> = hierarchy.rows_by_stages(context, &task)?;
    let ring = rings(scheme, base)?[0];
    let mut places = vec![0; base.vertices()];
    for (place, &v) in ring.iter().enumerate() {
        places[v as usize] = place as u32;
    }
    let offsets: Vec<u64> = table.offsets().iter().map(|&at| u64::from(at)).collect();
    let indices = table.indices().iter().map(|&i| places[i as usize]).collect();
    StencilTable::new(16, &offsets, indices, table.weights().to_vec())
}

/// A regular mesh of quads, closed.
fn torus() -> Result<Mesh> {
    let at = |i: u32, j: u32| (i % SIDE) * SIDE + j % SIDE;
    let quad = |n: u32| {
        let (i, j) = (n / SIDE, n % SIDE);
        [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]
    };
    let count = SIDE * SIDE;
    let faces: Vec<u32> = (0..count).flat_map(quad).collect();
    Mesh::from_polygons(count as usize, &vec![4; count as usize], &faces)
        .map_err(|_| Error::new(ErrorKind::BrokenInvariant, "a torus is refused"))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A ring that came out wrong would be refused as one, and every row be made the
    /// long way: right, and slow.
    #[test]
    fn a_regular_mesh_has_rings_only() {
        let torus = torus().unwrap();
        let all = rings(&Scheme::catmull_clark(), &torus).unwrap();
        assert_eq!(all.len(), (SIDE * SIDE) as usize);
        assert!(all.iter().all(|ring| ring[0] != NONE));
    }
}
