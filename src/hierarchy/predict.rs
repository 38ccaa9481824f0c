//! What a refinement will cost, before anything is built.

use crate::base::{Error, ErrorKind, Result};
use crate::mesh::Mesh;
use crate::refine::Counts;
use crate::scheme::Scheme;

/// The largest number of levels, for meshes that do not grow out of bounds
/// before: a lone triangle without boundary rule stays one.
const MOST_LEVELS: u32 = 64;

/// The sizes of every level of a refinement, and the memory it needs.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Prediction {
    levels: Vec<Counts>,
    passes: usize,
}

impl Prediction {
    /// Predicts levels 0 to `levels` of a mesh under a scheme. Costs one look
    /// at the boundary and the irregular vertices.
    ///
    /// # Errors
    /// [`ErrorKind::TooLarge`] if a count leaves 64 bits, or for more than 64
    /// levels.
    pub fn new(mesh: &Mesh, scheme: &Scheme, levels: u32) -> Result<Self> {
        if levels > MOST_LEVELS {
            return Err(Error::new(
                ErrorKind::TooLarge,
                format!("{levels} levels: the limit is {MOST_LEVELS}"),
            ));
        }
        let mut counts = vec![Counts::of(mesh)];
        for level in 0..levels {
            let last = counts[level as usize];
            let next = match level {
                0 => scheme.anchor(mesh).split_counts(mesh),
                _ => last.plain(),
            };
            counts.push(next.ok_or_else(|| {
                Error::new(
                    ErrorKind::TooLarge,
                    format!("level {} has more elements than 64 bits can count", level + 1),
                )
            })?);
        }
        Ok(Self { levels: counts, passes: scheme.passes().len() })
    }

    /// The counts of a level.
    ///
    /// # Panics
    /// If `level` is beyond the levels predicted.
    pub fn counts(&self, level: u32) -> &Counts {
        &self.levels[level as usize]
    }

    /// The counts of all levels, the control mesh first.
    pub fn levels(&self) -> &[Counts] {
        &self.levels
    }

    /// The counts of the last level.
    pub fn last(&self) -> &Counts {
        // Level 0 is always there.
        &self.levels[self.levels.len() - 1]
    }

    /// Bytes of the adjacency of all levels but the first.
    pub fn topology_bytes(&self) -> u64 {
        self.levels.iter().skip(1).map(topology_bytes).sum()
    }

    /// Bytes of the last level's faces and of `width` values of `size` bytes on
    /// each of its vertices.
    pub fn output_bytes(&self, width: u64, size: u64) -> u64 {
        let last = self.last();
        let values = last.vertices.saturating_mul(width).saturating_mul(size);
        values.saturating_add(4 * (last.corners + last.faces))
    }

    /// Bytes that the levels in between need while the last one is written:
    /// topology, and values of `width` columns of `size` bytes each.
    pub fn scratch_bytes(&self, width: u64, size: u64) -> u64 {
        let inner = &self.levels[..self.levels.len() - 1];
        let topology: u64 = inner.iter().skip(1).map(topology_bytes).sum();
        // Edge numbers and places of vertex faces, of the levels that get a child mesh.
        let links: u64 = inner.iter().rev().skip(1).map(|c| 4 * (c.corners + c.vertices)).sum();
        let values: u64 =
            inner.iter().map(|c| c.vertices).sum::<u64>().saturating_mul(width * size);
        let stages: u64 = match self.passes {
            0 => 0,
            1 => inner.iter().map(|c| irregular_bytes(c, width, size)).max().unwrap_or(0),
            _ => {
                let irregular = inner.iter().map(|c| irregular_bytes(c, width, size)).max();
                irregular.unwrap_or(0) + self.last().vertices * width.min(4) * size
            }
        };
        topology + links + values + stages
    }
}

fn topology_bytes(counts: &Counts) -> u64 {
    // Offsets and the reverse map of irregular faces, their vertices, the rim.
    let irregular = 8 * counts.irregular_corners + 8 * counts.irregular_faces;
    8 * counts.corners + 4 * counts.vertices + irregular + 12 * counts.boundary_edges
}

fn irregular_bytes(counts: &Counts, width: u64, size: u64) -> u64 {
    counts.stored_corners() * width.min(4) * size
}
