//! The edges of a mesh, numbered by their first corners.

use crate::base::{Context, NONE, Result, memory};
use crate::mesh::Mesh;
use std::ops::Range;
use std::sync::atomic::{AtomicU32, Ordering};

/// The number of every corner's outgoing edge.
#[derive(Debug)]
pub(crate) struct EdgeNumbers {
    pub(crate) of_corner: Vec<u32>,
    /// Runs of whole faces, in order, and the edges that their corners lead.
    pub(crate) chunks: Vec<EdgeChunk>,
}

/// A run of corners and the edges whose first corners are among them.
#[derive(Debug, Clone)]
pub(crate) struct EdgeChunk {
    pub(crate) corners: Range<u32>,
    pub(crate) edges: Range<u32>,
}

impl EdgeNumbers {
    /// Numbers the edges in the memory given.
    pub(crate) fn new(context: &Context, mesh: &Mesh, memory: &mut Vec<u32>) -> Result<Self> {
        let mut of_corner = std::mem::take(memory);
        memory::resize(&mut of_corner, mesh.corners())?;
        let runs = runs(context, mesh);
        if context.threads() > 1 && runs.len() > 1 {
            return in_parallel(context, mesh, of_corner, runs);
        }
        let mut next = 0;
        let mut chunks = memory::reserved(runs.len())?;
        for corners in runs {
            let first = next;
            if mesh.joints.sides.is_empty() {
                next = number(&mesh.twin, corners.clone(), first, &mut of_corner);
            } else {
                for c in corners.clone() {
                    let leader = mesh.first_of_edge(c);
                    of_corner[c as usize] =
                        if leader == c { next } else { of_corner[leader as usize] };
                    next += u32::from(leader == c);
                }
            }
            chunks.push(EdgeChunk { corners, edges: first..next });
        }
        Ok(Self { of_corner, chunks })
    }

    /// The number of edges.
    pub(crate) fn count(&self) -> u32 {
        self.chunks.last().map_or(0, |chunk| chunk.edges.end)
    }
}

/// Numbers the edges of a run of corners. Which corner is the first is hard to foresee,
/// so there is no branch: a guess is stored and read back from the first corner.
fn number(twin: &[u32], corners: Range<u32>, mut next: u32, of_corner: &mut [u32]) -> u32 {
    for c in corners {
        let first = c.min(twin[c as usize]);
        of_corner[c as usize] = next;
        of_corner[c as usize] = of_corner[first as usize];
        next += u32::from(first == c);
    }
    next
}

/// Whole faces: irregular ones together, the others as the context cuts them.
fn runs(context: &Context, mesh: &Mesh) -> Vec<Range<u32>> {
    let layout = &mesh.layout;
    let (irregular, side) = (layout.irregular_corners(), layout.side());
    let regular = (layout.corners() - irregular) / side;
    let at = |face: usize| irregular + side * face as u32;
    let regular = context.chunks(regular as usize).into_iter().map(|r| at(r.start)..at(r.end));
    std::iter::once(0..irregular).chain(regular).filter(|run| !run.is_empty()).collect()
}

/// Counts first, then every first corner stores its number for both sides: each
/// entry is written once, the atomics only make the scatter safe.
fn in_parallel(
    context: &Context,
    mesh: &Mesh,
    memory: Vec<u32>,
    runs: Vec<Range<u32>>,
) -> Result<EdgeNumbers> {
    let counts = context
        .map(runs.clone(), |run| run.filter(|&c| mesh.is_first_of_edge(c)).count() as u32)?;
    let mut next = 0;
    let chunks: Vec<_> = runs
        .into_iter()
        .zip(counts)
        .map(|(corners, n)| {
            next += n;
            EdgeChunk { corners, edges: next - n..next }
        })
        .collect();
    let of_corner: Vec<AtomicU32> = memory.into_iter().map(AtomicU32::new).collect();
    context.for_each(chunks.clone(), |chunk| {
        let leaders = chunk.corners.filter(|&c| mesh.is_first_of_edge(c));
        for (edge, c) in chunk.edges.zip(leaders) {
            of_corner[c as usize].store(edge, Ordering::Relaxed);
            let twin = mesh.twin[c as usize];
            if twin != NONE {
                of_corner[twin as usize].store(edge, Ordering::Relaxed);
            }
        }
    })?;
    let mut of_corner: Vec<u32> = of_corner.into_iter().map(AtomicU32::into_inner).collect();
    for &(c, leader) in &mesh.joints.sides {
        of_corner[c as usize] = of_corner[leader as usize];
    }
    Ok(EdgeNumbers { of_corner, chunks })
}
