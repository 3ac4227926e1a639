//! Direct addresses `%IX1.2` and partial accesses `%X3`.
//! From: IEC 61131-3 §6.5.5 (language reference §1.9, §2.11).

use super::Problem;
use crate::syntax::ast::{Address, AddressSize, Area};
use takt_base::Span;
use takt_base::diag::Code;

/// Levels between the dots.
const MAX_LEVELS: usize = 8;

/// `%IX1.2`, `%QW3`, `%M*`.
pub(crate) fn direct(text: &str, span: Span) -> Result<Address, Problem> {
    let body = text.strip_prefix('%').unwrap_or(text);
    let area = match body.bytes().next().map(|b| b.to_ascii_uppercase()) {
        Some(b'I') => Area::Input,
        Some(b'Q') => Area::Output,
        Some(b'M') => Area::Marker,
        _ => return Err(bad("no area of this letter").at(0, 2).help("the areas are %I (inputs), %Q (outputs) and %M (markers)")),
    };
    let rest = &body[1..];
    let (size, rest) = match size_of(rest) {
        Some(size) => (size, &rest[1..]),
        None => (AddressSize::Bit, rest),
    };
    if rest == "*" {
        return Ok(Address { area, size, path: Vec::new(), span });
    }
    Ok(Address { area, size, path: path(rest)?, span })
}

/// `%X3` behind a dot: size and index.
pub(crate) fn partial(text: &str) -> Result<(AddressSize, u32), Problem> {
    let body = text.strip_prefix('%').unwrap_or(text);
    let size = size_of(body).ok_or_else(|| bad("not a part of a value").help("the parts are %X (bit), %B, %W, %D and %L"))?;
    match body.get(1..) {
        Some(digits) if !digits.is_empty() => Ok((size, index(digits)?)),
        _ => Err(bad("the number is missing").help("for example %X3 or %B1")),
    }
}

/// `7` in `%B1.7`.
pub(crate) fn bit(text: &str) -> Result<u32, Problem> {
    index(text)
}

fn size_of(text: &str) -> Option<AddressSize> {
    Some(match text.bytes().next()?.to_ascii_uppercase() {
        b'X' => AddressSize::Bit,
        b'B' => AddressSize::Byte,
        b'W' => AddressSize::Word,
        b'D' => AddressSize::Dword,
        b'L' => AddressSize::Lword,
        _ => return None,
    })
}

fn path(text: &str) -> Result<Vec<u32>, Problem> {
    if text.is_empty() {
        return Err(bad("the number is missing").help("for example %IX1.2 or %QW3"));
    }
    let path: Vec<u32> = text.split('.').map(index).collect::<Result<_, _>>()?;
    if path.len() > MAX_LEVELS {
        return Err(bad(format!("more than {MAX_LEVELS} levels")));
    }
    Ok(path)
}

fn index(text: &str) -> Result<u32, Problem> {
    if text.bytes().all(|b| b.is_ascii_digit()) {
        return text.parse().map_err(|_| bad("the number is too large"));
    }
    if text.ends_with('*') {
        return Err(bad("a * stands instead of the whole number").help("write %I*, %Q* or %M*"));
    }
    Err(bad("not a number"))
}

fn bad(label: impl Into<String>) -> Problem {
    Problem::new(Code::BadAddress, label)
}
