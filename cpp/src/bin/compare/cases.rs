//! What is compared: schemes, meshes and levels.

use carvel::io::{self, ReadOptions};
use carvel_peers::{Control, PEERS, Peer, Precision, Scheme, Task, ours, shapes};
use std::path::Path;

use crate::args::Args;

/// A scheme on a mesh.
pub struct Case {
    /// The scheme.
    pub scheme: Scheme,
    /// The mesh's name.
    pub mesh: String,
    /// The mesh.
    pub control: Control,
    /// The level to refine to.
    pub level: u32,
}

impl Case {
    /// The peers that have the scheme.
    pub fn peers(&self) -> impl Iterator<Item = &'static dyn Peer> {
        let scheme = self.scheme;
        PEERS.into_iter().filter(move |peer| peer.schemes().contains(&scheme))
    }
}

/// The cow, as the repository has it.
const COW: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../assets/spot/spot_control_mesh.obj");

/// All cases: those of the file asked for, or the built-in ones.
pub fn all(args: &Args) -> Result<Box<dyn Iterator<Item = Case>>, String> {
    let mut plan: Vec<(String, Control, u32)> = Vec::new();
    if let Some(path) = &args.mesh {
        let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        plan.push((name, read(path)?, args.level));
    } else {
        plan.push(("cow".into(), read(Path::new(COW))?, 6));
        plan.push(("cube".into(), shapes::cube(), 9));
        plan.push(("torus".into(), shapes::torus(256, 128), 3));
        plan.push(("triangles".into(), shapes::triangulated(&shapes::torus(100, 100)), 3));
    }
    let chosen = args.mesh.is_some();
    let cases = plan.into_iter().flat_map(move |(mesh, control, level)| {
        let triangles = control.is_triangles();
        let schemes = Scheme::ALL.into_iter().filter(move |&it| fits(it, triangles, chosen));
        let case =
            move |scheme| Case { scheme, mesh: mesh.clone(), control: control.clone(), level };
        schemes.map(case)
    });
    Ok(Box::new(cases))
}

/// True if a scheme is to be run on a mesh: if carvel has it, and on the built-in
/// triangles only if it needs them.
fn fits(scheme: Scheme, triangles: bool, chosen: bool) -> bool {
    let nothing = Control::default();
    let both = ours::scheme(&Task::new(&nothing, scheme, Precision::Single)).is_some();
    both && (triangles == scheme.needs_triangles() || (chosen && !scheme.needs_triangles()))
}

/// Reads a mesh file; single precision, in which everything here is measured.
pub fn read(path: &Path) -> Result<Control, String> {
    let file = io::read(path, &ReadOptions::default()).map_err(|error| error.to_string())?;
    let control = Control::new(&file.positions, file.faces()).rounded();
    ours::mesh(&control).map_err(|error| format!("{}: {error}", path.display()))?;
    Ok(control)
}
