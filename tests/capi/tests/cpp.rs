//! The C++ interface: programs with g++ and clang++, with both libraries.

use std::path::{Path, PathBuf};
use std::process::Command;

use carvel_capi_tests::compiler::{Compiler, Linkage};
use carvel_capi_tests::header;
use carvel_capi_tests::library::library;
use carvel_capi_tests::program::{self, Limit};
use carvel_capi_tests::{root, work_directory};

/// Where Debian and a local installation have Eigen, as a system's header.
const EIGEN: [&str; 3] =
    ["-pthread", "-isystem/usr/include/eigen3", "-isystem/usr/local/include/eigen3"];
const PROGRAMS: [&str; 8] =
    ["handles", "errors", "arrays", "progress", "queries", "stencils", "surface", "masks"];

fn source(name: &str) -> PathBuf {
    root().join("tests/capi/cpp").join(format!("{name}.cpp"))
}

fn compiler(name: &'static str, standard: &'static str, flags: &[&'static str]) -> Compiler {
    Compiler::new(name, standard, &[&EIGEN, flags].concat())
}

/// Compiles and links a program; every call has a directory of its own.
#[track_caller]
fn build(name: &str, compiler: &Compiler, linkage: Linkage, directory: &str) -> PathBuf {
    let object = compiler.compile(&source(name), &work_directory(directory));
    compiler.link(&[object], library(), linkage)
}

#[track_caller]
fn run(name: &str, command: &mut Command) {
    let out = program::run(command, Limit::PROGRAM);
    assert_eq!(out.stdout, format!("{name}: ok\n"));
}

#[track_caller]
fn run_all(compiler: &Compiler, linkage: Linkage, directory: &str) {
    for name in PROGRAMS {
        run(name, &mut Command::new(build(name, compiler, linkage, directory)));
    }
}

#[test]
fn programs_run_with_gcc_and_the_shared_library() {
    run_all(&compiler("g++", "c++17", &[]), Linkage::Shared, "cpp gcc");
}

#[test]
fn programs_run_with_clang_and_the_static_library() {
    run_all(&compiler("clang++", "c++20", &[]), Linkage::Static, "cpp clang");
}

/// Every other standard takes the header and what the programs make of it.
#[test]
fn every_standard_takes_it() {
    for (name, standard) in
        [("g++", "c++20"), ("g++", "c++2b"), ("clang++", "c++17"), ("clang++", "c++2b")]
    {
        let mut command = compiler(name, standard, &[]).command();
        command.arg("-fsyntax-only").args(["errors", "queries"].map(source));
        program::run(&mut command, Limit::PROGRAM);
    }
}

#[test]
fn no_exceptions_are_needed() {
    for (name, standard) in [("g++", "c++17"), ("clang++", "c++20")] {
        let compiler = compiler(name, standard, &["-fno-exceptions"]);
        let program = build("no_exceptions", &compiler, Linkage::Shared, "cpp no exceptions");
        run("no_exceptions", &mut Command::new(program));
    }
}

/// Files with and without exceptions in one program must not share functions.
#[test]
fn both_styles_link_together() {
    let directory = work_directory("cpp both styles");
    let with = compiler("g++", "c++17", &["-Dmain=other_main"]);
    let without = compiler("g++", "c++17", &["-fno-exceptions"]);
    let objects = [
        without.compile(&source("no_exceptions"), &directory),
        with.compile(&source("progress"), &directory),
    ];
    let defined = |object: &Path| {
        let mut nm = Command::new("nm");
        let out = program::run(nm.args(["-C", "--defined-only"]).arg(object), Limit::TOOL);
        let names = out.stdout.lines().filter_map(|l| l.splitn(3, ' ').nth(2));
        names.filter(|n| n.starts_with("carvel::")).map(str::to_owned).collect::<Vec<_>>()
    };
    let (first, second) = (defined(&objects[0]), defined(&objects[1]));
    assert!(first.len() > 20 && second.len() > 20, "{first:#?} {second:#?}");
    let shared: Vec<_> = first.iter().filter(|n| second.contains(n)).collect();
    assert!(shared.is_empty(), "{shared:#?}");
    let program = with.link(&objects, library(), Linkage::Shared);
    run("no_exceptions", &mut Command::new(program));
}

#[test]
fn sanitizers_find_nothing() {
    let flags = ["-fsanitize=address,undefined", "-fno-sanitize-recover=all"];
    let compiler = compiler("g++", "c++20", &flags);
    for name in ["arrays", "errors", "progress"] {
        let program = build(name, &compiler, Linkage::Shared, "cpp sanitizers");
        // One allocation of these programs is meant to fail.
        run(name, Command::new(program).env("ASAN_OPTIONS", "allocator_may_return_null=1"));
    }
}

#[test]
fn valgrind_finds_nothing() {
    for name in ["handles", "progress"] {
        let program = build(name, &compiler("g++", "c++17", &[]), Linkage::Shared, "cpp valgrind");
        let mut valgrind = Command::new("valgrind");
        // A list of threads that rayon keeps for the next pool is "possibly lost".
        valgrind.args(["--quiet", "--error-exitcode=9", "--leak-check=full"]);
        valgrind.args(["--show-leak-kinds=definite", "--errors-for-leak-kinds=definite"]);
        let out = program::run(valgrind.arg(program), Limit::BUILD);
        assert_eq!(out.stdout, format!("{name}: ok\n"));
        assert_eq!(out.stderr, "");
    }
}

#[test]
fn meshes_of_openmesh_go_there_and_back() {
    let flags = ["-Wl,--no-as-needed", "-lOpenMeshCore"];
    let program =
        build("openmesh", &compiler("g++", "c++17", &flags), Linkage::Shared, "cpp openmesh");
    let cow = root().join("assets/spot/spot_control_mesh.obj");
    run("openmesh", Command::new(program).arg(cow));
}

#[test]
fn unusable_layouts_are_refused_by_the_compiler() {
    let mut command = compiler("g++", "c++17", &[]).command();
    command.arg("-fsyntax-only").arg(source("refused"));
    let out = program::attempt(&mut command, Limit::PROGRAM);
    assert!(!out.status.success(), "{}", program::report(&command, &out));
    for message in [
        "rows of a column-major matrix do not lie together; store the matrix row-major",
        "columns of a row-major matrix do not lie together; store the matrix column-major",
        "say whether the records are rows(matrix) or columns(matrix)",
        "values are float or double",
        "refined faces have four corners and more: write to a PolyMesh_ArrayKernelT",
    ] {
        let message = format!("carvel: {message}");
        assert!(out.stderr.contains(&message), "no '{message}' in\n{}", out.stderr);
    }
}

#[test]
fn the_headers_example_runs() {
    let directory = work_directory("cpp example");
    let source = directory.join("pyramid.cpp");
    std::fs::write(&source, header::example("carvel.hpp")).expect("a place for the example");
    let compiler = compiler("g++", "c++17", &[]);
    let object = compiler.compile(&source, &directory);
    let mut program = Command::new(compiler.link(&[object], library(), Linkage::Shared));
    assert_eq!(program::run(&mut program, Limit::PROGRAM).stdout, "66 faces\n");
}
