//! Triangles of limit surfaces on the command line.

use super::bench::{Bench, CUBE, STRIP};
use carvel::Mesh;
use carvel::io::MeshFile;
use std::fmt::Write;

fn topology(of: &MeshFile) -> Mesh {
    Mesh::from_polygons(of.positions.len(), &of.face_sizes, &of.face_vertices).expect("a mesh")
}

#[test]
fn every_format_holds_the_triangles() {
    let bench = Bench::new();
    bench.put("cube.obj", CUBE);
    let mut counts = Vec::new();
    for file in ["t.obj", "t.ply", "t.off", "t.stl"] {
        let call = format!("tessellate cube.obj -o {file} --scheme catmull-clark --tolerance 0.05");
        let run = bench.run(&call).ok();
        assert!(run.err.contains("6 faces -> ") && run.err.contains(" triangles (within "));
        let mesh = bench.mesh(file);
        let normals =
            if file.ends_with("obj") || file.ends_with("ply") { mesh.positions.len() } else { 0 };
        assert!(mesh.normals.len() >= normals, "{file}");
        assert!(topology(&mesh).is_closed(), "{file}");
        counts.push(mesh.face_sizes.len());
    }
    assert!(counts.iter().all(|&n| n == counts[0] && n > 12), "{counts:?}");
}

#[test]
fn the_report_says_what_was_reached() {
    let bench = Bench::new();
    bench.put("cube.obj", CUBE);
    let call = "tessellate cube.obj -o t.obj --scheme doo-sabin --relative 0.01 --json --threads 1";
    let report = bench.run(call).ok().json();
    let number = |key: &str| report[key].as_f64().unwrap_or(f64::NAN);
    assert!(number("bound") <= number("tolerance") && number("tolerance") > 0.0, "{report}");
    assert_eq!(number("triangles"), bench.mesh("t.obj").face_sizes.len() as f64);
    assert_eq!(number("coarse_cells") + number("left_out"), 0.0);
    let call = "tessellate cube.obj -o t.obj --extraordinary tuned --relative 0.01 --json";
    let report = bench.run(call).ok().json();
    assert_eq!(report["scheme"]["extraordinary"], "tuned");
    assert_eq!(report["coarse_cells"], 0);
    let call = "tessellate cube.obj -o p.obj --pixels 20 --size 400x300 --max-levels 2 --json";
    let report = bench.run(call).ok().json();
    assert!(report["coarse_cells"].as_u64() > Some(0), "{report}");
    assert!(report["longest_edge"].as_f64() > Some(20.0), "{report}");
    assert!(report["notes"][0].as_str().is_some_and(|note| note.contains("--max-levels 2")));
}

#[test]
fn vertex_data_follow_the_surface_and_names_their_faces() {
    let bench = Bench::new();
    let colored = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n\
                   property float z\nproperty float weight\nelement face 1\n\
                   property list uchar int vertex_indices\nend_header\n\
                   0 0 0 0\n1 0 0 1\n1 1 1 2\n0 1 0 1\n4 0 1 2 3\n";
    bench.put("one.ply", colored);
    bench.run("tessellate one.ply -o t.ply --scheme bilinear --tolerance 1e-3 --ascii").ok();
    let mesh = bench.mesh("t.ply");
    assert!(mesh.face_sizes.len() > 2);
    for (p, weight) in mesh.positions.iter().zip(&mesh.attributes[0].values) {
        assert!((p[0] + p[1] - weight).abs() < 1e-6, "{p:?} {weight}");
    }
    bench.put("named.obj", format!("usemtl red\n{CUBE}"));
    bench.run("tessellate named.obj -o t.obj --tolerance 0.1").ok();
    let mesh = bench.mesh("t.obj");
    assert_eq!(mesh.materials.names, ["red"]);
    assert!(mesh.materials.of_face.iter().all(|&name| name == 0));
}

#[test]
fn where_there_is_no_surface_there_are_no_triangles() {
    let bench = Bench::new();
    bench.put("strip.obj", STRIP);
    let run = bench.run("tessellate strip.obj -o t.obj --tolerance 0.1 --scheme doo-sabin").ok();
    assert!(!run.err.contains("left out"), "{}", run.err);
    let mut grid = String::new();
    for i in 0..16 {
        writeln!(grid, "v {} {} 0", i % 4, i / 4).unwrap();
    }
    for first in (0..9).map(|i| i / 3 * 4 + i % 3 + 1) {
        writeln!(grid, "f {first} {} {} {}", first + 1, first + 5, first + 4).unwrap();
    }
    bench.put("grid.obj", grid);
    let call = "tessellate grid.obj -o t.obj --tolerance 0.1 --scheme doo-sabin --boundary none";
    let run = bench.run(call).ok();
    assert!(run.err.contains("left out 8 faces or sectors"), "{}", run.err);
}

#[test]
fn what_makes_no_sense_is_refused() {
    let bench = Bench::new();
    bench.put("cube.obj", CUBE);
    let refused = |options: &str, code, what: &str| {
        bench.run(&format!("tessellate cube.obj -o no.obj {options}")).fails(code, what);
        assert!(!bench.path().join("no.obj").exists(), "{options}");
    };
    refused("--tolerance 0", 2, "above 0");
    refused("--relative nan", 2, "above 0");
    refused("--pixels -3", 2, "above 0");
    refused("--tolerance 1e-3 --non-manifold sharpen", 2, "--non-manifold cut");
    refused("--tolerance 1e-2 --max-triangles 50", 6, "triangles");
    refused("--tolerance 1e-2 --memory 10K", 6, "bytes");
    for both in ["", "--tolerance 1 --pixels 1"] {
        let run = bench.run(&format!("tessellate cube.obj -o no.obj {both}"));
        assert!(run.code == 2 && run.err.contains("--pixels"), "{}", run.err);
    }
}
