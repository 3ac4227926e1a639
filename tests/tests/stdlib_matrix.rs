//! All conversions between elementary types and strings (library reference §2.1, §2.6): which exist, and the value of 1, or of what
//! stands for it in types that are no numbers.

use takt_base::{Code, Profile};
use takt_image::Elementary as E;
use takt_tests::plc::{Plc, compile_in};

/// All ends of conversions, with the literal that is converted.
const ENDS: &[(&str, &str)] = &[
    ("SINT", "1"),
    ("INT", "1"),
    ("DINT", "1"),
    ("LINT", "1"),
    ("USINT", "1"),
    ("UINT", "1"),
    ("UDINT", "1"),
    ("ULINT", "1"),
    ("REAL", "1.0"),
    ("LREAL", "1.0"),
    ("BOOL", "TRUE"),
    ("BYTE", "16#1"),
    ("WORD", "16#1"),
    ("DWORD", "16#1"),
    ("LWORD", "16#1"),
    ("TIME", "T#1s"),
    ("LTIME", "LTIME#1s"),
    ("DATE", "D#1970-01-02"),
    ("LDATE", "LDATE#1970-01-02"),
    ("TOD", "TOD#00:00:01"),
    ("LTOD", "LTOD#00:00:01"),
    ("DT", "DT#1970-01-01-00:00:01"),
    ("LDT", "LDT#1970-01-01-00:00:01"),
    ("CHAR", "'1'"),
    ("WCHAR", "\"1\""),
    ("STRING", "'1'"),
    ("WSTRING", "\"1\""),
];

/// Kinds of the rows and columns of §2.1.
#[derive(Clone, Copy, PartialEq, Debug)]
enum Kind {
    Int,
    Real,
    Bool,
    Bits,
    Duration,
    Date,
    Text,
    Char,
}

fn kind(ty: &str) -> Kind {
    match E::from_name(ty) {
        None => Kind::Text,
        Some(E::Bool) => Kind::Bool,
        Some(e) if e.is_int() => Kind::Int,
        Some(e) if e.is_real() => Kind::Real,
        Some(e) if e.is_bit() => Kind::Bits,
        Some(e) if e.is_duration() => Kind::Duration,
        Some(e) if e.is_char() => Kind::Char,
        Some(_) => Kind::Date,
    }
}

fn bytes(ty: &str) -> u32 {
    E::from_name(ty).map_or(0, E::bytes)
}

/// The cells of §2.1 that are not empty.
fn exists(profile: Profile, from: &str, to: &str) -> bool {
    use Kind::*;
    let short = |ty: &str| ty.trim_start_matches('L').to_owned();
    match (kind(from), kind(to)) {
        _ if from == to => true,
        (Text, _) | (_, Text) | (Char, Char) => true,
        (Char, Bits) => bytes(to) >= bytes(from),
        (Bits, Char) => matches!((from, to), ("BYTE", "CHAR") | ("WORD", "WCHAR")),
        (Char, _) | (_, Char) => false,
        (Real, Bits) | (Bits, Real) => profile.is_vendor() || bytes(from) == bytes(to),
        (Date, Date) => {
            let pair = (short(from), short(to));
            matches!((pair.0.as_str(), pair.1.as_str()), ("DT", _) | ("DATE", "DATE" | "DT") | ("TOD", "TOD"))
        }
        (Duration, Date) | (Date, Duration) => false,
        _ => true,
    }
}

/// Units in a second of the number that a time is.
fn per_second(profile: Profile, ty: &str) -> i128 {
    match ty {
        "TIME" | "TOD" if profile == Profile::OpenPlc => 1,
        "TIME" | "TOD" => 1000,
        "DATE" | "DT" => 1,
        _ => 1_000_000_000,
    }
}

/// What `one` of the source is as a number.
fn number(profile: Profile, from: &str) -> i128 {
    match from {
        "DATE" => 86400,
        "LDATE" => 86_400_000_000_000,
        "CHAR" | "WCHAR" => 49,
        _ if matches!(kind(from), Kind::Duration | Kind::Date) => per_second(profile, from),
        _ => 1,
    }
}

/// The low bits as a number of the type.
fn wrapped(value: i128, to: &str) -> i128 {
    let e = E::from_name(to).unwrap();
    let bits = value & ((1 << e.bits()) - 1);
    if e.is_signed_int() && bits >> (e.bits() - 1) == 1 { bits - (1 << e.bits()) } else { bits }
}

/// Nanoseconds as a time literal as it is shown.
fn time(to: &str, ns: i128) -> String {
    let duration = match ns {
        0 => "0s",
        1 => "1ns",
        1_000_000 => "1ms",
        1_000_000_000 => "1s",
        _ => panic!("{ns}"),
    };
    let clock = match ns {
        0 => "00:00:00",
        1 => "00:00:00.000000001",
        1_000_000 => "00:00:00.001",
        1_000_000_000 => "00:00:01",
        _ => "",
    };
    match to {
        "TIME" => format!("T#{duration}"),
        "LTIME" => format!("LT#{duration}"),
        "DATE" => "D#1970-01-01".into(),
        "LDATE" => "LD#1970-01-01".into(),
        "DT" | "LDT" => format!("{to}#1970-01-01-{clock}"),
        _ => format!("{to}#{clock}"),
    }
}

/// As text.
fn text(profile: Profile, from: &str) -> String {
    let literal = ENDS.iter().find(|(ty, _)| *ty == from).unwrap().1;
    match kind(from) {
        Kind::Real if matches!(profile, Profile::Codesys2 | Profile::OpenPlc) => "1".into(),
        Kind::Bits if profile.is_codesys() => "1".into(),
        Kind::Text | Kind::Char => "1".into(),
        _ if from == "LDATE" => "LD#1970-01-02".into(),
        _ => literal.into(),
    }
}

fn expected(profile: Profile, from: &str, to: &str) -> String {
    use Kind::*;
    let one = number(profile, from);
    match (kind(from), kind(to)) {
        (_, Text) => {
            if to == "STRING" {
                format!("'{}'", text(profile, from))
            } else {
                format!("\"{}\"", text(profile, from))
            }
        }
        (Text | Char, Char) => if to == "CHAR" { "'1'" } else { "\"1\"" }.into(),
        (Bits, Char) => if to == "CHAR" { "'$01'" } else { "\"$0001\"" }.into(),
        (_, Bool) => "TRUE".into(),
        (Text, Int | Bits) => "1".into(),
        (Text, Real) => "1.0".into(),
        (Text, _) => time(to, 0),
        (Real, Bits) if !profile.is_vendor() => if to == "DWORD" { "1065353216" } else { "4607182418800017408" }.into(),
        (Bits, Real) if !profile.is_vendor() => if to == "REAL" { "1e-45" } else { "5e-324" }.into(),
        (_, Int | Bits) => wrapped(one, to).to_string(),
        (_, Real) => match one {
            1 => "1.0",
            1000 => "1000.0",
            86400 => "86400.0",
            1_000_000_000 => "1000000000.0",
            _ => "86400000000000.0",
        }
        .into(),
        (Duration, Duration) => time(to, 1_000_000_000),
        (Date, Date) if to.ends_with("DT") && from.ends_with("DATE") => format!("{to}#1970-01-02-00:00:00"),
        (Date, Date) if to.ends_with("DATE") && from.ends_with("DATE") => time(to, 0).replace("-01-01", "-01-02"),
        (Date, Date) => time(to, 1_000_000_000),
        _ => time(to, 1_000_000_000 / per_second(profile, to)),
    }
}

#[test]
fn s2_1_values_of_all_pairs() {
    let mut count = 0;
    for profile in Profile::ALL {
        for (from, literal) in ENDS {
            let pairs: Vec<_> = ENDS.iter().map(|(to, _)| *to).filter(|to| exists(profile, from, to)).collect();
            let vars: String = pairs.iter().map(|to| format!("v_{to}, w_{to} : {to}; ")).collect();
            let body: String = pairs.iter().map(|to| format!("v_{to} := {from}_TO_{to}(x); w_{to} := TO_{to}(x); ")).collect();
            let mut plc =
                Plc::new_in(profile, &format!("PROGRAM p VAR x : {from} := {literal}; {vars} END_VAR {body} END_PROGRAM"));
            plc.scan(0).unwrap();
            for to in pairs {
                let want = expected(profile, from, to);
                let found = [plc.get(&format!("p.v_{to}")), plc.get(&format!("p.w_{to}"))];
                assert_eq!(found, [want.clone(), want], "{from}_TO_{to} in {profile:?}");
                count += 1;
            }
        }
    }
    assert!(count > 2400, "{count}");
}

#[test]
fn s2_1_empty_cells_are_errors() {
    for profile in Profile::ALL {
        let mut count = 0;
        let mut body = String::new();
        let vars: String = ENDS.iter().map(|(ty, _)| format!("v_{ty} : {ty}; ")).collect();
        for (from, _) in ENDS {
            for (to, _) in ENDS.iter().filter(|(to, _)| !exists(profile, from, to)) {
                count += 2;
                body += &format!("v_{to} := {from}_TO_{to}(v_{from});\nv_{to} := TO_{to}(v_{from});\n");
            }
        }
        let c = compile_in(profile, &format!("PROGRAM p VAR {vars} END_VAR\n{body}END_PROGRAM"));
        assert!(c.diags.iter().all(|d| matches!(d.code, Code::TypeMismatch | Code::UnknownName)), "{profile:?}");
        let lines: std::collections::BTreeSet<_> =
            c.diags.iter().map(|d| c.sources.line_col(d.span.source, d.span.start).line).collect();
        assert_eq!(lines.len(), count, "{profile:?}");
    }
}
