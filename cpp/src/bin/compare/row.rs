//! A row of the table and of the file.

use carvel_peers::Comparison;
use serde::{Deserialize, Serialize};

use crate::cases::Case;
use crate::turns::Taken;

/// One scheme on one mesh against one peer in one regime.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub struct Row {
    /// The scheme.
    pub scheme: String,
    /// The mesh.
    pub mesh: String,
    /// The level refined to.
    pub level: u32,
    /// The peer; carvel itself where threads or sizes are compared.
    pub peer: String,
    /// Its version.
    pub peer_version: String,
    /// The state of memory.
    pub regime: String,
    /// Our threads; the peer has one.
    pub threads: u32,
    /// Timed calls of either side.
    pub runs: u32,
    /// Faces of the result, or vertices or samples where `unit` says so.
    pub faces: u64,
    /// Median.
    pub ours_ns_per_face: f64,
    /// Median.
    pub peer_ns_per_face: f64,
    /// Processor time of all our threads; median.
    pub ours_cpu_ns_per_face: f64,
    /// The same of the peer.
    pub peer_cpu_ns_per_face: f64,
    /// Peer over ours: how many times as fast we are.
    pub ratio: f64,
    /// Half the range of the middle half of the runs, relative to the median.
    pub ours_spread: f64,
    /// The same of the peer.
    pub peer_spread: f64,
    /// Growth of the resident set at its peak; median.
    pub ours_bytes_per_face: f64,
    /// The same of the peer.
    pub peer_bytes_per_face: f64,
    /// The largest distance of a vertex from its counterpart, relative to the diagonal
    /// of the bounding box; null where the meshes could not be matched, or are other
    /// surfaces by design.
    pub max_difference: Option<f64>,
    /// As many vertices, faces and corners.
    pub same_counts: bool,
    /// Every face is the same cycle of the same vertices.
    pub same_faces: bool,
    /// What is computed: `refine` faces and positions, `positions` on a topology that is
    /// ready, `stencil-create`, `stencil-apply`, `surface` points, `surface-derivatives` too.
    pub task: String,
    /// What times and bytes are per: `face`, `vertex` or `sample`.
    pub unit: String,
    /// Our call.
    pub ours_call: String,
    /// The peer's call or the scheme that it runs.
    pub peer_call: String,
    /// Our time over that of writing the same bytes; where memory is re-used.
    pub ours_per_write: Option<f64>,
    /// Bytes of our stencil table per row, where there is one.
    pub ours_table_bytes: Option<f64>,
    /// The same of the peer.
    pub peer_table_bytes: Option<f64>,
    /// Bytes that our call reads and writes at least, in 10⁹ per second.
    pub ours_gb_per_s: Option<f64>,
    /// The same of copying as many bytes on as many threads.
    pub copy_gb_per_s: Option<f64>,
}

impl Row {
    /// Times and memory of a case per face.
    pub fn new(case: &Case, faces: u64, ours: &Taken, peer: &Taken) -> Self {
        let per_face = |value: f64| value / faces as f64;
        Self {
            scheme: case.name().into(),
            mesh: case.mesh.clone(),
            level: case.level,
            threads: 1,
            runs: ours.runs(),
            faces,
            ours_ns_per_face: per_face(1e9 * ours.time()),
            peer_ns_per_face: per_face(1e9 * peer.time()),
            ours_cpu_ns_per_face: per_face(1e9 * ours.cpu()),
            peer_cpu_ns_per_face: per_face(1e9 * peer.cpu()),
            ratio: peer.time() / ours.time(),
            ours_spread: ours.spread(),
            peer_spread: peer.spread(),
            ours_bytes_per_face: per_face(ours.memory()),
            peer_bytes_per_face: per_face(peer.memory()),
            task: "refine".into(),
            unit: "face".into(),
            ..Self::default()
        }
    }

    /// The same with how far the answers are apart.
    pub fn compared(self, comparison: &Comparison) -> Self {
        Self {
            max_difference: Some(comparison.max_difference).filter(|it| it.is_finite()),
            same_counts: comparison.same_counts,
            same_faces: comparison.same_faces,
            ..self
        }
    }

    /// The same as carvel beside carvel, whose answers have the same bytes.
    pub fn beside_carvel(self, peer: &str) -> Self {
        Self {
            peer: peer.into(),
            max_difference: Some(0.0),
            same_counts: true,
            same_faces: true,
            ..self
        }
    }
}
