//! Whole refinements: nanoseconds and peak bytes per output face.
//!
//! `cargo bench` prints, for each scheme, mesh and number of threads, the time
//! into fresh arrays and into the caller's warm ones with re-used scratch, then
//! the peak memory of one fresh call, and what merely writing the same bytes
//! costs. Criterion's throughput is in output faces per second.

use carvel::{Context, Fraction, Mesh, Output, Prediction, Refiner, Scheme, Task};
use criterion::{Criterion, SamplingMode, Throughput, criterion_group, criterion_main};
use std::alloc::{GlobalAlloc, Layout, System};
use std::hint::black_box;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

/// Counts the bytes in use and their peak.
struct Counting;

static IN_USE: AtomicUsize = AtomicUsize::new(0);
static PEAK: AtomicUsize = AtomicUsize::new(0);

fn count(bytes: usize) {
    PEAK.fetch_max(IN_USE.fetch_add(bytes, Relaxed) + bytes, Relaxed);
}

// SAFETY: every call is handed to the system allocator unchanged.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        count(layout.size());
        // SAFETY: the caller's promises are those that `System` asks for.
        unsafe { System.alloc(layout) }
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        count(layout.size());
        // SAFETY: as above; zeroed pages come straight from the system.
        unsafe { System.alloc_zeroed(layout) }
    }

    unsafe fn dealloc(&self, ptr: *mut u8, layout: Layout) {
        IN_USE.fetch_sub(layout.size(), Relaxed);
        // SAFETY: as above.
        unsafe { System.dealloc(ptr, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// A control mesh with single-precision positions.
struct Control {
    name: &'static str,
    mesh: Mesh,
    positions: Vec<f32>,
}

fn cube() -> Control {
    let indices = [0, 1, 3, 2, 4, 6, 7, 5, 0, 4, 5, 1, 2, 3, 7, 6, 0, 2, 6, 4, 1, 5, 7, 3];
    let positions = (0..8).flat_map(|i| [i >> 2, i >> 1 & 1, i & 1]).map(|x| x as f32).collect();
    let mesh = Mesh::from_polygons(8, &[4; 6], &indices).expect("a cube");
    Control { name: "cube", mesh, positions }
}

/// The cow, read by a few lines so that the bench needs the kernel only.
fn cow() -> Control {
    let text = include_str!("../assets/spot/spot_control_mesh.obj");
    let (mut positions, mut sizes, mut indices) = (Vec::new(), Vec::new(), Vec::new());
    for line in text.lines() {
        let mut words = line.split_whitespace();
        match words.next() {
            Some("v") => positions.extend(words.map(|w| w.parse::<f32>().expect("a number"))),
            Some("f") => {
                let before = indices.len();
                let vertex = |w: &str| w.split('/').next()?.parse::<u32>().ok();
                indices.extend(words.filter_map(vertex).map(|v| v - 1));
                sizes.push((indices.len() - before) as u32);
            }
            _ => {}
        }
    }
    let mesh = Mesh::from_polygons(positions.len() / 3, &sizes, &indices).expect("the cow");
    Control { name: "cow", mesh, positions }
}

/// A torus of quads, row by row or with faces and vertices numbered at random.
fn torus(shuffled: bool) -> Control {
    const SIZE: [u32; 2] = [700, 740];
    let n = SIZE[0] * SIZE[1];
    let vertex = |i: u32, j: u32| (i % SIZE[0]) * SIZE[1] + j % SIZE[1];
    let mut names: Vec<u32> = (0..n).collect();
    let mut order: Vec<u32> = (0..n).collect();
    if shuffled {
        let mut state = 1;
        shuffle(&mut names, &mut state);
        shuffle(&mut order, &mut state);
    }
    let corners = |f: &u32| {
        let (i, j) = (f / SIZE[1], f % SIZE[1]);
        [vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)]
    };
    let indices: Vec<u32> = order.iter().flat_map(corners).map(|v| names[v as usize]).collect();
    let mut positions = vec![0.0; 3 * n as usize];
    for v in 0..n {
        let angle = |k: u32, of: u32| k as f32 / of as f32 * std::f32::consts::TAU;
        let (a, b) = (angle(v / SIZE[1], SIZE[0]), angle(v % SIZE[1], SIZE[1]));
        let at = 3 * names[v as usize] as usize;
        let radius = 3.0 + b.cos();
        positions[at..at + 3].copy_from_slice(&[radius * a.cos(), radius * a.sin(), b.sin()]);
    }
    let mesh = Mesh::from_polygons(n as usize, &vec![4; n as usize], &indices).expect("a torus");
    Control { name: if shuffled { "torus, shuffled" } else { "torus" }, mesh, positions }
}

fn shuffle(list: &mut [u32], state: &mut u64) {
    for i in (1..list.len()).rev() {
        *state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        list.swap(i, (*state >> 33) as usize % (i + 1));
    }
}

fn schemes() -> [(&'static str, Scheme); 2] {
    let w = Fraction::new(1, 32).expect("1/32");
    [
        ("doo-sabin", Scheme::doo_sabin()),
        ("three-point", Scheme::three_point(w).expect("w in range")),
    ]
}

fn refinements(criterion: &mut Criterion) {
    let jobs = [(cube(), 9), (cow(), 7), (torus(false), 1), (torus(true), 1)];
    for (control, levels) in &jobs {
        for (name, scheme) in &schemes() {
            for threads in [1, 2] {
                one(criterion, control, *levels, (name, scheme), threads);
            }
        }
    }
}

fn one(
    criterion: &mut Criterion,
    control: &Control,
    levels: u32,
    (name, scheme): (&str, &Scheme),
    threads: usize,
) {
    let context = Context::builder().threads(threads).build().expect("threads");
    let task = Task::new(&control.mesh, scheme, levels, &control.positions);
    let last = *Prediction::new(&control.mesh, scheme, levels).expect("it fits").last();
    let mut group = criterion.benchmark_group(format!("{name}/{}/{threads} threads", control.name));
    group.throughput(Throughput::Elements(last.faces)).sampling_mode(SamplingMode::Flat);
    group.sample_size(15);
    group.bench_function("fresh", |bencher| {
        bencher.iter(|| Refiner::new().refine(&context, &task).expect("it refines"));
    });
    let mut faces = vec![0; last.corners as usize];
    let mut points = vec![0.0; 3 * last.vertices as usize];
    let mut refiner = Refiner::new();
    group.bench_function("warm", |bencher| {
        bencher.iter(|| {
            let output = Output {
                face_sizes: None,
                face_vertices: Some(&mut faces),
                face_sources: None,
                positions: &mut points,
                attributes: Vec::new(),
                channels: Vec::new(),
            };
            refiner.refine_into(&context, &task, output).expect("it refines");
        });
    });
    group.bench_function("bare write", |bencher| {
        bencher.iter(|| {
            faces.fill(black_box(7));
            points.fill(black_box(1.0));
            black_box((&mut faces, &mut points));
        });
    });
    group.finish();
    drop((faces, points, refiner));
    if threads == 1 {
        report_memory(&context, &task, last.faces);
    }
}

fn report_memory(context: &Context, task: &Task<f32>, faces: u64) {
    let before = IN_USE.load(Relaxed);
    PEAK.store(before, Relaxed);
    let refined = Refiner::new().refine(context, task).expect("it refines");
    let peak = PEAK.load(Relaxed) - before;
    println!(
        "peak memory: {:.1} bytes per output face, output included\n",
        peak as f64 / faces as f64
    );
    drop(refined);
}

criterion_group!(benches, refinements);
criterion_main!(benches);
