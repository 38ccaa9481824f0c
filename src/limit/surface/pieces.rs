//! What the surface is over a part of a face: one polynomial, smooth, neither, or nothing.

use super::cell::Kind;
use super::nodes::Node;
use super::univariate::Univariate;
use super::{Sample, Surface};
use crate::base::Result;
use crate::scheme::Method;

/// The highest degree along an axis of what counts as a polynomial.
const DEGREE: usize = 4;

/// What the surface is over a square or triangle of a face.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::limit) enum Piece {
    /// One polynomial of degree 4 at most, along each axis of a square and in all of a triangle.
    Polynomial,
    /// That of a regular mesh.
    Regular,
    /// Anything; there may be a feature in it.
    Irregular,
    /// Not evaluated, in part at least.
    Missing,
}

impl Surface {
    /// True if the regular pieces of a quad are its quarters.
    pub(in crate::limit) fn has_quarters(&self) -> bool {
        self.method == Method::Dual
    }

    /// True if a face is a triangle with coordinates of its own.
    pub(in crate::limit) fn is_triangle(&self, face: usize) -> bool {
        self.method == Method::Loop && self.mesh.face_corners(face).len() == 3
    }

    /// The faces that are holes, ascending.
    pub(in crate::limit) fn holes(&self) -> &[u32] {
        &self.holes
    }

    /// What the surface is over the square or triangle with sides so long around a point inside
    /// it. Sides are powers of 1/2, and the part is one that so many halvings lead to.
    ///
    /// # Errors
    /// As [`Surface::evaluate`] for the point.
    pub(in crate::limit) fn piece(&self, inside: &Sample, side: f64) -> Result<Piece> {
        let start = self.start(inside)?;
        let scale =
            if self.has_quarters() && self.sectors(inside.face as usize) == 1 { 2.0 } else { 1.0 };
        let (mut node, mut at, mut side) = (start.node, start.at, side * scale);
        loop {
            match &self.nodes[node as usize] {
                Node::Refused(_) => return Ok(Piece::Missing),
                Node::Grid(_) => {
                    let spline = matches!(self.univariate, Some(Univariate::Spline(0..=DEGREE)));
                    return Ok(if spline { Piece::Polynomial } else { Piece::Regular });
                }
                Node::Triangle => return Ok(Piece::Polynomial),
                // The cell itself, with other points.
                Node::Split { kind: Kind::Sector, children } => match &children[0] {
                    Some(child) => node = child.node,
                    None => return Ok(Piece::Missing),
                },
                Node::Split { .. } if side > 0.5 => return Ok(Piece::Irregular),
                Node::Split { kind, children } => {
                    let (place, map) = kind.child(at);
                    let Some(child) = &children[place] else { return Ok(Piece::Missing) };
                    (node, at, side) = (child.node, map.apply(at), 2.0 * side);
                }
            }
        }
    }
}
