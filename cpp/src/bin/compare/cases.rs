//! What is compared: schemes, meshes and levels.

use carvel::Fraction;
use carvel::io::{self, ReadOptions};
use carvel_peers::{
    Boundary, Control, Options, PEERS, Peer, Precision, Scheme, Task, ours, shapes,
};
use std::path::Path;

use crate::args::Args;
use crate::regime::Regime;
use crate::sides::Given;

/// A scheme on a mesh.
pub struct Case {
    /// The peer's scheme, and carvel's too unless that is the three-point one.
    pub scheme: Scheme,
    /// carvel runs the three-point scheme, which no peer has: another surface on the
    /// faces of Doo–Sabin.
    pub three_point: bool,
    /// The mesh's name.
    pub mesh: String,
    /// The mesh.
    pub control: Control,
    /// The level to refine to.
    pub level: u32,
}

impl Case {
    /// A scheme that peers have too.
    pub fn new(scheme: Scheme, mesh: &str, control: &Control, level: u32) -> Self {
        Self { scheme, three_point: false, mesh: mesh.into(), control: control.clone(), level }
    }

    /// The three-point scheme beside Doo–Sabin.
    pub fn three_point(mesh: &str, control: &Control, level: u32) -> Self {
        Self { three_point: true, ..Self::new(Scheme::DooSabin, mesh, control, level) }
    }

    /// The name of carvel's scheme.
    pub fn name(&self) -> &'static str {
        if self.three_point { "three-point" } else { self.scheme.name() }
    }

    /// The peers that have the scheme.
    pub fn peers(&self) -> impl Iterator<Item = &'static dyn Peer> {
        let scheme = self.scheme;
        PEERS.into_iter().filter(move |peer| peer.schemes().contains(&scheme))
    }

    /// The case as carvel takes it, with a rule at borders.
    pub fn given(&self, boundary: Boundary) -> Result<Given, String> {
        let options = Options { boundary, ..Options::default() };
        let task = Task { options, ..Task::new(&self.control, self.scheme, Precision::Single) };
        let w = Fraction::new(1, 32).map_err(|e| e.to_string())?;
        let scheme = if self.three_point {
            carvel::Scheme::three_point(w).map_err(|e| e.to_string())?
        } else {
            let missing = || format!("carvel does not have {}", self.name());
            ours::scheme(&task).ok_or_else(missing)?
        };
        let positions = self.control.positions.iter().map(|&x| x as f32).collect();
        Ok(Given { mesh: ours::mesh(&self.control)?, scheme, level: self.level, positions })
    }
}

/// The cow, as the repository has it.
pub fn cow() -> Result<Control, String> {
    read(Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../assets/spot/spot_control_mesh.obj")))
}

/// 32,768 quads.
pub fn torus() -> Control {
    shapes::torus(256, 128)
}

/// 20,000 triangles.
pub fn triangles() -> Control {
    shapes::triangulated(&shapes::torus(100, 100))
}

/// All cases of one-shot refinement: those of the file asked for, or the built-in ones.
/// The shuffled torus and the three-point scheme are left out on huge pages, to save minutes.
pub fn all(args: &Args, regime: Regime) -> Result<Vec<Case>, String> {
    let whole = regime != Regime::Huge;
    let mut cases = Vec::new();
    let mut add = |mesh: &str, control: &Control, level, chosen| {
        let fit = Scheme::ALL.into_iter().filter(|&it| fits(it, control.is_triangles(), chosen));
        cases.extend(fit.map(|scheme| Case::new(scheme, mesh, control, level)));
        if whole && !chosen && !control.is_triangles() {
            cases.push(Case::three_point(mesh, control, level));
        }
    };
    if let Some(path) = &args.mesh {
        let name = path.file_stem().unwrap_or_default().to_string_lossy();
        add(&name, &read(path)?, args.level, true);
        return Ok(cases);
    }
    add("cow", &cow()?, 6, false);
    add("cube", &shapes::cube(), 9, false);
    add("torus", &torus(), 3, false);
    add("triangles", &triangles(), 3, false);
    if whole {
        let shuffled = shapes::shuffled(&torus());
        let case = |scheme| Case::new(scheme, "torus-shuffled", &shuffled, 3);
        cases.extend([Scheme::CatmullClark, Scheme::DooSabin].map(case));
    }
    Ok(cases)
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
