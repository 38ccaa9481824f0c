//! OpenMesh 9: uniform subdividers on array-kernel meshes.

use crate::bridge::ffi;
use crate::peer::{check_plain, code};
use crate::run::Run;
use crate::{Peer, Result, Scheme, Task};

/// OpenMesh.
#[derive(Debug, Clone, Copy)]
pub struct OpenMesh;

impl Peer for OpenMesh {
    fn name(&self) -> &'static str {
        "OpenMesh"
    }

    fn version(&self) -> String {
        ffi::openmesh_version()
    }

    fn schemes(&self) -> &'static [Scheme] {
        // In the order of the numbers in shim/openmesh.hpp.
        &[
            Scheme::CatmullClark,
            Scheme::Loop,
            Scheme::Sqrt3,
            Scheme::ModifiedButterfly,
            Scheme::LabsikGreiner,
        ]
    }

    fn start(&self, task: &Task) -> Result<Run> {
        check_plain(self, task)?;
        let scheme = code(self, task.scheme)?;
        Run::new(ffi::openmesh_run(&task.control.soup(), scheme, task.precision.code()))
    }
}
