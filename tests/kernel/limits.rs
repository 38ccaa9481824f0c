//! Hostile values and sizes, memory, progress and cancelling: an error with a
//! kind, never a panic, and nothing built in vain.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use carvel::base::Scalar;
use carvel::{
    Attribute, Context, Error, ErrorKind, Fraction, Hierarchy, Mesh, Output, Prediction, Refined,
    Refiner, Scheme, Task,
};

use crate::support::allocation::{Counter, peak_of};
use crate::support::bases;
use crate::support::kernel::{self, Soup, assert_same_bytes};
use crate::support::poly::Poly;

#[global_allocator]
static COUNTER: Counter = Counter;

/// The memory that a refused call may take: plans, messages.
const LITTLE: usize = 64 << 10;
/// The time that a refused call may take.
const AT_ONCE: Duration = Duration::from_secs(2);

fn dual(passes: &[(i64, i64)]) -> Scheme {
    let fraction = |&(p, q)| Fraction::new(p, q).expect("a fraction");
    let passes: Vec<Fraction> = passes.iter().map(fraction).collect();
    Scheme::dual(&passes).expect("passes in range")
}

/// A mesh with data, from which tasks are made.
struct Setup<T> {
    mesh: Mesh,
    scheme: Scheme,
    positions: Vec<T>,
}

impl<T: Scalar> Setup<T> {
    fn new(poly: &Poly<f64>, scheme: Scheme) -> Self {
        Self { mesh: kernel::mesh(poly), scheme, positions: kernel::coordinates(poly) }
    }

    fn task<'a>(&'a self, levels: u32, attributes: &'a [Attribute<'a, T>]) -> Task<'a, T> {
        Task {
            mesh: &self.mesh,
            scheme: &self.scheme,
            levels,
            positions: &self.positions,
            attributes,
            channels: &[],
            face_sources: true,
        }
    }

    fn refine(&self, context: &Context, levels: u32) -> Result<Refined<T>, Error> {
        Refiner::new().refine(context, &self.task(levels, &[]))
    }

    fn hierarchy(&self, levels: u32) -> Hierarchy {
        let made =
            Hierarchy::new(&Context::serial(), self.mesh.clone(), self.scheme.clone(), levels);
        made.expect("a small hierarchy")
    }
}

fn cube(scheme: Scheme) -> Setup<f64> {
    Setup::new(&bases::cube(), scheme)
}

#[track_caller]
fn assert_kind<R>(result: Result<R, Error>, kind: ErrorKind) -> Error {
    let Err(error) = result else { panic!("{kind:?} was expected") };
    assert_eq!(error.kind(), kind, "{error}");
    assert!(!error.to_string().contains('\n'), "one line: {error}");
    error
}

// --------------------------------------------------------------------- values

fn check_not_finite<T: Scalar>(bad: f64) {
    let mut setup = Setup::<T>::new(&bases::cube(), dual(&[(1, 2)]));
    let values = vec![T::from_f64(bad); 8];
    for levels in 0..3 {
        let attributes = &[Attribute::vertex(&values, 1)];
        let error = Refiner::new().refine(&Context::serial(), &setup.task(levels, attributes));
        let error = assert_kind(error, ErrorKind::NotFinite);
        assert_eq!(error.elements(), [carvel::Element::Vertex(0)]);
    }
    setup.positions[3 * 5 + 1] = T::from_f64(bad);
    for levels in 0..3 {
        let error = assert_kind(setup.refine(&Context::serial(), levels), ErrorKind::NotFinite);
        assert_eq!(error.elements(), [carvel::Element::Vertex(5)]);
        let (hierarchy, mut out) = (setup.hierarchy(levels), Vec::new());
        out.resize(3 * hierarchy.mesh(levels).vertices(), T::default());
        let values = hierarchy.refine(&Context::serial(), levels, &setup.positions, 3, &mut out);
        assert_kind(values, ErrorKind::NotFinite);
    }
}

#[test]
fn values_must_be_finite() {
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        check_not_finite::<f64>(bad);
        check_not_finite::<f32>(bad);
    }
}

/// An isolated vertex belongs to no row, and is checked all the same.
#[test]
fn isolated_vertices_must_be_finite() {
    let mut control = bases::cube();
    control.positions.push([0.0, 0.0, f64::NAN]);
    let setup = Setup::<f64>::new(&control, dual(&[]));
    let error = assert_kind(setup.refine(&Context::serial(), 1), ErrorKind::NotFinite);
    assert_eq!(error.elements(), [carvel::Element::Vertex(8)]);
}

/// Coordinates at the end of the range, of either sign, in a checkerboard.
fn extreme<T: Scalar>(poly: &Poly<f64>, scheme: Scheme, largest: f64) -> Setup<T> {
    let sign = |i: usize| if i.is_multiple_of(2) { largest } else { -largest };
    let mut setup = Setup::new(poly, scheme);
    for (i, p) in setup.positions.chunks_mut(3).enumerate() {
        p.fill(T::from_f64(sign(i)));
    }
    setup
}

fn check_overflow<T: Scalar>(largest: f64) {
    // Passes beyond 1 make more of a checkerboard, inside and along a boundary.
    let steep = || dual(&[(7, 2), (7, 2)]);
    let closed = extreme::<T>(&bases::torus(4, 4), steep(), largest);
    let open = extreme::<T>(&bases::grid(1, 3), steep(), largest);
    for setup in [&closed, &open] {
        for levels in 1..=3 {
            assert_kind(setup.refine(&Context::serial(), levels), ErrorKind::Overflow);
        }
        let hierarchy = setup.hierarchy(3);
        for level in 1..=3 {
            let mut out = vec![T::default(); 3 * hierarchy.mesh(level).vertices()];
            let refined =
                hierarchy.refine(&Context::serial(), level, &setup.positions, 3, &mut out);
            assert_kind(refined, ErrorKind::Overflow);
        }
    }
}

#[test]
fn values_that_overflow_on_the_way_are_an_error() {
    check_overflow::<f64>(1.7e308);
    check_overflow::<f32>(3.4e38);
}

/// Only an attribute overflows; positions do not.
#[test]
fn attributes_that_overflow_are_an_error() {
    let setup = Setup::<f32>::new(&bases::torus(4, 4), dual(&[(7, 2), (7, 2)]));
    let values: Vec<f32> = (0..16).map(|i| if i % 2 == 0 { 3.4e38 } else { -3.4e38 }).collect();
    let attributes = [Attribute::vertex(&values, 1)];
    for levels in 1..=3 {
        let task = setup.task(levels, &attributes);
        assert_kind(Refiner::new().refine(&Context::serial(), &task), ErrorKind::Overflow);
    }
}

/// Means of what is in range are in range: no false alarm near the limit.
#[test]
fn large_values_that_stay_in_range_are_refined() {
    fn check<T: Scalar>(largest: f64) {
        for passes in [&[][..], &[(1, 2)], &[(0, 1)]] {
            let mut setup = extreme::<T>(&bases::torus(16, 16), dual(passes), largest);
            let refined = setup.refine(&Context::serial(), 3).expect("no overflow");
            assert!(refined.positions.iter().all(|x| x.to_f64().abs() <= largest));
            // Of one sign, nothing cancels on the way.
            setup.positions.fill(T::from_f64(largest));
            let refined = setup.refine(&Context::serial(), 3).expect("no overflow");
            assert!(refined.positions.iter().all(|x| x.to_f64() > 0.99 * largest));
        }
    }
    check::<f64>(1.6e308);
    check::<f32>(3e38);
}

/// Primal means add up before they divide: what leaves the range then is said.
#[test]
fn sums_that_leave_the_range_are_an_error() {
    for levels in 1..=3 {
        let mut setup = Setup::<f32>::new(&bases::torus(16, 16), Scheme::catmull_clark());
        setup.positions.fill(1.3e38);
        assert_kind(setup.refine(&Context::serial(), levels), ErrorKind::Overflow);
    }
}

// ---------------------------------------------------------------------- sizes

#[test]
fn sixty_four_levels_are_too_many_at_once() {
    let setup = cube(dual(&[(1, 2)]));
    for levels in [15, 16, 31, 64, 1 << 20, u32::MAX] {
        let begun = Instant::now();
        let mut refiner = Refiner::new();
        let task = setup.task(levels, &[]);
        let (refused, bytes) = peak_of(|| refiner.refine(&Context::serial(), &task));
        assert_kind(refused, ErrorKind::TooLarge);
        assert!(bytes < LITTLE, "{levels} levels took {bytes} bytes");
        assert_eq!(refiner.bytes(), 0);
        let (mesh, scheme) = (setup.mesh.clone(), setup.scheme.clone());
        let (refused, bytes) = peak_of(|| Hierarchy::new(&Context::serial(), mesh, scheme, levels));
        assert_kind(refused, ErrorKind::TooLarge);
        assert!(bytes < LITTLE, "{levels} levels took {bytes} bytes");
        assert!(begun.elapsed() < AT_ONCE);
    }
}

/// A mesh that does not grow: levels must have a limit of their own.
#[test]
fn levels_are_limited_where_nothing_grows() {
    let lone = Soup::new(3, &[[0, 1, 2]]).mesh(false);
    let scheme = dual(&[]).with_boundary(carvel::Boundary::None);
    for mesh in [lone, Soup::new::<Vec<usize>>(3, &[]).mesh(false)] {
        let (plan, bytes) = peak_of(|| Prediction::new(&mesh, &scheme, 1 << 20));
        assert!(plan.is_err() || bytes < LITTLE, "{bytes} bytes for a plan");
    }
}

#[test]
fn the_ceiling_is_kept_before_anything_is_allocated() {
    let setup = cube(dual(&[(1, 2)]));
    let context = Context::builder().memory_ceiling(1_000_000).build().expect("one thread");
    assert!(setup.refine(&context, 2).is_ok());
    let mut refiner = Refiner::new();
    let task = setup.task(9, &[]);
    let (refused, bytes) = peak_of(|| refiner.refine(&context, &task));
    let error = assert_kind(refused, ErrorKind::MemoryCeiling);
    assert!(bytes < LITTLE && refiner.bytes() == 0, "{bytes} bytes");
    check_both_sizes(&error, 1_000_000);
    let (mesh, scheme) = (setup.mesh.clone(), setup.scheme.clone());
    let (refused, bytes) = peak_of(|| Hierarchy::new(&context, mesh, scheme, 9));
    check_both_sizes(&assert_kind(refused, ErrorKind::MemoryCeiling), 1_000_000);
    assert!(bytes < LITTLE, "{bytes} bytes");
}

/// The text names what is needed and what is allowed.
fn check_both_sizes(error: &Error, ceiling: u64) {
    let text = error.to_string();
    let numbers: Vec<u64> =
        text.split(|c: char| !c.is_ascii_digit()).filter_map(|n| n.parse().ok()).collect();
    assert!(numbers.contains(&ceiling), "{text}");
    assert!(numbers.iter().any(|&n| n > ceiling), "{text}");
}

/// The same where the last levels are done in one step: a call fits the ceiling that it
/// asks for.
#[test]
fn patches_fit_their_ceiling() {
    let schemes = || [Scheme::catmull_clark(), dual(&[]), dual(&[(1, 2)])];
    for (levels, scheme) in (5..=7).flat_map(|levels| schemes().map(|scheme| (levels, scheme))) {
        let setup = Setup { scheme, ..cube(dual(&[])) };
        for width in [0, 8] {
            fits_its_ceiling(&setup, levels, width);
        }
    }
}

/// The same where most faces are no quads or lie beside one.
#[test]
fn tiles_of_many_triangles_fit_their_ceiling() {
    let control = bases::several(&bases::octahedron(), 40);
    for scheme in [dual(&[]), dual(&[(1, 2)])] {
        let setup = Setup::new(&control, scheme);
        let plan = Prediction::new(&setup.mesh, &setup.scheme, 3).expect("small");
        assert_eq!(plan.patch_depth(), 2);
        fits_its_ceiling(&setup, 3, 0);
    }
}

fn fits_its_ceiling(setup: &Setup<f64>, levels: u32, width: usize) {
    let wide = vec![0.5; setup.mesh.vertices() * width];
    let attributes = [Attribute::vertex(&wide, width.max(1))];
    let task = setup.task(levels, &attributes[..width.min(1)]);
    let refine = |ceiling: u64| {
        let context = Context::builder().memory_ceiling(ceiling).build().expect("one thread");
        Refiner::new().refine(&context, &task)
    };
    let text = assert_kind(refine(1), ErrorKind::MemoryCeiling).to_string();
    let needed: u64 = text
        .split(|c: char| !c.is_ascii_digit())
        .filter_map(|n| n.parse().ok())
        .max()
        .expect("a number of bytes");
    let (refined, used) = peak_of(|| refine(needed));
    refined.expect("a refinement");
    let used = used as u64;
    // Large arrays are rounded up to whole huge pages.
    assert!(used < needed + needed / 8 + (1 << 16), "{used} bytes used, {needed} asked for");
    assert!(needed < 2 * used + (1 << 20), "{used} bytes used, {needed} asked for");
}

/// What is predicted covers what is asked for, and not by far too much.
#[test]
fn predicted_memory_is_about_what_is_used() {
    for passes in [&[][..], &[(1, 2)], &[(0, 1), (1, 2)]] {
        let setup = cube(dual(passes));
        let plan = Prediction::new(&setup.mesh, &setup.scheme, 6).expect("small");
        let predicted = plan.output_bytes(3, 8) + plan.scratch_bytes(3, 8);
        let (refined, used) = peak_of(|| setup.refine(&Context::serial(), 6));
        refined.expect("a refinement");
        let used = used as u64;
        assert!(used < 2 * predicted, "{used} bytes used, {predicted} predicted");
        assert!(predicted < 2 * used, "{used} bytes used, {predicted} predicted");
    }
}

// ------------------------------------------------------------------- progress

#[test]
fn progress_rises_to_one() {
    for threads in [1, 3] {
        let seen = Arc::new(Mutex::new(Vec::new()));
        let sink = Arc::clone(&seen);
        let context = Context::builder()
            .threads(threads)
            .progress(move |done| {
                sink.lock().expect("no panic").push(done);
                true
            })
            .build()
            .expect("threads");
        let setup = cube(dual(&[(1, 2)]));
        setup.refine(&context, 5).expect("a refinement");
        check_progress(&std::mem::take(&mut *seen.lock().expect("no panic")));
        Hierarchy::new(&context, setup.mesh, setup.scheme, 5).expect("a hierarchy");
        check_progress(&seen.lock().expect("no panic"));
    }
}

fn check_progress(seen: &[f64]) {
    assert!(seen.len() > 1, "one report is no progress");
    assert!(seen.is_sorted(), "{seen:?}");
    assert!(seen.iter().all(|done| (0.0..=1.0).contains(done)), "{seen:?}");
    assert!(seen.last().is_some_and(|&last| last.to_bits() == 1.0_f64.to_bits()), "{seen:?}");
}

// ------------------------------------------------------------------ cancelling

#[test]
fn a_set_flag_stops_everything() {
    let setup = cube(dual(&[(1, 2)]));
    for threads in [1, 2] {
        let context = Context::builder().threads(threads).build().expect("threads");
        let flag = context.cancel_flag();
        flag.cancel();
        assert_kind(setup.refine(&context, 3), ErrorKind::Cancelled);
        let (mesh, scheme) = (setup.mesh.clone(), setup.scheme.clone());
        assert_kind(Hierarchy::new(&context, mesh, scheme, 3), ErrorKind::Cancelled);
        let hierarchy = setup.hierarchy(1);
        let mut out = vec![0.0; 3 * hierarchy.mesh(1).vertices()];
        let refined = hierarchy.refine(&context, 1, &setup.positions, 3, &mut out);
        assert_kind(refined, ErrorKind::Cancelled);
        flag.reset();
        assert!(setup.refine(&context, 3).is_ok(), "the context can be used again");
    }
}

#[test]
fn another_thread_stops_the_work() {
    let setup = cube(dual(&[(1, 2)]));
    let context = Context::builder().threads(2).build().expect("threads");
    let (flag, begun) = (context.cancel_flag(), AtomicBool::new(false));
    std::thread::scope(|scope| {
        scope.spawn(|| {
            while !begun.load(Ordering::Acquire) {
                std::thread::yield_now();
            }
            flag.cancel();
        });
        let error = loop {
            match setup.refine(&context, 4) {
                Ok(_) => begun.store(true, Ordering::Release),
                Err(error) => break error,
            }
        };
        assert_eq!(error.kind(), ErrorKind::Cancelled);
    });
}

/// A callback that lets `n` reports pass and says no to the next.
fn stopping_after(n: usize) -> Context {
    let left = Mutex::new(n);
    let callback = move |_| {
        let mut left = left.lock().expect("no panic");
        let go_on = *left > 0;
        *left = left.saturating_sub(1);
        go_on
    };
    Context::builder().threads(2).progress(callback).build().expect("threads")
}

/// Stopped anywhere, a refiner is as good as new.
#[test]
fn a_stopped_refiner_can_be_used_again() {
    let setup = Setup::<f64>::new(&bases::half_fan(7), dual(&[(0, 1), (1, 2)]));
    let expected = setup.refine(&Context::serial(), 4).expect("a refinement");
    let mut refiner = Refiner::new();
    for reports in 0..4 {
        let stopped = refiner.refine(&stopping_after(reports), &setup.task(4, &[]));
        assert_kind(stopped, ErrorKind::Cancelled);
        let again = refiner.refine(&Context::serial(), &setup.task(4, &[])).expect("unharmed");
        assert_same_bytes(&again, &expected, &format!("after {reports} reports"));
    }
}

// -------------------------------------------------------------------- lengths

/// Arrays for a task's output, each of them longer by its part of `extra`.
struct Arrays {
    face_sizes: Vec<u32>,
    face_sources: Vec<u32>,
    face_vertices: Vec<u32>,
    positions: Vec<f64>,
    attribute: Vec<f64>,
}

impl Arrays {
    fn new(plan: &Prediction, width: usize, extra: [isize; 5]) -> Self {
        let last = plan.last();
        let len = |n: u64, i: usize| (n as usize).checked_add_signed(extra[i]).expect("a length");
        Self {
            face_sizes: vec![0; len(last.faces, 0)],
            face_sources: vec![0; len(last.faces, 1)],
            face_vertices: vec![0; len(last.corners, 2)],
            positions: vec![0.0; len(3 * last.vertices, 3)],
            attribute: vec![0.0; len(width as u64 * last.vertices, 4)],
        }
    }

    fn output(&mut self) -> Output<'_, f64> {
        Output {
            face_sizes: Some(&mut self.face_sizes),
            face_vertices: Some(&mut self.face_vertices),
            face_sources: Some(&mut self.face_sources),
            positions: &mut self.positions,
            attributes: vec![&mut self.attribute],
            channels: Vec::new(),
        }
    }
}

#[test]
fn outputs_must_have_the_right_lengths() {
    let setup = cube(dual(&[(1, 2)]));
    let values = vec![0.5; 16];
    let attributes = [Attribute::vertex(&values, 2)];
    for levels in 0..3 {
        let plan = Prediction::new(&setup.mesh, &setup.scheme, levels).expect("small");
        let run = |extra: [isize; 5]| {
            let mut arrays = Arrays::new(&plan, 2, extra);
            let task = setup.task(levels, &attributes);
            Refiner::new().refine_into(&Context::serial(), &task, arrays.output())
        };
        assert!(run([0; 5]).is_ok());
        for i in 0..5 {
            for by in [-1, 1] {
                let mut extra = [0; 5];
                extra[i] = by;
                assert_kind(run(extra), ErrorKind::LengthMismatch);
            }
        }
        let mut arrays = Arrays::new(&plan, 2, [0; 5]);
        let output = Output { attributes: Vec::new(), ..arrays.output() };
        let task = setup.task(levels, &attributes);
        let missing = Refiner::new().refine_into(&Context::serial(), &task, output);
        assert_kind(missing, ErrorKind::LengthMismatch);
    }
}

#[test]
fn callers_arrays_get_what_own_arrays_would() {
    let setup = cube(dual(&[(0, 1), (1, 2)]));
    let values: Vec<f64> = (0..16).map(f64::from).collect();
    let attributes = [Attribute::vertex(&values, 2)];
    for levels in 0..4 {
        let task = setup.task(levels, &attributes);
        let own = Refiner::new().refine(&Context::serial(), &task).expect("a refinement");
        let plan = Prediction::new(&setup.mesh, &setup.scheme, levels).expect("small");
        let mut arrays = Arrays::new(&plan, 2, [0; 5]);
        let done = Refiner::new().refine_into(&Context::serial(), &task, arrays.output());
        done.expect("arrays of the right lengths");
        assert_eq!(arrays.face_sizes, own.face_sizes);
        assert_eq!(arrays.face_sources, own.face_sources);
        assert_eq!(arrays.face_vertices, own.face_vertices);
        assert_eq!(kernel::bits(&arrays.positions), kernel::bits(&own.positions));
        assert_eq!(kernel::bits(&arrays.attribute), kernel::bits(&own.attributes[0]));
    }
}

#[test]
fn inputs_must_have_the_right_lengths() {
    let mut setup = cube(dual(&[]));
    let values = vec![0.5; 16];
    let widths = |width| [Attribute::vertex(&values[..], width)];
    for levels in 0..2 {
        for width in [0, 1, 3] {
            let attributes = widths(width);
            let task = setup.task(levels, &attributes);
            let refused = Refiner::new().refine(&Context::serial(), &task);
            assert_kind(refused, ErrorKind::LengthMismatch);
        }
        let hierarchy = setup.hierarchy(levels);
        for width in [0, 1, 3] {
            let mut out = vec![0.0; width * hierarchy.mesh(levels).vertices()];
            let refused = hierarchy.refine(&Context::serial(), levels, &values, width, &mut out);
            assert_kind(refused, ErrorKind::LengthMismatch);
        }
        let mut short = vec![0.0; 2 * hierarchy.mesh(levels).vertices() - 1];
        let refused = hierarchy.refine(&Context::serial(), levels, &values, 2, &mut short);
        assert_kind(refused, ErrorKind::LengthMismatch);
    }
    setup.positions.pop();
    for levels in 0..2 {
        assert_kind(setup.refine(&Context::serial(), levels), ErrorKind::LengthMismatch);
    }
}

/// Sizes that only multiplied leave the range of `usize`.
#[test]
fn absurd_widths_are_refused() {
    let setup = cube(dual(&[]));
    for width in [usize::MAX, usize::MAX / 2, 1 << 61] {
        let attributes = [Attribute::vertex(&[][..], width)];
        for levels in 0..2 {
            let refused =
                Refiner::new().refine(&Context::serial(), &setup.task(levels, &attributes));
            assert_kind(refused, ErrorKind::LengthMismatch);
        }
        let refused = setup.hierarchy(0).refine(&Context::serial(), 0, &[], width, &mut [0.0; 0]);
        assert_kind(refused, ErrorKind::LengthMismatch);
    }
}

#[test]
fn levels_that_were_not_built_are_refused() {
    let setup = cube(dual(&[]));
    let hierarchy = setup.hierarchy(1);
    let refused = hierarchy.refine(&Context::serial(), 2, &setup.positions, 3, &mut [0.0; 0]);
    assert_kind(refused, ErrorKind::ParameterOutOfRange);
    for level in [0, 2] {
        assert_kind(hierarchy.vertex_origins(level), ErrorKind::ParameterOutOfRange);
        assert_kind(hierarchy.face_origins(level), ErrorKind::ParameterOutOfRange);
        let rows = hierarchy.each_row::<f64>(level, |_, _, _| panic!("no row"));
        assert_kind(rows, ErrorKind::ParameterOutOfRange);
    }
}

// ------------------------------------------------------------------ degenerate

/// No faces: isolated vertices pass unchanged, and none at all are no error.
#[test]
fn meshes_without_faces_are_refined() {
    for vertices in [0, 1, 5] {
        let positions: Vec<f64> = (0..3 * vertices).map(|i| i as f64).collect();
        let mesh = Soup::new::<Vec<usize>>(vertices, &[]).mesh(false);
        let scheme = dual(&[(1, 2), (0, 1)]);
        for levels in 0..4 {
            let refined = kernel::refine_mesh(&mesh, &scheme, levels, &positions);
            assert!(refined.face_sizes.is_empty() && refined.face_vertices.is_empty());
            assert_eq!(kernel::bits(&refined.positions), kernel::bits(&positions));
            let context = Context::serial();
            let hierarchy = Hierarchy::new(&context, mesh.clone(), scheme.clone(), levels);
            let hierarchy = hierarchy.expect("a hierarchy of nothing");
            let made = kernel::refine_values(&hierarchy, levels, &positions, 3);
            assert_eq!(kernel::bits(&made), kernel::bits(&positions));
        }
    }
}

/// Level 0 is a copy, in the mesh's own face order.
#[test]
fn level_zero_is_the_control_mesh() {
    let control = bases::prism(5);
    let setup = Setup::<f32>::new(&control, dual(&[(1, 2)]));
    let refined = setup.refine(&Context::serial(), 0).expect("a copy");
    assert_eq!(kernel::faces_of(&refined), kernel::faces(&setup.mesh));
    assert_eq!(kernel::bits(&refined.positions), kernel::bits(&setup.positions));
    assert_eq!(refined.face_sources, (0..setup.mesh.faces() as u32).collect::<Vec<_>>());
    assert!(!refined.anchored, "nothing was laid");
    let anchored = bases::grid(2, 2);
    let mesh = Soup::new(9, &anchored.faces).mesh(true);
    let copy = kernel::refine_mesh(&mesh, &setup.scheme, 0, &kernel::coordinates::<f64>(&anchored));
    assert!(copy.anchored, "the flag is kept");
}

#[test]
fn schemes_have_ranges() {
    let fraction = |p, q| Fraction::new(p, q).expect("a fraction");
    let refused = [
        Scheme::three_point(fraction(-1, 1000)),
        Scheme::three_point(fraction(1, 15)),
        Scheme::b_spline(0),
        Scheme::b_spline(66),
        Scheme::dual(&[fraction(1001, 1)]),
        Scheme::dual(&[Fraction::ZERO; 65]),
    ];
    for scheme in refused {
        assert_kind(scheme, ErrorKind::ParameterOutOfRange);
    }
    assert_eq!(Scheme::three_point(fraction(0, 1)).expect("in range").passes(), [Fraction::ONE]);
    assert!(Scheme::dual(&[fraction(-1000, 1)]).is_ok());
    assert!(Scheme::dual(&[Fraction::ZERO; 64]).is_ok());
}

/// Wide attributes are written a few lanes at a time; the others are not looked at.
#[test]
fn what_an_output_held_before_does_not_matter() {
    let mesh = Mesh::from_polygons(3, &[3], &[0, 1, 2]).expect("a triangle");
    let (scheme, context) = (Scheme::doo_sabin(), Context::serial());
    let positions = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];
    // So large that every level is watched for overflow.
    let mut values = [0.0; 15];
    values[10] = f64::MAX;
    let attributes = [Attribute::vertex(&values[..], 5)];
    let task = Task { attributes: &attributes, ..Task::new(&mesh, &scheme, 1, &positions) };
    let last = *Prediction::new(&mesh, &scheme, 1).expect("it fits").last();
    let refined = |held: f64| {
        let mut out = vec![held; 5 * last.vertices as usize];
        let mut points = vec![held; 3 * last.vertices as usize];
        let output = Output {
            face_sizes: None,
            face_vertices: None,
            face_sources: None,
            positions: &mut points,
            attributes: vec![&mut out],
            channels: Vec::new(),
        };
        Refiner::new().refine_into(&context, &task, output).map(|()| out)
    };
    let expected = refined(0.0).expect("no overflow");
    assert_eq!(refined(f64::NAN).expect("no overflow"), expected);
}

#[test]
fn too_many_threads_are_refused() {
    let refused = Context::builder().threads(100_000).build();
    assert_kind(refused, ErrorKind::ParameterOutOfRange);
}

/// A channel knows its mesh by the vertices of the corners, not by their number.
#[test]
fn channels_of_other_meshes_are_refused() {
    let apart = Mesh::from_polygons(8, &[4, 4], &[0, 1, 2, 3, 4, 5, 6, 7]).expect("two quads");
    let strip = Mesh::from_polygons(6, &[4, 4], &[0, 1, 4, 3, 1, 2, 5, 4]).expect("a strip");
    let mode = carvel::FaceVaryingMode::default();
    let channel = carvel::Channel::new(&apart, &[0; 8], 1, mode).expect("a channel");
    let (scheme, values) = (Scheme::catmull_clark(), [0.0]);
    let channels = [carvel::FaceVarying { channel: &channel, values: &values, width: 1 }];
    let refine = |mesh: &Mesh| {
        let positions = vec![0.0; 3 * mesh.vertices()];
        let task = Task { channels: &channels, ..Task::new(mesh, &scheme, 1, &positions) };
        Refiner::new().refine(&Context::serial(), &task).map(|refined| refined.channels.len())
    };
    assert_eq!(refine(&apart).expect("its own mesh"), 1);
    assert_kind(refine(&strip), ErrorKind::LengthMismatch);
}

/// Every pair of vertex and value has a record of its own while it is refined.
#[test]
fn shared_values_count_once_for_each_vertex() {
    let mesh = Mesh::from_polygons(4, &[4], &[0, 1, 2, 3]).expect("a quad");
    let mode = carvel::FaceVaryingMode::default();
    let channel = carvel::Channel::new(&mesh, &[0; 4], 1, mode).expect("a channel");
    let (scheme, values, positions) = (Scheme::bilinear(), vec![0.0; 4096], [0.0; 12]);
    let channels = [carvel::FaceVarying { channel: &channel, values: &values, width: 4096 }];
    let task = Task { channels: &channels, ..Task::new(&mesh, &scheme, 1, &positions) };
    let ceiling = |bytes| Context::builder().memory_ceiling(bytes).build().expect("a context");
    // Nine values and the copies of four, each of 4096 doubles.
    let refined = Refiner::new().refine(&ceiling(13 * 4096 * 8), &task);
    assert_kind(refined, ErrorKind::MemoryCeiling);
    assert!(Refiner::new().refine(&ceiling(40 * 4096 * 8), &task).is_ok());
}
