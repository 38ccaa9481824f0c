//! Holes: refined, and left out of the file.

use super::bench::{Bench, faces_by_vertex};
use std::fmt::Write as _;

/// A grid of 4 by 4 quads with texture coordinates equal to x and y, a group for each face,
/// colours, creases along x = 1 and an isolated vertex in front.
fn grid(tags: &str) -> String {
    let mut text = "v 9 9 9 1 1 1\n".to_owned();
    for (x, y) in (0..25).map(|i| (i % 5, i / 5)) {
        writeln!(text, "v {x} {y} 0 {} 0 0\nvt {x} {y}", f64::from(x) / 4.0).unwrap();
    }
    for (x, y) in (0..16).map(|i| (i % 4, i / 4)) {
        let corner = |x: u32, y: u32| format!("{}/{}", 2 + x + 5 * y, 1 + x + 5 * y);
        let corners = [corner(x, y), corner(x + 1, y), corner(x + 1, y + 1), corner(x, y + 1)];
        writeln!(text, "g face{}\nf {}", x + 4 * y, corners.join(" ")).unwrap();
    }
    for y in 0..4 {
        writeln!(text, "t crease 2/1/0 {} {} 10", 2 + 5 * y, 7 + 5 * y).unwrap();
    }
    text + tags
}

#[test]
fn tagged_faces_are_left_out_with_what_only_they_use() {
    let bench = Bench::new();
    // The square from 1 to 3 in both directions but for its upper right quarter.
    bench.put("grid.obj", grid("t hole 1/0/0 5\nt hole 1/0/0 6\nt hole 1/0/0 9\n"));
    let options = "--scheme catmull-clark --levels 2";
    let run = bench.run(&format!("subdivide grid.obj -o out.obj {options}")).ok();
    let note = "left out 48 faces, which are holes (--keep-holes keeps them)";
    assert!(run.err.contains(note), "{}", run.err);
    assert!(run.err.contains("16 faces -> 208 faces"), "{}", run.err);
    bench.run(&format!("subdivide grid.obj -o kept.obj {options} --keep-holes")).ok();
    let (mesh, kept) = (bench.mesh("out.obj"), bench.mesh("kept.obj"));
    assert_eq!((mesh.face_sizes.len(), kept.face_sizes.len()), (208, 256));
    // Inside the L are 3·9 points of quarters and 2·3 of the edges between them.
    assert_eq!(kept.positions.len() - mesh.positions.len(), 33);
    assert_eq!(kept.uvs.len() - mesh.uvs.len(), 33);
    assert_eq!(mesh.positions.iter().filter(|p| **p == [9.0; 3]).count(), 1);
    assert!(mesh.holes.is_empty());
    assert_eq!(kept.holes.len(), 48);
    for (i, face) in mesh.faces().enumerate() {
        let middle = |k: usize| {
            face.iter().map(|&v| mesh.positions[v as usize][k]).sum::<f64>() / face.len() as f64
        };
        let name = mesh.groups.get(i).unwrap();
        let number = middle(0).floor() + 4.0 * middle(1).floor();
        assert_eq!(name, format!("face{number}"));
        assert!(![5.0, 6.0, 9.0].contains(&number));
    }
    // Attributes are in step with the vertices: all are linear in x.
    let (uvs, colors) = (mesh.face_uvs.unwrap(), mesh.colors.unwrap());
    for (&v, &uv) in mesh.face_vertices.iter().zip(&uvs) {
        let (p, uv) = (mesh.positions[v as usize], mesh.uvs[uv as usize]);
        assert!((p[0] - uv[0]).abs() < 1e-12 && (p[1] - uv[1]).abs() < 1e-12, "{p:?} {uv:?}");
        let red = colors.values[3 * v as usize];
        assert!((p[0] / 4.0 - red).abs() < 1e-12, "{p:?} {red}");
    }
}

#[test]
fn creases_inside_holes_go_with_them() {
    let bench = Bench::new();
    // Both faces beside the second crease are holes, the vertices at its ends stay.
    bench.put("grid.obj", grid("t hole 1/0/0 4\nt hole 1/0/0 5\n"));
    bench.run("subdivide grid.obj -o out.obj --scheme catmull-clark --levels 1").ok();
    let mesh = bench.mesh("out.obj");
    assert_eq!(mesh.creases.len(), 6);
    let edge = |face: &[u32], ends: [u32; 2]| {
        let next = face.iter().cycle().skip(1);
        face.iter().zip(next).any(|(&a, &b)| [a, b] == ends || [b, a] == ends)
    };
    for crease in &mesh.creases {
        assert!(mesh.faces().any(|face| edge(face, crease.vertices)), "{crease:?}");
    }
    bench.run("subdivide out.obj -o again.obj --scheme catmull-clark --levels 1").ok();
}

#[test]
fn kept_holes_stay_holes() {
    let bench = Bench::new();
    bench.put("grid.obj", grid("t hole 1/0/0 5\nt hole 1/0/0 9\n"));
    let scheme = "--scheme catmull-clark";
    bench.run(&format!("subdivide grid.obj -o one.obj {scheme} --levels 1 --keep-holes")).ok();
    bench.run(&format!("subdivide one.obj -o two.obj {scheme} --levels 1")).ok();
    bench.run(&format!("subdivide grid.obj -o once.obj {scheme} --levels 2")).ok();
    let (two, once) = (bench.mesh("two.obj"), bench.mesh("once.obj"));
    assert_eq!(faces_by_vertex(&two).len(), faces_by_vertex(&once).len());
    assert_eq!(two.positions.len(), once.positions.len());
}

#[test]
fn without_a_boundary_rule_the_rim_is_a_hole() {
    let bench = Bench::new();
    bench.put("grid.obj", grid(""));
    let args = "subdivide grid.obj -o out.obj --levels 1 --boundary none --json --scheme";
    let json = bench.run(&format!("{args} catmull-clark")).ok().json();
    assert_eq!(json["holes_left_out"], 48);
    assert!(json["notes"][0].as_str().unwrap().contains("left out 48 faces"));
    assert_eq!(bench.mesh("out.obj").face_sizes.len(), 16);
    assert_eq!(bench.run(&format!("{args} bilinear")).ok().json()["holes_left_out"], 0);
    bench.put("quad.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
    bench
        .run("subdivide quad.obj -o none.obj --scheme catmull-clark --boundary none")
        .fails(4, "quad.obj: all faces are holes (--keep-holes keeps them)");
    let kept = "subdivide quad.obj -o kept.obj --scheme catmull-clark --boundary none --keep-holes";
    bench.run(kept).ok();
    assert_eq!(bench.mesh("kept.obj").holes.len(), 16);
    assert_eq!(bench.files(), ["grid.obj", "kept.obj", "out.obj", "quad.obj"]);
}
