//! Predicted times: how they grow, what they add up from, and what is measured.

use std::time::Instant;

use carvel::{Context, Fraction, Mesh, Output, Prediction, Refiner, Scheme, Task};

use crate::support::bases;
use crate::support::kernel;

fn schemes(triangles: bool) -> Vec<Scheme> {
    let w = Fraction::new(1, 32).expect("1/32");
    let mut schemes = vec![
        Scheme::catmull_clark(),
        Scheme::bilinear(),
        Scheme::b_spline(5).expect("a degree"),
        Scheme::doo_sabin(),
        Scheme::three_point(w).expect("w in range"),
    ];
    if triangles {
        schemes.push(Scheme::loop_triangles());
    }
    schemes
}

fn meshes() -> Vec<(Mesh, bool)> {
    let triangles = [bases::tetrahedron(), bases::octahedron()];
    let others = [bases::cube(), bases::prism(5), bases::torus(16, 16)];
    let triangles = triangles.map(|poly| (kernel::mesh(&poly), true));
    let others = others.map(|poly| (kernel::mesh(&poly), false));
    triangles.into_iter().chain(others).collect()
}

/// The largest number of levels whose counts 64 bits hold, at most 64.
fn deepest(mesh: &Mesh, scheme: &Scheme) -> u32 {
    let fits = |&levels: &u32| Prediction::new(mesh, scheme, levels).is_ok();
    (0..=64).take_while(fits).last().expect("level 0")
}

#[test]
fn more_of_anything_takes_longer() {
    for (mesh, triangles) in &meshes() {
        for scheme in &schemes(*triangles) {
            let mut before = -1.0;
            for level in 0..=deepest(mesh, scheme) {
                let plan = Prediction::new(mesh, scheme, level).expect("it fits");
                let time = |width, size, threads| plan.seconds(width, size, threads).total();
                let one = time(3, 4, 1);
                assert!(one.is_finite() && one > before, "{scheme:?} {level}: {before} {one}");
                assert!(time(3, 8, 1) > one && time(8, 4, 1) > one);
                let two = time(3, 4, 2);
                assert!(two < one && two > one / 2.0, "{one} {two}");
                before = one;
            }
        }
    }
}

#[test]
fn a_lone_triangle_and_absurd_numbers_have_a_time() {
    let triangle = Mesh::from_polygons(3, &[3], &[0, 1, 2]).expect("a triangle");
    // Closed and large enough for patches and tiles.
    let torus = kernel::mesh(&bases::torus(16, 16));
    let dual = schemes(true).into_iter().map(|scheme| (&triangle, scheme));
    for (mesh, scheme) in dual.chain(schemes(false).into_iter().map(|scheme| (&torus, scheme))) {
        for level in [0, 1, 4, 31, 32, 64] {
            let Ok(plan) = Prediction::new(mesh, &scheme, level) else { continue };
            for n in [0, 1, u64::MAX] {
                let seconds = plan.seconds(n, n, n as usize);
                for part in [seconds.steps, seconds.last, seconds.memory, seconds.total()] {
                    assert!(part.is_finite() && part >= 0.0, "{scheme:?} {level} {n}: {seconds:?}");
                }
            }
        }
    }
}

#[test]
fn parts_add_up_and_follow_the_levels() {
    let mesh = kernel::mesh(&bases::torus(64, 64));
    // Two passes: every level by itself.
    let scheme = Scheme::dual(&[Fraction::HALF, Fraction::ZERO]).expect("passes in range");
    let steps = |level| {
        let plan = Prediction::new(&mesh, &scheme, level).expect("it fits");
        let seconds = plan.seconds(3, 4, 1);
        let sum = seconds.steps + seconds.last + seconds.memory;
        assert!((seconds.total() - sum).abs() <= f64::EPSILON * sum);
        (seconds.steps + seconds.last, plan.last().faces as f64, plan.patch_depth())
    };
    // On a torus all faces are regular: a level more adds its faces, each as dear as any.
    let each = steps(1).0 / steps(1).1;
    let whole = steps(2).0;
    assert_eq!(steps(2).2, 0);
    assert!((whole - (steps(1).1 + steps(2).1) * each).abs() < 1e-9 * whole);
    let plan = Prediction::new(&mesh, &Scheme::catmull_clark(), 4).expect("it fits");
    let deep = plan.seconds(3, 4, 1);
    assert!(plan.patch_depth() == 4 && deep.steps == 0.0 && deep.last > 0.0);
}

/// Corners of triangles are cut off one by one.
#[test]
fn triangles_cost_a_dual_scheme_more() {
    let time = |poly| {
        let mesh = kernel::mesh(&poly);
        let plan = Prediction::new(&mesh, &Scheme::doo_sabin(), 1).expect("it fits");
        plan.seconds(3, 4, 1).steps / plan.last().faces as f64
    };
    assert!(time(bases::octahedron()) > 3.0 * time(bases::torus(16, 16)));
}

/// A record of no lanes or bytes counts as one of one.
#[test]
fn nothing_counts_as_one() {
    let mesh = kernel::mesh(&bases::torus(16, 16));
    let plan = Prediction::new(&mesh, &Scheme::doo_sabin(), 4).expect("it fits");
    assert_eq!(plan.seconds(0, 0, 0), plan.seconds(1, 1, 1));
}

#[test]
fn sharp_edges_and_boundaries_cost() {
    let time = |poly| {
        let mesh = kernel::mesh(&poly);
        let plan = Prediction::new(&mesh, &Scheme::catmull_clark(), 1).expect("it fits");
        assert_eq!(plan.last().faces, 1024);
        plan.seconds(3, 4, 1).steps
    };
    assert!(time(bases::grid(16, 16)) > 1.1 * time(bases::torus(16, 16)));
}

/// Generous, since other programs may run beside the test; `cargo bench --bench cost` is the
/// measurement. In builds that are not optimised there is nothing to compare.
#[test]
#[cfg_attr(debug_assertions, ignore = "times are those of optimised code")]
fn times_are_of_the_right_size() {
    let poly = bases::torus(64, 64);
    let (mesh, positions) = (kernel::mesh(&poly), kernel::coordinates::<f32>(&poly));
    let context = Context::serial();
    for scheme in &schemes(false) {
        let plan = Prediction::new(&mesh, scheme, 2).expect("it fits");
        let mut points = vec![0.0; 3 * plan.last().vertices as usize];
        let mut faces = vec![0; plan.last().corners as usize];
        let mut refiner = Refiner::new();
        let mut call = || {
            let start = Instant::now();
            let mut output = Output::new(&mut points);
            output.face_vertices = Some(&mut faces);
            let task = Task::new(&mesh, scheme, 2, &positions);
            refiner.refine_into(&context, &task, output).expect("it refines");
            start.elapsed().as_secs_f64()
        };
        let least = (0..10).map(|_| call()).fold(f64::INFINITY, f64::min);
        let predicted = plan.seconds(3, 4, 1);
        let ratio = (predicted.steps + predicted.last) / least;
        assert!((0.25..4.0).contains(&ratio), "{scheme:?}: predicted {ratio} times {least} s");
    }
}
