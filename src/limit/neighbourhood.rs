//! The same neighbourhood in two meshes: names for the vertices that correspond.

use crate::base::NONE;
use crate::mesh::Mesh;
use std::collections::{HashMap, HashSet};

/// A vertex around a feature: the orbit that turns carry it through, and how far it was turned.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(super) struct Name {
    pub(super) orbit: usize,
    pub(super) sector: usize,
}

/// A vertex and the images that turns by one face make of it; a vertex in the middle has
/// itself alone.
#[derive(Debug, Clone)]
pub(super) struct Orbit {
    /// In the parent mesh, by sector.
    pub(super) parents: Vec<u32>,
    /// In the child mesh, the vertex that corresponds to the first of them.
    pub(super) child: u32,
    /// Edges crossed on the way from the middle.
    pub(super) distance: u32,
}

/// What a feature and a later image of it have in common.
#[derive(Debug)]
pub(super) struct Neighbourhood {
    pub(super) orbits: Vec<Orbit>,
    names: HashMap<u32, Name>,
}

impl Neighbourhood {
    /// Walks two meshes in step from corners in the middle that correspond, crossing at most
    /// `reach` edges. If a turn by one corner leads to the same mesh, the first corner is
    /// where one starts and the others are its images.
    pub(super) fn new(
        meshes: [&Mesh; 2],
        middle: &[[u32; 2]],
        symmetric: bool,
        reach: u32,
    ) -> Self {
        let [parent, child] = meshes;
        let (starts, images) = middle.split_at(if symmetric { 1 } else { middle.len() });
        let steps = walk(meshes, starts, reach);
        let mut corners: Vec<Vec<u32>> = vec![steps.iter().map(|step| step.corners[0]).collect()];
        // The other sectors go the same way without looking.
        corners.extend(images.iter().map(|&[start, _]| repeat(parent, start, &steps)));
        let mut orbits: Vec<Orbit> = Vec::new();
        let mut names: HashMap<u32, Name> = HashMap::new();
        for (at, step) in steps.iter().enumerate() {
            if names.contains_key(&parent.vert[step.corners[0] as usize]) {
                continue;
            }
            let image = |corners: &Vec<u32>| parent.vert[corners[at] as usize];
            let mut parents: Vec<u32> = corners.iter().map(image).collect();
            parents.dedup();
            for (sector, &parent) in parents.iter().enumerate() {
                names.insert(parent, Name { orbit: orbits.len(), sector });
            }
            let child = child.vert[step.corners[1] as usize];
            orbits.push(Orbit { parents, child, distance: step.distance });
        }
        Self { orbits, names }
    }

    /// The name of a vertex of the parent mesh.
    pub(super) fn name(&self, parent: u32) -> Option<Name> {
        self.names.get(&parent).copied()
    }
}

/// A corner seen for the first time on a walk.
pub(super) struct Step {
    /// In the parent and in the child.
    pub(super) corners: [u32; 2],
    pub(super) distance: u32,
    /// The step before, and whether it was left across its edge; a start has none.
    pub(super) from: Option<(usize, bool)>,
}

/// Goes from corner to corner in both meshes as long as they agree, breadth first.
pub(super) fn walk(meshes: [&Mesh; 2], starts: &[[u32; 2]], reach: u32) -> Vec<Step> {
    let [parent, child] = meshes;
    let sides = |mesh: &Mesh, corner| mesh.layout.face(mesh.layout.face_of(corner)).len();
    let start = |&corners: &[u32; 2]| Step { corners, distance: 0, from: None };
    let mut steps: Vec<Step> = starts.iter().map(start).collect();
    let mut seen: HashSet<u32> = starts.iter().map(|start| start[0]).collect();
    let mut at = 0;
    while let Some(&Step { corners: [c, d], distance, .. }) = steps.get(at) {
        if sides(parent, c) == sides(child, d) {
            let next = [parent.next(c), child.next(d)];
            if seen.insert(next[0]) {
                steps.push(Step { corners: next, distance, from: Some((at, false)) });
            }
            let twins = [parent.twin[c as usize], child.twin[d as usize]];
            if distance < reach && !twins.contains(&NONE) && seen.insert(twins[0]) {
                let from = Some((at, true));
                steps.push(Step { corners: twins, distance: distance + 1, from });
            }
        }
        at += 1;
    }
    steps
}

/// The corners on the same way from another start.
fn repeat(mesh: &Mesh, start: u32, steps: &[Step]) -> Vec<u32> {
    let mut corners: Vec<u32> = Vec::with_capacity(steps.len());
    for step in steps {
        corners.push(match step.from {
            None => start,
            Some((from, true)) => mesh.twin[corners[from] as usize],
            Some((from, false)) => mesh.next(corners[from]),
        });
    }
    corners
}
