//! Limits at the centres of features: at vertices of primal schemes, in faces of dual ones.

use super::Feature;
use super::local::corners_in_order;
use super::rule::Rule;
use super::weights::Weighted;
use crate::base::{NONE, Result};
use crate::mesh::{INFINITE, Mesh};
use crate::scheme::{Boundary, Scheme};
use std::collections::HashMap;
use std::rc::Rc;

/// What is known about the limit at a centre.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Found {
    /// The row has it.
    Limit,
    /// A later level has to tell: other features are too near, or sharpness is not used up.
    Later,
}

/// Finds limits, each kind of feature once.
pub(super) struct Centres {
    scheme: Scheme,
    rules: HashMap<Feature, Rc<Rule>>,
    corners: Vec<u32>,
    middle: Vec<u32>,
}

impl Centres {
    pub(super) fn new(scheme: &Scheme) -> Self {
        // Faces beside a boundary without a rule are holes; the curve there is the same.
        let scheme = match scheme.creases() && scheme.boundary() == Boundary::None {
            true => scheme.clone().with_boundary(Boundary::Edge),
            false => scheme.clone(),
        };
        Self { scheme, rules: HashMap::new(), corners: Vec::new(), middle: Vec::new() }
    }

    /// The limit of a vertex of a primal scheme.
    ///
    /// On a crease and at a corner tangents are those of one side: that which the vertex's fan
    /// comes to first.
    ///
    /// # Errors
    /// [`ErrorKind::Unsupported`] if points do not converge there or a feature has too many faces.
    pub(super) fn vertex(&mut self, mesh: &Mesh, v: u32, row: &mut Vec<Weighted>) -> Result<Found> {
        row.clear();
        if mesh.start[v as usize] == NONE {
            row.push((v, [1.0, 0.0, 0.0]));
            return Ok(Found::Limit);
        }
        let sharpness = self.scheme.vertex_sharpness(mesh, v);
        let Some(fan) = Fan::new(mesh, v, sharpness, self.scheme.creases()) else {
            return Ok(Found::Later);
        };
        self.middle.clear();
        let faces = fan.side.len();
        self.middle.extend(fan.side);
        let feature = match fan.sharp {
            _ if sharpness > 0.0 && self.scheme.creases() => return Ok(self.corner(mesh, v, row)),
            0 => Feature::Interior { valence: faces },
            1 => Feature::Dart { valence: faces },
            2 if faces == 1 && !self.scheme.creases() => Feature::Corner { faces },
            2 => Feature::Boundary { faces },
            _ => return Ok(self.corner(mesh, v, row)),
        };
        self.apply(mesh, feature, row)
    }

    /// A vertex that stays where it is, its tangents along the edges of its first side.
    fn corner(&self, mesh: &Mesh, v: u32, row: &mut Vec<Weighted>) -> Found {
        row.push((v, [1.0, -1.0, -1.0]));
        if let [first, .., last] | [first @ last] = self.middle[..] {
            let [along, across] = [mesh.next(first), mesh.prev(last)];
            row.push((mesh.vert[along as usize], [0.0, 1.0, 0.0]));
            row.push((mesh.vert[across as usize], [0.0, 0.0, 1.0]));
        }
        Found::Limit
    }

    /// The limit in the middle of a face of a dual scheme.
    ///
    /// # Errors
    /// As [`Centres::vertex`].
    pub(super) fn face(
        &mut self,
        mesh: &Mesh,
        face: u32,
        row: &mut Vec<Weighted>,
    ) -> Result<Found> {
        self.middle = corners_in_order(mesh, face);
        let open = self.middle.iter().filter(|&&c| mesh.twin[c as usize] == NONE).count();
        let sides = self.middle.len();
        let feature = match open {
            0 => Feature::Interior { valence: sides },
            1 if sides > 2 => Feature::Boundary { faces: sides - 2 },
            2 if sides > 3 => Feature::Corner { faces: sides - 3 },
            _ => return Ok(Found::Later),
        };
        self.apply(mesh, feature, row)
    }

    fn apply(&mut self, mesh: &Mesh, feature: Feature, row: &mut Vec<Weighted>) -> Result<Found> {
        let rule = match self.rules.get(&feature) {
            Some(rule) => Rc::clone(rule),
            None => {
                let rule = Rc::new(Rule::new(&self.scheme, feature)?);
                self.rules.insert(feature, Rc::clone(&rule));
                rule
            }
        };
        let like = rule.apply(mesh, &self.middle, &mut self.corners, row);
        Ok(if like { Found::Limit } else { Found::Later })
    }
}

/// The faces around a vertex as its limit sees them.
struct Fan {
    /// Corners of the first side between sharp edges, counter-clockwise; all if there is but one.
    side: Vec<u32>,
    /// Edges that stay sharp, those of the boundary included.
    sharp: usize,
}

impl Fan {
    /// Nothing if something there is sharp, but not for ever.
    fn new(mesh: &Mesh, v: u32, sharpness: f32, creases: bool) -> Option<Self> {
        let fan: Vec<u32> = mesh.fan(v).collect();
        let at_first = |corner: u32| {
            let twin = mesh.twin[corner as usize];
            match twin {
                NONE => INFINITE,
                _ if creases => mesh.sharpness.edge(mesh.first_of_edge(corner)),
                _ => 0.0,
            }
        };
        let spokes: Vec<f32> = fan.iter().map(|&corner| at_first(corner)).collect();
        let passing = |s: f32| s > 0.0 && s < INFINITE;
        if creases && (passing(sharpness) || spokes.iter().any(|&s| passing(s))) {
            return None;
        }
        let starts: Vec<usize> = (0..fan.len()).filter(|&i| spokes[i] > 0.0).collect();
        let is_open = mesh.on_rim(v);
        let sharp = starts.len() + usize::from(is_open);
        let mut side = fan;
        if let Some(&first) = starts.first() {
            side.rotate_left(first);
            let end = starts.get(1).map_or(side.len(), |next| next - first);
            side.truncate(end);
        }
        Some(Self { side, sharp })
    }
}
