//! Named base meshes, from which the random ones grow.
//!
//! All are orientable manifolds, counter-clockwise seen from outside. They lie
//! roughly where their names say: shape matters to no test.

use std::f64::consts::TAU;

use super::number::Point;
use super::poly::Poly;

type Faces = Vec<Vec<usize>>;

fn ring(n: usize, radius: f64, z: f64, turn: f64) -> Vec<Point<f64>> {
    let angle = |i: usize| TAU * (i as f64 + turn) / n as f64;
    (0..n).map(|i| [radius * angle(i).cos(), radius * angle(i).sin(), z]).collect()
}

fn poly(positions: Vec<Point<f64>>, faces: &[&[usize]]) -> Poly<f64> {
    Poly::new(positions, faces.iter().map(|f| f.to_vec()).collect())
}

/// Triangles from each side of the ring `first..first + n` to `apex`.
fn cone(first: usize, n: usize, apex: usize) -> impl Iterator<Item = Vec<usize>> {
    (0..n).map(move |i| vec![first + i, first + (i + 1) % n, apex])
}

pub fn tetrahedron() -> Poly<f64> {
    pyramid(3)
}

pub fn cube() -> Poly<f64> {
    prism(4)
}

pub fn octahedron() -> Poly<f64> {
    bipyramid(4)
}

pub fn dodecahedron() -> Poly<f64> {
    let rings = [ring(5, 1.0, 1.4, 0.0), ring(5, 1.6, 0.4, 0.0)];
    let below = [ring(5, 1.6, -0.4, 0.5), ring(5, 1.0, -1.4, 0.5)];
    let at = |r: usize, i: usize| 5 * r + i % 5;
    let mut faces: Faces = vec![(0..5).collect(), (15..20).rev().collect()];
    for i in 0..5 {
        faces.push(vec![at(0, i + 1), at(0, i), at(1, i), at(2, i), at(1, i + 1)]);
        faces.push(vec![at(1, i + 1), at(2, i), at(3, i), at(3, i + 1), at(2, i + 1)]);
    }
    Poly::new([rings, below].concat().concat(), faces)
}

/// Two n-gons and n quads.
pub fn prism(n: usize) -> Poly<f64> {
    let mut faces: Faces = vec![(0..n).rev().collect(), (n..2 * n).collect()];
    faces.extend((0..n).map(|i| vec![i, (i + 1) % n, n + (i + 1) % n, n + i]));
    Poly::new([ring(n, 1.0, -1.0, 0.0), ring(n, 1.0, 1.0, 0.0)].concat(), faces)
}

/// An n-gon and n triangles.
pub fn pyramid(n: usize) -> Poly<f64> {
    let mut it = fan(n);
    it.faces.push((0..n).rev().collect());
    it
}

/// n triangles around a vertex, open.
pub fn fan(n: usize) -> Poly<f64> {
    let mut positions = ring(n, 1.0, 0.0, 0.0);
    positions.push([0.0, 0.0, 1.0]);
    Poly::new(positions, cone(0, n, n).collect())
}

/// 2n triangles.
pub fn bipyramid(n: usize) -> Poly<f64> {
    let mut it = fan(n);
    it.positions.push([0.0, 0.0, -1.0]);
    it.faces.extend((0..n).map(|i| vec![(i + 1) % n, i, n + 1]));
    it
}

/// Two n-gons glued along all their edges: every vertex has valence 2.
pub fn pillow(n: usize) -> Poly<f64> {
    Poly::new(ring(n, 1.0, 0.0, 0.0), vec![(0..n).collect(), (0..n).rev().collect()])
}

/// One face.
pub fn polygon(n: usize) -> Poly<f64> {
    Poly::new(ring(n, 1.0, 0.0, 0.0), vec![(0..n).collect()])
}

/// n triangles around a boundary vertex.
pub fn half_fan(n: usize) -> Poly<f64> {
    let mut positions = ring(2 * n + 2, 1.0, 0.0, 0.0);
    positions.truncate(n + 1);
    positions.push([0.0; 3]);
    Poly::new(positions, (0..n).map(|i| vec![i, i + 1, n + 1]).collect())
}

/// `width` by `height` quads, open.
pub fn grid(width: usize, height: usize) -> Poly<f64> {
    let at = |i: usize, j: usize| i * (height + 1) + j;
    let mut it = Poly::new(Vec::new(), Vec::new());
    for i in 0..=width {
        it.positions.extend((0..=height).map(|j| [i as f64, j as f64, 0.3 * (i * j % 3) as f64]));
    }
    for (i, j) in (0..width).flat_map(|i| (0..height).map(move |j| (i, j))) {
        it.faces.push(vec![at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]);
    }
    it
}

/// A grid with each quad cut into two triangles.
pub fn triangle_grid(width: usize, height: usize) -> Poly<f64> {
    let mut it = grid(width, height);
    let cut = |f: &Vec<usize>| [vec![f[0], f[1], f[2]], vec![f[0], f[2], f[3]]];
    it.faces = it.faces.iter().flat_map(cut).collect();
    it
}

/// `around` quads in each of `rows` rings, open at both ends.
pub fn annulus(around: usize, rows: usize) -> Poly<f64> {
    let at = |r: usize, i: usize| r * around + i % around;
    let radius = |r: usize| 1.0 + r as f64;
    let positions = (0..=rows).flat_map(|r| ring(around, radius(r), 0.2 * r as f64, 0.0));
    let quad = |r: usize, i: usize| vec![at(r, i), at(r + 1, i), at(r + 1, i + 1), at(r, i + 1)];
    let faces = (0..rows).flat_map(|r| (0..around).map(move |i| quad(r, i)));
    Poly::new(positions.collect(), faces.collect())
}

/// `around` by `across` quads, closed both ways; three of each at least.
pub fn torus(around: usize, across: usize) -> Poly<f64> {
    let at = |i: usize, j: usize| (i % around) * across + j % across;
    let mut it = Poly::new(Vec::new(), Vec::new());
    for (i, j) in (0..around).flat_map(|i| (0..across).map(move |j| (i, j))) {
        let (u, v) = (TAU * i as f64 / around as f64, TAU * j as f64 / across as f64);
        let r = 3.0 + v.cos();
        it.positions.push([r * u.cos(), r * u.sin(), v.sin()]);
        it.faces.push(vec![at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]);
    }
    it
}

/// A square with a square hole that touches nothing: two loops, corners of
/// three and of two faces.
pub fn frame() -> Poly<f64> {
    let mut it = grid(3, 3);
    it.faces.remove(4);
    it
}

/// Two pentagons that share a path of three edges.
pub fn valence_two() -> Poly<f64> {
    let positions = vec![
        [0.0, 0.0, 0.0],
        [1.0, 0.2, 0.3],
        [2.0, 0.0, -0.2],
        [2.2, -1.3, 0.0],
        [-0.2, -1.1, 0.1],
        [-0.1, 1.2, 0.2],
        [2.1, 1.4, 0.4],
    ];
    poly(positions, &[&[2, 1, 0, 4, 3], &[0, 1, 2, 6, 5]])
}

/// Copies of a polyhedron side by side.
pub fn several(one: &Poly<f64>, copies: usize) -> Poly<f64> {
    let mut all = Poly::new(Vec::new(), Vec::new());
    for copy in 0..copies {
        let first = all.positions.len();
        let moved = one.positions.iter().map(|p| [p[0] + 3.0 * copy as f64, p[1], p[2]]);
        all.positions.extend(moved);
        let shifted = |face: &Vec<usize>| face.iter().map(|v| first + v).collect();
        all.faces.extend(one.faces.iter().map(shifted));
    }
    all
}
