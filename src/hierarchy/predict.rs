//! What a refinement will cost, before anything is built.

use crate::base::{Error, ErrorKind, NONE, Result};
use crate::mesh::{Channel, Mesh};
use crate::refine::{Counts, DEEPEST, DEEPEST_TILE, Patches, Pieces, PrimalSplit, Tiles};
use crate::scheme::{Scheme, SplitKind};

/// The largest number of levels, for meshes that do not grow out of bounds
/// before: a lone triangle without boundary rule stays one.
const MOST_LEVELS: u32 = 64;

/// The sizes of every level of a refinement, and the memory it needs.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Prediction {
    levels: Vec<Counts>,
    passes: usize,
    primal: bool,
    /// Sharp edges, sides of joints and faces of holes of the control mesh.
    features: [u64; 2],
    /// Levels that are done in one step, and the corners at extraordinary vertices, or of faces
    /// that are no quads, then.
    patches: u32,
    slots: u64,
}

impl Prediction {
    /// Predicts levels 0 to `levels` of a mesh under a scheme. Costs one look
    /// at the boundary and the irregular vertices.
    ///
    /// # Errors
    /// [`ErrorKind::TooLarge`] if a count leaves 64 bits, or for more than 64
    /// levels; as [`Scheme::check`].
    pub fn new(mesh: &Mesh, scheme: &Scheme, levels: u32) -> Result<Self> {
        if levels > MOST_LEVELS {
            return Err(Error::new(
                ErrorKind::TooLarge,
                format!("{levels} levels: the limit is {MOST_LEVELS}"),
            ));
        }
        scheme.check(mesh)?;
        let mut counts = vec![Counts::of(mesh)];
        for level in 0..levels {
            let last = counts[level as usize];
            let next = match scheme.split() {
                SplitKind::Corner if level == 0 => scheme.anchor(mesh)?.split_counts(mesh),
                SplitKind::Corner => last.plain(),
                _ => PrimalSplit::split_counts(&last, scheme.pieces()),
            };
            counts.push(next.ok_or_else(|| {
                Error::new(
                    ErrorKind::TooLarge,
                    format!("level {} has more elements than 64 bits can count", level + 1),
                )
            })?);
        }
        let primal = scheme.split() != SplitKind::Corner;
        let edges = mesh.sharpness.edges.len() + mesh.joints.sides.len();
        let features = [edges as u64, mesh.holes.len() as u64];
        let patches = patch_depth(mesh, scheme, &counts);
        let steps = levels > patches;
        let slots = match patches {
            0 => 0,
            _ if !primal => counts[(levels - patches) as usize].irregular_corners,
            _ => extraordinary_corners(mesh, scheme.pieces(), steps),
        };
        let passes = scheme.passes().len();
        Ok(Self { levels: counts, passes, primal, features, patches, slots })
    }

    /// Predicts the values of a face-varying channel: they are what the counts call
    /// vertices, level 0 being the caller's own.
    ///
    /// # Errors
    /// As [`Prediction::new`].
    pub fn of_channel(channel: &Channel, scheme: &Scheme, levels: u32) -> Result<Self> {
        let mut plan = Self::new(&channel.mesh, scheme, levels)?.level_by_level();
        plan.levels[0].vertices = channel.values as u64;
        Ok(plan)
    }

    /// How many of the last levels are done in one step, patch by patch or tile by tile; 0 if
    /// they are not.
    #[doc(hidden)]
    pub fn patch_depth(&self) -> u32 {
        self.patches
    }

    /// True unless the split is the dual one.
    pub(super) fn is_primal(&self) -> bool {
        self.primal
    }

    /// The number of smoothing passes.
    pub(super) fn passes(&self) -> usize {
        self.passes
    }

    /// Sharp edges of the control mesh, and sides of its joints.
    pub(super) fn sharp_edges(&self) -> u64 {
        self.features[0]
    }

    /// Corners that are followed by themselves where levels are done in one step.
    pub(super) fn slots(&self) -> u64 {
        self.slots
    }

    /// The same refinement with every level by itself.
    pub(crate) fn level_by_level(mut self) -> Self {
        self.patches = 0;
        self
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

    /// Refuses what does not fit 32-bit indices at any level.
    pub(crate) fn check_index_type(&self) -> Result<()> {
        let check = |(level, counts): (usize, &Counts)| {
            counts.check_index_type().map_err(|error| error.in_context(format!("level {level}")))
        };
        self.levels.iter().enumerate().try_for_each(check)
    }

    /// Scratch memory of a call of a refiner.
    pub(crate) fn refiner_bytes(&self, width: u64, size: u64, face_sources: bool) -> u64 {
        if self.levels.len() == 1 {
            return 0;
        }
        let faces = self.levels.iter().map(|counts| counts.faces);
        let sources = if face_sources { faces.fold(0, u64::saturating_add) } else { 0 };
        let scratch = match self.patches {
            0 => self.scratch_bytes(width, size),
            depth => self.patch_bytes(depth, width, size),
        };
        scratch.saturating_add(sources.saturating_mul(4))
    }

    /// Bytes of the adjacency of all levels but the first; all byte counts stop at
    /// the largest 64-bit number.
    pub fn topology_bytes(&self) -> u64 {
        let levels = self.levels.iter().skip(1).map(topology_bytes).sum::<u128>();
        let inner = &self.levels[..self.levels.len() - 1];
        let edges = inner.last().map_or(0, |counts| self.edge_bytes(counts));
        saturate(levels + edges + self.feature_bytes(self.levels.len()))
    }

    /// Numbers of the edges of a level that is split, and a set of its vertices.
    fn edge_bytes(&self, counts: &Counts) -> u128 {
        if !self.primal {
            return 0;
        }
        4 * (u128::from(counts.corners) + u128::from(counts.edges))
            + u128::from(counts.vertices) / 8
    }

    /// About what sharp edges, joints and holes take on the first levels: their number
    /// doubles from level to level, that of the faces of holes is four times as much; lists
    /// of them are collected, sorted and looked up in several places at once.
    fn feature_bytes(&self, levels: usize) -> u128 {
        const EACH: u128 = 96;
        let [edges, holes] = self.features.map(u128::from);
        let levels = levels.min(32) as u32;
        EACH * edges * ((1 << levels) - 1) + 8 * holes * ((1 << (2 * levels.min(16))) - 1) / 3
    }

    /// Bytes of the last level's faces and of `width` values of `size` bytes on
    /// each of its vertices.
    pub fn output_bytes(&self, width: u64, size: u64) -> u64 {
        let last = self.last();
        let faces = 4 * (u128::from(last.corners) + u128::from(last.faces));
        saturate(faces.saturating_add(value_bytes(last.vertices, width, size)))
    }

    /// Bytes that the levels in between need while the last one is written:
    /// topology, and `width` values of `size` bytes on each of their vertices; for a refiner
    /// that does the last levels of a closed mesh in one step at most as much.
    /// Records wider than xyz and four more may pass through a copy of the last
    /// level, which is counted in.
    pub fn scratch_bytes(&self, width: u64, size: u64) -> u64 {
        let levels = self.level_bytes(width, size);
        match self.patches {
            0 => levels,
            depth => levels.max(self.patch_bytes(depth, width, size)),
        }
    }

    /// The same with one level after the other.
    fn level_bytes(&self, width: u64, size: u64) -> u64 {
        let inner = &self.levels[..self.levels.len() - 1];
        let topology: u128 = inner.iter().skip(1).map(topology_bytes).sum();
        // Places of child quads, for the levels that get a child mesh.
        let places: u128 = inner.iter().rev().skip(1).map(|c| u128::from(c.corners)).sum();
        let values = inner.iter().map(|c| value_bytes(c.vertices, width, size));
        let values = values.fold(0, u128::saturating_add);
        let stored = inner.iter().map(|c| value_bytes(c.stored_corners(), width, size)).max();
        let last = value_bytes(self.last().vertices, width, size);
        let stages = match self.passes {
            0 => 0,
            1 => stored.unwrap_or(0),
            _ => stored.unwrap_or(0).saturating_add(last),
        };
        let copies = self.copy_bytes(width, size);
        let edges = inner.last().map_or(0, |counts| self.edge_bytes(counts));
        let features = self.feature_bytes(inner.len());
        let parts = [topology, places, values, stages, copies, edges, features];
        saturate(parts.into_iter().fold(0, u128::saturating_add))
    }

    /// Lanes of wide records are collected apart and then put together.
    fn copy_bytes(&self, width: u64, size: u64) -> u128 {
        if width > 7 { value_bytes(self.last().vertices, width, size) } else { 0 }
    }

    /// The same where the last levels are done in one step: the levels before it; of patches
    /// which sides each leads, what its corners become, and tables, and for the corners of
    /// extraordinary vertices four lanes of their neighbours for each level; of tiles the first
    /// vertex of each, tables, and for the corners of faces that are no quads four lanes for each
    /// level; with a pass the values of the first level, and at those corners four children for
    /// each level, nine split points, and the one that a level by itself stores.
    fn patch_bytes(&self, depth: u32, width: u64, size: u64) -> u64 {
        let levels = self.levels[..self.levels.len() - depth as usize].to_vec();
        let parent = levels[levels.len() - 1];
        let places = levels.iter().rev().nth(1).map_or(0, |counts| u128::from(counts.corners));
        let before = Self { levels, patches: 0, ..*self };
        let own = before.level_bytes(width, size);
        let parent_values = value_bytes(parent.vertices, width, size);
        let topology = if before.levels.len() > 1 { topology_bytes(&parent) } else { 0 };
        let faces = u128::from(parent.faces);
        let lanes = |levels: u32| 4 * u128::from(size) * u128::from(levels);
        // Tables grow with the faces of a patch or tile; two arrays are as large as the
        // deepest ones ask for.
        let each_table = |bytes: u128| bytes << (2 * depth);
        let (tables, each_face, each_slot) = if self.primal {
            let corners = value_bytes(parent.corners, width, size);
            let tables = each_table(128) + lanes(2 * 2048) + (16 << 10);
            (tables, corners.saturating_add(5 * faces), 16 + lanes(depth + 4))
        } else {
            let first = &self.levels[self.levels.len() - depth as usize];
            let (first, each_slot) = if self.passes == 0 {
                (0, lanes(depth + 1))
            } else {
                let split_points = value_bytes(parent.stored_corners(), width, size);
                let first = value_bytes(first.vertices, width, size);
                (first.saturating_add(split_points), lanes(4 * depth + 9))
            };
            (
                each_table(256) + lanes(2 * 512) + (16 << 10),
                first.saturating_add(4 * faces),
                each_slot,
            )
        };
        let slots = u128::from(self.slots).saturating_mul(each_slot);
        let copies = self.copy_bytes(width, size);
        let own = u128::from(own);
        let parts = [own, places, parent_values, topology, each_face, slots, tables, copies];
        saturate(parts.into_iter().fold(0, u128::saturating_add))
    }
}

/// How many of the last levels of a closed mesh are worth a single step; of a primal scheme
/// only if nothing is sharp.
fn patch_depth(mesh: &Mesh, scheme: &Scheme, levels: &[Counts]) -> u32 {
    /// Fewer patches do not pay for their tables.
    const FEWEST: u64 = 256;
    let last = levels.len() - 1;
    let corner = scheme.split() == SplitKind::Corner;
    if scheme.passes().len() > usize::from(corner) {
        return 0;
    }
    if corner {
        let fits = |&depth: &u32| {
            let parent = last - depth as usize;
            levels[parent].faces >= FEWEST && Tiles::fit(&levels[parent - 1])
        };
        return (2..=DEEPEST_TILE.min(last.saturating_sub(1) as u32)).rev().find(fits).unwrap_or(0);
    }
    if !Patches::fit(mesh) {
        return 0;
    }
    let side = u64::from(scheme.pieces().sides());
    let fits = |&depth: &u32| {
        let parent = &levels[last - depth as usize];
        parent.faces >= FEWEST
            && parent.corners == side * parent.faces
            && parent.irregular_faces == 0
    };
    (2..=DEEPEST.min(last as u32)).rev().find(fits).unwrap_or(0)
}

/// The corners at the extraordinary vertices of a closed mesh, with those of the middles of
/// its odd faces where there is a step before.
fn extraordinary_corners(mesh: &Mesh, pieces: Pieces, steps: bool) -> u64 {
    let valences = |vertices: &mut dyn Iterator<Item = usize>, regular: usize| {
        let valences = vertices.map(|v| if mesh.start[v] == NONE { 0 } else { mesh.valence(v) });
        valences.filter(|&n| n != regular).sum::<usize>() as u64
    };
    if pieces == Pieces::Triangles {
        return valences(&mut (0..mesh.vertices()), 6);
    }
    let layout = &mesh.layout;
    let odd = if layout.side() == 4 { layout.irregular_corners() } else { layout.corners() };
    let special = &mut mesh.special.iter().map(|&v| v as usize);
    valences(special, 4) + if steps { u64::from(odd) } else { 0 }
}

fn saturate(bytes: u128) -> u64 {
    u64::try_from(bytes).unwrap_or(u64::MAX)
}

fn value_bytes(records: u64, width: u64, size: u64) -> u128 {
    u128::from(records).saturating_mul(u128::from(width)).saturating_mul(u128::from(size))
}

fn topology_bytes(counts: &Counts) -> u128 {
    let n = |count: u64| u128::from(count);
    // Offsets, reverse map and near bits of irregular faces; their vertices; the
    // boundary's lists; fan starts and the set of special vertices.
    let irregular = 9 * n(counts.irregular_corners) + 8 * n(counts.irregular_faces);
    let vertices = 4 * n(counts.vertices) + n(counts.vertices) / 8;
    // Interior vertices of valence 6 are listed as special.
    let listed = if counts.has_triangles() { 4 * n(counts.vertices) } else { 0 };
    listed
        + 8 * n(counts.corners)
        + vertices
        + n(counts.faces)
        + irregular
        + 12 * n(counts.boundary_edges)
}
