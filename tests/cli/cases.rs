//! Some of the awkward meshes of `tests/cases` through the command.

use super::bench::{Bench, Run};
use std::path::PathBuf;

fn path(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/cases").join(format!("{name}.obj"))
}

/// Subdivides a case to `out.obj`.
fn subdivide(bench: &Bench, name: &str, options: &str) -> Run {
    std::fs::copy(path(name), bench.path().join("case.obj")).unwrap();
    bench.run(&format!("subdivide case.obj -o out.obj {options}"))
}

#[test]
fn awkward_meshes_are_refined() {
    let bench = Bench::new();
    for (name, faces) in [
        ("vertices/hub_100", 401),
        ("vertices/isolated_middle", 9),
        ("faces/thirty_gon", 61),
        ("closed/components", 60),
        ("closed/seven_vertex_torus", 42),
        ("numbers/huge", 26),
        ("numbers/subnormal", 26),
        ("boundary/slit", 27),
        ("uv/one_for_all", 26),
    ] {
        let run = subdivide(&bench, name, "--levels 1").ok();
        assert_eq!(run.err.lines().count(), 1, "{name}: {}", run.err);
        assert_eq!(bench.mesh("out.obj").face_sizes.len(), faces, "{name}");
    }
}

/// One line each, and no half-written file.
#[test]
fn what_is_no_mesh_is_refused_in_one_line() {
    let bench = Bench::new();
    for (name, code, words) in [
        ("vertices/nothing", 4, "case.obj: the file holds no mesh"),
        ("vertices/isolated_only", 4, "case.obj: there are no faces"),
        ("refused/bow_tie", 4, "case.obj:5: the faces around vertex 1 form more than one fan"),
        ("refused/three_at_an_edge", 4, "case.obj:15: edge 1-2 has 3 faces: 1, 2, 3"),
        ("refused/mobius_band", 4, "faces 1, 6 run through it in the same direction"),
        ("refused/repeated_in_a_row", 4, "case.obj:6: face 1 contains vertex 3 twice"),
        ("refused/two_gon", 4, "case.obj:7: face 2 has 2 vertices, at least 3 are needed"),
        ("refused/index_zero", 4, "case.obj:7: face 1 names vertex 0, but OBJ counts from 1"),
        ("refused/nan", 5, "case.obj:4: 'nan' is not a finite number"),
        ("refused/crease_beyond", 4, "case.obj:19: a tag names vertex 8, but the file has 8"),
        ("refused/crease_negative", 4, "case.obj:19: the sharpness '-1' is negative"),
        ("refused/crease_nan", 5, "case.obj:19: 'nan' is not a finite number"),
    ] {
        subdivide(&bench, name, "--levels 1").fails(code, words);
        assert_eq!(bench.files(), ["case.obj"], "{name}");
    }
}

#[test]
fn defects_are_cut_where_that_is_asked_for() {
    let bench = Bench::new();
    for (name, copies) in [
        ("refused/bow_tie", "1 copy of a vertex was made"),
        ("refused/klein_bottle", "3 copies of vertices were made"),
        ("refused/thirty_at_an_edge", "58 copies of vertices were made"),
        ("refused/flipped_face", "4 copies of vertices were made"),
    ] {
        let run = subdivide(&bench, name, "--levels 1 --non-manifold cut").ok();
        assert!(run.err.contains(copies), "{name}: {}", run.err);
    }
}

#[test]
fn what_is_dropped_is_told() {
    let bench = Bench::new();
    for (name, words) in [
        ("uv/tube", "dropped the texture coordinates (seams at 2 of 8 vertices)"),
        ("uv/missing", "dropped the texture coordinates (5 of 12 corners have none)"),
        ("creases/rising_chaikin", "left out 5 creases, the tags of the scheme"),
        ("holes/at_the_rim", "left out 2 holes"),
        ("refused/crease_twice", "1 creases were replaced by later ones"),
    ] {
        let run = subdivide(&bench, name, "--levels 1").ok();
        assert!(run.err.contains(words), "{name}: {}", run.err);
    }
}

#[test]
fn single_precision_has_an_end() {
    let bench = Bench::new();
    let words = "at vertex 1 is too large for single precision (counted from 0)";
    subdivide(&bench, "numbers/beyond_single", "--precision f32").fails(5, words);
    subdivide(&bench, "numbers/beyond_single", "").ok();
}
