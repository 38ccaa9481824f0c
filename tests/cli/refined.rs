//! Results: the same by every way that leads to them.

use super::bench::{Bench, COW, CUBE, STRIP};

#[test]
fn a_refinement_can_be_continued_from_its_file() {
    let bench = Bench::new();
    // Triangle, quad and pentagon with a common boundary.
    let open = "v 0 0 0\nv 1 0 .1\nv 1 1 .2\nv 0 1 .3\nv 2 0 .4\nv .5 2 0\nv 0 2 .7\nv -1 1.5 0\n\
        f 1 2 3 4\nf 2 5 3\nf 4 3 6 7 8\n";
    bench.put("open.obj", open).put("strip.obj", STRIP);
    for mesh in ["open.obj", "strip.obj", COW] {
        for options in ["", "--boundary edge --scheme quartic", "--scheme averaging --passes 0,7/2"]
        {
            let run = |args: &str| bench.run(&format!("subdivide {args} {options} --quiet")).ok();
            run(&format!("{mesh} -o three.obj --levels 3"));
            run(&format!("{mesh} -o two.obj --levels 2"));
            run("two.obj -o continued.obj --levels 1 --anchored");
            let [at_once, continued] =
                ["three.obj", "continued.obj"].map(|name| shape(&bench.mesh(name)));
            assert_eq!(at_once, continued, "{mesh} {options}");
        }
    }
}

/// The faces of a mesh by the rounded positions of their vertices, whatever the
/// numbering.
fn shape(mesh: &carvel::io::MeshFile) -> Vec<Vec<[i64; 3]>> {
    let mut corners = mesh.face_vertices.iter();
    let vertex = |&v: &u32| mesh.positions[v as usize].map(|x| (x * 1e9).round() as i64);
    let cycle = |&size: &u32| {
        let mut face: Vec<_> = corners.by_ref().take(size as usize).map(vertex).collect();
        let first = (0..face.len()).min_by_key(|&i| face[i]).unwrap();
        face.rotate_left(first);
        face
    };
    let mut faces: Vec<_> = mesh.face_sizes.iter().map(cycle).collect();
    faces.sort_unstable();
    faces
}

#[test]
fn threads_do_not_matter() {
    let bench = Bench::new();
    for threads in [1, 2, 7] {
        let args = format!("subdivide {COW} -o {threads}.obj --levels 4 --threads {threads}");
        bench.run(&args).ok();
    }
    assert_eq!(bench.get("1.obj"), bench.get("2.obj"));
    assert_eq!(bench.get("1.obj"), bench.get("7.obj"));
}

#[test]
fn schemes_are_the_ones_asked_for() {
    let bench = Bench::new();
    bench.put("cube.obj", CUBE);
    let made = |options: &[&str]| {
        let args = [&["subdivide", "cube.obj", "-o", "-", "--quiet"], options].concat();
        bench.run_list(&args).ok().out
    };
    let averaging =
        |passes| made(&["--scheme", "averaging", "--split", "dual", "--passes", passes]);
    assert_eq!(made(&[]), averaging("1/2"));
    assert_eq!(made(&["--w", "0.03125"]), averaging("0.5"));
    assert_eq!(made(&["--scheme", "doo-sabin"]), averaging(""));
    assert_eq!(made(&["--scheme", "doo-sabin"]), made(&["--scheme", "averaging"]));
    assert_eq!(made(&["--scheme", "quartic"]), averaging("0"));
    assert_eq!(made(&["--scheme", "bspline", "--degree", "8"]), averaging("0,0,0"));
    assert_ne!(averaging("-1/2"), averaging("1/2"));
    let strip = |options| bench.put("strip.obj", STRIP).run(options).ok().out;
    let cornered = strip("subdivide strip.obj -o - --quiet");
    assert_ne!(strip("subdivide strip.obj -o - --quiet --boundary edge"), cornered);
    assert_ne!(strip("subdivide strip.obj -o - --quiet --boundary none"), cornered);
    assert_ne!(made(&["--levels", "3"]), made(&["--levels", "3", "--corner-rule", "average"]));
}

/// From the second step on: a triangle's first corner among quads.
#[test]
fn the_tuned_rule_takes_faces_that_are_no_quads() {
    let bench = Bench::new();
    bench.put("cube.obj", CUBE);
    let made = |options: &str, levels: u32| {
        let args = format!("subdivide cube.obj -o - --quiet --levels {levels} {options}");
        bench.run(&args).ok().out
    };
    let tuned = "--w 1/32 --extraordinary tuned";
    assert_eq!(made(tuned, 1), made("", 1));
    assert_ne!(made(tuned, 2), made("", 2));
    assert_eq!(made("--extraordinary default", 2), made("", 2));
    let report = bench.run(&format!("subdivide cube.obj -o out.obj --json {tuned}")).ok().json();
    assert_eq!(report["scheme"]["extraordinary"], "tuned");
}

#[test]
fn doo_sabin_on_a_cube_is_what_the_paper_says() {
    let bench = Bench::new();
    bench.put("cube.obj", CUBE);
    bench.run("subdivide cube.obj -o out.obj --scheme doo-sabin --levels 1").ok();
    let mesh = bench.mesh("out.obj");
    // Corner weights of a quad are 9, 3, 3, 1 sixteenths: the first face's first.
    assert_eq!(mesh.positions[0], [0.25, 0.25, 0.0]);
    assert_eq!((mesh.positions.len(), mesh.face_sizes.len()), (24, 26));
}

#[test]
fn single_precision_is_computed_and_written() {
    let bench = Bench::new();
    bench.put("cube.obj", CUBE.replace("v 1 1 1", "v 1.1 1 1"));
    bench.run("subdivide cube.obj -o single.obj --precision f32").ok();
    bench.run("subdivide cube.obj -o double.obj").ok();
    let (single, double) = (bench.mesh("single.obj"), bench.mesh("double.obj"));
    assert_eq!(single.face_vertices, double.face_vertices);
    let mut rounded = 0;
    let pairs = single.positions.as_flattened().iter().zip(double.positions.as_flattened());
    for (a, b) in pairs {
        assert!((a - b).abs() < 1e-6, "{a} {b}");
        rounded += usize::from(a != b);
    }
    assert!(rounded > 0);
    // Every text stands for a single-precision number, as short as can be.
    let text = String::from_utf8(bench.get("single.obj")).unwrap();
    for word in text.lines().filter(|l| l.starts_with("v ")).flat_map(|l| l.split(' ').skip(1)) {
        assert_eq!(word.parse::<f32>().unwrap().to_string(), word);
    }
}

#[test]
fn the_report_says_what_was_done() {
    let bench = Bench::new();
    bench.put("strip.obj", STRIP);
    let args = "subdivide strip.obj -o out.ply --json --levels 1 --threads 2 --w 1/64";
    let run = bench.run(args).ok();
    assert!(!run.err.contains("->"), "the report is enough: {}", run.err);
    let json = run.json();
    assert_eq!(json["input"], "strip.obj");
    assert_eq!(json["output"], "out.ply");
    assert_eq!(json["format"], "ply");
    assert_eq!(json["scheme"]["name"], "three-point");
    assert_eq!(json["scheme"]["passes"], serde_json::json!(["3/4"]));
    assert_eq!(json["scheme"]["corner_rule"], "cosine");
    assert_eq!(json["scheme"]["boundary"], "edge-corner");
    assert_eq!((&json["levels"], &json["threads"]), (&1.into(), &2.into()));
    assert_eq!(json["precision"], "f64");
    assert_eq!(json["anchored"], true);
    assert_eq!(json["counts"][0]["boundary_edges"], 6);
    let mesh = bench.mesh("out.ply");
    assert_eq!(json["counts"][1]["vertices"], mesh.positions.len());
    assert_eq!(json["counts"][1]["faces"], mesh.face_sizes.len());
    assert_eq!(json["counts"][1]["corners"], mesh.face_vertices.len());
    for part in ["read", "build", "refine", "write", "preview", "total"] {
        assert!(json["seconds"][part].as_f64().unwrap() >= 0.0, "{part}");
    }
    let predicted = json["predicted_seconds"].as_f64().unwrap();
    assert!(predicted > 0.0 && predicted < 0.01, "{predicted} for a strip");
    let none = bench.run("subdivide strip.obj -o out.ply --json --boundary none").ok().json();
    assert_eq!(none["anchored"], false);
}

#[test]
fn a_summary_on_one_line_unless_quiet() {
    let bench = Bench::new();
    bench.put("cube.obj", CUBE);
    let run = bench.run("subdivide cube.obj -o out.obj --levels 5").ok();
    assert!(run.err.starts_with("cube.obj: 6 faces -> 6,146 faces (5 levels, three-point) in "));
    assert_eq!(run.err.lines().count(), 1);
    assert!(run.out.is_empty());
    assert!(bench.run("subdivide cube.obj -o out.obj --quiet").ok().err.is_empty());
}
