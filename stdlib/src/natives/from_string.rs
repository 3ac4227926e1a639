//! Text as values: leading blanks, then a literal of the type, with or without its prefix, and nothing behind it; everything else is
//! 0. Integers and durations out of range saturate. From: library reference §2.4; literals as in language reference §1.5, §1.7.
//! CODESYS: the longest beginning that is a literal counts, and no text is an error.
//! Runs: cyclic.

use super::Types;
use super::literals::{self, Cursor};
use super::text::{Text, source, width};
use crate::lookup::ConversionType;
use takt_image::{Elementary as E, NativeCall, Trap};

/// Longest literal in characters; a longer text is none.
const LITERAL_MAX: usize = 1024;

/// Slots: string.
pub(super) fn from_string(call: &mut NativeCall, types: Types) -> Result<(), Trap> {
    let ConversionType::Elementary(to) = types.to else { return Err(Trap::NativePanic) };
    let text = source(call, 0, width(types.from))?;
    let mut buffer = [0; LITERAL_MAX];
    let literal = read(call, text, &mut buffer);
    let codesys = types.profile.is_codesys();
    let value = literal.map(|literal| without_prefix(literal, to)).and_then(|literal| match codesys {
        true => beginning(literal, to),
        false => value(literal, to),
    });
    if !value.as_ref().map_or(codesys, |v| v.exact) {
        call.fail();
    }
    call.result = value.map_or(0, |v| v.slot);
    Ok(())
}

/// The characters behind leading blanks.
fn read<'a>(call: &NativeCall, text: Text, buffer: &'a mut [u8; LITERAL_MAX]) -> Option<&'a [u8]> {
    let blank = |&i: &usize| matches!(text.unit(call, i), 0x20 | 0x09);
    let start = (0..text.len).take_while(blank).count();
    let literal = buffer.get_mut(..text.len - start)?;
    for (i, place) in literal.iter_mut().enumerate() {
        *place = u8::try_from(text.unit(call, start + i)).unwrap_or(b'?');
    }
    Some(literal)
}

/// `INT#5` is 5 for INT and all that INT widens to; `T#`, `D#` and the like are short names.
fn without_prefix(literal: &[u8], to: E) -> &[u8] {
    let Some(at) = literal.iter().position(|&b| b == b'#') else { return literal };
    let name = literal.get(..at).and_then(|name| std::str::from_utf8(name).ok()).unwrap_or("");
    let ty = match name {
        "T" | "t" => Some(E::Time),
        "D" | "d" => Some(E::Date),
        _ if name.eq_ignore_ascii_case("LT") => Some(E::Ltime),
        _ if name.eq_ignore_ascii_case("LD") => Some(E::Ldate),
        _ => E::from_name(name),
    };
    if ty.is_some_and(|ty| ty.widens_to(to)) { literal.get(at + 1..).unwrap_or(&[]) } else { literal }
}

/// What a literal says.
struct Parsed {
    slot: u64,
    /// It is in the range of the type.
    exact: bool,
}

/// The value of a literal.
fn value(literal: &[u8], to: E) -> Option<Parsed> {
    let mut exact = true;
    let mut cursor = Cursor::new(literal);
    let slot = match to {
        E::Real => u64::from(real::<f32>(&mut cursor)?.to_bits()),
        E::Lreal => real::<f64>(&mut cursor)?.to_bits(),
        E::Bool => boolean(&mut cursor)?,
        E::Time | E::Ltime => literals::duration(&mut cursor)? as u64,
        E::Date | E::Ldate => literals::date(&mut cursor)? as u64,
        E::Tod | E::Ltod => literals::tod(&mut cursor)? as u64,
        E::Dt | E::Ldt => literals::instant(&mut cursor)? as u64,
        _ => {
            let (low, high) = to.int_range()?;
            let value = literals::integer(&mut cursor)?;
            exact = (low..=high).contains(&value);
            value.clamp(low, high) as u64
        }
    };
    cursor.at_end().then_some(Parsed { slot, exact })
}

/// Longest text of CODESYS that is looked at.
const CODESYS_MAX: usize = 255;

/// The value of the longest beginning that is a literal.
fn beginning(text: &[u8], to: E) -> Option<Parsed> {
    let text = text.get(..CODESYS_MAX).unwrap_or(text);
    (1..=text.len()).rev().find_map(|len| value(text.get(..len)?, to))
}

/// TRUE, FALSE, 1, 0.
fn boolean(cursor: &mut Cursor) -> Option<u64> {
    if cursor.eat_word("TRUE") || cursor.eat(b'1') {
        return Some(1);
    }
    (cursor.eat_word("FALSE") || cursor.eat(b'0')).then_some(0)
}

/// Sign, digits, and optionally a fraction and an exponent.
fn real<F: std::str::FromStr>(cursor: &mut Cursor) -> Option<F> {
    let mut buffer = [0; LITERAL_MAX];
    let mut out = Digits { bytes: &mut buffer, len: 0 };
    if let Some(sign) = cursor.eat_any(b"+-") {
        out.push(sign);
    }
    cursor.digits(10, |d| out.push(d))?;
    if cursor.eat(b'.') {
        out.push(b'.');
        cursor.digits(10, |d| out.push(d))?;
    }
    if cursor.eat_any(b"eE").is_some() {
        out.push(b'e');
        if let Some(sign) = cursor.eat_any(b"+-") {
            out.push(sign);
        }
        cursor.digits(10, |d| out.push(d))?;
    }
    std::str::from_utf8(out.bytes.get(..out.len)?).ok()?.parse().ok()
}

/// A literal without its underscores. It is not longer than the literal, so that everything fits.
struct Digits<'a> {
    bytes: &'a mut [u8; LITERAL_MAX],
    len: usize,
}

impl Digits<'_> {
    fn push(&mut self, byte: u8) {
        if let Some(place) = self.bytes.get_mut(self.len) {
            *place = byte;
            self.len += 1;
        }
    }
}
