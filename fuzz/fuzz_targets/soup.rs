//! A polygon soup, build options and a scheme from any bytes.
// Each target takes what it needs.
#![allow(dead_code)]

use carvel::mesh::{BuildOptions, NonManifold};
use carvel::{Boundary, CornerRule, ErrorKind, Fraction, Scheme};

/// Faces beyond these are dropped: a fuzzer lives from many small inputs.
const MOST_FACES: usize = 60;

/// Bytes that never end: zeros follow.
pub struct Bytes<'d>(&'d [u8]);

impl<'d> Bytes<'d> {
    pub fn new(data: &'d [u8]) -> Self {
        Self(data)
    }

    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    pub fn byte(&mut self) -> u8 {
        let Some((&first, rest)) = self.0.split_first() else { return 0 };
        self.0 = rest;
        first
    }

    /// A number below `n`, which is at least 1.
    pub fn below(&mut self, n: usize) -> usize {
        usize::from(self.byte()) % n
    }

    pub fn word(&mut self) -> u64 {
        u64::from_le_bytes(std::array::from_fn(|_| self.byte()))
    }
}

/// Faces as the kernel takes them, and how they are to be built.
#[derive(Debug)]
pub struct Soup {
    pub vertices: usize,
    pub sizes: Vec<u32>,
    pub indices: Vec<u32>,
    pub cut: bool,
    pub anchored: bool,
    pub tags: Vec<u32>,
}

impl Soup {
    pub fn new(bytes: &mut Bytes) -> Self {
        let flags = bytes.byte();
        let (mut vertices, mut faces) = shape(bytes);
        for _ in 0..bytes.below(8) {
            edit(bytes, vertices, &mut faces);
        }
        faces.truncate(MOST_FACES);
        let tags = (0..flags >> 2 & 3).map(|_| bytes.below(vertices + 1) as u32).collect();
        let mut sizes: Vec<u32> = faces.iter().map(|face| face.len() as u32).collect();
        if flags & 16 != 0 {
            // What no caller should pass. Counts just below the limit are left
            // out: they ask for tens of gigabytes.
            match bytes.below(8) {
                0 => vertices = usize::MAX,
                1 => vertices = u32::MAX as usize,
                2 => vertices = 0,
                3 => vertices = 5000,
                4 => sizes.push(u32::MAX),
                5 => sizes.extend([u32::MAX; 3]),
                6 => drop(sizes.pop()),
                _ => sizes.push(0),
            }
        }
        Self {
            vertices,
            sizes,
            indices: faces.concat(),
            cut: flags & 1 != 0,
            anchored: flags & 2 != 0,
            tags,
        }
    }

    pub fn options(&self) -> BuildOptions<'_> {
        let non_manifold = if self.cut { NonManifold::Cut } else { NonManifold::Error };
        BuildOptions {
            non_manifold,
            anchored: self.anchored,
            corner_tags: &self.tags,
            ..BuildOptions::default()
        }
    }
}

type Faces = Vec<Vec<u32>>;

/// Something to start from, mostly manifold.
fn shape(bytes: &mut Bytes) -> (usize, Faces) {
    match bytes.below(7) {
        0 => raw(bytes),
        1 => grid(1 + bytes.below(7), 1 + bytes.below(7), bytes.below(4)),
        2 => prism(3 + bytes.below(7)),
        3 => fan(2 + bytes.below(9), bytes.below(2) == 0),
        // One large face.
        4 => {
            let n = 3 + 5 * bytes.below(60) as u32;
            (n as usize, vec![(0..n).collect()])
        }
        // A large face with a neighbour at each edge.
        5 => ring(3 + bytes.below(50) as u32),
        // Two faces back to back: the smallest closed surface.
        _ => {
            let n = 3 + bytes.below(5) as u32;
            (n as usize, vec![(0..n).collect(), (0..n).rev().collect()])
        }
    }
}

fn raw(bytes: &mut Bytes) -> (usize, Faces) {
    let vertices = 1 + bytes.below(24);
    let faces = 1 + bytes.below(MOST_FACES);
    let mut face = || {
        let size = [3, 4, 3, 4, 5, 6, 2, 0][bytes.below(8)];
        (0..size).map(|_| bytes.below(vertices + 1) as u32).collect()
    };
    let faces: Faces = (0..faces).map(|_| face()).collect();
    (vertices, faces)
}

/// Quads, open or closed up in one direction or in both.
fn grid(across: usize, up: usize, wrap: usize) -> (usize, Faces) {
    let columns = if wrap & 1 == 0 { across + 1 } else { across };
    let rows = if wrap & 2 == 0 { up + 1 } else { up };
    let at = |x: usize, y: usize| (x % columns + y % rows * columns) as u32;
    let quad = |x, y| vec![at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)];
    let faces = (0..up).flat_map(|y| (0..across).map(move |x| (x, y)));
    (columns * rows, faces.map(|(x, y)| quad(x, y)).collect())
}

fn prism(n: usize) -> (usize, Faces) {
    let (vertices, mut faces) = grid(n, 1, 1);
    let n = n as u32;
    faces.push((0..n).rev().collect());
    faces.push((n..2 * n).collect());
    (vertices, faces)
}

/// Triangles around vertex 0.
fn fan(n: usize, open: bool) -> (usize, Faces) {
    let n = n as u32;
    let last = if open { n } else { n + 1 };
    let face = |i: u32| vec![0, i, i % n + 1];
    (n as usize + 1, (1..last).map(face).collect())
}

fn ring(n: u32) -> (usize, Faces) {
    let quad = |i: u32| vec![(i + 1) % n, i, n + i, n + (i + 1) % n];
    let faces = std::iter::once((0..n).collect()).chain((0..n).map(quad));
    (2 * n as usize, faces.collect())
}

/// Changes a face or two.
fn edit(bytes: &mut Bytes, vertices: usize, faces: &mut Faces) {
    if faces.is_empty() {
        return;
    }
    let kind = bytes.below(8);
    let at = bytes.below(faces.len());
    match kind {
        0 => drop(faces.remove(at)),
        1 => faces[at].reverse(),
        2 => {
            // Triangles instead of a polygon.
            let face = faces.remove(at);
            if let [first, rest @ ..] = &face[..] {
                faces.extend(rest.windows(2).map(|pair| vec![*first, pair[0], pair[1]]));
            }
        }
        3 => {
            let face = faces[at].clone();
            faces.push(face);
        }
        4 => {
            let vertex = bytes.below(vertices + 1) as u32;
            let place = bytes.below(faces[at].len() + 1);
            faces[at].insert(place, vertex);
        }
        5 => {
            let vertex = bytes.below(vertices + 1) as u32;
            let place = bytes.below(faces[at].len().max(1));
            if let Some(slot) = faces[at].get_mut(place) {
                *slot = vertex;
            }
        }
        6 => {
            let other = bytes.below(faces.len());
            faces.swap(at, other);
        }
        _ => {
            let turn = bytes.below(faces[at].len().max(1));
            faces[at].rotate_left(turn);
        }
    }
}

/// A scheme of the dual family; passes out of range are refused with the right kind.
pub fn scheme(bytes: &mut Bytes) -> Scheme {
    let flags = bytes.byte();
    let scheme = match flags & 7 {
        0 => Scheme::doo_sabin(),
        1 => Scheme::three_point(Fraction::new(1, 32).expect("a fraction")).expect("in range"),
        2 => Scheme::quartic(),
        3 => Scheme::b_spline(2 * (u32::from(bytes.byte()) % 5 + 1)).expect("in range"),
        _ => passes(bytes),
    };
    let rule = if flags & 8 == 0 { CornerRule::Cosine } else { CornerRule::Average };
    let boundary =
        [Boundary::EdgeAndCorner, Boundary::Edge, Boundary::None][usize::from(flags >> 4) % 3];
    scheme.with_rule(rule).with_boundary(boundary)
}

fn passes(bytes: &mut Bytes) -> Scheme {
    let count = bytes.below(5);
    let mut pass = || {
        let num = i16::from_le_bytes([bytes.byte(), bytes.byte()]);
        Fraction::new(i64::from(num), i64::from(bytes.byte()) + 1).expect("a fraction")
    };
    let list: Vec<Fraction> = (0..count).map(|_| pass()).collect();
    Scheme::dual(&list).unwrap_or_else(|error| {
        assert_eq!(error.kind(), ErrorKind::ParameterOutOfRange);
        Scheme::doo_sabin()
    })
}
