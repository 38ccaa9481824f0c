//! Where results go.

use super::bench::{Bench, CUBE, STRIP};
use std::fs;

#[test]
fn several_inputs_keep_their_names_in_a_directory() {
    let bench = Bench::new();
    bench.put("cube.obj", CUBE).put("strip.obj", STRIP);
    for out in ["made/", "named", "."] {
        let run = bench.run(&format!("subdivide cube.obj strip.obj -o {out} --format off"));
        assert_eq!(run.code, 0, "{}", run.err);
        let faces = |name: &str| bench.mesh(&format!("{out}/{name}")).face_sizes.len();
        assert_eq!((faces("cube.off"), faces("strip.off")), (98, 45));
    }
    bench.run("subdivide cube.obj strip.obj -o kept").ok();
    assert_eq!(bench.mesh("kept/cube.obj").face_sizes.len(), 98);
    bench.run("subdivide cube.obj -o made").ok();
    assert!(bench.path().join("made/cube.obj").exists());
}

/// What is no mesh follows links as meshes do, also one to nothing yet.
#[cfg(unix)]
#[test]
fn links_are_followed_whatever_is_written() {
    let bench = Bench::new();
    bench.put("cube.obj", CUBE).put("line.csv", "0,0\n1,0\n1,1\n");
    let link = |name: &str| bench.path().join(name);
    for (command, name) in [
        ("subdivide cube.obj", "mesh.obj"),
        ("curve line.csv", "curve.csv"),
        ("curve line.csv", "curve.svg"),
        ("stencils cube.obj", "table.npz"),
        ("preview cube.obj", "picture.png"),
    ] {
        let (there, dangling) = (format!("there_{name}"), format!("dangling_{name}"));
        std::os::unix::fs::symlink(&there, link(&dangling)).unwrap();
        for _ in 0..2 {
            bench.run(&format!("{command} -o {dangling}")).ok();
            assert!(fs::symlink_metadata(link(&dangling)).unwrap().is_symlink(), "{name}");
            assert!(fs::symlink_metadata(link(&there)).unwrap().is_file(), "{name}");
        }
    }
    std::os::unix::fs::symlink("round.csv", link("round.csv")).unwrap();
    bench.run("curve line.csv -o round.csv").fails(7, "round.csv");
    // Of a place that nothing can be made in the name alone is told, not that of the new file.
    let run = bench.run("curve line.csv -o /proc/none.csv");
    assert!(run.code == 7 && !run.err.contains(".tmp"), "{}", run.err);
}

#[test]
fn names_that_would_clash_are_refused_before_any_work() {
    let bench = Bench::new();
    fs::create_dir(bench.path().join("a")).unwrap();
    bench.put("a/cube.obj", CUBE).put("cube.obj", CUBE).put("cube.off", "OFF\n");
    let before = bench.files();
    bench.run("subdivide cube.obj a/cube.obj -o out/").fails(2, "both cube.obj and a/cube.obj");
    bench.run("subdivide cube.obj cube.off -o out/ --format ply").fails(2, "out/cube.ply: both");
    bench.run("subdivide cube.obj cube.off -o out.obj").fails(2, "several inputs need a directory");
    bench.run("subdivide cube.obj cube.off -o -").fails(2, "several inputs need a directory");
    bench.run("subdivide cube.obj cube.off -o .").fails(2, "this input would be replaced");
    bench.run("subdivide cube.obj -o x.png --format obj --preview x.png").fails(2, "both the mesh");
    bench.run("subdivide - -o out/").fails(2, "has no name to keep");
    assert_eq!(bench.files(), before);
}

#[test]
fn one_bad_input_does_not_stop_the_others() {
    let bench = Bench::new();
    bench.put("cube.obj", CUBE).put("bad.obj", "f 1 2 3\n").put("strip.obj", STRIP);
    let run =
        bench.run("subdivide cube.obj bad.obj strip.obj -o out/ --json").fails(4, "bad.obj:1:");
    assert!(bench.path().join("out/strip.obj").exists());
    assert!(!bench.path().join("out/bad.obj").exists());
    let json = run.json();
    assert_eq!(json.as_array().unwrap().len(), 3);
    assert_eq!(json[1]["error"]["exit_code"], 4);
    assert_eq!(json[2]["counts"][2]["faces"], 45);
}

#[test]
fn standard_streams() {
    let bench = Bench::new();
    bench.put("cube.obj", CUBE);
    bench.run("subdivide cube.obj -o file.obj").ok();
    let run = bench.run_with_input("subdivide - -o -", CUBE.as_bytes()).ok();
    assert_eq!(run.out, bench.get("file.obj"));
    let run = bench.run("subdivide cube.obj -o - --format ply").ok();
    let back = "subdivide - -o back.obj --input-format ply --levels 0";
    bench.run_with_input(back, &run.out).ok();
    assert_eq!(bench.get("back.obj"), bench.get("file.obj"));
    let run = bench.run("subdivide cube.obj -o - --json --levels 1").ok();
    let json: serde_json::Value = serde_json::from_str(&run.err).unwrap();
    assert_eq!(json["counts"][1]["faces"], 26);
    assert!(run.out.starts_with(b"v "));
    bench.run_with_input("info -", CUBE.as_bytes()).ok();
}

#[test]
fn a_report_on_the_error_stream_is_alone_there() {
    let bench = Bench::new();
    bench.put("cube.obj", CUBE);
    for (command, noted) in [
        ("subdivide cube.obj -o - --format stl --json", true),
        ("tessellate cube.obj -o - --format stl --relative 1e-1 --json", true),
        ("stencils cube.obj -o - --format mtx --json", false),
    ] {
        let run = bench.run(command).ok();
        let report: serde_json::Value = serde_json::from_str(&run.err).expect(command);
        let notes = report["notes"].as_array().or(report[0]["notes"].as_array()).expect(command);
        assert_eq!(!notes.is_empty(), noted, "{command}: {report}");
    }
}

#[test]
fn a_reader_that_goes_away_is_no_error() {
    let bench = Bench::new();
    bench.put("cube.obj", CUBE);
    let mut command = bench.command("subdivide cube.obj -o - --levels 6");
    command.stdout(std::process::Stdio::piped()).stderr(std::process::Stdio::piped());
    let mut child = command.spawn().unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(0));
    assert!(output.stderr.is_empty(), "{}", String::from_utf8_lossy(&output.stderr));
}

#[cfg(unix)]
#[test]
fn an_interruption_leaves_nothing() {
    interrupted("subdivide cube.obj -o out.obj --levels 10");
    interrupted("curve square.csv -o out.obj --closed --scheme chaikin --steps 20");
}

/// Interrupts a command that writes `out.obj` while it does so.
#[cfg(unix)]
fn interrupted(command: &str) {
    use std::process::Stdio;
    let bench = Bench::new();
    bench
        .put("cube.obj", CUBE)
        .put("square.csv", "0,0\n1,0\n1,1\n0,1\n")
        .put("out.obj", "precious");
    let before = bench.files();
    let child = bench.command(command).stderr(Stdio::piped()).spawn().unwrap();
    // The temporary file says that writing has begun; it takes its time.
    let start = std::time::Instant::now();
    while bench.files() == before {
        assert!(start.elapsed().as_secs() < 100, "{command}: nothing was written");
        std::thread::sleep(std::time::Duration::from_millis(1));
    }
    let pid = child.id().to_string();
    let kill = std::process::Command::new("kill").args(["-s", "INT", &pid]).status();
    assert!(kill.unwrap().success());
    let output = child.wait_with_output().unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(8), "{command}: {said}");
    assert_eq!(bench.get("out.obj"), b"precious");
    assert_eq!(bench.files(), before);
}
