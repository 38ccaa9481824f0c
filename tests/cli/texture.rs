//! Texture coordinates with seams.

use super::bench::{Bench, COW};
use carvel::base::NONE;
use carvel::io::MeshFile;
use carvel::{Channel, FaceVaryingMode, Mesh};
use std::collections::BTreeSet;
use std::fmt::Write as _;

/// Two rows of three quads, u and v being x and y, with values for x + 10 in the second
/// row from x = 1 on.
fn seamed(faces: &str) -> String {
    let mut text = String::new();
    for (x, y) in (0..12).map(|i| (i % 4, i / 4)) {
        writeln!(text, "v {x} {y} 0\nvt {x} {y}").unwrap();
    }
    for (x, y) in [(11, 1), (12, 1), (13, 1), (11, 2), (12, 2), (13, 2)] {
        writeln!(text, "vt {x} {y}").unwrap();
    }
    text + faces
}

/// The last two quads are an island of their own.
const FACES: &str = "f 1/1 2/2 6/6 5/5\nf 2/2 3/3 7/7 6/6\nf 3/3 4/4 8/8 7/7\n\
    f 5/5 6/6 10/10 9/9\nf 6/13 7/14 11/17 10/16\nf 7/14 8/15 12/18 11/17\n";

/// The edges whose sides take different values, by their ends' places.
fn seam(mesh: &MeshFile) -> BTreeSet<[[i64; 3]; 2]> {
    let uvs = mesh.face_uvs.as_ref().unwrap();
    let place = |v: u32| mesh.positions[v as usize].map(|x| (x * 1e6).round() as i64);
    let mut sides = std::collections::BTreeMap::new();
    let mut first = 0;
    for face in mesh.faces() {
        let corner = |i: usize| (face[i % face.len()], uvs[first + i % face.len()]);
        for i in 0..face.len() {
            let mut ends = [corner(i), corner(i + 1)];
            ends.sort_unstable();
            let values = ends.map(|end| end.1);
            sides.entry(ends.map(|end| end.0)).or_insert_with(Vec::new).push(values);
        }
        first += face.len();
    }
    let open = sides.into_iter().filter(|(_, values)| values.len() == 2 && values[0] != values[1]);
    open.map(|(ends, _)| {
        let mut ends = ends.map(place);
        ends.sort_unstable();
        ends
    })
    .collect()
}

fn seam_edges(mesh: &MeshFile) -> usize {
    let topology =
        Mesh::from_polygons(mesh.positions.len(), &mesh.face_sizes, &mesh.face_vertices).unwrap();
    let indices = mesh.face_uvs.as_ref().unwrap();
    let mode = FaceVaryingMode::default();
    Channel::new(&topology, indices, mesh.uvs.len(), mode).unwrap().seam_edges(&topology)
}

#[test]
fn the_seams_of_the_cow_stay_seams_at_every_level() {
    let bench = Bench::new();
    let control = bench.mesh(COW);
    let before = seam_edges(&control);
    assert_eq!(before, 72);
    // Pairs of vertex and value, edges and faces of the mesh cut along the seams.
    for (level, records) in [(1, 885), (2, 3225), (3, 12297)] {
        let args = format!("subdivide {COW} -o out.obj --scheme catmull-clark -l {level}");
        let run = bench.run(&args).ok();
        assert!(!run.err.contains("note"), "{}", run.err);
        let mesh = bench.mesh("out.obj");
        assert_eq!(mesh.uvs.len(), records, "level {level}");
        assert_eq!(seam_edges(&mesh), before << level);
        assert_eq!(seam(&mesh).len(), before << level);
    }
    let run = bench.run(&format!("subdivide {COW} -o linear.obj --scheme bilinear -l 1")).ok();
    assert!(!run.err.contains("note"), "{}", run.err);
    // Refined linearly, the seam lies where it was: on ends and middles of old edges.
    let old = seam(&control);
    let halves = seam(&bench.mesh("linear.obj"));
    assert_eq!(halves.len(), 2 * old.len());
    let ends: BTreeSet<_> = old.iter().flatten().collect();
    assert!(halves.iter().all(|half| half.iter().any(|end| ends.contains(end))));
}

#[test]
fn both_sides_of_a_seam_keep_to_themselves() {
    let bench = Bench::new();
    bench.put("rows.obj", seamed(FACES));
    bench.run("subdivide rows.obj -o out.obj --scheme catmull-clark -l 3 --uv all").ok();
    let mesh = bench.mesh("out.obj");
    assert_eq!(seam_edges(&mesh), 3 << 3);
    let uvs = mesh.face_uvs.as_ref().unwrap();
    let faces_above = mesh.face_vertices.chunks(4).zip(uvs.chunks(4)).filter(|(face, _)| {
        let middle = |k: usize| face.iter().map(|&v| mesh.positions[v as usize][k]).sum::<f64>();
        middle(0) > 4.0 && middle(1) > 4.0
    });
    let mut above = 0;
    for (_, values) in faces_above {
        assert!(values.iter().all(|&uv| mesh.uvs[uv as usize][0] > 10.5));
        above += 1;
    }
    assert!(above > 100, "{above}");
}

#[test]
fn modes_differ_and_the_default_is_that_of_usd() {
    let bench = Bench::new();
    let modes = ["smooth", "corners", "corners-plus1", "corners-plus2", "boundaries", "all"];
    let made = |options: &str| {
        let args = format!("subdivide {COW} -o - -l 1 --quiet --scheme catmull-clark {options}");
        // But for the tag that says which mode it was.
        let out = String::from_utf8(bench.run(&args).ok().out).expect("text");
        out.lines().filter(|line| !line.starts_with('t')).collect::<Vec<_>>().join("\n")
    };
    let results: Vec<_> = modes.iter().map(|mode| made(&format!("--uv {mode}"))).collect();
    assert_eq!(made(""), results[2]);
    let different: BTreeSet<_> = results.iter().collect();
    assert!(different.len() >= 5, "{}", different.len());
    // What the file says counts if no option does.
    let tagged =
        std::fs::read_to_string(COW).unwrap() + "t facevaryinginterpolateboundary 1/0/0 5\n";
    bench.put("cow.obj", tagged);
    let report = |options: &str| {
        let args = format!("subdivide cow.obj -o out.obj --scheme catmull-clark --json {options}");
        bench.run(&args).ok().json()["scheme"]["uv"].as_str().unwrap().to_owned()
    };
    assert_ne!(report(""), "corners-plus1");
    assert_eq!(report("--uv smooth"), "smooth");
}

#[test]
fn loop_and_seamless_coordinates_are_carried_too() {
    let bench = Bench::new();
    let cut = "f 1/1 2/2 6/6\nf 1/1 6/6 5/5\nf 2/2 3/3 7/7\nf 2/2 7/7 6/6\n\
        f 5/5 6/6 10/10\nf 5/5 10/10 9/9\nf 6/13 7/14 11/17\nf 6/13 11/17 10/16\n";
    let whole = "f 1/1 2/2 6/6\nf 1/1 6/6 5/5\nf 5/5 6/6 10/10\nf 5/5 10/10 9/9\n";
    bench.put("cut.obj", seamed(cut)).put("whole.obj", seamed(whole));
    bench.run("subdivide cut.obj -o out.obj --scheme loop -l 2").ok();
    assert_eq!(seam_edges(&bench.mesh("out.obj")), 4 * seam_edges(&bench.mesh("cut.obj")));
    bench.run("subdivide whole.obj -o out.obj --scheme loop -l 2").ok();
    let mesh = bench.mesh("out.obj");
    assert_eq!(seam_edges(&mesh), 0);
    // u, v equal x, y along straight boundaries, and in the flat inside.
    for (&v, &uv) in mesh.face_vertices.iter().zip(mesh.face_uvs.as_ref().unwrap()) {
        let (p, uv) = (mesh.positions[v as usize], mesh.uvs[uv as usize]);
        assert!((p[0] - uv[0]).abs() < 1e-12 && (p[1] - uv[1]).abs() < 1e-12, "{p:?} {uv:?}");
    }
}

#[test]
fn faces_without_coordinates_have_none_afterwards() {
    let bench = Bench::new();
    let bare = "f 1/1 2/2 6/6 5/5\nf 2/2 3/3 7/7 6/6\nf 3 4 8 7\nf 5 6/6 10/10 9/9\n";
    bench.put("bare.obj", seamed(bare));
    let run = bench.run("subdivide bare.obj -o out.obj --scheme catmull-clark -l 2").ok();
    let note = "1 face lost its texture coordinates: some of its corners have none";
    assert!(run.err.contains(note), "{}", run.err);
    let mesh = bench.mesh("out.obj");
    let uvs = mesh.face_uvs.as_ref().unwrap();
    for values in uvs.chunks(4) {
        let missing = values.iter().filter(|&&uv| uv == NONE).count();
        assert!(missing == 0 || missing == 4);
    }
    assert_eq!(uvs.iter().filter(|&&uv| uv == NONE).count(), 2 * 16 * 4);
    // Two quads side by side, each 4 by 4: no value of a bare face is left over.
    assert_eq!(mesh.uvs.len(), 9 * 5);
}

#[test]
fn other_schemes_drop_seams_and_say_so() {
    let bench = Bench::new();
    bench.put("rows.obj", seamed(FACES));
    for scheme in ["three-point", "bspline --degree 3", "averaging --split primal --passes 0"] {
        let run = bench.run(&format!("subdivide rows.obj -o out.obj --scheme {scheme}")).ok();
        let note = "dropped the texture coordinates (seams at 4 of 12 vertices)";
        assert_eq!(run.err.matches(note).count(), 1, "{scheme}: {}", run.err);
        assert!(bench.mesh("out.obj").uvs.is_empty());
    }
}

#[test]
fn info_counts_seams() {
    let run = Bench::new().run(&format!("info {COW}")).ok();
    assert!(run.out_text().contains("seams             72 edges"), "{}", run.out_text());
}

/// Adaptive triangles have the seams of the control mesh and no others.
#[test]
fn seams_survive_tessellation() {
    let bench = Bench::new();
    // Bare faces among them.
    let bare = FACES.replace("f 3/3 4/4 8/8 7/7", "f 3 4 8 7");
    bench.put("rows.obj", seamed(FACES)).put("bare.obj", seamed(&bare));
    let corners = |mesh: &MeshFile, check: &dyn Fn([f64; 3], Option<[f64; 2]>)| {
        let uvs = mesh.face_uvs.as_ref().expect("texture coordinates");
        for (&v, &uv) in mesh.face_vertices.iter().zip(uvs) {
            let uv = (uv != NONE).then(|| mesh.uvs[uv as usize]);
            check(mesh.positions[v as usize], uv);
        }
    };
    for (file, seams, scheme) in [("rows", 3, "bilinear"), ("bare", 3, "bilinear")] {
        let call = format!("tessellate {file}.obj -o out.obj --scheme {scheme} --tolerance 0.1");
        let run = bench.run(&call).ok();
        assert!(!run.err.contains("dropped"), "{}", run.err);
        let mesh = bench.mesh("out.obj");
        corners(&mesh, &|[x, y, _], uv| match uv {
            Some([u, v]) => assert!((v - y).abs() < 1e-6 && ((u - x) / 10.0).fract().abs() < 1e-6),
            None => assert!(file == "bare" && x >= 2.0 && y <= 1.0, "{x} {y}"),
        });
        if file == "rows" {
            assert_eq!(seam_edges(&mesh), seams);
        }
    }
    let call = format!("tessellate {COW} -o cow.obj --scheme catmull-clark --relative 3e-3");
    bench.run(&call).ok();
    let (before, after) = (bench.mesh(COW), bench.mesh("cow.obj"));
    // Each seam edge is one edge at least, and the largest of them have become several.
    let [before, after] = [&before, &after].map(seam_edges);
    assert!(after > before && after < 16 * before, "{before} {after}");
    let refused = bench.run("tessellate rows.obj -o no.obj --scheme quartic --tolerance 0.1").ok();
    assert!(refused.err.contains("dropped the texture coordinates"), "{}", refused.err);
}
