//! Folders are layers: each top-level module imports only what stands below it.
//!
//! The scanner reads tokens, not lines, so that groups, inline paths, `super`
//! chains and names re-exported at the root are all seen; comments and strings
//! are not.

use std::collections::HashMap;
use std::path::Path;

/// What each top-level module may use besides itself and `base`.
const LAYERS: [(&str, &[&str]); 12] = [
    ("base", &[]),
    ("mesh", &[]),
    ("sparse", &[]),
    ("refine", &["mesh"]),
    ("scheme", &["mesh", "refine", "sparse"]),
    ("hierarchy", &["mesh", "refine", "scheme", "sparse"]),
    ("curve", &[]),
    ("limit", &["mesh", "refine", "sparse", "scheme", "hierarchy"]),
    ("analysis", &["mesh", "refine", "sparse", "scheme", "hierarchy", "limit", "curve"]),
    ("fit", &["sparse", "hierarchy", "limit"]),
    ("io", &["mesh"]),
    ("capi", ABOVE_ALL),
];
/// Every public module.
const ABOVE_ALL: &[&str] =
    &["mesh", "sparse", "refine", "scheme", "hierarchy", "curve", "analysis", "limit", "fit", "io"];

fn may_use(module: &str, used: &str) -> bool {
    let Some((_, below)) = LAYERS.iter().find(|(name, _)| *name == module) else { return false };
    used == module || (used == "base" && module != "base") || below.contains(&used)
}

// ---------------------------------------------------------------------- tokens

#[derive(Clone, Debug, PartialEq)]
struct Token {
    /// A word, `::`, or one other character.
    text: String,
    line: usize,
}

/// The length of a comment or literal at the start of some text; 0 for code.
fn skipped(text: &str) -> usize {
    let until = |end: &str| text.find(end).map_or(text.len(), |at| at + end.len());
    if text.starts_with("//") {
        text.find('\n').unwrap_or(text.len())
    } else if text.starts_with("/*") {
        until("*/")
    } else if let Some(inner) = text.strip_prefix('"') {
        1 + string_end(inner)
    } else if let Some(inner) = text.strip_prefix("r\"") {
        2 + inner.find('"').map_or(inner.len(), |at| at + 1)
    } else if text.starts_with("r#\"") {
        until("\"#")
    } else if text.starts_with('\'') {
        character_end(text)
    } else {
        0
    }
}

/// Where a string literal ends, its opening quote taken off.
fn string_end(text: &str) -> usize {
    let mut escaped = false;
    for (at, c) in text.char_indices() {
        match c {
            '"' if !escaped => return at + 1,
            '\\' => escaped = !escaped,
            _ => escaped = false,
        }
    }
    text.len()
}

/// The length of a character literal; a lifetime's quote counts alone.
fn character_end(text: &str) -> usize {
    let mut rest = text.char_indices().skip(1);
    match (rest.next(), rest.next()) {
        (Some((_, '\\')), Some(_)) => text[3..].find('\'').map_or(1, |at| at + 4),
        (Some(_), Some((at, '\''))) => at + 1,
        _ => 1,
    }
}

fn tokens(text: &str) -> Vec<Token> {
    let mut tokens = Vec::new();
    let (mut at, mut line) = (0, 1);
    while at < text.len() {
        let rest = &text[at..];
        let word = rest.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(rest.len());
        let (length, is_token) = match skipped(rest) {
            0 if word > 0 => (word, true),
            0 if rest.starts_with("::") => (2, true),
            0 => (rest.chars().next().map_or(1, char::len_utf8), true),
            n => (n, false),
        };
        let piece = &rest[..length];
        if is_token && !piece.trim().is_empty() {
            tokens.push(Token { text: piece.to_owned(), line });
        }
        line += piece.matches('\n').count();
        at += length;
    }
    tokens
}

// ----------------------------------------------------------------------- paths

/// One file of the library.
struct Source {
    /// From the repository's root, such as `src/mesh/build.rs`.
    path: String,
    text: String,
}

impl Source {
    /// The module's path: `["mesh", "build"]`.
    fn module(&self) -> Vec<String> {
        let inner = self.path.trim_start_matches("src/").trim_end_matches(".rs");
        let parts = inner.split('/').filter(|part| !["mod", "lib"].contains(part));
        parts.map(str::to_owned).collect()
    }
}

/// A name used from the crate's root, and where.
type Use = (String, usize);

/// Reads the paths of one file.
struct Reader<'a> {
    tokens: &'a [Token],
    /// The module that the file is.
    file: Vec<String>,
    /// Inline modules that are open, with the depth of their braces.
    inline: Vec<(String, usize)>,
    depth: usize,
    found: Vec<Use>,
}

impl<'a> Reader<'a> {
    fn uses(tokens: &'a [Token], file: Vec<String>) -> Vec<Use> {
        let mut it = Self { tokens, file, inline: Vec::new(), depth: 0, found: Vec::new() };
        let mut at = 0;
        while at < tokens.len() {
            at = it.read(at);
        }
        it.found
    }

    fn text(&self, at: usize) -> &'a str {
        self.tokens.get(at).map_or("", |token| &token.text)
    }

    /// Reads what starts at a token; returns where to go on.
    fn read(&mut self, at: usize) -> usize {
        match self.text(at) {
            "{" => self.depth += 1,
            "}" => {
                self.depth = self.depth.saturating_sub(1);
                self.inline.pop_if(|(_, depth)| *depth > self.depth);
            }
            "mod" if self.text(at + 2) == "{" => {
                self.inline.push((self.text(at + 1).to_owned(), self.depth + 1));
            }
            "crate" | "super" | "self" if at == 0 || self.text(at - 1) != "::" => {
                return self.path(at);
            }
            _ => {}
        }
        at + 1
    }

    /// Follows `crate::…` or `super::…` from its first word.
    fn path(&mut self, first: usize) -> usize {
        let inline = self.inline.iter().map(|(name, _)| name.clone());
        let mut module: Vec<String> = self.file.iter().cloned().chain(inline).collect();
        let mut at = first;
        loop {
            match self.text(at) {
                "crate" => module.clear(),
                "super" => drop(module.pop()),
                "self" => {}
                _ => break,
            }
            if self.text(at + 1) != "::" {
                // `pub(crate)`, or another name for a whole module.
                self.note_alias(at, module.is_empty());
                return at + 1;
            }
            at += 2;
        }
        if module.is_empty() { self.names(at) } else { at }
    }

    fn note_alias(&mut self, at: usize, is_root: bool) {
        if is_root && self.text(at + 1) == "as" {
            self.found.push(("as".to_owned(), self.tokens[at].line));
        }
    }

    /// Collects what is named from the root: one word, or each in a group.
    fn names(&mut self, at: usize) -> usize {
        if self.text(at) != "{" {
            self.found.push((self.text(at).to_owned(), self.tokens[at].line));
            return at + 1;
        }
        let (mut at, mut depth, mut fresh) = (at + 1, 1, true);
        while depth > 0 && at < self.tokens.len() {
            match self.text(at) {
                "{" => depth += 1,
                "}" => depth -= 1,
                "," => fresh = depth == 1,
                name => {
                    if std::mem::take(&mut fresh) {
                        self.found.push((name.to_owned(), self.tokens[at].line));
                    }
                }
            }
            at += 1;
        }
        at
    }
}

/// The names that `lib.rs` re-exports, with the modules they come from.
fn re_exports(tokens: &[Token]) -> HashMap<String, String> {
    let mut exports = HashMap::new();
    let statements = tokens.split(|token| token.text == ";");
    for statement in statements {
        let words: Vec<&str> = statement.iter().map(|token| token.text.as_str()).collect();
        let Some(at) = words.iter().position(|&word| word == "use") else { continue };
        let Some((module, names)) = words[at + 1..].split_first() else { continue };
        for name in names.iter().filter(|name| name.starts_with(char::is_uppercase)) {
            exports.insert((*name).to_owned(), (*module).to_owned());
        }
    }
    exports
}

// ------------------------------------------------------------------- the rules

/// Every breach, as `file:line: what`.
fn breaches(sources: &[Source]) -> Vec<String> {
    let root = sources.iter().find(|source| source.path == "src/lib.rs");
    let exports = root.map(|root| re_exports(&tokens(&root.text))).unwrap_or_default();
    let library = |source: &&Source| source.path != "src/lib.rs" && !is_program(source);
    let in_library = sources.iter().filter(library);
    let in_programs = sources.iter().filter(|source| is_program(source));
    let of_library = in_library.flat_map(|source| library_breaches(source, &exports));
    of_library.chain(in_programs.flat_map(program_breaches)).collect()
}

fn is_program(source: &Source) -> bool {
    source.path.starts_with("src/bin/")
}

fn library_breaches(source: &Source, exports: &HashMap<String, String>) -> Vec<String> {
    let own = source.module().swap_remove(0);
    let found = Reader::uses(&tokens(&source.text), source.module());
    let breach = |(name, line): Use| {
        let used = exports.get(&name).unwrap_or(&name);
        let allowed = may_use(&own, used);
        (!allowed).then(|| format!("{}:{line}: {own} must not use {used}", source.path))
    };
    found.into_iter().filter_map(breach).collect()
}

/// A program is a crate of its own, so the compiler keeps it to the public API,
/// unless it takes the library's files in by another way.
fn program_breaches(source: &Source) -> Vec<String> {
    let tokens = tokens(&source.text);
    let is_side_door = |i: &usize| match tokens[*i].text.as_str() {
        "include" => tokens.get(i + 1).is_some_and(|next| next.text == "!"),
        "path" => *i > 1 && tokens[i - 1].text == "[" && tokens[i - 2].text == "#",
        _ => false,
    };
    let side_doors = (0..tokens.len()).filter(is_side_door);
    side_doors
        .map(|i| format!("{}:{}: a program takes in files", source.path, tokens[i].line))
        .collect()
}

// ----------------------------------------------------------------------- tests

fn read_folder(folder: &Path, name: &str, sources: &mut Vec<Source>) {
    let entries = std::fs::read_dir(folder).expect("src can be listed");
    let mut paths: Vec<_> = entries.map(|entry| entry.expect("an entry").path()).collect();
    paths.sort();
    for path in paths {
        let file = path.file_name().expect("a name").to_string_lossy();
        let name = format!("{name}/{file}");
        if path.is_dir() {
            read_folder(&path, &name, sources);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            let text = std::fs::read_to_string(&path).expect("UTF-8");
            sources.push(Source { path: name, text });
        }
    }
}

fn library() -> Vec<Source> {
    let mut sources = Vec::new();
    read_folder(&Path::new(env!("CARGO_MANIFEST_DIR")).join("src"), "src", &mut sources);
    assert!(sources.len() > 30, "sources are missing");
    sources
}

#[test]
fn no_module_imports_upwards() {
    let found = breaches(&library());
    assert!(found.is_empty(), "{}", found.join("\n"));
}

/// The scanner sees the imports that do exist; silence is no proof.
#[test]
fn the_scanner_sees_what_is_imported() {
    let sources = library();
    let uses = |path: &str| {
        let source = sources.iter().find(|source| source.path == path).expect("a source");
        let names = Reader::uses(&tokens(&source.text), source.module());
        names.into_iter().map(|(name, _)| name).collect::<Vec<_>>()
    };
    let levels = uses("src/hierarchy/levels.rs");
    for module in ["base", "mesh", "refine", "scheme"] {
        assert!(levels.iter().any(|name| name == module), "{module}");
    }
    let report = uses("src/analysis/mask/report.rs");
    assert!(report.iter().any(|name| name == "curve"), "{report:?}");
}

/// Plants text at the end of a file and expects one breach, there and only there.
#[track_caller]
fn assert_found(path: &str, planted: &str, line: usize, what: &str) {
    let mut sources = library();
    let source = sources.iter_mut().find(|source| source.path == path).expect("a source");
    let lines = source.text.lines().count();
    source.text.push_str(planted);
    let expected = format!("{path}:{}: {what}", lines + line);
    assert_eq!(breaches(&sources), [expected], "{planted}");
}

#[test]
fn planted_imports_are_found_by_file_and_line() {
    let file = "src/mesh/survey.rs";
    let upward = "mesh must not use hierarchy";
    assert_found(file, "use crate::hierarchy::Refiner;\n", 1, upward);
    assert_found(
        file,
        "\n\nuse crate::{\n    base::NONE,\n    hierarchy::{self, X},\n};",
        5,
        upward,
    );
    assert_found(file, "fn f() -> crate::hierarchy::Refiner<f32> { todo!() }", 1, upward);
    assert_found(file, "use super::super::hierarchy;", 1, upward);
    assert_found(file, "use self::super::super::hierarchy;", 1, upward);
    assert_found(file, "mod inner { use super::super::super::hierarchy; }", 1, upward);
    assert_found(file, "// One.\n/* Two\n */ pub(crate) use crate::Refiner;", 3, upward);
    assert_found(file, "const C: char = '\"'; use crate::hierarchy; // \"", 1, upward);
    assert_found(file, "macro_rules! m { () => { $crate::hierarchy::f() } }", 1, upward);
    assert_found("src/base/mod.rs", "use super::mesh::Mesh;", 1, "base must not use mesh");
    assert_found("src/refine/mod.rs", "use crate::Scheme;", 1, "refine must not use scheme");
    assert_found("src/io/mod.rs", "use crate::refine::Counts;", 1, "io must not use refine");
    let table = "src/curve/catalogue/table.rs";
    assert_found(table, "use crate::Scheme;", 1, "curve must not use scheme");
    assert_found(table, "use super::super::super::analysis;", 1, "curve must not use analysis");
}

/// The C interface, and the advice about memory pages, lift the ban on unsafe code.
#[test]
fn unsafe_code_stays_at_the_border() {
    let sources = library();
    let lifts = |source: &&Source| source.text.contains("allow(unsafe_code)");
    let paths: Vec<&str> = sources.iter().filter(lifts).map(|s| s.path.as_str()).collect();
    assert_eq!(paths, ["src/base/pages.rs", "src/base/simd.rs", "src/capi/mod.rs"]);
    let root = sources.iter().find(|source| source.path == "src/lib.rs").expect("a root");
    assert!(root.text.contains("#![deny(unsafe_code)]"));
}

#[test]
fn names_for_the_whole_crate_are_found() {
    let file = "src/mesh/survey.rs";
    assert_found(file, "use crate::*;", 1, "mesh must not use *");
    assert_found(file, "use crate as all;", 1, "mesh must not use as");
    assert_found(file, "use super::super as all;", 1, "mesh must not use as");
    assert_found(file, "use crate::elsewhere::X;", 1, "mesh must not use elsewhere");
}

#[test]
fn programs_that_take_in_library_files_are_found() {
    let file = "src/bin/carvel/main.rs";
    let what = "a program takes in files";
    assert_found(file, "#[path = \"../../mesh/mod.rs\"] mod mesh;", 1, what);
    assert_found(file, "\ninclude!(\"../../mesh/mod.rs\");", 2, what);
}

#[test]
fn a_new_module_must_be_given_its_place() {
    let mut sources = library();
    let text = "use crate::base::NONE;".to_owned();
    sources.push(Source { path: "src/news/mod.rs".to_owned(), text });
    assert_eq!(breaches(&sources), ["src/news/mod.rs:1: news must not use base"]);
}

#[test]
fn what_is_no_import_is_not_found() {
    let mut sources = library();
    let source = sources.iter_mut().find(|s| s.path == "src/mesh/survey.rs").expect("a source");
    source.text.push_str(
        r#"
//! See [`crate::hierarchy`].
/* use crate::hierarchy; */
const TEXT: &str = "use crate::hierarchy; \" crate::io";
pub(crate) fn f<'a>(x: &'a str) -> &'a str { x }
pub(in crate::mesh) struct S;
mod inner { use super::super::Mesh; use super::Survey; use crate::{base::NONE, mesh}; }
"#,
    );
    assert_eq!(breaches(&sources), [""; 0]);
}
