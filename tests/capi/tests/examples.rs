//! The programs of examples/, built against an installed library as their
//! comments and their `CMakeLists.txt` say, and run.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use carvel_capi_tests::program::{self, Limit, printed};
use carvel_capi_tests::root;
use carvel_capi_tests::stage::Stage;

const C: [&str; 5] = ["refine", "animate", "errors", "cancel", "threads"];
const CXX: [&str; 4] = ["refine", "animate", "errors", "openmesh"];

/// carvel in a folder without spaces: where a shell splits what pkg-config says, as
/// in the comments, there must be none. What is built here has them.
struct Installed {
    stage: Stage,
    prefix: PathBuf,
}

impl Installed {
    fn new() -> Self {
        let stage = Stage::new("not used", &[]);
        let prefix = stage.plain.path().join("carvel");
        printed(stage.make("install").arg(format!("PREFIX={}", prefix.display())));
        Self { stage, prefix }
    }

    /// A program that was linked with it.
    fn example(&self, program: &Path) -> Command {
        let mut example = Command::new(program);
        example.env("LD_LIBRARY_PATH", self.prefix.join("lib"));
        example
    }

    /// A folder for what is built of a language.
    fn room(&self, language: &str) -> PathBuf {
        let room = self.stage.room.path().join(language);
        fs::create_dir_all(&room).expect("a folder");
        room
    }
}

fn sources(language: &str) -> PathBuf {
    root().join("examples").join(language)
}

/// The compiler's line of the comment that a source begins with.
fn command_line(source: &Path) -> String {
    let text = fs::read_to_string(source).expect("a source");
    let comment = text.split("*/").next().expect("a comment");
    assert!(comment.starts_with("/*\n * "), "{}: no comment at its start", source.display());
    let mut lines = comment.lines().filter_map(|line| line.strip_prefix(" *   g"));
    let line = lines.find(|line| line.starts_with("cc ") || line.starts_with("++ "));
    format!("g{}", line.unwrap_or_else(|| panic!("{}: no command", source.display())))
}

/// Does what the comment says, with every warning an error.
fn build_as_told(carvel: &Installed, language: &str, name: &str) -> PathBuf {
    let source = sources(language).join(name).with_extension(language);
    let room = carvel.room(language);
    let line = command_line(&source);
    assert!(line.ends_with(&format!(" -o {name}")), "{line}");
    let strict = "-Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror";
    let script = line.replacen(' ', &format!(" {strict} "), 1);
    let script = script.replace(&format!(" -o {name}"), &format!(" -o \"$1/{name}\""));
    let mut shell = Command::new("sh");
    shell.args(["-ec", &script, "sh"]).arg(&room).current_dir(sources(language));
    printed(shell.env("PKG_CONFIG_PATH", carvel.prefix.join("lib/pkgconfig")));
    room.join(name)
}

fn build_with_cmake(carvel: &Installed, language: &str) -> PathBuf {
    let build = carvel.room(language);
    let mut cmake = Command::new("cmake");
    cmake.arg("-S").arg(sources(language)).arg("-B").arg(&build);
    cmake.arg(format!("-DCMAKE_PREFIX_PATH={}", carvel.prefix.display()));
    printed(cmake.arg("-DCMAKE_C_FLAGS=-Wall -Werror").arg("-DCMAKE_CXX_FLAGS=-Wall -Werror"));
    printed(Command::new("cmake").arg("--build").arg(&build).arg("--parallel=2"));
    build
}

/// Runs an example and checks what it says.
fn check(carvel: &Installed, program: &Path) {
    let name = program.file_name().and_then(|name| name.to_str()).expect("a name");
    if name == "openmesh" {
        return check_openmesh(carvel, program);
    }
    let said = printed(&mut carvel.example(program));
    let lines: Vec<&str> = said.lines().collect();
    match name {
        "refine" => {
            let count = |start| lines.iter().filter(|line| line.starts_with(start)).count();
            // V + E + F of 10, 15, 7 is 32; of 30, 60, 32 it is 122.
            assert_eq!((count("v "), count("f "), lines.len()), (120, 122, 242));
            let further = printed(carvel.example(program).arg("3"));
            assert_eq!(further.lines().filter(|line| line.starts_with("f ")).count(), 482);
        }
        "animate" => {
            assert_eq!(lines[0], "16900 vertices, 16641 faces");
            assert_eq!(lines.len(), 25, "{said}");
            assert!(lines[1].starts_with("frame 0: ") && lines[1].contains("height 0.146805"));
            assert!(lines[7].contains("height -0.00768"), "{said}");
        }
        "errors" => {
            for line in ["[edge 0-1] [face 0] [face 1] [face 2]", "[vertex 5]", "became 15"] {
                assert!(lines.iter().any(|l| l.ends_with(line)), "no {line} in\n{said}");
            }
            let cxx = program.parent().is_some_and(|p| p.ends_with("cpp"));
            assert!(!cxx || lines.contains(&"the progress function had enough"), "{said}");
        }
        "cancel" => assert_eq!(lines, ["cancelled", "refined to level 2"]),
        "threads" => assert_eq!(lines, ["1536 vertices each, up to 0.8630 and 86.30"]),
        other => panic!("nothing is known of {other}"),
    }
}

/// The cow, as OFF and as OBJ: 180 faces, 188 vertices, closed.
fn check_openmesh(carvel: &Installed, program: &Path) {
    let cow = root().join("assets/spot/spot_control_mesh.obj");
    for (extension, faces) in [("off", "11714"), ("obj", "11714")] {
        let out = program.with_extension(extension);
        let said = printed(carvel.example(program).arg(&cow).arg(&out).arg("3"));
        assert_eq!(said, format!("180 faces became {faces}"));
        let text = fs::read_to_string(&out).expect("the refined cow");
        let written = match extension {
            "off" => text.lines().nth(1).map(|counts| counts.split(' ').nth(1) == Some(faces)),
            _ => Some(text.lines().filter(|l| l.starts_with("f ")).count().to_string() == faces),
        };
        assert_eq!(written, Some(true), "{}", out.display());
    }
    let mut missing = carvel.example(program);
    let output = program::attempt(missing.args(["missing.off", "out.off"]), Limit::PROGRAM);
    assert_eq!(output.status.code(), Some(1));
}

fn check_by_hand(language: &str, names: &[&str]) {
    let carvel = Installed::new();
    for name in names {
        check(&carvel, &build_as_told(&carvel, language, name));
    }
}

fn check_with_cmake(language: &str, names: &[&str]) {
    let carvel = Installed::new();
    let build = build_with_cmake(&carvel, language);
    for name in names {
        check(&carvel, &build.join(name));
    }
}

#[test]
fn c_examples_do_as_their_comments_say() {
    check_by_hand("c", &C);
}

#[test]
fn cxx_examples_do_as_their_comments_say() {
    check_by_hand("cpp", &CXX);
}

#[test]
fn c_examples_build_with_cmake() {
    check_with_cmake("c", &C);
}

#[test]
fn cxx_examples_build_with_cmake() {
    check_with_cmake("cpp", &CXX);
}

/// No example is forgotten by the lists above.
#[test]
fn every_example_is_run() {
    for (language, names) in [("c", &C[..]), ("cpp", &CXX[..])] {
        let mut listed: Vec<_> = names.iter().map(|name| format!("{name}.{language}")).collect();
        listed.push("CMakeLists.txt".to_owned());
        listed.sort();
        let files = fs::read_dir(sources(language)).expect("the examples");
        let mut files: Vec<_> =
            files.map(|f| f.expect("a file").file_name().into_string().expect("text")).collect();
        files.sort();
        assert_eq!(files, listed);
    }
}
