//! IEC literals of durations, dates and times of day, both ways (IEC 61131-3 reference §1.7).
//! All times are i64 nanoseconds; dates count from 1970-01-01 (§16), without zones or leap seconds.

use crate::Elementary as E;
use crate::literal::digits;

const SECOND: i64 = 1_000_000_000;
const DAY: i64 = 86_400 * SECOND;
/// Units of a duration in descending order, in nanoseconds.
pub const UNITS: [(&str, i64); 7] =
    [("d", DAY), ("h", 3600 * SECOND), ("m", 60 * SECOND), ("s", SECOND), ("ms", 1_000_000), ("us", 1_000), ("ns", 1)];

/// The shortest literal of a time or date: `T#1s500ms`, `D#2024-02-29`, `TOD#07:05:03.25`, `DT#2024-02-29-07:05:03`.
/// `None` for a type that is neither.
pub fn format_time(ty: E, ns: i64) -> Option<String> {
    Some(match ty {
        E::Time => format!("T#{}", format_duration(ns)),
        E::Ltime => format!("LT#{}", format_duration(ns)),
        E::Date => format!("D#{}", date(ns)),
        E::Ldate => format!("LD#{}", date(ns)),
        E::Tod => format!("TOD#{}", time_of_day(ns.rem_euclid(DAY))),
        E::Ltod => format!("LTOD#{}", time_of_day(ns.rem_euclid(DAY))),
        E::Dt => format!("DT#{}-{}", date(ns), time_of_day(ns.rem_euclid(DAY))),
        E::Ldt => format!("LDT#{}-{}", date(ns), time_of_day(ns.rem_euclid(DAY))),
        _ => return None,
    })
}

/// A duration without its prefix, `-1h30m`; parts that are zero are left out.
pub fn format_duration(ns: i64) -> String {
    let mut rest = ns.unsigned_abs();
    let mut text = String::from(if ns < 0 { "-" } else { "" });
    for (unit, size) in UNITS {
        let n = rest / size as u64;
        rest %= size as u64;
        if n > 0 {
            text += &format!("{n}{unit}");
        }
    }
    if ns == 0 { "0s".into() } else { text }
}

fn date(ns: i64) -> String {
    let (y, m, d) = civil(ns.div_euclid(DAY));
    format!("{y:04}-{m:02}-{d:02}")
}

fn time_of_day(ns: i64) -> String {
    let (s, fraction) = (ns / SECOND, ns % SECOND);
    let clock = format!("{:02}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60);
    if fraction == 0 { clock } else { format!("{clock}.{}", format!("{fraction:09}").trim_end_matches('0')) }
}

/// Year, month and day of a day number from 1970-01-01, in the proleptic Gregorian calendar. Years begin in March here, so that the
/// leap day comes last; 146,097 days are 400 years.
pub fn civil(days: i64) -> (i64, i64, i64) {
    let z = days + 719_468;
    let era = z.div_euclid(146_097);
    let doe = z.rem_euclid(146_097);
    let yoe = (doe - doe / 1460 + doe / 36_524 - doe / 146_096) / 365;
    let doy = doe - (365 * yoe + yoe / 4 - yoe / 100);
    let mp = (5 * doy + 2) / 153;
    let month = if mp < 10 { mp + 3 } else { mp - 9 };
    (yoe + era * 400 + i64::from(month <= 2), month, doy - (153 * mp + 2) / 5 + 1)
}

/// The day number of a date, if there is such a day; years 1 to 9999.
pub fn day_number(y: i64, m: i64, d: i64) -> Option<i64> {
    if !(1..=9999).contains(&y) || !(1..=12).contains(&m) || !(1..=31).contains(&d) {
        return None;
    }
    let (shifted, mp) = (y - i64::from(m <= 2), (m + 9) % 12);
    let (era, yoe) = (shifted.div_euclid(400), shifted.rem_euclid(400));
    let doe = yoe * 365 + yoe / 4 - yoe / 100 + (153 * mp + 2) / 5 + d - 1;
    let days = era * 146_097 + doe - 719_468;
    (civil(days) == (y, m, d)).then_some(days)
}

/// A time or date from text, with any prefix of its family (`T#`, `TIME#`, `LTIME#`; a duration may go without).
/// `None` if it is malformed or out of range.
pub fn parse_time(ty: E, text: &str) -> Option<i64> {
    let (prefix, body) = match text.split_once('#') {
        Some((p, b)) => (Some(family(p.trim())?), b.trim()),
        None => (None, text.trim()),
    };
    let wanted = family(ty.name())?;
    if prefix.unwrap_or(Family::Duration) != wanted {
        return None;
    }
    match wanted {
        Family::Duration => parse_duration(body),
        Family::Date => parse_date(body)?.checked_mul(DAY),
        Family::Tod => parse_tod(body),
        Family::Dt => {
            let (day, clock) = body.rsplit_once('-')?;
            parse_date(day)?.checked_mul(DAY)?.checked_add(parse_tod(clock)?)
        }
    }
}

#[derive(Clone, Copy, PartialEq)]
enum Family {
    Duration,
    Date,
    Tod,
    Dt,
}

fn family(prefix: &str) -> Option<Family> {
    let ty = match prefix.to_ascii_uppercase().as_str() {
        "T" | "LT" => E::Time,
        "D" | "LD" => E::Date,
        _ => E::from_name(prefix)?,
    };
    Some(match ty {
        E::Time | E::Ltime => Family::Duration,
        E::Date | E::Ldate => Family::Date,
        E::Tod | E::Ltod => Family::Tod,
        E::Dt | E::Ldt => Family::Dt,
        _ => return None,
    })
}

/// A duration without its prefix, `1h_30m`, `-14.7ms`: units in descending order, a fraction in the last part alone, rounded
/// half to even at the nanosecond.
pub fn parse_duration(text: &str) -> Option<i64> {
    let (negative, mut rest) = match text.strip_prefix(['-', '+']) {
        Some(body) => (text.starts_with('-'), body),
        None => (false, text),
    };
    let (mut sum, mut next_unit) = (0i128, 0);
    while !rest.is_empty() || next_unit == 0 {
        let digits = rest.find(|c: char| c.is_ascii_alphabetic()).unwrap_or(rest.len());
        let letters = rest[digits..].find(|c: char| !c.is_ascii_alphabetic()).unwrap_or(rest.len() - digits);
        let (number, unit) = (&rest[..digits], &rest[digits..digits + letters]);
        rest = rest[digits + letters..].strip_prefix('_').unwrap_or(&rest[digits + letters..]);
        let i = UNITS.iter().position(|(name, _)| name.eq_ignore_ascii_case(unit)).filter(|&i| i >= next_unit)?;
        if number.contains('.') && !rest.is_empty() {
            return None;
        }
        sum = sum.checked_add(scaled(number, UNITS[i].1)?)?;
        next_unit = i + 1;
    }
    i64::try_from(if negative { -sum } else { sum }).ok()
}

/// A decimal number without sign times `unit`, rounded half to even.
fn scaled(number: &str, unit: i64) -> Option<i128> {
    let (whole, fraction) = number.split_once('.').unwrap_or((number, "0"));
    let whole = digits(whole)?.checked_mul(unit as i128)?;
    let fraction = fraction.replace('_', "");
    if fraction.is_empty() || fraction.len() > 18 {
        return None;
    }
    let (top, bottom) = (digits(&fraction)? * unit as i128, 10i128.pow(fraction.len() as u32));
    let (quotient, twice) = (top / bottom, 2 * (top % bottom));
    let down = whole.checked_add(quotient)?;
    down.checked_add(i128::from(twice > bottom || (twice == bottom && down % 2 == 1)))
}

fn parse_date(text: &str) -> Option<i64> {
    let mut parts = text.split('-').map(|p| digits(p).and_then(|n| i64::try_from(n).ok()));
    let (y, m, d) = (parts.next()??, parts.next()??, parts.next()??);
    if parts.next().is_some() { None } else { day_number(y, m, d) }
}

fn parse_tod(text: &str) -> Option<i64> {
    let (clock, seconds) = match text.split(':').count() {
        2 => (text, "0"),
        3 => text.rsplit_once(':')?,
        _ => return None,
    };
    let (h, m) = clock.split_once(':')?;
    let (h, m, s) = (digits(h)?, digits(m)?, scaled(seconds, SECOND)?);
    let fits = h < 24 && m < 60 && s < 60 * SECOND as i128;
    if fits { i64::try_from((h * 60 + m) * 60 * SECOND as i128 + s).ok() } else { None }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// IEC reference §1.7.
    #[test]
    fn durations() {
        for (text, ns, shortest) in [
            ("T#14ms", 14_000_000, "T#14ms"),
            ("t#-14MS", -14_000_000, "T#-14ms"),
            ("T#14.7h", 52_920 * SECOND, "T#14h42m"),
            ("TIME#5d_14h_12m_18s_3.5ms", 483_138 * SECOND + 3_500_000, "T#5d14h12m18s3ms500us"),
            ("T#25h_15m", 90_900 * SECOND, "T#1d1h15m"),
            ("LTIME#1ns", 1, "T#1ns"),
            ("1s500ms", 1_500_000_000, "T#1s500ms"),
            ("T#0.5ns", 0, "T#0s"),
            ("T#1.5ns", 2, "T#2ns"),
        ] {
            assert_eq!(parse_time(E::Time, text), Some(ns), "{text}");
            assert_eq!(format_time(E::Time, ns).as_deref(), Some(shortest));
        }
        for text in ["T#", "T#5", "T#1ms1s", "T#1.5s1ms", "T#1s1s", "T#1x", "D#1s", "T#300000000d", "T#--1s", "T#1_s", "T#é"] {
            assert_eq!(parse_time(E::Time, text), None, "{text}");
        }
        for ns in [i64::MIN, i64::MAX, -1] {
            assert_eq!(parse_duration(&format_duration(ns)), Some(ns));
        }
    }

    #[test]
    fn dates_and_times_of_day() {
        for (ty, text, ns, shortest) in [
            (E::Date, "D#2024-2-29", 19_782 * DAY, "D#2024-02-29"),
            (E::Ldate, "DATE#1969-12-31", -DAY, "LD#1969-12-31"),
            (E::Tod, "TIME_OF_DAY#7:5:3.25", 25_503 * SECOND + 250_000_000, "TOD#07:05:03.25"),
            (E::Ltod, "TOD#12:00", 43_200 * SECOND, "LTOD#12:00:00"),
            (E::Dt, "DT#1984-06-25-15:36:55.36", 457_025_815 * SECOND + 360_000_000, "DT#1984-06-25-15:36:55.36"),
            (E::Ldt, "LDT#1969-12-31-23:59:59.999999999", -1, "LDT#1969-12-31-23:59:59.999999999"),
        ] {
            assert_eq!(parse_time(ty, text), Some(ns), "{text}");
            assert_eq!(format_time(ty, ns).as_deref(), Some(shortest));
        }
        for (ty, text) in [
            (E::Date, "D#2023-02-29"),
            (E::Date, "D#2024-13-01"),
            (E::Date, "D#9999-01-01"),
            (E::Date, "2024-02-01"),
            (E::Tod, "TOD#24:00:00"),
            (E::Tod, "TOD#1:2:3:4"),
            (E::Tod, "TOD#1:2:60"),
            (E::Dt, "DT#2024-02-29"),
            (E::Int, "T#1s"),
        ] {
            assert_eq!(parse_time(ty, text), None, "{text}");
        }
        for days in -106_000..106_000 {
            let (y, m, d) = civil(days);
            assert_eq!(day_number(y, m, d), Some(days));
        }
    }
}
