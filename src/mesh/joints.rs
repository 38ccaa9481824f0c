//! Policy `sharpen`: where a mesh is not manifold, as OpenSubdiv has it.
//!
//! Every side of an edge that is no pair of opposite corners has no twin, so that the
//! fans around its vertices end there; the sides still share one edge, and the fans
//! one vertex. Such edges are infinitely sharp. So are the vertices, unless just two
//! such edges and no boundary meet there: then they form a crease, as they do inside
//! the edge where several sheets meet.

use super::sharpness::INFINITE;
use super::{Mesh, cut};
use crate::base::{NONE, Result, memory};

/// What a mesh has beside pairs of corners and one fan for each vertex.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub(crate) struct Joints {
    /// Each side of a non-manifold edge and the smallest corner of that edge, ascending.
    pub(crate) sides: Vec<(u32, u32)>,
    /// Vertex and first corner of every fan beyond the first, ascending.
    pub(crate) fans: Vec<(u32, u32)>,
}

impl Joints {
    pub(crate) fn is_empty(&self) -> bool {
        self.sides.is_empty() && self.fans.is_empty()
    }

    /// The smallest corner of the non-manifold edge of a side.
    pub(crate) fn leader(&self, corner: u32) -> Option<u32> {
        let at = self.sides.binary_search_by_key(&corner, |&(c, _)| c).ok()?;
        Some(self.sides[at].1)
    }

    /// The number of non-manifold edges.
    pub(crate) fn edges(&self) -> usize {
        self.sides.iter().filter(|(c, leader)| c == leader).count()
    }

    /// First corners of the further fans of a vertex.
    pub(crate) fn further_fans(&self, vertex: u32) -> impl Iterator<Item = u32> + '_ {
        let first = self.fans.partition_point(|&(v, _)| v < vertex);
        self.fans[first..].iter().take_while(move |&&(v, _)| v == vertex).map(|&(_, c)| c)
    }

    /// Bytes held.
    pub(crate) fn bytes(&self) -> u64 {
        8 * (self.sides.capacity() + self.fans.capacity()) as u64
    }

    /// From groups of sides: a leader for each.
    pub(crate) fn of_groups<'g>(
        groups: impl Iterator<Item = &'g [u32]>,
    ) -> Result<Vec<(u32, u32)>> {
        let mut sides = Vec::new();
        for group in groups {
            let leader = group.iter().copied().min().unwrap_or(NONE);
            memory::extend(&mut sides, group.iter().map(|&c| (c, leader)))?;
        }
        sides.sort_unstable();
        Ok(sides)
    }
}

/// Lists the fans of vertices that have several.
pub(super) fn collect_fans(mesh: &mut Mesh, several: &[u32]) -> Result<()> {
    let mut further = Vec::new();
    for group in cut::corners_of(mesh, several)?.chunk_by(|a, b| a.0 == b.0) {
        let v = group[0].0;
        let fans = cut::fans(mesh, group)?;
        // An open fan comes first: whether the vertex is on the rim is read off it.
        let open = |fan: &Vec<u32>| mesh.twin[fan[0] as usize] == NONE;
        let first = fans.iter().position(open).unwrap_or(0);
        mesh.start[v as usize] = fans[first][0];
        let others = fans.iter().enumerate().filter(|(i, _)| *i != first);
        memory::extend(&mut further, others.map(|(_, fan)| (v, fan[0])))?;
    }
    further.sort_unstable();
    mesh.joints.fans = further;
    Ok(())
}

/// Makes the non-manifold vertices sharp.
pub(super) fn sharpen_vertices(mesh: &mut Mesh) -> Result<()> {
    if mesh.joints.is_empty() {
        return Ok(());
    }
    let sides = mesh.joints.sides.iter().map(|&(c, _)| c);
    let ends = sides.flat_map(|c| [c, mesh.next(c)]).map(|c| mesh.vert[c as usize]);
    let mut vertices = memory::collect(ends.chain(mesh.joints.fans.iter().map(|&(v, _)| v)))?;
    vertices.sort_unstable();
    vertices.dedup();
    vertices.retain(|&v| !is_inside_crease(mesh, v));
    let sharpness = &mut mesh.sharpness;
    sharpness.vertices.retain(|(v, _)| vertices.binary_search(v).is_err());
    memory::extend(&mut sharpness.vertices, vertices.into_iter().map(|v| (v, INFINITE)))?;
    sharpness.vertices.sort_unstable_by_key(|&(v, _)| v);
    Ok(())
}

/// True if two non-manifold edges and no boundary edge meet at a vertex that has
/// more faces than edges.
fn is_inside_crease(mesh: &Mesh, vertex: u32) -> bool {
    let mut joint = Vec::new();
    let (mut faces, mut interior, mut boundary) = (0, 0, 0);
    for c in mesh.fans(vertex) {
        faces += 1;
        // Interior edges are counted where they leave, the others on either side.
        interior += usize::from(mesh.twin[c as usize] != NONE);
        for side in [c, mesh.prev(c)].into_iter().filter(|&c| mesh.twin[c as usize] == NONE) {
            match mesh.joints.leader(side) {
                Some(leader) => joint.push(leader),
                None => boundary += 1,
            }
        }
    }
    joint.sort_unstable();
    joint.dedup();
    joint.len() == 2 && boundary == 0 && faces > interior + joint.len()
}
