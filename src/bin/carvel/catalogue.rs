//! The command `catalogue`.

use crate::args::CatalogueArgs;
use crate::exit::{Doing, Exit, Failure};
use crate::session::Session;
use crate::{places, plot, report};
use carvel::curve::catalogue::{FAMILIES, NON_STATIONARY, Parameter};
use serde_json::{Value, json};
use std::fmt::Write as _;

/// Lists the catalogue.
pub fn run(args: &CatalogueArgs) -> Result<Exit, Failure> {
    if let Some(path) = &args.plot {
        let kind = plot::kind_of(path)?;
        let session = Session::new(0, None, false)?;
        let sheet = plot::sheet::figure(&session.context);
        let sheet = sheet.map_err(|e| Failure::from_error(&e, Doing::Working))?;
        plot::save(&session, path, kind, &sheet)?;
        session.console.clear();
        if places::is_stream(path) {
            return Ok(Exit::Success);
        }
    }
    if args.json {
        return report::print(&report::document(&document()));
    }
    let mut text = String::new();
    for family in &FAMILIES {
        let parameter = |p: &Parameter| format!("    {} = {}: {}\n", p.name, p.default, p.range);
        let parameters: String = family.parameters.iter().map(parameter).collect();
        let (name, mark) = (family.name, family.attribution.name());
        let (summary, authors, year) = (family.summary, family.authors, family.year);
        let _ = write!(
            text,
            "{name}: {summary}\n    {authors}, {year} ({mark})\n    {}\n{parameters}",
            family.formula
        );
    }
    for family in &NON_STATIONARY {
        let (name, mark) = (family.name, family.attribution.name());
        let (summary, authors, year) = (family.summary, family.authors, family.year);
        let _ = write!(
            text,
            "{name}: {summary}\n    {authors}, {year} ({mark})\n    {}\n    not stationary; in the limit {}\n",
            family.formula, family.limit,
        );
    }
    report::print(&text)
}

fn document() -> Value {
    let parameter = |p: &Parameter| json!({ "name": p.name, "range": p.range, "default": p.default, "free": p.is_free });
    let stationary = FAMILIES.iter().map(|family| {
        json!({
            "name": family.name,
            "summary": family.summary,
            "authors": family.authors,
            "year": family.year,
            "formula": family.formula,
            "attribution": family.attribution.name(),
            "stationary": true,
            "parameters": family.parameters.iter().map(parameter).collect::<Vec<_>>(),
        })
    });
    let others = NON_STATIONARY.iter().map(|family| {
        json!({
            "name": family.name,
            "summary": family.summary,
            "authors": family.authors,
            "year": family.year,
            "formula": family.formula,
            "attribution": family.attribution.name(),
            "stationary": false,
            "limit": family.limit,
        })
    });
    stationary.chain(others).collect()
}
