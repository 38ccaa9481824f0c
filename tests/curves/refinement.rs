//! Polygons: rules, ends, number types, threads.

use carvel::Context;
use carvel::curve::rational::{from_f64, ratio};
use carvel::curve::{Coordinate, Ends, Mask, Polygon, Rational};
use num_traits::Zero;

use crate::rng::Rng;
use crate::support::{list, named};

/// Coordinates in doubles against exact ones, relative to the largest.
const ROUNDING: f64 = 1e-14;
/// The same in singles.
const SINGLE: f64 = 1e-6;

fn context() -> Context {
    Context::serial()
}

fn random_points(n: usize, width: usize, seed: u64) -> Vec<Rational> {
    let mut rng = Rng::new(seed);
    (0..n * width).map(|_| ratio(rng.integer(10_000), 64)).collect()
}

/// A mask of any arity that satisfies the sum rule and is not symmetric.
fn random_mask(arity: usize, length: usize, offset: i64, rng: &mut Rng) -> Mask {
    let mut coefficients: Vec<_> = (0..length).map(|_| ratio(rng.integer(40), 16)).collect();
    for residue in 0..arity {
        let rest: Rational = coefficients.iter().skip(residue + arity).step_by(arity).sum();
        coefficients[residue] = ratio(1, 1) - rest;
    }
    Mask::new(arity, offset, coefficients).expect("a mask")
}

/// qᵢ = Σⱼ a₍ᵢ₋ₘⱼ₎ pⱼ as it stands; `None` where a point that is needed does not exist.
fn by_definition(mask: &Mask, i: i64, point: impl Fn(i64) -> Option<Rational>) -> Option<Rational> {
    let m = mask.arity() as i64;
    let mut sum = Rational::zero();
    for (k, a) in (mask.offset()..).zip(mask.coefficients()) {
        if (i - k).rem_euclid(m) == 0 && !a.is_zero() {
            sum += a * point((i - k).div_euclid(m))?;
        }
    }
    Some(sum)
}

fn masks() -> Vec<Mask> {
    let mut rng = Rng::new(7);
    let sizes = [(2, 2, 0), (2, 5, -3), (2, 9, 4), (3, 7, -2), (3, 4, 1), (4, 13, -6), (5, 5, 0)];
    let random = sizes.map(|(arity, length, offset)| random_mask(arity, length, offset, &mut rng));
    let known = ["chaikin", "four-point", "three-point", "ternary-four-point", "b-spline:2,4"];
    random.into_iter().chain(known.map(named)).collect()
}

#[test]
fn closed_polygons_follow_the_definition() {
    for (s, mask) in masks().iter().enumerate() {
        for (n, width) in [(1, 1), (2, 3), (7, 2), (40, 5)] {
            let points = random_points(n, width, s as u64);
            let polygon = Polygon::new(points.clone(), width, Ends::Closed);
            let refined = polygon.refine(&context(), mask, 1).expect("points");
            assert_eq!(refined.len(), n * mask.arity());
            for i in 0..refined.len() {
                for c in 0..width {
                    let point =
                        |j: i64| Some(points[j.rem_euclid(n as i64) as usize * width + c].clone());
                    let expected = by_definition(mask, i as i64, point).expect("all exist");
                    assert_eq!(refined.point(i)[c], expected, "{mask:?}, point {i}");
                }
            }
        }
    }
}

#[test]
fn dropped_ends_are_those_that_lack_points() {
    for (s, mask) in masks().iter().enumerate() {
        let n = 12_i64;
        let points = random_points(n as usize, 1, 100 + s as u64);
        let point = |j: i64| usize::try_from(j).ok().and_then(|j| points.get(j)).cloned();
        let polygon = Polygon::new(points.clone(), 1, Ends::Dropped);
        let refined = polygon.refine(&context(), mask, 1).expect("points");
        // The longest run of points that can be made.
        let m = mask.arity() as i64;
        let all: Vec<_> = (-40 * m..40 * m).map(|i| by_definition(mask, i, point)).collect();
        let runs = all.split(Option::is_none).max_by_key(|run| run.len()).expect("a run");
        let expected: Vec<_> = runs.iter().flatten().cloned().collect();
        assert_eq!(refined.points, expected, "{mask:?}");
    }
}

/// Ends that stay: the odd extension of the control polygon is refined without ends, and
/// what lies between the ends is cut out, whatever the level.
#[test]
fn kept_ends_are_the_odd_extension() {
    let masks = [
        "chaikin",
        "three-point",
        "dyn-floater-hormann",
        "four-point",
        "b-spline:3",
        "b-spline:2,3",
        "even-point-approximating:0,3",
        "ternary-four-point",
        "even-point-approximating:0,4",
        "b-spline:3,4",
    ];
    for (s, name) in masks.iter().enumerate() {
        let mask = named(name);
        for n in [2_i64, 3, 6] {
            let points = random_points(n as usize, 1, 200 + s as u64);
            check_kept(name, &mask, &points);
        }
    }
}

fn check_kept(name: &str, mask: &Mask, points: &[Rational]) {
    let (n, m) = (points.len() as i64, mask.arity() as i64);
    // One period of the extension: p₍ᵢ₊₂ₙ₋₂₎ = pᵢ + 2(pₙ₋₁ − p₀).
    let extended = |j: i64| {
        let (lap, within) = (j.div_euclid(2 * n - 2), j.rem_euclid(2 * n - 2));
        let rise = (&points[n as usize - 1] - &points[0]) * ratio(2, 1);
        let base = if within < n {
            points[within as usize].clone()
        } else {
            let image = points[(2 * n - 2 - within) as usize].clone();
            &points[n as usize - 1] * ratio(2, 1) - image
        };
        base + rise * ratio(lap, 1)
    };
    let wide = 60;
    let mut line: Vec<Rational> = (-wide..n + wide).map(extended).collect();
    // Twice the place of the first point of the line, in intervals of its level.
    let mut twice_first = -2 * wide;
    let mut polygon = Polygon::new(points.to_vec(), 1, Ends::Kept);
    for level in 1..=3 {
        // New point i belongs to (i − c)/m; the dropped ones are told by the first made.
        let dropped = Polygon::new(line, 1, Ends::Dropped);
        let refined = dropped.refine(&context(), mask, 1).expect("long enough");
        let twice_centre = mask.offset() * 2 + mask.coefficients().len() as i64 - 1;
        twice_first = m * twice_first + 2 * first_complete(mask) - twice_centre;
        line = refined.points;
        polygon = polygon.refine(&context(), mask, 1).expect("points");
        let length = 2 * (n - 1) * m.pow(level);
        let places = (0..line.len() as i64).map(|i| twice_first + 2 * i);
        let inside = places.zip(&line).filter(|(place, _)| (0..=length).contains(place));
        let mut expected: Vec<_> = inside.map(|(_, x)| x.clone()).collect();
        if twice_first.rem_euclid(2) == 1 {
            expected.insert(0, points[0].clone());
            expected.push(points[n as usize - 1].clone());
            assert_eq!(polygon.ends, Ends::Anchored, "{name}, level {level}");
        } else {
            assert_eq!(polygon.ends, Ends::Kept, "{name}, level {level}");
        }
        assert_eq!(polygon.points, expected, "{name}, {n} points, level {level}");
    }
}

/// The first new point that needs no old point before 0, and none after it does.
fn first_complete(mask: &Mask) -> i64 {
    let m = mask.arity() as i64;
    let needs = |i: i64| {
        let exists = |j: i64| (j >= 0).then(Rational::zero);
        by_definition(mask, i, exists).is_none()
    };
    (-20 * m..20 * m).rev().find(|&i| needs(i)).expect("one that needs more") + 1
}

#[test]
fn the_first_points_of_the_specification() {
    let mask = named("three-point:1/32");
    let p = random_points(5, 1, 3);
    let once = Polygon::new(p.clone(), 1, Ends::Kept).refine(&context(), &mask, 1).expect("one");
    let twice = once.refine(&context(), &mask, 1).expect("two");
    let of = |terms: &[(i64, &Rational)], over: i64| {
        terms.iter().map(|(w, x)| ratio(*w, over) * *x).sum::<Rational>()
    };
    assert_eq!(once.points[..2], [p[0].clone(), of(&[(3, &p[0]), (1, &p[1])], 4)]);
    let q = &once.points;
    let first = of(&[(18, &p[0]), (13, &q[1]), (1, &q[2])], 32);
    let second = of(&[(2, &p[0]), (21, &q[1]), (9, &q[2])], 32);
    assert_eq!(twice.points[1..3], [first, second]);
}

fn kinds() -> [Ends; 3] {
    [Ends::Closed, Ends::Dropped, Ends::Kept]
}

#[test]
fn steps_at_once_are_steps_one_by_one() {
    for name in ["three-point", "four-point", "even-point-approximating:0,3", "ternary-four-point"]
    {
        let mask = named(name);
        for ends in kinds() {
            let control = Polygon::new(random_points(9, 2, 5), 2, ends);
            let at_once = control.refine(&context(), &mask, 3).expect("points");
            let one = |p: Polygon<Rational>| p.refine(&context(), &mask, 1).expect("points");
            assert_eq!(at_once, one(one(one(control.clone()))), "{name}, {ends:?}");
            let predicted = Polygon::<f64>::predict(&mask, 9, ends, 3).expect("a number");
            assert_eq!(predicted, (at_once.len(), at_once.ends));
            assert_eq!(control.refine(&context(), &mask, 0).expect("a copy"), control);
        }
    }
}

fn check_number<T: Coordinate>(tolerance: f64) {
    for name in ["three-point", "four-point", "b-spline:4,3", "deslauriers-dubuc:4", "b-spline:2"] {
        let mask = named(name);
        for (ends, width) in kinds().into_iter().flat_map(|e| (1..=6).map(move |w| (e, w))) {
            // Long enough for two blocks.
            let exact = random_points(800 / width + 20, width, 11);
            let rounded = exact.iter().map(T::from_rational).collect();
            let control = Polygon::<T>::new(rounded, width, ends);
            let exact = control.points.iter().map(|x| from_f64(x.to_f64()).expect("finite"));
            let exact = Polygon::new(exact.collect(), width, ends);
            let made = control.refine(&context(), &mask, 1).expect("points");
            let expected = exact.refine(&context(), &mask, 1).expect("points");
            assert_eq!(made.points.len(), expected.points.len());
            for (a, b) in made.points.iter().zip(&expected.points) {
                let apart = (a.to_f64() - b.to_f64()).abs();
                assert!(apart <= tolerance * 160.0, "{name}, {ends:?}: {a:?} for {b:?}");
            }
        }
    }
}

#[test]
fn doubles_are_the_exact_points_rounded() {
    check_number::<f64>(ROUNDING);
}

#[test]
fn singles_are_the_exact_points_rounded() {
    check_number::<f32>(SINGLE);
}

#[test]
fn threads_and_buffers_change_no_bit() {
    let threads = Context::builder().threads(4).chunk(37).build().expect("threads");
    for (name, ends) in
        ["three-point", "b-spline:4,3"].into_iter().flat_map(|n| kinds().map(|e| (n, e)))
    {
        let mask = named(name);
        let points = random_points(3000, 3, 17).iter().map(f64::from_rational).collect();
        let control = Polygon::<f64>::new(points, 3, ends);
        let alone = control.refine(&context(), &mask, 2).expect("points");
        assert_eq!(control.refine(&threads, &mask, 2).expect("points"), alone);
        let once = control.refine(&context(), &mask, 1).expect("points");
        let mut out = vec![0.0; once.points.len()];
        let after = control.refine_into(&threads, &mask, &mut out).expect("room");
        assert_eq!((out, after), (once.points, once.ends));
    }
}

#[test]
fn a_mask_read_from_text_is_its_rules() {
    let mask = Mask::parse("-5/128,-7/128,35/128,105/128,105/128,35/128,-7/128,-5/128", 2, None);
    let mask = mask.expect("a mask");
    assert_eq!(mask, named("dyn-floater-hormann"));
    let weights = |e| mask.taps(e).into_iter().map(|tap| tap.weight).collect::<Vec<_>>();
    assert_eq!(weights(0), list("-7/128 105/128 35/128 -5/128"));
    assert_eq!(weights(1), list("-5/128 35/128 105/128 -7/128"));
}
