//! The awkward meshes of `tests/cases`, run from C.

#[path = "../../cases/case.rs"]
mod case;

use std::collections::HashSet;
use std::fmt::Write as _;
use std::process::Command;

use carvel_capi_tests::compiler::{Compiler, Linkage};
use carvel_capi_tests::header::{self, Header};
use carvel_capi_tests::library::library;
use carvel_capi_tests::program::{self, Limit};
use carvel_capi_tests::{root, sources, work_directory};
use case::{Case, Outcome};

/// The number that the header gives to an outcome: `NonManifoldEdge` is
/// `CARVEL_STATUS_NON_MANIFOLD_EDGE`.
fn status(header: &Header, outcome: &Outcome) -> String {
    let Outcome::Error(kind) = outcome else { return "0".to_owned() };
    let mut name = "CARVEL_STATUS".to_owned();
    for c in kind.chars() {
        if c.is_ascii_uppercase() {
            name.push('_');
        }
        name.push(c.to_ascii_uppercase());
    }
    header.constant(&name)
}

/// True if an outcome is about coordinates.
fn of_values(outcome: &Outcome) -> bool {
    matches!(outcome, Outcome::Error(kind) if kind == "NotFinite")
}

/// A case as cases.c reads it.
fn write_case(out: &mut String, header: &Header, case: &Case) {
    // Creating a mesh says what is wrong with its topology, refining what with values.
    let values = |outcome: &Outcome| of_values(outcome).then(|| status(header, outcome));
    let values = |outcome| values(outcome).unwrap_or_else(|| "0".to_owned());
    let topology = |outcome: &Outcome| (!of_values(outcome)).then(|| status(header, outcome));
    let topology = |outcome| topology(outcome).unwrap_or_else(|| "0".to_owned());
    let plain = case.expected("");
    let single = case.special("f32").unwrap_or(plain);
    let may_be = case.may_fail.clone().map_or(Outcome::Ok, Outcome::Error);
    let statuses = [
        topology(plain),
        topology(case.expected("cut")),
        topology(case.expected("sharpen")),
        topology(case.expected("tags")),
        values(plain),
        values(single),
        status(header, &may_be),
    ];
    let counts = [case.positions.len(), case.sizes.len(), case.indices.len()];
    writeln!(out, "{} {}", case.name, statuses.join(" ")).expect("a string");
    writeln!(out, "{}", joined(&counts)).expect("a string");
    writeln!(out, "{}\n{}", joined(&case.sizes), joined(&case.indices)).expect("a string");
    for point in &case.positions {
        writeln!(out, "{}", joined(point)).expect("a string");
    }
    write_tags(out, case);
}

/// Creases, sharp vertices and holes; sharpness as its bits.
fn write_tags(out: &mut String, case: &Case) {
    let counts = [case.creases.len(), case.sharp_vertices.len(), case.holes.len()];
    writeln!(out, "{}", joined(&counts)).expect("a string");
    for ([a, b], sharpness) in &case.creases {
        writeln!(out, "{a} {b} {}", sharpness.to_bits()).expect("a string");
    }
    for (vertex, sharpness) in &case.sharp_vertices {
        writeln!(out, "{vertex} {}", sharpness.to_bits()).expect("a string");
    }
    writeln!(out, "{}", joined(&case.holes)).expect("a string");
}

fn joined<T: ToString>(values: &[T]) -> String {
    let words: Vec<String> = values.iter().map(ToString::to_string).collect();
    words.join(" ")
}

/// All cases, each once: some differ in what C does not read.
fn cases() -> Vec<Case> {
    let mut seen = HashSet::new();
    let mut cases = case::all(&root().join("tests/cases"));
    cases.retain(|case| {
        let bits: Vec<u64> = case.positions.as_flattened().iter().map(|x| x.to_bits()).collect();
        let mut tags = String::new();
        write_tags(&mut tags, case);
        seen.insert((bits, case.sizes.clone(), case.indices.clone(), tags))
    });
    cases
}

#[test]
fn every_scheme_runs_every_case() {
    let (header, cases) = (Header::read(&header::text()), cases());
    assert!(cases.len() >= 60, "cases are missing: {} found", cases.len());
    let mut list = String::new();
    for case in &cases {
        write_case(&mut list, &header, case);
    }
    let (compiler, directory) = (Compiler::usual(), work_directory("cases"));
    let path = directory.join("cases.txt");
    std::fs::write(&path, list).expect("a place for the cases");
    let objects = sources::objects("cases", &compiler, &directory);
    let program = compiler.link(&objects, library(), Linkage::Shared);
    let output = program::run(Command::new(program).arg(&path), Limit::PROGRAM);
    let names: Vec<&str> = cases.iter().map(|case| case.name.as_str()).collect();
    assert_eq!(output.stdout.lines().collect::<Vec<_>>(), names);
}
