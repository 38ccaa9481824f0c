//! Curves: one step of a million points; analyses of typical and of long masks.

use std::hint::black_box;

use carvel::Context;
use carvel::analysis::mask::{Analysis, Effort};
use carvel::curve::{Coordinate, Ends, Polygon, catalogue};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};

const POINTS: usize = 1_000_000;

fn polygon<T: Coordinate>(width: usize, ends: Ends) -> Polygon<T> {
    let value = |i: usize| T::from_f64(libm::sin(i as f64 * 0.37) * 10.0);
    Polygon::new((0..POINTS * width).map(value).collect(), width, ends)
}

fn step<T: Coordinate>(c: &mut Criterion, number: &str) {
    let context = Context::serial();
    let mut group = c.benchmark_group("curve/1M");
    group.sample_size(20);
    for name in ["chaikin", "three-point:1/32", "four-point:1/16", "b-spline:3,3"] {
        let mask = catalogue::mask(name).unwrap();
        for (width, ends) in [(2, Ends::Closed), (3, Ends::Closed), (3, Ends::Kept)] {
            let control = polygon::<T>(width, ends);
            let (points, _) = Polygon::<T>::predict(&mask, POINTS, ends, 1).unwrap();
            let mut out = T::zeros(points * width).unwrap();
            group.throughput(Throughput::Elements((points * width) as u64));
            group.bench_function(format!("{name}/{number}x{width}/{}", ends.name()), |b| {
                b.iter(|| control.refine_into(&context, &mask, black_box(&mut out)).unwrap());
            });
        }
    }
    group.finish();
}

fn analyse(c: &mut Criterion) {
    let mut group = c.benchmark_group("analyse");
    group.sample_size(10);
    for name in [
        "chaikin",
        "three-point:1/32",
        "four-point:1/16",
        "four-point:3/20",
        "ternary-four-point:1/11",
        "dual-pseudo-spline:4,3",
        "four-point:19/100",
        "dyn-floater-hormann:1/100",
        "weissman:1/50",
        "deslauriers-dubuc:6",
        "deslauriers-dubuc:10",
    ] {
        let mask = catalogue::mask(name).unwrap();
        group.bench_function(name, |b| {
            b.iter(|| Analysis::of(&Context::serial(), black_box(&mask), Effort::default()));
        });
    }
    group.finish();
}

fn steps(c: &mut Criterion) {
    step::<f32>(c, "f32");
    step::<f64>(c, "f64");
}

criterion_group!(benches, steps, analyse);
criterion_main!(benches);
