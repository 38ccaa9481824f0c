//! What `Prediction::seconds` says beside what refinements take.
//!
//! `cargo bench --bench cost` prints, for refinements that each are ruled by one constant of
//! `src/hierarchy/cost.rs`, nanoseconds per output face on one thread, the least of many
//! calls into memory that was used before. What fresh memory adds, `make compare` tells.

use carvel::mesh::{BuildOptions, build};
use carvel::{
    Attribute, Context, Crease, Fraction, Mesh, Output, Prediction, Refiner, Scheme, Task,
};
use std::time::Instant;

const CALLS: u32 = 15;

/// A control mesh with single-precision positions.
struct Control {
    name: String,
    mesh: Mesh,
    positions: Vec<f32>,
}

/// A torus, or a sheet with a boundary, of quads or triangles; every `crease`-th row of edges
/// is sharp.
fn surface(side: u32, closed: bool, triangles: bool, crease: Option<u32>) -> Control {
    let vertices = if closed { side } else { side + 1 };
    let at = |i: u32, j: u32| (i % vertices) * vertices + j % vertices;
    let (mut indices, mut positions, mut creases) = (Vec::new(), Vec::new(), Vec::new());
    for i in 0..side {
        for j in 0..side {
            let quad = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            if triangles {
                indices.extend([quad[0], quad[1], quad[2], quad[0], quad[2], quad[3]]);
            } else {
                indices.extend(quad);
            }
            if crease.is_some_and(|every| i % every == 0) {
                creases.push(Crease { vertices: [quad[0], quad[3]], sharpness: 10.0 });
            }
        }
    }
    for v in 0..vertices * vertices {
        let angle = |k: u32| k as f32 / side as f32 * std::f32::consts::TAU;
        let (a, b) = (angle(v / vertices), angle(v % vertices));
        let radius = 3.0 + b.cos();
        positions.extend([radius * a.cos(), radius * a.sin(), b.sin()]);
    }
    let corners = if triangles { 3 } else { 4 };
    let sizes = vec![corners; indices.len() / corners as usize];
    let options = BuildOptions { creases: &creases, ..BuildOptions::default() };
    let n = positions.len() / 3;
    let mesh = build(&Context::serial(), n, &sizes, &indices, &options).expect("a mesh").mesh;
    let kind = if closed { "torus" } else { "sheet" };
    let sharp = if crease.is_some() { ", creased" } else { "" };
    Control { name: format!("{kind} of {}{sharp}", sizes.len()), mesh, positions }
}

fn schemes() -> Vec<(&'static str, Scheme)> {
    let w = Fraction::new(1, 32).expect("1/32");
    vec![
        ("catmull-clark", Scheme::catmull_clark()),
        ("bilinear", Scheme::bilinear()),
        ("b-spline 5", Scheme::b_spline(5).expect("a degree")),
        ("loop", Scheme::loop_triangles()),
        ("doo-sabin", Scheme::doo_sabin()),
        ("three-point", Scheme::three_point(w).expect("w in range")),
        ("b-spline 4", Scheme::b_spline(4).expect("a degree")),
    ]
}

fn main() {
    println!(
        "{:<14} {:<24} {:>5} {:>5} {:>5} {:>8} {:>9} {:>9} {:>6}",
        "scheme", "mesh", "level", "depth", "width", "faces", "ns", "predicted", "ratio"
    );
    for (name, scheme) in &schemes() {
        let surface = |side, closed, crease| surface(side, closed, *name == "loop", crease);
        // Calls of a millisecond or less, which other programs seldom interrupt.
        for (level, side) in [(1, 128), (2, 64), (3, 32), (4, 16), (5, 16)] {
            row(name, scheme, &surface(side, true, None), level, 0);
        }
        for level in [1, 3] {
            row(name, scheme, &surface(32, false, None), level, 0);
            row(name, scheme, &surface(32, true, None), level, 4);
        }
        row(name, scheme, &surface(32, true, None), 3, 12);
    }
    for (every, level) in [(2, 1), (2, 3), (16, 3)] {
        let creased = surface(32, true, false, Some(every));
        row("catmull-clark", &Scheme::catmull_clark(), &creased, level, 0);
    }
}

fn row(name: &str, scheme: &Scheme, control: &Control, level: u32, more: usize) {
    let context = Context::serial();
    let values = vec![0.5_f32; more * control.mesh.vertices()];
    let attributes = if more == 0 { vec![] } else { vec![Attribute::vertex(&values, more)] };
    let task = Task {
        attributes: &attributes,
        ..Task::new(&control.mesh, scheme, level, &control.positions)
    };
    let plan = Prediction::new(&control.mesh, scheme, level).expect("it fits");
    let last = *plan.last();
    let (mut sizes, mut faces) = (vec![0; last.faces as usize], vec![0; last.corners as usize]);
    let mut points = vec![0.0; 3 * last.vertices as usize];
    let mut others = vec![0.0; more * last.vertices as usize];
    let mut refiner = Refiner::new();
    let warm = least(|| {
        let mut output = Output::new(&mut points);
        output.face_sizes = Some(&mut sizes);
        output.face_vertices = Some(&mut faces);
        if more > 0 {
            output.attributes.push(&mut others);
        }
        refiner.refine_into(&context, &task, output).expect("it refines");
    });
    let predicted = plan.seconds(3 + more as u64, 4, 1);
    let predicted = predicted.steps + predicted.last;
    let ns = |seconds: f64| 1e9 * seconds / last.faces as f64;
    println!(
        "{name:<14} {:<24} {level:>5} {:>5} {:>5} {:>8} {:>9.2} {:>9.2} {:>6.2}",
        control.name,
        plan.patch_depth(),
        3 + more,
        last.faces,
        ns(warm),
        ns(predicted),
        predicted / warm,
    );
}

/// The least time of a call, the first left out.
fn least(mut call: impl FnMut()) -> f64 {
    call();
    let timed = |_| {
        let start = Instant::now();
        call();
        start.elapsed().as_secs_f64()
    };
    (0..CALLS).map(timed).fold(f64::INFINITY, f64::min)
}
