//! Points in whose convex hull the surface over a part of a face lies.
//!
//! A step whose weights are nowhere negative makes every new point an average of old ones, so
//! that what a cell's points become for ever stays in their hull, features or not.

use super::cell::Kind;
use super::nodes::Node;
use super::{NONE, Sample, Surface};
use crate::base::{Error, ErrorKind, Result, memory};
use glam::DVec3;

impl Surface {
    /// True if no step around a feature has a negative weight.
    pub(in crate::limit) fn is_positive(&self) -> bool {
        // A regular triangle at a boundary is made of points beyond that, by no step.
        let is_step = |kind: &Kind, node: u32| {
            *kind != Kind::Sector || !matches!(self.nodes[node as usize], Node::Triangle)
        };
        self.nodes.iter().all(|node| match node {
            Node::Split { kind, children } => {
                let steps = children.iter().flatten().filter(|child| is_step(kind, child.node));
                let mut weights = steps.flat_map(|child| child.rows().flatten());
                weights.all(|&(_, weight)| weight >= 0.0)
            }
            _ => true,
        })
    }

    /// For each node whether the surface is evaluated at all points of its cell.
    pub(in crate::limit) fn complete_nodes(&self) -> Result<Vec<bool>> {
        let mut complete = memory::filled(true, self.nodes.len())?;
        loop {
            let mut changed = false;
            for (i, node) in self.nodes.iter().enumerate() {
                let is_complete = match node {
                    Node::Refused(_) => false,
                    Node::Split { children, .. } => children.iter().all(|child| {
                        child.as_ref().is_some_and(|child| complete[child.node as usize])
                    }),
                    Node::Grid(_) | Node::Triangle => true,
                };
                changed |= complete[i] != is_complete;
                complete[i] = is_complete;
            }
            if !changed {
                return Ok(complete);
            }
        }
    }

    /// Whether the surface is evaluated all over a face or sector, by [`Self::complete_nodes`].
    pub(in crate::limit) fn is_complete(&self, complete: &[bool], face: u32, sector: u32) -> bool {
        let corners = self.mesh.layout.face(face);
        let quarters = self.has_quarters() && self.sectors(face as usize) == 1;
        let cells =
            if quarters { corners } else { corners.start + sector..corners.start + sector + 1 };
        cells.into_iter().all(|corner| {
            let node = self.roots[corner as usize].node;
            node != NONE && complete[node as usize]
        })
    }

    /// The points of the irregular cell that is the square or triangle with sides so long
    /// around a point inside it, as in [`Self::piece`], from three positions for each vertex.
    ///
    /// # Errors
    /// As [`Surface::evaluate`] for the point; [`ErrorKind::BrokenInvariant`] for other parts.
    pub(in crate::limit) fn cell_hull(
        &self,
        inside: &Sample,
        side: f64,
        positions: &[f64],
    ) -> Result<Vec<DVec3>> {
        let start = self.start(inside)?;
        let scale =
            if self.has_quarters() && self.sectors(inside.face as usize) == 1 { 2.0 } else { 1.0 };
        let position = |&v: &u32| DVec3::from_slice(&positions[3 * v as usize..]);
        let mut points = memory::collect(self.cell_points(start.corner).iter().map(position))?;
        let (mut node, mut at, mut side) = (start.node, start.at, side * scale);
        loop {
            let Node::Split { kind, children } = &self.nodes[node as usize] else {
                return Err(Error::new(ErrorKind::BrokenInvariant, "a cell is not irregular"));
            };
            let is_same = *kind == Kind::Sector;
            if side > 0.5 && !is_same {
                return Ok(points);
            }
            let (place, map) = kind.child(at);
            let child = children[place].as_ref();
            let child = child
                .ok_or_else(|| Error::new(ErrorKind::BrokenInvariant, "a cell has no child"))?;
            let sum = |row: &[(u32, f64)]| {
                row.iter().fold(DVec3::ZERO, |sum, &(i, weight)| sum + weight * points[i as usize])
            };
            points = memory::collect(child.rows().map(sum))?;
            if !is_same {
                (at, side) = (map.apply(at), 2.0 * side);
            }
            node = child.node;
        }
    }
}
