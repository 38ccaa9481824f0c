//! The cases of `tests/golden`: control meshes with their refined meshes, from
//! a reference that shares no code with this one.

use std::path::{Path, PathBuf};

use serde_json::Value;

use super::number::{Point, parse_fraction};
use super::poly::Poly;
use super::reference::{Boundary, Rule, Scheme, Split};

pub struct Case {
    pub name: String,
    /// The control mesh. [`Poly::to_exact`] turns its doubles into fractions.
    pub control: Poly<f64>,
    pub scheme: Scheme,
    pub levels: usize,
    /// The refined mesh, in a numbering of its own.
    pub expected: Poly<f64>,
}

pub fn directory() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden")
}

/// All cases, by name.
pub fn load_all() -> Vec<Case> {
    let entries = std::fs::read_dir(directory()).expect("tests/golden can be listed");
    let mut paths: Vec<_> = entries.map(|e| e.expect("a directory entry").path()).collect();
    paths.retain(|p| p.extension().is_some_and(|e| e == "json"));
    paths.sort();
    paths.iter().map(|p| load(p)).collect()
}

/// One case.
///
/// # Panics
/// With the path, on a file that is not a golden case.
pub fn load(path: &Path) -> Case {
    let text = std::fs::read_to_string(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    let value = serde_json::from_str(&text).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    parse(&value).unwrap_or_else(|field| panic!("{}: bad field {field}", path.display()))
}

fn parse(value: &Value) -> Result<Case, &'static str> {
    Ok(Case {
        name: value["name"].as_str().ok_or("name")?.to_owned(),
        control: parse_mesh(value, "positions", "faces")?,
        scheme: parse_scheme(value)?,
        levels: value["levels"].as_u64().ok_or("levels")? as usize,
        expected: parse_mesh(value, "out_positions", "out_faces")?,
    })
}

fn parse_mesh(
    value: &Value,
    positions: &'static str,
    faces: &'static str,
) -> Result<Poly<f64>, &'static str> {
    let positions = parse_positions(&value[positions]).ok_or(positions)?;
    Ok(Poly::new(positions, parse_faces(&value[faces]).ok_or(faces)?))
}

fn parse_scheme(value: &Value) -> Result<Scheme, &'static str> {
    let text = |field: &'static str| value[field].as_str().ok_or(field);
    let passes = value["passes"].as_array().ok_or("passes")?;
    Ok(Scheme {
        split: match text("split")? {
            "dual" => Split::Dual,
            "primal" => Split::Primal,
            _ => return Err("split"),
        },
        passes: passes
            .iter()
            .map(|t| t.as_str().map(parse_fraction).ok_or("passes"))
            .collect::<Result<_, _>>()?,
        rule: match text("corner_rule")? {
            "cosine" => Rule::Cosine,
            "average" => Rule::Average,
            _ => return Err("corner_rule"),
        },
        boundary: match text("boundary")? {
            "none" => Boundary::None,
            "edge" => Boundary::Edge,
            "edge-corner" => Boundary::EdgeCorner,
            _ => return Err("boundary"),
        },
    })
}

fn parse_positions(value: &Value) -> Option<Vec<Point<f64>>> {
    let point = |p: &Value| {
        let xyz: Vec<f64> = p.as_array()?.iter().filter_map(Value::as_f64).collect();
        xyz.try_into().ok()
    };
    value.as_array()?.iter().map(point).collect()
}

fn parse_faces(value: &Value) -> Option<Vec<Vec<usize>>> {
    let index = |v: &Value| v.as_u64().map(|v| v as usize);
    let face = |f: &Value| f.as_array()?.iter().map(index).collect();
    value.as_array()?.iter().map(face).collect()
}
