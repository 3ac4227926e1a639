//! Durations, dates and times of day, exact to the nanosecond: no floating point.
//! From: IEC 61131-3 §6.3.4, §6.3.5 (language reference §1.7).

use super::{Problem, Read, Value};
use crate::syntax::ast::Literal;
use takt_base::diag::Code;
use takt_image::Elementary;

const SECOND: i128 = 1_000_000_000;
const DAY: i128 = 86_400 * SECOND;

/// Units in descending order: name, nanoseconds, and how many make the next larger one.
const UNITS: [(&str, i128, i128); 7] = [
    ("d", DAY, i128::MAX),
    ("h", 3600 * SECOND, 24),
    ("m", 60 * SECOND, 60),
    ("s", SECOND, 60),
    ("ms", 1_000_000, 1000),
    ("us", 1000, 1000),
    ("ns", 1, 1000),
];

/// `T#1h_30.5m`, with its prefix.
pub(crate) fn duration(token: &str) -> Read {
    let (prefix, body) = token.split_once('#').unwrap_or((token, ""));
    let ty = if prefix.starts_with(['l', 'L']) { Elementary::Ltime } else { Elementary::Time };
    let negative = body.starts_with('-');
    let body = body.strip_prefix(['+', '-']).unwrap_or(body);
    if body.is_empty() {
        return Err(bad("no duration behind the #").help("write it with units, for example T#1h30m or T#250ms"));
    }
    let (nanos, warning) = if body.bytes().all(|b| b == b'0') {
        (0, Some(bad("a duration without a unit").help("write T#0s")))
    } else {
        parts(body)?
    };
    let nanos = i64::try_from(if negative { -nanos } else { nanos })
        .map_err(|_| bad("longer than the longest duration").help("the longest duration is about 292 years"))?;
    Ok(Value { literal: Literal::Time { ty, nanos }, warning })
}

/// Sum of all parts, in nanoseconds, and what is unusual.
fn parts(body: &str) -> Result<(i128, Option<Problem>), Problem> {
    let mut rest = body;
    let (mut sum, mut next_unit, mut warning) = (0i128, 0usize, None);
    while !rest.is_empty() {
        let part = Part::read(rest)?;
        let Some(i) = UNITS.iter().position(|u| u.0.eq_ignore_ascii_case(part.unit)) else {
            return Err(no_unit(part.unit, part.number));
        };
        if i < next_unit {
            return Err(bad(format!("the part in {} is out of order", part.unit)).help("the order is d h m s ms us ns"));
        }
        if part.number.contains('.') && !part.rest.is_empty() {
            return Err(bad("only the last part may have a fraction").help("write the fraction as a part in a smaller unit"));
        }
        let (nanos, exact) = scale(part.number, UNITS[i].1)?;
        if next_unit > 0 && nanos >= UNITS[i].2.saturating_mul(UNITS[i].1) {
            warning = Some(bad(format!("{}{} is more than the next larger unit", part.number, part.unit)));
        }
        if !exact {
            warning = Some(bad("finer than a nanosecond").help("it is rounded to the nearest nanosecond"));
        }
        sum = sum.saturating_add(nanos);
        next_unit = i + 1;
        rest = part.rest;
    }
    Ok((sum, warning))
}

/// A number with its unit at the front of `rest`.
struct Part<'a> {
    number: &'a str,
    unit: &'a str,
    /// Behind it and behind an underscore.
    rest: &'a str,
}

impl<'a> Part<'a> {
    fn read(text: &'a str) -> Result<Self, Problem> {
        let n = text.find(|c: char| c.is_ascii_alphabetic()).unwrap_or(text.len());
        let (number, rest) = text.split_at(n);
        let u = rest.find(|c: char| !c.is_ascii_alphabetic()).unwrap_or(rest.len());
        let (unit, rest) = rest.split_at(u);
        if number.is_empty() {
            return Err(bad(format!("no number before {unit}")));
        }
        let rest = match rest.strip_prefix('_') {
            Some("") => return Err(bad("nothing behind the last underscore")),
            Some(rest) => rest,
            None => rest,
        };
        Ok(Self { number, unit, rest })
    }
}

fn no_unit(unit: &str, number: &str) -> Problem {
    if unit.is_empty() {
        return bad(format!("{number} has no unit"))
            .help(format!("write T#{number}ms, T#{number}s, T#{number}m, T#{number}h or T#{number}d"));
    }
    bad(format!("no unit is called {unit}")).help("the units are d h m s ms us ns")
}

/// `number` (digits, underscores, at most one point) times `unit`, rounded half to even; false if it had to be rounded.
fn scale(number: &str, unit: i128) -> Result<(i128, bool), Problem> {
    let (whole, fraction) = number.split_once('.').unwrap_or((number, "0"));
    let well_formed = |d: &str| {
        d.starts_with(|c: char| c.is_ascii_digit())
            && d.ends_with(|c: char| c.is_ascii_digit())
            && !d.contains("__")
            && d.bytes().all(|b| b == b'_' || b.is_ascii_digit())
    };
    if !well_formed(whole) || !well_formed(fraction) {
        return Err(bad(format!("{number} is not a number")));
    }
    let nanos = digits(whole).and_then(|w| w.checked_mul(unit)).ok_or_else(|| bad("longer than the longest duration"))?;
    let (part, exact) = fraction_of(fraction, unit, nanos % 2 != 0);
    Ok((nanos.saturating_add(part), exact))
}

/// `0.fraction * unit`, rounded half to even; `odd`: what it is added to is odd.
fn fraction_of(fraction: &str, unit: i128, odd: bool) -> (i128, bool) {
    let (mut numerator, mut denominator, mut rest_is_zero) = (0i128, 1i128, true);
    for (i, d) in fraction.bytes().filter(u8::is_ascii_digit).enumerate() {
        let d = i128::from(d - b'0');
        if i < 22 {
            numerator = numerator * 10 + d;
            denominator *= 10;
        } else {
            rest_is_zero &= d == 0;
        }
    }
    let product = numerator * unit; // below 10^22 * 8.64 * 10^13: fits
    let (quotient, remainder) = (product / denominator, product % denominator);
    let half = (remainder * 2).cmp(&denominator);
    let up = half.is_gt() || half.is_eq() && (!rest_is_zero || (quotient % 2 == 1) != odd);
    (quotient + i128::from(up), remainder == 0 && rest_is_zero)
}

/// `D#2024-02-29`, `TOD#12:30:00.5`, `DT#2024-02-29-12:30:00`, with their prefixes.
pub(crate) fn date(token: &str) -> Read {
    let (prefix, body) = token.split_once('#').unwrap_or((token, ""));
    let ty = match prefix.to_ascii_uppercase().as_str() {
        "D" => Elementary::Date,
        "LD" => Elementary::Ldate,
        other => Elementary::from_name(other).ok_or_else(|| bad("not a prefix of a date"))?,
    };
    let (nanos, warning) = match ty {
        Elementary::Date | Elementary::Ldate => (day(body)?, None),
        Elementary::Tod | Elementary::Ltod => time_of_day(body)?,
        _ => {
            let cut = body.match_indices('-').nth(2).map(|(i, _)| i);
            let cut = cut.ok_or_else(|| bad("a date and a time of day are needed").help(form(ty)))?;
            let (time, warning) = time_of_day(&body[cut + 1..])?;
            (day(&body[..cut])? + time, warning)
        }
    };
    let nanos = i64::try_from(nanos).map_err(|_| bad("outside of the years 1677 to 2262"))?;
    Ok(Value { literal: Literal::Time { ty, nanos }, warning })
}

fn form(ty: Elementary) -> &'static str {
    match ty {
        Elementary::Date | Elementary::Ldate => "the form is D#yyyy-mm-dd",
        Elementary::Tod | Elementary::Ltod => "the form is TOD#hh:mm:ss.fraction",
        _ => "the form is DT#yyyy-mm-dd-hh:mm:ss.fraction",
    }
}

/// Nanoseconds from 1970-01-01 to the start of `yyyy-mm-dd`.
fn day(text: &str) -> Result<i128, Problem> {
    let fields: Vec<&str> = text.split('-').collect();
    let [year, month, day] = fields[..] else { return Err(bad("not a date").help(form(Elementary::Date))) };
    let year = field(year, 1, 9999, "year")?;
    let month = field(month, 1, 12, "month")?;
    let day = field(day, 1, days_in(year, month), "day")?;
    Ok(days_from_epoch(year, month, day) * DAY)
}

/// Nanoseconds since midnight of `hh:mm:ss[.fraction]`; seconds may be left out, with a warning.
fn time_of_day(text: &str) -> Result<(i128, Option<Problem>), Problem> {
    let fields: Vec<&str> = text.split(':').collect();
    let (hour, minute, second) = match fields[..] {
        [h, m, s] => (h, m, Some(s)),
        [h, m] => (h, m, None),
        _ => return Err(bad("not a time of day").help(form(Elementary::Tod))),
    };
    let minutes = field(hour, 0, 23, "hour")? * 60 + field(minute, 0, 59, "minute")?;
    let Some(second) = second else {
        let warning = bad("the seconds are missing").help(format!("write {text}:00"));
        return Ok((minutes * 60 * SECOND, Some(warning)));
    };
    let (nanos, exact) = scale(second, SECOND)?;
    if nanos >= 60 * SECOND {
        return Err(bad("the second is not below 60"));
    }
    let warning = (!exact).then(|| bad("finer than a nanosecond").help("it is rounded to the nearest nanosecond"));
    Ok((minutes * 60 * SECOND + nanos, warning))
}

fn field(text: &str, low: i128, high: i128, name: &str) -> Result<i128, Problem> {
    let value = (!text.is_empty() && text.bytes().all(|b| b.is_ascii_digit())).then(|| digits(text)).flatten();
    match value {
        None => Err(bad(format!("the {name} is not a number"))),
        Some(v) if v < low || v > high => Err(bad(format!("the {name} is not in {low} to {high}"))),
        Some(v) => Ok(v),
    }
}

fn digits(text: &str) -> Option<i128> {
    text.bytes().filter(u8::is_ascii_digit).try_fold(0i128, |v, b| v.checked_mul(10)?.checked_add(i128::from(b - b'0')))
}

fn days_in(year: i128, month: i128) -> i128 {
    match month {
        4 | 6 | 9 | 11 => 30,
        2 if year % 4 == 0 && (year % 100 != 0 || year % 400 == 0) => 29,
        2 => 28,
        _ => 31,
    }
}

/// Days from 1970-01-01 in the proleptic Gregorian calendar; years begin in March so that the leap day comes last.
fn days_from_epoch(year: i128, month: i128, day: i128) -> i128 {
    let year = if month <= 2 { year - 1 } else { year };
    let (era, of_era) = (year.div_euclid(400), year.rem_euclid(400));
    let day_of_year = (153 * ((month + 9) % 12) + 2) / 5 + day - 1;
    era * 146_097 + of_era * 365 + of_era / 4 - of_era / 100 + day_of_year - 719_468
}

fn bad(label: impl Into<String>) -> Problem {
    Problem::new(Code::BadTime, label)
}
