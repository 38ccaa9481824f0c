//! Which vertex is which, through parents.
//!
//! Two libraries that split the same way number the children differently. Every child
//! vertex comes from a vertex, an edge or a face of the level before, and an edge is
//! known by its ends: so once a level's vertices and faces are matched, the next
//! level's are too, without looking at a position.
//!
//! Our side is not read off a result but laid out anew from the documented numbering
//! (the head of `refine/`), so that a result which numbers its vertices otherwise shows.

use crate::normalise::Correspondence;
use crate::opensubdiv::{Level, Parent};
use crate::{PeerMesh, Refinement, Result, Scheme, Task, ours};
use std::collections::HashMap;

/// How a step cuts faces.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Split {
    /// Every n-gon into n quads (Catmull–Clark, bilinear).
    Quad,
    /// Every triangle into four (Loop).
    Triangle,
}

/// A level in our numbering.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Ours {
    /// Faces and their vertices.
    pub level: PeerMesh,
    vertices: u32,
    parents: Vec<Parent>,
    face_parents: Vec<u32>,
}

impl Ours {
    /// The control mesh in carvel's order of faces.
    pub fn control(vertices: usize, sizes: Vec<u32>, indices: Vec<u32>) -> Self {
        let level = PeerMesh { sizes, indices, positions: Vec::new() };
        Self { level, vertices: vertices as u32, ..Self::default() }
    }

    /// The next level, as documented: old vertices keep their numbers, then one for
    /// each edge, edges by their first corner, then (quads) one for each face.
    #[must_use]
    pub fn split(&self, split: Split) -> Self {
        let (edges, corner_edges) = self.edges();
        let mut parents: Vec<_> = (0..self.vertices).map(Parent::Vertex).collect();
        parents.extend(edges.iter().map(|&[a, b]| Parent::Edge(a.min(b), a.max(b))));
        if split == Split::Quad {
            parents.extend((0..self.level.sizes.len() as u32).map(Parent::Face));
        }
        let mut next = Self { vertices: parents.len() as u32, parents, ..Self::default() };
        let first_face = self.vertices + edges.len() as u32;
        let mut corner = 0;
        for (f, face) in (0..).zip(self.level.faces()) {
            let edge: Vec<_> = corner_edges[corner..corner + face.len()]
                .iter()
                .map(|e| self.vertices + e)
                .collect();
            corner += face.len();
            match split {
                Split::Quad => next.quads(f, face, &edge, first_face + f),
                Split::Triangle => next.triangles(f, face, &edge),
            }
        }
        next
    }

    fn push(&mut self, parent: u32, face: &[u32]) {
        self.level.sizes.push(face.len() as u32);
        self.level.indices.extend_from_slice(face);
        self.face_parents.push(parent);
    }

    /// One quad per corner: vertex, its edge, the face, the edge before.
    fn quads(&mut self, parent: u32, face: &[u32], edge: &[u32], middle: u32) {
        for i in 0..face.len() {
            let before = edge[(i + face.len() - 1) % face.len()];
            self.push(parent, &[face[i], edge[i], middle, before]);
        }
    }

    /// One triangle per corner and the middle one.
    fn triangles(&mut self, parent: u32, face: &[u32], edge: &[u32]) {
        for i in 0..3 {
            self.push(parent, &[face[i], edge[i], edge[(i + 2) % 3]]);
        }
        self.push(parent, &[edge[2], edge[0], edge[1]]);
    }

    /// The ends of every edge, numbered by their first corners, and the edge that
    /// leaves each corner. Sorted, not hashed: levels before the last are large.
    fn edges(&self) -> (Vec<[u32; 2]>, Vec<u32>) {
        let mut sides: Vec<([u32; 2], u32)> = Vec::with_capacity(self.level.indices.len());
        for face in self.level.faces() {
            for (i, &a) in face.iter().enumerate() {
                let b = face[(i + 1) % face.len()];
                sides.push(([a.min(b), a.max(b)], sides.len() as u32));
            }
        }
        sides.sort_unstable();
        let mut leader = vec![0; sides.len()];
        let mut ends = vec![[0; 2]; sides.len()];
        for same in sides.chunk_by(|a, b| a.0 == b.0) {
            for &(pair, corner) in same {
                leader[corner as usize] = same[0].1;
                ends[corner as usize] = pair;
            }
        }
        let (mut edges, mut numbers) = (Vec::new(), vec![0; sides.len()]);
        for corner in 0..leader.len() {
            if leader[corner] as usize == corner {
                numbers[corner] = edges.len() as u32;
                edges.push(ends[corner]);
            } else {
                numbers[corner] = numbers[leader[corner] as usize];
            }
        }
        (edges, numbers)
    }
}

/// The vertex of a face that was a vertex before: it tells the children of a face
/// apart; the middle triangle has none.
fn old_corner(face: &[u32], parents: impl Fn(u32) -> Option<Parent>) -> Option<u32> {
    face.iter().find_map(|&v| match parents(v) {
        Some(Parent::Vertex(old)) => Some(old),
        _ => None,
    })
}

/// Matches the next level of both sides, given the level before.
fn descend(before: &Correspondence, ours: &Ours, theirs: &Level) -> Result<Correspondence> {
    let mut by_parent = HashMap::with_capacity(theirs.parents.len());
    for (v, parent) in (0..).zip(&theirs.parents) {
        let parent = parent.ok_or_else(|| format!("their vertex {v} has no parent"))?;
        if by_parent.insert(parent, v).is_some() {
            return Err(format!("their vertex {v} shares its parent"));
        }
    }
    let mut by_corner = HashMap::with_capacity(theirs.sizes.len());
    for ((g, face), &parent) in (0..).zip(theirs.faces()).zip(&theirs.face_parents) {
        let corner = old_corner(face, |v| theirs.parents[v as usize]);
        by_corner.insert((parent, corner), g);
    }
    let vertex = |v: u32| before.vertices[v as usize];
    let renamed = |parent: &Parent| match *parent {
        Parent::Vertex(v) => Parent::Vertex(vertex(v)),
        Parent::Edge(a, b) => Parent::Edge(vertex(a).min(vertex(b)), vertex(a).max(vertex(b))),
        Parent::Face(f) => Parent::Face(before.faces[f as usize]),
    };
    let find_vertex = |parent| {
        let lost = || format!("{parent:?} has no child with them");
        by_parent.get(&renamed(parent)).copied().ok_or_else(lost)
    };
    let find_face = |(face, &parent): (&[u32], &u32)| {
        let corner = old_corner(face, |v| Some(ours.parents[v as usize])).map(vertex);
        let lost = || format!("the child of face {parent} at {corner:?} is not with them");
        by_corner.get(&(before.faces[parent as usize], corner)).copied().ok_or_else(lost)
    };
    Ok(Correspondence {
        vertices: ours.parents.iter().map(find_vertex).collect::<Result<_>>()?,
        faces: ours.level.faces().zip(&ours.face_parents).map(find_face).collect::<Result<_>>()?,
    })
}

/// Matches level after level. `face_source` is their face for each of our control
/// faces; vertices of the control mesh have the same numbers on both sides.
///
/// # Errors
/// The first child that one side has and the other has not.
pub fn match_levels(
    control: &Ours,
    face_source: Vec<u32>,
    split: Split,
    theirs: &[Level],
) -> Result<(Ours, Correspondence)> {
    let mut at = Correspondence { vertices: (0..control.vertices).collect(), faces: face_source };
    let mut ours = control.clone();
    for level in &theirs[1..] {
        ours = ours.split(split);
        at = descend(&at, &ours, level)?;
    }
    Ok((ours, at))
}

/// Matches carvel's answer to a task with OpenSubdiv's: carvel's last level laid out
/// from the documentation, and whose vertex and face is whose.
///
/// # Errors
/// The first child that one side has and the other has not.
pub fn match_refinement(
    task: &Task,
    theirs: &Refinement,
    levels: u32,
) -> Result<(Ours, Correspondence)> {
    let split = if task.scheme == Scheme::Loop { Split::Triangle } else { Split::Quad };
    let levels = (0..=levels).map(|n| theirs.level(n)).collect::<Result<Vec<_>>>()?;
    let (control, sources) = ours::control(task.control)?;
    match_levels(&control, sources, split, &levels)
}
