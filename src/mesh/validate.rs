//! One function that checks every invariant a [`Mesh`] relies on.

use super::near::{LEADS, STARTS};
use super::{Mesh, VertexSet};
use crate::base::{Error, ErrorKind, NONE, Result, memory};

impl Mesh {
    /// Checks every stored invariant: the table in the module's documentation,
    /// and that the topology is an orientable 2-manifold but for the joints of policy
    /// `sharpen`. O(H).
    ///
    /// # Errors
    /// [`ErrorKind::BrokenInvariant`], which is a defect of this library;
    /// [`ErrorKind::OutOfResources`].
    pub fn validate(&self) -> Result<()> {
        self.check_layout()?;
        self.check_corners()?;
        self.check_fans()?;
        self.check_lists()?;
        if self.anchored { super::anchor::check(self) } else { Ok(()) }
    }

    fn check_layout(&self) -> Result<()> {
        let corners = self.layout.corners() as usize;
        ensure(self.layout.is_consistent(), "layout", 0)?;
        ensure(self.vert.len() == corners && self.twin.len() == corners, "array lengths", corners)?;
        let Some(source) = &self.face_source else { return Ok(()) };
        let mut sorted = memory::copied(source)?;
        sorted.sort_unstable();
        let permutation = sorted.iter().enumerate().all(|(i, &f)| i == f as usize);
        ensure(permutation && source.len() == self.faces(), "face source", 0)
    }

    /// Indices in range, twins mutual, edges running opposite ways.
    fn check_corners(&self) -> Result<()> {
        for c in 0..self.layout.corners() {
            let v = self.vert[c as usize];
            ensure((v as usize) < self.start.len(), "vertex of corner", c as usize)?;
            let twin = self.twin[c as usize];
            if twin == NONE {
                continue;
            }
            ensure((twin as usize) < self.twin.len(), "twin range", c as usize)?;
            ensure(self.twin[twin as usize] == c && twin != c, "twin of twin", c as usize)?;
            let end = self.vert[self.next(c) as usize];
            let back = self.vert[self.next(twin) as usize];
            ensure(self.vert[twin as usize] == end && back == v, "twin's vertices", c as usize)?;
        }
        Ok(())
    }

    /// Every corner is in the one fan of its vertex, which starts where it should.
    fn check_fans(&self) -> Result<()> {
        let mut reached = 0;
        for (v, &start) in self.start.iter().enumerate() {
            ensure(start == NONE || (start as usize) < self.vert.len(), "range of start", v)?;
            reached += self.check_fan(v, start)?;
        }
        for &(v, start) in &self.joints.fans {
            let named = (v as usize) < self.start.len() && (start as usize) < self.vert.len();
            ensure(named, "further fan", v as usize)?;
            reached += self.check_fan(v as usize, start)?;
        }
        ensure(reached == self.vert.len(), "corners reached by fans", reached)
    }

    /// The number of corners of a fan that stays at its vertex.
    fn check_fan(&self, vertex: usize, start: u32) -> Result<usize> {
        let fan = memory::collect(self.fan_from(start))?;
        let at_vertex = fan.iter().all(|&c| self.vert[c as usize] as usize == vertex);
        ensure(at_vertex, "fan", vertex)?;
        let closed = fan.last().is_none_or(|&last| self.ccw(last) == start);
        let open = start != NONE && self.twin[start as usize] == NONE;
        ensure(closed || open, "start of fan", vertex)?;
        Ok(fan.len())
    }

    /// Sides of one edge run between the same vertices, and the smallest leads.
    fn check_joints(&self) -> Result<()> {
        let sides = &self.joints.sides;
        let ends = |c: u32| {
            let (a, b) = (self.vert[c as usize], self.vert[self.next(c) as usize]);
            (a.min(b), a.max(b))
        };
        for &(c, leader) in sides {
            let open = self.twin.get(c as usize) == Some(&NONE) && leader <= c;
            ensure(open && self.joints.leader(leader) == Some(leader), "side", c as usize)?;
            ensure(ends(c) == ends(leader), "ends of side", c as usize)?;
        }
        let ascending = sides.windows(2).all(|pair| pair[0].0 < pair[1].0);
        let fans = self.joints.fans.windows(2).all(|pair| pair[0] < pair[1]);
        ensure(ascending && fans, "order of joints", sides.len())
    }

    fn check_lists(&self) -> Result<()> {
        let open = (0..).zip(&self.twin).filter(|(_, twin)| **twin == NONE).map(|(c, _)| c);
        ensure(self.rim.iter().copied().eq(open), "rim", self.rim.len())?;
        let special = (0..self.start.len() as u32).filter(|&v| !self.is_regular(v));
        ensure(self.special.iter().copied().eq(special), "special", self.special.len())?;
        let set = VertexSet::new(self.start.len(), &self.special)?;
        self.check_near()?;
        self.check_joints()?;
        ensure(self.sharpness.is_consistent(self), "sharpness", self.sharpness.edges.len())?;
        let runs =
            self.runs.is_sorted() && self.runs.iter().all(|&v| v as usize <= self.start.len());
        ensure(runs, "runs", self.runs.len())?;
        let holes = self.holes.windows(2).all(|pair| pair[0] < pair[1])
            && self.holes.iter().all(|&f| (f as usize) < self.faces());
        ensure(holes, "holes", self.holes.len())?;
        ensure(self.special_set == set, "set of special vertices", self.special.len())?;
        let sorted = self.corner_tags.windows(2).all(|pair| pair[0] < pair[1])
            && self.corner_tags.iter().all(|&v| (v as usize) < self.start.len());
        ensure(sorted, "order of corner tags", self.corner_tags.len())?;
        let tagged = self.corner_tags.iter().all(|&v| self.on_rim(v));
        ensure(tagged, "corner tags", self.corner_tags.len())
    }
}

impl Mesh {
    /// One corner leads each interior edge, and the right ones start fans.
    fn check_near(&self) -> Result<()> {
        let Some(near) = &self.near else { return Ok(()) };
        let first = self.layout.first_quad_corner();
        let quads = (self.layout.corners() - first) as usize / 4;
        let sizes = near.irregular.len() == first as usize && near.quads.len() == quads;
        ensure(sizes, "sizes of near", quads)?;
        for c in 0..self.layout.corners() {
            let leads = |c| near.corner(first, c) & LEADS != 0;
            let led = match self.twin[c as usize] {
                NONE => !leads(c),
                twin => leads(c) != leads(twin),
            };
            ensure(led, "leader of edge", c as usize)?;
            let v = self.vert[c as usize];
            let starts = self.start[v as usize] == c && !self.special_set.contains(v);
            ensure((near.corner(first, c) & STARTS != 0) == starts, "starts", c as usize)?;
        }
        Ok(())
    }
}

fn ensure(holds: bool, what: &str, at: usize) -> Result<()> {
    if holds {
        return Ok(());
    }
    Err(Error::new(ErrorKind::BrokenInvariant, format!("broken invariant: {what} ({at})")))
}
