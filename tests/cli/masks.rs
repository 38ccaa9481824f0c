//! `carvel analyse --mask` and `--curve`, and `carvel catalogue`.

use serde_json::{Value, json};

use super::bench::Bench;

#[test]
fn the_papers_mask_in_json() {
    let bench = Bench::new();
    let mask = "1/32,9/32,11/16,11/16,9/32,1/32";
    let found = bench.run(&format!("analyse --mask {mask} --json")).ok().json();
    for (key, value) in [
        ("arity", json!(2)),
        ("offset", json!(-3)),
        ("mask", mask.split(',').collect::<Value>()),
        ("parametrisation", json!("dual")),
        ("continuity", json!(2)),
        ("contractivity", json!({ "k": 2, "L": 1, "norm": "3/4" })),
        ("support", json!("5")),
        ("generation_degree", json!(2)),
        ("reproduction_degree", json!(1)),
        ("tau", json!("-1/2")),
        ("factors", json!({ "split": "dual", "passes": ["1/2"] })),
    ] {
        assert_eq!(found[key], value, "{key}");
    }
    let exponent = 2.0 - 0.75_f64.log2();
    for end in found["holder"].as_array().expect("two numbers") {
        assert!((end.as_f64().expect("a number") - exponent).abs() < 1e-12, "{end}");
    }
    let same = bench.run("analyse --curve three-point:1/32 --json").ok().json();
    assert_eq!(same, found);
    for other in ["--scheme three-point:1/32", "three-point:1/32", "--mask 1,9,22,22,9,1/32"] {
        assert_eq!(bench.run(&format!("analyse {other} --json")).ok().json(), found, "{other}");
    }
}

/// A mask of the averaging family is its scheme on meshes, whichever way it is given.
#[test]
fn masks_are_schemes_on_meshes() {
    let bench = Bench::new();
    bench.put("cube.obj", super::bench::CUBE);
    for (mask, scheme) in [
        ("--mask 1,9,22,22,9,1/32", "--scheme three-point"),
        ("--scheme three-point:1/64", "--scheme three-point --w 1/64"),
        ("--mask [1,4,6,4,1]/8", "--scheme bspline --degree 3"),
        ("--scheme dyn-floater-hormann", "--scheme averaging --split dual --passes 0,7/2"),
        (
            "--scheme four-point:1/16 --corner-rule average",
            "--scheme averaging --split primal --passes 0,3 --corner-rule average",
        ),
    ] {
        bench.run(&format!("subdivide cube.obj -o a.obj {mask}")).ok();
        bench.run(&format!("subdivide cube.obj -o b.obj {scheme}")).ok();
        assert!(bench.get("a.obj") == bench.get("b.obj"), "{mask} and {scheme}");
    }
    let json =
        bench.run("subdivide cube.obj -o a.obj --mask [1,9,22,22,9,1]/32 --json").ok().json();
    assert_eq!(json["scheme"]["split"], "dual");
    assert_eq!(json["scheme"]["passes"], json!(["1/2"]));
    for (options, words) in [
        ("--mask [1,2,2,1]/3", "[1,3,3,1]/4 is no factor"),
        ("--mask [2,3,2,1]/4", "it is not symmetric"),
        ("--scheme ternary-four-point", "its arity is 3, not 2"),
        ("--scheme weissman", "passes are not rational"),
        ("--scheme tension-four-point", "invalid value"),
        ("--mask [1,3,3,1]/4 --passes 0", "follow from it"),
        ("--mask [1,3,3,1]/4 --w 1/32", "--w belongs to --scheme three-point"),
        ("--mask 1,2", "sum rule"),
    ] {
        let run = bench.run(&format!("subdivide cube.obj -o none.obj {options}"));
        assert!(run.code == 2 && run.err.contains(words), "{options}: {}", run.err);
    }
    assert!(!bench.files().contains(&"none.obj".to_owned()));
}

#[test]
fn arity_and_offset_are_heeded() {
    let bench = Bench::new();
    let run = "analyse --mask -1/9,0,2/9,8/9,1,8/9,2/9,0,-1/9 --arity 3 --offset 2 --json";
    let found = bench.run(run).ok().json();
    assert_eq!((&found["arity"], &found["offset"]), (&json!(3), &json!(2)));
    assert_eq!((&found["continuity"], &found["tau"]), (&json!(0), &json!("6")));
    let reason = found["factors"]["none"].as_str().expect("a reason");
    assert!(reason.contains("arity is 3"), "{reason}");
}

#[test]
fn text_says_what_is_proved() {
    let bench = Bench::new();
    let run = bench.run("analyse --curve four-point:1/16 --range w --within -1..1").ok();
    let text = run.out_text();
    for part in ["C^1", "3/4 < 1, L = 2", "primal", "--split primal --passes \"0,3\""] {
        assert!(text.contains(part), "{part}: {text}");
    }
    let c1 = text.lines().find(|line| line.starts_with("C^1")).expect("a range");
    // Ends are narrowed down to a millionth of the search.
    assert!(c1.contains("w from 0.00000") && c1.contains("to 0.1927"), "{c1}");
}

#[test]
fn mistakes_are_told_in_one_line() {
    let bench = Bench::new();
    for (arguments, word) in [
        ("--mask 1/4,3/4,3/4", "sum"),
        ("--mask 1,x", "'x'"),
        ("--mask 1,1 --arity 1", "arity 1"),
        ("--curve nothing", "nothing"),
        ("--curve three-point:a", "'a'"),
        ("--curve three-point --range v", "three-point has no parameter 'v'; its parameters: w"),
        ("--curve chaikin --range w", "chaikin has no parameter 'w'; its parameters: none"),
        ("--curve b-spline --range degree", "degree of b-spline counts something"),
        ("--curve tension-four-point:1", "change: it has no mask; four-point"),
        ("--curve chaikin --mask 1,1", "cannot be used"),
        ("--curve chaikin --scheme loop", "cannot be used"),
        ("--curve chakin", "'chaikin' is near it"),
        ("--scheme four-pint:1/16", "invalid value"),
        ("--scheme four-point:1/16 --valence 5", "mean nothing to a mask"),
        ("four-point --boundary edge", "mean nothing to a mask"),
        ("three-point --range w", "--range needs a name"),
        ("--mask 1,1 --range w", "--range needs a name"),
        ("chaikin --mask 1,1", "cannot be used"),
        ("--mask 1,1 --valence 5", "cannot be used"),
        ("--mask 1/0,1", "'1/0'"),
        ("--mask 1,nan", "'nan'"),
        ("--mask 1,1 --arity 0", "arity 0"),
        ("--mask 1,1 --arity 65", "arity 65"),
        ("--mask [1,3,3,1]/0", "is not a list"),
        ("--arity 3", "--mask"),
    ] {
        let run = bench.run(&format!("analyse {arguments}"));
        assert_eq!(run.code, 2, "{arguments}: {}", run.err);
        assert!(run.err.contains(word), "{arguments}: {}", run.err);
        assert!(run.out.is_empty());
    }
}

#[test]
fn the_catalogue_lists_what_can_be_analysed() {
    let bench = Bench::new();
    let list = bench.run("catalogue --json").ok().json();
    let list = list.as_array().expect("a list");
    assert_eq!(list.len(), 22);
    let run = bench.run("catalogue").ok();
    let text = run.out_text();
    for family in list {
        let name = family["name"].as_str().expect("a name");
        assert!(text.contains(&format!("{name}: ")), "{name}");
        assert!(family["attribution"].is_string(), "{name}");
    }
}
