//! The edges of a mesh, numbered by their first corners.

use crate::base::{Context, NONE, Result, memory};
use crate::mesh::Mesh;
use std::ops::Range;
use std::sync::atomic::{AtomicU32, Ordering};

/// The number of every corner's outgoing edge, and the first corner of every edge.
#[derive(Debug, Default)]
pub(crate) struct EdgeNumbers {
    pub(crate) of_corner: Vec<u32>,
    pub(crate) first: Vec<u32>,
}

impl EdgeNumbers {
    /// Numbers the edges, in memory that held other numbers.
    pub(crate) fn new(context: &Context, mesh: &Mesh, memory: &mut Self) -> Result<Self> {
        let mut numbers = std::mem::take(memory);
        memory::resize(&mut numbers.of_corner, mesh.corners())?;
        memory::resize(&mut numbers.first, mesh.edges())?;
        let runs = runs(context, mesh);
        if context.threads() > 1 && runs.len() > 1 {
            return in_parallel(context, mesh, numbers, runs);
        }
        if mesh.joints.sides.is_empty() {
            number(&mesh.twin, &mut numbers);
        } else {
            number_joined(mesh, &mut numbers);
        }
        Ok(numbers)
    }

    /// The number of edges.
    pub(crate) fn count(&self) -> u32 {
        self.first.len() as u32
    }

    /// Bytes held.
    pub(crate) fn bytes(&self) -> u64 {
        4 * (self.of_corner.capacity() + self.first.capacity()) as u64
    }
}

/// Which corner is the first is hard to foresee, so there is no branch: both numbers are
/// at hand and one is chosen.
fn number(twin: &[u32], numbers: &mut EdgeNumbers) {
    let EdgeNumbers { of_corner, first } = numbers;
    let mut next = 0;
    for (c, &twin) in (0..).zip(twin) {
        let leader = c.min(twin);
        let seen = of_corner[leader as usize];
        of_corner[c as usize] = if leader == c { next } else { seen };
        // Past the last edge the guess is wrong and has no place.
        if let Some(slot) = first.get_mut(next as usize) {
            *slot = c;
        }
        next += u32::from(leader == c);
    }
}

fn number_joined(mesh: &Mesh, numbers: &mut EdgeNumbers) {
    let mut next = 0;
    for c in 0..mesh.layout.corners() {
        let leader = mesh.first_of_edge(c);
        if leader == c {
            numbers.of_corner[c as usize] = next;
            numbers.first[next as usize] = c;
            next += 1;
        } else {
            numbers.of_corner[c as usize] = numbers.of_corner[leader as usize];
        }
    }
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
    numbers: EdgeNumbers,
    runs: Vec<Range<u32>>,
) -> Result<EdgeNumbers> {
    let leaders = |run: Range<u32>| run.filter(|&c| mesh.is_first_of_edge(c));
    let counts = context.map(runs.clone(), |run| leaders(run).count())?;
    let EdgeNumbers { of_corner, mut first } = numbers;
    let of_corner: Vec<AtomicU32> = of_corner.into_iter().map(AtomicU32::new).collect();
    let mut parts = memory::reserved(runs.len())?;
    let (mut rest, mut next) = (&mut first[..], 0);
    for (run, count) in runs.into_iter().zip(counts) {
        let (part, later) = rest.split_at_mut(count);
        parts.push((run, next, part));
        (rest, next) = (later, next + count as u32);
    }
    context.for_each(parts, |(run, next, first)| {
        for ((edge, slot), c) in (next..).zip(first).zip(leaders(run)) {
            *slot = c;
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
    Ok(EdgeNumbers { of_corner, first })
}
