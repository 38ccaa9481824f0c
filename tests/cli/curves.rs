//! `carvel curve`: polygons and grids in, refined ones out.

use super::bench::Bench;
use carvel::Context;
use carvel::curve::{Ends, Polygon, Rational, catalogue, rational};

const SQUARE: &str = "x,y\n0,0\n1,0\n1,1\n0,1\n";

/// Chaikin's first step, by hand.
#[test]
fn a_square_by_chaikin_exactly() {
    let bench = Bench::new();
    bench.put("square.csv", SQUARE);
    let run = "curve square.csv -o - --closed --mask [1,3,3,1]/4 -n 1 --precision exact";
    let run = bench.run(run).ok();
    let points = "1/4,0\n3/4,0\n1,1/4\n1,3/4\n3/4,1\n1/4,1\n0,3/4\n0,1/4\n";
    let found = run.out_text().strip_prefix("x,y\n").expect("the header stays");
    // The rule of even points begins a point earlier.
    let mut lines: Vec<&str> = found.lines().collect();
    let mut expected: Vec<&str> = points.lines().collect();
    lines.sort_unstable();
    expected.sort_unstable();
    assert_eq!(lines, expected);
    let json = bench.run("curve square.csv -o out.csv --closed -n 3 --json").ok().json();
    assert_eq!(json["polygons"][0]["control"]["points"], 4);
    assert_eq!(json["polygons"][0]["refined"]["points"], 32);
    assert_eq!((&json["dimension"], &json["format"]), (&2.into(), &"csv".into()));
}

/// A polygon of one place is refined, with a note: nothing of it can be seen in a picture.
#[test]
fn polygons_of_one_place_are_noted() {
    let bench = Bench::new();
    bench.put("one.csv", "1,2\n1,2\n1,2\n").put("two.csv", "0,0\n1,0\n\n2,2\n2,2\n");
    bench.put("level.csv", "5\n5\n5\n");
    for (input, output) in [("one.csv", "one.svg"), ("two.csv", "two.csv")] {
        let run = bench.run(&format!("curve {input} -o {output}")).ok();
        assert!(run.err.contains("in 1 polygon all points are at one place"), "{}", run.err);
    }
    let run = bench.run("curve one.csv -o out.csv --closed -n 2 --json").ok();
    assert_eq!(run.json()["notes"].as_array().unwrap().len(), 2, "{}", run.err);
    let run = bench.run("curve level.csv -o out.csv").ok();
    assert!(!run.err.contains("note"), "{}", run.err);
}

/// Exponents are exact in masks, parameters and points alike.
#[test]
fn exponents_are_exact() {
    let bench = Bench::new();
    bench.put("square.csv", SQUARE);
    let run = |mask: &str| {
        bench.run(&format!("curve square.csv -o - --closed {mask} --precision exact")).ok().out
    };
    assert_eq!(run("--mask 25e-2,7.5E-1,75e-2,2.5e-1"), run("--mask [1,3,3,1]/4"));
    assert_eq!(run("--scheme four-point:6.25e-2"), run("--scheme four-point:1/16"));
    bench.run("curve square.csv -o - --mask 1e500,1").fails(2, "exponent beyond");
}

#[test]
fn every_stationary_scheme_is_what_the_library_makes() {
    let bench = Bench::new();
    let control = [0.0, 0.0, 1.0, 2.5, -1.0, 0.5, 2.0, 0.0, 1.0, 3.0, 3.5, -2.0, 4.0, 1.0, 0.5];
    let line = |p: &[f64]| format!("{};{};{}\n", p[0], p[1], p[2]);
    let text = control.chunks(3).map(line).collect::<Vec<_>>().concat();
    bench.put("in.csv", text);
    for name in ["four-point:1/16", "ternary-four-point", "b-spline:4", "hormann-sabin:5"] {
        for (option, ends) in [
            ("--closed", Ends::Closed),
            ("--open kept", Ends::Kept),
            ("--open dropped", Ends::Dropped),
            ("", Ends::Kept),
        ] {
            bench.run(&format!("curve in.csv -o out.csv --scheme {name} -n 2 {option}")).ok();
            let mask = catalogue::mask(name).unwrap();
            let polygon = Polygon::new(control.to_vec(), 3, ends);
            let expected = polygon.refine(&Context::serial(), &mask, 2).unwrap();
            assert_eq!(numbers(&bench.get("out.csv")), expected.points, "{name} {option}");
        }
    }
    bench.run("curve in.csv -o out.csv --limit -n 1 --precision f32").ok();
    let control: Vec<f32> = control.iter().map(|&x| x as f32).collect();
    let mask = catalogue::mask("three-point").unwrap();
    let refined = Polygon::new(control, 3, Ends::Kept).refine(&Context::serial(), &mask, 1);
    let limit = refined.unwrap().limit(&Context::serial(), &mask, 0).unwrap();
    let found: Vec<f32> = numbers(&bench.get("out.csv")).iter().map(|&x| x as f32).collect();
    assert_eq!(found, limit.points);
}

fn numbers(csv: &[u8]) -> Vec<f64> {
    let text = std::str::from_utf8(csv).unwrap();
    text.split([',', '\n']).filter(|field| !field.is_empty()).map(|x| x.parse().unwrap()).collect()
}

/// Points on a circle go to points on it, under v = cos of the angle between them.
#[test]
fn tension_keeps_a_circle() {
    let bench = Bench::new();
    let angle = |i: i32| std::f64::consts::TAU * f64::from(i) / 6.0;
    let line = |i: i32| format!("{} {}\n", angle(i).cos(), angle(i).sin());
    let hexagon = (0..6).map(line).collect::<Vec<_>>().concat();
    bench.put("hexagon.txt", hexagon);
    for scheme in ["tension-four-point:1/2", "tension-four-point:.5,.5,.5,.5,.5,.5"] {
        bench.run(&format!("curve hexagon.txt -o out.csv --closed --scheme {scheme}")).ok();
        let points = numbers(&bench.get("out.csv"));
        assert_eq!(points.len(), 2 * 6 * 16);
        for point in points.chunks(2) {
            assert!((point[0].hypot(point[1]) - 1.0).abs() < 1e-14, "{scheme}: {point:?}");
        }
    }
    // Equal edges make uniform parameters, and Dubuc's scheme.
    bench.run("curve hexagon.txt -o a.csv --closed --scheme non-uniform-four-point:1").ok();
    bench.run("curve hexagon.txt -o b.csv --closed --scheme four-point").ok();
    let (a, b) = (numbers(&bench.get("a.csv")), numbers(&bench.get("b.csv")));
    assert!(a.iter().zip(&b).all(|(a, b)| (a - b).abs() < 1e-14) && a.len() == b.len());
}

#[test]
fn lines_of_an_obj_stay_lines() {
    let bench = Bench::new();
    let edges = "v 0 0 0\nv 1 0 0\nv 1 1 1\nv 5 5 5\nv 6 5 5\nl 1 2\nl 3 2\nl 1 3\nl 4 5\n";
    bench.put("in.obj", edges);
    let json = bench.run("curve in.obj -o out.obj --scheme chaikin -n 1 --json").ok().json();
    let ends = |i: usize| json["polygons"][i]["control"]["ends"].clone();
    assert_eq!((ends(0), ends(1)), ("closed".into(), "kept".into()));
    let text = String::from_utf8(bench.get("out.obj")).unwrap();
    let lines: Vec<&str> = text.lines().filter(|line| line.starts_with('l')).collect();
    assert_eq!(lines, ["l 1 2 3 4 5 6 1", "l 7 8 9 10"]);
    assert_eq!(text.lines().filter(|line| line.starts_with("v ")).count(), 10);
    assert!(text.contains("v 5.25 5.0 5.0\n") && text.contains("v 6.0 5.0 5.0\n"), "{text}");
    // The file can be refined again.
    bench.run("curve out.obj -o again.csv --scheme chaikin -n 1").ok();
}

/// A grid's refinement is the polygons' in one direction, then in the other.
#[test]
fn grids_are_refined_both_ways() {
    let bench = Bench::new();
    let rows: [[i64; 3]; 4] = [[0, 1, 5], [2, -1, 3], [4, 4, 4], [7, 0, 1]];
    let text = rows.map(|row| row.map(|x| format!("{x}\n")).concat()).join("\n");
    bench.put("grid.csv", text);
    bench.run("curve grid.csv -o out.csv --grid -n 1 --precision exact --scheme chaikin").ok();
    let text = String::from_utf8(bench.get("out.csv")).unwrap();
    let found: Vec<Vec<Rational>> = text
        .split("\n\n")
        .map(|row| row.lines().map(|x| rational::parse(x).unwrap()).collect())
        .collect();
    let mask = catalogue::mask("chaikin").unwrap();
    let step = |line: Vec<Rational>| {
        Polygon::new(line, 1, Ends::Kept).refine(&Context::serial(), &mask, 1).unwrap().points
    };
    let along: Vec<Vec<Rational>> =
        rows.iter().map(|row| step(row.iter().map(|&x| rational::ratio(x, 1)).collect())).collect();
    for column in 0..along[0].len() {
        let expected = step(along.iter().map(|row| row[column].clone()).collect());
        let got: Vec<Rational> = found.iter().map(|row| row[column].clone()).collect();
        assert_eq!(got, expected, "column {column}");
    }
    bench.run("curve grid.csv -o out.obj --grid -n 1").ok();
    let mesh = bench.mesh("out.obj");
    assert_eq!((mesh.positions.len(), mesh.face_sizes.len()), (8 * 6, 7 * 5));
    bench.put("ragged.csv", "1\n2\n\n3\n");
    bench.run("curve ragged.csv -o out.csv --grid").fails(4, "row 2 has 1 points");
}

#[test]
fn pictures_show_polygons_and_limits() {
    let bench = Bench::new();
    bench.put("square.csv", SQUARE).put("line.csv", "1\n3\n2\n");
    bench.run("curve square.csv -o out.svg --closed").ok();
    let svg = String::from_utf8(bench.get("out.svg")).unwrap();
    assert!(
        svg.starts_with("<svg width=\"640\" height=\"480\" viewBox=\"0 0 6400 4800\""),
        "{svg}"
    );
    // Five control points, as the first comes back, and five of the limit.
    assert_eq!(svg.matches("<circle").count(), 10);
    let lines = |svg: &str| svg.matches("<polyline").count();
    assert_eq!(lines(&svg), 2);
    bench.run("curve line.csv -o out.png").ok();
    let png = bench.get("out.png");
    assert_eq!((&png[1..4], &png[16..24]), (&b"PNG"[..], &[0, 0, 2, 128, 0, 0, 1, 224][..]));
    // Without a proof that it converges no limit is shown.
    bench.run("curve square.csv -o out.svg --closed --mask [1,0,0,0,1,2]/2").ok();
    let svg = String::from_utf8(bench.get("out.svg")).unwrap();
    assert_eq!(svg.matches("<circle").count(), 5, "{svg}");
}

#[test]
fn what_is_wrong_is_named() {
    let bench = Bench::new();
    bench.put("square.csv", SQUARE).put("bad.csv", "0,0\n1\n").put("nan.csv", "0\nNaN\n");
    bench.put("huge.csv", "0\n1e39\n").put("empty.csv", "\n").put("word.csv", "0 0\n0 zero\n");
    bench.put("mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").put("one.csv", "1,2\n");
    bench.put("same.csv", "0,0\n0,0\n1,1\n").put("wide.csv", "1,2,3,4\n2,3,4,5\n");
    bench.put("raw.csv", [0xff, 0xfe, 0x00]).put("vast.csv", "0\n1e999\n");
    bench.put("long.csv", format!("0,0\n{0},1\n{0},2\n", "9".repeat(400)));
    for (arguments, code, words) in [
        ("square.csv -o out.xyz", 2, "out.xyz: the format is none of csv, obj, svg, png"),
        ("square.ply -o out.csv", 2, "square.ply: the format is none of csv, obj"),
        ("none.csv -o out.csv", 3, "none.csv"),
        ("square.csv -o nowhere/out.csv", 7, "there is no directory nowhere"),
        ("bad.csv -o out.csv", 3, "bad.csv: line 2: 1 coordinates, after points of 2"),
        ("word.csv -o out.csv", 3, "word.csv: line 2: 'zero' is not a number"),
        ("nan.csv -o out.csv", 5, "nan.csv: line 2"),
        ("huge.csv -o out.csv --precision f32", 5, "huge.csv: line 2"),
        ("vast.csv -o out.csv --precision exact", 5, "vast.csv: line 2"),
        ("vast.csv -o out.csv", 5, "vast.csv: line 2"),
        ("long.csv -o out.obj --precision exact", 5, "as a number of OBJ"),
        ("empty.csv -o out.csv", 4, "the file holds no points"),
        ("raw.csv -o out.csv", 3, "not a text in UTF-8"),
        ("mesh.obj -o out.csv", 4, "the file holds no lines (l)"),
        ("square.csv -o out.csv --memory 10", 6, "the ceiling is 10"),
        ("square.csv -o out.csv --memory 50", 6, "the ceiling is 50"),
        ("/dev/zero -o out.csv --input-format csv --memory 3M", 6, "the ceiling is 3145728"),
        ("one.csv -o out.csv", 4, "a polygon (kept) needs 2 or more points, not 1"),
        ("one.csv -o out.csv --open dropped", 4, "too few points, 1, for a rule"),
        ("wide.csv -o out.obj", 2, "OBJ has 3 coordinates, the points have 4"),
        ("same.csv -o out.csv --scheme non-uniform-four-point:1", 2, "interval of edge 0 is 0"),
        ("square.csv -o out.csv --scheme tension-four-point:1,1", 4, "2 values for 3 edges"),
        ("square.csv -o out.csv --scheme tension-four-point:-1", 2, "tension -1 is out of range"),
        ("square.csv -o out.csv --scheme tension-four-point:x", 2, "'x' is not a number"),
        ("square.csv -o out.csv --scheme non-uniform-four-point:2", 2, "exponent 2"),
        (
            "square.csv -o out.csv --scheme non-uniform-four-point:0,1",
            2,
            "too many parameters, 2: non-uniform-four-point has 1",
        ),
        ("square.csv -o out.csv --scheme chakin", 2, "'chaikin' is near it"),
        ("square.csv -o out.csv --scheme b-spline:0", 2, "degree = 0"),
        ("square.csv -o out.csv --mask 1,1,1", 2, "sum rule"),
        ("square.csv -o out.csv --mask 1,1 --arity 0", 2, "arity 0"),
        ("square.csv -o out.csv --mask 1/2,pi", 2, "'pi' is not a number"),
        ("square.csv -o out.csv --mask [1,2,3,3]/4", 2, "sum rule"),
        ("square.csv -o out.csv --mask [2,3,2,1]/4", 4, "symmetric masks only"),
        ("square.csv -o out.svg --grid", 2, "not grids"),
        ("square.csv -o out.csv --grid --limit", 2, "--limit is for polygons"),
        ("square.csv -o out.csv --limit --scheme tension-four-point", 2, "--limit needs a mask"),
        ("square.csv -o out.csv --scheme tension-four-point --precision exact", 2, "roots"),
        ("square.csv -o out.csv --closed --mask [1,0,0,0,1,2]/2 --limit", 4, "not proved"),
        ("square.csv -o out.csv -n 64", 6, "points"),
    ] {
        bench.run(&format!("curve {arguments}")).fails(code, words);
    }
    for arguments in ["--closed --open kept", "--mask 1,1 --scheme chaikin", "--arity 3", "-n 65"] {
        let run = bench.run(&format!("curve square.csv -o out.csv {arguments}"));
        assert_eq!(run.code, 2, "{arguments}: {}", run.err);
    }
    assert!(!bench.files().iter().any(|name| name.starts_with("out")), "{:?}", bench.files());
}

#[test]
fn points_that_come_back_are_left_out_once() {
    let bench = Bench::new();
    bench.put("in.csv", "0,0\n1,0\n1,1\n0,0\n");
    let run = bench.run("curve in.csv -o out.csv --closed --scheme four-point -n 1").ok();
    assert!(run.err.contains("repeats the first"), "{}", run.err);
    assert_eq!(numbers(&bench.get("out.csv")).len(), 12);
    let run = bench.run_with_input("curve - -o - -n 0", b"1 2\n3 4\n").ok();
    assert_eq!(run.out_text(), "1.0,2.0\n3.0,4.0\n");
}

/// In a grid and in single numbers a value that comes again is no closing point.
#[test]
fn values_that_come_again_stay() {
    let bench = Bench::new();
    let run = bench.run_with_input("curve - -o - -n 0 --closed", b"0\n1\n1\n0\n").ok();
    assert_eq!(run.out_text(), "0.0\n1.0\n1.0\n0.0\n");
    let rows = b"0,0\n0,0\n0,0\n\n1,0\n0,1\n2,2\n\n0,5\n0,5\n0,5\n";
    let run = bench.run_with_input("curve - -o - -n 0 --grid --closed", rows).ok();
    assert_eq!(numbers(run.out_text().as_bytes()).len(), 18);
}

/// Exponents and points at the end are numbers in exact arithmetic, too, and no header.
#[test]
fn exact_decimals() {
    let bench = Bench::new();
    let run = "curve - -o - -n 0 --precision exact";
    let run = bench.run_with_input(run, b"1e-05,2.5E1\n1.,2.\n3,4\n").ok();
    assert_eq!(run.out_text(), "1/100000,25\n1,2\n3,4\n");
}
