//! Limits at the centres of features: at vertices of primal schemes, in faces of dual ones.

use super::Feature;
use super::local::corners_in_order;
use super::rule::Rule;
use super::weights::Weighted;
use crate::base::{Context, NONE, Result, memory};
use crate::mesh::{INFINITE, Mesh};
use crate::scheme::{Boundary, Scheme};
use std::collections::HashMap;
use std::f64::consts::PI;
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
pub(super) struct Centres<'a> {
    context: &'a Context,
    scheme: &'a Scheme,
    /// The scheme of models: there a face alone at a vertex is a side of a crease, no corner.
    of_models: Scheme,
    rules: HashMap<Feature, Rc<Rule>>,
    corners: Vec<u32>,
    middle: Vec<u32>,
}

impl<'a> Centres<'a> {
    pub(super) fn new(context: &'a Context, scheme: &'a Scheme) -> Self {
        let of_models = if scheme.creases() {
            scheme.clone().with_boundary(Boundary::Edge)
        } else {
            scheme.clone()
        };
        let (rules, corners, middle) = (HashMap::new(), Vec::new(), Vec::new());
        Self { context, scheme, of_models, rules, corners, middle }
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
        let Some(fan) = Fan::new(mesh, v, sharpness, self.scheme.creases())? else {
            return Ok(Found::Later);
        };
        let faces = fan.side.len();
        let feature = match fan.sharp {
            _ if sharpness > 0.0 && self.scheme.creases() => {
                return corner(mesh, v, &fan, row).map(|()| Found::Limit);
            }
            0 => Feature::Interior { valence: faces },
            1 => Feature::Dart { valence: faces },
            2 if faces == 1 && !self.scheme.creases() => Feature::Corner { faces },
            2 => Feature::Boundary { faces },
            _ => return corner(mesh, v, &fan, row).map(|()| Found::Limit),
        };
        self.middle = fan.side;
        self.apply(mesh, feature, row)
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
        self.middle = corners_in_order(mesh, face)?;
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
        let rule = if let Some(rule) = self.rules.get(&feature) {
            Rc::clone(rule)
        } else {
            let rule = Rc::new(Rule::new(self.context, &self.of_models, feature)?);
            self.rules.insert(feature, Rc::clone(&rule));
            rule
        };
        let like = rule.apply(mesh, &self.middle, &mut self.corners, row);
        Ok(if like { Found::Limit } else { Found::Later })
    }
}

/// A vertex that stays where it is. Its tangents are those of the fan of edges around its first
/// side, spread over less than half a turn, as the side may go round more than that; a vertex that is
/// sharp among smooth faces has none.
fn corner(mesh: &Mesh, v: u32, fan: &Fan, row: &mut Vec<Weighted>) -> Result<()> {
    memory::extend(row, [(v, [1.0, 0.0, 0.0])])?;
    if fan.sharp < 2 {
        return Ok(());
    }
    let last = fan.side.last().map(|&corner| mesh.prev(corner));
    let ends = fan.side.iter().map(|&corner| mesh.next(corner)).chain(last);
    for (k, end) in ends.enumerate() {
        let angle = PI * k as f64 / (fan.side.len() + 1) as f64;
        let [along, across] = [libm::cos(angle), libm::sin(angle)];
        let edge = [(mesh.vert[end as usize], [0.0, along, across]), (v, [0.0, -along, -across])];
        memory::extend(row, edge)?;
    }
    Ok(())
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
    fn new(mesh: &Mesh, v: u32, sharpness: f32, creases: bool) -> Result<Option<Self>> {
        let fan = memory::collect(mesh.fan(v))?;
        let at_first = |corner: u32| {
            let twin = mesh.twin[corner as usize];
            match twin {
                NONE => INFINITE,
                _ if creases => mesh.sharpness.edge(mesh.first_of_edge(corner)),
                _ => 0.0,
            }
        };
        let spokes = memory::collect(fan.iter().map(|&corner| at_first(corner)))?;
        let passing = |s: f32| s > 0.0 && s < INFINITE;
        if creases && (passing(sharpness) || spokes.iter().any(|&s| passing(s))) {
            return Ok(None);
        }
        let starts = memory::collect((0..fan.len()).filter(|&i| spokes[i] > 0.0))?;
        let is_open = mesh.on_rim(v);
        let sharp = starts.len() + usize::from(is_open);
        let mut side = fan;
        if let Some(&first) = starts.first() {
            side.rotate_left(first);
            let end = starts.get(1).map_or(side.len(), |next| next - first);
            side.truncate(end);
        }
        Ok(Some(Self { side, sharp }))
    }
}
