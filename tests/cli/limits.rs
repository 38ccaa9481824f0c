//! Limits and normals on the command line.

use super::bench::{Bench, CUBE, STRIP};

fn apart(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    a.iter().zip(b).fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()))
}

/// A vertex of a primal scheme that stays has its limit at every level.
#[test]
fn vertices_go_to_the_surface() {
    let bench = Bench::new();
    bench.put("cube.obj", CUBE);
    bench.run("subdivide cube.obj -o limit.obj --scheme catmull-clark --levels 1 --limit").ok();
    bench.run("subdivide cube.obj -o plain.obj --scheme catmull-clark --levels 1").ok();
    bench.run("subdivide cube.obj -o deep.ply --scheme catmull-clark --levels 6").ok();
    let [limit, plain, deep] = ["limit.obj", "plain.obj", "deep.ply"].map(|file| bench.mesh(file));
    assert_eq!(limit.face_vertices, plain.face_vertices);
    for v in 0..limit.positions.len() {
        let [there, far] = [&deep, &plain].map(|m| apart(&limit.positions[v], &m.positions[v]));
        assert!(there < 1e-3 && far > 10.0 * there, "vertex {v}: {there} {far}");
    }
}

#[test]
fn normals_are_those_of_the_surface() {
    let bench = Bench::new();
    bench.put("cube.obj", CUBE);
    for scheme in ["three-point", "doo-sabin", "catmull-clark"] {
        for file in ["normals.obj", "normals.ply"] {
            let call = format!("subdivide cube.obj -o {file} --scheme {scheme} --normals --limit");
            bench.run(&call).ok();
            let mesh = bench.mesh(file);
            assert_eq!(mesh.normals.len(), mesh.positions.len(), "{scheme} {file}");
            let middle = [0, 1, 2].map(|k| {
                mesh.positions.iter().map(|p| p[k]).sum::<f64>() / mesh.positions.len() as f64
            });
            for (normal, position) in mesh.normals.iter().zip(&mesh.positions) {
                let dot = |a: &[f64; 3], b: &[f64; 3]| a.iter().zip(b).map(|(a, b)| a * b).sum();
                let out: [f64; 3] = std::array::from_fn(|k| position[k] - middle[k]);
                // The bench's cube shows its inside.
                let (length, inward): (f64, f64) = (dot(normal, normal), -dot(normal, &out));
                let far: f64 = dot(&out, &out);
                assert!((length - 1.0).abs() < 1e-12 && inward > 0.9 * far.sqrt());
            }
        }
    }
}

#[test]
fn what_has_no_limit_is_refused_and_nothing_written() {
    let bench = Bench::new();
    bench.put("cube.obj", CUBE);
    bench.put("strip.obj", STRIP);
    bench.run("subdivide cube.obj -o no.obj --levels 0 --normals").fails(2, "--levels 0");
    let refused = "subdivide strip.obj -o no.obj --boundary none --limit";
    bench.run(refused).fails(4, "(boundary none)");
    assert!(!bench.path().join("no.obj").exists());
}
