//! The header as bindgen reads it.

use std::collections::BTreeSet;

use syn::{Fields, ForeignItem, ForeignItemFn, Item, ItemStruct};

use crate::root;

/// What `include/carvel.h` declares.
#[derive(Debug)]
pub struct Header {
    /// bindgen's translation.
    pub rust: String,
    /// The same, read.
    items: Vec<Item>,
}

/// The text of the C header.
pub fn text() -> String {
    text_of("carvel.h")
}

fn text_of(name: &str) -> String {
    let path = root().join("include").join(name);
    std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

/// The example of a header's overview, without the comment around it.
///
/// # Panics
/// If there is none.
pub fn example(name: &str) -> String {
    let (text, first) = (text_of(name), format!("  #include <{name}>"));
    let lines = text.lines().skip_while(|line| !line.contains(&first));
    let mut example = String::new();
    for line in lines.map(|l| l.trim_start_matches(" *").strip_prefix("   ").unwrap_or("")) {
        example.push_str(line);
        example.push('\n');
        if line == "}" {
            return example;
        }
    }
    panic!("{name} has no example");
}

impl Header {
    /// Reads a header from its text.
    ///
    /// # Panics
    /// If it is no C.
    pub fn read(text: &str) -> Self {
        let bindings = bindgen::Builder::default()
            .header_contents("carvel.h", text)
            .allowlist_item("(carvel|CARVEL)_.*")
            .default_enum_style(bindgen::EnumVariation::Consts)
            .prepend_enum_name(false)
            .layout_tests(false)
            .generate()
            .unwrap_or_else(|e| panic!("bindgen cannot read the header: {e}"));
        let rust = bindings.to_string();
        let items = syn::parse_file(&rust).expect("bindgen writes Rust").items;
        Self { rust, items }
    }

    /// The functions, in order.
    pub fn functions(&self) -> impl Iterator<Item = &ForeignItemFn> {
        let blocks = self.items.iter().filter_map(|item| match item {
            Item::ForeignMod(block) => Some(&block.items),
            _ => None,
        });
        blocks.flatten().filter_map(|item| match item {
            ForeignItem::Fn(function) => Some(function),
            _ => None,
        })
    }

    /// The functions' names.
    pub fn function_names(&self) -> BTreeSet<String> {
        self.functions().map(|function| function.sig.ident.to_string()).collect()
    }

    /// The structs that are more than a name.
    pub fn structs(&self) -> impl Iterator<Item = &ItemStruct> {
        self.items.iter().filter_map(|item| match item {
            Item::Struct(item) if !is_opaque(item) => Some(item),
            _ => None,
        })
    }

    /// Other names for types, but for those of enums.
    pub fn aliases(&self) -> Vec<String> {
        let alias = |item: &Item| match item {
            Item::Type(item) => Some(item.ident.to_string()),
            _ => None,
        };
        let mut names: Vec<String> = self.items.iter().filter_map(alias).collect();
        let enums = enum_names(&text());
        names.retain(|name| !enums.contains(name));
        names
    }

    /// The constants that are no part of the version.
    pub fn enumerators(&self) -> Vec<String> {
        let names = self.constants().map(|(name, _)| name);
        names.filter(|name| !name.starts_with("CARVEL_VERSION")).collect()
    }

    /// The value of a constant, as bindgen writes it.
    ///
    /// # Panics
    /// If there is none of this name.
    pub fn constant(&self, name: &str) -> String {
        let found = self.constants().find(|(constant, _)| constant == name);
        found.unwrap_or_else(|| panic!("the header has no {name}")).1
    }

    fn constants(&self) -> impl Iterator<Item = (String, String)> {
        self.items.iter().filter_map(|item| match item {
            Item::Const(item) if item.ident.to_string().starts_with("CARVEL_") => {
                let value = &item.expr;
                Some((item.ident.to_string(), quote::quote!(#value).to_string()))
            }
            _ => None,
        })
    }
}

/// An object that C knows by its pointer only.
fn is_opaque(item: &ItemStruct) -> bool {
    match &item.fields {
        Fields::Named(fields) => fields
            .named
            .iter()
            .any(|f| f.ident.as_ref().is_some_and(|name| name == "_unused" || name == "_address")),
        _ => true,
    }
}

/// The names of the enums of a header.
fn enum_names(text: &str) -> BTreeSet<String> {
    let lines = text.lines().filter_map(|line| line.strip_prefix("enum "));
    lines.filter_map(|rest| rest.split_whitespace().next()).map(str::to_owned).collect()
}
