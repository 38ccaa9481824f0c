//! Twins of a soup's corners, by bucketing on the smaller vertex of each edge.
//!
//! O(H) and parallel: corners are dealt into buckets of vertices, each bucket
//! is counting-sorted by smaller vertex, and the few entries of one vertex are
//! sorted by the other end. No hash map, and no order that depends on threads.

use crate::base::{Context, NONE, Result, memory};
use std::sync::atomic::{AtomicU32, Ordering};

/// Vertices per bucket: the counting sort of one bucket stays in cache.
const BUCKET_BITS: u32 = 14;

/// An edge with more than two sides, or with two that run the same way.
#[derive(Debug)]
pub(super) struct BadEdge {
    pub(super) edge: (u32, u32),
    /// Its corners, ascending.
    pub(super) corners: Vec<u32>,
}

/// Twins and bad edges, the latter sorted by edge. Sides of bad edges have no
/// twin, which is what policy `cut` wants.
#[derive(Debug)]
pub(super) struct Pairing {
    pub(super) twin: Vec<u32>,
    pub(super) bad: Vec<BadEdge>,
}

/// One side of an edge.
#[derive(Debug, Clone, Copy, Default)]
struct Side {
    low: u32,
    high: u32,
    corner: u32,
}

/// Pairs the corners of a soup. `vert` is the face-vertex array and `next` the
/// successor of a corner within its face.
pub(super) fn pair(
    context: &Context,
    vertices: usize,
    vert: &[u32],
    next: impl Fn(u32) -> u32 + Sync,
) -> Result<Pairing> {
    let buckets = (vertices >> BUCKET_BITS) + 1;
    let dealt = context.map(context.chunks(vert.len()), |range| {
        let sides = range.map(|c| c as u32).map(|corner| {
            let (a, b) = (vert[corner as usize], vert[next(corner) as usize]);
            Side { low: a.min(b), high: a.max(b), corner }
        });
        deal(sides, buckets)
    })?;
    let dealt = dealt.into_iter().collect::<Result<Vec<_>>>()?;
    let twin = memory::collect((0..vert.len()).map(|_| AtomicU32::new(NONE)))?;
    let bad = context.map((0..buckets).collect(), |bucket| {
        let parts: Vec<&[Side]> = dealt.iter().map(|d| d.bucket(bucket)).collect();
        let first = bucket << BUCKET_BITS;
        // Small meshes do not pay for a whole bucket.
        let len = (vertices - first).min(1 << BUCKET_BITS);
        let (sides, bounds) = sort_bucket(&parts, first as u32, len)?;
        let mut bad = Vec::new();
        for pair in bounds.windows(2) {
            match_vertex(&sides[pair[0] as usize..pair[1] as usize], vert, &twin, &mut bad)?;
        }
        Ok(bad)
    })?;
    let bad = bad.into_iter().collect::<Result<Vec<_>>>()?;
    // Each entry is stored by one thread only; the atomics make the scatter safe.
    let twin = twin.into_iter().map(AtomicU32::into_inner).collect();
    Ok(Pairing { twin, bad: memory::collect(bad.into_iter().flatten())? })
}

/// The sides of one chunk of corners, grouped by bucket.
struct Dealt {
    sides: Vec<Side>,
    bounds: Vec<u32>,
}

impl Dealt {
    fn bucket(&self, i: usize) -> &[Side] {
        &self.sides[self.bounds[i] as usize..self.bounds[i + 1] as usize]
    }
}

fn deal(sides: impl Iterator<Item = Side> + Clone, buckets: usize) -> Result<Dealt> {
    let mut bounds = memory::zeroed(buckets + 1)?;
    let bucket = |side: &Side| (side.low >> BUCKET_BITS) as usize;
    for side in sides.clone() {
        bounds[bucket(&side) + 1] += 1;
    }
    accumulate(&mut bounds);
    let mut place = memory::copied(&bounds)?;
    let mut dealt = memory::filled(Side::default(), bounds[buckets] as usize)?;
    for side in sides {
        let at = &mut place[bucket(&side)];
        dealt[*at as usize] = side;
        *at += 1;
    }
    Ok(Dealt { sides: dealt, bounds })
}

/// Sorts the bucket of `len` vertices from `first` on by (low, high, corner); also
/// returns the bounds per `low`.
fn sort_bucket(parts: &[&[Side]], first: u32, len: usize) -> Result<(Vec<Side>, Vec<u32>)> {
    let mut bounds = memory::zeroed(len + 1)?;
    let sides = || parts.iter().flat_map(|part| part.iter());
    for side in sides() {
        bounds[(side.low - first) as usize + 1] += 1;
    }
    accumulate(&mut bounds);
    let mut place = memory::copied(&bounds)?;
    let sides_in_all = parts.iter().map(|part| part.len()).sum();
    let mut sorted = memory::filled(Side::default(), sides_in_all)?;
    for side in sides() {
        let at = &mut place[(side.low - first) as usize];
        sorted[*at as usize] = *side;
        *at += 1;
    }
    for pair in bounds.windows(2) {
        sorted[pair[0] as usize..pair[1] as usize]
            .sort_unstable_by_key(|side| (side.high, side.corner));
    }
    Ok((sorted, bounds))
}

fn accumulate(counts: &mut [u32]) {
    let mut sum = 0;
    for count in counts {
        sum += *count;
        *count = sum;
    }
}

/// Pairs the sides that share their smaller vertex.
fn match_vertex(
    sides: &[Side],
    vert: &[u32],
    twin: &[AtomicU32],
    bad: &mut Vec<BadEdge>,
) -> Result<()> {
    for edge in sides.chunk_by(|a, b| a.high == b.high) {
        let forward = |side: &Side| vert[side.corner as usize] == side.low;
        match edge {
            [_] => {}
            [a, b] if forward(a) != forward(b) => {
                twin[a.corner as usize].store(b.corner, Ordering::Relaxed);
                twin[b.corner as usize].store(a.corner, Ordering::Relaxed);
            }
            _ => {
                let corners = memory::collect(edge.iter().map(|side| side.corner))?;
                memory::extend(bad, [BadEdge { edge: (edge[0].low, edge[0].high), corners }])?;
            }
        }
    }
    Ok(())
}
