//! Text of a user to the bytes of a value, with range checks.

use super::VarType;
use crate::access::AccessError;
use crate::elementary::Elementary as E;
use crate::literal::{parse_int, parse_real, parse_string, real_text};
use crate::literal_time::parse_time;
use crate::types::{Type, TypeTable};
use takt_base::nearest;

type Parsed = Result<Vec<u8>, AccessError>;

/// The bytes of the value.
pub(super) fn parse(types: &TypeTable, ty: VarType, text: &str) -> Parsed {
    let id = match ty {
        VarType::Direct(e) => return elementary(e, text),
        VarType::Declared(id) => id,
    };
    match types.try_get(id) {
        Some(Type::Elementary(e)) => elementary(*e, text),
        Some(Type::Subrange { name, base, low, high }) => integer(*base, name, (*low, *high), text),
        Some(Type::Enum { name, base, values }) => enumerator(*base, name, values, text),
        Some(Type::String { capacity }) => string(*capacity, false, text),
        Some(Type::WString { capacity }) => string(*capacity, true, text),
        Some(Type::Reference { .. } | Type::Pointer { .. }) | None => {
            Err(AccessError::value("a reference can't be set from text"))
        }
        Some(_) => {
            let message = format!("{} has more than one value", types.display(id));
            Err(AccessError::value(message).help("set its members or elements one by one"))
        }
    }
}

fn bad(text: &str, ty: &str) -> AccessError {
    AccessError::value(format!("`{text}` is not a {ty}"))
}

fn elementary(e: E, text: &str) -> Parsed {
    match e {
        E::Bool => boolean(text),
        E::Real => real(text),
        E::Lreal => lreal(text),
        E::Char | E::Wchar => character(e, text),
        e if e.is_duration() || e.is_date() => {
            let ns = parse_time(e, text).ok_or_else(|| bad(text, e.name()).help(format!("write {}", example(e))))?;
            Ok(ns.to_le_bytes().to_vec())
        }
        e => integer(e, e.name(), e.int_range().unwrap_or((0, 0)), text),
    }
}

fn example(e: E) -> &'static str {
    match e {
        E::Time | E::Ltime => "T#1s500ms",
        E::Date | E::Ldate => "D#2024-02-29",
        E::Tod | E::Ltod => "TOD#07:05:03.25",
        _ => "DT#2024-02-29-07:05:03",
    }
}

/// The text behind the type's own prefix: `INT#5`, but not `16#5`.
fn unprefixed<'a>(text: &'a str, name: &str) -> &'a str {
    text.split_once('#').filter(|(p, _)| p.trim().eq_ignore_ascii_case(name)).map_or(text, |(_, rest)| rest.trim())
}

fn boolean(text: &str) -> Parsed {
    match unprefixed(text, "BOOL").to_ascii_uppercase().as_str() {
        "TRUE" | "1" => Ok(vec![1]),
        "FALSE" | "0" => Ok(vec![0]),
        _ => Err(bad(text, "BOOL").help("write TRUE or FALSE")),
    }
}

fn integer(base: E, name: &str, (low, high): (i128, i128), text: &str) -> Parsed {
    if base == E::Bool {
        return boolean(text);
    }
    let body = unprefixed(unprefixed(text, name), base.name());
    let value = parse_int(body).ok_or_else(|| bad(text, name).help("write a number such as 42, -5 or 16#FF"))?;
    if value < low || value > high {
        return Err(AccessError::value(format!("{text} does not fit {name}")).help(format!("the range is {low} to {high}")));
    }
    Ok(value.to_le_bytes()[..base.bytes() as usize].to_vec())
}

fn enumerator(base: E, name: &str, values: &[(String, i128)], text: &str) -> Parsed {
    let body = unprefixed(text, name);
    let named = values.iter().find(|(n, _)| n.eq_ignore_ascii_case(body)).map(|(_, v)| *v);
    let value = named.or_else(|| parse_int(body).filter(|i| values.iter().any(|(_, v)| v == i)));
    let names = || values.iter().map(|(n, _)| n.as_str());
    let value = value.ok_or_else(|| {
        let help = match nearest(body, names()) {
            Some(n) => format!("did you mean `{n}`?"),
            None => format!("its values are {}", names().take(12).collect::<Vec<_>>().join(", ")),
        };
        bad(text, name).help(help)
    })?;
    Ok(value.to_le_bytes()[..base.bytes() as usize].to_vec())
}

const REAL_HELP: &str = "write a number such as 1.5, -2 or 1.5E3";

fn lreal(text: &str) -> Parsed {
    let body = unprefixed(text, "LREAL");
    let value = parse_real(body).ok_or_else(|| bad(text, "LREAL").help(REAL_HELP))?;
    finite(text, "LREAL", value.is_infinite())?;
    Ok(value.to_le_bytes().to_vec())
}

fn real(text: &str) -> Parsed {
    // Rounded once, from the text: by way of LREAL some numbers would be off by one bit.
    let body = real_text(unprefixed(text, "REAL"));
    let value: f32 = body.and_then(|t| t.parse().ok()).ok_or_else(|| bad(text, "REAL").help(REAL_HELP))?;
    finite(text, "REAL", value.is_infinite())?;
    Ok(value.to_le_bytes().to_vec())
}

/// Infinity must be meant: a number that is too large is an error.
fn finite(text: &str, name: &str, infinite: bool) -> Result<(), AccessError> {
    let meant = text.to_ascii_uppercase().contains("INF");
    if infinite && !meant { Err(AccessError::value(format!("{text} does not fit {name}"))) } else { Ok(()) }
}

fn character(e: E, text: &str) -> Parsed {
    let units = parse_string(unprefixed(text, e.name()), e == E::Wchar);
    match units.as_deref() {
        Some([unit]) => Ok(unit.to_le_bytes()[..e.bytes() as usize].to_vec()),
        _ => Err(bad(text, e.name()).help("write one character in quotes")),
    }
}

fn string(capacity: u32, wide: bool, text: &str) -> Parsed {
    let name = if wide { "WSTRING" } else { "STRING" };
    let units = parse_string(unprefixed(text, name), wide)
        .ok_or_else(|| bad(text, name).help("write the text in quotes; a quote or dollar sign in it as $' or $$"))?;
    if units.len() > capacity as usize {
        let message = format!("the text has {} characters, {name}[{capacity}] has room for {capacity}", units.len());
        return Err(AccessError::value(message));
    }
    let mut bytes: Vec<u8> =
        if wide { units.iter().flat_map(|u| u.to_le_bytes()).collect() } else { units.iter().map(|&u| u as u8).collect() };
    bytes.extend([0, 0].iter().take(if wide { 2 } else { 1 }));
    Ok(bytes)
}

/// A string's characters as they stand in a literal.
pub(super) fn escaped(text: &str, quote: char) -> String {
    let mut out = String::new();
    for c in text.chars() {
        match c {
            '\n' => out += "$N",
            '\r' => out += "$R",
            '\t' => out += "$T",
            c if c == quote || c == '$' => out.extend(['$', c]),
            c if c.is_control() => out += &format!("${:0width$X}", c as u32, width = if quote == '"' { 4 } else { 2 }),
            c => out.push(c),
        }
    }
    out
}
