//! What a mesh is like: components, boundary loops, histograms.

use super::Mesh;
use crate::base::{Result, memory};
use std::collections::BTreeMap;

/// Figures about a mesh as a whole.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct Survey {
    /// Connected components, isolated vertices not counted.
    pub components: usize,
    /// Boundary loops.
    pub boundary_loops: usize,
    /// Vertices that belong to no face.
    pub isolated_vertices: usize,
    /// V − E + F, isolated vertices not counted.
    pub euler_characteristic: i64,
    /// Number of faces by size.
    pub face_sizes: BTreeMap<usize, usize>,
    /// Number of interior vertices by valence.
    pub interior_valences: BTreeMap<usize, usize>,
    /// Number of boundary vertices by number of faces.
    pub boundary_valences: BTreeMap<usize, usize>,
}

impl Survey {
    /// Looks at the whole mesh once.
    ///
    /// # Panics
    /// If there is no memory for a number for each vertex; see [`Self::try_of`].
    pub fn of(mesh: &Mesh) -> Self {
        Self::try_of(mesh).unwrap_or_else(|error| panic!("{error}"))
    }

    /// Looks at the whole mesh once, if there is memory for it.
    ///
    /// # Errors
    /// [`crate::ErrorKind::OutOfResources`].
    pub fn try_of(mesh: &Mesh) -> Result<Self> {
        let isolated = mesh.start.iter().filter(|&&c| c == crate::base::NONE).count();
        let mut survey = Self {
            components: components(mesh)?,
            boundary_loops: boundary_loops(mesh)?,
            isolated_vertices: isolated,
            euler_characteristic: (mesh.vertices() - isolated) as i64 - mesh.edges() as i64
                + mesh.faces() as i64,
            face_sizes: BTreeMap::new(),
            interior_valences: BTreeMap::new(),
            boundary_valences: BTreeMap::new(),
        };
        for size in mesh.face_sizes() {
            *survey.face_sizes.entry(size as usize).or_default() += 1;
        }
        for v in 0..mesh.vertices() {
            match mesh.valence(v) {
                0 => {}
                n if mesh.is_boundary_vertex(v) => {
                    *survey.boundary_valences.entry(n).or_default() += 1;
                }
                n => *survey.interior_valences.entry(n).or_default() += 1,
            }
        }
        Ok(survey)
    }
}

/// Connected components by union-find over the vertices of each face.
fn components(mesh: &Mesh) -> Result<usize> {
    let mut parent = memory::collect(0..mesh.start.len() as u32)?;
    let mut joined = 0;
    for corner in 0..mesh.layout.corners() {
        let a = root(&mut parent, mesh.vert[corner as usize]);
        let b = root(&mut parent, mesh.vert[mesh.next(corner) as usize]);
        if a != b {
            parent[a.max(b) as usize] = a.min(b);
            joined += 1;
        }
    }
    let used = mesh.start.iter().filter(|&&c| c != crate::base::NONE).count();
    Ok(used - joined)
}

/// The root of a vertex, halving the path on the way.
fn root(parent: &mut [u32], mut v: u32) -> u32 {
    while parent[v as usize] != v {
        parent[v as usize] = parent[parent[v as usize] as usize];
        v = parent[v as usize];
    }
    v
}

fn boundary_loops(mesh: &Mesh) -> Result<usize> {
    if !mesh.is_manifold() {
        return boundary_components(mesh);
    }
    let mut seen = memory::filled(false, mesh.rim.len())?;
    let mut loops = 0;
    for i in 0..mesh.rim.len() {
        let mut at = i;
        loops += usize::from(!seen[i]);
        while !seen[at] {
            seen[at] = true;
            let end = mesh.vert[mesh.next(mesh.rim[at]) as usize];
            let onward = mesh.start[end as usize];
            at = mesh.rim.binary_search(&onward).expect("a boundary goes on");
        }
    }
    Ok(loops)
}

/// Where several fans meet, loops are not told apart: connected parts of the boundary.
fn boundary_components(mesh: &Mesh) -> Result<usize> {
    let mut parent = memory::collect(0..mesh.start.len() as u32)?;
    let mut touched = memory::filled(false, mesh.start.len())?;
    let mut joined = 0;
    for &c in mesh.rim.iter().filter(|&&c| mesh.joints.leader(c).is_none()) {
        let ends = [c, mesh.next(c)].map(|c| mesh.vert[c as usize]);
        let [a, b] = ends.map(|v| root(&mut parent, v));
        if a != b {
            parent[a.max(b) as usize] = a.min(b);
            joined += 1;
        }
        for v in ends {
            touched[v as usize] = true;
        }
    }
    Ok(touched.iter().filter(|&&t| t).count() - joined)
}
