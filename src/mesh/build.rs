//! From a polygon soup to a [`Mesh`]: checks, order, twins, fans.

use super::pairing::{BadEdge, Pairing, pair};
use super::{Defect, Defects, Joints, Layout, Mesh, Near, Sharpness, VertexSet};
use super::{anchor, cut, joints, order, sharpness};
use crate::base::{Context, Crease, Element, Error, ErrorKind, NONE, Result, SharpVertex, memory};

/// What to do with edges and vertices that are not manifold.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[non_exhaustive]
pub enum NonManifold {
    /// Refuse the mesh.
    #[default]
    Error,
    /// Make every face side at such an edge a boundary edge, and give every
    /// extra fan of a vertex its own copy of it.
    Cut,
    /// Keep them as they are, infinitely sharp, as OpenSubdiv does; only primal
    /// schemes refine such a mesh.
    Sharpen,
}

/// How a mesh is built.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct BuildOptions<'a> {
    /// What to do with edges and vertices that are not manifold.
    pub non_manifold: NonManifold,
    /// The mesh is the result of an earlier dual step, with the anchor row laid
    /// along its boundary (`docs/schemes.md`, "Boundaries").
    pub anchored: bool,
    /// Boundary vertices to interpolate although they have several faces.
    pub corner_tags: &'a [u32],
    /// Sharp edges; those on the boundary are infinitely sharp in any case.
    pub creases: &'a [Crease],
    /// Sharp vertices.
    pub sharp_vertices: &'a [SharpVertex],
    /// Faces, in the caller's order, that are refined but left out of what is drawn.
    pub holes: &'a [u32],
}

/// A mesh and where its vertices came from.
#[derive(Debug, Clone)]
pub struct Built {
    /// The mesh.
    pub mesh: Mesh,
    /// For each vertex the caller's vertex, if policy `cut` copied any:
    /// the first entries are the vertices themselves, the copies follow.
    pub vertex_source: Option<Vec<u32>>,
}

/// Builds a mesh from faces given as sizes and concatenated vertex indices.
///
/// Costs O(H) for H corners, plus a sort of the edges of each vertex.
///
/// # Errors
/// [`Defects::Soup`] with every defect found; [`Defects::Call`] for sizes that
/// do not match or do not fit 32 bits, too little memory, unusable tags, or a cancel.
pub fn build(
    context: &Context,
    vertices: usize,
    sizes: &[u32],
    indices: &[u32],
    options: &BuildOptions,
) -> Result<Built, Defects> {
    context.check_cancelled()?;
    let offsets = check_sizes(context, vertices, sizes, indices)?;
    let mut defects = face_defects(context, vertices, &offsets, indices)?;
    let soup = Soup::arrange(sizes, &offsets, indices, &defects)?;
    let Pairing { twin, bad } = pair(context, vertices, &soup.vert, |c| soup.layout.next(c))?;
    let unusable = !defects.is_empty();
    let policy = if unusable { NonManifold::Error } else { options.non_manifold };
    if policy == NonManifold::Error {
        for edge in &bad {
            memory::extend(&mut defects, [soup.edge_defect(edge)?])?;
        }
    }
    let mut mesh = soup.into_mesh(vertices, twin)?;
    if policy == NonManifold::Sharpen {
        mesh.joints.sides = Joints::of_groups(bad.iter().map(|edge| &edge.corners[..]))?;
    }
    // Joints name corners; a mesh with some keeps its order.
    if mesh.joints.is_empty()
        && let Some(order) = order::breadth_first(&mesh.layout, &mesh.twin)?
    {
        mesh.reorder(&order)?;
    }
    let split = if unusable { Vec::new() } else { several_fans(context, &mut mesh)? };
    let mut vertex_source = None;
    match policy {
        NonManifold::Error => memory::extend(&mut defects, fan_defects(&split, &bad)?)?,
        NonManifold::Cut => vertex_source = cut::separate_fans(&mut mesh, &split)?,
        NonManifold::Sharpen => joints::collect_fans(&mut mesh, &split)?,
    }
    if !defects.is_empty() {
        return Err(Defects::Soup(defects));
    }
    mesh.collect_lists()?;
    mesh.near = Some(Near::of(&mesh)?);
    set_tags(&mut mesh, options, vertex_source.as_deref(), vertices)?;
    Ok(Built { mesh, vertex_source })
}

/// About the bytes that building takes at its peak, measured on quads in order and
/// in none: sides being paired, the arrays of the mesh, orders of faces.
fn peak_bytes(vertices: usize, faces: usize, corners: usize) -> u64 {
    20 * corners as u64 + 12 * (faces as u64 + vertices as u64)
}

/// Checks that everything fits the index type and the memory ceiling; returns the
/// face offsets.
fn check_sizes(
    context: &Context,
    vertices: usize,
    sizes: &[u32],
    indices: &[u32],
) -> Result<Vec<u32>> {
    const LIMIT: u64 = NONE as u64;
    let corners: u64 = sizes.iter().map(|&size| u64::from(size)).sum();
    if corners != indices.len() as u64 {
        return Err(Error::new(
            ErrorKind::LengthMismatch,
            format!("the face sizes add up to {corners}, but {} indices are given", indices.len()),
        ));
    }
    if corners >= LIMIT || vertices as u64 >= LIMIT {
        return Err(Error::new(
            ErrorKind::TooLarge,
            format!("{vertices} vertices and {corners} corners do not fit 32-bit indices"),
        ));
    }
    if sizes.len() as u64 >= LIMIT {
        return Err(Error::new(
            ErrorKind::TooLarge,
            format!("{} faces do not fit 32-bit indices", sizes.len()),
        ));
    }
    context.check_memory(peak_bytes(vertices, sizes.len(), indices.len()))?;
    let mut sum = 0;
    let mut offsets = memory::reserved(sizes.len() + 1)?;
    offsets.push(0);
    offsets.extend(sizes.iter().map(|&size| {
        sum += size;
        sum
    }));
    Ok(offsets)
}

/// The defects that a face has by itself, in face order, one per face.
fn face_defects(
    context: &Context,
    vertices: usize,
    offsets: &[u32],
    indices: &[u32],
) -> Result<Vec<Defect>> {
    let faces = offsets.len() - 1;
    let found = context.map(context.chunks(faces), |range| {
        let mut scratch = Vec::new();
        let mut found = Vec::new();
        for f in range {
            let face = &indices[offsets[f] as usize..offsets[f + 1] as usize];
            memory::extend(&mut found, face_defect(f as u64, face, vertices, &mut scratch)?)?;
        }
        Ok(found)
    })?;
    concatenated(found)
}

/// The lists of all chunks, one after the other.
fn concatenated<T>(parts: Vec<Result<Vec<T>>>) -> Result<Vec<T>> {
    let parts = parts.into_iter().collect::<Result<Vec<_>>>()?;
    memory::collect(parts.into_iter().flatten())
}

fn face_defect(
    id: u64,
    face: &[u32],
    vertices: usize,
    scratch: &mut Vec<u32>,
) -> Result<Option<Defect>> {
    if face.len() < 3 {
        return Ok(Some(Defect::FaceTooSmall { face: id, size: face.len() as u32 }));
    }
    if let Some(&vertex) = face.iter().find(|&&v| v as usize >= vertices) {
        let (vertex, vertices) = (u64::from(vertex), vertices as u64);
        return Ok(Some(Defect::IndexOutOfRange { face: id, vertex, vertices }));
    }
    let repeated = repeated(face, scratch)?;
    Ok(repeated.map(|vertex| Defect::RepeatedVertex { face: id, vertex: u64::from(vertex) }))
}

/// A vertex that occurs twice in a face.
fn repeated(face: &[u32], scratch: &mut Vec<u32>) -> Result<Option<u32>> {
    const SMALL: usize = 12;
    if face.len() <= SMALL {
        return Ok((1..face.len()).find(|&i| face[..i].contains(&face[i])).map(|i| face[i]));
    }
    scratch.clear();
    memory::extend(scratch, face.iter().copied())?;
    scratch.sort_unstable();
    Ok(scratch.windows(2).find(|pair| pair[0] == pair[1]).map(|pair| pair[0]))
}

/// Usable faces in the mesh's order.
struct Soup {
    layout: Layout,
    vert: Vec<u32>,
    /// Input face of each face, unless they are the same.
    source: Option<Vec<u32>>,
}

impl Soup {
    fn arrange(
        sizes: &[u32],
        offsets: &[u32],
        indices: &[u32],
        defects: &[Defect],
    ) -> Result<Self> {
        let mut usable = memory::filled(true, sizes.len())?;
        for defect in defects {
            // The face comes last.
            if let Some(Element::Face(face)) = defect.element(defect.element_count() - 1) {
                usable[face as usize] = false;
            }
        }
        let all = || (0..sizes.len()).filter(|&f| usable[f]);
        let side = if all().all(|f| sizes[f] == 3) { 3 } else { 4 };
        let irregular = || all().filter(|&f| sizes[f] != side);
        let regular = || all().filter(|&f| sizes[f] == side);
        let layout = Layout::new(irregular().map(|f| sizes[f]), side, regular().count() as u32)?;
        let ordered = || irregular().chain(regular());
        let in_place = ordered().enumerate().all(|(new, old)| new == old);
        if in_place {
            let vert = memory::copied(&indices[..layout.corners() as usize])?;
            return Ok(Self { layout, vert, source: None });
        }
        let mut vert = memory::reserved(layout.corners() as usize)?;
        for f in ordered() {
            vert.extend_from_slice(&indices[offsets[f] as usize..offsets[f + 1] as usize]);
        }
        let source = Some(memory::collect(ordered().map(|f| f as u32))?);
        Ok(Self { layout, vert, source })
    }

    /// The defect of a bad edge, in terms of the caller's faces.
    fn edge_defect(&self, bad: &BadEdge) -> Result<Defect> {
        let face = |&corner: &u32| {
            let face = self.layout.face_of(corner);
            u64::from(self.source.as_ref().map_or(face, |source| source[face as usize]))
        };
        let edge = (u64::from(bad.edge.0), u64::from(bad.edge.1));
        let mut faces: Vec<u64> = memory::collect(bad.corners.iter().map(face))?;
        faces.sort_unstable();
        Ok(match faces.len() {
            2 => Defect::InconsistentOrientation { edge, faces },
            _ => Defect::NonManifoldEdge { edge, faces },
        })
    }

    fn into_mesh(self, vertices: usize, twin: Vec<u32>) -> Result<Mesh> {
        Ok(Mesh {
            layout: self.layout,
            vert: self.vert,
            twin,
            start: memory::filled(NONE, vertices)?,
            rim: Vec::new(),
            special: Vec::new(),
            special_set: VertexSet::default(),
            near: None,
            sharpness: Sharpness::default(),
            joints: Joints::default(),
            holes: Vec::new(),
            runs: Vec::new(),
            corner_tags: Vec::new(),
            anchored: false,
            refined: false,
            face_source: self.source,
        })
    }
}

/// Sets the starts of all fans; returns the vertices with more than one.
pub(super) fn several_fans(context: &Context, mesh: &mut Mesh) -> Result<Vec<u32>> {
    let mut valence = memory::zeroed::<u32>(mesh.start.len())?;
    for (corner, (&v, &twin)) in (0..).zip(mesh.vert.iter().zip(&mesh.twin)) {
        let v = v as usize;
        valence[v] += 1;
        if mesh.start[v] == NONE || twin == NONE {
            mesh.start[v] = corner;
        }
    }
    let mesh = &*mesh;
    let found = context.map(context.chunks(valence.len()), |range| {
        let reached = |v: usize| mesh.fan(v as u32).count() as u32;
        let split = range.filter(|&v| reached(v) != valence[v]);
        memory::collect(split.map(|v| v as u32))
    })?;
    concatenated(found)
}

/// Vertices with several fans; the ends of bad edges are reported by the edge.
fn fan_defects(split: &[u32], bad: &[BadEdge]) -> Result<impl Iterator<Item = Defect>> {
    let mut ends: Vec<u32> = memory::collect(bad.iter().flat_map(|e| [e.edge.0, e.edge.1]))?;
    ends.sort_unstable();
    let single = split.iter().filter(move |v| ends.binary_search(v).is_err());
    Ok(single.map(|&v| Defect::NonManifoldVertex { vertex: u64::from(v) }))
}

impl Mesh {
    /// Puts the faces in another order, before fans and lists exist.
    fn reorder(&mut self, order: &[u32]) -> Result<()> {
        let new = order::reorder(&self.layout, &self.vert, &self.twin, order)?;
        (self.layout, self.vert, self.twin) = (new.layout, new.vert, new.twin);
        let source = |&face: &u32| self.face_source.as_ref().map_or(face, |s| s[face as usize]);
        self.face_source = Some(memory::collect(order.iter().map(source))?);
        Ok(())
    }

    /// Fills the lists of boundary corners and special vertices.
    pub(super) fn collect_lists(&mut self) -> Result<()> {
        let corners = 0..self.vert.len() as u32;
        self.rim = memory::collect(corners.filter(|&c| self.twin[c as usize] == NONE))?;
        let vertices = 0..self.start.len() as u32;
        self.special = memory::collect(vertices.filter(|&v| !self.is_regular(v)))?;
        self.special_set = VertexSet::new(self.start.len(), &self.special)?;
        Ok(())
    }

    /// True for an interior vertex of valence 4.
    pub(super) fn is_regular(&self, vertex: u32) -> bool {
        let start = self.start[vertex as usize];
        start != NONE && self.twin[start as usize] != NONE && self.fan(vertex).take(5).count() == 4
    }
}

/// Checks and stores the tags and the anchored flag.
fn set_tags(
    mesh: &mut Mesh,
    options: &BuildOptions,
    source: Option<&[u32]>,
    vertices: usize,
) -> Result<()> {
    let invalid = |v: u32, why: &str| {
        Err(Error::new(ErrorKind::InvalidTag, format!("the corner tag of vertex {v} {why}"))
            .with_elements([Element::Vertex(u64::from(v))]))
    };
    if let Some(&v) = options.corner_tags.iter().find(|&&v| v as usize >= vertices) {
        return invalid(v, "names no vertex of the mesh");
    }
    if let (true, Some(&v)) = (options.anchored, options.corner_tags.first()) {
        return invalid(v, "cannot be kept: an anchored mesh carries no tags");
    }
    let mut tags = memory::copied(options.corner_tags)?;
    tags.sort_unstable();
    let copies = source.unwrap_or_default().iter().enumerate().skip(vertices);
    let tagged = copies.filter(|(_, v)| tags.binary_search(v).is_ok());
    let tagged = memory::collect(tagged.map(|(i, _)| i as u32))?;
    memory::extend(&mut tags, tagged)?;
    tags.sort_unstable();
    tags.dedup();
    if let Some(&v) = tags.iter().find(|&&v| !mesh.on_rim(v)) {
        return invalid(v, "needs a boundary vertex");
    }
    mesh.corner_tags = tags;
    mesh.anchored = options.anchored;
    mesh.refined = options.anchored;
    let (creases, sharp) = (options.creases, options.sharp_vertices);
    mesh.sharpness = sharpness::collect(mesh, creases, sharp, source, vertices)?;
    joints::sharpen_vertices(mesh)?;
    mesh.holes = holes(mesh, options.holes)?;
    if mesh.anchored { anchor::check(mesh) } else { Ok(()) }
}

/// The tagged holes in the mesh's order of faces, ascending.
fn holes(mesh: &Mesh, tagged: &[u32]) -> Result<Vec<u32>> {
    if let Some(&face) = tagged.iter().find(|&&f| f as usize >= mesh.faces()) {
        let message = format!("the hole, face {face}, is not in the mesh");
        let element = Element::Face(u64::from(face));
        return Err(Error::new(ErrorKind::InvalidTag, message).with_elements([element]));
    }
    let mut wanted = memory::copied(tagged)?;
    wanted.sort_unstable();
    wanted.dedup();
    let Some(source) = &mesh.face_source else { return Ok(wanted) };
    let is_wanted = |face: &&u32| wanted.binary_search(face).is_ok();
    memory::collect((0..).zip(source).filter(|(_, face)| is_wanted(face)).map(|(new, _)| new))
}
