//! What a limit is made of, and the way to it from the middle of a feature.

use super::local::Model;
use super::neighbourhood::walk;
use super::weights::{Weighted, at_centre};
use super::{Feature, LocalMatrix};
use crate::base::{Context, Error, ErrorKind, NONE, Result};
use crate::mesh::Mesh;
use crate::scheme::{Scheme, SplitKind};
use std::collections::HashMap;

/// The limit at the centre of a feature: a walk from the corners in the middle, which tells
/// whether a mesh is like the model as far as that matters, and weights on the way.
#[derive(Debug)]
pub(super) struct Rule {
    steps: Vec<Step>,
    /// Corners in the middle: the first steps.
    middle: usize,
    /// Weights of the vertices of steps, by number.
    entries: Vec<Weighted>,
}

/// A corner on the way.
#[derive(Debug)]
struct Step {
    /// The step before and whether it is left across its edge.
    from: Option<(usize, bool)>,
    /// Sides of the face.
    sides: u32,
    /// Whether the edge is on the boundary, where that matters.
    open: Option<bool>,
    /// The step across the edge, if that is one: around a vertex the way closes.
    across: Option<usize>,
}

/// Edges to cross to all faces whose look decides the limit. Without passes the faces in the
/// middle say it all: they alone make the children of the vertices that have weights.
fn reach(scheme: &Scheme) -> u32 {
    2 * scheme.passes().len() as u32
}

impl Rule {
    /// The rule at a feature.
    ///
    /// # Errors
    /// As [`LocalMatrix::new`]; [`ErrorKind::Unsupported`] if points do not converge.
    pub(super) fn new(context: &Context, scheme: &Scheme, feature: Feature) -> Result<Self> {
        let reach = reach(scheme);
        let model = Model::new(scheme, feature, reach.max(2))?;
        let matrix = LocalMatrix::of_model(&model, feature, None)?;
        let weights = at_centre(context, &model, &matrix)?;
        let mesh = model.mesh();
        let mut middle: Vec<[u32; 2]> =
            model.middle.iter().map(|&[corner, _]| [corner; 2]).collect();
        if let Feature::Dart { .. } = feature {
            // Its crease comes first.
            let sharp =
                |&[corner, _]: &[u32; 2]| mesh.sharpness.edge(mesh.first_of_edge(corner)) > 0.0;
            let first = middle.iter().position(sharp);
            middle.rotate_left(first.unwrap_or(0));
        }
        let walked = walk([mesh, mesh], &middle, reach);
        let mut places: HashMap<u32, u32> = HashMap::new();
        for (place, step) in (0..).zip(&walked) {
            places.entry(mesh.vert[step.corners[0] as usize]).or_insert(place);
        }
        let placed = |&(v, weights): &Weighted| places.get(&v).map(|&place| (place, weights));
        let entries: Option<Vec<Weighted>> = weights.iter().map(placed).collect();
        let lost = || Error::new(ErrorKind::BrokenInvariant, "a limit depends on distant vertices");
        let seen: HashMap<u32, usize> =
            walked.iter().enumerate().map(|(place, step)| (step.corners[0], place)).collect();
        // At a vertex without passes the boundary is one of its sides, such as a crease.
        let minds_edges = reach > 0 || scheme.split() == SplitKind::Corner;
        let steps = walked.iter().map(|step| {
            let corner = step.corners[0];
            let twin = mesh.twin[corner as usize];
            Step {
                across: seen.get(&twin).copied(),
                from: step.from,
                sides: sides(mesh, corner),
                open: minds_edges.then_some(twin == NONE),
            }
        });
        Ok(Self {
            steps: steps.collect(),
            middle: middle.len(),
            entries: entries.ok_or_else(lost)?,
        })
    }

    /// Goes the way in a mesh from corners in the middle. False if it looks otherwise than
    /// the model; else `row` has the vertices and weights, of which some may name one vertex.
    pub(super) fn apply(
        &self,
        mesh: &Mesh,
        middle: &[u32],
        corners: &mut Vec<u32>,
        row: &mut Vec<Weighted>,
    ) -> bool {
        debug_assert_eq!(middle.len(), self.middle, "corners of another feature");
        corners.clear();
        for (place, step) in self.steps.iter().enumerate() {
            let corner = match step.from {
                None => middle[place],
                Some((from, true)) => mesh.twin[corners[from] as usize],
                Some((from, false)) => mesh.next(corners[from]),
            };
            let open = || mesh.twin[corner as usize] == NONE;
            if sides(mesh, corner) != step.sides || step.open.is_some_and(|o| o != open()) {
                return false;
            }
            corners.push(corner);
        }
        let closes = |(step, &corner): (&Step, &u32)| {
            step.across.is_none_or(|place| mesh.twin[corner as usize] == corners[place])
        };
        if !self.steps.iter().zip(&*corners).all(closes) {
            return false;
        }
        row.clear();
        let vertex = |place: u32| mesh.vert[corners[place as usize] as usize];
        row.extend(self.entries.iter().map(|&(place, weights)| (vertex(place), weights)));
        true
    }
}

fn sides(mesh: &Mesh, corner: u32) -> u32 {
    mesh.layout.face_around(corner).len() as u32
}
