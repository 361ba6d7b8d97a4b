//! The header that people read has the functions of the library, as cbindgen derives them from the source.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use regex::Regex;
use std::collections::BTreeMap;
use std::path::Path;

/// Functions of a header: name, and the types of the result and of the arguments.
fn functions(header: &str) -> BTreeMap<String, Vec<String>> {
    let comments = Regex::new(r"(?s)/\*.*?\*/|//[^\n]*|#[^\n]*").unwrap();
    let plain = comments.replace_all(header, " ");
    let function = Regex::new(r"(?s)([A-Za-z_][\w\s]*[\s*]+)(stickslip_\w+)\(([^)]*)\)\s*;").unwrap();
    let of_argument = |argument: &str| {
        let name = Regex::new(r"\s*\b\w+\s*$").unwrap();
        let kind = if argument.trim() == "void" { "void".into() } else { name.replace(argument.trim(), "") };
        kind.split_whitespace().collect::<Vec<_>>().join(" ").replace(" *", "*").replace("struct ", "")
    };
    let found = function.captures_iter(&plain).map(|found| {
        let result = found[1].split_whitespace().collect::<Vec<_>>().join(" ").replace(" *", "*");
        let types = found[3].split(',').map(of_argument);
        (found[2].to_owned(), std::iter::once(result).chain(types).collect())
    });
    found.collect()
}

#[test]
fn the_header_has_the_functions_of_the_library() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    let written = std::fs::read_to_string(folder.join("include/stickslip.h")).unwrap();
    let mut config = cbindgen::Config { language: cbindgen::Language::C, ..Default::default() };
    config.usize_is_size_t = true;
    let names = [("Stickslip", "stickslip"), ("StickslipVariable", "stickslip_description")];
    config.export.rename = names.map(|(from, to)| (from.to_owned(), to.to_owned())).into();
    let mut derived = Vec::new();
    let source = folder.join("src/c.rs");
    let builder = cbindgen::Builder::new().with_config(config).with_src(source);
    builder.generate().unwrap().write(&mut derived);
    let (written, derived) = (functions(&written), functions(&String::from_utf8(derived).unwrap()));
    assert_eq!(written, derived);
    assert!((15..=20).contains(&written.len()), "{}", written.len());
    assert_eq!(written["stickslip_row"], ["int", "stickslip*", "double*", "size_t"]);
}

/// The pkg-config file and the library have one version.
#[test]
fn the_version_is_one() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    let file = std::fs::read_to_string(folder.join("stickslip.pc")).unwrap();
    assert!(file.contains(&format!("\nVersion: {}\n", env!("CARGO_PKG_VERSION"))));
}
