//! Random manifold polygon meshes, the same for the same seed.
//!
//! A mesh starts from base meshes and goes through local edits. An edit that
//! could break the manifold is made on a copy and kept only if the brute-force
//! check agrees, and every finished mesh is checked once more, so a property
//! test may rely on it.

use proptest::prelude::{Strategy, any};

use super::bases;
use super::manifold::{assert_manifold, defects};
use super::number::{Point, add, mean};
use super::poly::Poly;
use super::rng::Rng;
use super::topology::Topology;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Closed and open components side by side.
    Any,
    /// No boundary edge.
    Closed,
    /// A boundary on every component.
    Open,
}

/// All that a mesh depends on. Fewer edits with the same seed are the first of
/// the same edits, so that proptest can shrink a failure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Recipe {
    pub seed: u64,
    pub kind: Kind,
    pub components: usize,
    pub edits: usize,
    pub isolated: usize,
}

/// Faces never grow beyond this.
const LARGEST_FACE: usize = 14;
/// Edits stop here, to keep the brute force affordable.
const MOST_CORNERS: usize = 600;

pub fn recipes(kind: Kind) -> impl Strategy<Value = Recipe> {
    (any::<u64>(), 1..=3usize, 0..24usize, 0..3usize).prop_map(
        move |(seed, components, edits, isolated)| Recipe {
            seed,
            kind,
            components,
            edits,
            isolated,
        },
    )
}

/// Random meshes for proptest.
pub fn meshes(kind: Kind) -> impl Strategy<Value = Poly<f64>> {
    recipes(kind).prop_map(|recipe| mesh(&recipe))
}

/// Random meshes with some boundary vertices tagged as corners.
pub fn tagged_meshes(kind: Kind) -> impl Strategy<Value = Poly<f64>> {
    (meshes(kind), any::<u64>()).prop_map(|(mut mesh, seed)| {
        mesh.tags = random_tags(&mesh, &mut Rng::new(seed));
        mesh
    })
}

/// A mesh of some size from a seed alone, for plain loops.
pub fn seeded(seed: u64, kind: Kind) -> Poly<f64> {
    let mut rng = Rng::new(seed ^ 0x5eed);
    mesh(&Recipe {
        seed,
        kind,
        components: rng.between(1, 3),
        edits: rng.below(24),
        isolated: rng.below(3),
    })
}

/// The mesh of a recipe.
pub fn mesh(recipe: &Recipe) -> Poly<f64> {
    let mut rng = Rng::new(recipe.seed);
    let mut it = Poly::new(Vec::new(), Vec::new());
    for _ in 0..recipe.components {
        let base = random_base(&mut rng, recipe.kind);
        join(&mut it, &base, [4.0 * rng.signed(), 4.0 * rng.signed(), 4.0 * rng.signed()]);
    }
    // Own streams: what follows does not depend on how many edits there were.
    let (mut edits, mut last) = (Rng::new(rng.bits()), Rng::new(rng.bits()));
    for _ in 0..recipe.edits {
        if it.corner_count() < MOST_CORNERS {
            edit(&mut it, &mut edits, recipe.kind);
        }
    }
    for _ in 0..recipe.isolated {
        it.positions.push([5.0, last.signed(), last.signed()]);
    }
    perturb(&mut it, 0.1, &mut last);
    let it = relabel(&it, &mut last);
    assert_manifold(it.positions.len(), &it.faces);
    it
}

// --------------------------------------------------------------------- bases

fn random_base(rng: &mut Rng, kind: Kind) -> Poly<f64> {
    let open = match kind {
        Kind::Closed => false,
        Kind::Open => true,
        Kind::Any => rng.one_in(2),
    };
    if !open {
        return closed_base(rng);
    }
    if rng.one_in(4) {
        let mut it = closed_base(rng);
        it.faces.remove(rng.below(it.faces.len()));
        return it;
    }
    open_base(rng)
}

fn closed_base(rng: &mut Rng) -> Poly<f64> {
    match rng.below(9) {
        0 => bases::tetrahedron(),
        1 => bases::cube(),
        2 => bases::octahedron(),
        3 => bases::dodecahedron(),
        4 => bases::prism(rng.between(3, 12)),
        5 => bases::pyramid(rng.between(3, 14)),
        // The poles are the vertices of high valence.
        6 => bases::bipyramid(rng.between(3, 30)),
        7 => bases::pillow(rng.between(3, 8)),
        _ => bases::torus(rng.between(3, 6), rng.between(3, 5)),
    }
}

fn open_base(rng: &mut Rng) -> Poly<f64> {
    match rng.below(8) {
        0 => bases::polygon(rng.between(3, 12)),
        1 => bases::fan(rng.between(3, 30)),
        2 => bases::half_fan(rng.between(1, 30)),
        3 => bases::grid(rng.between(1, 5), rng.between(1, 5)),
        // A strip.
        4 => bases::triangle_grid(rng.between(1, 6), rng.between(1, 2)),
        5 => bases::annulus(rng.between(3, 8), rng.between(1, 3)),
        6 => bases::frame(),
        _ => bases::valence_two(),
    }
}

/// Adds a mesh beside another.
pub fn join(it: &mut Poly<f64>, other: &Poly<f64>, offset: Point<f64>) {
    let first = it.positions.len();
    it.positions.extend(other.positions.iter().map(|p| add(p, &offset)));
    it.faces.extend(other.faces.iter().map(|f| f.iter().map(|v| v + first).collect()));
}

// --------------------------------------------------------------------- edits

fn edit(it: &mut Poly<f64>, rng: &mut Rng, kind: Kind) {
    match rng.below(if kind == Kind::Closed { 7 } else { 9 }) {
        0 => split_edge(it, rng),
        1 | 2 => keep_if_manifold(it, |it| split_face(it, rng)),
        3 | 4 => keep_if_manifold(it, |it| merge_faces(it, rng)),
        5 => poke_face(it, rng),
        6 => keep_if_manifold(it, |it| bridge(it, rng)),
        _ => keep_if_manifold(it, |it| delete_face(it, rng)),
    }
}

fn keep_if_manifold(it: &mut Poly<f64>, edit: impl FnOnce(&mut Poly<f64>)) {
    let mut edited = it.clone();
    edit(&mut edited);
    if defects(edited.positions.len(), &edited.faces).is_empty() {
        *it = edited;
    }
}

/// A face and a position in it.
fn random_corner(it: &Poly<f64>, rng: &mut Rng) -> (usize, usize) {
    let f = rng.below(it.faces.len());
    (f, rng.below(it.faces[f].len()))
}

fn side(it: &Poly<f64>, f: usize, i: usize) -> (usize, usize) {
    (it.faces[f][i], it.faces[f][(i + 1) % it.faces[f].len()])
}

/// Puts a vertex on an edge: one of valence 2 inside, a single-face one on the
/// boundary.
fn split_edge(it: &mut Poly<f64>, rng: &mut Rng) {
    let (f, i) = random_corner(it, rng);
    let (a, b) = side(it, f, i);
    let touches = |f: &Vec<usize>| f.contains(&a) && f.contains(&b);
    if it.faces.iter().any(|f| touches(f) && f.len() >= LARGEST_FACE) {
        return;
    }
    let new = it.positions.len();
    it.positions.push(mean([&it.positions[a], &it.positions[b]]));
    for cycle in &mut it.faces {
        let n = cycle.len();
        let on = |j: &usize| {
            let ends = (cycle[*j], cycle[(j + 1) % n]);
            ends == (a, b) || ends == (b, a)
        };
        if let Some(j) = (0..n).find(on) {
            cycle.insert(j + 1, new);
        }
    }
}

/// Cuts a face along a diagonal; the new edge may exist elsewhere already.
fn split_face(it: &mut Poly<f64>, rng: &mut Rng) {
    let (f, i) = random_corner(it, rng);
    let mut cycle = it.faces[f].clone();
    let n = cycle.len();
    if n > 3 {
        cycle.rotate_left(i);
        let j = rng.between(2, n - 2);
        it.faces[f] = cycle[..=j].to_vec();
        it.faces.push([&cycle[j..], &cycle[..1]].concat());
    }
}

/// Removes an interior edge; faces that share more than it come out with a
/// repeated vertex.
fn merge_faces(it: &mut Poly<f64>, rng: &mut Rng) {
    let (f, i) = random_corner(it, rng);
    let (a, b) = side(it, f, i);
    let across = |g: usize| (0..it.faces[g].len()).find(|&j| side(it, g, j) == (b, a));
    let Some((g, j)) = (0..it.faces.len()).find_map(|g| Some((g, across(g)?))) else { return };
    let (n, m) = (it.faces[f].len(), it.faces[g].len());
    if f == g || n + m - 2 > LARGEST_FACE {
        return;
    }
    // From b around f to a, then from after a around g to before b.
    let first = (0..n).map(|k| it.faces[f][(i + 1 + k) % n]);
    let second = (0..m - 2).map(|k| it.faces[g][(j + 2 + k) % m]);
    let merged = first.chain(second).collect();
    it.faces[f] = merged;
    it.faces.remove(g);
}

/// Replaces a face by triangles around a new vertex.
fn poke_face(it: &mut Poly<f64>, rng: &mut Rng) {
    let (f, _) = random_corner(it, rng);
    let cycle = it.faces.remove(f);
    let apex = it.positions.len();
    it.positions.push(mean(cycle.iter().map(|&v| &it.positions[v])));
    let n = cycle.len();
    it.faces.extend((0..n).map(|i| vec![cycle[i], cycle[(i + 1) % n], apex]));
}

/// Joins two faces of one size by a tube: a handle, or one component less.
fn bridge(it: &mut Poly<f64>, rng: &mut Rng) {
    let (f, i) = random_corner(it, rng);
    let (g, j) = random_corner(it, rng);
    let (mut one, mut other) = (it.faces[f].clone(), it.faces[g].clone());
    let n = one.len();
    if f == g || n != other.len() || it.faces.len() < 6 {
        return;
    }
    one.rotate_left(i);
    other.rotate_left(j);
    it.faces.remove(f.max(g));
    it.faces.remove(f.min(g));
    // Around the tube the second face is passed backwards.
    let back = |k: usize| other[(n - k % n) % n];
    it.faces.extend((0..n).map(|k| vec![one[k], one[(k + 1) % n], back(k + 1), back(k)]));
}

/// Opens a hole; vertices that lose their only face become isolated.
fn delete_face(it: &mut Poly<f64>, rng: &mut Rng) {
    if it.faces.len() > 1 {
        it.faces.remove(rng.below(it.faces.len()));
    }
}

// ------------------------------------------------------------------ finishing

/// Moves every coordinate by up to `amount`.
pub fn perturb(it: &mut Poly<f64>, amount: f64, rng: &mut Rng) {
    for x in it.positions.iter_mut().flatten() {
        *x += amount * rng.signed();
    }
}

/// Puts every vertex on a random integer point: short fractions, and few
/// coincidences.
pub fn scatter(it: &mut Poly<f64>, rng: &mut Rng) {
    for x in it.positions.iter_mut().flatten() {
        *x = rng.integer(10_000) as f64;
    }
}

/// The same mesh with vertices and faces renumbered and cycles rotated.
pub fn relabel(it: &Poly<f64>, rng: &mut Rng) -> Poly<f64> {
    let vertex = rng.permutation(it.positions.len());
    let mut positions = it.positions.clone();
    for (v, &to) in vertex.iter().enumerate() {
        positions[to] = it.positions[v];
    }
    let order = rng.permutation(it.faces.len());
    let mut face = |f: usize| {
        let mut cycle: Vec<_> = it.faces[f].iter().map(|&v| vertex[v]).collect();
        let first = rng.below(cycle.len());
        cycle.rotate_left(first);
        cycle
    };
    let faces = order.into_iter().map(&mut face).collect();
    let tags = it.tags.iter().map(|&v| vertex[v]).collect();
    Poly { positions, faces, anchored: it.anchored, tags }
}

/// About a third of the boundary vertices.
pub fn random_tags(it: &Poly<f64>, rng: &mut Rng) -> Vec<usize> {
    let topo = Topology::new(it.positions.len(), &it.faces);
    (0..it.positions.len()).filter(|&v| topo.is_boundary(v) && rng.one_in(3)).collect()
}
