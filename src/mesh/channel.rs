//! Face-varying data: values at the corners of faces, with seams.
//!
//! A *channel* says which value each corner of a mesh takes. Corners of one vertex that
//! take the same value share it; where two faces beside an edge take different values at
//! either end, the edge is a *seam*. So a channel is a mesh of its own on the same
//! corners, cut along the seams, whose vertices are the pairs (vertex, value).

use super::build::several_fans;
use super::{Joints, Layout, Mesh, Sharpness, VertexSet, joints};
use crate::base::{Context, Element, Error, ErrorKind, NONE, Result, memory};

/// How smooth the values of a channel are along its own boundaries: seams, and the
/// boundary of the mesh. Names and meaning are OpenSubdiv's.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
#[non_exhaustive]
pub enum FaceVaryingMode {
    /// Everything smooth: boundaries are curves, corners are rounded
    /// (`FVAR_LINEAR_NONE`).
    Smooth,
    /// Corners, which belong to one face, stay (`FVAR_LINEAR_CORNERS_ONLY`).
    #[default]
    Corners,
    /// And values stay where three and more meet, or where one of two is not one piece
    /// (`FVAR_LINEAR_CORNERS_PLUS1`).
    CornersPlus1,
    /// And ends of seams, and both values where one of two is a corner
    /// (`FVAR_LINEAR_CORNERS_PLUS2`).
    CornersPlus2,
    /// Boundaries are refined linearly (`FVAR_LINEAR_BOUNDARIES`).
    Boundaries,
    /// Everything is refined linearly (`FVAR_LINEAR_ALL`).
    All,
}

/// The topology of face-varying values on a mesh.
///
/// # Example
/// ```
/// use carvel::{Mesh, mesh::{Channel, FaceVaryingMode}};
/// // Two quads with a seam between them: 8 values on 6 vertices.
/// let mesh = Mesh::from_polygons(6, &[4, 4], &[0, 1, 4, 3, 1, 2, 5, 4])?;
/// let indices = [0, 1, 2, 3, 4, 5, 6, 7];
/// let channel = Channel::new(&mesh, &indices, 8, FaceVaryingMode::default())?;
/// assert_eq!(channel.seam_edges(&mesh), 1);
/// # Ok::<(), carvel::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Channel {
    /// The mesh cut along the seams; a vertex is a pair of a vertex and a value.
    pub(crate) mesh: Mesh,
    /// The caller's value of each vertex, and the vertex of the caller's mesh.
    pub(crate) source: Vec<u32>,
    vertex: Vec<u32>,
    /// The caller's values.
    pub(crate) values: usize,
    pub(crate) mode: FaceVaryingMode,
}

impl Channel {
    /// A channel from the value of every corner, in the order of the faces and corners
    /// that the mesh was built from.
    ///
    /// Values that no corner takes are allowed; the same value at different vertices
    /// counts as several.
    ///
    /// # Errors
    /// [`ErrorKind::LengthMismatch`] unless there is one index per corner,
    /// [`ErrorKind::IndexOutOfRange`] naming the face, [`ErrorKind::OutOfResources`].
    pub fn new(mesh: &Mesh, indices: &[u32], values: usize, mode: FaceVaryingMode) -> Result<Self> {
        if indices.len() != mesh.corners() {
            let message =
                format!("{} face-varying indices for {} corners", indices.len(), mesh.corners());
            return Err(Error::new(ErrorKind::LengthMismatch, message));
        }
        let taken = in_mesh_order(mesh, indices, values)?;
        let (vert, source) = slots(mesh, &taken)?;
        let twin = twins(mesh, &vert)?;
        let mut cut = unfinished(mesh.layout.try_clone()?, vert, twin, source.len())?;
        cut.joints.sides = joints(mesh, &cut)?;
        let several = several_fans(&Context::serial(), &mut cut)?;
        joints::collect_fans(&mut cut, &several)?;
        cut.collect_lists()?;
        let mut vertex = memory::zeroed(source.len())?;
        for (&slot, &v) in cut.vert.iter().zip(&mesh.vert) {
            vertex[slot as usize] = v;
        }
        Ok(Self { mesh: cut, source, vertex, values, mode })
    }

    /// How smooth the values are along boundaries.
    pub fn mode(&self) -> FaceVaryingMode {
        self.mode
    }

    /// The number of the caller's values.
    pub fn values(&self) -> usize {
        self.values
    }

    /// The number of edges of a mesh, the one that the channel was made for, across which
    /// values are not continuous.
    ///
    /// # Panics
    /// If the mesh has another number of corners.
    pub fn seam_edges(&self, mesh: &Mesh) -> usize {
        assert_eq!(self.mesh.corners(), mesh.corners(), "a channel of another mesh");
        let cut =
            |&c: &u32| self.mesh.twin[c as usize] == NONE && self.mesh.joints.leader(c).is_none();
        let edge = |&c: &u32| mesh.is_first_of_edge(c) && !mesh.is_boundary_edge(c);
        (0..mesh.layout.corners()).filter(edge).filter(cut).count()
    }

    /// Refuses to work on another mesh.
    ///
    /// # Errors
    /// [`ErrorKind::LengthMismatch`].
    pub(crate) fn check_mesh(&self, mesh: &Mesh) -> Result<()> {
        let same = |(&slot, &v): (&u32, &u32)| self.vertex[slot as usize] == v;
        if self.mesh.layout == mesh.layout && self.mesh.vert.iter().zip(&mesh.vert).all(same) {
            return Ok(());
        }
        Err(Error::new(ErrorKind::LengthMismatch, "a face-varying channel belongs to another mesh"))
    }

    /// The channel as a mesh of single fans: vertices of several are there several times. With the
    /// channel's own number of each vertex.
    ///
    /// # Errors
    /// [`ErrorKind::OutOfResources`].
    pub(crate) fn apart(&self) -> Result<(Mesh, Vec<u32>)> {
        let mut vert = memory::copied(&self.mesh.vert)?;
        let mut own = memory::collect(0..self.source.len() as u32)?;
        for &(v, start) in &self.mesh.joints.fans {
            let copy = own.len() as u32;
            memory::extend(&mut own, [v])?;
            self.mesh.fan_from(start).for_each(|corner| vert[corner as usize] = copy);
        }
        let twin = memory::copied(&self.mesh.twin)?;
        let mut mesh = unfinished(self.mesh.layout.try_clone()?, vert, twin, own.len())?;
        several_fans(&Context::serial(), &mut mesh)?;
        mesh.collect_lists()?;
        Ok((mesh, own))
    }

    /// The value that a corner takes, by the caller's number.
    pub(crate) fn taken(&self, corner: usize) -> u32 {
        self.source[self.mesh.vert[corner] as usize]
    }
}

impl Mesh {
    /// True for the outgoing edge of a corner if it has no other face.
    pub(crate) fn is_boundary_edge(&self, corner: u32) -> bool {
        self.twin[corner as usize] == NONE && self.joints.leader(corner).is_none()
    }
}

/// A mesh whose fans and lists are to be found.
fn unfinished(layout: Layout, vert: Vec<u32>, twin: Vec<u32>, vertices: usize) -> Result<Mesh> {
    Ok(Mesh {
        layout,
        twin,
        vert,
        start: memory::filled(NONE, vertices)?,
        rim: Vec::new(),
        special: Vec::new(),
        special_set: VertexSet::default(),
        near: None,
        sharpness: Sharpness::default(),
        joints: Joints::default(),
        holes: Vec::new(),
        runs: Vec::new(),
        corner_tags: Vec::new(),
        anchored: false,
        refined: false,
        face_source: None,
    })
}

/// The indices in the mesh's order of faces, all in range.
fn in_mesh_order(mesh: &Mesh, indices: &[u32], values: usize) -> Result<Vec<u32>> {
    let mut sizes = memory::zeroed::<u32>(mesh.faces())?;
    for (face, size) in mesh.face_sizes().enumerate() {
        sizes[mesh.face_source(face)] = size;
    }
    let mut offsets = memory::reserved(mesh.faces() + 1)?;
    offsets.push(0);
    for size in sizes {
        offsets.push(offsets[offsets.len() - 1] + size as usize);
    }
    if let Some(at) = indices.iter().position(|&i| i as usize >= values) {
        let face = offsets.partition_point(|&o| o <= at) - 1;
        let message = format!("face {face} names value {} of {values}", indices[at]);
        let element = Element::Face(face as u64);
        return Err(Error::new(ErrorKind::IndexOutOfRange, message).with_elements([element]));
    }
    let mut taken = memory::reserved(mesh.corners())?;
    for face in 0..mesh.faces() {
        let source = mesh.face_source(face);
        taken.extend_from_slice(&indices[offsets[source]..offsets[source + 1]]);
    }
    Ok(taken)
}

/// Numbers the pairs (vertex, value), by vertex and then by value: the pair of each
/// corner, and the value of each pair.
fn slots(mesh: &Mesh, taken: &[u32]) -> Result<(Vec<u32>, Vec<u32>)> {
    let mut slot = memory::filled(NONE, mesh.corners())?;
    let mut source: Vec<u32> = Vec::new();
    let mut around = Vec::new();
    for v in 0..mesh.start.len() as u32 {
        around.clear();
        memory::extend(&mut around, mesh.fans(v).map(|c| (taken[c as usize], c)))?;
        around.sort_unstable();
        for same in around.chunk_by(|a, b| a.0 == b.0) {
            for &(_, corner) in same {
                slot[corner as usize] = source.len() as u32;
            }
            memory::extend(&mut source, [same[0].0])?;
        }
    }
    Ok((slot, source))
}

/// The twins where both ends take the same values on both sides.
fn twins(mesh: &Mesh, slot: &[u32]) -> Result<Vec<u32>> {
    let continuous = |c: u32, twin: u32| {
        slot[c as usize] == slot[mesh.next(twin) as usize]
            && slot[mesh.next(c) as usize] == slot[twin as usize]
    };
    let corners = 0..mesh.layout.corners();
    memory::collect(corners.map(|c| match mesh.twin[c as usize] {
        NONE => NONE,
        twin if continuous(c, twin) => twin,
        _ => NONE,
    }))
}

/// The sides of non-manifold edges that take the same values.
fn joints(mesh: &Mesh, cut: &Mesh) -> Result<Vec<(u32, u32)>> {
    let ends = |c: u32| {
        let (a, b) = (cut.vert[c as usize], cut.vert[cut.next(c) as usize]);
        (a.min(b), a.max(b))
    };
    let mut sides = memory::copied(&mesh.joints.sides)?;
    sides.sort_unstable_by_key(|&(c, leader)| (leader, c));
    let groups = sides.chunk_by(|a, b| a.1 == b.1);
    let continuous = groups.filter(|group| group.iter().all(|&(c, l)| ends(c) == ends(l)));
    let mut kept = memory::collect(continuous.flatten().copied())?;
    kept.sort_unstable();
    Ok(kept)
}
