//! A slow reference of the averaging family: one split, then smoothing passes.
//!
//! Written from the mathematical specification alone, one function per
//! sentence. In exact arithmetic it is exact; rule `Cosine` then takes faces
//! of 3, 4 and 6 sides only (mirrored ones counted).
//!
//! Numbering of a dual step: the corners, in the order of the concatenated
//! face-vertex array; the β points, two for each boundary edge in the order of
//! its corner (first at the start of the edge); the κ points in vertex order;
//! isolated vertices. Faces: old faces, edges (interior by their smaller
//! corner, then boundary), vertices.

use std::collections::HashMap;

use num_rational::BigRational;

use super::number::{Number, Point, add, blend, combine, mean, ratio, scale};
use super::poly::Poly;
use super::topology::Topology;

/// The corner rule.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rule {
    Cosine,
    Average,
}

/// What a dual scheme does at the boundary.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Boundary {
    None,
    Edge,
    EdgeCorner,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Split {
    Dual,
    Primal,
}

/// How a pass treats the boundary: it follows from split and mode.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PassKind {
    /// After a dual split in `edge` or `edge-corner`: mirrored faces.
    Anchored,
    /// After a dual split in `none`: the univariate filter everywhere.
    Free,
    /// After a primal split: the filter, and single-face vertices stay.
    Primal,
}

/// A member of the family.
#[derive(Clone, Debug, PartialEq)]
pub struct Scheme {
    pub split: Split,
    pub passes: Vec<BigRational>,
    pub rule: Rule,
    pub boundary: Boundary,
}

/// Where a child vertex comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum VertexParent {
    Corner {
        face: usize,
        position: usize,
    },
    /// The β point at the end `at` of the boundary edge `from -> to`, which is
    /// directed as in its face.
    Beta {
        from: usize,
        to: usize,
        at: usize,
    },
    Kappa(usize),
    Isolated(usize),
    /// Primal: the same vertex, isolated or not.
    Vertex(usize),
    /// Primal: an edge, smaller end first.
    Edge(usize, usize),
    /// Primal: a face.
    Face(usize),
}

/// Where a child face comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum FaceParent {
    Face(usize),
    /// Smaller end first. Each direction is used once, so the ends name it.
    Edge(usize, usize),
    Vertex(usize),
    /// Primal: the quad of a corner.
    Corner {
        face: usize,
        position: usize,
    },
}

/// One step, or its split alone, with the parents of all it made.
#[derive(Clone, Debug)]
pub struct Step<N> {
    pub poly: Poly<N>,
    pub vertices: Vec<VertexParent>,
    pub faces: Vec<FaceParent>,
}

impl Scheme {
    pub fn dual(passes: &[(i64, i64)], rule: Rule, boundary: Boundary) -> Self {
        let passes = passes.iter().map(|&(p, q)| ratio(p, q)).collect();
        Self { split: Split::Dual, passes, rule, boundary }
    }

    pub fn primal(passes: &[(i64, i64)], rule: Rule) -> Self {
        Self { split: Split::Primal, ..Self::dual(passes, rule, Boundary::EdgeCorner) }
    }

    pub fn doo_sabin(rule: Rule, boundary: Boundary) -> Self {
        Self::dual(&[], rule, boundary)
    }

    /// Three-point with `w = p / q`: one pass of `t = 1 − 16w`.
    pub fn three_point(p: i64, q: i64, rule: Rule, boundary: Boundary) -> Self {
        Self::dual(&[(q - 16 * p, q)], rule, boundary)
    }

    pub fn quartic(rule: Rule, boundary: Boundary) -> Self {
        Self::dual(&[(0, 1)], rule, boundary)
    }

    pub fn pass_kind(&self) -> PassKind {
        match (self.split, self.boundary) {
            (Split::Primal, _) => PassKind::Primal,
            (Split::Dual, Boundary::None) => PassKind::Free,
            (Split::Dual, _) => PassKind::Anchored,
        }
    }
}

// ---------------------------------------------------------------- the steps

/// `levels` steps.
pub fn refine<N: Number>(poly: &Poly<N>, scheme: &Scheme, levels: usize) -> Poly<N> {
    let mut at = poly.clone();
    for _ in 0..levels {
        at = step(&at, scheme).poly;
    }
    at
}

/// The steps of `levels` levels, each with its parents in the one before.
pub fn hierarchy<N: Number>(poly: &Poly<N>, scheme: &Scheme, levels: usize) -> Vec<Step<N>> {
    let mut steps: Vec<Step<N>> = Vec::new();
    for _ in 0..levels {
        steps.push(step(steps.last().map_or(poly, |s| &s.poly), scheme));
    }
    steps
}

/// One split and all passes.
pub fn step<N: Number>(poly: &Poly<N>, scheme: &Scheme) -> Step<N> {
    let mut made = match scheme.split {
        Split::Dual => split_dual(poly, scheme.rule, scheme.boundary),
        Split::Primal => split_primal(poly),
    };
    for t in &scheme.passes {
        made.poly = pass(&made.poly, &N::from_exact(t), scheme.rule, scheme.pass_kind());
    }
    made
}

/// The weights of one step: `rows[child][parent]`, dense.
pub fn rows<N: Number>(poly: &Poly<N>, scheme: &Scheme) -> Vec<Vec<N>> {
    let n = poly.positions.len();
    let mut rows: Vec<Vec<N>> = Vec::new();
    // Three unit vectors at a time, one in each coordinate.
    for first in (0..n).step_by(3) {
        let mut unit = poly.clone();
        for (v, p) in unit.positions.iter_mut().enumerate() {
            *p = std::array::from_fn(|k| N::ratio(i64::from(v == first + k), 1));
        }
        let made = step(&unit, scheme).poly;
        rows.resize(made.positions.len(), Vec::new());
        for (row, p) in rows.iter_mut().zip(made.positions) {
            row.extend(p.into_iter().take(n - first));
        }
    }
    rows
}

// ------------------------------------------------------ the corner operator

/// The weights αⱼ of `C_t` on an n-gon, from corner 0.
pub fn corner_weights<N: Number>(n: usize, t: &N, rule: Rule) -> Vec<N> {
    match (n, rule) {
        // The mirrored triangle of a boundary edge: the univariate cut.
        (2, _) => {
            let half = N::ratio(1, 2);
            vec![half.clone() * (N::unit() + t.clone()), half * (N::unit() - t.clone())]
        }
        (_, Rule::Cosine) => (0..n).map(|j| cosine_weight(j, n, t)).collect(),
        (_, Rule::Average) => (0..n).map(|j| average_weight(j, n, t)).collect(),
    }
}

fn cosine_weight<N: Number>(j: usize, n: usize, t: &N) -> N {
    let square = t.clone() * t.clone();
    let wave = N::ratio(2, 1) * t.clone() * (N::unit() - t.clone()) * N::cos_turn(j, n);
    let share = N::ratio(1, n as i64) * (N::unit() - square.clone() + wave);
    if j == 0 { square + share } else { share }
}

/// t² of the vertex, t(1−t) of each of the two edge midpoints at it, (1−t)² of
/// the centroid.
fn average_weight<N: Number>(j: usize, n: usize, t: &N) -> N {
    let rest = N::unit() - t.clone();
    let midpoints = t.clone() * rest.clone();
    let centroid = rest.clone() * rest * N::ratio(1, n as i64);
    if j == 0 {
        // Half of either midpoint.
        t.clone() * t.clone() + midpoints + centroid
    } else if j == 1 || j == n - 1 {
        N::ratio(1, 2) * midpoints + centroid
    } else {
        centroid
    }
}

/// `C_t` at corner `i` of a polygon, from its weights.
fn corner_point<N: Number>(polygon: &[Point<N>], i: usize, weights: &[N]) -> Point<N> {
    let n = polygon.len();
    combine(weights.iter().enumerate().map(|(j, w)| (w.clone(), &polygon[(i + j) % n])))
}

/// `C_t` of every corner of a mesh, on its face as `look` sees it; none for the
/// corners that do not lie in the polygon seen.
fn corner_points<N: Number>(
    poly: &Poly<N>,
    t: &N,
    rule: Rule,
    look: impl Fn(usize) -> View<N>,
) -> Vec<Option<Point<N>>> {
    let on_face = |f: usize| {
        let View { polygon, place } = look(f);
        let weights = corner_weights(polygon.len(), t, rule);
        place.into_iter().map(move |i| Some(corner_point(&polygon, i?, &weights)))
    };
    (0..poly.faces.len()).flat_map(on_face).collect()
}

// ------------------------------------------------------- the mirrored faces

/// A face as its corners see it: `place[i]` says where the corner at position
/// `i` of the face lies in the polygon, if it lies there at all.
struct View<N> {
    polygon: Vec<Point<N>>,
    place: Vec<Option<usize>>,
}

fn plain_view<N: Number>(poly: &Poly<N>, f: usize) -> View<N> {
    let polygon: Vec<_> = poly.faces[f].iter().map(|&v| poly.positions[v].clone()).collect();
    View { place: (0..polygon.len()).map(Some).collect(), polygon }
}

/// A face of an anchored mesh, with its image across the anchor row.
fn mirrored_view<N: Number>(poly: &Poly<N>, topo: &Topology, f: usize) -> View<N> {
    let corners = topo.corners_of(f);
    let boundary: Vec<usize> =
        (0..corners.len()).filter(|&i| topo.is_boundary_edge(corners[i])).collect();
    let n = corners.len();
    match boundary[..] {
        [] => plain_view(poly, f),
        [i] => edge_view(poly, f, i),
        // Positions i, i + 1 are consecutive edges, which meet at i + 1.
        [i, j] if (i + 1) % n == j => corner_view(poly, f, j),
        [i, j] if (j + 1) % n == i => corner_view(poly, f, i),
        _ => panic!("face {f} cannot stand beside an anchor row: {:?}", poly.faces[f]),
    }
}

/// The boundary edge runs from position `at` to the next one.
fn edge_view<N: Number>(poly: &Poly<N>, f: usize, at: usize) -> View<N> {
    let cycle = &poly.faces[f];
    let n = cycle.len();
    let m = n - 2;
    let here = |i: usize| &poly.positions[cycle[(at + i) % n]];
    let (a, b) = (here(0), here(1));
    let inner: Vec<Point<N>> = (0..m).map(|i| here(i + 2).clone()).collect();
    // x₁ is beside b, x_m beside a.
    let foot = |i: usize| match m {
        1 => blend((1, 2), a, (1, 2), b),
        _ => blend(((m - 1 - i) as i64, m as i64 - 1), b, (i as i64, m as i64 - 1), a),
    };
    let image = |i: usize| blend((2, 1), &foot(i), (-1, 1), &inner[i]);
    let polygon = inner.iter().cloned().chain((0..m).rev().map(image)).collect();
    let mut place = vec![None; n];
    for i in 0..m {
        place[(at + i + 2) % n] = Some(i);
    }
    View { polygon, place }
}

/// The corner vertex κ of the boundary is at position `at`.
fn corner_view<N: Number>(poly: &Poly<N>, f: usize, at: usize) -> View<N> {
    let View { mut polygon, mut place } = plain_view(poly, f);
    let n = polygon.len();
    assert!(n >= 4, "a triangle has no room for a corner of an anchor row");
    let old = polygon.clone();
    let here = |i: usize| &old[(at + i) % n];
    let (kappa, after, before) = (here(0), here(1), here(n - 1));
    let others = mean((2..n - 1).map(here));
    let image =
        combine([(N::ratio(4, 1), kappa), (N::ratio(-2, 1), after), (N::ratio(-2, 1), before)]);
    polygon[at] = add(&image, &others);
    polygon[(at + 1) % n] = blend((2, 1), after, (-1, 1), here(2));
    polygon[(at + n - 1) % n] = blend((2, 1), before, (-1, 1), here(n - 2));
    for i in [at, at + 1, at + n - 1] {
        place[i % n] = None;
    }
    View { polygon, place }
}

/// Why a mesh cannot be refined as an anchored one; `None` when it can.
pub fn anchored_defect<N: Number>(poly: &Poly<N>) -> Option<String> {
    let topo = Topology::new(poly.positions.len(), &poly.faces);
    let crowded =
        (0..poly.positions.len()).find(|&v| topo.is_boundary(v) && topo.fans[v].len() > 2);
    if let Some(v) = crowded {
        return Some(format!("boundary vertex {v} has more than two faces"));
    }
    let bad = (0..poly.faces.len()).find(|&f| !fits_anchor_row(&topo, f))?;
    Some(format!("face {bad} has boundary edges that do not meet at a corner"))
}

fn fits_anchor_row(topo: &Topology, f: usize) -> bool {
    let corners = topo.corners_of(f);
    let boundary = corners.iter().filter(|&&c| topo.is_boundary_edge(c)).count();
    let meets = corners.iter().any(|&c| topo.is_single_face(topo.vert[c]));
    boundary <= 1 || (boundary == 2 && meets && corners.len() >= 4)
}

// ----------------------------------------------------------- the dual split

/// The corner split, every mode, from a control mesh or an anchored one.
pub fn split_dual<N: Number>(poly: &Poly<N>, rule: Rule, boundary: Boundary) -> Step<N> {
    let topo = Topology::new(poly.positions.len(), &poly.faces);
    let mut made = DualSplit::new(poly, &topo);
    if boundary == Boundary::None {
        made.corners_plain(rule);
    } else if poly.anchored {
        made.corners_anchored(rule);
    } else {
        made.corners_plain(rule);
        made.betas();
        made.kappas(boundary);
    }
    made.isolated();
    made.face_faces();
    made.interior_edge_faces();
    made.boundary_edge_faces();
    made.vertex_faces();
    made.out.poly.anchored = boundary != Boundary::None;
    made.out
}

/// A corner split while it is built. New vertex `c` is that of corner `c`.
struct DualSplit<'a, N> {
    poly: &'a Poly<N>,
    topo: &'a Topology,
    out: Step<N>,
    /// The β point of the boundary edge of corner `c` at the vertex `at`.
    beta: HashMap<(usize, usize), usize>,
    kappa: HashMap<usize, usize>,
}

impl<'a, N: Number> DualSplit<'a, N> {
    fn new(poly: &'a Poly<N>, topo: &'a Topology) -> Self {
        let empty = Poly::new(Vec::new(), Vec::new());
        let out = Step { poly: empty, vertices: Vec::new(), faces: Vec::new() };
        Self { poly, topo, out, beta: HashMap::new(), kappa: HashMap::new() }
    }

    fn vertex(&mut self, position: Point<N>, parent: VertexParent) -> usize {
        self.out.poly.positions.push(position);
        self.out.vertices.push(parent);
        self.out.vertices.len() - 1
    }

    fn face(&mut self, cycle: Vec<usize>, parent: FaceParent) {
        self.out.poly.faces.push(cycle);
        self.out.faces.push(parent);
    }

    fn at(&self, v: usize) -> &'a Point<N> {
        &self.poly.positions[v]
    }

    fn corner(&mut self, c: usize, position: Point<N>) {
        let parent =
            VertexParent::Corner { face: self.topo.face[c], position: self.topo.position[c] };
        self.vertex(position, parent);
    }

    fn corners_plain(&mut self, rule: Rule) {
        let cut = corner_points(self.poly, &N::ratio(1, 2), rule, |f| plain_view(self.poly, f));
        for (c, x) in cut.into_iter().enumerate() {
            self.corner(c, x.expect("every corner is in its plain face"));
        }
    }

    fn corners_anchored(&mut self, rule: Rule) {
        if let Some(defect) = anchored_defect(self.poly) {
            panic!("not an anchored mesh: {defect}");
        }
        let look = |f| mirrored_view(self.poly, self.topo, f);
        let cut = corner_points(self.poly, &N::ratio(1, 2), rule, look);
        for (c, inner) in cut.into_iter().enumerate() {
            let x = self.row_corner(c).or(inner);
            self.corner(c, x.expect("a corner off the row sees itself"));
        }
    }

    /// The child of a corner that has a boundary edge at its vertex.
    fn row_corner(&self, c: usize) -> Option<Point<N>> {
        let topo = self.topo;
        let (out, into) = (c, topo.prev[c]);
        let v = topo.vert[c];
        match (topo.is_boundary_edge(out), topo.is_boundary_edge(into)) {
            (true, true) => Some(self.at(v).clone()),
            (true, false) => Some(self.along_row(v, topo.vert[topo.next[c]])),
            (false, true) => Some(self.along_row(v, topo.vert[into])),
            (false, false) => None,
        }
    }

    /// The row is half an interval long beside a corner.
    fn along_row(&self, v: usize, u: usize) -> Point<N> {
        if self.topo.is_single_face(u) {
            blend((1, 2), self.at(v), (1, 2), self.at(u))
        } else {
            blend((3, 4), self.at(v), (1, 4), self.at(u))
        }
    }

    fn betas(&mut self) {
        for c in self.topo.boundary_edges() {
            let (a, b) = (self.topo.vert[c], self.topo.vert[self.topo.next[c]]);
            for (at, other) in [(a, b), (b, a)] {
                let x = blend((3, 4), self.at(at), (1, 4), self.at(other));
                let made = self.vertex(x, VertexParent::Beta { from: a, to: b, at });
                self.beta.insert((c, at), made);
            }
        }
    }

    /// Tags mean something at boundary vertices only: inside they wait for
    /// creases.
    fn kappas(&mut self, boundary: Boundary) {
        for v in 0..self.poly.positions.len() {
            let single = self.topo.is_single_face(v) && boundary == Boundary::EdgeCorner;
            let tagged = self.topo.is_boundary(v) && self.poly.tags.contains(&v);
            if single || tagged {
                let made = self.vertex(self.at(v).clone(), VertexParent::Kappa(v));
                self.kappa.insert(v, made);
            }
        }
    }

    fn isolated(&mut self) {
        for v in self.topo.isolated() {
            self.vertex(self.at(v).clone(), VertexParent::Isolated(v));
        }
    }

    fn face_faces(&mut self) {
        for f in 0..self.topo.face_count() {
            self.face(self.topo.corners_of(f), FaceParent::Face(f));
        }
    }

    fn edge_parent(&self, c: usize) -> FaceParent {
        let (a, b) = ends(self.topo, c);
        FaceParent::Edge(a, b)
    }

    fn interior_edge_faces(&mut self) {
        for c in self.topo.interior_edges() {
            let g = self.topo.twin[c].expect("an interior edge has two sides");
            let cycle = vec![self.topo.next[c], c, self.topo.next[g], g];
            self.face(cycle, self.edge_parent(c));
        }
    }

    /// Only a first step has β points and so these faces.
    fn boundary_edge_faces(&mut self) {
        for c in self.topo.boundary_edges() {
            let (a, b) = (self.topo.vert[c], self.topo.vert[self.topo.next[c]]);
            if let (Some(&at_a), Some(&at_b)) = (self.beta.get(&(c, a)), self.beta.get(&(c, b))) {
                let cycle = vec![self.topo.next[c], c, at_a, at_b];
                self.face(cycle, self.edge_parent(c));
            }
        }
    }

    fn vertex_faces(&mut self) {
        for v in 0..self.poly.positions.len() {
            let cycle = if self.topo.is_boundary(v) {
                self.boundary_vertex_cycle(v)
            } else {
                self.topo.fans[v].clone()
            };
            // An interior vertex of valence 2 gives no face, nor does an
            // isolated one, nor a boundary vertex without β points.
            if cycle.len() >= 3 {
                self.face(cycle, FaceParent::Vertex(v));
            }
        }
    }

    /// β on the outgoing boundary edge, the corners, β on the incoming one, κ.
    fn boundary_vertex_cycle(&self, v: usize) -> Vec<usize> {
        let fan = &self.topo.fans[v];
        let outgoing = fan[0];
        let incoming = self.topo.prev[fan[fan.len() - 1]];
        let (Some(&first), Some(&last)) =
            (self.beta.get(&(outgoing, v)), self.beta.get(&(incoming, v)))
        else {
            return Vec::new();
        };
        let mut cycle = vec![first];
        cycle.extend(fan);
        cycle.push(last);
        cycle.extend(self.kappa.get(&v));
        cycle
    }
}

/// The ends of the edge that leaves a corner, the smaller first.
fn ends(topo: &Topology, c: usize) -> (usize, usize) {
    let (a, b) = (topo.vert[c], topo.vert[topo.next[c]]);
    (a.min(b), a.max(b))
}

// --------------------------------------------------------- the primal split

/// The quad split: old vertices, edge midpoints, face centroids.
pub fn split_primal<N: Number>(poly: &Poly<N>) -> Step<N> {
    let topo = Topology::new(poly.positions.len(), &poly.faces);
    let at = |v: usize| &poly.positions[v];
    let mut positions = poly.positions.clone();
    let mut vertices: Vec<_> = (0..positions.len()).map(VertexParent::Vertex).collect();
    let mut edge_vertex = HashMap::new();
    for c in topo.interior_edges().into_iter().chain(topo.boundary_edges()) {
        let (a, b) = ends(&topo, c);
        edge_vertex.insert((a, b), positions.len());
        positions.push(blend((1, 2), at(a), (1, 2), at(b)));
        vertices.push(VertexParent::Edge(a, b));
    }
    let first_face = positions.len();
    for (f, cycle) in poly.faces.iter().enumerate() {
        positions.push(mean(cycle.iter().map(|&v| at(v))));
        vertices.push(VertexParent::Face(f));
    }
    let quad = |c: usize| {
        let on = |c| edge_vertex[&ends(&topo, c)];
        vec![topo.vert[c], on(c), first_face + topo.face[c], on(topo.prev[c])]
    };
    let parent = |c| FaceParent::Corner { face: topo.face[c], position: topo.position[c] };
    let corners = 0..topo.corner_count();
    let faces = corners.clone().map(quad).collect();
    Step { poly: Poly::new(positions, faces), vertices, faces: corners.map(parent).collect() }
}

// ----------------------------------------------------------------- the pass

/// The smoothing pass `M_t`.
pub fn pass<N: Number>(poly: &Poly<N>, t: &N, rule: Rule, kind: PassKind) -> Poly<N> {
    let topo = Topology::new(poly.positions.len(), &poly.faces);
    let look = |f| match kind {
        PassKind::Anchored => mirrored_view(poly, &topo, f),
        PassKind::Free | PassKind::Primal => plain_view(poly, f),
    };
    let moved = corner_points(poly, t, rule, look);
    let move_vertex = |v: usize| {
        if topo.is_isolated(v) {
            poly.positions[v].clone()
        } else if topo.is_boundary(v) {
            boundary_pass(poly, &topo, v, t, kind)
        } else {
            let seen = |&c: &usize| moved[c].as_ref().expect("an interior vertex sees itself");
            mean(topo.fans[v].iter().map(seen))
        }
    };
    let positions = (0..poly.positions.len()).map(move_vertex).collect();
    Poly { positions, ..poly.clone() }
}

/// The univariate filter (a/2, 1−a, a/2), a = (1−t)/2, along the boundary.
fn boundary_pass<N: Number>(
    poly: &Poly<N>,
    topo: &Topology,
    v: usize,
    t: &N,
    kind: PassKind,
) -> Point<N> {
    let x = &poly.positions[v];
    if topo.is_single_face(v) && kind != PassKind::Free {
        return x.clone();
    }
    let (p, q) = topo.boundary_neighbours(v);
    let seen = |u: usize| {
        let y = &poly.positions[u];
        let mirrored = kind == PassKind::Anchored && topo.is_single_face(u);
        if mirrored { blend((2, 1), y, (-1, 1), x) } else { y.clone() }
    };
    let half_a = N::ratio(1, 4) * (N::unit() - t.clone());
    let stay = N::unit() - N::ratio(2, 1) * half_a.clone();
    add(&scale(&stay, x), &scale(&half_a, &add(&seen(p), &seen(q))))
}
