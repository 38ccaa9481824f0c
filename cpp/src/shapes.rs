//! Control meshes made by code: small ones for the tests, large ones for the times.
//!
//! Counter-clockwise seen from outside. They lie roughly where their names say, bent a
//! little where a symmetric shape would hide a wrong weight.

use crate::Control;
use std::f64::consts::TAU;

type Faces = Vec<Vec<u32>>;

fn ring(n: u32, radius: f64, z: f64) -> Vec<[f64; 3]> {
    let angle = |i: u32| TAU * i as f64 / n as f64;
    // The last term keeps rings from being mirror images of themselves.
    let bend = |i: u32| 1.0 + 0.1 * (i as f64 * 1.7).sin();
    (0..n)
        .map(|i| [radius * bend(i) * angle(i).cos(), radius * bend(i) * angle(i).sin(), z])
        .collect()
}

fn cone(n: u32, apex: u32) -> Faces {
    (0..n).map(|i| vec![i, (i + 1) % n, apex]).collect()
}

/// Four triangles.
pub fn tetrahedron() -> Control {
    let at = [[1.0, 1.0, 1.0], [-1.0, -1.0, 1.0], [-1.0, 1.0, -1.0], [1.0, -1.0, -1.0]];
    Control::new(&at, [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
}

/// Six quads from -1 to 1.
pub fn cube() -> Control {
    let at: Vec<_> = (0..8u32)
        .map(|i| [i & 1, i >> 1 & 1, i >> 2].map(|bit| 2.0 * f64::from(bit) - 1.0))
        .collect();
    let faces =
        [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    Control::new(&at, faces)
}

/// Twenty triangles.
pub fn icosahedron() -> Control {
    let turn = |i: u32, half: f64, z: f64| {
        let angle = TAU * (i as f64 + half) / 5.0;
        [2.0 * angle.cos(), 2.0 * angle.sin(), z]
    };
    let mut at: Vec<_> = (0..5).map(|i| turn(i, 0.0, 1.0)).collect();
    at.extend((0..5).map(|i| turn(i, 0.5, -1.0)));
    at.extend([[0.0, 0.0, 2.2], [0.0, 0.0, -2.3]]);
    let next = |i: u32| (i + 1) % 5;
    let mut faces: Faces = Vec::new();
    for i in 0..5 {
        faces.push(vec![i, next(i), 10]);
        faces.push(vec![i, 5 + i, next(i)]);
        faces.push(vec![next(i), 5 + i, 5 + next(i)]);
        faces.push(vec![5 + next(i), 5 + i, 11]);
    }
    Control::new(&at, faces)
}

/// Two n-gons and n quads.
pub fn prism(n: u32) -> Control {
    let mut faces: Faces = vec![(0..n).rev().collect(), (n..2 * n).collect()];
    faces.extend((0..n).map(|i| vec![i, (i + 1) % n, n + (i + 1) % n, n + i]));
    Control::new(&[ring(n, 1.0, -1.0), ring(n, 1.3, 1.0)].concat(), faces)
}

/// An n-gon and n triangles that meet in a point.
pub fn pyramid(n: u32) -> Control {
    let mut faces = cone(n, n);
    faces.push((0..n).rev().collect());
    Control::new(&[ring(n, 1.0, 0.0), vec![[0.1, 0.0, 1.0]]].concat(), faces)
}

/// Two points of n triangles each.
pub fn bipyramid(n: u32) -> Control {
    let mut faces = cone(n, n);
    faces.extend((0..n).map(|i| vec![(i + 1) % n, i, n + 1]));
    let ends = vec![[0.1, 0.0, 1.0], [0.0, 0.1, -0.8]];
    Control::new(&[ring(n, 1.0, 0.0), ends].concat(), faces)
}

/// n triangles around a vertex, open.
pub fn fan(n: u32) -> Control {
    Control::new(&[ring(n, 1.0, 0.0), vec![[0.1, 0.0, 1.0]]].concat(), cone(n, n))
}

/// n triangles around a vertex of the boundary: valence 1 for n = 1.
pub fn half_fan(n: u32) -> Control {
    let mut at = ring(2 * n + 2, 1.0, 0.0);
    at.truncate(n as usize + 1);
    at.push([0.0, 0.0, 0.3]);
    Control::new(&at, (0..n).map(|i| [i, i + 1, n + 1]))
}

/// One face.
pub fn polygon(n: u32) -> Control {
    Control::new(&ring(n, 1.0, 0.0), [(0..n).collect::<Vec<_>>()])
}

/// Two pentagons that share a path of three edges: valence 2 inside.
pub fn valence_two() -> Control {
    let at = [
        [0.0, 0.0, 0.0],
        [1.0, 0.2, 0.3],
        [2.0, 0.0, -0.2],
        [2.2, -1.3, 0.0],
        [-0.2, -1.1, 0.1],
        [-0.1, 1.2, 0.2],
        [2.1, 1.4, 0.4],
    ];
    Control::new(&at, [[2, 1, 0, 4, 3], [0, 1, 2, 6, 5]])
}

/// `width` by `height` quads, open. Vertex (i, j) is number i (height + 1) + j.
pub fn grid(width: u32, height: u32) -> Control {
    let at = |i: u32, j: u32| i * (height + 1) + j;
    let point = |i: u32, j: u32| [i as f64, j as f64, 0.3 * (i * j % 3) as f64];
    let all: Vec<_> = (0..=width).flat_map(|i| (0..=height).map(move |j| point(i, j))).collect();
    let quad = |i, j| [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
    Control::new(&all, (0..width).flat_map(|i| (0..height).map(move |j| quad(i, j))))
}

/// A square of grid quads with a square hole: corners of three faces and of one.
pub fn frame() -> Control {
    without_face(&grid(3, 3), 4)
}

/// The mesh less one face.
fn without_face(control: &Control, face: usize) -> Control {
    let kept = control.faces().enumerate().filter(|(f, _)| *f != face).map(|(_, it)| it.to_vec());
    let mut it = Control::new(&[], kept);
    it.positions.clone_from(&control.positions);
    it
}

/// The same with every face cut into triangles from its first corner.
#[must_use]
pub fn triangulated(control: &Control) -> Control {
    let cut = |face: &[u32]| -> Faces {
        face[1..].windows(2).map(|pair| vec![face[0], pair[0], pair[1]]).collect()
    };
    let mut it = Control::new(&[], control.faces().flat_map(cut));
    it.positions.clone_from(&control.positions);
    it
}

/// `around` by `across` quads, closed both ways; three of each at least.
pub fn torus(around: u32, across: u32) -> Control {
    let at = |i: u32, j: u32| (i % around) * across + j % across;
    let point = |i: u32, j: u32| {
        let (u, v) = (TAU * i as f64 / around as f64, TAU * j as f64 / across as f64);
        let r = 3.0 + (1.0 + 0.2 * (3.0 * u).sin()) * v.cos();
        [r * u.cos(), r * u.sin(), v.sin()]
    };
    let all: Vec<_> = (0..around).flat_map(|i| (0..across).map(move |j| point(i, j))).collect();
    let quad = |i, j| [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
    Control::new(&all, (0..around).flat_map(|i| (0..across).map(move |j| quad(i, j))))
}

/// The same with vertices and faces numbered at random, always the same way.
#[must_use]
pub fn shuffled(control: &Control) -> Control {
    let mut state = 1;
    let names = permutation(control.vertices(), &mut state);
    let faces: Vec<_> = control.faces().collect();
    let order = permutation(faces.len(), &mut state);
    let renamed = |&f: &u32| faces[f as usize].iter().map(|&v| names[v as usize]).collect();
    let mut it = Control::new(&[], order.iter().map(renamed).collect::<Faces>());
    it.positions = vec![0.0; control.positions.len()];
    for (&name, at) in names.iter().zip(control.positions.chunks(3)) {
        it.positions[3 * name as usize..][..3].copy_from_slice(at);
    }
    it
}

/// The numbers below n in a random order; Knuth's generator of 64 bits.
fn permutation(n: usize, state: &mut u64) -> Vec<u32> {
    let mut list: Vec<u32> = (0..n as u32).collect();
    for i in (1..n).rev() {
        *state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        list.swap(i, (*state >> 33) as usize % (i + 1));
    }
    list
}

/// Several meshes side by side as one.
pub fn components(parts: &[Control]) -> Control {
    let mut all = Control::default();
    for (i, part) in parts.iter().enumerate() {
        let first = all.vertices() as u32;
        all.sizes.extend_from_slice(&part.sizes);
        all.indices.extend(part.indices.iter().map(|v| v + first));
        let moved = part.positions.chunks(3).flat_map(|p| [p[0] + 8.0 * i as f64, p[1], p[2]]);
        all.positions.extend(moved);
    }
    all
}

/// `pages` quads that share one edge: not a manifold from three on.
pub fn book(pages: u32) -> Control {
    let mut at = vec![[0.0, 0.0, 0.0], [0.0, 0.0, 1.0]];
    for i in 0..pages {
        let angle = TAU * i as f64 / pages as f64;
        at.extend([0.0, 1.0].map(|z| [angle.cos(), angle.sin(), z]));
    }
    Control::new(&at, (0..pages).map(|i| [0, 2 + 2 * i, 3 + 2 * i, 1]))
}

/// Two cubes that share the vertex 7 and nothing else.
pub fn touching_cubes() -> Control {
    let (first, second) = (cube(), cube());
    let mut all = first.clone();
    let shifted = |v: &u32| if *v == 0 { 7 } else { v + 7 };
    all.sizes.extend_from_slice(&second.sizes);
    all.indices.extend(second.indices.iter().map(shifted));
    all.positions.extend(second.positions[3..].iter().map(|x| x + 2.0));
    all
}
