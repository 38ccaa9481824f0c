//! The rows of one step as stencil tables want them: on old vertices and on new vertices
//! of faces, or, in a pass, on the vertices of the stage before.

use super::step::Interpolation;
use crate::base::{NONE, Result, memory};
use crate::mesh::Mesh;
use crate::refine::{PrimalChild, Split};
use crate::scheme::{DualRows, PointSink, PrimalRows, RowSink, Scheme, SmoothMasks};

/// The rows of one step. Scratch memory is inside: one per thread.
pub(super) enum StepRows<'a> {
    Dual(DualRows<'a, f64>),
    Primal(PrimalRows<'a, f64>),
}

impl<'a> StepRows<'a> {
    pub(super) fn new(
        scheme: &'a Scheme,
        split: &'a Split<'a>,
        interpolation: Interpolation,
    ) -> Self {
        match split {
            Split::Corner(split) => Self::Dual(DualRows::new(scheme, split)),
            Split::Primal(split) if interpolation == Interpolation::Varying => {
                Self::Primal(PrimalRows::with_masks(scheme, split, SmoothMasks::linear()))
            }
            Split::Primal(split) => Self::Primal(PrimalRows::new(scheme, split)),
        }
    }

    /// The row of a child vertex after the split.
    pub(super) fn split_row(&mut self, split: &Split, vertex: u32, sink: &mut impl PointSink<f64>) {
        match (self, split) {
            (Self::Primal(rows), Split::Primal(split)) => match split.child(vertex) {
                PrimalChild::Vertex(v) => rows.vertex_row(v, sink),
                PrimalChild::Edge(edge) => rows.edge_row(split.edges.first[edge as usize], sink),
                PrimalChild::Face(face) => sink.face(face, 1.0),
            },
            (Self::Primal(rows), _) => {
                rows.split_row(vertex, &mut |v, weight| sink.vertex(v, weight));
            }
            (Self::Dual(rows), _) => {
                rows.split_row(vertex, &mut |v, weight| sink.vertex(v, weight));
            }
        }
    }

    /// The row of a child vertex that has one of its own instead of split and passes, on the
    /// parent's vertices. False, and nothing sent, for all others.
    pub(super) fn tuned_row(&mut self, vertex: u32, sink: &mut impl RowSink<f64>) -> bool {
        match self {
            Self::Dual(rows) => rows.tuned_row(vertex, sink),
            Self::Primal(_) => false,
        }
    }

    /// The row of a child vertex in a pass, on the child vertices.
    pub(super) fn pass_row(&mut self, pass: usize, vertex: u32, sink: &mut impl RowSink<f64>) {
        match self {
            Self::Dual(rows) => rows.pass_row(pass, vertex, sink),
            Self::Primal(rows) => rows.pass_row(pass, vertex, sink),
        }
    }
}

/// True if the rows of a split speak of new vertices of faces.
pub(super) fn has_faces(split: &Split) -> bool {
    split.primal().next().is_some_and(|split| split.pieces() == crate::refine::Pieces::Quads)
}

/// The row of the new vertex of a face.
pub(super) fn face_row(mesh: &Mesh, face: usize, mut add: impl FnMut(u32, f64)) {
    let corners = mesh.face_corners(face);
    let share = 1.0 / corners.len() as f64;
    for v in &mesh.corner_vertices()[corners] {
        add(*v, share);
    }
}

/// Some of the elements of a kind, and where each stands among them.
pub(super) enum Wanted {
    All(usize),
    Some { list: Vec<u32>, places: Vec<u32> },
}

impl Wanted {
    /// The elements of a list, which may repeat them; of `n` that exist.
    pub(super) fn new(n: usize, marked: &[u32]) -> Result<Self> {
        let mut places = memory::filled(NONE, n)?;
        for &element in marked {
            places[element as usize] = 0;
        }
        Self::marked(places)
    }

    /// The elements whose place is anything but `NONE`.
    pub(super) fn marked(mut places: Vec<u32>) -> Result<Self> {
        let there = (0..places.len() as u32).filter(|&i| places[i as usize] != NONE);
        let list = memory::collect(there)?;
        for (&element, place) in list.iter().zip(0..) {
            places[element as usize] = place;
        }
        Ok(Self::Some { list, places })
    }

    pub(super) fn len(&self) -> usize {
        match self {
            Self::All(n) => *n,
            Self::Some { list, .. } => list.len(),
        }
    }

    /// The element at a place.
    #[inline]
    pub(super) fn at(&self, place: usize) -> u32 {
        match self {
            Self::All(_) => place as u32,
            Self::Some { list, .. } => list[place],
        }
    }

    /// The place of an element that is among them.
    #[inline]
    pub(super) fn place(&self, element: u32) -> usize {
        match self {
            Self::All(_) => element as usize,
            Self::Some { places, .. } => places[element as usize] as usize,
        }
    }
}

/// What one step must make: the vertices of every stage, and new vertices of faces.
pub(super) struct Needs {
    pub(super) faces: Wanted,
    /// After the split, and after each pass.
    stages: Vec<Wanted>,
}

impl Needs {
    /// Everything.
    pub(super) fn all(split: &Split, passes: usize) -> Self {
        let faces = if has_faces(split) { split.parent().faces() } else { 0 };
        let children = split.counts().vertices as usize;
        let stages = (0..=passes).map(|_| Wanted::All(children)).collect();
        Self { faces: Wanted::All(faces), stages }
    }

    /// What the vertices wanted after the last stage ask for, and the vertices of the
    /// parent: those whose mark is not `NONE`.
    pub(super) fn of(
        rows: &mut StepRows,
        split: &Split,
        passes: usize,
        last: Wanted,
    ) -> Result<(Self, Vec<u32>)> {
        let mesh = split.parent();
        let mut marks = Marks {
            vertices: memory::filled(NONE, mesh.vertices())?,
            faces: memory::filled(NONE, if has_faces(split) { mesh.faces() } else { 0 })?,
        };
        let mut stages = vec![last];
        for pass in (0..passes).rev() {
            let mut before = memory::filled(NONE, split.counts().vertices as usize)?;
            let after = &stages[stages.len() - 1];
            for at in 0..after.len() {
                let parents = &mut |v: u32, _: f64| marks.vertices[v as usize] = 0;
                if pass + 1 < passes || !rows.tuned_row(after.at(at), parents) {
                    rows.pass_row(pass, after.at(at), &mut |v: u32, _: f64| before[v as usize] = 0);
                }
            }
            stages.push(Wanted::marked(before)?);
        }
        stages.reverse();
        for at in 0..stages[0].len() {
            rows.split_row(split, stages[0].at(at), &mut marks);
        }
        let faces = Wanted::marked(marks.faces)?;
        for at in 0..faces.len() {
            face_row(mesh, faces.at(at) as usize, |v, _| marks.vertices[v as usize] = 0);
        }
        Ok((Self { faces, stages }, marks.vertices))
    }

    /// The vertices after the split, or after a number of passes.
    pub(super) fn stage(&self, passes: usize) -> &Wanted {
        &self.stages[passes]
    }

    /// The vertices after the step.
    pub(super) fn last(&self) -> &Wanted {
        &self.stages[self.stages.len() - 1]
    }
}

/// What rows speak of.
struct Marks {
    vertices: Vec<u32>,
    faces: Vec<u32>,
}

impl PointSink<f64> for Marks {
    fn vertex(&mut self, vertex: u32, _: f64) {
        self.vertices[vertex as usize] = 0;
    }

    fn face(&mut self, face: u32, _: f64) {
        self.faces[face as usize] = 0;
    }
}
