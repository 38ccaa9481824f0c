//! Every level's adjacency and lineage against what its faces alone say.
//!
//! A split computes the child's twins, fans and parents by arithmetic. Here they
//! are found again by brute force, from the face list and from the numbering
//! that the documentation of the corner split promises.

use std::collections::HashMap;

use carvel::Mesh;
use carvel::base::NONE;
use carvel::refine::{FaceOrigin, VertexOrigin};
use proptest::prelude::*;

use crate::support::bases;
use crate::support::cases::{all_schemes, config, schemes};
use crate::support::compare::canonical_cycle;
use crate::support::generate::{Kind, tagged_meshes};
use crate::support::kernel::{self, Soup};
use crate::support::manifold::assert_manifold;
use crate::support::poly::Poly;
use crate::support::reference::{self, Boundary, FaceParent, Rule, Scheme, VertexParent};
use crate::support::topology::Topology;

const LEVELS: u32 = 3;

fn topology(mesh: &Mesh) -> Topology {
    Topology::new(mesh.vertices(), &kernel::faces(mesh))
}

// ------------------------------------------------------------------ adjacency

/// Everything a mesh says about itself, found again from its faces.
fn check_adjacency(mesh: &Mesh) {
    assert_manifold(mesh.vertices(), &kernel::faces(mesh));
    let topo = topology(mesh);
    let twins = topo.twin.iter().map(|t| t.map_or(NONE, |c| c as u32));
    assert!(twins.eq(mesh.corner_twins().iter().copied()), "twins");
    assert!(topo.vert.iter().copied().eq(mesh.corner_vertices().iter().map(|&v| v as usize)));
    for f in 0..mesh.faces() {
        assert_eq!(mesh.face_corners(f).collect::<Vec<_>>(), topo.corners_of(f), "face {f}");
    }
    assert_eq!(mesh.edges(), topo.edge_count());
    assert_eq!(mesh.boundary_edges(), topo.boundary_edges().len());
    for v in 0..mesh.vertices() {
        assert_eq!(mesh.valence(v), topo.fans[v].len(), "faces of vertex {v}");
        assert_eq!(mesh.is_boundary_vertex(v), topo.is_boundary(v), "vertex {v}");
    }
}

/// Built from its faces, a level keeps its faces, vertices and adjacency.
fn check_rebuilt(mesh: &Mesh) {
    let faces = kernel::faces(mesh);
    let rebuilt = Soup::new(mesh.vertices(), &faces).mesh(mesh.is_anchored());
    rebuilt.validate().expect("a valid mesh");
    assert_eq!(rebuilt.corner_vertices(), mesh.corner_vertices());
    assert_eq!(rebuilt.corner_twins(), mesh.corner_twins());
    assert!((0..mesh.faces()).all(|f| rebuilt.face_source(f) == f), "order of {faces:?}");
}

// ---------------------------------------------------------- documented numbering

/// The children of a corner split, from its documentation and the parent's faces.
struct Expected<'a> {
    topo: &'a Topology,
    anchored: bool,
    kappas: Vec<usize>,
}

impl<'a> Expected<'a> {
    fn new(parent: &Mesh, topo: &'a Topology, scheme: &Scheme) -> Self {
        let anchored = scheme.boundary != Boundary::None && !parent.is_anchored();
        let single = |v| scheme.boundary == Boundary::EdgeCorner && topo.is_single_face(v);
        let tagged = |v: usize| parent.corner_tags().contains(&(v as u32));
        let kappa = |&v: &usize| anchored && (single(v) || tagged(v));
        Self { topo, anchored, kappas: (0..parent.vertices()).filter(kappa).collect() }
    }

    /// Corners, β in pairs, κ, isolated vertices.
    fn vertex_origins(&self) -> Vec<VertexOrigin> {
        let corners = (0..self.topo.corner_count()).map(|c| VertexOrigin::Corner(c as u32));
        let beta = |(c, at_end)| VertexOrigin::EdgeEnd { corner: c as u32, at_end };
        let rim = self.rim();
        let betas = rim.iter().flat_map(|&c| [(c, false), (c, true)]).map(beta);
        let vertices = self.kappas.iter().copied().chain(self.topo.isolated());
        corners.chain(betas).chain(vertices.map(|v| VertexOrigin::Vertex(v as u32))).collect()
    }

    /// The boundary corners that get β points.
    fn rim(&self) -> Vec<usize> {
        if self.anchored { self.topo.boundary_edges() } else { Vec::new() }
    }

    fn beta(&self, corner: usize, at_end: bool) -> usize {
        let place = self.rim().iter().position(|&c| c == corner).expect("a boundary corner");
        self.topo.corner_count() + 2 * place + usize::from(at_end)
    }

    /// The child face of an origin, starting where the documentation says.
    fn face(&self, origin: FaceOrigin) -> Vec<usize> {
        match origin {
            FaceOrigin::Face(f) => self.topo.corners_of(f as usize),
            FaceOrigin::Edge(c) => self.edge_quad(c as usize),
            FaceOrigin::Vertex(v) => self.vertex_face(v as usize),
            other => panic!("{other:?} is no parent in a corner split"),
        }
    }

    fn edge_quad(&self, c: usize) -> Vec<usize> {
        let next = &self.topo.next;
        match self.topo.twin[c] {
            Some(g) => vec![next[c], c, next[g], g],
            None => vec![next[c], c, self.beta(c, false), self.beta(c, true)],
        }
    }

    fn vertex_face(&self, v: usize) -> Vec<usize> {
        let mut face = self.topo.fans[v].clone();
        if self.topo.is_boundary(v) {
            let incoming = self.topo.prev[face[face.len() - 1]];
            face.insert(0, self.beta(face[0], false));
            face.push(self.beta(incoming, true));
            let betas = self.topo.corner_count() + 2 * self.rim().len();
            face.extend(self.kappas.iter().position(|&k| k == v).map(|place| betas + place));
        }
        face
    }

    /// All parents of faces, the irregular ones in their order, the rest sorted.
    fn face_origins(&self) -> (Vec<FaceOrigin>, Vec<FaceOrigin>) {
        let faces = (0..self.topo.face_count()).map(|f| FaceOrigin::Face(f as u32));
        let edges = self.topo.interior_edges().into_iter().chain(self.rim());
        let edges = edges.map(|c| FaceOrigin::Edge(c as u32));
        let has_face = |v: &usize| {
            let inside = self.topo.is_interior(*v) && self.topo.fans[*v].len() >= 3;
            inside || (self.anchored && self.topo.is_boundary(*v))
        };
        let vertices = (0..self.topo.fans.len()).filter(has_face);
        let vertices = vertices.map(|v| FaceOrigin::Vertex(v as u32));
        let is_quad = |o: &FaceOrigin| self.face(*o).len() == 4;
        let all = faces.chain(vertices).chain(edges);
        let (mut quads, irregular): (Vec<_>, Vec<_>) = all.partition(is_quad);
        quads.sort_by_key(|&o| rank(o));
        (irregular, quads)
    }

    /// The edge named by its smaller corner: either may lead it.
    fn normal(&self, origin: FaceOrigin) -> FaceOrigin {
        match origin {
            FaceOrigin::Edge(c) => {
                let twin = self.topo.twin[c as usize].unwrap_or(c as usize);
                FaceOrigin::Edge(c.min(twin as u32))
            }
            other => other,
        }
    }
}

/// Some order of origins.
fn rank(origin: FaceOrigin) -> (u32, u32) {
    match origin {
        FaceOrigin::Face(f) => (0, f),
        FaceOrigin::Edge(c) => (1, c),
        FaceOrigin::Vertex(v) => (2, v),
        other => panic!("{other:?} is no parent in a corner split"),
    }
}

/// Lineage and faces of a level, element by element. Where the quads stand is
/// the kernel's to choose; [`check_rebuilt`] holds it to one choice.
fn check_numbering(
    parent: &Mesh,
    child: &Mesh,
    scheme: &Scheme,
    vertices: &[VertexOrigin],
    faces: &[FaceOrigin],
) {
    let topo = topology(parent);
    let expected = Expected::new(parent, &topo, scheme);
    assert_eq!(vertices, expected.vertex_origins());
    let (irregular, quads) = expected.face_origins();
    let (first, rest) = faces.split_at(irregular.len());
    assert_eq!(first, irregular);
    let mut rest: Vec<_> = rest.iter().map(|&o| expected.normal(o)).collect();
    rest.sort_by_key(|&o| rank(o));
    assert_eq!(rest, quads);
    for (f, &origin) in faces.iter().enumerate() {
        let cycle: Vec<usize> = child.face_vertices(f).iter().map(|&v| v as usize).collect();
        // A fan inside has no first corner of its own.
        let turns = matches!(origin, FaceOrigin::Vertex(v) if topo.is_interior(v as usize));
        let normal = |cycle| if turns { canonical_cycle(cycle) } else { cycle };
        assert_eq!(normal(cycle), normal(expected.face(origin)), "face {f} from {origin:?}");
        check_representative(parent, &topo, origin);
    }
}

/// The face whose data a child inherits: its own, its edge's, one at its vertex.
fn check_representative(parent: &Mesh, topo: &Topology, origin: FaceOrigin) {
    let face = origin.representative(parent) as usize;
    let right = match origin {
        FaceOrigin::Face(f) => face == f as usize,
        FaceOrigin::Edge(c) => face == topo.face[c as usize],
        FaceOrigin::Vertex(v) if topo.is_boundary(v as usize) => {
            face == topo.face[topo.fans[v as usize][0]]
        }
        FaceOrigin::Vertex(v) => topo.fans[v as usize].iter().any(|&c| topo.face[c] == face),
        other => panic!("{other:?} is no parent in a corner split"),
    };
    assert!(right, "{origin:?} is represented by face {face}");
}

// --------------------------------------------------------------------- oracle

/// The oracle's name for the parent of a vertex.
fn vertex_parent(topo: &Topology, origin: VertexOrigin) -> VertexParent {
    match origin {
        VertexOrigin::Corner(c) => {
            let c = c as usize;
            VertexParent::Corner { face: topo.face[c], position: topo.position[c] }
        }
        VertexOrigin::EdgeEnd { corner, at_end } => {
            let c = corner as usize;
            let (from, to) = (topo.vert[c], topo.vert[topo.next[c]]);
            VertexParent::Beta { from, to, at: if at_end { to } else { from } }
        }
        VertexOrigin::Vertex(v) if topo.is_isolated(v as usize) => {
            VertexParent::Isolated(v as usize)
        }
        VertexOrigin::Vertex(v) => VertexParent::Kappa(v as usize),
        other => panic!("{other:?} is no parent in a corner split"),
    }
}

fn face_parent(topo: &Topology, origin: FaceOrigin) -> FaceParent {
    match origin {
        FaceOrigin::Face(f) => FaceParent::Face(f as usize),
        FaceOrigin::Edge(c) => {
            let (a, b) = (topo.vert[c as usize], topo.vert[topo.next[c as usize]]);
            FaceParent::Edge(a.min(b), a.max(b))
        }
        FaceOrigin::Vertex(v) => FaceParent::Vertex(v as usize),
        other => panic!("{other:?} is no parent in a corner split"),
    }
}

/// Same parents as the oracle's step on the same mesh, and the same children.
fn check_against_oracle(
    parent: &Mesh,
    child: &Mesh,
    scheme: &Scheme,
    vertices: &[VertexOrigin],
    faces: &[FaceOrigin],
) {
    let tags = parent.corner_tags().iter().map(|&v| v as usize).collect();
    let flat = vec![0.0; 3 * parent.vertices()];
    let step = reference::step(&Poly { tags, ..kernel::poly(parent, &flat) }, scheme);
    let topo = topology(parent);
    let parents: Vec<_> = vertices.iter().map(|&o| vertex_parent(&topo, o)).collect();
    // Parents are distinct, so they say which vertex is which.
    let place: HashMap<_, _> = step.vertices.iter().enumerate().map(|(i, p)| (*p, i)).collect();
    assert_eq!(place.len(), parents.len(), "as many children");
    let partner: Vec<usize> = parents.iter().map(|p| place[p]).collect();
    let cycles = step.faces.iter().zip(&step.poly.faces);
    let cycles: HashMap<_, _> = cycles.map(|(p, f)| (*p, canonical_cycle(f.clone()))).collect();
    assert_eq!(cycles.len(), faces.len(), "as many faces");
    for (f, &origin) in faces.iter().enumerate() {
        let cycle = child.face_vertices(f).iter().map(|&v| partner[v as usize]).collect();
        assert_eq!(canonical_cycle(cycle), cycles[&face_parent(&topo, origin)], "face {f}");
    }
}

fn check_levels(control: &Poly<f64>, scheme: &Scheme) {
    let hierarchy = kernel::hierarchy(control, scheme, LEVELS);
    check_adjacency(hierarchy.mesh(0));
    for level in 1..=LEVELS {
        let (parent, child) = (hierarchy.mesh(level - 1), hierarchy.mesh(level));
        check_adjacency(child);
        let vertices = hierarchy.vertex_origins(level).expect("a level that was built");
        let faces = hierarchy.face_origins(level).expect("a level that was built");
        check_numbering(parent, child, scheme, &vertices, &faces);
        if level < LEVELS {
            check_against_oracle(parent, child, scheme, &vertices, &faces);
        }
    }
}

fn check_rebuilt_levels(control: &Poly<f64>, scheme: &Scheme) {
    let hierarchy = kernel::hierarchy(control, scheme, LEVELS);
    for level in 1..=LEVELS {
        check_rebuilt(hierarchy.mesh(level));
    }
}

proptest! {
    #![proptest_config(config(128))]

    #[test]
    fn levels_are_what_their_faces_say(
        control in tagged_meshes(Kind::Any),
        scheme in schemes(),
    ) {
        check_levels(&control, &scheme);
    }

    #[test]
    fn levels_built_from_their_faces_are_the_same(
        control in tagged_meshes(Kind::Any),
        scheme in schemes(),
    ) {
        check_rebuilt_levels(&control, &scheme);
    }
}

/// Named awkward meshes, under every boundary rule.
fn each_awkward_case(check: impl Fn(&Poly<f64>, &Scheme)) {
    let awkward = [
        // All triangles: the regular size is 3 once, and 4 ever after.
        bases::tetrahedron(),
        bases::triangle_grid(2, 2),
        // Lone faces: nothing but boundary.
        bases::polygon(3),
        bases::polygon(4),
        bases::polygon(7),
        // Interior vertices of valence 2.
        bases::pillow(4),
        bases::valence_two(),
        // Vertices with more faces than a short fan has.
        bases::fan(40),
        bases::half_fan(40),
        // Two loops.
        bases::frame(),
        bases::annulus(3, 1),
        // A triangle beside a quad: every face along the boundary is a quad.
        Poly::new(vec![[0.0; 3]; 5], vec![vec![2, 1, 3], vec![2, 0, 4, 1]]),
        // Nothing to split.
        Poly::new(vec![[0.0; 3]; 3], Vec::new()),
    ];
    let plain = |scheme: &Scheme| scheme.passes.is_empty();
    for scheme in all_schemes().into_iter().filter(plain) {
        for mesh in &awkward {
            check(mesh, &scheme);
        }
    }
}

#[test]
fn awkward_levels_are_what_their_faces_say() {
    each_awkward_case(check_levels);
}

#[test]
fn awkward_levels_built_from_their_faces_are_the_same() {
    each_awkward_case(check_rebuilt_levels);
}

/// Beside an interior vertex of valence 2 the quads of its two edges meet. Either of them
/// could lead the edge between; where its child stands follows from who does.
#[test]
fn the_smaller_of_two_edge_quads_leads_between_them() {
    for control in [bases::pillow(4), bases::pillow(5), bases::valence_two()] {
        let scheme = Scheme::doo_sabin(Rule::Cosine, Boundary::None);
        let hierarchy = kernel::hierarchy(&control, &scheme, 2);
        let mesh = hierarchy.mesh(1);
        let topo = topology(mesh);
        let faces = hierarchy.face_origins(1).expect("a level that was built");
        let of_edge = |c: usize| matches!(faces[topo.face[c]], FaceOrigin::Edge(_));
        let mut met = 0;
        for origin in hierarchy.face_origins(2).expect("a level that was built") {
            let FaceOrigin::Edge(corner) = origin else { continue };
            let twin = mesh.corner_twins()[corner as usize];
            if of_edge(corner as usize) && of_edge(twin as usize) {
                assert!(corner < twin, "{twin} is smaller than {corner}");
                met += 1;
            }
        }
        assert!(met > 0, "no two quads of edges met");
    }
}
