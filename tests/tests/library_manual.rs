//! The library manual is made of the catalogue and of the heads of the function blocks. `TAKT_BLESS=1` writes it anew.

use std::fmt::Write;
use takt_stdlib::SOURCES;
use takt_stdlib::catalog::notes::NOTES;
use takt_stdlib::catalog::{Function, GROUPS, Pattern, TITLES, functions};
use takt_stdlib::vendor::VENDOR_SOURCES;
use takt_tests::plc::Plc;

const PATH: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/guide/library.md");

#[test]
fn manual_is_up_to_date() {
    let text = manual();
    if std::env::var_os("TAKT_BLESS").is_some() {
        std::fs::write(PATH, &text).unwrap();
    }
    assert_eq!(std::fs::read_to_string(PATH).unwrap_or_default(), text, "run it with TAKT_BLESS=1 and read the difference");
}

/// Every function has one note, and its example uses it and is TRUE.
#[test]
fn examples_are_true() {
    let names: Vec<_> = functions().map(|f| f.name).collect();
    let noted: Vec<_> = NOTES.iter().map(|(name, _, _)| *name).collect();
    assert_eq!(noted, names);
    let vars: String = names.iter().map(|name| format!("v_{name} : BOOL; ")).collect();
    let body: String = NOTES.iter().map(|(name, _, example)| format!("v_{name} := {example};\n")).collect();
    let mut plc = Plc::new(&format!("PROGRAM p VAR {vars} END_VAR {body} END_PROGRAM"));
    plc.scan(0).unwrap();
    for (name, _, example) in NOTES {
        assert!(example.contains(&format!("{name}(")), "{example}");
        assert_eq!(plc.get(&format!("p.v_{name}")), "TRUE", "{example}");
    }
}

fn manual() -> String {
    let mut out = String::from(HEAD);
    for (title, group) in TITLES.iter().zip(GROUPS) {
        let _ =
            writeln!(out, "### {title}\n\n| function | result | what it does | on an error | example |\n|---|---|---|---|---|");
        for f in *group {
            let (error, example) = note(f);
            let _ = writeln!(out, "| `{}` | {} | {} | {error} | `{example}` |", signature(f), kind(f.result), f.doc);
        }
        out += "\n";
    }
    out += BLOCKS;
    for (name, text) in SOURCES {
        let _ = writeln!(out, "### {name}\n\n{}\n```st\n{}\n```\n", pins(text), text.trim_end());
    }
    out += VENDORS;
    for (name, text, _) in VENDOR_SOURCES {
        let head = text.split_once("*)").map_or("", |(head, _)| head);
        let _ = writeln!(out, "### {name}\n\n{}\n```st\n{head}*)\n```\n", pins(text));
    }
    out.trim_end().to_owned() + "\n"
}

const HEAD: &str = "# Standard library

Functions are overloaded: `T` is the common type of all inputs marked so. Typed names such as `ADD_INT` or `SIN_LREAL` fix it. `..` may be
continued: IN3, IN4, ... Conversions are `X_TO_Y` and `TO_Y` for all elementary types and strings, `TRUNC_Y` toward zero.

On an error the function gives the stated value, and ENO of the call is FALSE. A constant call with an error is refused by the compiler.

## Functions

";

const BLOCKS: &str = "## Function blocks

SR and RS take SET1, RESET and SET, RESET1 too in the profiles of vendors. TP, TON and TOF take LTIME as PT as well. The outputs of
SPLIT_DATE and the like go into integers of any type.

";

const VENDORS: &str = "## Function blocks of vendors

A file of the profile gets them under the plain names, unless the project declares a block of that name. LTP, LTON and LTOF of profile
codesys are TP_LTIME, TON_LTIME and TOF_LTIME.

";

fn note(f: &Function) -> (&'static str, &'static str) {
    let &(_, error, example) = NOTES.iter().find(|(name, _, _)| *name == f.name).unwrap_or_else(|| panic!("{}", f.name));
    (error, example)
}

/// The units of a file with their pins.
fn pins(text: &str) -> String {
    let mut out = String::from("| unit | inputs | outputs |\n|---|---|---|\n");
    for unit in text.split("\nFUNCTION").skip(1) {
        let name = unit.lines().next().unwrap_or("").rsplit(' ').next().unwrap_or("");
        let _ = writeln!(out, "| {name} | {} | {} |", section(unit, "VAR_INPUT"), section(unit, "VAR_OUTPUT"));
    }
    out
}

/// `IN : BOOL, PT : TIME`.
fn section(unit: &str, head: &str) -> String {
    let lines = unit.split_once(head).map_or("", |(_, rest)| rest.split_once("END_VAR").map_or("", |(lines, _)| lines));
    lines.lines().map(|line| line.trim().trim_end_matches(';')).filter(|line| !line.is_empty()).collect::<Vec<_>>().join(", ")
}

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
