//! Hostile input: an error with a kind, never a panic; work that can be stopped.

use carvel::analysis::mask::{Analysis, Effort, JointRadius, Response};
use carvel::curve::rational::ratio;
use carvel::curve::{
    Coordinate, Ends, Grid, GridMask, Laurent, Mask, Polygon, Tension, catalogue, limit_stencil,
    sample_limit,
};
use carvel::{Context, Element, Error, ErrorKind};

use crate::support::{named, q};

#[track_caller]
fn is<R>(result: Result<R, Error>, kind: ErrorKind) -> Error {
    let Err(error) = result else { panic!("{kind:?} was expected") };
    assert_eq!(error.kind(), kind, "{error}");
    assert!(!error.to_string().contains('\n'), "one line: {error}");
    assert!(error.to_string().len() < 200, "a short line: {error}");
    error
}

fn serial() -> Context {
    Context::serial()
}

#[test]
fn masks_that_are_none() {
    let parse = |text: &str, arity| Mask::parse(text, arity, None);
    is(parse("", 2), ErrorKind::InvalidText);
    is(parse("1/2,one,1/2", 2), ErrorKind::InvalidText);
    is(parse("1e400,1", 2), ErrorKind::ParameterOutOfRange);
    is(parse("1e401,1", 2), ErrorKind::ParameterOutOfRange);
    is(parse("1/0,1", 2), ErrorKind::InvalidText);
    is(parse("1/4,3/4,3/4", 2), ErrorKind::ParameterOutOfRange);
    is(parse("1,1", 0), ErrorKind::ParameterOutOfRange);
    is(parse("1,1", 1), ErrorKind::ParameterOutOfRange);
    is(Mask::new(2, 0, vec![ratio(1, 1); 2000]), ErrorKind::TooLarge);
    is(parse(&format!("1,1/{}", "7".repeat(900)), 2), ErrorKind::ParameterOutOfRange);
    is(catalogue::mask("no-such-scheme"), ErrorKind::InvalidText);
    is(catalogue::mask("three-point:1/32,5"), ErrorKind::ParameterOutOfRange);
    is(catalogue::mask("b-spline:0"), ErrorKind::ParameterOutOfRange);
    is(catalogue::mask("b-spline:1/2"), ErrorKind::ParameterOutOfRange);
    is(catalogue::mask("b-spline:99999999999999999999"), ErrorKind::ParameterOutOfRange);
    is(catalogue::mask("b-spline:64,64"), ErrorKind::TooLarge);
    is(catalogue::mask("primal-pseudo-spline:3,3"), ErrorKind::ParameterOutOfRange);
    is(catalogue::mask("odd-point:2,4"), ErrorKind::ParameterOutOfRange);
    let grid = |columns, count| GridMask::new([2, 2], [0, 0], columns, vec![ratio(1, 1); count]);
    assert!(grid(2, 4).is_ok());
    is(grid(2, 5), ErrorKind::ParameterOutOfRange);
    is(grid(0, 4), ErrorKind::ParameterOutOfRange);
    is(grid(3, 6), ErrorKind::ParameterOutOfRange);
}

fn check_values<T: Coordinate>(largest: f64) {
    let mask = named("three-point");
    for bad in [f64::NAN, f64::INFINITY] {
        let mut polygon = Polygon::new(vec![T::from_f64(1.0); 30], 3, Ends::Kept);
        polygon.points[3 * 7 + 1] = T::from_f64(bad);
        for steps in 0..3 {
            let error = is(polygon.refine(&serial(), &mask, steps), ErrorKind::NotFinite);
            assert_eq!(error.elements(), [Element::Vertex(7)]);
        }
        is(polygon.limit(&serial(), &mask, 0), ErrorKind::NotFinite);
        let tension = Tension::FourPoint(1.0);
        is(polygon.refine_with_tension(&serial(), tension, 1), ErrorKind::NotFinite);
        is(polygon.refine_non_uniform(&serial(), &[1.0; 9], 1), ErrorKind::NotFinite);
        let ends = [Ends::Closed; 2];
        let grid = Grid { points: polygon.points.clone(), columns: 5, width: 3, ends };
        is(grid.refine(&serial(), [&mask, &mask], 1), ErrorKind::NotFinite);
    }
    // A mask with norm above 1 leaves the range; one with norm 1 does not.
    let swing = |i: usize| T::from_f64(if i.is_multiple_of(2) { largest } else { -largest });
    let polygon = Polygon::new((0..40).map(swing).collect::<Vec<_>>(), 1, Ends::Closed);
    let steep = Mask::centred(2, ["-3", "-3", "5", "5", "-1", "-1"].map(q).to_vec()).expect("one");
    is(polygon.refine(&serial(), &steep, 1), ErrorKind::Overflow);
    assert!(polygon.refine(&serial(), &mask, 3).is_ok());
}

#[test]
fn values_that_are_none() {
    check_values::<f32>(f32::MAX.into());
    check_values::<f64>(f64::MAX);
}

#[test]
fn polygons_that_are_none() {
    let (mask, dual) = (named("four-point"), named("chaikin"));
    let line = |n: usize, ends| Polygon::new(vec![1.0; n], 1, ends);
    for ends in [Ends::Closed, Ends::Dropped, Ends::Kept, Ends::Anchored] {
        is(line(0, ends).refine(&serial(), &mask, 1), ErrorKind::LengthMismatch);
        is(
            Polygon::new(vec![1.0; 7], 2, ends).refine(&serial(), &mask, 1),
            ErrorKind::LengthMismatch,
        );
        is(
            Polygon::new(vec![1.0; 7], 0, ends).refine(&serial(), &mask, 1),
            ErrorKind::LengthMismatch,
        );
    }
    is(line(1, Ends::Kept).refine(&serial(), &mask, 1), ErrorKind::LengthMismatch);
    is(line(2, Ends::Anchored).refine(&serial(), &dual, 1), ErrorKind::LengthMismatch);
    // Four points have three between them, and those one: no third step.
    is(line(2, Ends::Dropped).refine(&serial(), &mask, 1), ErrorKind::LengthMismatch);
    assert_eq!(line(4, Ends::Dropped).refine(&serial(), &mask, 2).expect("one point").len(), 1);
    is(line(4, Ends::Dropped).refine(&serial(), &mask, 3), ErrorKind::LengthMismatch);
    let lopsided = named("corner-cutting:1/4,1/3");
    is(line(5, Ends::Kept).refine(&serial(), &lopsided, 1), ErrorKind::Unsupported);
    is(line(5, Ends::Closed).refine(&serial(), &mask, 65), ErrorKind::ParameterOutOfRange);
    is(line(5, Ends::Closed).refine(&serial(), &mask, 64), ErrorKind::TooLarge);
    let mut small = vec![0.0; 9];
    is(line(5, Ends::Closed).refine_into(&serial(), &mask, &mut small), ErrorKind::LengthMismatch);
    let ceiling = Context::builder().memory_ceiling(1 << 20).build().expect("a context");
    is(line(5, Ends::Closed).refine(&ceiling, &mask, 20), ErrorKind::MemoryCeiling);
    let grid = Grid { points: vec![1.0; 30], columns: 5, width: 1, ends: [Ends::Kept; 2] };
    let pair = GridMask::tensor(&dual, &dual).expect("a mask");
    is(grid.refine_by(&serial(), &pair, 1), ErrorKind::Unsupported);
    is(
        Grid { columns: 7, ..grid.clone() }.refine_by(&serial(), &pair, 1),
        ErrorKind::LengthMismatch,
    );
    is(Grid { columns: 0, ..grid }.refine(&serial(), [&dual, &dual], 1), ErrorKind::LengthMismatch);
}

#[test]
fn tensions_and_parameters_out_of_range() {
    let line = Polygon::new(vec![0.0, 1.0, 2.0, 4.0, 5.0], 1, Ends::Closed);
    for v in [-1.0, -2.0, f64::NAN, f64::INFINITY] {
        let tension = Tension::FourPoint(v);
        is(line.refine_with_tension(&serial(), tension, 1), ErrorKind::ParameterOutOfRange);
        let local = [1.0, v, 1.0, 1.0, 1.0];
        is(line.refine_with_local_tension(&serial(), &local, 1), ErrorKind::ParameterOutOfRange);
        let ternary = Tension::TernaryFourPoint(v.min(-1.0));
        is(line.refine_with_tension(&serial(), ternary, 1), ErrorKind::ParameterOutOfRange);
    }
    is(line.refine_with_local_tension(&serial(), &[1.0; 4], 1), ErrorKind::LengthMismatch);
    is(line.refine_non_uniform(&serial(), &[1.0; 4], 1), ErrorKind::LengthMismatch);
    is(line.refine_non_uniform(&serial(), &[0.0; 5], 1), ErrorKind::ParameterOutOfRange);
    is(line.parameters(2.0), ErrorKind::ParameterOutOfRange);
    let still = Polygon::new(vec![1.0; 5], 1, Ends::Closed);
    is(still.parameters(0.5), ErrorKind::ParameterOutOfRange);
}

#[test]
fn questions_without_an_answer() {
    let paper = named("three-point");
    is(limit_stencil(&serial(), &paper, &q("0"), 3), ErrorKind::Unsupported);
    is(limit_stencil(&serial(), &named("de-rham"), &q("0"), 1), ErrorKind::Unsupported);
    is(limit_stencil(&serial(), &paper, &q("1/1009"), 0), ErrorKind::TooLarge);
    is(sample_limit(&serial(), &paper, 40), ErrorKind::TooLarge);
    let tight = Context::builder().threads(1).memory_ceiling(1 << 20).build().expect("a context");
    assert!(sample_limit(&tight, &paper, 9).is_ok());
    is(sample_limit(&tight, &paper, 14), ErrorKind::MemoryCeiling);
    // The scheme that doubles every point has no continuous limit.
    let doubling = Mask::new(2, 0, vec![q("1"), q("1")]).expect("a mask");
    is(limit_stencil(&serial(), &doubling, &q("0"), 0), ErrorKind::Unsupported);
    let done = Analysis::of(&serial(), &doubling, Effort::default()).expect("done");
    assert_eq!((done.continuity, done.contractivity), (None, None));
    is(Response::of(&paper, 1.0), ErrorKind::ParameterOutOfRange);
    is(Response::of(&paper, f64::NAN), ErrorKind::ParameterOutOfRange);
    is(JointRadius::of(&serial(), 2, &Laurent::new(0, vec![])), ErrorKind::ParameterOutOfRange);
    is(JointRadius::of(&serial(), 1, &Laurent::one()), ErrorKind::ParameterOutOfRange);
}

#[test]
fn analyses_report_and_stop() {
    use std::sync::{Arc, Mutex};
    let mask = named("deslauriers-dubuc:6");
    let cancelled = serial();
    cancelled.cancel();
    is(Analysis::of(&cancelled, &mask, Effort::default()), ErrorKind::Cancelled);
    let seen = Arc::new(Mutex::new(Vec::new()));
    let kept = Arc::clone(&seen);
    let progress = move |done: f64| {
        let mut seen = kept.lock().expect("no panic");
        seen.push(done);
        seen.len() < 3
    };
    let context = Context::builder().progress(progress).build().expect("a context");
    is(Analysis::of(&context, &mask, Effort::default()), ErrorKind::Cancelled);
    let seen = seen.lock().expect("no panic");
    assert!(seen.len() == 3 && seen.is_sorted(), "{seen:?}");
}

/// A radius a little above m⁻³ is not rounded to it, nor the exponent to 3.
#[test]
fn a_radius_is_not_taken_for_the_power_beside_it() {
    for (arity, places) in [(5, 25), (3, 40), (10, 26)] {
        let over = num_traits::pow(q("1/10"), places);
        let kernel = Laurent::new(0, vec![q("1") + &over, -over]);
        let smoothed = (0..4).fold(kernel, |p, _| &p * &Laurent::sigma(arity));
        let symbol = smoothed.scaled(&num_traits::pow(ratio(1, arity as i64), 3));
        let mask = Mask::new(arity, 0, symbol.coefficients().to_vec()).expect("a mask");
        let found = Analysis::of(&serial(), &mask, Effort::default()).expect("done");
        assert_eq!(found.continuity, Some(2), "{arity}");
        assert!(found.holder.low < 3.0 && found.holder.high >= 3.0, "{:?}", found.holder);
        assert!(found.holder.high - found.holder.low < 1e-12);
    }
}

/// One of the longest of the catalogue, cancelled in the middle, ends long before it would.
#[test]
fn hard_analyses_can_be_cancelled() {
    let mask = named("deslauriers-dubuc:64");
    let context = serial();
    let found = std::thread::scope(|scope| {
        let found = scope.spawn(|| Analysis::of(&context, &mask, Effort::default()));
        std::thread::sleep(std::time::Duration::from_millis(50));
        context.cancel();
        found.join().expect("no panic")
    });
    is(found, ErrorKind::Cancelled);
}

/// Long masks get bounds that are far apart but right, and no overflow on the way.
#[test]
fn long_and_large_masks_are_answered() {
    let mut rng = crate::rng::Rng::new(1);
    let mut coefficients: Vec<_> = (0..600).map(|_| ratio(rng.integer(1000), 1 << 20)).collect();
    for residue in 0..2 {
        let rest: carvel::curve::Rational = coefficients.iter().skip(residue + 2).step_by(2).sum();
        coefficients[residue] = ratio(1, 1) - rest;
    }
    let mask = Mask::centred(2, coefficients).expect("a mask");
    let done = Analysis::of(&serial(), &mask, Effort::default()).expect("done");
    assert!(done.holder.low <= done.holder.high);
    let large = carvel::curve::Rational::from(num_bigint::BigInt::from(1) << 3000);
    let wild = vec![large.clone(), &q("1") + &large, q("1") - large.clone(), -large];
    let mask = Mask::centred(2, wild).expect("a mask");
    let done = Analysis::of(&serial(), &mask, Effort::default()).expect("done");
    assert_eq!(done.continuity, None);
}
