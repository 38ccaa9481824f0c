//! A row of the table and of the file.

use serde::{Deserialize, Serialize};

/// One scheme on one mesh against one peer in one regime.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Row {
    /// The scheme.
    pub scheme: String,
    /// The mesh.
    pub mesh: String,
    /// The level refined to.
    pub level: u32,
    /// The peer.
    pub peer: String,
    /// Its version.
    pub peer_version: String,
    /// The state of memory.
    pub regime: String,
    /// Threads on either side.
    pub threads: u32,
    /// Timed calls of either side.
    pub runs: u32,
    /// Faces of the result.
    pub faces: u64,
    /// Median.
    pub ours_ns_per_face: f64,
    /// Median.
    pub peer_ns_per_face: f64,
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
    /// of the bounding box; null where the meshes could not be matched.
    pub max_difference: Option<f64>,
    /// As many vertices, faces and corners.
    pub same_counts: bool,
    /// Every face is the same cycle of the same vertices.
    pub same_faces: bool,
}
