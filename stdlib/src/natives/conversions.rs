//! Which conversions are natives, and their code.
//!
//! The compiler does these inline: between integers, reals, bit strings and BOOL; between characters and bit strings, CHAR to WCHAR;
//! anything to itself; short to long forms of time types and back, DATE to DT (the nanoseconds are the same); everything to BOOL (not
//! zero); LTIME, LDATE, LTOD, LDT as a number of nanoseconds. The rest of §2.1 is native: strings, WCHAR to CHAR, parts of an instant,
//! and TIME, TOD, DATE, DT as numbers (row g).

use super::{Native, Run, Types, from_string, numbers, push, result, text, to_string};
use crate::catalog::Pattern;
use crate::lookup::{ConversionType, Found, converts, lookup};
use takt_base::Profile;
use takt_image::{Elementary as E, Generic};

/// Name of the native that converts; `None` if the compiler does it inline or there is no such conversion.
pub fn native_conversion(from: ConversionType, to: ConversionType) -> Option<String> {
    run(from, to).map(|_| format!("{}_TO_{}", from.name(), to.name()))
}

/// The same for a file of a profile.
pub fn native_conversion_in(profile: Profile, from: ConversionType, to: ConversionType) -> Option<String> {
    let name = native_conversion(from, to)?;
    Some(if differs(profile, from, to) { format!("{name}_{}", profile.name().to_ascii_uppercase()) } else { name })
}

/// True if a vendor converts in another way than the standard (§2.1 row g, §2.3, §2.4).
fn differs(profile: Profile, from: ConversionType, to: ConversionType) -> bool {
    use ConversionType::Elementary as Of;
    let bits = |e: E| e.is_bit() && e != E::Bool;
    match (profile, from, to) {
        (Profile::Std, _, _) => false,
        (Profile::Codesys | Profile::Codesys2, Of(from), to) if to.is_string() => bits(from) || from.is_real() || from == E::Time,
        (Profile::Codesys | Profile::Codesys2, from, Of(to)) => from.is_string() && !to.is_char(),
        (Profile::OpenPlc, Of(from), to) if to.is_string() => bits(from) || from.is_real(),
        (Profile::OpenPlc, Of(from), Of(to)) => [from, to].iter().any(|e| matches!(e, E::Time | E::Tod)),
        _ => false,
    }
}

/// The native of a conversion.
pub(super) fn find(name: &str) -> Option<Native> {
    let suffix = |p: &Profile| name.strip_suffix(&p.name().to_ascii_uppercase())?.strip_suffix('_').map(|plain| (*p, plain));
    let (profile, name) = Profile::ALL.iter().skip(1).find_map(suffix).unwrap_or((Profile::Std, name));
    let Found::Conversion { from: Some(from), to, truncate: false } = lookup(name)? else { return None };
    let known = profile == Profile::Std || differs(profile, from, to);
    let run = run(from, to).filter(|_| known && native_conversion(from, to).as_deref() == Some(name))?;
    let t = Pattern::T(Generic::Any);
    let mut params = Vec::new();
    push(&mut params, t, from);
    let result = result(&mut params, t, to);
    Some(Native { params, result, extensible: false, run, types: Types { from, to, profile } })
}

fn run(from: ConversionType, to: ConversionType) -> Option<Run> {
    use ConversionType::Elementary as Of;
    if from == to || !converts(from, to) {
        return None;
    }
    match (from, to) {
        (Of(from), Of(to)) => between_scalars(from, to),
        (Of(from), _) if from.is_char() => Some(text::char_to_string),
        (Of(_), _) => Some(to_string::to_string),
        (_, Of(to)) if to.is_char() => Some(text::string_to_char),
        (_, Of(_)) => Some(from_string::from_string),
        _ => Some(text::string_to_string),
    }
}

fn between_scalars(from: E, to: E) -> Option<Run> {
    match (from, to) {
        (E::Wchar, E::Char) => Some(text::wchar_to_char),
        (E::Dt | E::Ldt, E::Date | E::Ldate) => Some(numbers::instant_to_date),
        (E::Dt | E::Ldt, E::Tod | E::Ltod) => Some(numbers::instant_to_tod),
        (_, E::Bool) => None,
        (from, to) if is_time(from) && is_time(to) => None,
        (from, to) if numbers::unit(from).is_some() && to.is_real() => Some(numbers::time_to_real),
        (from, _) if numbers::unit(from).is_some() => Some(numbers::time_to_int),
        (from, to) if numbers::unit(to).is_some() && from.is_real() => Some(numbers::real_to_time),
        (_, to) if numbers::unit(to).is_some() => Some(numbers::int_to_time),
        _ => None,
    }
}

fn is_time(ty: E) -> bool {
    ty.is_duration() || ty.is_date()
}
