//! `carvel analyse --mask` and `--curve`, and `carvel catalogue`.

use serde_json::{Value, json};

use super::bench::Bench;

/// Coefficients of a mask that is analysed without optimisation in no time.
const LONGEST: usize = 8;

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
        ("--scheme tension-four-point", "change: it has no mask"),
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

/// Coefficients far beyond what doubles hold: bounds by another route than scaling, and no
/// number in JSON that is none.
#[test]
fn coefficients_of_hundreds_of_digits_have_finite_bounds() {
    let bench = Bench::new();
    let run = bench.run("analyse --mask 1,1e320,0,-1e320,0,1 --json").ok();
    let found = run.json();
    let [low, high] = [0, 1].map(|i| found["holder"][i].as_f64().expect("a finite number"));
    // The kernel has 1 − 1e320 on the diagonal of a matrix, and rows of twice that at most.
    let digits = 320.0 * 10.0_f64.log2();
    assert!(low <= high && low >= -digits - 1.0 && high <= -digits + 1.0, "{low} to {high}");
    assert!(found["joint_spectral_radius"]["low"].is_f64());
    assert!(found["wave"]["shrink"].is_null() && found["wave"]["artifact"].is_null());
    let text = bench.run("analyse --mask 1,1e320,0,-1e320,0,1").ok();
    assert!(text.out_text().contains("beyond the range of doubles"));
    assert!(!text.out_text().contains("inf") && !text.out_text().contains("NaN"));
    // Of the radius 1, 0 rather than -0.
    let zero = bench.run("analyse --mask 1,1").ok();
    assert!(zero.out_text().contains(" 0 (radius 1)"), "{}", zero.out_text());
}

/// The keys and values that are promised, for every scheme of the oracle with a short mask.
#[test]
fn every_key_of_every_scheme_is_there() {
    let bench = Bench::new();
    let oracle = include_str!("../curves/curve_schemes.json");
    let oracle: Value = serde_json::from_str(oracle).unwrap();
    let mut tried = 0;
    for row in oracle["schemes"].as_array().unwrap() {
        let mask: Vec<_> = row["mask"].as_array().unwrap().iter().map(Value::as_str).collect();
        if mask.len() > LONGEST {
            continue;
        }
        tried += 1;
        let mask = mask.into_iter().map(Option::unwrap).collect::<Vec<_>>().join(",");
        let given = format!("--mask={mask} --arity {} --offset {}", row["arity"], row["offset"]);
        let found = bench.run(&format!("analyse {given} --json")).ok().json();
        let (name, expected) = (&row["name"], &row["properties"]);
        for (key, value) in [
            ("arity", &row["arity"]),
            ("mask", &row["mask"]),
            ("offset", &row["offset"]),
            ("parametrisation", &expected["parametrisation"]),
            ("continuity", &expected["Ck"]),
            ("support", &expected["support_width"]),
            ("generation_degree", &expected["generation_degree"]),
            ("reproduction_degree", &expected["reproduction_degree"]),
            ("tau", &expected["tau"]),
        ] {
            assert_eq!(&found[key], value, "{name}: {key}");
        }
        let proof = &found["contractivity"];
        assert_eq!(proof["L"], expected["contractivity_L"], "{name}: L");
        if proof["norm"].as_str().is_none_or(|norm| norm.len() < 24) {
            assert_eq!(proof["norm"], expected["contractivity_norm"], "{name}: norm");
        }
        let holder = found["holder"].as_array().expect("two bounds");
        assert!(holder.len() == 2 && holder.iter().all(Value::is_f64), "{name}: {holder:?}");
        let text = bench.run(&format!("analyse {given}")).ok();
        for label in [
            "mask",
            "continuity",
            "contractivity",
            "Hoelder exponent",
            "parametrisation",
            "tau",
            "support",
            "generated",
            "reproduced",
        ] {
            assert!(text.out_text().contains(label), "{name}: {label}");
        }
    }
    assert!(tried > 40, "{tried}");
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
    let ranges = |name: &str| {
        let found = bench.run(&format!("analyse {name} --range w --json")).ok().json();
        (found["mask"].clone(), found["ranges"].clone())
    };
    // The name of a scheme on meshes too.
    let paper = ranges("--curve three-point:1/32");
    assert!(paper.1.as_array().is_some_and(|list| list.len() == 4), "{paper:?}");
    for name in ["three-point", "--scheme three-point", ""] {
        assert_eq!(ranges(name), paper, "{name}");
    }
    let none = bench.run("analyse four-point --range w --within 5..6").ok();
    assert!(none.out_text().contains("no w found from 5 to 6"), "{}", none.out_text());
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
        ("loop --range w", "--range needs a name"),
        ("three-point --range q", "three-point has no parameter 'q'; its parameters: w"),
        ("--mask 1,1 --range w", "--range needs a name"),
        ("chaikin --mask 1,1", "cannot be used"),
        ("--mask 1,1 --valence 5", "cannot be used"),
        ("--mask 1/0,1", "'1/0'"),
        ("--mask 1,nan", "'nan'"),
        ("--mask 1,1 --arity 0", "arity 0"),
        ("--mask 1,3,3,1", "all divided by 4 make a mask"),
        ("--scheme chakin", "a similar value exists: 'chaikin'"),
        ("four-point --range w --within 1..0", "the smaller number comes first"),
        ("four-point:1e401", "exponent beyond"),
        ("tension-four-point:1", "change: it has no mask; four-point"),
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
