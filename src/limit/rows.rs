//! The limits of all vertices of a mesh, on the vertices of that mesh.

use super::centres::{Centres, Found};
use super::part::Part;
use super::weights::Weighted;
use crate::base::{Context, Element, Error, ErrorKind, NONE, Result, memory};
use crate::hierarchy::{Hierarchy, StencilTask};
use crate::mesh::Mesh;
use crate::refine::{FaceOrigin, VertexOrigin};
use crate::scheme::{Boundary, Scheme, SplitKind};
use crate::sparse::StencilTable;
use std::ops::Range;
use std::sync::Arc;

/// Levels after which the neighbourhood of a vertex must be that of one feature: sharpness
/// lasts for ten, and two more separate what is not sharp.
const DEEPEST: u32 = 12;
/// Vertices between two looks at whether to go on.
const CANCEL_EVERY: usize = 1 << 12;

/// Rows of three weights each: of the position and of two tangents.
#[derive(Debug, Default)]
pub(super) struct Rows {
    /// Where the entries of each row begin, and the last one's end.
    pub(super) offsets: Vec<u32>,
    pub(super) entries: Vec<Weighted>,
}

/// Rows of some vertices, in any order.
#[derive(Default)]
struct Loose {
    rows: Vec<(u32, Range<usize>)>,
    entries: Vec<Weighted>,
}

impl Loose {
    fn push(&mut self, vertex: u32, row: &[Weighted]) -> Result<()> {
        let start = self.entries.len();
        memory::extend(&mut self.entries, row.iter().copied())?;
        memory::extend(&mut self.rows, [(vertex, start..self.entries.len())])
    }

    /// The rows in the order of the vertices, each vertex once in a row.
    fn in_order(mut self) -> Result<Rows> {
        self.rows.sort_unstable_by_key(|row| row.0);
        let mut rows = Rows::default();
        let mut row = Vec::new();
        memory::extend(&mut rows.offsets, [0])?;
        for (_, range) in self.rows {
            row.clear();
            memory::extend(&mut row, self.entries[range].iter().copied())?;
            merge(&mut row);
            memory::extend(&mut rows.entries, row.iter().copied())?;
            let end = u32::try_from(rows.entries.len()).map_err(|_| {
                Error::new(ErrorKind::TooLarge, "limits of more weights than can be counted")
            })?;
            memory::extend(&mut rows.offsets, [end])?;
        }
        Ok(rows)
    }
}

/// Adds up entries of the same vertex and leaves out what is zero.
fn merge(row: &mut Vec<Weighted>) {
    // Stable, so that sums are always taken in one order.
    row.sort_by_key(|entry| entry.0);
    row.dedup_by(|next, kept| {
        let same = next.0 == kept.0;
        if same {
            kept.1.iter_mut().zip(next.1).for_each(|(sum, w)| *sum += w);
        }
        same
    });
    row.retain(|(_, weights)| weights.iter().any(|&w| w != 0.0));
}

/// The limits of the vertices of a mesh.
///
/// # Errors
/// As [`super::Limits::new`].
pub(super) fn rows(context: &Context, mesh: &Arc<Mesh>, scheme: &Scheme) -> Result<Rows> {
    scheme.check(mesh)?;
    if !mesh.is_manifold() {
        let message = "a mesh that is not manifold has no limit positions yet";
        return Err(Error::new(ErrorKind::Unsupported, message));
    }
    context.report(0.0)?;
    let mut made = Loose::default();
    let mut centres = Centres::new(context, scheme);
    let rest = match scheme.split() {
        SplitKind::Corner => dual(context, mesh, scheme, &mut centres, &mut made)?,
        _ => primal(context, mesh, scheme, &mut centres, &mut made)?,
    };
    if let Some(&v) = rest.first() {
        return Err(later(mesh, v, scheme));
    }
    let rows = made.in_order()?;
    context.report(1.0)?;
    Ok(rows)
}

fn later(mesh: &Mesh, v: u32, scheme: &Scheme) -> Error {
    let dual = scheme.split() == SplitKind::Corner;
    let ends = dual && mesh.on_rim(v) && scheme.boundary() == Boundary::None;
    let message = if ends {
        "the surface ends inside the mesh and has no point there (boundary none)"
    } else {
        "its neighbourhood is not regular after some levels, or stays sharp too long"
    };
    refused(v, message)
}

fn refused(v: u32, message: &str) -> Error {
    Error::new(ErrorKind::Unsupported, format!("vertex {v} has no limit: {message}"))
        .with_elements([Element::Vertex(v.into())])
}

/// Names the vertex whose feature has no rule.
fn at(v: u32) -> impl Fn(Error) -> Error {
    move |error| match error.kind() {
        ErrorKind::ParameterOutOfRange | ErrorKind::Unsupported => refused(v, &error.to_string()),
        _ => error,
    }
}

/// Vertices on the mesh itself, then those that are left on submeshes around them.
fn primal(
    context: &Context,
    mesh: &Arc<Mesh>,
    scheme: &Scheme,
    centres: &mut Centres<'_>,
    made: &mut Loose,
) -> Result<Vec<u32>> {
    let (mut row, mut rest) = (Vec::new(), Vec::new());
    for v in 0..mesh.vertices() as u32 {
        if (v as usize).is_multiple_of(CANCEL_EVERY) {
            context.report(0.5 * f64::from(v) / mesh.vertices() as f64)?;
        }
        match centres.vertex(mesh, v, &mut row).map_err(at(v))? {
            Found::Limit => made.push(v, &row)?,
            Found::Later => memory::extend(&mut rest, [v])?,
        }
    }
    // The mesh of the level before, on it the vertices that are left, and its vertices' rows on
    // the control vertices. Only what is near the former is ever refined.
    let (mut coarse, mut inner) = (Arc::clone(mesh), memory::copied(&rest)?);
    let mut rows: Option<StencilTable<f64>> = None;
    for _ in 1..=DEEPEST {
        if rest.is_empty() {
            break;
        }
        let part = Part::new(&coarse, &inner, scheme.passes().len() as u32)?;
        let hierarchy = Hierarchy::new(context, part.mesh, scheme.clone(), 1)?;
        let before = match rows {
            Some(rows) => rows.select(context, &part.vertices)?,
            None => selection(mesh.vertices(), &part.vertices)?,
        };
        let step = hierarchy.stencils(context, &StencilTask::level(1))?;
        let table = before.compose(context, &step)?;
        coarse = hierarchy.shared_mesh(1)?;
        let (mut still, mut lowered) = (Vec::new(), Vec::new());
        inner.clear();
        for (&v, &i) in rest.iter().zip(&part.wanted) {
            match centres.vertex(&coarse, i, &mut row).map_err(at(v))? {
                Found::Limit => {
                    lower(&row, |u| table.row(u as usize), &mut lowered)?;
                    made.push(v, &lowered)?;
                }
                Found::Later => {
                    memory::extend(&mut still, [v])?;
                    memory::extend(&mut inner, [i])?;
                }
            }
        }
        (rows, rest) = (Some(table), still);
    }
    Ok(rest)
}

/// The table of some of so many vertices.
fn selection(of: usize, vertices: &[u32]) -> Result<StencilTable<f64>> {
    let offsets = memory::collect(0..=vertices.len() as u64)?;
    let weights = memory::filled(1.0, vertices.len())?;
    StencilTable::new(of, &offsets, memory::copied(vertices)?, weights)
}

/// Faces that a dual step puts in the places of vertices, level after level.
fn dual(
    context: &Context,
    mesh: &Arc<Mesh>,
    scheme: &Scheme,
    centres: &mut Centres<'_>,
    made: &mut Loose,
) -> Result<Vec<u32>> {
    let mut row = Vec::new();
    let isolated = |&v: &u32| mesh.start[v as usize] == NONE;
    for v in (0..mesh.vertices() as u32).filter(isolated) {
        made.push(v, &[(v, [1.0, 0.0, 0.0])])?;
    }
    let there = (0..mesh.vertices() as u32).filter(|v| !isolated(v));
    let mut rest = memory::collect(there)?;
    let mut levels = 1;
    let mut hierarchy = Hierarchy::new(context, Arc::clone(mesh), scheme.clone(), levels)?;
    // The face at the level where a vertex's limit lies in the middle, or `NONE`.
    let mut faces = memory::filled(NONE, mesh.vertices())?;
    // Features that are neighbours are 2ⁿ edges apart after n steps, and rules look twice as far
    // as there are passes; beside vertices of two faces it takes two steps more.
    let passes = scheme.passes().len() as u32;
    for level in 1..=4 + (2 * passes).checked_ilog2().unwrap_or(0) {
        if rest.is_empty() {
            break;
        }
        if level > levels {
            levels = level;
            hierarchy = Hierarchy::new(context, Arc::clone(mesh), scheme.clone(), levels)?;
        }
        follow(&hierarchy, level, &mut faces)?;
        let mut found = Loose::default();
        let mut still = Vec::new();
        for (done, &v) in rest.iter().enumerate() {
            if done.is_multiple_of(CANCEL_EVERY) {
                context.check_cancelled()?;
            }
            let face = faces[v as usize];
            let fine = hierarchy.mesh(level);
            match face {
                NONE => memory::extend(&mut still, [v])?,
                _ => match centres.face(fine, face, &mut row).map_err(at(v))? {
                    Found::Limit => found.push(v, &row)?,
                    Found::Later => memory::extend(&mut still, [v])?,
                },
            }
        }
        lower_all(context, &hierarchy, level, &found, made)?;
        rest = still;
    }
    Ok(rest)
}

/// From the faces of the level before to those of a level. A vertex between two faces has no
/// face of its own after one step, but an edge, and that has one after two.
fn follow(hierarchy: &Hierarchy, level: u32, faces: &mut [u32]) -> Result<()> {
    let origins = hierarchy.face_origins(level)?;
    let parent = hierarchy.mesh(level - 1);
    let mut children = memory::filled(NONE, parent.faces())?;
    for (face, origin) in (0..).zip(&origins) {
        match *origin {
            FaceOrigin::Vertex(v) if level == 1 => faces[v as usize] = face,
            FaceOrigin::Edge(corner) if level == 1 => {
                anchored_ends(parent, corner).for_each(|v| faces[v as usize] = face);
            }
            FaceOrigin::Face(of) => {
                children[of as usize] = face;
                if level == 1 {
                    anchored_corners(parent, of).for_each(|v| faces[v as usize] = face);
                }
            }
            _ => {}
        }
    }
    if level == 1 {
        return Ok(());
    }
    for face in faces.iter_mut().filter(|face| **face != NONE) {
        *face = children[*face as usize];
    }
    if level == 2 {
        between_two(hierarchy, &origins, faces)?;
    }
    Ok(())
}

/// The ends of an edge on the boundary of an anchored mesh. A step lays no face in their place,
/// but one on the edge, with the vertex's place in the middle of its boundary edge.
fn anchored_ends(mesh: &Mesh, corner: u32) -> impl Iterator<Item = u32> {
    let ends = [corner, mesh.next(corner)].map(|c| mesh.vert[c as usize]);
    ends.into_iter().filter(|&v| mesh.is_anchored() && mesh.on_rim(v))
}

/// The vertices of a face of an anchored mesh that have no other: they stay where they are, and
/// the face's children shrink towards them.
fn anchored_corners(mesh: &Mesh, face: u32) -> impl Iterator<Item = u32> {
    let corners = mesh.layout.face(face).filter(|_| mesh.is_anchored());
    let open = |corner: u32| mesh.twin[corner as usize] == NONE;
    corners.filter(move |&c| open(c) && open(mesh.prev(c))).map(|c| mesh.vert[c as usize])
}

/// The faces of the second level on the edges of the first that vertices of two faces become.
fn between_two(hierarchy: &Hierarchy, origins: &[FaceOrigin], faces: &mut [u32]) -> Result<()> {
    let [control, first] = [hierarchy.mesh(0), hierarchy.mesh(1)];
    let lone = |v: u32| {
        let v = v as usize;
        control.start[v] != NONE && control.valence(v) == 2 && !control.is_boundary_vertex(v)
    };
    if !(0..control.vertices() as u32).any(lone) {
        return Ok(());
    }
    let parents = hierarchy.vertex_origins(1)?;
    let vertex = |child: u32| match parents[child as usize] {
        VertexOrigin::Corner(c) => control.vert[c as usize],
        _ => NONE,
    };
    for (face, origin) in (0..).zip(origins) {
        let FaceOrigin::Edge(corner) = *origin else { continue };
        let ends = [corner, first.next(corner)].map(|c| vertex(first.vert[c as usize]));
        if ends[0] == ends[1] && ends[0] != NONE && lone(ends[0]) {
            faces[ends[0] as usize] = face;
        }
    }
    Ok(())
}

/// Rows on the vertices of a level become rows on the control vertices.
fn lower_all(
    context: &Context,
    hierarchy: &Hierarchy,
    level: u32,
    found: &Loose,
    made: &mut Loose,
) -> Result<()> {
    if found.rows.is_empty() {
        return Ok(());
    }
    let mut needed = memory::collect(found.entries.iter().map(|entry| entry.0))?;
    needed.sort_unstable();
    needed.dedup();
    let task = StencilTask { vertices: Some(&needed), ..StencilTask::level(level) };
    let table: StencilTable<f64> = hierarchy.stencils(context, &task)?;
    let mut row: Vec<Weighted> = Vec::new();
    for (vertex, range) in &found.rows {
        let of = |v: u32| table.row(needed.binary_search(&v).unwrap_or_default());
        lower(&found.entries[range.clone()], of, &mut row)?;
        made.push(*vertex, &row)?;
    }
    Ok(())
}

/// A row on vertices that have rows themselves.
fn lower<'t>(
    row: &[Weighted],
    of: impl Fn(u32) -> (&'t [u32], &'t [f64]),
    lowered: &mut Vec<Weighted>,
) -> Result<()> {
    lowered.clear();
    for &(v, weights) in row {
        let (indices, factors) = of(v);
        let scaled = indices.iter().zip(factors);
        memory::extend(lowered, scaled.map(|(&i, factor)| (i, weights.map(|w| w * factor))))?;
    }
    merge(lowered);
    Ok(())
}
