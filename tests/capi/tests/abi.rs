//! The header, the library and the C tests speak of the same interface, and it is
//! the one that was recorded.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::Command;

use carvel_capi_tests::header::{self, Header};
use carvel_capi_tests::library::{Library, library, symbols};
use carvel_capi_tests::program::{self, Limit};
use carvel_capi_tests::version::{series, version};
use carvel_capi_tests::{agreement, library, root, sources, work_directory};

#[test]
fn the_librarys_types_are_those_of_the_header() {
    let header = Header::read(&header::text());
    let directory = work_directory("agreement");
    let out = agreement::compile(&header, library(), &directory);
    assert!(out.status.success(), "{}", out.stderr);
}

/// Plants a mistake in the header and expects the check to name it.
#[track_caller]
fn assert_refused(right: &str, wrong: &str, named: &str) {
    let text = header::text();
    assert!(text.contains(right), "the header has no '{right}'");
    let header = Header::read(&text.replacen(right, wrong, 1));
    let directory = work_directory(&format!("agreement of {named}"));
    let out = agreement::compile(&header, library(), &directory);
    assert!(!out.status.success(), "'{wrong}' was not noticed");
    assert!(out.stderr.contains(named), "{}", out.stderr);
}

#[test]
fn a_dropped_const_is_noticed() {
    assert_refused(
        "carvel_mesh_validate(const carvel_mesh *mesh",
        "carvel_mesh_validate(carvel_mesh *mesh",
        "carvel_mesh_validate",
    );
    assert_refused("const uint32_t *face_sizes;", "uint32_t *face_sizes;", "face_sizes");
    assert_refused("const char *carvel_version", "char *carvel_version", "carvel_version");
}

#[test]
fn a_changed_width_is_noticed() {
    assert_refused(
        "uint32_t level, carvel_counts *counts,",
        "uint64_t level, carvel_counts *counts,",
        "carvel_hierarchy_counts",
    );
    assert_refused(
        "uint32_t carvel_hierarchy_last_level(",
        "uint64_t carvel_hierarchy_last_level(",
        "carvel_hierarchy_last_level",
    );
    assert_refused("uint32_t thread_count;", "uint64_t thread_count;", "carvel_context_desc");
    assert_refused("typedef int32_t carvel_status;", "typedef int64_t carvel_status;", "i64");
    assert_refused("    uint64_t degree;", "    int64_t degree;", "degree");
    assert_refused("double done,", "float done,", "carvel_progress");
}

#[test]
fn moved_fields_and_numbers_are_noticed() {
    assert_refused("    uint64_t second;\n", "", "carvel_element");
    assert_refused("    uint64_t count;\n    /* Values in", "    /* Values in", "count");
    assert_refused("CARVEL_STATUS_PANIC = 108", "CARVEL_STATUS_PANIC = 110", "CARVEL_STATUS_PANIC");
    assert_refused("CARVEL_ORIGIN_CORNER = 4", "CARVEL_ORIGIN_NOOK = 4", "CARVEL_ORIGIN_NOOK");
}

#[test]
fn a_function_that_the_library_lacks_is_noticed() {
    let right = "CARVEL_API void carvel_mesh_destroy(";
    let wrong = "CARVEL_API void carvel_mesh_vanish(void);\n".to_owned() + right;
    assert_refused(right, &wrong, "carvel_mesh_vanish");
}

/// Every constant of the library is one of the header.
#[test]
fn the_library_has_no_constants_of_its_own() {
    let header: BTreeSet<String> =
        Header::read(&header::text()).enumerators().into_iter().collect();
    let folder = std::fs::read_dir(root().join("src/capi")).expect("the sources");
    let mut own = BTreeSet::new();
    for file in folder {
        let text = std::fs::read_to_string(file.expect("a file").path()).expect("a text");
        let words = text.split(|c: char| !c.is_ascii_alphanumeric() && c != '_');
        own.extend(words.filter(|word| word.starts_with("CARVEL_")).map(str::to_owned));
    }
    assert_eq!(own, header);
}

/// The functions that a shared library exports.
fn exports(shared: &Path) -> BTreeSet<String> {
    symbols(&["--dynamic", "--defined-only"], shared)
}

#[test]
fn header_exports_and_tests_have_the_same_functions() {
    let header = Header::read(&header::text()).function_names();
    assert_eq!(exports(&library().shared), header, "exported and declared");
    assert_eq!(sources::called_functions(), header, "called by the C tests and declared");
}

/// A shared library made of the static one that lacks a function.
fn library_without(function: &str) -> PathBuf {
    let directory = work_directory("missing export");
    let (script, shared) = (directory.join("exports.map"), directory.join("libcarvel.so"));
    let kept = Header::read(&header::text()).function_names();
    let kept = kept.iter().filter(|name| *name != function).cloned().collect::<Vec<_>>();
    let text = format!("{{ global: {}; local: *; }};", kept.join("; "));
    std::fs::write(&script, text).expect("a version script");
    let mut link = Command::new("gcc");
    link.args(["-shared", "-o"]).arg(&shared).arg("-Wl,--whole-archive").arg(&library().archive);
    link.arg("-Wl,--no-whole-archive").arg(format!("-Wl,--version-script={}", script.display()));
    program::run(&mut link, Limit::BUILD);
    shared
}

#[test]
fn a_missing_export_is_noticed() {
    let missing = "carvel_scheme_passes";
    let exported = exports(&library_without(missing));
    let header = Header::read(&header::text()).function_names();
    let lost: Vec<&String> = header.difference(&exported).collect();
    assert_eq!(lost, [missing]);
}

#[test]
fn the_versions_agree() {
    let header = Header::read(&header::text());
    let number = |name: &str| header.constant(&format!("CARVEL_VERSION_{name}"));
    let parts = [number("MAJOR"), number("MINOR"), number("PATCH")].join(".");
    assert_eq!(parts, version());
    assert_eq!(number("STRING"), format!("b\"{parts}\\0\""));
}

/// The recorded interface of this series of versions.
fn recorded() -> PathBuf {
    root().join(format!("tests/capi/abi/carvel-{}.abi", series()))
}

/// The library with all of its debug information.
fn described() -> Library {
    if cfg!(debug_assertions) {
        return library().clone();
    }
    let target = library::target_directory().join("described");
    library::build(&target, "cargo", &library::DESCRIBED, &[])
}

/// Compares interfaces; the differences, or nothing.
fn differences(old: &Path, new: &Path) -> String {
    let mut abidiff = Command::new("abidiff");
    abidiff.args(["--no-show-locs", "--harmless"]).arg(old).arg(new);
    let out = program::attempt(&mut abidiff, Limit::TOOL);
    // Bits 1 and 2: it could not compare; 4 and 8: there are differences.
    let code = out.status.code().unwrap_or(1);
    assert_eq!(code & 3, 0, "{}", program::report(&abidiff, &out));
    if code == 0 { String::new() } else { out.stdout }
}

/// `make abi-record` sets the variable and keeps what this test finds.
#[test]
fn the_interface_is_the_recorded_one() {
    let library = described();
    if std::env::var_os("CARVEL_RECORD_ABI").is_some() {
        let mut abidw = Command::new("abidw");
        abidw.args(["--no-corpus-path", "--no-comp-dir-path", "--no-show-locs", "--no-elf-needed"]);
        abidw.args(["--type-id-style", "hash", "--out-file"]);
        program::run(abidw.arg(recorded()).arg(&library.shared), Limit::TOOL);
    }
    let found = differences(&recorded(), &library.shared);
    assert!(found.is_empty(), "{found}\nMeant? See docs/abi.md, then `make abi-record`.");
    assert_notices_changes(&library);
}

/// The comparison is not blind: planted changes of the record are found.
fn assert_notices_changes(library: &Library) {
    let record = std::fs::read_to_string(recorded()).expect("the record");
    let directory = work_directory("abidiff");
    let planted = |name: &str, from: &str, to: &str| {
        assert!(record.contains(from), "the record has no {from}");
        let file = directory.join(format!("{name}.abi"));
        std::fs::write(&file, record.replace(from, to)).expect("a file to write");
        differences(&file, &library.shared)
    };
    let lost = planted("lost", "'carvel_mesh_survey'", "'carvel_mesh_review'");
    assert!(lost.contains("carvel_mesh_review"), "{lost}");
    let size = "name='carvel_context_desc' size-in-bits='256'";
    let wide = planted("wide", size, &size.replace("256", "320"));
    assert!(wide.contains("type size changed from 320 to 256"), "{wide}");
}
