//! The C programs under valgrind and under the sanitizers, with less to do.

use std::path::PathBuf;
use std::process::Command;

use carvel_capi_tests::compiler::{Compiler, Linkage};
use carvel_capi_tests::library::library;
use carvel_capi_tests::program::{self, Limit};
use carvel_capi_tests::{c_directory, sources, work_directory};

/// Builds a program into a directory of its own.
fn build(name: &str, tool: &str, compiler: &Compiler, linkage: Linkage) -> PathBuf {
    let directory = work_directory(&format!("{name} {tool}"));
    let objects = sources::objects(name, compiler, &directory);
    compiler.link(&objects, library(), linkage)
}

// ------------------------------------------------------------------- valgrind

#[track_caller]
fn memcheck(name: &str, arguments: &[&str]) {
    let program = build(name, "memcheck", &Compiler::usual(), Linkage::Shared);
    let mut command = Command::new("valgrind");
    command.args(["--quiet", "--leak-check=full", "--num-callers=30", "--error-exitcode=9"]);
    command.arg("--errors-for-leak-kinds=definite,indirect,possible");
    let known = c_directory().join("valgrind.supp");
    command.arg(format!("--suppressions={}", known.display()));
    program::run(command.arg(program).args(arguments), Limit::BUILD);
}

#[test]
fn meshes_are_clean() {
    memcheck("mesh", &[]);
}

#[test]
fn misuse_is_clean() {
    memcheck("misuse", &[]);
}

#[test]
fn hostile_meshes_are_clean() {
    memcheck("hostile", &["200"]);
}

#[test]
fn values_are_clean() {
    memcheck("values", &["2"]);
}

#[test]
fn hierarchies_are_clean() {
    memcheck("hierarchy", &[]);
}

#[test]
fn primal_schemes_and_tags_are_clean() {
    memcheck("primal", &[]);
}

#[test]
fn channels_are_clean() {
    memcheck("channel", &[]);
}

#[test]
fn surfaces_are_clean() {
    memcheck("surface", &[]);
    memcheck("search", &[]);
    memcheck("tessellation", &[]);
}

#[test]
fn contexts_are_clean() {
    memcheck("context", &["4"]);
}

#[test]
fn sharing_threads_are_clean() {
    memcheck("threads", &["1"]);
}

// ----------------------------------------------------------------- sanitizers

/// The host and the borders of its heap blocks under AddressSanitizer, which the
/// library's own allocations pass through as well; undefined behaviour in C.
#[track_caller]
fn sanitize(name: &str, arguments: &[&str]) {
    let flags = ["-fsanitize=address,undefined", "-fno-sanitize-recover=all", "-pthread"];
    let compiler = Compiler::new("gcc", "c99", &flags);
    let program = build(name, "sanitizers", &compiler, Linkage::Static);
    let mut command = Command::new(program);
    command.env("ASAN_OPTIONS", "detect_leaks=1:allocator_may_return_null=1");
    command.env("UBSAN_OPTIONS", "print_stacktrace=1");
    program::run(command.args(arguments), Limit::PROGRAM);
}

#[test]
fn misuse_passes_the_sanitizers() {
    sanitize("misuse", &[]);
}

#[test]
fn values_pass_the_sanitizers() {
    sanitize("values", &[]);
}

#[test]
fn hostile_meshes_pass_the_sanitizers() {
    sanitize("hostile", &[]);
}

#[test]
fn channels_pass_the_sanitizers() {
    sanitize("channel", &[]);
}
