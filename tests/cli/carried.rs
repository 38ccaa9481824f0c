//! What travels with a mesh: names of faces, colours, texture coordinates.

use super::bench::{Bench, COW, STRIP};
use carvel::io::MeshFile;
use std::fmt::Write as _;
use std::fs;

/// Two quads with everything OBJ can say, and a vertex that no face uses.
const RICH: &str = "mtllib a.mtl\nv 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 2 0 0 0 0 1\nv 0 1 0 1 0 0\n\
    v 1 1 0 1 0 0\nv 2 1 0 0 0 1\nv 9 9 9 0 1 0\nvt 0 0\nvt 1 0\nvt 2 0\nvt 0 1\nvt 1 1\nvt 2 1\n\
    vn 0 0 1\no thing\ng left\nusemtl red\ns 1\nf 1/1/1 2/2/1 5/5/1 4/4/1\n\
    g right\nusemtl blue\ns off\nf 2/2/1 3/3/1 6/6/1 5/5/1\n";

#[test]
fn level_zero_keeps_everything() {
    let bench = Bench::new();
    bench.put("rich.obj", RICH);
    fs::copy(COW, bench.path().join("cow.obj")).unwrap();
    for name in ["rich", "cow"] {
        let run = bench.run(&format!("subdivide {name}.obj -o {name}0.obj --levels 0")).ok();
        assert!(!run.err.contains("note"), "{}", run.err);
        let lineless = |name: String| MeshFile {
            face_lines: Vec::new(),
            vertex_lines: Vec::new(),
            ..bench.mesh(&name)
        };
        assert_eq!(lineless(format!("{name}.obj")), lineless(format!("{name}0.obj")));
    }
}

#[test]
fn level_zero_converts_what_is_no_surface() {
    let bench = Bench::new();
    bench.put("flip.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\n");
    let run = bench.run("subdivide flip.obj -o flip.off --levels 0 --json").ok();
    assert_eq!(run.json()["counts"][0]["edges"], serde_json::Value::Null);
    assert_eq!(bench.mesh("flip.off").face_vertices, [0, 1, 2, 0, 1, 3]);
}

#[test]
fn names_of_faces_go_to_their_descendants() {
    let bench = Bench::new();
    bench.put("rich.obj", RICH);
    bench.run("subdivide rich.obj -o out.obj --scheme doo-sabin").ok();
    let mesh = bench.mesh("out.obj");
    assert_eq!(mesh.material_libraries, ["a.mtl"]);
    let mut seen = [0, 0];
    for (i, face) in mesh.faces().enumerate() {
        let x: f64 = face.iter().map(|&v| mesh.positions[v as usize][0]).sum::<f64>();
        let x = x / face.len() as f64;
        assert_eq!(mesh.objects.get(i), Some("thing"));
        let left = mesh.groups.get(i) == Some("left");
        assert_eq!(mesh.materials.get(i), Some(if left { "red" } else { "blue" }));
        assert_eq!(mesh.smoothing.get(i), left.then_some("1"));
        // Faces off the common edge x = 1 lie on the side of their name.
        assert!((x - 1.0).abs() < 0.26 || (x < 1.0) == left, "face {i} at {x}");
        seen[usize::from(left)] += 1;
    }
    assert!(seen.iter().all(|&n| n >= 10), "{seen:?}");
}

#[test]
fn vertex_data_follows_the_positions() {
    let bench = Bench::new();
    bench.put("rich.obj", RICH);
    let run = bench.run("subdivide rich.obj -o out.obj").ok();
    assert!(!run.err.contains("note"), "{}", run.err);
    let mesh = bench.mesh("out.obj");
    // Texture coordinates equal x and y in the control mesh, and so everywhere.
    assert_eq!(mesh.face_uvs.as_ref(), Some(&mesh.face_vertices));
    for &v in &mesh.face_vertices {
        let (p, uv) = (mesh.positions[v as usize], mesh.uvs[v as usize]);
        assert!((p[0] - uv[0]).abs() < 1e-14 && (p[1] - uv[1]).abs() < 1e-14, "{p:?} {uv:?}");
        assert_eq!(mesh.normals[v as usize], [0.0, 0.0, 1.0]);
    }
    let colors = mesh.colors.unwrap();
    let of = |v: usize| &colors.values[3 * v..3 * v + 3];
    assert!(colors.values.iter().all(|c| (0.0..=1.0).contains(c)));
    let isolated = mesh.positions.iter().position(|p| *p == [9.0; 3]).unwrap();
    assert_eq!(of(isolated), [0.0, 1.0, 0.0]);
    let corner = mesh.positions.iter().position(|p| *p == [2.0, 0.0, 0.0]).unwrap();
    assert_eq!(of(corner), [0.0, 0.0, 1.0]);
}

#[test]
fn seams_are_told_once_with_the_reason() {
    let bench = Bench::new();
    let run = bench.run(&format!("subdivide {COW} -o out.obj --levels 1")).ok();
    let notes: Vec<_> = run.err.lines().filter(|l| l.starts_with("carvel: note: ")).collect();
    assert_eq!(notes.len(), 1, "{}", run.err);
    assert!(notes[0].contains("dropped the texture coordinates (seams at 61 of 188 vertices)"));
    let json = bench.run(&format!("subdivide {COW} -o out.obj --levels 1 --json")).ok().json();
    assert!(json["notes"][0].as_str().unwrap().contains("seams"));
    assert!(bench.mesh("out.obj").uvs.is_empty());
    let quiet = bench.run(&format!("subdivide {COW} -o out.obj --quiet")).ok();
    assert!(quiet.err.is_empty(), "{}", quiet.err);
}

#[test]
fn the_cow_keeps_a_name_per_face() {
    let bench = Bench::new();
    let mut named = String::new();
    for (i, line) in fs::read_to_string(COW).unwrap().lines().enumerate() {
        if line.starts_with("f ") {
            writeln!(named, "usemtl m{i}").unwrap();
        }
        writeln!(named, "{line}").unwrap();
    }
    bench.put("cow.obj", named);
    bench.run("subdivide cow.obj -o out.obj --levels 2").ok();
    let (control, mesh) = (bench.mesh("cow.obj"), bench.mesh("out.obj"));
    let mut children = vec![0; control.face_sizes.len()];
    for (i, face) in mesh.faces().enumerate() {
        let name = mesh.materials.get(i).unwrap();
        let parent = control.materials.names.iter().position(|n| n == name).unwrap();
        children[parent] += 1;
        // Every face lies about where the face of its name does.
        let of = control.faces().nth(parent).unwrap();
        let center = centroid(&control, of);
        let reach = of.iter().map(|&v| distance(center, control.positions[v as usize]));
        let reach = reach.fold(0.0, f64::max);
        assert!(distance(centroid(&mesh, face), center) < 3.0 * reach, "face {i} of {name}");
    }
    assert!(children.iter().all(|&n| n > 2), "{children:?}");
}

fn centroid(mesh: &MeshFile, face: &[u32]) -> [f64; 3] {
    let sum = |k: usize| face.iter().map(|&v| mesh.positions[v as usize][k]).sum::<f64>();
    [0, 1, 2].map(|k| sum(k) / face.len() as f64)
}

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>().sqrt()
}

#[test]
fn what_a_format_cannot_hold_is_told() {
    let bench = Bench::new();
    bench.put("rich.obj", RICH);
    let run = bench.run("subdivide rich.obj -o out.off --levels 0").ok();
    for what in ["groups", "materials"] {
        let lines = run.err.lines().filter(|l| l.contains(what) && l.contains("off cannot hold"));
        assert_eq!(lines.count(), 1, "{what}: {}", run.err);
    }
}

#[test]
fn copies_made_by_a_cut_carry_colours() {
    let bench = Bench::new();
    let bow = "v 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 1 1 0 1 0 0\nv -1 0 0 1 0 0\nv -1 -1 0 1 0 0\n\
        f 1 2 3\nf 1 4 5\n";
    bench.put("bow.obj", bow);
    bench.run("subdivide bow.obj -o out.obj --non-manifold cut --levels 1").ok();
    let colors = bench.mesh("out.obj").colors.unwrap();
    assert!(colors.values.chunks(3).all(|c| (c[0] - 1.0).abs() < 1e-15 && c[1..] == [0.0, 0.0]));
}

#[test]
fn ply_attributes_are_refined() {
    let bench = Bench::new();
    let ply = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n\
        property float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n\
        property double heat\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n\
        0 0 0 255 0 0 0\n1 0 0 255 0 0 1\n1 1 0 255 0 0 1\n0 1 0 255 0 0 0\n4 0 1 2 3\n";
    bench.put("quad.ply", ply);
    bench.run("subdivide quad.ply -o out.ply --ascii --levels 3").ok();
    let mesh = bench.mesh("out.ply");
    assert_eq!(mesh.attributes[0].name, "heat");
    for (p, heat) in mesh.positions.iter().zip(&mesh.attributes[0].values) {
        assert!((p[0] - heat).abs() < 1e-6, "{p:?} {heat}");
    }
    assert!(mesh.colors.unwrap().values.chunks(3).all(|c| c == [1.0, 0.0, 0.0]));
}

#[test]
fn tags_are_kept_at_level_zero_and_told_where_they_are_not() {
    let bench = Bench::new();
    let tags = "t crease 2/1/0 1 4 2.5\nt corner 2/1/0 0 2 10\nt creasemethod 0/0/1 chaikin\n";
    bench.put("tags.obj", format!("{STRIP}{tags}"));
    let run = bench.run("subdivide tags.obj -o kept.obj --levels 0").ok();
    assert!(!run.err.contains("note"), "{}", run.err);
    let (before, after) = (bench.mesh("tags.obj"), bench.mesh("kept.obj"));
    assert_eq!((before.creases, before.sharp_vertices), (after.creases, after.sharp_vertices));
    assert_eq!(before.scheme, after.scheme);
    let run = bench.run("subdivide tags.obj -o out.obj --levels 1").ok();
    let note = "left out 1 crease, 2 sharp vertices, the tags of the scheme: \
        three-point has none, catmull-clark, loop and bilinear have";
    assert!(run.err.contains(note), "{}", run.err);
    assert!(bench.mesh("out.obj").creases.is_empty());
}
