//! The faces near some vertices, as a mesh of their own.

use crate::base::{Context, Crease, NONE, Result, SharpVertex, memory};
use crate::mesh::{BuildOptions, Mesh, NonManifold, build};

/// Rings of faces around vertices that leave, after a step, as many as a rule looks at: it makes
/// two of each, spoils one more than there are passes beside a cut, and rules look at up to twice
/// as many as there are passes.
fn rings(passes: u32) -> u32 {
    (2 * passes).max(3)
}

/// A part of a mesh.
pub(super) struct Part {
    pub(super) mesh: Mesh,
    /// The vertices wanted, in the part's own numbers.
    pub(super) wanted: Vec<u32>,
    /// For each vertex of the part its number in the whole.
    pub(super) vertices: Vec<u32>,
}

impl Part {
    /// The faces up to some rings around vertices, with their sharp features.
    pub(super) fn new(mesh: &Mesh, wanted: &[u32], passes: u32) -> Result<Self> {
        let mut taken = memory::filled(false, mesh.faces())?;
        let mut reached = memory::filled(false, mesh.vertices())?;
        let mut front = memory::copied(wanted)?;
        let mut faces: Vec<u32> = Vec::new();
        for &v in wanted {
            reached[v as usize] = true;
        }
        for _ in 0..rings(passes) {
            let mut next = Vec::new();
            for &v in &front {
                for face in mesh.fans(v).map(|corner| mesh.layout.face_of(corner)) {
                    if std::mem::replace(&mut taken[face as usize], true) {
                        continue;
                    }
                    memory::extend(&mut faces, [face])?;
                    for &other in mesh.face_vertices(face as usize) {
                        if !std::mem::replace(&mut reached[other as usize], true) {
                            memory::extend(&mut next, [other])?;
                        }
                    }
                }
            }
            front = next;
        }
        faces.sort_unstable();
        Self::of_faces(mesh, &faces, &taken, wanted)
    }

    fn of_faces(mesh: &Mesh, faces: &[u32], taken: &[bool], wanted: &[u32]) -> Result<Self> {
        let mut names = memory::filled(NONE, mesh.vertices())?;
        let mut vertices = Vec::new();
        let (mut sizes, mut indices) = (memory::reserved(faces.len())?, Vec::new());
        for &face in faces {
            let around = mesh.face_vertices(face as usize);
            sizes.push(around.len() as u32);
            for &v in around {
                if names[v as usize] == NONE {
                    names[v as usize] = vertices.len() as u32;
                    memory::extend(&mut vertices, [v])?;
                }
                memory::extend(&mut indices, [names[v as usize]])?;
            }
        }
        let name = |v: u32| Some(names[v as usize]).filter(|&name| name != NONE);
        // Of the edges whose ends are there only those of the part's own faces.
        let within = |corner: u32| taken[mesh.layout.face_of(corner) as usize];
        let own = |c: u32| within(c) || within(mesh.twin[c as usize]);
        let crease = |&(c, sharpness): &(u32, f32)| {
            let ends = [c, mesh.next(c)].map(|c| names[mesh.vert[c as usize] as usize]);
            own(c).then_some(Crease { vertices: ends, sharpness })
        };
        let edges = memory::collect(mesh.sharpness.edges.iter().filter_map(crease))?;
        let sharp = |sharp: SharpVertex| Some(SharpVertex { vertex: name(sharp.vertex)?, ..sharp });
        let points = memory::collect(mesh.sharp_vertices().filter_map(sharp))?;
        let tags = memory::collect(mesh.corner_tags().iter().filter_map(|&v| name(v)))?;
        let options = BuildOptions {
            creases: &edges,
            sharp_vertices: &points,
            corner_tags: &tags,
            // Far from what is wanted a part may touch itself.
            non_manifold: NonManifold::Cut,
            ..BuildOptions::default()
        };
        let context = Context::serial();
        let built = build(&context, vertices.len(), &sizes, &indices, &options)?;
        if let Some(source) = &built.vertex_source {
            vertices = memory::collect(source.iter().map(|&v| vertices[v as usize]))?;
        }
        let wanted = memory::collect(wanted.iter().filter_map(|&v| name(v)))?;
        Ok(Self { mesh: built.mesh, wanted, vertices })
    }
}
