//! Creases and sharp vertices from file to file.

use super::bench::{Bench, CUBE, STRIP};
use carvel::io::{BoundaryTag, CreasingTag, MeshFile};

/// A cube with creases around a face, one of which never ends, and a sharp vertex.
fn creased() -> String {
    let tags = "t crease 2/1/0 0 1 10\nt crease 2/1/0 3 1 2.5\nt crease 2/1/0 3 2 3.75\n\
        t crease 2/1/0 2 0 0.5\nt corner 1/1/0 7 3.5\nt corner 1/1/0 6 12\n";
    format!("{CUBE}{tags}")
}

/// Creases with their ends in order, ascending.
fn creases(mesh: &MeshFile) -> Vec<([u32; 2], f32)> {
    let mut creases: Vec<_> = mesh
        .creases
        .iter()
        .map(|crease| {
            let [a, b] = crease.vertices;
            ([a.min(b), a.max(b)], crease.sharpness)
        })
        .collect();
    creases.sort_unstable_by_key(|crease| crease.0);
    creases
}

#[test]
fn what_is_left_of_sharpness_is_written() {
    let bench = Bench::new();
    bench.put("cube.obj", creased());
    let run = bench.run("subdivide cube.obj -o out.obj --scheme catmull-clark --levels 2").ok();
    assert!(!run.err.contains("note"), "{}", run.err);
    let mesh = bench.mesh("out.obj");
    let count =
        |sharpness| mesh.creases.iter().filter(|crease| crease.sharpness == sharpness).count();
    assert_eq!([10.0, 1.75, 0.5].map(count), [4, 4, 4]);
    assert_eq!(mesh.creases.len(), 12);
    let sharp: Vec<_> = mesh.sharp_vertices.iter().map(|s| (s.vertex, s.sharpness)).collect();
    assert_eq!(sharp, [(6, 10.0), (7, 1.5)]);
    assert_eq!(mesh.positions[6], [0.0, 1.0, 1.0]);
}

#[test]
fn a_refinement_with_creases_goes_on_from_its_file() {
    let bench = Bench::new();
    let triangles = "v 1 0 0\nv -1 0 0\nv 0 1 0\nv 0 -1 0\nv 0 0 1\nv 0 0 -1\n\
        f 1 3 5\nf 3 2 5\nf 2 4 5\nf 4 1 5\nf 3 1 6\nf 2 3 6\nf 4 2 6\nf 1 4 6\n\
        t crease 2/1/0 0 2 3\nt crease 2/1/0 2 1 2.25\nt crease 2/1/0 4 2 1.5\n";
    bench.put("cube.obj", creased()).put("octahedron.obj", triangles);
    bench.put("strip.obj", format!("{STRIP}t crease 2/1/0 1 4 2.5\n"));
    for (mesh, options) in [
        ("cube", "--scheme catmull-clark"),
        ("cube", "--scheme catmull-clark --creasing chaikin"),
        ("cube", "--scheme bilinear"),
        ("strip", "--scheme catmull-clark --boundary edge"),
        ("octahedron", "--scheme loop"),
        ("octahedron", "--scheme loop --creasing chaikin"),
    ] {
        let run = |args: &str| bench.run(&format!("subdivide {args} {options} --quiet")).ok();
        run(&format!("{mesh}.obj -o three.obj --levels 3"));
        run(&format!("{mesh}.obj -o one.obj --levels 1"));
        run("one.obj -o continued.obj --levels 2");
        let [at_once, continued] = ["three.obj", "continued.obj"].map(|name| bench.mesh(name));
        let places = |mesh: &MeshFile| {
            let mut places: Vec<_> =
                mesh.positions.iter().map(|p| p.map(|x| (x * 1e9).round() as i64)).collect();
            places.sort_unstable();
            places
        };
        assert_eq!(places(&at_once), places(&continued), "{mesh} {options}");
        assert_eq!(at_once.creases.len(), continued.creases.len(), "{mesh} {options}");
        // A crease at a vertex of many faces would be lost if numbers were confused.
        let total = |m: &MeshFile| m.creases.iter().map(|c| c.sharpness).sum::<f32>();
        assert!((total(&at_once) - total(&continued)).abs() < 1e-3);
    }
}

#[test]
fn creases_by_angle_give_way_to_those_of_the_file() {
    let bench = Bench::new();
    bench.put("cube.obj", creased());
    let made = |options: &str| {
        let args = format!("subdivide cube.obj -o out.obj -l 1 --scheme catmull-clark {options}");
        bench.run(&args).ok();
        creases(&bench.mesh("out.obj"))
    };
    assert_eq!(made("--crease-angle 91"), made(""));
    let count = |list: &[([u32; 2], f32)], sharpness: f32| {
        list.iter().filter(|crease| crease.1 == sharpness).count()
    };
    let bent = made("--crease-angle 80 --crease-sharpness 4");
    assert_eq!([9.0, 3.0, 1.5, 2.75].map(|s| count(&bent, s)), [0, 16, 2, 2]);
    assert_eq!(count(&bent, 10.0), 2);
    let endless = made("--crease-angle 80");
    assert_eq!(count(&endless, 10.0), 18);
}

#[test]
fn a_cube_with_endless_creases_stays_a_cube() {
    let bench = Bench::new();
    bench.put("cube.obj", CUBE);
    for scheme in ["catmull-clark", "bilinear"] {
        let args =
            format!("subdivide cube.obj -o {scheme}.obj --scheme {scheme} --crease-angle 80");
        bench.run(&args).ok();
    }
    assert_eq!(bench.mesh("catmull-clark.obj").positions, bench.mesh("bilinear.obj").positions);
}

#[test]
fn what_a_file_asks_of_the_scheme_is_followed_and_overruled() {
    let bench = Bench::new();
    let tags =
        "t crease 2/1/0 1 4 2.5\nt interpolateboundary 1/0/0 2\nt creasemethod 0/0/1 chaikin\n";
    bench.put("plain.obj", STRIP).put("tags.obj", format!("{STRIP}{tags}"));
    let run = |args: &str| bench.run(&format!("subdivide {args} --scheme catmull-clark --json"));
    let followed = run("tags.obj -o followed.obj").ok().json();
    assert_eq!(followed["scheme"]["boundary"], "edge");
    assert_eq!(followed["scheme"]["creasing"], "chaikin");
    let scheme = bench.mesh("followed.obj").scheme;
    assert_eq!(scheme.boundary, Some(BoundaryTag::Edge));
    assert_eq!(scheme.creasing, Some(CreasingTag::Chaikin));
    let overruled = run("tags.obj -o overruled.obj --boundary edge-corner").ok().json();
    assert_eq!(overruled["scheme"]["boundary"], "edge-corner");
    assert_eq!(bench.mesh("overruled.obj").scheme.boundary, Some(BoundaryTag::EdgeAndCorner));
    run("plain.obj -o asked.obj --boundary edge --creasing chaikin").ok();
    let asked = bench.mesh("asked.obj").scheme;
    assert_eq!((asked.boundary, asked.creasing), (scheme.boundary, scheme.creasing));
    assert_eq!(run("plain.obj -o plain.ply").ok().json()["scheme"]["boundary"], "edge-corner");
}

#[test]
fn tags_that_name_nothing_are_refused() {
    let bench = Bench::new();
    bench.put("cube.obj", format!("{CUBE}t crease 2/1/0 0 7 2\n"));
    let words = "cube.obj: a crease, edge 0-7, names no edge of the mesh (counted from 0)";
    bench.run("subdivide cube.obj -o out.obj --scheme catmull-clark").fails(4, words);
    let info = bench.run("info cube.obj");
    assert_eq!(info.code, 4);
    assert!(info.out_text().contains("names no edge of the mesh"), "{}", info.out_text());
}

#[test]
fn info_tells_sharp_features() {
    let bench = Bench::new();
    let tags = "t hole 1/0/0 2\nt creasemethod 0/0/1 chaikin\n";
    bench.put("cube.obj", creased() + tags);
    let info = bench.run("info cube.obj").ok();
    let line = "tags              4 creases (1 infinite), 2 sharp vertices (1 infinite), 1 hole, \
        some of the scheme";
    assert!(info.out_text().contains(line), "{}", info.out_text());
    let json = bench.run("info cube.obj --json").ok().json();
    assert_eq!((&json["creases"], &json["holes"]), (&4.into(), &1.into()));
}
