//! What lies around a face, seen from its first corner.

use crate::base::{NONE, Result, memory};
use crate::mesh::{Mesh, VertexSet};

/// Sides of a face, and faces around a vertex, up to which configurations are told apart.
const MOST_SIDES: usize = 16;
const MOST_FACES: u32 = 32;
/// Vertices of a ring: as many as a byte can count.
pub(super) const MOST_VERTICES: usize = 255;

/// A short list on the stack.
#[derive(Clone)]
pub(super) struct Short {
    items: [u32; MOST_VERTICES + 1],
    len: usize,
}

impl Default for Short {
    fn default() -> Self {
        Self { items: [0; MOST_VERTICES + 1], len: 0 }
    }
}

impl Short {
    /// Adds an item; a list that is too long counts on and has lost some.
    #[inline(always)]
    fn push(&mut self, item: u32) {
        self.items[self.len & MOST_VERTICES] = item;
        self.len += 1;
    }

    fn is_whole(&self) -> bool {
        self.len <= MOST_VERTICES
    }
}

impl std::ops::Deref for Short {
    type Target = [u32];

    #[inline(always)]
    fn deref(&self) -> &[u32] {
        &self.items[..self.len.min(MOST_VERTICES)]
    }
}

/// A face and the faces that touch it.
#[derive(Clone, Default)]
pub(super) struct Ring {
    /// The vertices of the face from its first corner on, then those around it.
    pub(super) vertices: Short,
    /// The edges that begin at a vertex of the face, by the corners there: those of the
    /// face itself come first in each case.
    pub(super) edges: Short,
    /// The sides of the face; for each of its vertices the number of faces there and their
    /// sides: two faces with the same have the same rows inside.
    pub(super) signature: Short,
}

impl Ring {
    /// Walks around a face all of whose vertices are interior. False if there are too many
    /// neighbours to tell apart.
    pub(super) fn walk(&mut self, mesh: &Mesh, face: u32) -> bool {
        let corners = mesh.layout.face(face);
        (self.vertices.len, self.edges.len, self.signature.len) = (0, 0, 0);
        if corners.len() > MOST_SIDES {
            return false;
        }
        self.signature.push(corners.len() as u32);
        for &v in &mesh.vert[corners.start as usize..corners.end as usize] {
            self.vertices.push(v);
        }
        let mut first = mesh.twin[corners.end as usize - 1];
        for corner in corners {
            if first == NONE || !self.walk_vertex(mesh, corner, first) {
                return false;
            }
            first = mesh.twin[corner as usize];
        }
        self.vertices.is_whole() && self.edges.is_whole() && self.signature.is_whole()
    }

    /// Goes around the vertex of a corner, from the face across the edge before it to that
    /// across its own, and takes from each face but the first what those before did not have.
    #[inline(always)]
    fn walk_vertex(&mut self, mesh: &Mesh, corner: u32, first: u32) -> bool {
        let across = mesh.twin[corner as usize];
        if across == NONE {
            return false;
        }
        let (place, mut faces) = (self.signature.len, 2);
        self.edges.push(corner);
        self.signature.push(0);
        let (mut at, mut around) = (first, mesh.layout.face_around(first));
        let beyond = mesh.layout.face_around(across);
        let last = if across + 1 == beyond.end { beyond.start } else { across + 1 };
        while at != last {
            let before = if at == around.start { around.end - 1 } else { at - 1 };
            at = mesh.twin[before as usize];
            faces += 1;
            if at == NONE || at == corner || faces > MOST_FACES {
                return false;
            }
            around = mesh.layout.face_around(at);
            let sides = around.len() as u32;
            // The vertex itself and the one before are known; across an edge so are its ends.
            let fresh = if at == last { sides - 3 } else { sides - 2 };
            for next in at + 2..at + 2 + fresh {
                let c = if next >= around.end { next - sides } else { next };
                self.vertices.push(mesh.vert[c as usize]);
            }
            self.edges.push(at);
            self.signature.push(sides);
        }
        self.signature.items[place & MOST_VERTICES] = faces;
        // Of two faces around a vertex nobody knows which is which.
        faces > 2
    }

    /// Walks around a face and names each vertex once.
    pub(super) fn walk_once(&mut self, mesh: &Mesh, face: u32) -> bool {
        self.walk(mesh, face) && self.name_once()
    }

    /// Names each vertex once. Which of them came several times is part of the signature.
    fn name_once(&mut self) -> bool {
        let all = self.vertices.clone();
        self.vertices.len = 0;
        for (place, &v) in (0..).zip(&*all) {
            match self.vertices.iter().position(|&known| known == v) {
                Some(known) => {
                    self.signature.push(place);
                    self.signature.push(known as u32);
                }
                None => self.vertices.push(v),
            }
        }
        // The face itself may not: its slots would not be told apart.
        self.signature.is_whole() && self.vertices.starts_with(&all[..self.signature[0] as usize])
    }
}

/// Walks around the faces of a mesh of any kind.
pub(super) struct Walker<'a> {
    mesh: &'a Mesh,
    /// The vertices that need not follow the smooth rule.
    ruled: VertexSet,
    /// For every vertex the last face that had it in its ring.
    seen: Vec<u32>,
}

impl<'a> Walker<'a> {
    /// `ruled` may be in any order.
    pub(super) fn new(mesh: &'a Mesh, ruled: impl Iterator<Item = u32>) -> Result<Self> {
        let mut ruled = memory::collect(ruled)?;
        ruled.sort_unstable();
        ruled.dedup();
        let ruled = VertexSet::new(mesh.vertices(), &ruled)?;
        Ok(Self { mesh, ruled, seen: memory::filled(NONE, mesh.vertices())? })
    }

    /// Walks around a face. False if a vertex of it is ruled or if there are too many
    /// neighbours. Each face may be asked for once.
    pub(super) fn walk(&mut self, face: u32, ring: &mut Ring) -> bool {
        let smooth = |&v: &u32| !self.ruled.contains(v);
        if !self.mesh.face_vertices(face as usize).iter().all(smooth)
            || !ring.walk(self.mesh, face)
            || ring.vertices.len == ring.signature[0] as usize
        {
            return false;
        }
        let mut twice = false;
        for &v in &*ring.vertices {
            twice |= std::mem::replace(&mut self.seen[v as usize], face) == face;
        }
        !twice || ring.name_once()
    }
}
