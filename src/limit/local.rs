//! The local subdivision matrix: how a step maps the vertices around a feature to those around
//! its image.

use super::Feature;
use super::neighbourhood::{Name, Neighbourhood};
use crate::base::{Context, Error, ErrorKind, NONE, Result, Weight, memory};
use crate::hierarchy::Hierarchy;
use crate::mesh::Mesh;
use crate::refine::{EdgeNumbers, FaceOrigin, Pieces, VertexOrigin};
use crate::scheme::{ComposedRow, ComposedRows, Scheme, SplitKind};
use std::collections::HashMap;

/// The level from which on a step does the same around a feature as the one before.
const STATIONARY: u32 = 1;

/// Edges to cross from the middle so that no eigenvalue is missing but those of farther rings,
/// which are no new ones.
const RING: u32 = 2;

/// Edges to cross to all vertices that decide the surface of two rings of faces around a feature.
#[cfg(feature = "spectra")]
pub(crate) fn control_reach(scheme: &Scheme) -> u32 {
    6 + 2 * scheme.passes().len() as u32
}

/// The mesh around a feature after the first step, with the one after that, and the corners
/// in the middle that correspond.
#[derive(Debug)]
pub(crate) struct Model {
    pub(crate) hierarchy: Hierarchy,
    /// Rings of faces around the feature in the control mesh.
    pub(super) rings: u32,
    pub(super) middle: Vec<[u32; 2]>,
    symmetric: bool,
    passes: u32,
}

impl Model {
    /// Regular so far that `reach` faces around the feature follow its rules alone.
    pub(crate) fn new(scheme: &Scheme, feature: Feature, reach: u32) -> Result<Self> {
        let passes = scheme.passes().len() as u32;
        // A step looks two faces far, and each pass one more; the first step doubles the rings.
        let rings = (reach + passes).div_ceil(2) + 2;
        let mesh = feature.model(scheme, rings)?;
        let hierarchy = Hierarchy::new(&Context::serial(), mesh, scheme.clone(), STATIONARY + 1)?;
        let mut corners = match scheme.split() {
            SplitKind::Corner => vec![face_corners(&hierarchy, feature)?],
            _ => vec![hierarchy.mesh(STATIONARY).fan(0).collect::<Vec<_>>()],
        };
        corners.push(children(&hierarchy, &corners[0])?);
        let middle =
            corners[0].iter().zip(&corners[1]).map(|(&parent, &child)| [parent, child]).collect();
        Ok(Self { hierarchy, rings, middle, symmetric: feature.is_symmetric(), passes })
    }

    /// The mesh that the local matrix takes vertices from.
    pub(crate) fn mesh(&self) -> &Mesh {
        self.hierarchy.mesh(STATIONARY)
    }

    /// The faces in the middle, in [`Model::mesh`]: one, or those around a vertex.
    #[cfg(feature = "spectra")]
    pub(crate) fn innermost(&self) -> Vec<u32> {
        let mesh = self.mesh();
        let first = self.middle[0][0];
        match self.hierarchy.scheme().split() {
            SplitKind::Corner => vec![mesh.layout.face_of(first)],
            _ => mesh.fan(mesh.vert[first as usize]).map(|c| mesh.layout.face_of(c)).collect(),
        }
    }

    pub(super) fn neighbourhood(&self, reach: u32) -> Neighbourhood {
        let meshes = [self.mesh(), self.hierarchy.mesh(STATIONARY + 1)];
        // Rows of those farthest out are made of others that lie hardly farther; those of many
        // passes of as many rings, whose diagonals are two edges away each.
        let edges = (reach + 4 + self.passes).max(reach + 2 * self.passes);
        Neighbourhood::new(meshes, &self.middle, self.symmetric, edges)
    }

    /// Calls `row` with the composed row of each of some vertices of the child mesh.
    fn each_row<W: Weight>(
        &self,
        vertices: &[u32],
        mut row: impl FnMut(usize, ComposedRow<W>) -> Result<()>,
    ) -> Result<()> {
        let scheme = self.hierarchy.scheme();
        let mut memory = EdgeNumbers::default();
        let split = scheme.plan(&Context::serial(), self.mesh(), &mut memory)?;
        let mut rows = ComposedRows::new(scheme, &split);
        vertices.iter().enumerate().try_for_each(|(i, &v)| row(i, rows.row(v)))
    }
}

/// The corners of the face that a dual scheme puts in the place of vertex 0.
fn face_corners(hierarchy: &Hierarchy, feature: Feature) -> Result<Vec<u32>> {
    let origins = hierarchy.face_origins(STATIONARY)?;
    let face = origins.iter().position(|&origin| origin == FaceOrigin::Vertex(0));
    let face = face.ok_or_else(|| {
        let message = format!("{feature}: the scheme puts no face there");
        Error::new(ErrorKind::Unsupported, message)
    })?;
    let mesh = hierarchy.mesh(STATIONARY);
    corners_in_order(mesh, face as u32)
}

/// The corners of a face; of one at the boundary from the first boundary edge on.
pub(super) fn corners_in_order(mesh: &Mesh, face: u32) -> Result<Vec<u32>> {
    let mut corners = memory::collect(mesh.layout.face(face))?;
    let open = |corner: u32| mesh.twin[corner as usize] == NONE;
    let first = corners.iter().position(|&c| open(c) && !open(mesh.prev(c)));
    corners.rotate_left(first.unwrap_or(0));
    Ok(corners)
}

/// The child corners that correspond to the corners in the middle.
fn children(hierarchy: &Hierarchy, corners: &[u32]) -> Result<Vec<u32>> {
    let scheme = hierarchy.scheme();
    if scheme.split() != SplitKind::Corner {
        let pieces: Pieces = scheme.pieces();
        return Ok(corners.iter().map(|&corner| pieces.start_half(corner)).collect());
    }
    let child = hierarchy.mesh(STATIONARY + 1);
    let face = hierarchy.mesh(STATIONARY).layout.face_of(corners[0]);
    let faces = hierarchy.face_origins(STATIONARY + 1)?;
    let vertices = hierarchy.vertex_origins(STATIONARY + 1)?;
    let image = faces.iter().position(|&origin| origin == FaceOrigin::Face(face));
    let image = image.ok_or_else(|| broken("a face without an image"))?;
    let at = |corner: &u32| {
        let mut around = child.layout.face(image as u32);
        let origin = |c: u32| vertices[child.vert[c as usize] as usize];
        around
            .find(|&c| origin(c) == VertexOrigin::Corner(*corner))
            .ok_or_else(|| broken("a corner without an image"))
    };
    corners.iter().map(at).collect()
}

fn broken(message: &str) -> Error {
    Error::new(ErrorKind::BrokenInvariant, message)
}

/// The step of a scheme around a feature, once it repeats itself.
///
/// Its rows are the scheme's own. Around an interior feature vertices come in orbits of the
/// turns by one face, and a row is stored for one vertex of each orbit.
#[derive(Debug, Clone)]
pub struct LocalMatrix<W> {
    feature: Feature,
    sectors: usize,
    /// How many vertices each orbit has: as many as sectors, or one.
    sizes: Vec<usize>,
    /// In the mesh of the model, by orbit and sector.
    vertices: Vec<Vec<u32>>,
    rows: Vec<Vec<(Name, W)>>,
}

impl<W: Weight> LocalMatrix<W> {
    /// The matrix of the vertices of the faces around a feature and of all that they depend on.
    ///
    /// # Errors
    /// [`ErrorKind::ParameterOutOfRange`] for a feature with too many or too few faces,
    /// [`ErrorKind::Unsupported`] if the scheme has no such feature.
    pub fn new(scheme: &Scheme, feature: Feature) -> Result<Self> {
        Self::of_model(&Model::new(scheme, feature, RING)?, feature, Some(RING))
    }

    /// The matrix of all vertices up to `reach` edges away, at least.
    pub(crate) fn of_model(model: &Model, feature: Feature, reach: Option<u32>) -> Result<Self> {
        let reach = reach.unwrap_or(RING);
        let around = model.neighbourhood(reach);
        let mut chosen: Vec<usize> =
            (0..around.orbits.len()).filter(|&i| around.orbits[i].distance <= reach).collect();
        let mut known: HashMap<usize, Vec<(Name, W)>> = HashMap::new();
        let mut done = 0;
        // What a row asks for needs a row, too.
        while done < chosen.len() {
            let children: Vec<u32> =
                chosen[done..].iter().map(|&orbit| around.orbits[orbit].child).collect();
            let mut rows = Vec::new();
            model.each_row(&children, |_, row: ComposedRow<W>| {
                let named = |(v, weight)| around.name(v).map(|name| (name, weight));
                let row: Option<Vec<(Name, W)>> = row.into_iter().map(named).collect();
                rows.push(row.ok_or_else(|| broken("a row reaches out of the neighbourhood"))?);
                Ok(())
            })?;
            let new: Vec<usize> = chosen[done..].to_vec();
            done = chosen.len();
            for (orbit, row) in new.into_iter().zip(rows) {
                for (name, _) in &row {
                    if !chosen.contains(&name.orbit) {
                        chosen.push(name.orbit);
                    }
                }
                known.insert(orbit, row);
            }
        }
        chosen.sort_unstable();
        let place: HashMap<usize, usize> =
            chosen.iter().enumerate().map(|(i, &orbit)| (orbit, i)).collect();
        let renamed =
            |(name, weight): (Name, W)| (Name { orbit: place[&name.orbit], ..name }, weight);
        let rows = chosen
            .iter()
            .map(|orbit| known.remove(orbit).unwrap_or_default().into_iter().map(renamed).collect())
            .collect();
        let vertices: Vec<Vec<u32>> =
            chosen.iter().map(|&orbit| around.orbits[orbit].parents.clone()).collect();
        let sizes = vertices.iter().map(Vec::len).collect();
        let sectors = if feature.is_symmetric() { feature.faces() } else { 1 };
        Ok(Self { feature, sectors, sizes, vertices, rows })
    }

    /// The feature.
    pub fn feature(&self) -> Feature {
        self.feature
    }

    /// Turns that lead back to the start: the valence of an interior feature, or 1.
    pub fn sectors(&self) -> usize {
        self.sectors
    }

    /// The number of orbits: rows of a Fourier block.
    pub fn orbits(&self) -> usize {
        self.sizes.len()
    }

    /// The vertices of an orbit: one in the middle, or one for each sector.
    ///
    /// # Panics
    /// If `orbit` is not below [`LocalMatrix::orbits`].
    pub fn orbit_size(&self, orbit: usize) -> usize {
        self.sizes[orbit]
    }

    /// The row of an orbit's first vertex: orbit, sector and weight of what it is made of.
    ///
    /// # Panics
    /// If `orbit` is not below [`LocalMatrix::orbits`].
    pub fn row(&self, orbit: usize) -> impl Iterator<Item = (usize, usize, &W)> {
        self.rows[orbit].iter().map(|(name, weight)| (name.orbit, name.sector, weight))
    }

    /// The vertices of an orbit in the mesh of the model.
    #[cfg(feature = "spectra")]
    pub(crate) fn orbit_vertices(&self, orbit: usize) -> &[u32] {
        &self.vertices[orbit]
    }

    /// Calls `row` with every vertex of the model that has a row, and what it is made of.
    pub(crate) fn each_vertex(
        &self,
        mut row: impl FnMut(u32, &mut dyn Iterator<Item = (u32, &W)>),
    ) {
        for (vertices, entries) in self.vertices.iter().zip(&self.rows) {
            for (turn, &vertex) in vertices.iter().enumerate() {
                let mut turned = entries.iter().map(|(name, weight)| {
                    let orbit = &self.vertices[name.orbit];
                    (orbit[(name.sector + turn) % orbit.len()], weight)
                });
                row(vertex, &mut turned);
            }
        }
    }

    /// All rows, of the vertices in the order of orbits and sectors.
    pub fn dense(&self) -> Vec<Vec<W>> {
        let first: Vec<usize> = self
            .sizes
            .iter()
            .scan(0, |sum, size| {
                *sum += size;
                Some(*sum - size)
            })
            .collect();
        let count: usize = self.sizes.iter().sum();
        let mut rows = Vec::with_capacity(count);
        for (orbit, &size) in self.sizes.iter().enumerate() {
            for turn in 0..size {
                let mut row = vec![W::ratio(0, 1); count];
                for (name, weight) in &self.rows[orbit] {
                    let sector = (name.sector + turn) % self.sizes[name.orbit];
                    row[first[name.orbit] + sector] = weight.clone();
                }
                rows.push(row);
            }
        }
        rows
    }
}
