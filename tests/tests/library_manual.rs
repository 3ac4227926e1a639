//! The library manual is made of the catalogue and of the heads of the function blocks. `TAKT_BLESS=1` writes it anew.

use std::fmt::Write;
use takt_stdlib::SOURCES;
use takt_stdlib::catalog::{Function, Pattern, functions};

const PATH: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/guide/library.md");

#[test]
fn manual_is_up_to_date() {
    let text = manual();
    if std::env::var_os("TAKT_BLESS").is_some() {
        std::fs::write(PATH, &text).unwrap();
    }
    assert_eq!(std::fs::read_to_string(PATH).unwrap_or_default(), text, "run it with TAKT_BLESS=1 and read the difference");
}

fn manual() -> String {
    let mut out = String::from(HEAD);
    for f in functions() {
        let _ = writeln!(out, "| `{}` | {} | {} |", signature(f), kind(f.result), f.doc);
    }
    out += "\n## Function blocks\n\n";
    for (name, text) in SOURCES {
        let _ = writeln!(out, "### {name}\n\n```st\n{}\n```\n", text.trim_end());
    }
    out
}

const HEAD: &str = "# Standard library

Functions are overloaded: `T` is the common type of all inputs marked so. Typed names such as `ADD_INT` or `SIN_LREAL` fix it. `..` may be
continued: IN3, IN4, ... Conversions are `X_TO_Y` and `TO_Y` for all elementary types and strings, `TRUNC_Y` toward zero.

## Functions

| function | result | what it does |
|---|---|---|
";

fn signature(f: &Function) -> String {
    let inputs: Vec<_> = f.params.iter().map(|p| format!("{} : {}", p.name, kind(p.ty))).collect();
    format!("{}({}{})", f.name, inputs.join(", "), if f.extensible { ", .." } else { "" })
}

fn kind(pattern: Pattern) -> String {
    match pattern {
        Pattern::Is(e) => e.name().to_owned(),
        Pattern::T(group) => format!("T in {}", group_name(&format!("{group:?}"))),
        Pattern::Own(group) => group_name(&format!("{group:?}")),
    }
}

/// `AnyInt` as the standard writes it: ANY_INT.
fn group_name(name: &str) -> String {
    name.replacen("Any", "ANY_", 1).trim_end_matches('_').to_uppercase()
}
