//! Values as text. From: library reference §2.3. Standard: integers decimal, bit strings `16#` and hexadecimal digits, reals the shortest
//! decimal that reads back as the same value, times and dates as literals with their prefix.
//! CODESYS: bit strings decimal, reals of 7 or 16 digits, durations in whole milliseconds. OpenPLC: lower case, reals as `%.10g`.
//! Runs: cyclic.

use super::Types;
use super::numbers::extend;
use super::text::{store_units, target, width};
use crate::calendar::{MILLISECOND_NS, SECOND_NS, date_of, time_of_day};
use crate::lookup::ConversionType;
use std::fmt::{self, Write};
use takt_base::Profile;
use takt_image::literal_time::UNITS;
use takt_image::{Elementary as E, NativeCall, Trap};

/// Slots: value, target.
pub(super) fn to_string(call: &mut NativeCall, types: Types) -> Result<(), Trap> {
    let ConversionType::Elementary(from) = types.from else { return Err(Trap::NativePanic) };
    let mut line = Line::default();
    // A Line takes whatever it is given, so that writing can't fail.
    write_value(&mut line, call.i64(0) as u64, from, types.profile).map_err(|_| Trap::NativePanic)?;
    let to = target(call, 1, width(types.to))?;
    store_units(call, &to, line.len, |_, i| line.bytes.get(i).map_or(0, |&b| b.into()))
}

/// Text on the stack. The longest is an LTIME with all its parts, under 50 characters; what passes the end is dropped.
struct Line {
    bytes: [u8; 64],
    len: usize,
}

impl Default for Line {
    fn default() -> Self {
        Self { bytes: [0; 64], len: 0 }
    }
}

impl Write for Line {
    fn write_str(&mut self, s: &str) -> fmt::Result {
        for (place, &byte) in self.bytes.iter_mut().skip(self.len).zip(s.as_bytes()) {
            *place = byte;
            self.len += 1;
        }
        Ok(())
    }
}

fn write_value(line: &mut Line, slot: u64, ty: E, profile: Profile) -> fmt::Result {
    let bits = extend(slot, ty);
    match ty {
        E::Real if profile == Profile::Std => write_real(line, format_args!("{:e}", f32::from_bits(slot as u32)), POINT),
        E::Lreal if profile == Profile::Std => write_real(line, format_args!("{:e}", f64::from_bits(slot)), POINT),
        E::Real => write_vendor_real(line, f64::from(f32::from_bits(slot as u32)), 7, profile),
        E::Lreal => write_vendor_real(line, f64::from_bits(slot), 16, profile),
        E::Bool => line.write_str(if bits != 0 { "TRUE" } else { "FALSE" }),
        E::Byte | E::Word | E::Dword | E::Lword if profile.is_codesys() => write!(line, "{bits}"),
        E::Byte | E::Word | E::Dword | E::Lword if profile == Profile::OpenPlc => write!(line, "16#{bits:x}"),
        E::Byte | E::Word | E::Dword | E::Lword => write!(line, "16#{bits:X}"),
        E::Time if profile.is_codesys() => write_duration(line, "T#", bits as i64 / MILLISECOND_NS * MILLISECOND_NS, "0ms"),
        E::Time => write_duration(line, "T#", bits as i64, "0s"),
        E::Ltime => write_duration(line, "LTIME#", bits as i64, "0s"),
        E::Date | E::Ldate => write_prefix(line, ty).and_then(|()| write_date(line, bits as i64)),
        E::Tod | E::Ltod => write_prefix(line, ty).and_then(|()| write_tod(line, bits as i64)),
        E::Dt | E::Ldt => write_instant(line, ty, bits as i64),
        ty if ty.is_signed_int() => write!(line, "{}", bits as i64),
        _ => write!(line, "{bits}"),
    }
}

/// Decimal exponents in this range are written out.
const PLAIN: std::ops::Range<i32> = -5..16;

/// What stands behind a whole number.
const POINT: &str = ".0";

/// With so many significant digits at most, in C that is `%.10g`.
fn write_vendor_real(line: &mut Line, value: f64, digits: usize, profile: Profile) -> fmt::Result {
    if profile == Profile::OpenPlc {
        return super::printf::write_g(line, value, 10);
    }
    let point = if profile == Profile::Codesys2 { "" } else { POINT };
    write_real(line, format_args!("{value:.*e}", digits - 1), point)
}

/// From the shortest scientific form `d.ddde-7`: `1.5`, `100.0`, `1.0E+20`.
fn write_real(line: &mut Line, scientific: fmt::Arguments, point: &str) -> fmt::Result {
    let mut shortest = Line::default();
    shortest.write_fmt(scientific)?;
    let text = shortest.bytes.get(..shortest.len).and_then(|b| std::str::from_utf8(b).ok()).unwrap_or("");
    let Some((mantissa, exponent)) = text.split_once('e') else {
        return line.write_str(if text == "inf" {
            "Inf"
        } else if text == "-inf" {
            "-Inf"
        } else {
            "NaN"
        });
    };
    let exponent: i32 = exponent.parse().unwrap_or(0);
    let (sign, mantissa) = mantissa.strip_prefix('-').map_or(("", mantissa), |m| ("-", m));
    let (first, rest) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let rest = rest.trim_end_matches('0');
    line.write_str(sign)?;
    if PLAIN.contains(&exponent) {
        write_plain(line, first, rest, exponent, point)
    } else {
        write!(line, "{first}.{}E{exponent:+}", if rest.is_empty() { "0" } else { rest })
    }
}

fn write_plain(line: &mut Line, first: &str, rest: &str, exponent: i32, point: &str) -> fmt::Result {
    let Ok(exponent) = usize::try_from(exponent) else {
        return write!(line, "0.{:0>1$}{first}{rest}", "", exponent.unsigned_abs() as usize - 1);
    };
    let (whole, fraction) = rest.split_at_checked(exponent).unwrap_or((rest, ""));
    write!(line, "{first}{whole:0<exponent$}")?;
    if fraction.is_empty() { line.write_str(point) } else { write!(line, ".{fraction}") }
}

/// Parts that are not zero.
fn write_duration(line: &mut Line, prefix: &str, ns: i64, zero: &str) -> fmt::Result {
    line.write_str(prefix)?;
    if ns == 0 {
        return line.write_str(zero);
    }
    if ns < 0 {
        line.write_str("-")?;
    }
    let mut rest = ns.unsigned_abs();
    for (unit, size) in UNITS.map(|(unit, ns)| (unit, ns as u64)) {
        if rest >= size {
            write!(line, "{}{unit}", rest / size)?;
            rest %= size;
        }
    }
    Ok(())
}

fn write_prefix(line: &mut Line, ty: E) -> fmt::Result {
    let name = match ty {
        E::Date => "D",
        E::Ldate => "LD",
        ty => ty.name(),
    };
    write!(line, "{name}#")
}

fn write_instant(line: &mut Line, ty: E, ns: i64) -> fmt::Result {
    write_prefix(line, ty)?;
    write_date(line, ns)?;
    line.write_str("-")?;
    write_tod(line, ns)
}

fn write_date(line: &mut Line, ns: i64) -> fmt::Result {
    let (year, month, day) = date_of(ns);
    write!(line, "{year:04}-{month:02}-{day:02}")
}

/// The fraction of a second with 3, 6 or 9 digits, if there is one.
fn write_tod(line: &mut Line, ns: i64) -> fmt::Result {
    let ns = time_of_day(ns);
    let (seconds, fraction) = (ns / SECOND_NS, ns % SECOND_NS);
    write!(line, "{:02}:{:02}:{:02}", seconds / 3600, seconds / 60 % 60, seconds % 60)?;
    match fraction {
        0 => Ok(()),
        f if f % 1_000_000 == 0 => write!(line, ".{:03}", f / 1_000_000),
        f if f % 1_000 == 0 => write!(line, ".{:06}", f / 1_000),
        f => write!(line, ".{f:09}"),
    }
}
