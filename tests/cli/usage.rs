//! What people type, typos included.

use super::bench::{Bench, COW, CUBE};

#[test]
fn no_arguments_explain_the_command() {
    let run = Bench::new().run("").ok();
    assert!(run.err.is_empty(), "{}", run.err);
    let lines = run.out_text().lines().count();
    assert!((8..=12).contains(&lines), "{lines} lines");
    for word in ["carvel subdivide", "carvel info", "carvel preview", "--help"] {
        assert!(run.out_text().contains(word), "{word}");
    }
}

#[test]
fn help_documents_the_exit_codes_and_defaults() {
    let bench = Bench::new();
    for args in ["--help", "subdivide --help", "info --help", "preview --help", "curve --help"] {
        let run = bench.run(args).ok();
        for code in 0..=8 {
            assert!(run.out_text().contains(&format!("\n  {code}  ")), "{args}: {code}");
        }
    }
    let help = bench.run("subdivide --help").ok();
    // Lines are folded at the width of the terminal.
    let words: Vec<_> = help.out_text().split_whitespace().collect();
    let help = words.join(" ");
    for default in [
        "[default: three-point]",
        "[default: 2]",
        "1/32",
        "[default: edge-corner]",
        "[default: what the file says, or corners-plus1]",
        "infinite ones stay so",
    ] {
        assert!(help.contains(default), "{default}");
    }
    assert!(bench.run("--version").ok().out_text().starts_with("carvel "));
}

#[test]
fn typos_get_a_suggestion() {
    let bench = Bench::new();
    for (args, suggestion) in [
        ("subdivde a.obj -o b.obj", "'subdivide'"),
        ("subdivide a.obj -o b.obj --lvels 3", "'--levels'"),
        ("subdivide a.obj -o b.obj --scheme doosabin", "'doo-sabin'"),
    ] {
        let run = bench.run(args);
        assert_eq!(run.code, 2, "{args}");
        assert!(run.err.contains(suggestion), "{}", run.err);
    }
}

#[test]
fn options_of_another_scheme_are_refused() {
    let bench = Bench::new();
    bench.put("cube.obj", CUBE);
    for (options, words) in [
        ("--scheme doo-sabin --w 1/32", "--w belongs to --scheme three-point, not to doo-sabin"),
        ("--scheme quartic --degree 4", "--degree belongs to --scheme bspline, not to quartic"),
        ("--passes 0", "--passes belongs to --scheme averaging, not to three-point"),
        ("--scheme bspline --degree 4 --split dual", "--split belongs to --scheme averaging"),
        ("--scheme bspline", "needs --degree"),
    ] {
        bench.run(&format!("subdivide cube.obj -o out.obj {options}")).fails(2, words);
    }
    assert_eq!(bench.files(), ["cube.obj"]);
}

#[test]
fn values_out_of_range_are_refused() {
    let bench = Bench::new();
    bench.put("cube.obj", CUBE);
    for (options, words) in [
        ("--w 1/15", "w = 1/15 is not within 0 and 1/16"),
        ("--w -1/32", "w = -1/32 is not within"),
        ("--scheme bspline --degree 0", "degree 0"),
        ("--scheme bspline --degree 66", "degree 66"),
        ("--scheme averaging --passes 1001", "pass 1001"),
        ("--size 0x900", "each side must be"),
        ("--azimuth nan", "must be a finite number"),
    ] {
        bench.run(&format!("subdivide cube.obj -o out.obj {options}")).fails(2, words);
    }
    for options in ["--w 1/0", "--w x", "--levels 65", "--levels -1", "--memory 2X", "--passes 1;2"]
    {
        let run = bench.run(&format!("subdivide cube.obj -o out.obj {options}"));
        assert_eq!(run.code, 2, "{options}: {}", run.err);
    }
    assert_eq!(bench.files(), ["cube.obj"]);
}

#[test]
fn formats_that_nobody_knows_are_refused_before_any_work() {
    let bench = Bench::new();
    bench.put("cube.obj", CUBE);
    bench.run("subdivide cube.obj -o out.xyz").fails(2, "'xyz' is not a known format");
    bench.run("subdivide none.obj -o out").fails(2, "out: no extension");
    bench.run("preview none.obj -o out.jpg").fails(2, "pictures are PNG");
    bench.run("subdivide cube.obj -o out.obj --preview out.jpg").fails(2, "pictures are PNG");
}

#[test]
fn info_describes_a_mesh() {
    let run = Bench::new().run(&format!("info {COW}")).ok();
    for line in [
        "vertices          188",
        "faces             180",
        "edges             366 (0 on boundaries)",
        "Euler number      2",
        "components        1",
        "face sizes        4 of 3, 160 of 4, 16 of 5",
        "267 texture coordinates",
        "defects           none",
    ] {
        assert!(run.out_text().contains(line), "{line} in {}", run.out_text());
    }
}

#[test]
fn info_lists_defects_and_says_so_by_its_code() {
    let bench = Bench::new();
    let mut mesh = "v 0 0 0\nv 1 0 0\nv 1 1 0\n".to_owned();
    mesh.push_str(&"f 1 2 1\n".repeat(25));
    bench.put("bad.obj", mesh).put("cube.obj", CUBE);
    let run = bench.run("info cube.obj bad.obj");
    assert_eq!(run.code, 4);
    let defects = run.out_text().lines().filter(|l| l.contains(" twice")).count();
    assert_eq!(defects, 20);
    assert!(run.out_text().contains("line 4: face 1 contains vertex 1 twice"));
    assert!(run.out_text().contains("25 in all"));
    let json = bench.run("info cube.obj bad.obj --json").json();
    assert_eq!(json[0]["topology"]["euler_characteristic"], 2);
    assert_eq!(json[0]["topology"]["interior_valences"]["3"], 8);
    assert_eq!(json[1]["defects"].as_array().unwrap().len(), 25);
    assert_eq!(json[1]["defects"][24]["line"], 28);
    assert_eq!(json[1]["defects"][24]["kind"], "RepeatedVertex");
}
