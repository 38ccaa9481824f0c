//! What the tests share: exact numbers, and the oracle's file.

use carvel::curve::{Mask, Rational, catalogue, rational};
use serde_json::Value;

/// The oracle: masks and properties of schemes. `mask[k]` is a_{k + offset}.
const ORACLE: &str = include_str!("curve_schemes.json");

pub fn q(text: &str) -> Rational {
    rational::parse(text).unwrap_or_else(|e| panic!("{e}"))
}

/// Reads a list such as `1/4 3/4`.
pub fn list(text: &str) -> Vec<Rational> {
    text.split_whitespace().map(q).collect()
}

pub fn named(text: &str) -> Mask {
    catalogue::mask(text).unwrap_or_else(|e| panic!("{text}: {e}"))
}

/// A scheme of the oracle.
pub struct Scheme {
    pub name: String,
    pub arity: usize,
    pub offset: i64,
    pub coefficients: Vec<Rational>,
    pub attribution: String,
    properties: Value,
}

impl Scheme {
    pub fn mask(&self) -> Mask {
        Mask::new(self.arity, self.offset, self.coefficients.clone()).expect("a mask")
    }

    pub fn property(&self, name: &str) -> &Value {
        &self.properties[name]
    }

    pub fn exact(&self, name: &str) -> Rational {
        q(self.property(name).as_str().unwrap_or_else(|| panic!("{}: {name}", self.name)))
    }

    pub fn count(&self, name: &str) -> Option<usize> {
        self.property(name).as_u64().map(|n| n as usize)
    }

    pub fn number(&self, name: &str) -> f64 {
        self.property(name).as_f64().unwrap_or_else(|| panic!("{}: {name}", self.name))
    }
}

fn strings(value: &Value) -> Vec<Rational> {
    value.as_array().expect("a list").iter().map(|x| q(x.as_str().expect("text"))).collect()
}

pub fn schemes() -> Vec<Scheme> {
    let all: Value = serde_json::from_str(ORACLE).expect("JSON");
    let scheme = |value: &Value| Scheme {
        name: value["name"].as_str().expect("a name").to_owned(),
        arity: value["arity"].as_u64().expect("an arity") as usize,
        offset: value["offset"].as_i64().expect("an offset"),
        coefficients: strings(&value["mask"]),
        attribution: value["mask_source_status"].as_str().expect("text").to_owned(),
        properties: value["properties"].clone(),
    };
    let schemes: Vec<_> = all["schemes"].as_array().expect("schemes").iter().map(scheme).collect();
    assert_eq!(schemes.len(), 104, "rows of the oracle");
    schemes
}
