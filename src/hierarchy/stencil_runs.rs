//! Where the vertices inside a face stand among all of a level.
//!
//! Each step adds vertices on edges, by first corners, and, in a quad split, in faces. The
//! corners inside a face follow each other, and so do the vertices of a step, edges and
//! faces apart: a *run*. How many stand before a run follows from the corners before the
//! face and from how many of their sides lead an edge.

use crate::base::{Result, memory};
use crate::mesh::Mesh;
use crate::refine::Pieces;
use std::ops::Range;

/// The runs of all faces of a mesh: for each step that on edges and that in faces.
pub(super) struct Runs<'a> {
    mesh: &'a Mesh,
    pieces: Pieces,
    /// The vertices before each step, and after the last.
    firsts: Vec<u32>,
    /// For every face the sides before it that lead an edge; all in the end.
    leaders: Vec<u32>,
}

/// A vertex of the last level, seen from the mesh.
#[derive(Debug, Clone, Copy)]
pub(super) enum Inside {
    /// The mesh has it.
    Old(u32),
    /// It stands in a run: of a face, which one, and at which place.
    New { face: u32, run: usize, place: u32 },
}

impl<'a> Runs<'a> {
    /// The runs of some steps, of which the vertices before each and after all are given.
    pub(super) fn new(mesh: &'a Mesh, pieces: Pieces, firsts: Vec<u32>) -> Result<Self> {
        let mut leaders = memory::reserved(mesh.faces() + 1)?;
        let mut sum = 0;
        for face in 0..mesh.layout.faces() {
            leaders.push(sum);
            sum += mesh.layout.face(face).filter(|&c| mesh.is_first_of_edge(c)).count() as u32;
        }
        leaders.push(sum);
        Ok(Self { mesh, pieces, firsts, leaders })
    }

    /// The number of runs that each face has.
    pub(super) fn count(&self) -> usize {
        2 * (self.firsts.len() - 1)
    }

    /// The sides of a face that lead an edge, a bit for each; of up to 32 sides.
    pub(super) fn leads(&self, face: u32) -> u32 {
        let corners = self.mesh.layout.face(face);
        corners.zip(0..).fold(0, |leads, (corner, side)| {
            leads | u32::from(self.mesh.is_first_of_edge(corner)) << side
        })
    }

    /// The vertices in the runs of some faces.
    pub(super) fn vertices(&self, faces: Range<u32>, run: usize) -> Range<u32> {
        self.start(faces.start, run)..self.start(faces.end, run)
    }

    /// Where the run of a face begins, or, beyond the last, where all of them end.
    fn start(&self, face: u32, run: usize) -> u32 {
        let step = run as u32 / 2;
        let first = u64::from(self.firsts[run / 2]);
        let before = if run.is_multiple_of(2) {
            self.edges_before(face, step)
        } else {
            self.edges_before(self.mesh.layout.faces(), step) + self.faces_before(face, step)
        };
        (first + before) as u32
    }

    fn corners_before(&self, face: u32) -> u64 {
        let layout = &self.mesh.layout;
        if face == layout.faces() {
            layout.corners().into()
        } else {
            layout.face(face).start.into()
        }
    }

    /// The edges, before a step, whose first corners lie in faces before one.
    fn edges_before(&self, face: u32, step: u32) -> u64 {
        let corners = self.corners_before(face);
        // Of the sides of all pieces those that lie on no side of the face come in pairs.
        let inner = ((corners << (2 * step)) - (corners << step)) / 2;
        inner + (u64::from(self.leaders[face as usize]) << step)
    }

    /// The faces, before a step, that lie in faces before one.
    fn faces_before(&self, face: u32, step: u32) -> u64 {
        match (self.pieces, step.checked_sub(1)) {
            (Pieces::Triangles, _) => 0,
            (Pieces::Quads, None) => face.into(),
            (Pieces::Quads, Some(split)) => self.corners_before(face) << (2 * split),
        }
    }

    /// What a vertex of the last level is.
    pub(super) fn find(&self, vertex: u32) -> Inside {
        let Some(step) = self.firsts.partition_point(|&first| first <= vertex).checked_sub(1)
        else {
            return Inside::Old(vertex);
        };
        let faces = self.mesh.layout.faces();
        let run = 2 * step + usize::from(self.start(faces, 2 * step) <= vertex);
        let (mut low, mut high) = (0, faces);
        while low + 1 < high {
            let middle = low.midpoint(high);
            if self.start(middle, run) <= vertex { low = middle } else { high = middle }
        }
        Inside::New { face: low, run, place: vertex - self.start(low, run) }
    }
}
