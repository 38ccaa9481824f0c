//! What refinement leaves of creases, without the meshes of the levels.
//!
//! Both halves of an edge are found by arithmetic, and a step's sharpness depends on the
//! sharp edges at either end alone. So the creases of level n cost no more than themselves:
//! 2ⁿ for each of the control mesh. The same as [`super::Hierarchy`]'s meshes have, to the
//! bit.

use super::Prediction;
use crate::base::{Crease, Error, ErrorKind, Result, memory};
use crate::mesh::Mesh;
use crate::refine::{Around, Creasing, Pieces};
use crate::scheme::{Scheme, SplitKind};

/// The creases that are left after some levels, by the vertices of the last one.
///
/// `face_vertices` are the concatenated faces of that level, as refinement gives them.
/// Infinitely sharp edges stay so; those on the boundary are not listed, being sharp
/// anyway. (Of sharp vertices, which keep their numbers, each level takes 1 as well.)
///
/// # Errors
/// [`ErrorKind::Unsupported`] for a dual scheme, whose edges have no descendants,
/// [`ErrorKind::LengthMismatch`] for faces of another level, [`ErrorKind::TooLarge`],
/// [`ErrorKind::OutOfResources`].
///
/// # Example
/// ```
/// use carvel::{Context, Crease, Refiner, Scheme, Task};
/// use carvel::{hierarchy::creases_left, mesh::{BuildOptions, build}};
/// let options = BuildOptions {
///     creases: &[Crease { vertices: [1, 4], sharpness: 2.5 }],
///     ..BuildOptions::default()
/// };
/// let faces = [0, 1, 4, 3, 1, 2, 5, 4];
/// let strip = build(&Context::serial(), 6, &[4, 4], &faces, &options).unwrap().mesh;
/// let scheme = Scheme::catmull_clark();
/// let positions = [0., 0., 0., 1., 0., 0., 2., 0., 0., 0., 1., 0., 1., 1., 0., 2., 1., 0.];
/// let task = Task::new(&strip, &scheme, 2, &positions);
/// let refined = Refiner::new().refine(&Context::serial(), &task)?;
/// let left = creases_left(&strip, &scheme, 2, &refined.face_vertices)?;
/// assert_eq!(left.len(), 4);
/// assert!(left.iter().all(|crease| crease.sharpness == 0.5));
/// # Ok::<(), carvel::Error>(())
/// ```
pub fn creases_left(
    mesh: &Mesh,
    scheme: &Scheme,
    levels: u32,
    face_vertices: &[u32],
) -> Result<Vec<Crease>> {
    if scheme.split() == SplitKind::Corner {
        let message = "creases have no descendants under a dual scheme";
        return Err(Error::new(ErrorKind::Unsupported, message));
    }
    let plan = Prediction::new(mesh, scheme, levels)?;
    plan.check_index_type()?;
    if face_vertices.len() as u64 != plan.last().corners {
        let (len, corners) = (face_vertices.len(), plan.last().corners);
        let message = format!("{len} face vertices, level {levels} has {corners}");
        return Err(Error::new(ErrorKind::LengthMismatch, message));
    }
    if levels == 0 {
        return memory::collect(mesh.creases());
    }
    let mut tracks = Tracks::of(mesh, scheme.creasing())?;
    for level in 0..levels {
        if tracks.edges.iter().all(|edge| edge.sharpness <= 0.0) {
            return Ok(Vec::new());
        }
        let pieces = scheme.pieces();
        tracks = tracks.step(pieces, |corner| match level {
            0 => mesh.next(corner),
            _ => next_in_face(corner, pieces.sides()),
        })?;
    }
    let left = tracks.edges.iter().filter(|edge| edge.sharpness > 0.0);
    memory::collect(left.map(|edge| {
        let ends = [edge.corner, next_in_face(edge.corner, scheme.pieces().sides())];
        let vertices = ends.map(|corner| face_vertices[corner as usize]);
        Crease { vertices, sharpness: edge.sharpness }
    }))
}

/// The next corner in a mesh of faces of one size.
fn next_in_face(corner: u32, sides: u32) -> u32 {
    if corner % sides == sides - 1 { corner + 1 - sides } else { corner + 1 }
}

/// A sharp edge at some level.
struct Track {
    /// One of its sides.
    corner: u32,
    sharpness: f32,
}

/// The sharp edges of a level, and how they meet.
struct Tracks {
    creasing: Creasing,
    edges: Vec<Track>,
    /// Who meets where, in the order around each vertex; [`Creasing::Uniform`] does not
    /// ask. The number of the vertex is one of ours.
    ends: Vec<End>,
    vertices: u32,
}

/// An end of a sharp edge.
#[derive(Clone, Copy)]
struct End {
    vertex: u32,
    edge: u32,
    /// False at the vertex of its corner.
    far: bool,
}

impl Tracks {
    /// The creases of a control mesh.
    fn of(mesh: &Mesh, creasing: Creasing) -> Result<Self> {
        let sharp = &mesh.sharpness.edges;
        let edges =
            memory::collect(sharp.iter().map(|&(corner, sharpness)| Track { corner, sharpness }))?;
        let mut tracks = Self { creasing, edges, ends: Vec::new(), vertices: 0 };
        if creasing != Creasing::Uniform {
            tracks.meet(mesh)?;
        }
        Ok(tracks)
    }

    /// Lists the ends around every vertex.
    fn meet(&mut self, mesh: &Mesh) -> Result<()> {
        let sharp = &mesh.sharpness.edges;
        let corners = sharp.iter().flat_map(|&(c, _)| [c, mesh.next(c)]);
        let mut vertices = memory::collect(corners.map(|c| mesh.vert[c as usize]))?;
        vertices.sort_unstable();
        vertices.dedup();
        self.vertices = vertices.len() as u32;
        for (vertex, &v) in (0..).zip(&vertices) {
            let mut around = Vec::new();
            mesh.each_edge_at(v, |far, _| {
                // The last edge of an open fan leaves from no corner here; it is no crease.
                let corner = mesh.prev(far);
                if mesh.vert[corner as usize] == v {
                    around.push(mesh.first_of_edge(corner));
                }
            });
            for first in around {
                let found = sharp.binary_search_by_key(&first, |&(c, _)| c);
                let end = found.ok().map(|edge| End {
                    vertex,
                    edge: edge as u32,
                    far: mesh.vert[first as usize] != v,
                });
                memory::extend(&mut self.ends, end)?;
            }
        }
        Ok(())
    }

    /// The halves of all edges: number 2e is that at the near end of edge e. `next` gives
    /// the next corner of a face.
    fn step(&self, pieces: Pieces, next: impl Fn(u32) -> u32) -> Result<Self> {
        let mut edges = memory::reserved(2 * self.edges.len())?;
        for &Track { corner, sharpness } in &self.edges {
            let uniform = self.creasing.edge(sharpness, Around::default());
            let half = |corner| Track { corner, sharpness: uniform };
            edges.push(half(pieces.start_half(corner)));
            edges.push(half(pieces.end_half(next(corner))));
        }
        let around = self.around()?;
        let half = |end: End| 2 * end.edge + u32::from(end.far);
        for end in &self.ends {
            let sharpness = self.edges[end.edge as usize].sharpness;
            let left = self.creasing.edge(sharpness, around[end.vertex as usize]);
            edges[half(*end) as usize].sharpness = left;
        }
        let mut tracks = Self { creasing: self.creasing, edges, ends: Vec::new(), vertices: 0 };
        if self.ends.is_empty() {
            return Ok(tracks);
        }
        let old = self.ends.iter().map(|&end| End { edge: half(end), ..end });
        let middles = (0..self.edges.len() as u32).flat_map(|edge| {
            let vertex = self.vertices + edge;
            [(2 * edge, true), (2 * edge + 1, false)].map(|(edge, far)| End { vertex, edge, far })
        });
        tracks.ends = memory::collect(old.chain(middles))?;
        tracks.vertices = self.vertices + self.edges.len() as u32;
        Ok(tracks)
    }

    /// The sharp edges around each vertex.
    fn around(&self) -> Result<Vec<Around>> {
        let mut around = memory::filled(Around::default(), self.vertices as usize)?;
        for end in &self.ends {
            around[end.vertex as usize].add(self.edges[end.edge as usize].sharpness);
        }
        Ok(around)
    }
}
