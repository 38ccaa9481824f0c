//! What a library is asked to do, and the trait that every one of them answers to.

use crate::bridge::ffi;
use crate::run::Run;
use crate::{Cgal, Control, OpenMesh, OpenSubdiv, Options};

/// A refinement or what a library said against it, in one line.
pub type Result<T> = std::result::Result<T, String>;

/// Subdivision schemes that some peer has.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[expect(missing_docs, reason = "the schemes are named after their papers")]
pub enum Scheme {
    CatmullClark,
    Loop,
    Bilinear,
    DooSabin,
    Sqrt3,
    ModifiedButterfly,
    LabsikGreiner,
}

impl Scheme {
    /// All, in the order of the table.
    pub const ALL: [Self; 7] = [
        Self::CatmullClark,
        Self::Loop,
        Self::Bilinear,
        Self::DooSabin,
        Self::Sqrt3,
        Self::ModifiedButterfly,
        Self::LabsikGreiner,
    ];

    /// The name in tables and files.
    pub fn name(self) -> &'static str {
        match self {
            Self::CatmullClark => "catmull-clark",
            Self::Loop => "loop",
            Self::Bilinear => "bilinear",
            Self::DooSabin => "doo-sabin",
            Self::Sqrt3 => "sqrt3",
            Self::ModifiedButterfly => "modified-butterfly",
            Self::LabsikGreiner => "labsik-greiner",
        }
    }

    /// True for schemes that take triangles and nothing else.
    pub fn needs_triangles(self) -> bool {
        !matches!(self, Self::CatmullClark | Self::Bilinear | Self::DooSabin)
    }
}

/// The type in which positions are stored and blended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Precision {
    /// `f32`.
    Single,
    /// `f64`.
    Double,
}

impl Precision {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Single, Self::Double];

    pub(crate) fn code(self) -> ffi::Precision {
        match self {
            Self::Single => ffi::Precision::Single,
            Self::Double => ffi::Precision::Double,
        }
    }
}

/// What to refine and how.
#[derive(Debug, Clone, Copy)]
pub struct Task<'a> {
    /// The control mesh.
    pub control: &'a Control,
    /// The scheme.
    pub scheme: Scheme,
    /// The type of positions inside the library.
    pub precision: Precision,
    /// Further options.
    pub options: Options,
}

impl<'a> Task<'a> {
    /// A task with default options.
    pub fn new(control: &'a Control, scheme: Scheme, precision: Precision) -> Self {
        Self { control, scheme, precision, options: Options::default() }
    }
}

/// A mesh that a library gave back; positions of either precision as doubles.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct PeerMesh {
    /// Corners per face.
    pub sizes: Vec<u32>,
    /// The corners' vertices, face after face.
    pub indices: Vec<u32>,
    /// xyz per vertex.
    pub positions: Vec<f64>,
}

impl PeerMesh {
    /// The number of vertices.
    pub fn vertices(&self) -> usize {
        self.positions.len() / 3
    }

    /// The faces as slices, in order.
    pub fn faces(&self) -> impl Iterator<Item = &[u32]> {
        crate::control::faces(&self.sizes, &self.indices)
    }
}

/// A library that subdivides.
pub trait Peer: Sync {
    /// Its name.
    fn name(&self) -> &'static str;

    /// The version that the shims were compiled against.
    fn version(&self) -> String;

    /// The schemes that it has.
    fn schemes(&self) -> &'static [Scheme];

    /// A control mesh in the library's own memory, ready for a timed call.
    ///
    /// # Errors
    /// What the library does not take, in its words or the shim's.
    fn start(&self, task: &Task) -> Result<Run>;

    /// Refines to a level.
    ///
    /// # Errors
    /// As [`Peer::start`].
    fn refine(&self, task: &Task, levels: u32) -> Result<PeerMesh> {
        let mut run = self.start(task)?;
        run.prepare()?;
        run.refine(levels)?;
        run.mesh()
    }
}

/// All peers.
pub const PEERS: [&dyn Peer; 3] = [&OpenSubdiv, &OpenMesh, &Cgal];

/// The number by which a shim knows a scheme: its place in the peer's list.
pub(crate) fn code(peer: &dyn Peer, scheme: Scheme) -> Result<u8> {
    let place = peer.schemes().iter().position(|&it| it == scheme);
    let missing = || format!("{} does not have {}", peer.name(), scheme.name());
    place.map(|place| place as u8).ok_or_else(missing)
}

/// Refuses tags and options for libraries that would ignore them.
pub(crate) fn check_plain(peer: &dyn Peer, task: &Task) -> Result<()> {
    let it = task.control;
    let tagged = !it.creases.is_empty()
        || !it.sharp_vertices.is_empty()
        || !it.holes.is_empty()
        || !it.channels.is_empty();
    if tagged || task.options != Options::default() {
        return Err(format!("{} has no tags and no options", peer.name()));
    }
    Ok(())
}
