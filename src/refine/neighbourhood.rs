//! What surrounds a child vertex of a corner split, read off the parent.
//!
//! Smoothing passes work on the split mesh; with this view they need no split
//! mesh to exist, so that the last level never builds one.

use super::corner_split::{Child, CornerSplit};
use crate::base::NONE;

/// How a face of an anchored mesh touches the boundary.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Side {
    /// Not along an edge.
    Inside,
    /// Along the edge from this place of the cycle to the next.
    Edge(usize),
    /// Along both edges at this place of the cycle.
    Corner(usize),
}

/// A face as a cycle of vertices that starts at the vertex in question.
#[derive(Debug, Clone)]
pub(crate) struct Cycle {
    pub(crate) vertices: Vec<u32>,
    pub(crate) side: Side,
}

impl Cycle {
    /// An empty cycle, to be filled.
    pub(crate) fn new() -> Self {
        Self { vertices: Vec::new(), side: Side::Inside }
    }

    fn clear(&mut self) {
        self.vertices.clear();
        self.side = Side::Inside;
    }

    fn set(&mut self, vertices: [u32; 4]) {
        self.clear();
        self.vertices.extend(vertices);
    }

    /// Marks the edge from `place` to the next as a boundary edge; two such
    /// edges meet, which anchored meshes guarantee.
    fn open(&mut self, place: usize) {
        self.side = match self.side {
            Side::Inside => Side::Edge(place),
            Side::Edge(before) if (before + 1) % self.vertices.len() == place => {
                Side::Corner(place)
            }
            Side::Edge(after) => Side::Corner(after),
            Side::Corner(place) => Side::Corner(place),
        };
    }
}

/// The neighbours of a boundary vertex along the boundary, and whether they are
/// corner vertices.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct BoundaryNeighbours {
    pub(crate) vertices: [u32; 2],
    pub(crate) are_corners: [bool; 2],
}

/// What surrounds a child vertex.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Neighbourhood {
    /// Isolated, or a corner of an anchored boundary: it stays.
    Fixed,
    /// On the boundary.
    Boundary(BoundaryNeighbours),
    /// Interior, around a corner of the parent: see [`CornerSplit::each_face`].
    Interior(u32),
}

impl CornerSplit<'_> {
    /// What surrounds a child vertex. On an anchored boundary, corners stay.
    pub(crate) fn neighbourhood(&self, vertex: u32, anchored: bool) -> Neighbourhood {
        match self.child(vertex) {
            Child::Isolated(_) | Child::Kappa(_) => Neighbourhood::Fixed,
            Child::Beta { corner, at_end } => {
                Neighbourhood::Boundary(self.beta_neighbours(corner, at_end))
            }
            Child::Corner(c) => {
                let v = self.parent.vert[c as usize];
                if self.lays_anchor() || self.parent.is_closed() || !self.parent.on_rim(v) {
                    Neighbourhood::Interior(c)
                } else if anchored && self.is_corner_of_rim(c) {
                    Neighbourhood::Fixed
                } else {
                    Neighbourhood::Boundary(self.rim_neighbours(c))
                }
            }
        }
    }

    /// True if both edges of the face at a corner are boundary edges.
    pub(crate) fn is_corner_of_rim(&self, corner: u32) -> bool {
        let parent = self.parent;
        parent.twin[corner as usize] == NONE && parent.ccw(corner) == NONE
    }

    fn beta_neighbours(&self, corner: u32, at_end: bool) -> BoundaryNeighbours {
        let parent = self.parent;
        let across = self.beta(corner, !at_end);
        let v = parent.vert[if at_end { parent.next(corner) } else { corner } as usize];
        let kappa = self.kappa(v);
        let around = kappa.unwrap_or_else(|| {
            let [outgoing, incoming] = self.frame(v).expect("β lies on a framed boundary");
            if at_end { outgoing } else { incoming }
        });
        BoundaryNeighbours { vertices: [across, around], are_corners: [false, kappa.is_some()] }
    }

    /// The boundary neighbours of a corner at a boundary vertex, plain split.
    fn rim_neighbours(&self, corner: u32) -> BoundaryNeighbours {
        let parent = self.parent;
        let onward = match parent.twin[corner as usize] {
            NONE => parent.next(corner),
            twin => parent.next(twin),
        };
        let back = match parent.ccw(corner) {
            NONE => parent.prev(corner),
            around => around,
        };
        let are_corners = [self.is_corner_of_rim(onward), self.is_corner_of_rim(back)];
        BoundaryNeighbours { vertices: [onward, back], are_corners }
    }

    /// The number of child faces around the interior child vertex of a corner:
    /// 4, or 3 at an interior vertex of valence 2, which gets no face.
    pub(crate) fn faces_around(&self, corner: u32) -> i64 {
        let parent = self.parent;
        let around = parent.ccw(corner);
        let two = around != NONE && parent.ccw(around) == corner;
        if two { 3 } else { 4 }
    }

    /// Calls `each` with every child face around the interior child vertex of a
    /// corner, as a cycle that starts there; boundary edges are marked if
    /// `mirrored`.
    pub(crate) fn each_face(
        &self,
        corner: u32,
        mirrored: bool,
        cycle: &mut Cycle,
        mut each: impl FnMut(&Cycle),
    ) {
        let mut visit = |cycle: &mut Cycle| {
            if !mirrored {
                cycle.side = Side::Inside;
            }
            each(cycle);
        };
        self.child_of_face(corner, cycle);
        visit(cycle);
        self.edge_after(corner, cycle);
        visit(cycle);
        if self.child_of_vertex(corner, cycle) {
            visit(cycle);
        }
        self.edge_before(corner, cycle);
        visit(cycle);
    }

    /// The parent's own face at a corner, in parent vertices; boundary edges are
    /// marked if `mirrored`.
    pub(crate) fn parent_face(&self, corner: u32, mirrored: bool, cycle: &mut Cycle) {
        self.face_from(corner, cycle);
        if mirrored {
            self.mark_boundary(cycle);
        }
        for slot in &mut cycle.vertices {
            *slot = self.parent.vert[*slot as usize];
        }
    }

    /// The face child of the corner's face.
    fn child_of_face(&self, corner: u32, cycle: &mut Cycle) {
        self.face_from(corner, cycle);
        if !self.lays_anchor() && !self.parent.is_closed() {
            self.mark_boundary(cycle);
        }
    }

    /// The corners of a face, from the given one on.
    fn face_from(&self, corner: u32, cycle: &mut Cycle) {
        let layout = &self.parent.layout;
        let face = layout.face(layout.face_of(corner));
        cycle.clear();
        cycle.vertices.extend((corner..face.end).chain(face.start..corner));
    }

    /// Marks the boundary edges of a cycle of corners.
    fn mark_boundary(&self, cycle: &mut Cycle) {
        for place in 0..cycle.vertices.len() {
            if self.parent.twin[cycle.vertices[place] as usize] == NONE {
                cycle.open(place);
            }
        }
    }

    /// The quad of the edge that leaves the corner.
    fn edge_after(&self, corner: u32, cycle: &mut Cycle) {
        let parent = self.parent;
        let next = parent.next(corner);
        match parent.twin[corner as usize] {
            NONE => {
                cycle.set([corner, self.beta(corner, false), self.beta(corner, true), next]);
                cycle.open(1);
            }
            twin => {
                cycle.set([corner, parent.next(twin), twin, next]);
                if self.opens_at(next) {
                    cycle.open(2);
                }
            }
        }
    }

    /// The quad of the edge that arrives at the corner.
    fn edge_before(&self, corner: u32, cycle: &mut Cycle) {
        let parent = self.parent;
        let prev = parent.prev(corner);
        match parent.twin[prev as usize] {
            NONE => {
                cycle.set([corner, prev, self.beta(prev, false), self.beta(prev, true)]);
                cycle.open(2);
            }
            twin => {
                cycle.set([corner, prev, parent.next(twin), twin]);
                if self.opens_at(prev) {
                    cycle.open(1);
                }
            }
        }
    }

    /// True if the vertex of a corner gets no face because it is on a boundary.
    fn opens_at(&self, corner: u32) -> bool {
        let parent = self.parent;
        !parent.is_closed() && !self.lays_anchor() && parent.on_rim(parent.vert[corner as usize])
    }

    /// The face of the corner's vertex; false if it has none.
    fn child_of_vertex(&self, corner: u32, cycle: &mut Cycle) -> bool {
        let parent = self.parent;
        cycle.clear();
        let v = parent.vert[corner as usize];
        let mut at = corner;
        loop {
            cycle.vertices.push(at);
            at = parent.ccw(at);
            if at == corner {
                return cycle.vertices.len() > 2;
            }
            if at == NONE {
                break;
            }
        }
        let [outgoing, incoming] = self.frame(v).expect("an interior child of a boundary vertex");
        let opening = cycle.vertices.len();
        cycle.vertices.push(incoming);
        cycle.vertices.extend(self.kappa(v));
        cycle.vertices.push(outgoing);
        cycle.vertices.extend(parent.fan(v).take_while(|&c| c != corner));
        cycle.open(opening);
        if self.kappa(v).is_some() {
            cycle.open(opening + 1);
        }
        true
    }
}
