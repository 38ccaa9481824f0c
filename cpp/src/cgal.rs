//! CGAL 5.5: `Subdivision_method_3` on `Surface_mesh`.

use crate::bridge::ffi;
use crate::peer::{check_plain, code};
use crate::run::Run;
use crate::{Peer, Result, Scheme, Task};

/// CGAL.
#[derive(Debug, Clone, Copy)]
pub struct Cgal;

impl Peer for Cgal {
    fn name(&self) -> &'static str {
        "CGAL"
    }

    fn version(&self) -> String {
        ffi::cgal_version()
    }

    fn schemes(&self) -> &'static [Scheme] {
        // In the order of the numbers in shim/cgal.hpp.
        &[Scheme::CatmullClark, Scheme::Loop, Scheme::Sqrt3, Scheme::DooSabin]
    }

    fn start(&self, task: &Task) -> Result<Run> {
        check_plain(self, task)?;
        let scheme = code(self, task.scheme)?;
        Run::new(ffi::cgal_run(&task.control.soup(), scheme, task.precision.code()))
    }
}
