//! The faces around a cell that decide its surface, as a mesh of their own with a name: cells
//! with the same name have the same surface over their points.

use super::cell::Kind;
use crate::base::{Context, Crease, Error, ErrorKind, NONE, Result, SharpVertex};
use crate::mesh::{BuildOptions, Built, Mesh, NonManifold, build};
use crate::scheme::Scheme;
use std::collections::{HashMap, HashSet};

/// Corners of a vicinity beyond which a surface is refused.
const MOST: usize = 1 << 12;

/// The faces around a cell, listed in an order that depends on nothing but how they hang
/// together, from the cell's corner on.
#[derive(Debug)]
pub(super) struct Vicinity {
    pub(super) kind: Kind,
    sizes: Vec<u32>,
    /// Vertices of faces, by their place in `vertices`.
    indices: Vec<u32>,
    /// In the mesh that it is a part of.
    pub(super) vertices: Vec<u32>,
    creases: Vec<Crease>,
    sharp: Vec<SharpVertex>,
    /// A step on it heeds the tuned rule.
    tuned: bool,
    /// The boundary comes so near that it has a say.
    pub(super) on_rim: bool,
}

impl Vicinity {
    /// Some rings of faces around a cell; nothing if they have too many corners.
    pub(super) fn new(
        scheme: &Scheme,
        mesh: &Mesh,
        corner: u32,
        kind: Kind,
        rings: u32,
    ) -> Option<Self> {
        let faces = faces(mesh, corner, kind, rings)?;
        let mut names: HashMap<u32, u32> = HashMap::new();
        let (mut vertices, mut indices) = (Vec::new(), Vec::new());
        for &first in &faces.corners {
            for corner in around(mesh, first) {
                let v = mesh.vert[corner as usize];
                let name = *names.entry(v).or_insert_with(|| {
                    vertices.push(v);
                    vertices.len() as u32 - 1
                });
                indices.push(name);
            }
        }
        let sizes = faces.corners.iter().map(|&c| mesh.layout.face_around(c).len() as u32);
        let mut vicinity = Self {
            kind,
            sizes: sizes.collect(),
            indices,
            vertices,
            creases: Vec::new(),
            sharp: Vec::new(),
            tuned: scheme.tunes(mesh),
            on_rim: faces.inside.iter().any(|&v| mesh.on_rim(v)),
        };
        if scheme.creases() {
            vicinity.sharpen(scheme, mesh, &faces.corners, &names);
        }
        Some(vicinity)
    }

    fn sharpen(&mut self, scheme: &Scheme, mesh: &Mesh, faces: &[u32], names: &HashMap<u32, u32>) {
        for corner in faces.iter().flat_map(|&first| around(mesh, first)) {
            let sharpness = mesh.sharpness.edge(mesh.first_of_edge(corner));
            if mesh.twin[corner as usize] != NONE && sharpness > 0.0 {
                let ends = [corner, mesh.next(corner)].map(|c| names[&mesh.vert[c as usize]]);
                let vertices = [ends[0].min(ends[1]), ends[0].max(ends[1])];
                self.creases.push(Crease { vertices, sharpness });
            }
        }
        self.creases.sort_by_key(|crease| crease.vertices);
        self.creases.dedup();
        for (vertex, &v) in (0..).zip(&self.vertices) {
            let sharpness = scheme.vertex_sharpness(mesh, v);
            if sharpness > 0.0 {
                self.sharp.push(SharpVertex { vertex, sharpness });
            }
        }
    }

    /// What all vicinities of the same surface have in common.
    pub(super) fn name(&self) -> Vec<u32> {
        let [faces, creases] = [self.sizes.len(), self.creases.len()].map(|n| n as u32);
        let start = [self.kind as u32, u32::from(self.tuned), faces, creases];
        let crease = |crease: &Crease| {
            let [a, b] = crease.vertices;
            [a, b, crease.sharpness.to_bits()]
        };
        let sharp = |sharp: &SharpVertex| [sharp.vertex, sharp.sharpness.to_bits()];
        let mut name = start.to_vec();
        name.extend(&self.sizes);
        name.extend(&self.indices);
        name.extend(self.creases.iter().flat_map(crease));
        name.extend(self.sharp.iter().flat_map(sharp));
        name
    }

    /// The faces as a mesh, and the corner of the cell in it. Vertices of several fans, which
    /// lie farthest out, are cut into copies.
    ///
    /// # Errors
    /// [`ErrorKind::OutOfResources`].
    pub(super) fn mesh(&self) -> Result<(Built, u32)> {
        let options = BuildOptions {
            non_manifold: NonManifold::Cut,
            creases: &self.creases,
            sharp_vertices: &self.sharp,
            ..BuildOptions::default()
        };
        let context = Context::serial();
        let vertices = self.vertices.len();
        let mut built = build(&context, vertices, &self.sizes, &self.indices, &options)?;
        built.mesh.refined = self.tuned;
        let mesh = &built.mesh;
        let first = (0..mesh.faces()).find(|&face| mesh.face_source(face) == 0);
        let first = first
            .ok_or_else(|| Error::new(ErrorKind::BrokenInvariant, "a mesh lost its first face"))?;
        let corner = mesh.face_corners(first).start as u32;
        Ok((built, corner))
    }
}

/// The corners of a face from one on.
fn around(mesh: &Mesh, first: u32) -> impl Iterator<Item = u32> + '_ {
    let next = move |&corner: &u32| Some(mesh.next(corner)).filter(|&next| next != first);
    std::iter::successors(Some(first), next)
}

/// Faces by the corner that each was found at.
struct Faces {
    corners: Vec<u32>,
    /// Vertices all of whose faces are listed.
    inside: Vec<u32>,
}

/// The faces up to some rings around a cell's face, or around its vertex under dual schemes.
fn faces(mesh: &Mesh, corner: u32, kind: Kind, rings: u32) -> Option<Faces> {
    let face = |c: u32| mesh.layout.face_around(c).start;
    let mut known: HashSet<u32> = HashSet::from([face(corner)]);
    let mut done: HashSet<u32> = HashSet::new();
    let mut corners = vec![corner];
    let mut count = mesh.layout.face_around(corner).len();
    let mut inside = Vec::new();
    // Corners whose vertices are next to be surrounded.
    let mut front: Vec<u32> = match kind {
        Kind::Quarter => vec![corner],
        _ => around(mesh, corner).collect(),
    };
    for _ in 0..rings {
        for c in std::mem::take(&mut front) {
            let v = mesh.vert[c as usize];
            if !done.insert(v) {
                continue;
            }
            inside.push(v);
            for beside in fan(mesh, c) {
                if known.insert(face(beside)) {
                    corners.push(beside);
                    count += mesh.layout.face_around(beside).len();
                }
                if count > MOST {
                    return None;
                }
            }
        }
        front = corners.iter().flat_map(|&first| around(mesh, first)).collect();
    }
    Some(Faces { corners, inside })
}

/// The corners of a vertex from one on, counter-clockwise; past a boundary those clockwise.
fn fan(mesh: &Mesh, corner: u32) -> impl Iterator<Item = u32> + '_ {
    let some = |c: u32| (c != NONE).then_some(c);
    let ccw = std::iter::successors(Some(corner), move |&c| {
        some(mesh.ccw(c)).filter(|&next| next != corner)
    });
    let open = mesh.on_rim(mesh.vert[corner as usize]);
    let start = if open { some(mesh.cw(corner)) } else { None };
    ccw.chain(std::iter::successors(start, move |&c| some(mesh.cw(c))))
}
