//! How long a refinement will take, estimated from its predicted sizes.
//!
//! Faces of a level cost what the loop that makes them costs, times the records of four lanes
//! that are blended on the way; rows that are made one by one (at irregular faces and vertices,
//! boundaries and sharp edges) cost more; memory costs by the byte when it is first touched:
//!
//! ```text
//! steps  = Σ over levels done one by one: faces · level + records · (faces · blend
//!          + passes · faces · pass + rows · (row + passes · pass_row))
//! last   = faces · level[depth] + records · (faces · (blend[depth] + passes · deep_pass)
//!          + slots · depth · slot)
//! memory = bytes of the result and of scratch · fresh
//! ```
//!
//! [`RATES`] has the constants. `cargo bench --bench cost` measures refinements that each are
//! ruled by one of them, on one thread, and prints them beside what is predicted; a run on the
//! machine named in benches/README.md is where they are from, and the place to look when a loop
//! has become faster.

use super::predict::Prediction;

/// What a refinement is estimated to take, in seconds of wall time.
///
/// The constants are those of one machine (benches/README.md), where they are within a
/// factor of two of what is measured for 10⁴ faces and more; a machine of another speed
/// scales all of them. Faces of hundreds of sides take longer than is estimated, and constants of
/// smoothing passes are known to a factor of three. What is ruled by a call's fixed costs, below 10³ faces, may take some
/// times as long. Reading, building and writing meshes is not included.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Seconds {
    /// Levels that are done one after the other.
    pub steps: f64,
    /// The last levels, where they are done in one step
    /// (ARCHITECTURE.md, "Where time goes").
    pub last: f64,
    /// Touching fresh memory: the result and scratch. A call into memory that was used before,
    /// with a refiner that was, does without.
    pub memory: f64,
}

impl Seconds {
    /// All of it.
    pub fn total(&self) -> f64 {
        self.steps + self.last + self.memory
    }
}

/// Nanoseconds on one thread: of a face whatever its values, and for each record of four
/// lanes of f32.
#[derive(Debug, Clone, Copy)]
struct Rate {
    face: f64,
    blend: f64,
}

/// The constants of a kind of split.
struct Rates {
    /// A face of a level done by itself.
    level: Rate,
    /// A face of the last level, by how many levels are one step, from two.
    deep: [Rate; 4],
    /// A face and a record in a smoothing pass.
    pass: f64,
    /// The same in the last levels where they are one step: from instructions, since the
    /// machine was never quiet.
    deep_pass: f64,
    /// What a pass adds to a row that is made by itself.
    pass_row: f64,
}

/// Splits into quads, into triangles, and at corners.
const RATES: [Rates; 3] = [
    Rates {
        level: rate(3.2, 5.0),
        deep: [rate(5.0, 6.0), rate(2.0, 3.6), rate(1.5, 2.7), rate(1.5, 2.7)],
        pass: 173.0,
        deep_pass: 0.0,
        pass_row: 0.0,
    },
    Rates {
        level: rate(3.5, 4.7),
        deep: [rate(5.0, 6.5), rate(1.8, 3.5), rate(1.2, 2.3), rate(1.2, 2.3)],
        pass: 173.0,
        deep_pass: 0.0,
        pass_row: 0.0,
    },
    Rates {
        level: rate(3.0, 3.0),
        deep: [rate(2.2, 2.6), rate(1.2, 1.5), rate(0.9, 1.1), rate(0.9, 1.1)],
        pass: 6.2,
        deep_pass: 4.0,
        pass_row: 800.0,
    },
];

const fn rate(face: f64, blend: f64) -> Rate {
    Rate { face, blend }
}

/// A row that is made by itself, and a record.
const ROW: f64 = 100.0;
/// A corner at an extraordinary vertex or of a face that is no quad, followed for one level.
const SLOT: f64 = 20.0;
/// A byte that nobody has touched.
const FRESH: f64 = 0.13;
/// A second thread and each after it adds this much of the first one.
const FURTHER_THREAD: f64 = 0.85;
/// Lanes of a record in the inner loops.
const LANES: u64 = 4;

impl Prediction {
    /// Estimates how long a refinement takes that writes faces and `width` values of `size`
    /// bytes on each vertex (3 and 4 for positions in f32) on `threads` threads, each of which
    /// has a processor. A `width`, `size` or number of threads of 0 counts as 1.
    ///
    /// O(levels). The estimate is finite, whatever the sizes, and grows with each of them.
    pub fn seconds(&self, width: u64, size: u64, threads: usize) -> Seconds {
        let (width, size) = (width.max(1), size.max(1));
        let depth = self.patch_depth();
        let levels = self.levels().len() - 1;
        let one_by_one = levels - depth as usize;
        // f64 has half as many lanes in a register.
        let records = width.div_ceil(LANES) as f64 * (size as f64 / 4.0).max(1.0);
        let rates = &RATES[self.kind()];
        let passes = self.passes() as f64;

        let step = |level: usize| {
            let faces = self.counts(level as u32).faces as f64;
            let Rate { face, blend } = rates.level;
            let rows = self.rows(level) * (ROW + passes * rates.pass_row);
            faces * face + records * (faces * (blend + passes * rates.pass) + rows)
        };
        let steps: f64 = (1..=one_by_one).map(step).sum();
        let last = if depth == 0 {
            0.0
        } else {
            let Rate { face, blend } = rates.deep[depth as usize - 2];
            let faces = self.last().faces as f64;
            let followed = self.slots() as f64 * f64::from(depth) * SLOT;
            faces * face + records * (faces * (blend + passes * rates.deep_pass) + followed)
        };
        let scratch = if levels == 0 { 0 } else { self.refiner_bytes(width, size, false) };
        let memory = (self.output_bytes(width, size) as f64 + scratch as f64) * FRESH;
        let at_once = 1e-9 / (1.0 + FURTHER_THREAD * (threads.max(1) - 1) as f64);
        Seconds { steps: steps * at_once, last: last * at_once, memory: memory * at_once }
    }

    /// The place of the split's constants.
    fn kind(&self) -> usize {
        match (self.is_primal(), self.last().has_triangles()) {
            (true, false) => 0,
            (true, true) => 1,
            (false, _) => 2,
        }
    }

    /// About how many rows of a level are made one by one: one for each corner of an irregular
    /// face of the level before, which for a dual split triangles are, too, and each edge of its
    /// boundary, two for a sharp edge.
    fn rows(&self, level: usize) -> f64 {
        let parent = self.counts(level as u32 - 1);
        let sharp = self.sharp_edges() as f64 * 2_f64.powi(level as i32 - 1);
        let irregular =
            if self.is_primal() { parent.irregular_corners } else { parent.stored_corners() };
        irregular as f64 + parent.boundary_edges as f64 + 2.0 * sharp
    }
}
