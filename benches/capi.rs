//! What the C interface costs over a call from Rust.
//!
//! The same refinement into the same buffers, by `Refiner::refine_into` and by
//! `carvel_refiner_refine_f32`, in turn: first each alone by Criterion, then in
//! pairs, whose median ratio is what `benches/README.md` quotes, for two runs of
//! one program on a shared machine differ by more than the border costs.

use carvel::capi::{
    CARVEL_SCHEME_THREE_POINT, CARVEL_STATUS_OK, carvel_const_values_f32, carvel_indices,
    carvel_mesh, carvel_mesh_create, carvel_mesh_desc, carvel_mesh_destroy,
    carvel_refine_input_f32, carvel_refine_output_f32, carvel_refiner, carvel_refiner_create,
    carvel_refiner_destroy, carvel_refiner_refine_f32, carvel_scheme, carvel_scheme_create,
    carvel_scheme_desc, carvel_scheme_destroy, carvel_values_f32,
};
use carvel::{Context, Fraction, Mesh, Output, Prediction, Refiner, Scheme, Task};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use std::hint::black_box;
use std::ptr::{null, null_mut};
use std::time::{Duration, Instant};

/// A grid of quads on a torus.
struct Torus {
    vertices: u64,
    positions: Vec<f32>,
    indices: Vec<u32>,
}

impl Torus {
    fn new(n: u32) -> Self {
        let vertex = |i: u32, j: u32| (i % n) * n + j % n;
        let corners = |f: u32| {
            let (i, j) = (f / n, f % n);
            [vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)]
        };
        let angle = |k: u32| k as f32 / n as f32 * std::f32::consts::TAU;
        let point = |v: u32| {
            let (a, b) = (angle(v / n), angle(v % n));
            [(3.0 + b.cos()) * a.cos(), (3.0 + b.cos()) * a.sin(), b.sin()]
        };
        Self {
            vertices: u64::from(n * n),
            positions: (0..n * n).flat_map(point).collect(),
            indices: (0..n * n).flat_map(corners).collect(),
        }
    }
}

/// The torus in the hands of a Rust program and of a C program.
struct Hosts<'t> {
    torus: &'t Torus,
    levels: u32,
    mesh: Mesh,
    scheme: Scheme,
    refiner: Refiner<f32>,
    context: Context,
    c_mesh: *mut carvel_mesh,
    c_scheme: *mut carvel_scheme,
    c_refiner: *mut carvel_refiner,
    faces: Vec<u32>,
    points: Vec<f32>,
}

/// A struct of the interface with its size set and all else at its default.
fn described<T>() -> T {
    // SAFETY: zero is a value of all of them, and the size is their first field.
    unsafe {
        let mut value: T = std::mem::zeroed();
        (&raw mut value).cast::<u32>().write(size_of::<T>() as u32);
        value
    }
}

impl<'t> Hosts<'t> {
    fn new(torus: &'t Torus, levels: u32) -> Self {
        let sizes = vec![4; torus.vertices as usize];
        let mesh = Mesh::from_polygons(torus.vertices as usize, &sizes, &torus.indices);
        let (mesh, w) = (mesh.expect("a torus"), Fraction::new(1, 32).expect("1/32"));
        let scheme = Scheme::three_point(w).expect("w in range");
        let last = *Prediction::new(&mesh, &scheme, levels).expect("it fits").last();
        let mut hosts = Self {
            torus,
            levels,
            mesh,
            scheme,
            refiner: Refiner::new(),
            context: Context::serial(),
            c_mesh: null_mut(),
            c_scheme: null_mut(),
            c_refiner: null_mut(),
            faces: vec![0; last.corners as usize],
            points: vec![0.0; 3 * last.vertices as usize],
        };
        hosts.create();
        hosts
    }

    fn create(&mut self) {
        let mesh = carvel_mesh_desc {
            face_size: 4,
            vertex_count: self.torus.vertices,
            face_count: self.torus.vertices,
            face_vertices: self.torus.indices.as_ptr(),
            face_vertex_count: self.torus.indices.len() as u64,
            ..described()
        };
        let scheme = carvel_scheme_desc { family: CARVEL_SCHEME_THREE_POINT, ..described() };
        // SAFETY: valid pointers; the arrays are as long as described.
        unsafe {
            let error = null_mut();
            assert_eq!(carvel_mesh_create(null(), &raw const mesh, &raw mut self.c_mesh, error), 0);
            let out = &raw mut self.c_scheme;
            assert_eq!(carvel_scheme_create(&raw const scheme, out, error), 0);
            assert_eq!(carvel_refiner_create(&raw mut self.c_refiner, error), 0);
        }
    }

    fn call_from_rust(&mut self) {
        let task = Task::new(&self.mesh, &self.scheme, self.levels, &self.torus.positions);
        let output = Output {
            face_sizes: None,
            face_vertices: Some(&mut self.faces),
            face_sources: None,
            positions: &mut self.points,
            attributes: Vec::new(),
            channels: Vec::new(),
        };
        self.refiner.refine_into(&self.context, &task, output).expect("it refines");
    }

    fn call_from_c(&mut self) {
        let (data, count) = (self.torus.positions.as_ptr(), self.torus.vertices);
        let input = carvel_refine_input_f32 {
            levels: self.levels,
            mesh: self.c_mesh,
            scheme: self.c_scheme,
            positions: carvel_const_values_f32 { data, count, width: 3, stride: 0 },
            ..described()
        };
        let count = self.points.len() as u64 / 3;
        let positions =
            carvel_values_f32 { data: self.points.as_mut_ptr(), count, width: 3, stride: 0 };
        let (data, count) = (self.faces.as_mut_ptr(), self.faces.len() as u64);
        let face_vertices = carvel_indices { data, count };
        let mut output = carvel_refine_output_f32 { face_vertices, positions, ..described() };
        let (input, output) = (&raw const input, black_box(&raw mut output));
        // SAFETY: objects that live, and buffers as long as described.
        let status =
            unsafe { carvel_refiner_refine_f32(self.c_refiner, null(), input, output, null_mut()) };
        assert_eq!(status, CARVEL_STATUS_OK);
    }

    /// Both hosts give the same bytes; compared before anything is timed.
    fn check(&mut self) {
        self.call_from_rust();
        let expected = (self.faces.clone(), self.points.clone());
        self.faces.fill(7);
        self.points.fill(7.0);
        self.call_from_c();
        assert!((&self.faces, &self.points) == (&expected.0, &expected.1));
    }

    /// The median, over pairs of calls in alternating order, of C's time over
    /// Rust's.
    fn ratio(&mut self) -> f64 {
        const PAIRS: usize = 301;
        let mut ratios: Vec<f64> = (0..PAIRS)
            .map(|i| {
                let mut times = [Duration::ZERO; 2];
                for host in [i % 2, (i + 1) % 2] {
                    let begun = Instant::now();
                    if host == 0 {
                        self.call_from_rust();
                    } else {
                        self.call_from_c();
                    }
                    times[host] = begun.elapsed();
                }
                times[1].as_secs_f64() / times[0].as_secs_f64()
            })
            .collect();
        ratios.sort_by(f64::total_cmp);
        ratios[PAIRS / 2]
    }
}

impl Drop for Hosts<'_> {
    fn drop(&mut self) {
        // SAFETY: each is destroyed once, and not used after.
        unsafe {
            carvel_refiner_destroy(self.c_refiner);
            carvel_scheme_destroy(self.c_scheme);
            carvel_mesh_destroy(self.c_mesh);
        }
    }
}

fn calls(criterion: &mut Criterion) {
    for (side, levels) in [(4, 1), (16, 1), (16, 3), (64, 3)] {
        let torus = Torus::new(side);
        let mut hosts = Hosts::new(&torus, levels);
        hosts.check();
        let faces = hosts.faces.len() as u64 / 4;
        let mut group = criterion.benchmark_group(format!("three-point/{faces} faces"));
        group.throughput(Throughput::Elements(faces)).sample_size(20);
        group.bench_function("from Rust", |bencher| {
            bencher.iter(|| hosts.call_from_rust());
        });
        group.bench_function("from C", |bencher| {
            bencher.iter(|| hosts.call_from_c());
        });
        group.finish();
        println!("{faces} faces: from C in {:.3} of the time from Rust\n", hosts.ratio());
    }
}

criterion_group!(benches, calls);
criterion_main!(benches);
