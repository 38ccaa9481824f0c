//! Which rule holds at a vertex, as OpenSubdiv decides it.
//!
//! A vertex is smooth with no sharp edge, a dart with one, on a crease with two, a corner
//! with more or if it is sharp itself. Where the sharpness left for the children gives
//! another rule, both are mixed by the part of a step that the sharpness still lasts.

use crate::base::NONE;
use crate::mesh::Mesh;
use crate::refine::{Around, Creasing, decrement};

/// The rule at a vertex.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Rule {
    Smooth,
    Dart,
    Crease,
    Corner,
}

impl Rule {
    fn of(vertex: f32, sharp_edges: usize) -> Self {
        match sharp_edges {
            _ if vertex > 0.0 => Self::Corner,
            0 => Self::Smooth,
            1 => Self::Dart,
            2 => Self::Crease,
            _ => Self::Corner,
        }
    }

    /// True if the rule does not know the sharp edges.
    pub(super) fn is_smooth(self) -> bool {
        matches!(self, Self::Smooth | Self::Dart)
    }
}

/// An edge at a vertex.
#[derive(Debug, Clone, Copy)]
pub(super) struct Spoke {
    /// A corner at its far end.
    pub(super) far: u32,
    /// Its sharpness.
    pub(super) sharpness: f32,
    /// What the step leaves of it at this vertex.
    pub(super) left: f32,
}

/// The edges around a vertex, its own sharpness, and the rules that follow.
#[derive(Debug, Default)]
pub(super) struct Surroundings {
    pub(super) spokes: Vec<Spoke>,
    sharpness: f32,
    creasing: Creasing,
}

impl Surroundings {
    /// Looks at a vertex of its own sharpness.
    pub(super) fn look(&mut self, mesh: &Mesh, vertex: u32, sharpness: f32, creasing: Creasing) {
        self.spokes.clear();
        self.sharpness = sharpness;
        self.creasing = creasing;
        let mut around = Around::default();
        mesh.each_edge_at(vertex, |far, sharpness| {
            around.add(sharpness);
            self.spokes.push(Spoke { far, sharpness, left: 0.0 });
        });
        for spoke in &mut self.spokes {
            spoke.left = creasing.edge(spoke.sharpness, around);
        }
    }

    /// Some edges only, by their sharpness before and after the step.
    pub(super) fn inside(edges: Vec<(f32, f32)>, sharpness: f32, creasing: Creasing) -> Self {
        let spoke = |(sharpness, left)| Spoke { far: NONE, sharpness, left };
        Self { spokes: edges.into_iter().map(spoke).collect(), sharpness, creasing }
    }

    /// The rule before the step.
    pub(super) fn rule(&self) -> Rule {
        let sharp = self.spokes.iter().filter(|spoke| spoke.sharpness > 0.0);
        Rule::of(self.sharpness, sharp.count())
    }

    /// The rule for what the step leaves.
    pub(super) fn rule_left(&self) -> Rule {
        let sharp = self.spokes.iter().filter(|spoke| spoke.left > 0.0);
        Rule::of(decrement(self.sharpness), sharp.count())
    }

    /// The weight of the rule before the step where it is another one afterwards: the mean
    /// sharpness of what becomes smooth, at most 1.
    pub(super) fn weight(&self) -> f32 {
        let (mut sum, mut count) = (0.0_f32, 0_u32);
        let mut add = |sharpness| {
            sum += sharpness;
            count += 1;
        };
        if self.sharpness > 0.0 && decrement(self.sharpness) <= 0.0 {
            add(self.sharpness);
        }
        for spoke in self.spokes.iter().filter(|spoke| spoke.sharpness > 0.0) {
            let ends = match self.creasing {
                Creasing::Uniform => spoke.sharpness <= 1.0,
                Creasing::Chaikin => spoke.left <= 0.0,
            };
            if ends {
                add(spoke.sharpness);
            }
        }
        if count == 0 { 0.0 } else { (sum / count as f32).min(1.0) }
    }
}
