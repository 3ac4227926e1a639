//! Integers and reals.
//! From: IEC 61131-3 §6.3.2 (language reference §1.5).

use super::{Problem, Read, Value};
use crate::syntax::ast::Literal;
use takt_base::diag::Code;

/// `1_000`.
pub(crate) fn integer(text: &str) -> Read {
    underscores(text)?;
    let value = digits(text, 10).ok_or_else(too_large)?;
    Ok(Literal::Int { value, based: false }.into())
}

/// `16#FF`, `2#1010`, `8#17`.
pub(crate) fn based(text: &str) -> Read {
    let (base, rest) = text.split_once('#').unwrap_or((text, ""));
    let radix = match base {
        "2" => 2,
        "8" => 8,
        "16" => 16,
        _ => return Err(bad(format!("there is no base {base}")).at(0, base.len()).help("the bases are 2#, 8# and 16#")),
    };
    let first = base.len() + 1;
    if rest.is_empty() {
        return Err(bad("no digits behind the #").help(format!("write {base}# and the digits, without a blank or a sign")));
    }
    if let Some(i) = rest.bytes().position(|b| b != b'_' && !(b as char).is_digit(radix)) {
        return Err(bad(format!("not a digit of base {radix}")).at(first + i, first + i + 1));
    }
    underscores(rest).map_err(|p| p.at(first, text.len()))?;
    let value = digits(rest, radix).ok_or_else(too_large)?;
    Ok(Literal::Int { value, based: true }.into())
}

/// `3.14`, `1.0E-6`; also `1E6` and `1.`, with a warning.
pub(crate) fn real(text: &str) -> Read {
    let split = text.find(['e', 'E']).unwrap_or(text.len());
    let (mantissa, exponent) = text.split_at(split);
    for part in mantissa.split('.').chain([exponent.trim_start_matches(['e', 'E', '+', '-'])]) {
        if !part.is_empty() {
            underscores(part)?;
        }
    }
    let plain: String = text.chars().filter(|&c| c != '_').collect();
    let value: f64 = plain.parse().map_err(|_| bad("not a number"))?;
    if !value.is_finite() {
        return Err(bad("larger than the largest LREAL").help("the largest LREAL is 1.79E308"));
    }
    let unusual = !mantissa.contains('.') || mantissa.ends_with('.');
    let warning = unusual.then(|| {
        let whole = mantissa.trim_end_matches('.');
        bad("the standard wants a digit on both sides of the point").help(format!("write {whole}.0{exponent}"))
    });
    Ok(Value { literal: Literal::Real(value), warning })
}

/// What is wrong with `12abc` or `1.E3`.
pub(crate) fn explain_bad(text: &str) -> Problem {
    let number = text.trim_end_matches(|c: char| c.is_ascii_alphabetic());
    let unit = text[number.len()..].to_ascii_lowercase();
    if matches!(unit.as_str(), "d" | "h" | "m" | "s" | "ms" | "us" | "ns") {
        return bad("a number with a unit").help(format!("write T#{text} for a duration"));
    }
    if text.starts_with("0x") || text.starts_with("0X") {
        return bad("not a number of this language").help(format!("write 16#{}", &text[2..]));
    }
    if text.contains('.') {
        return bad("a digit is missing behind the point").help(format!("write {}", text.replacen('.', ".0", 1)));
    }
    bad("letters in a number").help("a name starts with a letter or an underscore")
}

fn bad(label: impl Into<String>) -> Problem {
    Problem::new(Code::BadNumber, label)
}

fn too_large() -> Problem {
    bad("larger than every integer type").help("the largest integer is 18446744073709551615, ULINT")
}

/// Underscores stand alone and between digits.
fn underscores(text: &str) -> Result<(), Problem> {
    if text.contains("__") || text.starts_with('_') || text.ends_with('_') {
        return Err(bad("an underscore belongs between two digits"));
    }
    Ok(())
}

/// The value of digits of a base, underscores skipped; `None` if it does not fit.
fn digits(text: &str, radix: u32) -> Option<i128> {
    let mut value: i128 = 0;
    for c in text.chars().filter(|&c| c != '_') {
        value = value.checked_mul(radix as i128)?.checked_add(c.to_digit(radix)? as i128)?;
    }
    Some(value)
}
