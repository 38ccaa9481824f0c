//! Sharp edges and vertices of a mesh, found by number.

use super::Mesh;
use crate::base::{Crease, Element, Error, ErrorKind, NONE, Result, SharpVertex, memory};

/// The sharpness from which on a feature never becomes smooth.
pub(crate) const INFINITE: f32 = 10.0;

/// The sharp features of a mesh, sorted; none of them has sharpness 0.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Sharpness {
    /// First corner of each sharp interior edge, and its sharpness.
    pub(crate) edges: Vec<(u32, f32)>,
    /// Each sharp vertex and its sharpness.
    pub(crate) vertices: Vec<(u32, f32)>,
}

/// No NaN comes in, so equality is what it should be.
impl Eq for Sharpness {}

impl Sharpness {
    pub(crate) fn is_empty(&self) -> bool {
        self.edges.is_empty() && self.vertices.is_empty()
    }

    /// The sharpness of the edge with a first corner.
    pub(crate) fn edge(&self, first: u32) -> f32 {
        find(&self.edges, first)
    }

    /// The sharpness of a vertex.
    pub(crate) fn vertex(&self, vertex: u32) -> f32 {
        find(&self.vertices, vertex)
    }

    /// Bytes held.
    pub(crate) fn bytes(&self) -> u64 {
        8 * (self.edges.capacity() + self.vertices.capacity()) as u64
    }

    /// True if both lists ascend, name what exists, and hold sharpness in (0, 10].
    pub(super) fn is_consistent(&self, mesh: &Mesh) -> bool {
        let sorted = |list: &[(u32, f32)]| list.windows(2).all(|pair| pair[0].0 < pair[1].0);
        let sharp = |list: &[(u32, f32)]| list.iter().all(|&(_, s)| s > 0.0 && s <= INFINITE);
        let first =
            |&(c, _): &(u32, f32)| mesh.twin.get(c as usize).is_some_and(|&t| c < t && t != NONE);
        let vertex = |&(v, _): &(u32, f32)| (v as usize) < mesh.start.len();
        sorted(&self.edges)
            && sorted(&self.vertices)
            && sharp(&self.edges)
            && sharp(&self.vertices)
            && self.edges.iter().all(first)
            && self.vertices.iter().all(vertex)
    }
}

fn find(list: &[(u32, f32)], key: u32) -> f32 {
    list.binary_search_by_key(&key, |&(k, _)| k).map_or(0.0, |i| list[i].1)
}

/// Turns the caller's tags into sorted lists. `source` leads from copied vertices to
/// the caller's; a copy is as sharp as its source.
pub(super) fn collect(
    mesh: &Mesh,
    creases: &[Crease],
    sharp_vertices: &[SharpVertex],
    source: Option<&[u32]>,
    vertices: usize,
) -> Result<Sharpness> {
    let copies = Copies::new(source, vertices)?;
    let mut edges = find_edges(mesh, creases, &copies, vertices)?;
    // The boundary is infinitely sharp in any case.
    edges.retain(|&(c, _)| mesh.twin[c as usize] != NONE);
    let edges = unique(edges, |c| {
        let (a, b) = (mesh.vert[c as usize], mesh.vert[mesh.next(c) as usize]);
        Element::Edge(u64::from(copies.origin(a)), u64::from(copies.origin(b)))
    })?;
    let mut list = Vec::new();
    for tag in sharp_vertices {
        let element = Element::Vertex(u64::from(tag.vertex));
        let sharpness = checked(tag.sharpness, || element)?;
        if tag.vertex as usize >= vertices {
            return Err(invalid("a sharp vertex", "is not in the mesh", element));
        }
        memory::extend(&mut list, copies.of(tag.vertex).map(|v| (v, sharpness)))?;
    }
    let vertices = unique(list, |v| Element::Vertex(u64::from(copies.origin(v))))?;
    Ok(Sharpness { edges, vertices })
}

fn edge_element(crease: &Crease) -> Element {
    Element::Edge(u64::from(crease.vertices[0]), u64::from(crease.vertices[1]))
}

fn invalid(what: &str, why: &str, element: Element) -> Error {
    Error::new(ErrorKind::InvalidTag, format!("{what}, {element}, {why}")).with_elements([element])
}

fn checked(sharpness: f32, element: impl Fn() -> Element) -> Result<f32> {
    if sharpness >= 0.0 {
        return Ok(sharpness.min(INFINITE));
    }
    let why = format!("has sharpness {sharpness:?}, which is not a number from 0 up");
    Err(invalid("a tag", &why, element()))
}

/// The first corners of the creases' edges with their sharpness: one look at every edge.
fn find_edges(
    mesh: &Mesh,
    creases: &[Crease],
    copies: &Copies,
    vertices: usize,
) -> Result<Vec<(u32, f32)>> {
    let key = |[a, b]: [u32; 2]| (a.min(b), a.max(b));
    let mut wanted = memory::reserved(creases.len())?;
    for (crease, number) in creases.iter().zip(0_u32..) {
        checked(crease.sharpness, || edge_element(crease))?;
        if crease.vertices.iter().any(|&v| v as usize >= vertices) {
            return Err(invalid("a crease", "names no edge of the mesh", edge_element(crease)));
        }
        wanted.push((key(crease.vertices), number));
    }
    wanted.sort_unstable();
    let mut found = memory::filled(false, wanted.len())?;
    let mut edges = Vec::new();
    let all = 0..if wanted.is_empty() { 0 } else { mesh.layout.corners() };
    for c in all.filter(|&c| mesh.is_first_of_edge(c)) {
        let ends = [c, mesh.next(c)].map(|c| copies.origin(mesh.vert[c as usize]));
        let first = wanted.partition_point(|(edge, _)| *edge < key(ends));
        let same = wanted[first..].iter().take_while(|(edge, _)| *edge == key(ends));
        for (place, (_, number)) in (first..).zip(same) {
            found[place] = true;
            let sharpness = creases[*number as usize].sharpness.min(INFINITE);
            memory::extend(&mut edges, [(c, sharpness)])?;
        }
    }
    // The first of the caller's creases that was not met.
    let lost = wanted.iter().zip(&found).filter(|(_, found)| !**found).map(|(w, _)| w.1).min();
    match lost.map(|number| &creases[number as usize]) {
        Some(crease) => Err(invalid("a crease", "names no edge of the mesh", edge_element(crease))),
        None => Ok(edges),
    }
}

/// Sorts tags by element; the same element twice must say the same.
fn unique(mut tags: Vec<(u32, f32)>, element: impl Fn(u32) -> Element) -> Result<Vec<(u32, f32)>> {
    tags.sort_unstable_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
    tags.dedup();
    if let Some(pair) = tags.windows(2).find(|pair| pair[0].0 == pair[1].0) {
        let why = format!("has two sharpnesses, {} and {}", pair[0].1, pair[1].1);
        return Err(invalid("a tag", &why, element(pair[0].0)));
    }
    tags.retain(|&(_, sharpness)| sharpness > 0.0);
    Ok(tags)
}

/// Copies of vertices that policy `cut` made.
struct Copies<'a> {
    source: Option<&'a [u32]>,
    /// The number of vertices that are no copies.
    vertices: usize,
    /// (vertex, copy), sorted.
    list: Vec<(u32, u32)>,
}

impl<'a> Copies<'a> {
    fn new(source: Option<&'a [u32]>, vertices: usize) -> Result<Self> {
        let copies = source.unwrap_or_default().iter().zip(0..).skip(vertices);
        let mut list = memory::collect(copies.map(|(&v, copy)| (v, copy)))?;
        list.sort_unstable();
        Ok(Self { source, vertices, list })
    }

    fn origin(&self, vertex: u32) -> u32 {
        self.source.map_or(vertex, |source| source[vertex as usize])
    }

    /// A vertex and its copies; none if the caller has no such vertex.
    fn of(&self, vertex: u32) -> impl Iterator<Item = u32> + '_ {
        let first = self.list.partition_point(|&(v, _)| v < vertex);
        let copies = self.list[first..].iter().take_while(move |&&(v, _)| v == vertex);
        let own = ((vertex as usize) < self.vertices).then_some(vertex);
        own.into_iter().chain(copies.map(|&(_, copy)| copy))
    }
}
