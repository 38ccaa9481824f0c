//! A library's ordinary call, apart from what comes before and after it.

use crate::bridge::ffi;
use crate::{PeerMesh, Result};
use cxx::UniquePtr;

/// A control mesh in a library's own memory.
pub struct Run {
    inner: UniquePtr<ffi::Run>,
}

impl Run {
    pub(crate) fn new(
        inner: std::result::Result<UniquePtr<ffi::Run>, cxx::Exception>,
    ) -> Result<Self> {
        Ok(Self { inner: inner.map_err(message)? })
    }

    /// Puts the control mesh back, beside the one kept for the next time. Not part of
    /// what is timed, as building carvel's mesh is not.
    ///
    /// # Errors
    /// What the library does not take.
    pub fn prepare(&mut self) -> Result<()> {
        self.inner.pin_mut().prepare().map_err(message)
    }

    /// The library's ordinary public call, after which faces and positions are in
    /// memory: this is what is timed.
    ///
    /// # Errors
    /// What the library does not do.
    pub fn refine(&mut self, levels: u32) -> Result<()> {
        self.inner.pin_mut().refine(levels).map_err(message)
    }

    /// Frees the result.
    pub fn clear(&mut self) {
        self.inner.pin_mut().clear();
    }

    /// Copies the result.
    ///
    /// # Errors
    /// Without a result.
    pub fn mesh(&self) -> Result<PeerMesh> {
        let counts = self.inner.counts();
        let mut mesh = empty(&counts);
        let into = (&mut mesh.sizes, &mut mesh.indices, &mut mesh.positions);
        self.inner.copy(into.0, into.1, into.2).map_err(message)?;
        Ok(mesh)
    }
}

/// Arrays for a mesh of the given size.
pub(crate) fn empty(counts: &ffi::Counts) -> PeerMesh {
    PeerMesh {
        sizes: vec![0; counts.faces],
        indices: vec![0; counts.corners],
        positions: vec![0.0; 3 * counts.vertices],
    }
}

/// An exception's text on one line.
#[expect(clippy::needless_pass_by_value, reason = "map_err gives it away")]
pub(crate) fn message(exception: cxx::Exception) -> String {
    exception.what().split_whitespace().collect::<Vec<_>>().join(" ")
}
