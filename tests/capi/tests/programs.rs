//! The C programs: compiled in every dialect, linked with both libraries, run.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::Command;

use carvel_capi_tests::compiler::{Compiler, Linkage};
use carvel_capi_tests::header::{self, Header};
use carvel_capi_tests::library::library;
use carvel_capi_tests::program::{self, Limit};
use carvel_capi_tests::{root, sources, work_directory};
use serde_json::Value;

/// Builds a program as most are and runs it with both libraries.
#[track_caller]
fn run_with_both(name: &str, arguments: &[&Path]) -> Vec<program::Output> {
    run_with(name, &Linkage::ALL, arguments)
}

#[track_caller]
fn run_with(name: &str, linkages: &[Linkage], arguments: &[&Path]) -> Vec<program::Output> {
    let (compiler, directory) = (Compiler::usual(), work_directory(name));
    let objects = sources::objects(name, &compiler, &directory);
    let run = |&linkage: &Linkage| {
        let program = compiler.link(&objects, library(), linkage);
        program::run(Command::new(program).args(arguments), Limit::PROGRAM)
    };
    linkages.iter().map(run).collect()
}

#[test]
fn meshes_answer_as_computed_by_hand() {
    run_with_both("mesh", &[]);
}

#[test]
fn hostile_meshes_are_refused() {
    run_with_both("hostile", &[]);
}

#[test]
fn every_wrong_call_is_refused() {
    run_with_both("misuse", &[]);
}

/// Unoptimised, a mesh of 40 k faces takes minutes; a quarter of them will do.
#[test]
fn running_out_of_memory_is_answered() {
    let side = Path::new(if cfg!(debug_assertions) { "80" } else { "200" });
    for output in run_with("allocation", &[Linkage::Shared], &[side]) {
        assert!(output.stderr.contains("create hierarchy: "), "{}", output.stderr);
    }
}

#[test]
fn values_of_any_layout_are_refined() {
    run_with_both("values", &[]);
}

#[test]
fn hierarchies_keep_all_levels() {
    run_with_both("hierarchy", &[]);
}

#[test]
fn stencil_tables_do_what_hierarchies_do() {
    let file = work_directory("stencil file").join("table");
    run_with_both("stencils", &[&file]);
}

#[test]
fn surfaces_are_evaluated_anywhere() {
    run_with_both("surface", &[]);
}

#[test]
fn surfaces_are_searched() {
    run_with_both("search", &[]);
}

#[test]
fn surfaces_become_triangles() {
    run_with_both("tessellation", &[]);
}

#[test]
fn masks_answer_as_computed_by_hand() {
    run_with_both("mask", &[]);
}

#[test]
fn primal_schemes_and_tags_do_as_opensubdiv_says() {
    run_with_both("primal", &[]);
}

#[test]
fn channels_keep_their_seams() {
    run_with_both("channel", &[]);
}

#[test]
fn contexts_bring_threads_and_limits() {
    run_with_both("context", &[]);
}

#[test]
fn threads_share_what_may_be_shared() {
    run_with_both("threads", &[]);
}

#[test]
fn a_refiner_at_work_is_busy() {
    run_with_both("busy", &[]);
}

#[test]
fn nothing_grows_in_ten_thousand_rounds() {
    run_with("churn", &[Linkage::Shared], &[]);
}

// ------------------------------------------------------------------- dialects

fn check_dialects(compiler: &'static str, standards: &[&'static str]) {
    let directory = work_directory(&format!("dialects {compiler} {}", standards[0]));
    for &standard in standards {
        let compiler = Compiler::new(compiler, standard, &[]);
        let objects = sources::objects("dialects", &compiler, &directory);
        for linkage in Linkage::ALL {
            let program = compiler.link(&objects, library(), linkage);
            program::run(&mut Command::new(program), Limit::PROGRAM);
        }
    }
}

const C: [&str; 4] = ["c89", "c99", "c11", "c2x"];
const CXX: [&str; 4] = ["c++98", "c++11", "c++17", "c++20"];

#[test]
fn gcc_takes_every_c() {
    check_dialects("gcc", &C);
}

#[test]
fn gcc_takes_every_cxx() {
    check_dialects("gcc", &CXX);
}

#[test]
fn clang_takes_every_c() {
    check_dialects("clang", &C);
}

#[test]
fn clang_takes_every_cxx() {
    check_dialects("clang", &CXX);
}

// -------------------------------------------------------------------- example

#[test]
fn the_headers_example_runs() {
    let directory = work_directory("example");
    let source = directory.join("pyramid.c");
    std::fs::write(&source, header::example("carvel.h")).expect("a place for the example");
    // The pages' own warnings, but for the habits that examples may have.
    let compiler = Compiler::new("gcc", "c99", &["-Wno-conversion"]);
    let object = compiler.compile(&source, &directory);
    for linkage in Linkage::ALL {
        let program = compiler.link(std::slice::from_ref(&object), library(), linkage);
        let out = program::run(&mut Command::new(program), Limit::PROGRAM);
        assert_eq!(out.stdout, "66 faces, the first vertex is at 0.846042 0.381449 0.542318\n");
    }
}

// --------------------------------------------------------------------- golden

fn golden_files() -> Vec<PathBuf> {
    let directory = root().join("tests/golden");
    let entries = std::fs::read_dir(directory).expect("tests/golden can be listed");
    let mut paths: Vec<_> = entries.map(|e| e.expect("a directory entry").path()).collect();
    paths.retain(|p| p.extension().is_some_and(|e| e == "json"));
    paths.sort();
    paths
}

fn load(path: &Path) -> Value {
    let text = std::fs::read_to_string(path).expect("a golden file");
    serde_json::from_str(&text).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

fn items(value: &Value) -> &[Value] {
    value.as_array().expect("a list")
}

/// The number that the header gives to a name.
fn number_of(name: &Value, names: &[&str]) -> usize {
    let found = names.iter().position(|&n| name == n);
    found.unwrap_or_else(|| panic!("{name} is none of {names:?}"))
}

/// Vertices, faces, corners, sizes, indices and positions.
fn write_mesh(out: &mut String, positions: &Value, faces: &Value) {
    let (positions, faces) = (items(positions), items(faces));
    let corners: Vec<&Value> = faces.iter().flat_map(items).collect();
    let sizes: Vec<String> = faces.iter().map(|f| items(f).len().to_string()).collect();
    let indices: Vec<String> = corners.iter().map(ToString::to_string).collect();
    let counts = format!("{} {} {}", positions.len(), faces.len(), corners.len());
    writeln!(out, "{counts}\n{}\n{}", sizes.join(" "), indices.join(" ")).expect("a string");
    for point in positions {
        let xyz: Vec<String> = items(point).iter().map(ToString::to_string).collect();
        writeln!(out, "{}", xyz.join(" ")).expect("a string");
    }
}

/// A case as golden.c reads it.
fn write_case(out: &mut String, header: &Header, case: &Value) {
    let name = case["name"].as_str().expect("a name");
    let family = match &case["split"] {
        split if split == "dual" => header.constant("CARVEL_SCHEME_AVERAGING"),
        split if split == "primal" => header.constant("CARVEL_SCHEME_PRIMAL"),
        other => panic!("{name}: the split {other}"),
    };
    let rule = number_of(&case["corner_rule"], &["cosine", "average"]);
    let boundary = number_of(&case["boundary"], &["edge-corner", "edge", "none"]);
    let passes = items(&case["passes"]);
    let levels = &case["levels"];
    writeln!(out, "{name} {levels} {family} {rule} {boundary} {}", passes.len()).expect("a string");
    for pass in passes {
        let (p, q) = split_fraction(pass.as_str().expect("a fraction"));
        writeln!(out, "{p} {q}").expect("a string");
    }
    write_mesh(out, &case["positions"], &case["faces"]);
    write_mesh(out, &case["out_positions"], &case["out_faces"]);
}

fn split_fraction(text: &str) -> (&str, &str) {
    text.split_once('/').unwrap_or((text, "1"))
}

#[test]
fn golden_cases_are_reproduced() {
    let cases: Vec<Value> = golden_files().iter().map(|p| load(p)).collect();
    let header = Header::read(&header::text());
    let names: Vec<&str> = cases.iter().map(|c| c["name"].as_str().expect("a name")).collect();
    assert!(names.contains(&"prism_primal_cubic_2"), "no primal case in {names:?}");
    assert!(names.len() >= 18, "golden cases are missing: {} found", names.len());
    let mut list = String::new();
    for case in &cases {
        write_case(&mut list, &header, case);
    }
    let path = work_directory("golden").join("cases.txt");
    std::fs::write(&path, list).expect("a place for the cases");
    for output in run_with_both("golden", &[&path]) {
        let ran: Vec<&str> = output.stdout.lines().collect();
        assert_eq!(ran, names);
    }
}
