//! The primal schemes and what belongs to them.

use super::bench::{Bench, COW, CUBE, STRIP};

/// An octahedron.
const OCTAHEDRON: &str = "v 1 0 0\nv -1 0 0\nv 0 1 0\nv 0 -1 0\nv 0 0 1\nv 0 0 -1\n\
    f 1 3 5\nf 3 2 5\nf 2 4 5\nf 4 1 5\nf 3 1 6\nf 2 3 6\nf 4 2 6\nf 1 4 6\n";

#[test]
fn catmull_clark_on_a_cube_is_what_the_paper_says() {
    let bench = Bench::new();
    bench.put("cube.obj", CUBE);
    bench.run("subdivide cube.obj -o out.obj --scheme catmull-clark --levels 1").ok();
    let mesh = bench.mesh("out.obj");
    assert_eq!((mesh.positions.len(), mesh.face_sizes.len()), (26, 24));
    // A corner keeps a third; its neighbours and the centres of its faces have 1/9 each.
    for x in mesh.positions[0] {
        assert!((x - 2.0 / 9.0).abs() < 1e-15, "{x}");
    }
    // The middle of the first face's first edge, from its ends and both faces' centres.
    assert_eq!(mesh.positions[8], [0.5, 0.125, 0.125]);
}

#[test]
fn loop_on_an_octahedron_is_what_the_thesis_says() {
    let bench = Bench::new();
    bench.put("octahedron.obj", OCTAHEDRON);
    let made = |options: &str| {
        let args = format!("subdivide octahedron.obj -o out.obj --scheme loop -l 1 {options}");
        bench.run(&args).ok();
        bench.mesh("out.obj")
    };
    let mesh = made("");
    assert_eq!((mesh.positions.len(), mesh.face_sizes.len()), (18, 32));
    // β = 31/256 at valence 4; Warren's is 3/32.
    assert!((mesh.positions[0][0] - 33.0 / 64.0).abs() < 1e-15);
    assert_eq!(made("--loop-weights warren").positions[0], [0.625, 0.0, 0.0]);
    // The middle of an edge: 3/8 of its ends and 1/8 of the opposite vertices.
    assert_eq!(mesh.positions[6], [0.375, 0.375, 0.0]);
}

#[test]
fn loop_names_the_first_face_that_is_no_triangle() {
    let bench = Bench::new();
    // In the kernel's order the pentagon comes before the quad.
    let mixed = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 2 1 0\nv 0 2 0\nv 1 2 0\nv .5 3 0\n\
        f 2 5 3\nf 1 2 3 4\nf 4 3 8 9 7\n";
    bench.put("mixed.obj", mixed).put("cube.obj", CUBE);
    let words = "mixed.obj:11: Loop refines triangles only, face 1 has 4 sides";
    bench.run("subdivide mixed.obj -o out.obj --scheme loop").fails(4, words);
    bench.run("subdivide cube.obj -o out.obj --scheme loop").fails(4, "face 0 has 4 sides");
    assert_eq!(bench.files(), ["cube.obj", "mixed.obj"]);
}

#[test]
fn schemes_have_several_names() {
    let bench = Bench::new();
    bench.put("strip.obj", STRIP);
    let made = |options: &[&str]| {
        let args = [&["subdivide", "strip.obj", "-o", "-", "--quiet", "--scheme"], options];
        bench.run_list(&args.concat()).ok().out
    };
    let zeros = ["0"; 32].join(",");
    let primal = |passes| made(&["averaging", "--split", "primal", "--passes", passes]);
    assert_eq!(made(&["bilinear"]), primal(""));
    assert_eq!(made(&["bilinear"]), made(&["bspline", "--degree", "1"]));
    assert_eq!(made(&["bspline", "--degree", "3"]), primal("0"));
    assert_eq!(made(&["bspline", "--degree", "65"]), primal(&zeros));
    assert_ne!(primal("1/2"), primal("0"));
    // The same where all is regular.
    assert_eq!(made(&["catmull-clark"]), primal("0"));
    bench.put("strip.obj", CUBE);
    let args = "subdivide strip.obj -o - --quiet --scheme";
    let cube = |scheme: &str| bench.run(&format!("{args} {scheme}")).ok().out;
    assert_ne!(cube("catmull-clark"), cube("bspline --degree 3"));
}

#[test]
fn options_change_the_surface() {
    let bench = Bench::new();
    bench.put("strip.obj", STRIP).put("octahedron.obj", OCTAHEDRON);
    let made = |mesh: &str, options: &str| {
        let args = format!("subdivide {mesh}.obj -o - --quiet --scheme catmull-clark {options}");
        bench.run(&args).ok().out
    };
    assert_ne!(made("strip", ""), made("strip", "--boundary edge"));
    assert_ne!(made("octahedron", ""), made("octahedron", "--triangle-rule smooth"));
    let report = bench.run(&format!("subdivide {COW} -o a.obj --scheme catmull-clark --json"));
    let scheme = &report.ok().json()["scheme"];
    for (option, word) in [
        ("name", "catmull-clark"),
        ("split", "primal"),
        ("boundary", "edge-corner"),
        ("creasing", "uniform"),
        ("triangle_rule", "catmull-clark"),
        ("uv", "corners-plus1"),
    ] {
        assert_eq!(scheme[option], word, "{option}");
    }
    assert!(scheme["corner_rule"].is_null() && scheme["loop_weights"].is_null());
}

#[test]
fn options_belong_to_their_schemes() {
    let bench = Bench::new();
    bench.put("cube.obj", CUBE);
    let featured = "belongs to --scheme catmull-clark, loop or bilinear, not to";
    for (options, words) in [
        ("--creasing chaikin", format!("--creasing {featured} three-point")),
        ("--scheme doo-sabin --uv all", format!("--uv {featured} doo-sabin")),
        ("--scheme quartic --keep-holes", format!("--keep-holes {featured} quartic")),
        ("--crease-angle 30", format!("--crease-angle {featured} three-point")),
        ("--non-manifold sharpen", format!("--non-manifold sharpen {featured} three-point")),
        (
            "--scheme loop --triangle-rule smooth",
            "--triangle-rule belongs to --scheme catmull-clark, not to loop".to_owned(),
        ),
        (
            "--scheme catmull-clark --loop-weights warren",
            "--loop-weights belongs to --scheme loop, not to catmull-clark".to_owned(),
        ),
        (
            "--scheme loop --corner-rule average",
            "--corner-rule belongs to --scheme three-point, doo-sabin, quartic, bspline or \
             averaging, not to loop"
                .to_owned(),
        ),
        (
            "--scheme quartic --extraordinary tuned",
            "--extraordinary belongs to --scheme three-point, not to quartic".to_owned(),
        ),
        (
            "--w 1/64 --extraordinary tuned",
            "w = 1/32, a corner split and the pass 1/2, not those of a corner split and the pass \
             3/4"
            .to_owned(),
        ),
        ("--scheme catmull-clark --w 0", "--w belongs to --scheme three-point".to_owned()),
        ("--scheme loop --anchored", "--anchored belongs to dual schemes, not to loop".to_owned()),
        (
            "--scheme bspline --degree 3 --anchored",
            "--anchored belongs to dual schemes, not to bspline".to_owned(),
        ),
        ("--scheme loop --crease-angle 181", "degrees from 0 to 180".to_owned()),
        ("--scheme loop --crease-angle nan", "degrees from 0 to 180".to_owned()),
        (
            "--scheme loop --crease-angle 30 --crease-sharpness -1",
            "--crease-sharpness -1 is not a number from 0 up".to_owned(),
        ),
    ] {
        bench.run(&format!("subdivide cube.obj -o out.obj {options}")).fails(2, &words);
    }
    assert_eq!(bench.files(), ["cube.obj"]);
}

#[test]
fn typos_in_values_get_a_suggestion() {
    let bench = Bench::new();
    bench.put("cube.obj", CUBE);
    for (options, suggestion) in [
        ("--scheme catmul-clark", "'catmull-clark'"),
        ("--scheme catmull-clark --creasing chalkin", "'chaikin'"),
        ("--scheme catmull-clark --uv corners-plus-1", "'corners-plus1'"),
        ("--scheme catmull-clark --triangle-rule smoth", "'smooth'"),
        ("--scheme loop --loop-weights waren", "'warren'"),
        ("--non-manifold sharp", "'sharpen'"),
        ("--scheme catmull-clark --crease-angel 30", "'--crease-angle'"),
        ("--scheme catmull-clark --keep-hole", "'--keep-holes'"),
        ("--scheme catmull-clark --crease-sharpness 2", "--crease-angle"),
    ] {
        let run = bench.run(&format!("subdivide cube.obj -o out.obj {options}"));
        assert_eq!(run.code, 2, "{options}");
        assert!(run.err.contains(suggestion), "{options}: {}", run.err);
    }
}

#[test]
fn what_is_not_manifold_stays_sharp() {
    let bench = Bench::new();
    // Three quads at the edge 1-2.
    let fin = "v 0 0 0\nv 0 0 1\nv 1 0 0\nv 1 0 1\nv -1 1 0\nv -1 1 1\nv -1 -1 0\nv -1 -1 1\n\
        f 1 3 4 2\nf 2 6 5 1\nf 1 7 8 2\n";
    bench.put("fin.obj", fin);
    let run = bench.run(
        "subdivide fin.obj -o out.obj --scheme catmull-clark --non-manifold sharpen --levels 2",
    );
    assert!(run.ok().err.contains("not manifold, kept as it is: infinitely sharp there"));
    let mesh = bench.mesh("out.obj");
    assert_eq!(mesh.face_sizes.len(), 48);
    let on_edge = |p: &&[f64; 3]| p[0] == 0.0 && p[1] == 0.0;
    assert_eq!(mesh.positions.iter().filter(on_edge).count(), 5);
    assert!(mesh.creases.is_empty() && mesh.sharp_vertices.is_empty());
    let info = bench.run("info fin.obj");
    assert_eq!(info.code, 4);
    let line = "not manifold      1 edge and 0 vertices, sharp under --non-manifold sharpen";
    assert!(info.out_text().contains(line), "{}", info.out_text());
}
