//! The paths that are counted: one thread, single precision, memory that is used again.

use carvel::sparse::{Records, RecordsMut};
use carvel::{
    Context, Fraction, Hierarchy, Mesh, Output, Prediction, Refiner, Scheme, StencilTask, Task,
};

/// Something done `calls` times; returns what a call makes, in its unit.
pub type Path = fn(calls: u32) -> u64;

/// All paths by name; the unit is a face or a row of the result.
pub const PATHS: [(&str, Path); 15] = [
    ("catmull-clark, 3 levels at once, face", |n| refined(&Scheme::catmull_clark(), 3, n)),
    ("catmull-clark, 1 level, face", |n| refined(&Scheme::catmull_clark(), 1, n)),
    ("loop, 3 levels at once, face", |n| triangles(3, n)),
    ("loop, 1 level, face", |n| triangles(1, n)),
    ("doo-sabin, 1 level and 2 at once, face", |n| refined(&Scheme::doo_sabin(), 3, n)),
    ("doo-sabin, 1 level and 3 at once, face", |n| refined(&Scheme::doo_sabin(), 4, n)),
    ("doo-sabin, 1 level, face", |n| refined(&Scheme::doo_sabin(), 1, n)),
    ("three-point, 1 level and 2 at once, face", |n| refined(&three_point(), 3, n)),
    ("three-point, 1 level and 3 at once, face", |n| refined(&three_point(), 4, n)),
    ("three-point, 1 level, face", |n| refined(&three_point(), 1, n)),
    ("mesh from a soup of quads, face", built),
    ("catmull-clark, stencils of level 2, row", stencils),
    ("catmull-clark, stencils of the cow at level 4, row", cow_stencils),
    ("loop, stencils of level 2, row", loop_stencils),
    ("catmull-clark, applying them to xyz, row", applied),
];

/// A torus of quads: positions and the faces' vertices.
struct Torus {
    positions: Vec<f32>,
    quads: Vec<u32>,
}

impl Torus {
    fn new(around: u32, across: u32) -> Self {
        let turn = |i: u32, n: u32| i as f32 / n as f32 * std::f32::consts::TAU;
        let (mut positions, mut quads) = (Vec::new(), Vec::new());
        for (i, j) in (0..around).flat_map(|i| (0..across).map(move |j| (i, j))) {
            let ((a, b), (c, d)) = (turn(i, around).sin_cos(), turn(j, across).sin_cos());
            positions.extend([(3.0 + d) * b, (3.0 + d) * a, c]);
            let at = |i: u32, j: u32| i % around * across + j % across;
            quads.extend([at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]);
        }
        Self { positions, quads }
    }

    fn vertices(&self) -> usize {
        self.positions.len() / 3
    }

    fn mesh(&self) -> Mesh {
        let sizes = vec![4; self.quads.len() / 4];
        Mesh::from_polygons(self.vertices(), &sizes, &self.quads).expect("a torus")
    }

    fn triangles(&self) -> Mesh {
        let halves = |q: &[u32; 4]| [q[0], q[1], q[2], q[0], q[2], q[3]];
        let indices: Vec<u32> = self.quads.as_chunks().0.iter().flat_map(halves).collect();
        let sizes = vec![3; indices.len() / 3];
        Mesh::from_polygons(self.vertices(), &sizes, &indices).expect("a torus")
    }
}

fn three_point() -> Scheme {
    let w = Fraction::new(1, 32).expect("a fraction");
    Scheme::three_point(w).expect("a weight in range")
}

fn refined(scheme: &Scheme, levels: u32, calls: u32) -> u64 {
    let torus = Torus::new(64, 32);
    refine(&torus.mesh(), &torus.positions, scheme, levels, calls)
}

fn triangles(levels: u32, calls: u32) -> u64 {
    let torus = Torus::new(64, 32);
    refine(&torus.triangles(), &torus.positions, &Scheme::loop_triangles(), levels, calls)
}

fn refine(mesh: &Mesh, positions: &[f32], scheme: &Scheme, levels: u32, calls: u32) -> u64 {
    let plan = Prediction::new(mesh, scheme, levels).expect("small");
    let last = *plan.last();
    let mut faces = vec![0; last.corners as usize];
    let mut out = vec![0.0; 3 * last.vertices as usize];
    let task = Task::new(mesh, scheme, levels, positions);
    let mut refiner = Refiner::new();
    for _ in 0..calls {
        let output = Output { face_vertices: Some(&mut faces), ..Output::new(&mut out) };
        refiner.refine_into(&Context::serial(), &task, output).expect("a refinement");
    }
    last.faces
}

fn built(calls: u32) -> u64 {
    let torus = Torus::new(128, 64);
    for _ in 0..calls {
        std::hint::black_box(torus.mesh());
    }
    torus.quads.len() as u64 / 4
}

/// Makes tables.
fn tables(mesh: Mesh, scheme: Scheme, level: u32, calls: u32) -> u64 {
    let serial = Context::serial();
    let hierarchy = Hierarchy::new(&serial, mesh, scheme, level - 1).expect("a hierarchy");
    let make = || hierarchy.stencils::<f32>(&serial, &StencilTask::level(level)).expect("a table");
    (1..calls).for_each(|_| drop(std::hint::black_box(make())));
    make().rows() as u64
}

fn stencils(calls: u32) -> u64 {
    tables(Torus::new(64, 32).mesh(), Scheme::catmull_clark(), 2, calls)
}

fn cow_stencils(calls: u32) -> u64 {
    tables(cow(), Scheme::catmull_clark(), 4, calls)
}

fn loop_stencils(calls: u32) -> u64 {
    tables(Torus::new(64, 32).triangles(), Scheme::loop_triangles(), 2, calls)
}

/// A mesh of faces of three to five sides, hardly two alike with what is around them.
fn cow() -> Mesh {
    let file = include_str!("../../../assets/spot/spot_control_mesh.obj");
    let (mut vertices, mut sizes, mut indices) = (0, Vec::new(), Vec::new());
    for line in file.lines() {
        vertices += usize::from(line.starts_with("v "));
        let corners = line.strip_prefix("f ").into_iter().flat_map(str::split_whitespace);
        let number = |corner: &str| corner.split('/').next()?.parse::<u32>().ok();
        let face: Vec<u32> = corners.map(|c| number(c).expect("a vertex") - 1).collect();
        if !face.is_empty() {
            sizes.push(face.len() as u32);
            indices.extend(face);
        }
    }
    Mesh::from_polygons(vertices, &sizes, &indices).expect("the cow")
}

/// Applies a table.
fn applied(calls: u32) -> u64 {
    let (torus, serial) = (Torus::new(64, 32), Context::serial());
    let hierarchy = Hierarchy::new(&serial, torus.mesh(), Scheme::catmull_clark(), 1);
    let hierarchy = hierarchy.expect("a hierarchy");
    let table = hierarchy.stencils::<f32>(&serial, &StencilTask::level(2)).expect("a table");
    let mut out = vec![0.0; 3 * table.rows()];
    let from = Records::packed(&torus.positions, 3);
    for _ in 0..calls {
        let to = RecordsMut::packed(&mut out, 3);
        table.apply(&serial, from, to).expect("values of the right length");
    }
    table.rows() as u64
}
