//! Pictures from the command line.

use super::bench::{Bench, CUBE, STRIP};

/// Width and height from the header of a PNG file.
fn size(png: &[u8]) -> (u32, u32) {
    assert_eq!(&png[..8], b"\x89PNG\r\n\x1a\n");
    let number = |at: usize| u32::from_be_bytes(png[at..at + 4].try_into().unwrap());
    (number(16), number(20))
}

#[test]
fn preview_draws_one_or_several_meshes() {
    let bench = Bench::new();
    bench.put("cube.obj", CUBE).put("strip.obj", STRIP);
    bench.run("preview cube.obj -o one.png --size 120x90").ok();
    assert_eq!(size(&bench.get("one.png")), (120, 90));
    bench.run("preview cube.obj strip.obj -o two.png --size 120x90").ok();
    assert_eq!(size(&bench.get("two.png")), (240, 90));
    let out = bench.run("preview cube.obj -o - --size 120x90").ok().out;
    assert_eq!(out, bench.get("one.png"));
}

#[test]
fn every_option_changes_the_picture() {
    let bench = Bench::new();
    bench.put("cube.obj", CUBE);
    let draw = |options: &str| bench.run(&format!("preview cube.obj -o - --size 99x77 {options}"));
    let plain = draw("").ok().out;
    for options in [
        "--azimuth -20",
        "--elevation 80",
        "--background #204060",
        "--wireframe overlay",
        "--wireframe only",
        "--shading flat",
        "--up z",
    ] {
        assert_ne!(draw(options).ok().out, plain, "{options}");
    }
}

#[test]
fn subdivide_draws_what_it_writes() {
    let bench = Bench::new();
    bench.put("cube.obj", CUBE).put("strip.obj", STRIP);
    let options = "--size 99x77 --wireframe overlay";
    bench.run(&format!("subdivide cube.obj -o out.obj --preview a.png {options}")).ok();
    bench.run(&format!("preview out.obj -o b.png {options}")).ok();
    assert_eq!(bench.get("a.png"), bench.get("b.png"));
    let all = "subdivide cube.obj strip.obj -o made/ --preview made/ --size 99x77 --json";
    let json = bench.run(all).ok().json();
    assert_eq!(size(&bench.get("made/strip.png")), (99, 77));
    assert_eq!(json[0]["preview"], "made/cube.png");
}

#[test]
fn a_picture_that_cannot_be_written_leaves_the_old_one() {
    let bench = Bench::new();
    bench.put("cube.obj", CUBE).put("old.png", "precious").put("bad.obj", "f 1 2 3\n");
    bench.run("preview bad.obj -o old.png").fails(4, "bad.obj:1");
    bench.run("subdivide bad.obj -o out.obj --preview old.png").fails(4, "bad.obj:1");
    bench.run("subdivide cube.obj -o out.obj --preview none/a.png").fails(7, "no directory none");
    assert_eq!(bench.get("old.png"), b"precious");
    assert_eq!(bench.files(), ["bad.obj", "cube.obj", "old.png"]);
}
