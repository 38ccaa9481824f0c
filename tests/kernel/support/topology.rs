//! Adjacency rebuilt from the faces alone, by brute force.
//!
//! Corners are numbered by their place in the concatenated face-vertex array.
//! The face list must be manifold (see [`super::manifold`]).

use std::collections::HashMap;

/// Everything that the faces say about their neighbours.
#[derive(Clone, Debug)]
pub struct Topology {
    /// Vertex of each corner.
    pub vert: Vec<usize>,
    /// Face of each corner.
    pub face: Vec<usize>,
    /// Position of each corner in its face.
    pub position: Vec<usize>,
    pub next: Vec<usize>,
    pub prev: Vec<usize>,
    /// The corner across the edge from `vert[c]` to `vert[next[c]]`.
    pub twin: Vec<Option<usize>>,
    /// Corners of each vertex, counter-clockwise: from the outgoing boundary
    /// edge on the boundary, from the smallest corner inside.
    pub fans: Vec<Vec<usize>>,
    /// First corner of each face.
    pub first: Vec<usize>,
}

impl Topology {
    pub fn new(vertices: usize, faces: &[Vec<usize>]) -> Self {
        let mut it = Self {
            vert: faces.concat(),
            face: Vec::new(),
            position: Vec::new(),
            next: Vec::new(),
            prev: Vec::new(),
            twin: Vec::new(),
            fans: Vec::new(),
            first: Vec::new(),
        };
        for (f, cycle) in faces.iter().enumerate() {
            it.push_face(f, cycle.len());
        }
        it.twin = it.find_twins();
        it.fans = it.find_fans(vertices);
        it
    }

    fn push_face(&mut self, f: usize, n: usize) {
        let first = self.face.len();
        self.first.push(first);
        for i in 0..n {
            self.face.push(f);
            self.position.push(i);
            self.next.push(first + (i + 1) % n);
            self.prev.push(first + (i + n - 1) % n);
        }
    }

    fn find_twins(&self) -> Vec<Option<usize>> {
        let ends = |c: usize| (self.vert[c], self.vert[self.next[c]]);
        let by_ends: HashMap<_, _> = (0..self.vert.len()).map(|c| (ends(c), c)).collect();
        let twin = |c| {
            let (a, b) = ends(c);
            by_ends.get(&(b, a)).copied()
        };
        (0..self.vert.len()).map(twin).collect()
    }

    fn find_fans(&self, vertices: usize) -> Vec<Vec<usize>> {
        let mut corners = vec![Vec::new(); vertices];
        for (c, &v) in self.vert.iter().enumerate() {
            corners[v].push(c);
        }
        corners.iter().map(|around| self.fan_of(around)).collect()
    }

    fn fan_of(&self, around: &[usize]) -> Vec<usize> {
        let start = around.iter().find(|&&c| self.twin[c].is_none()).or(around.first());
        let mut fan = Vec::new();
        let mut at = start.copied();
        while let Some(c) = at {
            fan.push(c);
            at = self.twin[self.prev[c]].filter(|g| Some(g) != start);
        }
        assert_eq!(fan.len(), around.len(), "a vertex has several fans: not a manifold");
        fan
    }

    pub fn corner_count(&self) -> usize {
        self.vert.len()
    }

    pub fn face_count(&self) -> usize {
        self.first.len()
    }

    /// Corners of a face, in its order.
    pub fn corners_of(&self, f: usize) -> Vec<usize> {
        let end = self.first.get(f + 1).copied().unwrap_or(self.vert.len());
        (self.first[f]..end).collect()
    }

    /// Whether the edge that leaves a corner is on the boundary.
    pub fn is_boundary_edge(&self, c: usize) -> bool {
        self.twin[c].is_none()
    }

    pub fn is_isolated(&self, v: usize) -> bool {
        self.fans[v].is_empty()
    }

    pub fn is_boundary(&self, v: usize) -> bool {
        self.fans[v].first().is_some_and(|&c| self.is_boundary_edge(c))
    }

    pub fn is_interior(&self, v: usize) -> bool {
        !self.is_isolated(v) && !self.is_boundary(v)
    }

    /// A boundary vertex with one face.
    pub fn is_single_face(&self, v: usize) -> bool {
        self.is_boundary(v) && self.fans[v].len() == 1
    }

    /// One corner of each interior edge: the smaller of the two.
    pub fn interior_edges(&self) -> Vec<usize> {
        (0..self.vert.len()).filter(|&c| self.twin[c].is_some_and(|g| c < g)).collect()
    }

    /// The corner of each boundary edge.
    pub fn boundary_edges(&self) -> Vec<usize> {
        (0..self.vert.len()).filter(|&c| self.is_boundary_edge(c)).collect()
    }

    pub fn edge_count(&self) -> usize {
        self.interior_edges().len() + self.boundary_edges().len()
    }

    /// The vertex before and the one after a boundary vertex along its loop.
    pub fn boundary_neighbours(&self, v: usize) -> (usize, usize) {
        let fan = &self.fans[v];
        let last = fan[fan.len() - 1];
        (self.vert[self.prev[last]], self.vert[self.next[fan[0]]])
    }

    /// Boundary loops as vertex cycles, in the direction of their faces.
    pub fn boundary_loops(&self) -> Vec<Vec<usize>> {
        let mut seen = vec![false; self.fans.len()];
        let mut loops = Vec::new();
        for start in (0..self.fans.len()).filter(|&v| self.is_boundary(v)) {
            let mut at = start;
            let mut cycle = Vec::new();
            while !seen[at] {
                seen[at] = true;
                cycle.push(at);
                at = self.boundary_neighbours(at).1;
            }
            if !cycle.is_empty() {
                loops.push(cycle);
            }
        }
        loops
    }

    /// The faces of each connected component, by their smallest face.
    pub fn components(&self) -> Vec<Vec<usize>> {
        let mut seen = vec![false; self.face_count()];
        let mut components = Vec::new();
        for start in 0..self.face_count() {
            if !seen[start] {
                components.push(self.flood(start, &mut seen));
            }
        }
        components
    }

    fn flood(&self, start: usize, seen: &mut [bool]) -> Vec<usize> {
        seen[start] = true;
        let mut component = vec![start];
        let mut done = 0;
        while done < component.len() {
            let across = self.corners_of(component[done]).into_iter().filter_map(|c| self.twin[c]);
            for f in across.map(|g| self.face[g]) {
                if !std::mem::replace(&mut seen[f], true) {
                    component.push(f);
                }
            }
            done += 1;
        }
        component.sort_unstable();
        component
    }

    pub fn isolated(&self) -> Vec<usize> {
        (0..self.fans.len()).filter(|&v| self.is_isolated(v)).collect()
    }

    /// V − E + F, without isolated vertices.
    pub fn euler_characteristic(&self) -> i64 {
        let used = self.fans.len() - self.isolated().len();
        (used + self.face_count()) as i64 - self.edge_count() as i64
    }
}
