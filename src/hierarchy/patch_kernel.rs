//! The inner loops of patches: one face, refined a few times in its own small arrays.
//!
//! The array of a level holds the patch and a ring of one more cell. Everything in it is
//! refined as if it were regular; what that makes wrong beside an extraordinary corner, three
//! places, is written again from [`FanValues`]. The rules are those of `primal_kernel`,
//! which add in an order that does not depend on where one starts, so that both
//! give the same bits.

use super::kernel::{Value, narrow, widen};
use super::patch_fan_values::FanValues;
use super::primal_kernel::{face_mean, mix_edge, mix_vertex, regular_sum, weights};
use crate::base::{Result, Scalar};
use crate::mesh::{prev_in_triangle, turn_in_quad};
use crate::refine::{PatchArray, Patches, Pieces, patch_array, within};
use crate::scheme::SmoothMasks;

/// The weights of the regular rules.
#[derive(Clone, Copy)]
struct Rules<T> {
    edge: [T; 2],
    vertex: [T; 3],
}

/// Refines patches, one after the other.
pub(super) struct PatchKernel<'v, T: Scalar, const W: usize> {
    patches: &'v Patches<'v>,
    values: &'v [Value<T, W>],
    fans: &'v FanValues<T>,
    rules: Rules<T>,
    linear: bool,
    /// The arrays of this level and of the next.
    from: PatchArray<T::Lanes>,
    to: PatchArray<T::Lanes>,
}

impl<'v, T: Scalar, const W: usize> PatchKernel<'v, T, W> {
    pub(super) fn new(
        patches: &'v Patches<'v>,
        masks: &SmoothMasks<f64>,
        values: &'v [Value<T, W>],
        fans: &'v FanValues<T>,
    ) -> Result<Self> {
        let mut masks = masks.clone();
        let edge = masks.edge(0);
        let rules = Rules {
            edge: [edge.end, edge.beside].map(T::from_f64),
            vertex: weights(&masks.vertex(patches.pieces().valence())),
        };
        let zero = T::lanes([T::default(); 4]);
        let (from, to) = (patch_array(zero)?, patch_array(zero)?);
        Ok(Self { patches, values, fans, rules, linear: masks.is_linear(), from, to })
    }

    /// Writes what a patch leads, from the front of each run, and its corners.
    pub(super) fn run(
        &mut self,
        patch: usize,
        corners: &mut [Value<T, W>],
        runs: &mut [&mut [Value<T, W>]],
    ) {
        let depth = self.patches.depth();
        self.gather(patch);
        let odd = self.extraordinary(patch);
        for level in 0..depth {
            self.refine(1 << level, level + 1 < depth);
            std::mem::swap(&mut self.from, &mut self.to);
            if odd != 0 {
                self.mend(patch, odd, level);
            }
        }
        let (frame, order) = (self.patches.tables().frame(depth), self.patches.order(patch));
        for (slot, &index) in corners.iter_mut().zip(&frame.own) {
            *slot = narrow::<T, W>(self.from[within(index)]);
        }
        for (level, runs) in runs.chunks_exact_mut(2).enumerate() {
            for (run, indices) in
                runs.iter_mut().zip([order.on_edges(level), order.in_faces(level)])
            {
                let (mine, later) = std::mem::take(run).split_at_mut(indices.len());
                write::<T, W>(&self.from, indices, mine);
                *run = later;
            }
        }
    }

    /// The patch of level 0 and what is around it.
    #[inline(always)]
    fn gather(&mut self, patch: usize) {
        match self.patches.pieces() {
            Pieces::Quads => self.gather_quads(patch),
            Pieces::Triangles => self.gather_triangles(patch),
        }
    }

    /// The face across an edge has two of the neighbours outside the patch, one at each end
    /// of the edge; what lies beyond a corner is across one edge more.
    fn gather_quads(&mut self, patch: usize) {
        let (mesh, frame) = (self.patches.parent(), self.patches.tables().frame(0));
        let faces = mesh.vert.as_chunks::<4>().0;
        let value = |v: u32| widen::<T, W>(&self.values[v as usize]);
        for (&index, &v) in frame.own.iter().zip(&faces[patch]) {
            self.from[within(index)] = value(v);
        }
        if self.linear {
            return;
        }
        for (i, &twin) in mesh.twin.as_chunks::<4>().0[patch].iter().enumerate() {
            let at = |corner: u32, by| {
                let face = faces[corner as usize / 4];
                face[(corner as usize + by) % 4]
            };
            let next = (i + 1) % 4;
            self.from[within(frame.before[i])] = value(at(twin, 2));
            self.from[within(frame.second[next])] = value(at(twin, 3));
            // Meaningless beyond an extraordinary corner, which is mended.
            let beyond = mesh.twin[turn_in_quad(0, twin, 3) as usize];
            self.from[within(frame.beyond[next][0])] = value(at(beyond, 2));
        }
    }

    /// The triangle across an edge has one of the neighbours outside the patch; two more at each
    /// corner are in the next two triangles around it.
    fn gather_triangles(&mut self, patch: usize) {
        let (mesh, frame) = (self.patches.parent(), self.patches.tables().frame(0));
        let value = |corner: u32| widen::<T, W>(&self.values[mesh.vert[corner as usize] as usize]);
        for (&index, corner) in frame.own.iter().zip(3 * patch as u32..).take(3) {
            self.from[within(index)] = value(corner);
        }
        if self.linear {
            return;
        }
        for (i, &twin) in mesh.twin.as_chunks::<3>().0[patch].iter().enumerate() {
            let [near, far] = frame.beyond[(i + 1) % 3].map(within);
            let apex = prev_in_triangle(twin);
            self.from[within(frame.before[i])] = value(apex);
            // Meaningless beyond an extraordinary corner, which is mended.
            let third = prev_in_triangle(mesh.twin[apex as usize]);
            self.from[near] = value(third);
            self.from[far] = value(prev_in_triangle(mesh.twin[third as usize]));
        }
    }

    /// One step of the whole array; of its ring only if it is needed.
    fn refine(&mut self, cells: usize, ring: bool) {
        // With the size known, no index needs a check.
        match cells {
            1 => self.refine_cells::<1>(ring),
            2 => self.refine_cells::<2>(ring),
            4 => self.refine_cells::<4>(ring),
            8 => self.refine_cells::<8>(ring),
            _ => self.refine_cells::<16>(ring),
        }
    }

    fn refine_cells<const N: usize>(&mut self, ring: bool) {
        let (from, to) = (&self.from[..], &mut self.to[..]);
        match (self.patches.pieces(), self.linear) {
            (Pieces::Quads, false) if ring => refine_quads::<T, N, true>(self.rules, from, to),
            (Pieces::Quads, false) => refine_quads::<T, N, false>(self.rules, from, to),
            (Pieces::Quads, true) => bisect_quads::<T, N>(self.rules, from, to),
            (Pieces::Triangles, true) => bisect_triangles::<T, N>(self.rules, from, to),
            (Pieces::Triangles, _) if ring => refine_triangles::<T, N, true>(self.rules, from, to),
            (Pieces::Triangles, _) => refine_triangles::<T, N, false>(self.rules, from, to),
        }
    }

    /// The corners of a patch that are extraordinary, one bit each.
    #[inline(always)]
    fn extraordinary(&self, patch: usize) -> u8 {
        let (fans, sides) = (&self.patches.fans, self.patches.pieces().sides() as usize);
        if self.linear || fans.vertices().is_empty() {
            return 0;
        }
        let corners = &self.patches.parent().vert[patch * sides..][..sides];
        let bit = |(i, &v): (usize, &u32)| u8::from(fans.contains(v)) << i;
        corners.iter().enumerate().map(bit).sum()
    }

    /// Writes the extraordinary corners and their neighbours that the patch does not contain.
    #[inline(never)]
    fn mend(&mut self, patch: usize, odd: u8, level: u32) {
        let (patches, fans) = (self.patches, &self.patches.fans);
        let frame = patches.tables().frame(level + 1);
        let sides = patches.pieces().sides() as usize;
        for i in (0..sides).filter(|i| odd >> i & 1 == 1) {
            let slot = fans.slot((patch * sides + i) as u32);
            let level = level as usize;
            self.from[within(frame.own[i])] = self.fans.own(level, fans.owner(slot));
            self.from[within(frame.second[i])] = self.fans.near(level, fans.turn(slot, 2));
            self.from[within(frame.before[i])] = self.fans.near(level, fans.back(slot));
        }
    }
}

/// Writes the values at some places of an array, one after the other. Four lanes are one
/// store, so a record is followed by a lane too much where another one overwrites it.
#[inline(always)]
fn write<T: Scalar, const W: usize>(
    array: &PatchArray<T::Lanes>,
    indices: &[u16],
    out: &mut [Value<T, W>],
) {
    const BLOCK: usize = 8;
    let (blocks, rest) = out.as_chunks_mut::<BLOCK>();
    let (places, last) = indices.as_chunks::<BLOCK>();
    for (block, places) in blocks.iter_mut().zip(places) {
        let block = block.as_flattened_mut();
        for (i, &index) in places.iter().enumerate() {
            let lanes = T::unlaned(array[within(index)]);
            let length = if W * i + 4 <= W * BLOCK { 4 } else { W };
            block[W * i..][..length].copy_from_slice(&lanes[..length]);
        }
    }
    for (slot, &index) in rest.iter_mut().zip(last) {
        *slot = narrow::<T, W>(array[within(index)]);
    }
}

/// A row of an array with `N` cells along a side.
#[inline(always)]
fn row<L>(array: &[L], y: usize, wide: usize) -> &[L] {
    &array[y * wide..(y + 1) * wide]
}

/// One step of Catmull–Clark on an array of N by N cells and its ring. Faces come first: new
/// places with two even indices; then edges and old vertices, row by row.
#[inline(never)]
fn refine_quads<T: Scalar, const N: usize, const RING: bool>(
    rules: Rules<T>,
    from: &[T::Lanes],
    to: &mut [T::Lanes],
) {
    let (wide, new) = (N + 3, 2 * N + 3);
    let (from, to) = (&from[..wide * wide], &mut to[..new * new]);
    let skip = usize::from(!RING);
    for y in 0..N + 2 {
        let (low, high) = (row(from, y, wide), row(from, y + 1, wide));
        let out = &mut to[2 * y * new..(2 * y + 1) * new];
        for x in 0..N + 2 {
            out[2 * x] = face_mean::<T, _>([low[x], low[x + 1], high[x + 1], high[x]]);
        }
    }
    for y in 1..N + 2 {
        let (below, own) = (row(from, y - 1, wide), row(from, y, wide));
        let above = row(from, y + 1, wide);
        let rows = &mut to[2 * (y - 1) * new..(2 * y + 1) * new];
        let (done, rest) = rows.split_at_mut(new);
        let (out, next) = rest.split_at_mut(new);
        for x in skip..N + 2 - skip {
            let sides = [done[2 * x], next[2 * x]];
            out[2 * x] = mix_edge(rules.edge, [own[x], own[x + 1]], sides);
        }
        for x in 1..N + 2 {
            let near = regular_sum([own[x - 1], below[x], own[x + 1], above[x]]);
            let (left, right) = (2 * x - 2, 2 * x);
            let faces = regular_sum([done[left], done[right], next[right], next[left]]);
            out[2 * x - 1] = mix_vertex(rules.vertex, own[x], near, faces);
        }
    }
    for y in skip..N + 2 - skip {
        let (low, high) = (row(from, y, wide), row(from, y + 1, wide));
        let out = &mut to[2 * y * new..(2 * y + 1) * new];
        for x in 1..N + 2 {
            let sides = [out[2 * x - 2], out[2 * x]];
            out[2 * x - 1] = mix_edge(rules.edge, [low[x], high[x]], sides);
        }
    }
}

/// One linear step; the ring is left alone.
#[inline(never)]
fn bisect_quads<T: Scalar, const N: usize>(
    rules: Rules<T>,
    from: &[T::Lanes],
    to: &mut [T::Lanes],
) {
    let (wide, new) = (N + 3, 2 * N + 3);
    let (from, to) = (&from[..wide * wide], &mut to[..new * new]);
    let (half, end) = (rules.edge[0], N + 1);
    for y in 1..N + 2 {
        let own = row(from, y, wide);
        let out = &mut to[(2 * y - 1) * new..2 * y * new];
        for x in 1..N + 2 {
            out[2 * x - 1] = own[x];
        }
        for x in 1..end {
            out[2 * x] = (own[x] + own[x + 1]) * half;
        }
    }
    for y in 1..end {
        let (low, high) = (row(from, y, wide), row(from, y + 1, wide));
        let out = &mut to[2 * y * new..(2 * y + 1) * new];
        for x in 1..N + 2 {
            out[2 * x - 1] = (low[x] + high[x]) * half;
        }
        for x in 1..end {
            out[2 * x] = face_mean::<T, _>([low[x], low[x + 1], high[x + 1], high[x]]);
        }
    }
}

/// One linear step on half an array; the ring is left alone.
#[inline(never)]
fn bisect_triangles<T: Scalar, const N: usize>(
    rules: Rules<T>,
    from: &[T::Lanes],
    to: &mut [T::Lanes],
) {
    let (wide, new) = (N + 3, 2 * N + 3);
    let (from, to) = (&from[..wide * wide], &mut to[..new * new]);
    let (half, end) = (rules.edge[0], N + 1);
    for y in 1..N + 2 {
        let own = row(from, y, wide);
        let out = &mut to[(2 * y - 1) * new..2 * y * new];
        for x in 1..=N + 2 - y {
            out[2 * x - 1] = own[x];
        }
        for x in 1..=end - y {
            out[2 * x] = (own[x] + own[x + 1]) * half;
        }
    }
    for y in 1..end {
        let (low, high) = (row(from, y, wide), row(from, y + 1, wide));
        let out = &mut to[2 * y * new..(2 * y + 1) * new];
        for x in 1..=end - y {
            out[2 * x - 1] = (low[x] + high[x]) * half;
            out[2 * x] = (low[x + 1] + high[x]) * half;
        }
    }
}

/// One step of Loop on half an array of N by N cells and its ring. Index 1 is the first
/// place that is not in the ring, x + y ≤ N + 2 is inside.
#[inline(never)]
fn refine_triangles<T: Scalar, const N: usize, const RING: bool>(
    rules: Rules<T>,
    from: &[T::Lanes],
    to: &mut [T::Lanes],
) {
    let (wide, new) = (N + 3, 2 * N + 3);
    let (from, to) = (&from[..wide * wide], &mut to[..new * new]);
    let skip = usize::from(!RING);
    let zero = T::lanes([T::default(); 4]);
    for y in 1..N + 2 {
        let (below, own) = (row(from, y - 1, wide), row(from, y, wide));
        let above = row(from, y + 1, wide);
        let out = &mut to[(2 * y - 1) * new..2 * y * new];
        for x in 1..=N + 2 - y {
            let ends = [own[x + 1], above[x], above[x - 1], own[x - 1], below[x], below[x + 1]];
            let near = regular_sum(ends);
            out[2 * x - 1] = mix_vertex(rules.vertex, own[x], near, zero);
        }
        for x in skip..=N + 2 - y - skip {
            let sides = [above[x], below[x + 1]];
            out[2 * x] = mix_edge(rules.edge, [own[x], own[x + 1]], sides);
        }
    }
    for y in skip..N + 2 - skip {
        let (low, high) = (row(from, y, wide), row(from, y + 1, wide));
        let out = &mut to[2 * y * new..(2 * y + 1) * new];
        // The ring below the patch is one place shorter than a row of the patch would be.
        for x in 1..=N + 2 - y.max(1) {
            let sides = [high[x - 1], low[x + 1]];
            out[2 * x - 1] = mix_edge(rules.edge, [low[x], high[x]], sides);
        }
        let first = if y == 0 { 1 } else { skip };
        for x in first..N + 2 - y {
            let sides = [low[x], high[x + 1]];
            out[2 * x] = mix_edge(rules.edge, [low[x + 1], high[x]], sides);
        }
    }
}
