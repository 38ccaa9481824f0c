//! Inputs that are wrong: one line, a documented code, nothing written.

use super::bench::{Bench, CUBE};
use std::fs;

const POINTS: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 2 2\nv 3 3 3\n";

/// Runs a file through `subdivide` onto an existing output.
#[track_caller]
fn refused(name: &str, content: impl AsRef<[u8]>, code: i32, words: &str) {
    refused_with(name, content, "", code, words);
}

#[track_caller]
fn refused_with(name: &str, content: impl AsRef<[u8]>, options: &str, code: i32, words: &str) {
    let bench = Bench::new();
    bench.put(name, content).put("out.obj", "precious");
    let before = bench.files();
    let run = bench.run(&format!("subdivide {name} -o out.obj {options}")).fails(code, words);
    assert!(run.err.contains(name), "{}", run.err);
    assert_eq!(bench.get("out.obj"), b"precious");
    assert_eq!(bench.files(), before, "nothing is left over");
    let run = bench.run(&format!("subdivide {name} -o new.obj {options}"));
    assert_eq!(run.code, code);
    assert_eq!(bench.files(), before, "nothing is written");
}

#[track_caller]
fn refused_faces(faces: &str, words: &str) {
    refused("mesh.obj", format!("{POINTS}{faces}"), 4, words);
}

#[test]
fn files_without_a_surface() {
    refused("mesh.obj", "", 4, "mesh.obj: the file holds no mesh");
    refused("mesh.obj", POINTS, 4, "mesh.obj: there are no faces");
    refused("mesh.off", "", 3, "mesh.off");
    refused("mesh.ply", "", 3, "mesh.ply");
    refused("mesh.stl", "solid a\nendsolid a\n", 4, "no mesh");
}

#[test]
fn faces_that_are_none() {
    refused_faces("f 0 1 2\n", "mesh.obj:7: face 1 names vertex 0");
    refused_faces("f 1 2 -9\n", "mesh.obj:7: face 1");
    refused_faces("f 1 2 3\nf 1 2 99\n", "mesh.obj:8: face 2 names vertex 99");
    refused_faces("f 1 2\n", "mesh.obj:7: face 1 has 2 vertices");
    refused_faces("f 1 2 3 2\n", "mesh.obj:7: face 1 contains vertex 2 twice");
}

#[test]
fn faces_that_do_not_fit_together() {
    let three = "f 1 2 3\nf 2 1 4\nf 1 2 5\n";
    refused_faces(three, "mesh.obj:9: edge 1-2 has 3 faces: 1, 2, 3");
    let flipped = "f 1 2 3\nf 1 2 4\n";
    refused_faces(flipped, "mesh.obj:8: edge 1-2: faces 1, 2 run through it in the same direction");
    refused_faces("f 1 2 3\nf 1 5 6\n", "mesh.obj:1: the faces around vertex 1 form more than one");
    refused_faces("f 1 2 3 2\nf 4 5 4\n", "(and one more defect: see carvel info)");
}

#[test]
fn other_formats_count_from_zero() {
    let off = "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 1 3\n";
    refused("mesh.off", off, 4, "mesh.off:8: edge 0-1: faces 0, 1 run");
}

#[test]
fn numbers_that_are_none() {
    for (number, code) in [("nan", 5), ("inf", 5), ("-inf", 5), ("1e999", 5), ("1x", 3)] {
        let content = format!("v 0 0 0\nv 1 0 0\nv 0 {number} 0\nf 1 2 3\n");
        refused("mesh.obj", content, code, "mesh.obj:3: ");
    }
}

#[test]
fn numbers_that_leave_the_range() {
    let content = CUBE.replace("v 1 1 1", "v 1e39 1 1");
    refused_with("mesh.obj", &content, "--precision f32", 5, "mesh.obj:8: the value 1e39");
    refused_with("mesh.obj", &content, "--precision f32 --levels 0", 5, "");
    let content = CUBE.replace(" 1", " 1.7e308").replace("f 1.7e308", "f 1");
    let content: String = content
        .lines()
        .map(|l| if l.starts_with('f') { l.replace("1.7e308", "1") } else { l.to_owned() } + "\n")
        .collect();
    let passes = "--scheme averaging --passes 900";
    refused_with("mesh.obj", &content, passes, 5, "leaves the range of the number type");
}

#[test]
fn files_that_break_off_or_make_no_sense() {
    refused("mesh.obj", "v 0 0 0\nv 1 0", 3, "mesh.obj:2: ");
    refused("mesh.off", "OFF\n4 2 0\n0 0 0\n", 3, "mesh.off");
    refused("mesh.ply", "ply\nformat binary_little_endian 1.0\n", 3, "mesh.ply");
    let noise: Vec<u8> = (0..400_u32).map(|i| (i * i * 31 + i * 17 + 128) as u8).collect();
    for name in ["mesh.obj", "mesh.off", "mesh.ply", "mesh.stl"] {
        refused(name, &noise, 3, name);
    }
}

#[test]
fn a_directory_or_nothing_as_input() {
    let bench = Bench::new();
    fs::create_dir(bench.path().join("dir.obj")).unwrap();
    bench.run("subdivide dir.obj -o out.obj").fails(3, "dir.obj: is a directory");
    bench.run("subdivide none.obj -o out.obj").fails(3, "none.obj: ");
    bench.run("info none.obj").fails(3, "none.obj: ");
    bench.run("preview none.obj -o out.png").fails(3, "none.obj: ");
    assert_eq!(bench.files(), ["dir.obj"]);
}

#[test]
fn sizes_that_do_not_fit() {
    let many = "--levels 64";
    refused_with("mesh.obj", CUBE, many, 6, "level 14 of 64 is too large: ");
    refused_with("mesh.obj", CUBE, "--levels 5 --memory 100K", 6, "the ceiling is 102400");
    refused_with("mesh.obj", CUBE, "--levels 12 --memory 100M", 6, "bytes are needed");
}

#[test]
fn outputs_that_cannot_be_written() {
    let bench = Bench::new();
    bench.put("cube.obj", CUBE);
    bench.run("subdivide cube.obj -o none/out.obj").fails(7, "there is no directory none");
    bench.run("subdivide cube.obj -o cube.obj/").fails(7, "cube.obj/: not a directory");
    if cfg!(target_os = "linux") {
        bench.run("subdivide cube.obj -o /proc/out.obj").fails(7, "/proc/out.obj: ");
        bench.run("preview cube.obj -o /proc/out.png").fails(7, "/proc/out.png: ");
        bench.run("subdivide cube.obj -o /dev/full --format obj").fails(7, "/dev/full: ");
    }
    assert_eq!(bench.files(), ["cube.obj"]);
}

#[test]
fn anchored_is_checked() {
    let fan = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n";
    refused_with("mesh.obj", fan, "--anchored", 4, "cannot be anchored");
}

#[test]
fn cut_repairs_what_error_refuses() {
    let bench = Bench::new();
    bench.put("bow.obj", format!("{POINTS}f 1 2 3\nf 1 5 6\n"));
    let run = bench.run("subdivide bow.obj -o out.obj --non-manifold cut --levels 1").ok();
    assert!(run.err.contains("1 copy of a vertex was made"), "{}", run.err);
    assert_eq!(bench.mesh("out.obj").face_sizes.len(), 2 + 6 + 6);
}
