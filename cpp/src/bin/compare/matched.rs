//! OpenSubdiv's refinement beside carvel's, matched level by level.

use carvel::Refined;
use carvel_peers::lineage::match_refinement;
use carvel_peers::normalise::Correspondence;
use carvel_peers::{Comparison, OpenSubdiv, PeerMesh, Task};

/// Both last levels, and which vertex and face is which.
pub struct Matched {
    ours: PeerMesh,
    theirs: PeerMesh,
    at: Correspondence,
    /// Our faces are in the documented numbering.
    as_documented: bool,
}

impl Matched {
    /// Refines by OpenSubdiv and matches.
    pub fn new(task: &Task, level: u32, ours: PeerMesh) -> Result<Self, String> {
        let refinement = OpenSubdiv.refinement(task, level)?;
        let (laid, at) = match_refinement(task, &refinement, level)?;
        let as_documented = laid.level.indices == ours.indices;
        Ok(Self { ours, theirs: refinement.mesh()?, at, as_documented })
    }

    /// Compares the answers.
    pub fn compare(&self) -> Comparison {
        let mut comparison = Comparison::of(&self.ours, &self.theirs, &self.at);
        comparison.same_faces &= self.as_documented;
        comparison
    }

    /// Compares positions that were computed otherwise on the same faces.
    pub fn compare_positions(&mut self, ours: &[f32], theirs: Vec<f64>) -> Comparison {
        self.ours.positions = doubles(ours);
        self.theirs.positions = theirs;
        self.compare()
    }
}

/// carvel's answer as a peer's.
pub fn mesh(refined: &Refined<f32>) -> PeerMesh {
    PeerMesh {
        sizes: refined.face_sizes.clone(),
        indices: refined.face_vertices.clone(),
        positions: doubles(&refined.positions),
    }
}

fn doubles(values: &[f32]) -> Vec<f64> {
    values.iter().map(|&x| f64::from(x)).collect()
}
