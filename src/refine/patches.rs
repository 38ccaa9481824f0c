//! Several primal splits at once, face by face.
//!
//! Each face of a closed mesh of quads or triangles is a patch: refined a few times it is a
//! grid that fits a first-level cache, and no mesh in between exists. The numbering is
//! that of one split after the other (`primal_split`): old vertices, then for each level what
//! it adds on edges and in faces. Within such a run the patches follow each other, since
//! the children of a face do, so that every vertex has a place by arithmetic and patches
//! share nothing that is written.

use super::counts::Counts;
use super::patch_fans::PatchFans;
use super::patch_grid::{PatchArray, patch_array, within};
use super::patch_tables::{Led, PatchOrder, PatchTables};
use super::primal_split::{family_of_quad, family_of_triangle};
use super::{Pieces, PrimalSplit};
use crate::base::{Context, Error, ErrorKind, Result, memory};
use crate::mesh::Mesh;
use std::ops::Range;

/// Some primal splits of a mesh, planned together.
#[derive(Debug)]
pub(crate) struct Patches<'a> {
    parent: &'a Mesh,
    pieces: Pieces,
    depth: u32,
    pub(crate) counts: Counts,
    pub(crate) fans: PatchFans,
    tables: PatchTables,
    /// The sides that each patch leads.
    led: Vec<Led>,
    /// How many sides the patches before each lead, and all at the end.
    before: Vec<u32>,
    /// The first vertex of what each level adds on edges and in faces, and their number.
    runs: Vec<u32>,
}

impl<'a> Patches<'a> {
    /// True if a mesh can be refined this way once its faces are regular: closed and without
    /// sharp features. No face is its own neighbour, since none repeats a vertex.
    pub(crate) fn fit(mesh: &Mesh) -> bool {
        mesh.rim.is_empty() && mesh.joints.is_empty() && mesh.sharpness.is_empty()
    }

    /// Plans `depth` splits of a mesh that fits and has no other faces than the pieces;
    /// `linear` if no value will follow other rules.
    ///
    /// # Errors
    /// [`ErrorKind::TooLarge`] if the children do not fit the index type.
    pub(crate) fn new(
        context: &Context,
        parent: &'a Mesh,
        (pieces, depth): (Pieces, u32),
        linear: bool,
    ) -> Result<Self> {
        let side = pieces.sides();
        debug_assert!(Self::fit(parent) && parent.corners() == side as usize * parent.faces());
        let mut counts = Counts::sizes_of(parent);
        let mut runs = memory::collect([parent.vertices() as u32])?;
        for _ in 0..depth {
            let (edges, vertices) = (counts.edges, counts.vertices);
            counts = PrimalSplit::split_counts(&counts, pieces)
                .ok_or_else(|| Error::new(ErrorKind::TooLarge, "the split exceeds 64-bit sizes"))?;
            counts.check_index_type()?;
            memory::extend(&mut runs, [(vertices + edges) as u32, counts.vertices as u32])?;
        }
        let mut led = memory::reserved(parent.faces())?;
        let mut before = memory::reserved(parent.faces() + 1)?;
        let (mut kinds, mut sum) = ([false; 16], 0);
        for (corner, twins) in (0..).step_by(side as usize).zip(parent.twin.chunks(side as usize)) {
            let first = |(i, &twin): (u32, &u32)| Led::from(corner < twin) << i;
            let sides = (0..).zip(twins).map(first).sum::<Led>();
            kinds[sides as usize] = true;
            led.push(sides);
            before.push(sum);
            sum += sides.count_ones();
        }
        before.push(sum);
        let tables = PatchTables::new(pieces, depth, kinds)?;
        context.check_cancelled()?;
        let fans =
            if linear { PatchFans::none() } else { PatchFans::new(context, parent, pieces)? };
        Ok(Self { parent, pieces, depth, counts, fans, tables, led, before, runs })
    }

    pub(crate) fn parent(&self) -> &'a Mesh {
        self.parent
    }

    pub(crate) fn pieces(&self) -> Pieces {
        self.pieces
    }

    pub(crate) fn depth(&self) -> u32 {
        self.depth
    }

    pub(crate) fn tables(&self) -> &PatchTables {
        &self.tables
    }

    /// The order of what a patch leads.
    #[inline(always)]
    pub(crate) fn order(&self, patch: usize) -> &PatchOrder {
        self.tables.order(self.led[patch])
    }

    /// Faces that one patch becomes.
    pub(crate) fn faces_each(&self) -> usize {
        1 << (2 * self.depth)
    }

    /// The patches, cut into ranges of about as many faces as the context's chunks.
    pub(crate) fn chunks(&self, context: &Context) -> Vec<Range<usize>> {
        let (patches, each) = (self.led.len(), self.faces_each());
        let len = (context.chunk_len(patches * each) / each).max(1);
        (0..patches.div_ceil(len)).map(|i| i * len..((i + 1) * len).min(patches)).collect()
    }

    /// Cuts an array of one entry for each new vertex: for each range of patches what its
    /// patches lead, run after run.
    pub(crate) fn cut<'o, V>(
        &self,
        new: &'o mut [V],
        ranges: &[Range<usize>],
    ) -> Result<Vec<Vec<&'o mut [V]>>> {
        let mut parts = memory::reserved(ranges.len())?;
        for _ in ranges {
            parts.push(memory::reserved(2 * self.depth as usize)?);
        }
        let mut rest = new;
        for run in 0..2 * self.depth as usize {
            for (range, parts) in ranges.iter().zip(&mut parts) {
                let len = self.first(run, range.end) - self.first(run, range.start);
                let (part, later) = rest.split_at_mut(len as usize);
                parts.push(part);
                rest = later;
            }
        }
        Ok(parts)
    }

    /// How many vertices of a run the patches before one lead.
    #[inline(always)]
    fn first(&self, run: usize, patch: usize) -> u32 {
        let (level, patch_number) = (run / 2, patch as u32);
        let n = 1_u32 << level;
        let inside = match (run % 2, self.pieces) {
            (0, Pieces::Quads) => 2 * n * (n - 1),
            (0, Pieces::Triangles) => 3 * n * (n - 1) / 2,
            (_, Pieces::Quads) => return patch_number * (n * n),
            (_, Pieces::Triangles) => return 0,
        };
        patch_number * inside + (self.before[patch] << level)
    }

    /// Writes the size of every last face.
    pub(crate) fn write_sizes(&self, out: &mut [u32]) {
        out.fill(self.pieces.sides());
    }

    /// Writes the vertices of all last faces.
    pub(crate) fn write_faces(&self, context: &Context, out: &mut [u32]) -> Result<()> {
        match self.pieces {
            Pieces::Quads => self.write_pieces::<4>(context, out, family_of_quad),
            Pieces::Triangles => {
                self.write_pieces::<3>(context, out, |v, e, _| family_of_triangle(v, e))
            }
        }
    }

    /// Writes faces of N corners; `family` makes four of the numbers of their parent's
    /// vertices, of its edges' and its own.
    fn write_pieces<const N: usize>(
        &self,
        context: &Context,
        out: &mut [u32],
        family: impl Fn([u32; N], [u32; N], u32) -> [[u32; N]; 4] + Sync + Send,
    ) -> Result<()> {
        let (mut rest, mut parts) = (out, Vec::new());
        for range in self.chunks(context) {
            let (part, later) = rest.split_at_mut(range.len() * self.faces_each() * N);
            memory::extend(&mut parts, [(range, part)])?;
            rest = later;
        }
        let parents = self.tables.parents::<N>();
        let last = 2 * self.depth as usize - 1;
        let done = context.map(parts, |(range, part)| {
            let mut numbers = patch_array(0)?;
            let families = part.as_chunks_mut::<N>().0.as_chunks_mut::<4>().0;
            for (patch, out) in range.zip(families.chunks_exact_mut(parents.len())) {
                self.number(patch, &mut numbers);
                let first = self.runs[last] + self.first(last, patch);
                for ((out, &[v, e]), own) in out.iter_mut().zip(parents).zip(first..) {
                    let number = |index: u16| numbers[within(index)];
                    *out = family(v.map(number), e.map(number), own);
                }
            }
            Ok(())
        })?;
        done.into_iter().collect()
    }

    /// The numbers of the vertices in a patch.
    fn number(&self, patch: usize, numbers: &mut PatchArray<u32>) {
        let order = self.order(patch);
        for level in 0..self.depth as usize {
            let runs = [order.on_edges(level), order.in_faces(level)];
            for (run, indices) in (2 * level..).zip(runs) {
                let first = self.runs[run] + self.first(run, patch);
                for (number, &index) in (first..).zip(indices) {
                    numbers[within(index)] = number;
                }
            }
        }
        let sides = self.pieces.sides() as usize;
        let corners = self.tables.frame(self.depth).own;
        for side in 0..sides {
            let corner = patch * sides + side;
            numbers[within(corners[side])] = self.parent.vert[corner];
            let twin = self.parent.twin[corner] as usize;
            if twin < corner {
                self.number_across(side, twin, numbers);
            }
        }
    }

    /// The numbers on a side that the face across it leads.
    fn number_across(&self, side: usize, twin: usize, numbers: &mut PatchArray<u32>) {
        let sides = self.pieces.sides() as usize;
        let (across, order) = (twin / sides, self.order(twin / sides));
        for level in 0..self.depth as usize {
            let first = self.runs[2 * level] + self.first(2 * level, across);
            let theirs = self.tables.side(twin % sides, level).iter().rev();
            for (&own, &theirs) in self.tables.side(side, level).iter().zip(theirs) {
                numbers[within(own)] = first + order.number(theirs as usize);
            }
        }
    }

    /// Calls `each` with every last face's place and the face that it comes from.
    pub(crate) fn each_face_source(&self, mut each: impl FnMut(usize, u32)) {
        let children = self.faces_each();
        for face in 0..self.counts.faces as usize {
            each(face, (face / children) as u32);
        }
    }
}
