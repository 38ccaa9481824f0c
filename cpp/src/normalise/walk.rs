//! Which vertex is which, through adjacency.
//!
//! One corner is found by where it lies; from there both meshes are walked side by side
//! from face to face. So positions decide where a walk starts and nothing else, and
//! vertices that lie on top of each other are told apart.

use super::{Correspondence, diagonal, distance, offsets};
use crate::{PeerMesh, Result};

/// No corner.
const NONE: u32 = u32::MAX;

/// How far, relative to the diagonal, a vertex may lie from its counterpart: far more
/// than rounding, less than would let a walk run on a mesh that is another one.
const REACH: f64 = 0.02;

/// The most places that a walk is started from.
const STARTS: usize = 64;

/// A mesh with its twins.
struct Walked<'a> {
    mesh: &'a PeerMesh,
    offsets: Vec<usize>,
    face: Vec<u32>,
    twin: Vec<u32>,
}

impl<'a> Walked<'a> {
    fn new(mesh: &'a PeerMesh) -> Result<Self> {
        let offsets = offsets(&mesh.sizes);
        let mut face = vec![0; mesh.indices.len()];
        for (f, range) in offsets.windows(2).enumerate() {
            face[range[0]..range[1]].fill(f as u32);
        }
        let mut it = Self { mesh, offsets, face, twin: Vec::new() };
        it.twin = it.twins()?;
        Ok(it)
    }

    fn next(&self, corner: u32) -> u32 {
        let f = self.face[corner as usize] as usize;
        let after = corner as usize + 1;
        if after == self.offsets[f + 1] { self.offsets[f] as u32 } else { after as u32 }
    }

    fn vertex(&self, corner: u32) -> u32 {
        self.mesh.indices[corner as usize]
    }

    fn at(&self, vertex: u32) -> &[f64] {
        &self.mesh.positions[3 * vertex as usize..][..3]
    }

    fn size(&self, corner: u32) -> u32 {
        self.mesh.sizes[self.face[corner as usize] as usize]
    }

    fn twins(&self) -> Result<Vec<u32>> {
        let corners = 0..self.mesh.indices.len() as u32;
        let mut sides: Vec<_> = corners
            .map(|c| {
                let (a, b) = (self.vertex(c), self.vertex(self.next(c)));
                (a.min(b), a.max(b), c)
            })
            .collect();
        sides.sort_unstable();
        let mut twin = vec![NONE; sides.len()];
        for edge in sides.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
            match *edge {
                [_] => {}
                [(_, _, c), (_, _, d)] => {
                    twin[c as usize] = d;
                    twin[d as usize] = c;
                }
                _ => return Err(format!("edge {} {} is not manifold", edge[0].0, edge[0].1)),
            }
        }
        Ok(twin)
    }

    /// The corners by the x of their vertices.
    fn by_x(&self) -> Vec<(f64, u32)> {
        let corners = 0..self.mesh.indices.len() as u32;
        let mut all: Vec<_> = corners.map(|c| (self.at(self.vertex(c))[0], c)).collect();
        all.sort_by(|a, b| a.0.total_cmp(&b.0));
        all
    }
}

/// Two meshes and what is matched so far.
struct Walk<'a> {
    ours: Walked<'a>,
    theirs: Walked<'a>,
    at: Correspondence,
    reach: f64,
    /// Our faces and vertices that the present walk has matched.
    trail: (Vec<u32>, Vec<u32>),
}

/// Matches every face and vertex by walking both meshes from corners that lie together.
///
/// # Errors
/// If a part of ours is nowhere with them, or a mesh is not manifold.
pub fn by_adjacency(ours: &PeerMesh, theirs: &PeerMesh) -> Result<Correspondence> {
    let at = Correspondence {
        vertices: vec![NONE; ours.vertices()],
        faces: vec![NONE; ours.sizes.len()],
    };
    let reach = REACH * diagonal(&theirs.positions);
    let (ours, theirs) = (Walked::new(ours)?, Walked::new(theirs)?);
    let places = theirs.by_x();
    let mut walk = Walk { ours, theirs, at, reach, trail: Default::default() };
    for f in 0..walk.at.faces.len() {
        if walk.at.faces[f] == NONE {
            let corner = walk.ours.offsets[f] as u32;
            let starts = walk.starts(corner, &places);
            if !starts.iter().any(|&start| walk.from(corner, start)) {
                return Err(format!("face {f} is nowhere with them"));
            }
        }
    }
    Ok(walk.at)
}

impl Walk<'_> {
    /// Their corners whose vertex and next vertex lie near those of ours, nearest first.
    fn starts(&self, corner: u32, places: &[(f64, u32)]) -> Vec<u32> {
        let (v, w) = (self.ours.vertex(corner), self.ours.vertex(self.ours.next(corner)));
        let x = self.ours.at(v)[0];
        let first = places.partition_point(|place| place.0 < x - self.reach);
        let near = places[first..].iter().take_while(|place| place.0 <= x + self.reach);
        let far = |&(_, start): &(f64, u32)| {
            let (a, b) = (self.theirs.vertex(start), self.theirs.vertex(self.theirs.next(start)));
            let apart = distance(self.ours.at(v), self.theirs.at(a));
            (apart + distance(self.ours.at(w), self.theirs.at(b)), start)
        };
        let mut all: Vec<_> = near.map(far).filter(|it| it.0 <= 2.0 * self.reach).collect();
        all.sort_by(|a, b| a.0.total_cmp(&b.0));
        all.truncate(STARTS);
        all.into_iter().map(|(_, start)| start).collect()
    }

    /// Walks from a pair of corners; takes everything back if the meshes part.
    fn from(&mut self, ours: u32, theirs: u32) -> bool {
        let mut todo = vec![(ours, theirs)];
        let mut fits = true;
        while let (true, Some((c, d))) = (fits, todo.pop()) {
            fits = self.lay(c, d, &mut todo);
        }
        let (faces, vertices) = std::mem::take(&mut self.trail);
        if !fits {
            for f in faces {
                self.at.faces[f as usize] = NONE;
            }
            for v in vertices {
                self.at.vertices[v as usize] = NONE;
            }
        }
        fits
    }

    /// Lays our face at corner `c` on theirs at `d`.
    fn lay(&mut self, mut c: u32, mut d: u32, todo: &mut Vec<(u32, u32)>) -> bool {
        let (f, g) = (self.ours.face[c as usize], self.theirs.face[d as usize]);
        let known = self.at.faces[f as usize];
        if known != NONE {
            // The faces met again; that corners agree follows from their vertices.
            return known == g;
        }
        if self.ours.size(c) != self.theirs.size(d) {
            return false;
        }
        self.at.faces[f as usize] = g;
        self.trail.0.push(f);
        for _ in 0..self.ours.size(c) {
            if !self.lay_vertex(self.ours.vertex(c), self.theirs.vertex(d)) {
                return false;
            }
            match (self.ours.twin[c as usize], self.theirs.twin[d as usize]) {
                (NONE, NONE) => {}
                (NONE, _) | (_, NONE) => return false,
                twins => todo.push(twins),
            }
            (c, d) = (self.ours.next(c), self.theirs.next(d));
        }
        true
    }

    fn lay_vertex(&mut self, v: u32, w: u32) -> bool {
        let known = self.at.vertices[v as usize];
        if known != NONE {
            return known == w;
        }
        self.at.vertices[v as usize] = w;
        self.trail.1.push(v);
        distance(self.ours.at(v), self.theirs.at(w)) <= self.reach
    }
}
