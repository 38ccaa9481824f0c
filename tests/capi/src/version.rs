//! The version that `Cargo.toml` gives, and what is named after it.

use crate::root;

/// The version: names of installed files and the header follow it.
pub fn version() -> String {
    let manifest = std::fs::read_to_string(root().join("Cargo.toml")).expect("the manifest");
    let line = manifest.lines().find_map(|line| line.strip_prefix("version = "));
    line.expect("a version").trim_matches('"').to_owned()
}

/// The versions that a program may be given in place of each other (docs/abi.md):
/// 0.MINOR before 1.0, then MAJOR.
pub fn series() -> String {
    series_of(&version())
}

fn series_of(version: &str) -> String {
    let mut parts = version.split('.');
    match (parts.next(), parts.next()) {
        (Some("0"), Some(minor)) => format!("0.{minor}"),
        (Some(major), _) => major.to_owned(),
        (None, _) => unreachable!("a version has parts"),
    }
}

#[cfg(test)]
mod tests {
    use super::series_of;

    #[test]
    fn a_series_is_the_first_number_that_is_not_zero() {
        let series = ["0.1.0", "0.12.3", "1.0.0", "10.2.1"].map(series_of);
        assert_eq!(series, ["0.1", "0.12", "1", "10"]);
    }
}
