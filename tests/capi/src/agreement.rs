//! A Rust program that compiles only if the library's functions, structs and
//! constants are those of the header.
//!
//! bindgen translates the header. Every function of the library is assigned to a
//! pointer of the header's type: arguments, their constness, the result. Every
//! struct is compared by size, alignment, and each field's place and type, and may
//! have no other field. Every constant is compared by value.

use std::fmt::Write as _;
use std::path::Path;

use quote::{ToTokens, quote};
use syn::ItemStruct;

use crate::header::Header;
use crate::library::{Library, rustc};
use crate::program::{self, Limit, Output};

/// The program's text.
pub fn source(header: &Header) -> String {
    let mut text =
        String::from("#![allow(warnings)]\nuse carvel::capi::{self, *};\nmod declared {\n");
    text.push_str(&header.rust);
    text.push_str("}\n");
    for function in header.functions() {
        let sig = &function.sig;
        let (name, output) = (&sig.ident, &sig.output);
        let arguments = sig.inputs.iter().map(|argument| match argument {
            syn::FnArg::Typed(argument) => argument.ty.to_token_stream(),
            syn::FnArg::Receiver(_) => unreachable!("a C function has no receiver"),
        });
        let check = quote! {
            const _: unsafe extern "C" fn(#(#arguments),*) #output = capi::#name;
        };
        line(&mut text, &check);
    }
    header.structs().for_each(|item| check_struct(&mut text, item));
    for alias in header.aliases() {
        let _ = writeln!(text, "const _: fn(declared::{alias}) -> capi::{alias} = |x| x;");
    }
    for name in header.enumerators() {
        let _ = writeln!(
            text,
            "const _: () = assert!(declared::{name} as i128 == capi::{name} as i128, \"{name}\");"
        );
    }
    text
}

fn line(text: &mut String, tokens: &impl ToTokens) {
    let _ = writeln!(text, "{}", tokens.to_token_stream());
}

fn check_struct(text: &mut String, item: &ItemStruct) {
    let name = &item.ident;
    let label = name.to_string();
    line(
        text,
        &quote! {
            const _: () = assert!(size_of::<declared::#name>() == size_of::<capi::#name>(), #label);
            const _: () = assert!(align_of::<declared::#name>() == align_of::<capi::#name>(), #label);
        },
    );
    let fields: Vec<_> = item.fields.iter().map(|f| f.ident.clone().expect("a name")).collect();
    line(
        text,
        &quote! {
            const _: fn(capi::#name) = |all| { let capi::#name { #(#fields: _),* } = all; };
        },
    );
    for (field, ty) in fields.iter().zip(item.fields.iter().map(|f| &f.ty)) {
        let label = format!("{name}.{field}");
        line(
            text,
            &quote! {
                const _: () = assert!(
                    std::mem::offset_of!(declared::#name, #field)
                        == std::mem::offset_of!(capi::#name, #field),
                    #label
                );
                const _: fn(capi::#name) -> #ty = |all| all.#field;
            },
        );
    }
}

/// Compiles the program against the library.
pub fn compile(header: &Header, library: &Library, directory: &Path) -> Output {
    std::fs::create_dir_all(directory).expect("a directory to build in");
    let file = directory.join("agreement.rs");
    std::fs::write(&file, source(header)).expect("a file to write");
    let dependencies = library.rlib.with_file_name("deps");
    let mut rustc = rustc();
    rustc.args(["--edition=2024", "--crate-type=lib", "--emit=metadata"]);
    rustc.arg("--extern").arg(format!("carvel={}", library.rlib.display()));
    rustc.arg("-L").arg(format!("dependency={}", dependencies.display()));
    rustc.arg("--out-dir").arg(directory).arg(&file);
    program::attempt(&mut rustc, Limit::PROGRAM)
}
