//! Names of the library (library reference §1, §2.1, §2.6, §13).

use std::collections::HashSet;
use takt_image::Elementary as E;
use takt_stdlib::catalog::{Intrinsic, Lowering, Pattern, functions};
use takt_stdlib::lookup::{converts, truncates};
use takt_stdlib::{ConversionType as C, Found, lookup};

/// What a name stands for, as text.
fn show(name: &str) -> String {
    match lookup(name) {
        None => "-".to_owned(),
        Some(Found::Function { function, fixed: None }) => function.name.to_owned(),
        Some(Found::Function { function, fixed: Some(ty) }) => format!("{} of {}", function.name, ty.name()),
        Some(Found::Conversion { from, to, truncate }) => {
            let from = from.map_or("any", C::name);
            format!("{from} {} {}", if truncate { "trunc" } else { "to" }, to.name())
        }
    }
}

/// Library reference §1: overloaded and typed names.
#[test]
fn overloaded_and_typed_names() {
    for (name, want) in [
        ("ADD", "ADD"),
        ("add", "ADD"),
        ("ADD_INT", "ADD of INT"),
        ("Add_Time", "ADD of TIME"),
        ("SUB_LTIME", "SUB of LTIME"),
        ("ADD_BYTE", "-"),
        ("ADD_DATE", "-"),
        ("SIN_LREAL", "SIN of LREAL"),
        ("SIN_INT", "-"),
        ("MAX_TIME", "MAX of TIME"),
        ("SEL_BYTE", "SEL of BYTE"),
        ("LIMIT_REAL", "LIMIT of REAL"),
        ("SHL_WORD", "SHL of WORD"),
        ("SHL_INT", "-"),
        ("MOD_REAL", "-"),
        ("MUL_TIME", "MUL_TIME"),
        ("MUL_LTIME", "MUL_LTIME"),
        ("MULTIME", "MULTIME"),
        ("ADD_TOD_TIME", "ADD_TOD_TIME"),
        ("CONCAT_DATE_TOD", "CONCAT_DATE_TOD"),
        ("GT_INT", "GT of INT"),
        ("LEN_STRING", "-"),
        ("TIME", "TIME"),
        ("LTIME", "LTIME"),
        ("IS_VALID_BCD", "IS_VALID_BCD"),
        ("ADD_DATE_AND_TIME_TIME", "ADD_DT_TIME"),
    ] {
        assert_eq!(show(name), want, "{name}");
    }
}

/// Library reference §2.1, §2.6: conversions, long names, truncation, BCD.
#[test]
fn conversion_names() {
    for (name, want) in [
        ("INT_TO_REAL", "INT to REAL"),
        ("int_to_int", "INT to INT"),
        ("TO_REAL", "any to REAL"),
        ("TO_STRING", "any to STRING"),
        ("TO_CHAR", "any to CHAR"),
        ("TRUNC", "TRUNC"),
        ("TRUNC_INT", "any trunc INT"),
        ("REAL_TRUNC_INT", "REAL trunc INT"),
        ("INT_TRUNC_INT", "-"),
        ("TRUNC_REAL", "-"),
        ("DATE_AND_TIME_TO_DATE", "DT to DATE"),
        ("DATE_AND_TIME_TO_TIME_OF_DAY", "DT to TOD"),
        ("LDATE_AND_TIME_TO_LTIME_OF_DAY", "LDT to LTOD"),
        ("TOD_TO_LTOD", "TOD to LTOD"),
        ("TIME_TO_DATE", "-"),
        ("DATE_TO_TOD", "-"),
        ("TOD_TO_DT", "-"),
        ("DWORD_TO_REAL", "DWORD to REAL"),
        ("REAL_TO_LWORD", "REAL to LWORD"),
        ("REAL_TO_BOOL", "REAL to BOOL"),
        ("STRING_TO_TIME", "STRING to TIME"),
        ("WSTRING_TO_STRING", "WSTRING to STRING"),
        ("CHAR_TO_INT", "-"),
        ("INT_TO_CHAR", "-"),
        ("CHAR_TO_BYTE", "CHAR to BYTE"),
        ("WCHAR_TO_BYTE", "-"),
        ("WORD_TO_WCHAR", "WORD to WCHAR"),
        ("WORD_TO_CHAR", "-"),
        ("INT_TO_FOO", "-"),
        ("FOO_TO_INT", "-"),
        ("INTTO_INT", "-"),
        ("_TO_INT", "-"),
        ("INT_TO_", "-"),
        ("WORD_BCD_TO_UINT", "WORD_BCD_TO_UINT"),
        ("TO_BCD_BYTE", "TO_BCD_BYTE"),
    ] {
        assert_eq!(show(name), want, "{name}");
    }
}

/// Library reference §2.6: what edition 3 names itself.
#[test]
fn conversions_of_edition_3() {
    let numbers = [E::Sint, E::Int, E::Dint, E::Lint, E::Usint, E::Uint, E::Udint, E::Ulint, E::Real, E::Lreal];
    let bits = [E::Bool, E::Byte, E::Word, E::Dword, E::Lword];
    for from in numbers.into_iter().chain(bits) {
        for to in numbers.into_iter().chain(bits) {
            if !(from.is_real() || to.is_real()) || (numbers.contains(&from) && numbers.contains(&to)) {
                assert!(lookup(&format!("{}_TO_{}", from.name(), to.name())).is_some(), "{from:?} {to:?}");
            }
        }
    }
    let others = "LTIME_TO_TIME TIME_TO_LTIME LDT_TO_DT LDT_TO_DATE LDT_TO_LTOD LDT_TO_TOD DT_TO_LDT DT_TO_DATE DT_TO_LTOD DT_TO_TOD \
        LTOD_TO_TOD TOD_TO_LTOD WSTRING_TO_STRING WSTRING_TO_WCHAR STRING_TO_WSTRING STRING_TO_CHAR WCHAR_TO_WSTRING WCHAR_TO_CHAR \
        CHAR_TO_STRING CHAR_TO_WCHAR CHAR_TO_BYTE CHAR_TO_WORD CHAR_TO_DWORD CHAR_TO_LWORD WCHAR_TO_WORD WCHAR_TO_DWORD \
        WCHAR_TO_LWORD BYTE_TO_CHAR DWORD_TO_REAL REAL_TO_DWORD LWORD_TO_LREAL LREAL_TO_LWORD";
    for name in others.split_whitespace() {
        assert!(lookup(name).is_some(), "{name}");
    }
}

/// Every pair is found by its name exactly if the table has it.
#[test]
fn names_agree_with_the_table() {
    for from in C::all() {
        for to in C::all() {
            let name = format!("{}_TO_{}", from.name(), to.name());
            assert_eq!(lookup(&name).is_some(), converts(from, to), "{name}");
            let name = format!("{}_TRUNC_{}", from.name(), to.name());
            assert_eq!(lookup(&name).is_some(), truncates(from, to), "{name}");
        }
    }
}

#[test]
fn the_catalogue_is_well_formed() {
    let mut names = HashSet::new();
    for function in functions() {
        assert!(names.insert(function.name), "{} twice", function.name);
        assert_eq!(function.name, function.name.to_ascii_uppercase());
        assert!(!function.doc.is_empty() && !function.doc.ends_with('.'), "{}", function.name);
        assert_eq!(function.extensible, function.extensible && function.params.len() >= 2, "{}", function.name);
        if let Pattern::T(group) = function.result {
            assert_eq!(function.group(), Some(group), "{}", function.name);
        }
        assert!(matches!(lookup(function.name), Some(Found::Function { fixed: None, .. })), "{}", function.name);
    }
    let time = functions().find(|f| f.name == "TIME").map(|f| f.lowering);
    assert_eq!(time, Some(Lowering::Inline(Intrinsic::Now)));
}

#[test]
fn odd_names_are_unknown() {
    for name in ["", "_", "__", "TO_", "ADD_", "_ADD", "ÄÖ_TO_INT", &"A".repeat(10_000), &"TO_".repeat(1000), "ADD_INT_INT"] {
        assert!(lookup(name).is_none(), "{name}");
    }
}
