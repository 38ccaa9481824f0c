//! Small control meshes with tags, and the rows of their vertices by name.

use std::collections::{BTreeMap, HashMap};

use carvel::mesh::{BuildOptions, Defects, NonManifold, build};
use carvel::refine::VertexOrigin;
use carvel::{Context, Crease, Hierarchy, Mesh, Scheme, SharpVertex};
use num_rational::BigRational;
use num_traits::Zero;

use crate::support::exact::{Exact, stages};
use crate::support::number::ratio;

/// A row: the weights of the parents that have one.
pub type Row = BTreeMap<u32, BigRational>;

#[derive(Clone, Debug, Default)]
pub struct Control {
    pub vertices: usize,
    pub faces: Vec<Vec<u32>>,
    pub creases: Vec<Crease>,
    pub sharp: Vec<SharpVertex>,
    pub holes: Vec<u32>,
    pub corners: Vec<u32>,
}

impl Control {
    pub fn new<F: AsRef<[u32]>>(faces: &[F]) -> Self {
        let faces: Vec<Vec<u32>> = faces.iter().map(|face| face.as_ref().to_vec()).collect();
        let vertices = faces.iter().flatten().max().map_or(0, |&last| last as usize + 1);
        Self { vertices, faces, ..Self::default() }
    }

    /// `height` by `width` quads; vertex (i, j) is i·(width + 1) + j.
    pub fn grid(height: u32, width: u32) -> Self {
        let at = |i, j| i * (width + 1) + j;
        let quad = |i, j| vec![at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)];
        let cells = (0..height).flat_map(|i| (0..width).map(move |j| (i, j)));
        Self::new(&cells.map(|(i, j)| quad(i, j)).collect::<Vec<_>>())
    }

    /// The same closed both ways; vertex (i, j) is i·width + j.
    pub fn torus(height: u32, width: u32) -> Self {
        let at = |i, j| (i % height) * width + j % width;
        let quad = |i, j| vec![at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)];
        let cells = (0..height).flat_map(|i| (0..width).map(move |j| (i, j)));
        Self::new(&cells.map(|(i, j)| quad(i, j)).collect::<Vec<_>>())
    }

    /// Every quad cut from its first to its third vertex.
    pub fn cut(&self) -> Self {
        let halves = |q: &Vec<u32>| [vec![q[0], q[1], q[2]], vec![q[0], q[2], q[3]]];
        let faces: Vec<Vec<u32>> = self.faces.iter().flat_map(halves).collect();
        Self { faces, ..self.clone() }
    }

    /// Two tips, 0 and 1, of valence n, on a ring 2, 3, …
    pub fn bipyramid(n: u32) -> Self {
        let ring = |i: u32| 2 + i % n;
        let sides = |i| [[0, ring(i), ring(i + 1)], [1, ring(i + 1), ring(i)]];
        Self::new(&(0..n).flat_map(sides).collect::<Vec<_>>())
    }

    pub fn crease(mut self, vertices: [u32; 2], sharpness: f32) -> Self {
        self.creases.push(Crease { vertices, sharpness });
        self
    }

    pub fn sharp(mut self, vertex: u32, sharpness: f32) -> Self {
        self.sharp.push(SharpVertex { vertex, sharpness });
        self
    }

    pub fn holes(mut self, holes: &[u32]) -> Self {
        self.holes = holes.to_vec();
        self
    }

    pub fn indices(&self) -> Vec<u32> {
        self.faces.concat()
    }

    pub fn try_mesh(&self, non_manifold: NonManifold) -> Result<Mesh, Defects> {
        let sizes: Vec<u32> = self.faces.iter().map(|face| face.len() as u32).collect();
        let options = BuildOptions {
            non_manifold,
            creases: &self.creases,
            sharp_vertices: &self.sharp,
            holes: &self.holes,
            corner_tags: &self.corners,
            ..BuildOptions::default()
        };
        let context = Context::serial();
        build(&context, self.vertices, &sizes, &self.indices(), &options).map(|built| built.mesh)
    }

    pub fn mesh(&self) -> Mesh {
        self.try_mesh(NonManifold::Sharpen).expect("a mesh")
    }

    pub fn hierarchy(&self, scheme: &Scheme, levels: u32) -> Hierarchy {
        let made = Hierarchy::new(&Context::serial(), self.mesh(), scheme.clone(), levels);
        made.expect("a small hierarchy")
    }

    pub fn rows(&self, scheme: &Scheme) -> Rows {
        Rows::of(&self.hierarchy(scheme, 1), 1)
    }
}

/// The rows of one level, passes included, each found by the vertices of its parent.
pub struct Rows {
    rows: HashMap<Vec<u32>, (u32, Row)>,
}

impl Rows {
    pub fn of(hierarchy: &Hierarchy, level: u32) -> Self {
        let stages = stages::<Exact>(hierarchy, level);
        let parent = hierarchy.mesh(level - 1);
        let origins = hierarchy.vertex_origins(level).expect("a level that was built");
        let place = |(child, origin): (usize, VertexOrigin)| {
            let row = composed(&stages, child as u32);
            (key(parent, origin), (child as u32, row))
        };
        Self { rows: origins.into_iter().enumerate().map(place).collect() }
    }

    /// The row of the vertex that comes from a vertex, an edge or a face.
    #[track_caller]
    pub fn at(&self, parent: &[u32]) -> &Row {
        &self.entry(parent).1
    }

    /// The number of that vertex.
    #[track_caller]
    pub fn child(&self, parent: &[u32]) -> u32 {
        self.entry(parent).0
    }

    #[track_caller]
    fn entry(&self, parent: &[u32]) -> &(u32, Row) {
        let mut key = parent.to_vec();
        key.sort_unstable();
        self.rows.get(&key).unwrap_or_else(|| panic!("no child of {parent:?}"))
    }
}

fn key(parent: &Mesh, origin: VertexOrigin) -> Vec<u32> {
    let verts = parent.corner_vertices();
    let face_of = |c: u32| {
        let contains = |&f: &usize| parent.face_corners(f).contains(&(c as usize));
        (0..parent.faces()).find(contains).expect("a corner of a face")
    };
    let mut key = match origin {
        VertexOrigin::Vertex(v) => vec![v],
        VertexOrigin::Face(f) => parent.face_vertices(f as usize).to_vec(),
        VertexOrigin::Edge(c) => {
            let face = parent.face_corners(face_of(c));
            let next = if c as usize + 1 == face.end { face.start } else { c as usize + 1 };
            vec![verts[c as usize], verts[next]]
        }
        other => panic!("{other:?} of a primal split"),
    };
    key.sort_unstable();
    key
}

/// The row of a child on the parents, stages multiplied.
fn composed(stages: &[Vec<Vec<(u32, Exact)>>], child: u32) -> Row {
    let mut row = Row::from([(child, ratio(1, 1))]);
    for stage in stages.iter().rev() {
        let mut before = Row::new();
        for (v, w) in row {
            for (u, x) in &stage[v as usize] {
                *before.entry(*u).or_insert_with(BigRational::zero) += &w * &x.0;
            }
        }
        row = before;
    }
    row.retain(|_, w| !w.is_zero());
    row
}

/// A row from vertices and numerators over one denominator.
pub fn row(den: i64, entries: &[(u32, i64)]) -> Row {
    sum(entries.iter().map(|&(v, num)| (ratio(num, den), Row::from([(v, ratio(1, 1))]))))
}

/// A row that is the mean of some vertices.
pub fn mean(vertices: &[u32]) -> Row {
    row(vertices.len() as i64, &vertices.iter().map(|&v| (v, 1)).collect::<Vec<_>>())
}

/// Rows times factors.
pub fn sum(parts: impl IntoIterator<Item = (BigRational, Row)>) -> Row {
    let mut total = Row::new();
    for (factor, row) in parts {
        for (v, w) in row {
            *total.entry(v).or_insert_with(BigRational::zero) += &factor * w;
        }
    }
    total.retain(|_, w| !w.is_zero());
    total
}

/// `num / den` of one row and the rest of another.
pub fn blend((num, den): (i64, i64), one: Row, other: Row) -> Row {
    sum([(ratio(num, den), one), (ratio(den - num, den), other)])
}
