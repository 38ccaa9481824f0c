//! Compiles the shims over the three C++ libraries, or says which packages they lack.

use std::path::Path;

/// A header or library file of each Debian package that the shims need.
const NEEDED: [(&str, &str); 3] = [
    ("libosd-dev", "opensubdiv/version.h"),
    ("libopenmesh-dev", "OpenMesh/Core/System/config.h"),
    ("libcgal-dev", "CGAL/version.h"),
];

/// Where headers are looked for: the system's places, which compilers search too.
const PLACES: [&str; 2] = ["/usr/include", "/usr/local/include"];

const SOURCES: [&str; 9] = [
    "shim/cgal_double.cpp",
    "shim/cgal_single.cpp",
    "shim/check.cpp",
    "shim/heap.cpp",
    "shim/openmesh.cpp",
    "shim/opensubdiv.cpp",
    "shim/osd_topology.cpp",
    "shim/stencils.cpp",
    "shim/surface.cpp",
];

fn main() {
    println!("cargo::rerun-if-changed=shim");
    println!("cargo::rerun-if-changed=src/bridge.rs");
    for (_, header) in NEEDED {
        // A package that is installed or removed later changes the answer.
        println!("cargo::rerun-if-changed={}/{header}", PLACES[0]);
    }
    let missing = missing();
    if !missing.is_empty() {
        println!(
            "cargo::error=carvel is compared with C++ libraries that are not installed: {}. \
             `make test` installs them; so does: apt-get install {}",
            missing.join(", "),
            missing.join(" ")
        );
        return;
    }
    compile();
    for library in ["osdCPU", "OpenMeshCore", "OpenMeshTools"] {
        println!("cargo::rustc-link-lib={library}");
    }
}

fn missing() -> Vec<&'static str> {
    let there = |header: &str| PLACES.iter().any(|place| Path::new(place).join(header).exists());
    NEEDED.iter().filter(|(_, header)| !there(header)).map(|(package, _)| *package).collect()
}

/// Optimised in every profile: these are the peers' own inner loops, and a debug
/// build of ours must not make them look slow.
fn compile() {
    cxx_build::bridge("src/bridge.rs")
        .files(SOURCES)
        .std("c++17")
        .opt_level(3)
        .debug(false)
        .define("NDEBUG", None)
        // The libraries' headers warn.
        .warnings(false)
        .compile("carvel_peers_shims");
}
