//! `make install` and `make uninstall`, and programs that find the library through
//! pkg-config and CMake.

use std::fs;
use std::os::unix::fs::symlink;
use std::path::{Path, PathBuf};
use std::process::Command;

use carvel_capi_tests::library::{dynamic, native_libraries, rustc, symbols};
use carvel_capi_tests::program::{printed, refused};
use carvel_capi_tests::stage::{Stage, tree};
use carvel_capi_tests::version::{series, version};
use carvel_capi_tests::{c_directory, root};

#[test]
fn all_is_installed_where_it_belongs() {
    let stage = Stage::installed("/opt/carvel kernel", &[]);
    let (version, series) = (version(), series());
    let found = tree(&stage.at(""));
    for file in [
        "include/carvel.h",
        "include/carvel.hpp",
        "lib/cmake/carvel/carvelConfig.cmake",
        "lib/cmake/carvel/carvelConfigVersion.cmake",
        "lib/libcarvel.a",
        "lib/libcarvel.so",
        &format!("lib/libcarvel.so.{series}"),
        &format!("lib/libcarvel.so.{version}"),
        "lib/pkgconfig/carvel.pc",
        "share/carvel/manifest",
        "share/doc/carvel/LICENSE-APACHE",
        "share/doc/carvel/LICENSE-MIT",
    ] {
        assert!(found.iter().any(|name| name == file), "{file} is not in {found:#?}");
    }
    let link = |name: &str| fs::read_link(stage.at("lib").join(name)).expect("a link");
    assert_eq!(link("libcarvel.so"), Path::new(&format!("libcarvel.so.{series}")));
    let soname = format!("libcarvel.so.{series}");
    assert_eq!(link(&soname), Path::new(&format!("libcarvel.so.{version}")));
    let library = stage.at("lib").join(format!("libcarvel.so.{version}"));
    assert!(fs::symlink_metadata(&library).expect("the library").is_file());
    assert_eq!(dynamic(&library, "(SONAME)"), [soname]);
    // Nothing that is installed knows of the stage or of the sources.
    for file in found.iter().filter(|name| name.contains("Config") || name.contains("carvel.pc")) {
        let text = fs::read_to_string(stage.at(file)).expect("text");
        assert!(!text.contains("carvel stage") && !text.contains('@'), "{file}: {text}");
    }
}

#[test]
fn only_the_interface_is_exported() {
    let stage = Stage::installed("/usr/local", &[]);
    let shared = symbols(&["-D", "--defined-only"], &stage.at("lib/libcarvel.so"));
    let fixed = symbols(&["-g", "--defined-only"], &stage.at("lib/libcarvel.a"));
    assert!(shared.contains("carvel_version"), "{shared:?}");
    assert_eq!(shared, fixed);
    let others: Vec<_> = shared.iter().filter(|name| !name.starts_with("carvel_")).collect();
    assert!(others.is_empty(), "{others:?}");
    let sections = printed(Command::new("readelf").arg("-SW").arg(stage.at("lib/libcarvel.a")));
    for name in [" .debug_", " .llvmbc", " GROUP "] {
        assert!(!sections.contains(name), "{name} in libcarvel.a");
    }
    assert!(sections.contains(" .text."), "functions have sections of their own");
}

/// pkg-config's answer, for a stage that has a DESTDIR or none.
fn pkg_config(stage: &Stage, arguments: &[&str]) -> String {
    let mut pkg_config = Command::new("pkg-config");
    pkg_config.env_remove("PKG_CONFIG_PATH").env("PKG_CONFIG_LIBDIR", stage.at("lib/pkgconfig"));
    if let Some(destdir) = stage.destdir() {
        // By a name without spaces, which pkgconf 1.8 would put before the paths twice.
        let sysroot = stage.plain.path().join("sysroot");
        if !sysroot.exists() {
            symlink(destdir, &sysroot).expect("a link");
        }
        pkg_config.env("PKG_CONFIG_SYSROOT_DIR", sysroot);
    }
    printed(pkg_config.args(arguments).arg("carvel"))
}

/// C and C++ through both libraries with the flags that pkg-config gives.
fn build_with_pkg_config(stage: &Stage, more: &[&str]) {
    let shared = pkg_config(stage, &[more, &["--cflags", "--libs"]].concat());
    let fixed = pkg_config(stage, &[more, &["--static", "--cflags", "--libs"]].concat());
    // As carvel.pc says it: by its name, or the linker takes the shared one.
    let fixed = fixed.replace("-lcarvel", "-l:libcarvel.a");
    let soname = format!("libcarvel.so.{}", series());
    for (compiler, source) in [("cc", "install_main.c"), ("c++ -std=c++17", "install_main.cpp")] {
        for (flags, name, is_shared) in [(&shared, "shared", true), (&fixed, "static", false)] {
            assert_eq!(stage.program(compiler, source, flags, name), version());
            let needed = dynamic(&stage.room.path().join(name), "(NEEDED)");
            assert_eq!(needed.contains(&soname), is_shared, "{name}: {needed:?}");
        }
    }
}

/// Few systems miss one of the libraries today, so that linking alone does not show that
/// they are there.
#[test]
fn static_programs_get_the_system_libraries() {
    let stage = Stage::installed("a prefix", &[]);
    let needed = native_libraries();
    assert!(needed.len() > 1, "{needed:?}");
    let libraries = pkg_config(&stage, &["--static", "--libs-only-l"]);
    assert_eq!(libraries, format!("-lcarvel {}", needed.join(" ")));
    let shared = pkg_config(&stage, &["--libs-only-l"]);
    assert_eq!(shared, "-lcarvel");
    printed(&mut configure(&stage, "install_cmake.txt", &[]));
    let libraries = fs::read_to_string(stage.room.path().join("a host/build/libraries"));
    assert_eq!(libraries.expect("text"), needed.join(";"));
}

#[test]
fn programs_find_it_through_pkg_config() {
    let stage = Stage::installed("a prefix", &[]);
    assert_eq!(pkg_config(&stage, &["--modversion"]), version());
    build_with_pkg_config(&stage, &[]);
}

#[test]
fn programs_find_a_stage_through_pkg_config() {
    build_with_pkg_config(&Stage::installed("/opt/carvel kernel", &[]), &[]);
}

#[test]
fn a_moved_tree_is_found_through_pkg_config() {
    let stage = Stage::installed("a prefix", &[]);
    let moved = moved(&stage);
    build_with_pkg_config(&moved, &["--define-prefix"]);
}

/// What is installed there, in another place.
fn moved(stage: &Stage) -> Stage {
    let moved = Stage::new("moved away", &[]);
    fs::rename(stage.at(""), moved.at("")).expect("the tree moves");
    moved
}

/// CMake's program and build folder for `lists`.
fn configure(stage: &Stage, lists: &str, arguments: &[&str]) -> Command {
    let source = stage.room.path().join("a host");
    fs::create_dir_all(&source).expect("a folder");
    fs::copy(c_directory().join(lists), source.join("CMakeLists.txt")).expect("a copy");
    for name in ["install_main.c", "install_main.cpp"] {
        fs::copy(c_directory().join(name), source.join(name)).expect("a copy");
    }
    let mut cmake = Command::new("cmake");
    cmake.arg("-S").arg(&source).arg("-B").arg(source.join("build")).args(arguments);
    cmake.arg(format!("-DCMAKE_PREFIX_PATH={}", stage.at("").display()));
    cmake
}

fn build_with_cmake(stage: &Stage) {
    let names = ["shared_c", "shared_cpp", "static_c", "static_cpp"];
    build_these_with_cmake(stage, &names, &[]);
}

fn build_these_with_cmake(stage: &Stage, names: &[&str], arguments: &[&str]) {
    let build = stage.room.path().join("a host/build");
    let arguments = [&["-DCMAKE_C_FLAGS=-Wall -Werror"], arguments].concat();
    printed(&mut configure(stage, "install_cmake.txt", &arguments));
    assert_eq!(fs::read_to_string(build.join("version")).expect("text"), version());
    printed(Command::new("cmake").arg("--build").arg(&build));
    let soname = format!("libcarvel.so.{}", series());
    for name in names {
        // The path to the library is in the program, as CMake leaves it in build folders.
        assert_eq!(printed(&mut Command::new(build.join(name))), version());
        let needed = dynamic(&build.join(name), "(NEEDED)");
        assert_eq!(needed.contains(&soname), name.starts_with("shared"), "{name}: {needed:?}");
    }
}

#[test]
fn programs_find_it_through_cmake() {
    build_with_cmake(&Stage::installed("a prefix", &[]));
}

#[test]
fn programs_find_a_moved_stage_through_cmake() {
    build_with_cmake(&moved(&Stage::installed("/opt/carvel kernel", &[])));
}

#[test]
fn cmake_grants_versions_of_the_same_series_only() {
    let stage = Stage::installed("a prefix", &[]);
    let expected = [
        ("0.1", "yes"),
        ("0.1.0", "yes"),
        ("0.1.1", "no"),
        ("0", "no"),
        ("0.0", "no"),
        ("0.2", "no"),
        ("0.10", "no"),
        ("1.0", "no"),
        ("1", "no"),
        ("0.0...0.1", "yes"),
        ("0.1...<0.2", "yes"),
        ("0.0...<0.1", "no"),
        ("0.2...1.0", "no"),
    ];
    assert_eq!(version(), "0.1.0", "the requests above are made for this version");
    let requests: Vec<_> = expected.iter().map(|(request, _)| *request).collect();
    let requests = format!("-DREQUESTS={}", requests.join(";"));
    printed(&mut configure(&stage, "install_versions.txt", &[&requests]));
    let answers = fs::read_to_string(stage.room.path().join("a host/build/answers"));
    let expected: Vec<_> = expected.iter().map(|(r, answer)| format!("{r} {answer}")).collect();
    assert_eq!(answers.expect("text").lines().collect::<Vec<_>>(), expected);
}

#[test]
fn cmake_says_what_is_missing() {
    let stage = Stage::installed("a prefix", &[]);
    let shared = format!("lib/libcarvel.so.{}", version());
    for file in [shared.as_str(), "include/carvel.h", "include/carvel.hpp"] {
        let aside = stage.room.path().join("aside");
        fs::rename(stage.at(file), &aside).expect("the file goes");
        let said = refused(&mut configure(&stage, "install_cmake.txt", &[]));
        let name = file.rsplit('/').next().expect("a name");
        assert!(said.contains(&format!("{name} is missing")), "{said}");
        fs::rename(aside, stage.at(file)).expect("the file comes back");
    }
    printed(&mut configure(&stage, "install_cmake.txt", &[]));
}

/// Distributions leave the static library out; who asks for it is told so by name.
#[test]
fn cmake_does_without_the_static_library() {
    let stage = Stage::installed("a prefix", &[]);
    fs::remove_file(stage.at("lib/libcarvel.a")).expect("the library goes");
    build_these_with_cmake(&stage, &["shared_c", "shared_cpp"], &["-DWITH_STATIC=OFF"]);
    let said = refused(&mut configure(&stage, "install_cmake.txt", &["-DWITH_STATIC=ON"]));
    assert!(said.contains("carvel::carvel-static"), "{said}");
}

#[test]
fn uninstalling_leaves_nothing_and_takes_nothing_else() {
    let stage = Stage::new("/opt/carvel kernel", &[]);
    fs::create_dir_all(stage.at("share")).expect("a folder");
    printed(&mut stage.make("install"));
    // Installing again must not forget what was made the first time.
    printed(&mut stage.make("install"));
    fs::write(stage.at("include/foreign.h"), "").expect("a foreign file");
    let said = refused(stage.make("uninstall").arg(format!("LIBDIR={}", "/opt/elsewhere")));
    assert!(said.contains("installed with other variables"), "{said}");
    printed(&mut stage.make("uninstall"));
    assert_eq!(tree(&stage.at("")), ["include/", "include/foreign.h", "share/"]);
    let said = refused(&mut stage.make("uninstall"));
    assert!(said.contains("nothing is installed there"), "{said}");

    let stage = Stage::installed("/opt/carvel kernel", &[]);
    printed(&mut stage.make("uninstall"));
    assert_eq!(tree(stage.destdir().expect("a stage")), Vec::<String>::new());
}

/// A program for the shell, in a folder without spaces.
fn script(stage: &Stage, name: &str, text: &str) -> PathBuf {
    let (written, path) = (stage.room.path().join(name), stage.plain.path().join(name));
    fs::write(&written, format!("#!/bin/sh\n{text}\n")).expect("a script");
    // By another program: were it this one, a thread that starts a third might hold it
    // open for writing a moment longer, and it could not be run.
    printed(Command::new("install").args(["-m", "755"]).arg(written).arg(&path));
    path
}

/// Installs into /usr where the compiler and dpkg answer as these scripts do; the folder
/// of the libraries.
fn installed_in_usr(compiler: &str, dpkg: &str) -> (Stage, String) {
    let stage = Stage::new("/usr", &[]);
    let answers = format!("test \"$*\" = -print-multiarch || exit 9\n{compiler}");
    let compiler = script(&stage, "cc", &answers);
    script(&stage, "dpkg-architecture", dpkg);
    let path = std::env::var("PATH").expect("a search path");
    let path = format!("{}:{path}", stage.plain.path().display());
    printed(stage.make("install").env("CC", compiler).env("PATH", path));
    let found = tree(&stage.at(""));
    let place = found.iter().find_map(|name| name.strip_suffix("/pkgconfig/carvel.pc"));
    let place = place.unwrap_or_else(|| panic!("no carvel.pc in {found:#?}")).to_owned();
    assert!(stage.at(&place).join("libcarvel.so").is_file(), "{found:#?}");
    assert!(stage.at("include/carvel.h").is_file());
    let text = fs::read_to_string(stage.at(&place).join("pkgconfig/carvel.pc")).expect("text");
    assert!(text.contains(&format!("\nlibdir=${{prefix}}/{place}\n")), "{text}");
    (stage, place)
}

/// Whatever this machine's own compiler says.
#[test]
fn libraries_go_where_debian_has_them() {
    let (stage, place) = installed_in_usr("echo fake-linux-gnu", "echo other-linux-gnu");
    assert_eq!(place, "lib/fake-linux-gnu");
    // CMake looks in the folders of its own compiler's triplet, and of no other.
    let place = stage.at("lib/fake-linux-gnu/cmake/carvel");
    let place = format!("-Dcarvel_DIR={}", place.display());
    build_these_with_cmake(&stage, &["shared_c", "static_c"], &[&place]);
}

#[test]
fn libraries_go_where_the_compiler_names_no_triplet() {
    // GCC of a system without such folders prints an empty line.
    let (stage, place) = installed_in_usr("echo", "echo other-linux-gnu");
    assert_eq!(place, "lib");
    build_with_cmake(&stage);
    // A compiler that does not know the question leaves it to dpkg, if there is one.
    assert_eq!(installed_in_usr("exit 1", "echo other-linux-gnu").1, "lib/other-linux-gnu");
    assert_eq!(installed_in_usr("exit 1", "exit 1").1, "lib");
}

/// `make install` asks the compiler that is there.
#[test]
fn a_stage_of_usr_is_found_through_cmake() {
    build_with_cmake(&Stage::installed("/usr", &[]));
}

/// Other goals take `make CARGO='cargo +nightly'` as well.
#[test]
fn cargo_may_be_a_command_with_arguments() {
    let stage = Stage::new("a prefix", &[]);
    let text = "test \"$1 $2\" = '+some --thing' || exit 9\nshift 2\nexec cargo \"$@\"";
    let cargo = script(&stage, "wrapped", text);
    let out = stage.plain.path().join("out");
    let mut make = stage.make("lib");
    make.arg(format!("CARGO={} +some --thing", cargo.display()));
    printed(make.arg(format!("LIB={}", out.display())));
    let mut found = tree(&out);
    found.retain(|name| !["log", "messages"].contains(&name.as_str()));
    assert_eq!(found, ["facts", "libcarvel.a", "libcarvel.so"]);
}

#[test]
fn folders_can_be_chosen() {
    let chosen = [("LIBDIR", "/opt/lib 64"), ("INCLUDEDIR", "/srv/head ers/carvel")];
    let stage = Stage::installed("/opt/carvel kernel", &chosen);
    let destdir = stage.destdir().expect("a stage").to_path_buf();
    assert!(destdir.join("srv/head ers/carvel/carvel.h").is_file());
    assert!(!stage.at("lib").exists() && !stage.at("include").exists());
    let pkg_config = printed(
        Command::new("pkg-config")
            .env("PKG_CONFIG_LIBDIR", destdir.join("opt/lib 64/pkgconfig"))
            .args(["--cflags", "--libs", "carvel"]),
    );
    assert_eq!(pkg_config, r"-I/srv/head\ ers/carvel -L/opt/lib\ 64 -lcarvel");
    let place = format!("-Dcarvel_DIR={}", destdir.join("opt/lib 64/cmake/carvel").display());
    printed(&mut configure(&stage, "install_cmake.txt", &[&place]));
    printed(Command::new("cmake").arg("--build").arg(stage.room.path().join("a host/build")));
    printed(&mut stage.make("uninstall"));
    assert_eq!(tree(&destdir), Vec::<String>::new());
}

#[test]
fn unusable_folders_are_refused() {
    let stage = Stage::new("a prefix", &[]);
    for prefix in ["relative", "/opt/../opt", "/opt/$(HOME)x;y", "/a\"b"] {
        let said =
            refused(stage.make("install").arg(format!("PREFIX={}", prefix.replace('$', "$$"))));
        assert!(said.contains("is no absolute path") || said.contains("has characters"), "{said}");
    }
    assert_eq!(tree(stage.room.path()), Vec::<String>::new());
}

/// Rust's static libraries carry the standard library. Of carvel's that is hidden, or two
/// of them would take each other's functions; and panics must still be caught in each.
#[test]
fn it_links_beside_other_rust_libraries() {
    let stage = Stage::installed("a prefix", &[]);
    let room = stage.room.path();
    for (name, merged) in [("one", true), ("two", false)] {
        let archive = room.join(format!("lib{name}.a"));
        printed(
            rustc()
                .args([
                    "--edition",
                    "2024",
                    "--crate-type",
                    "staticlib",
                    "--crate-name",
                    name,
                    "-O",
                ])
                .arg(c_directory().join("panicking.rs"))
                .arg("-o")
                .arg(&archive)
                .env("PREFIX", name),
        );
        if merged {
            let merge = root().join("packaging/merge.sh");
            printed(Command::new(merge).arg(&archive).arg(&archive).arg(format!("{name}_")));
        }
    }
    let flags = pkg_config(&stage, &["--static", "--cflags", "--libs"]);
    let flags = flags.replace("-lcarvel", "-l:libone.a -l:libtwo.a -l:libcarvel.a");
    for (linker, name) in [("", "default"), ("-Wl,--gc-sections", "gc")] {
        let flags = format!("-L'{}' {flags} {linker}", room.display());
        let printed = stage.program("cc", "install_panics.c", &flags, name);
        assert_eq!(printed, format!("{} 11 11", version()));
    }
}
