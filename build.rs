//! Gives the shared library the name that programs record when they link it.

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    let major = env!("CARGO_PKG_VERSION_MAJOR");
    let minor = env!("CARGO_PKG_VERSION_MINOR");
    // docs/abi.md, "Library versions": before 1.0 every minor version is its own.
    let version = if major == "0" { format!("0.{minor}") } else { major.to_owned() };
    let name = match std::env::var("CARGO_CFG_TARGET_OS").as_deref() {
        Ok("linux" | "android" | "freebsd" | "netbsd" | "openbsd" | "dragonfly") => {
            format!("-Wl,-soname,libcarvel.so.{version}")
        }
        Ok("macos") => format!("-Wl,-install_name,@rpath/libcarvel.{version}.dylib"),
        _ => return,
    };
    println!("cargo::rustc-cdylib-link-arg={name}");
}
