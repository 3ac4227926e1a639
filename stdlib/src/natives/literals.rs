//! Literals of integers, durations and dates, read from bytes without allocation. From: language reference §1.5, §1.7.
//! Runs: cyclic.

use crate::calendar::{SECOND_NS, date_ns, tod_ns};
use takt_image::literal_time::UNITS;

/// A place in a text.
pub(super) struct Cursor<'a> {
    rest: &'a [u8],
}

impl<'a> Cursor<'a> {
    pub fn new(text: &'a [u8]) -> Self {
        Self { rest: text }
    }
    pub fn at_end(&self) -> bool {
        self.rest.is_empty()
    }
    pub fn eat(&mut self, byte: u8) -> bool {
        self.eat_any(&[byte]).is_some()
    }
    /// One of these bytes.
    pub fn eat_any(&mut self, bytes: &[u8]) -> Option<u8> {
        let (&first, rest) = self.rest.split_first()?;
        bytes.contains(&first).then(|| {
            self.rest = rest;
            first
        })
    }
    /// This word in any case.
    pub fn eat_word(&mut self, word: &str) -> bool {
        let Some((head, rest)) = self.rest.split_at_checked(word.len()) else { return false };
        let found = head.eq_ignore_ascii_case(word.as_bytes());
        if found {
            self.rest = rest;
        }
        found
    }
    /// At least one digit of the base; single underscores may stand between digits.
    pub fn digits(&mut self, base: u32, mut each: impl FnMut(u8)) -> Option<()> {
        let digit = |b: Option<&u8>| b.copied().filter(|&b| char::from(b).is_digit(base));
        each(digit(self.rest.first())?);
        self.rest = &self.rest[1..];
        loop {
            let skip = usize::from(self.rest.first() == Some(&b'_'));
            let Some(next) = digit(self.rest.get(skip)) else { return Some(()) };
            each(next);
            self.rest = self.rest.get(skip + 1..)?;
        }
    }
    /// Digits as a number; saturates.
    fn number(&mut self, base: u32) -> Option<i128> {
        let mut n = 0i128;
        self.digits(base, |d| {
            let d = char::from(d).to_digit(base).unwrap_or(0);
            n = n.saturating_mul(base.into()).saturating_add(d.into());
        })?;
        Some(n)
    }
    /// Letters, at most three.
    fn word(&mut self) -> &'a [u8] {
        let len = self.rest.iter().take(3).take_while(|b| b.is_ascii_alphabetic()).count();
        let (word, rest) = self.rest.split_at(len);
        self.rest = rest;
        word
    }
}

/// `-12`, `123_456`, `16#FF`, `2#1010`, `8#17`; a based literal has no sign.
pub(super) fn integer(cursor: &mut Cursor) -> Option<i128> {
    let sign = cursor.eat_any(b"+-");
    let n = cursor.number(10)?;
    if !cursor.eat(b'#') {
        return Some(if sign == Some(b'-') { -n } else { n });
    }
    match (sign, n) {
        (None, 2 | 8 | 16) => cursor.number(n as u32),
        _ => None,
    }
}

/// `1d2h`, `-5ms`, `1h_30m`, `14.7h`, `0`, in nanoseconds, ties to even; saturates. Units descend, the last may have a fraction.
pub(super) fn duration(cursor: &mut Cursor) -> Option<i64> {
    let negative = cursor.eat_any(b"+-") == Some(b'-');
    let mut units = UNITS.as_slice();
    let mut total = 0i128;
    loop {
        let whole = cursor.number(10)?;
        let fraction = if cursor.eat(b'.') { Some(Fraction::read(cursor)?) } else { None };
        let word = cursor.word();
        if word.is_empty() && whole == 0 && total == 0 && fraction.is_none() && cursor.at_end() {
            return Some(0);
        }
        let at = units.iter().position(|(name, _)| name.as_bytes().eq_ignore_ascii_case(word))?;
        let size = i128::from(units[at].1);
        units = &units[at + 1..];
        total = total.saturating_add(whole.saturating_mul(size));
        if let Some(fraction) = fraction {
            total = fraction.add_to(total, size);
        }
        if cursor.at_end() || fraction.is_some() {
            break;
        }
        cursor.eat(b'_');
    }
    let ns = if negative { -total } else { total };
    Some(ns.clamp(i64::MIN.into(), i64::MAX.into()) as i64)
}

/// Digits behind the point: `digits / scale`, and whether something not zero was cut off.
#[derive(Clone, Copy)]
struct Fraction {
    digits: i128,
    scale: i128,
    more: bool,
}

impl Fraction {
    /// Of the digits, 18 are kept exactly.
    const SCALE_MAX: i128 = 1_000_000_000_000_000_000;

    fn read(cursor: &mut Cursor) -> Option<Self> {
        let mut f = Fraction { digits: 0, scale: 1, more: false };
        cursor.digits(10, |d| {
            let d = i128::from(d - b'0');
            if f.scale < Self::SCALE_MAX {
                f.digits = f.digits * 10 + d;
                f.scale *= 10;
            } else {
                f.more |= d != 0;
            }
        })?;
        Some(f)
    }

    /// `total + self * size`, to the nearest integer, ties to even.
    fn add_to(self, total: i128, size: i128) -> i128 {
        let (quotient, rest) = (self.digits * size / self.scale, self.digits * size % self.scale);
        let down = total.saturating_add(quotient);
        let up = match (2 * rest).cmp(&self.scale) {
            std::cmp::Ordering::Less => false,
            std::cmp::Ordering::Greater => true,
            std::cmp::Ordering::Equal => self.more || down % 2 != 0,
        };
        down.saturating_add(i128::from(up))
    }
}

/// `2024-02-29` in nanoseconds since 1970-01-01.
pub(super) fn date(cursor: &mut Cursor) -> Option<i64> {
    let year = part(cursor)?;
    let month = if cursor.eat(b'-') { part(cursor)? } else { return None };
    let day = if cursor.eat(b'-') { part(cursor)? } else { return None };
    date_ns(year, month, day)
}

/// `07:05:03.250` or `07:05` in nanoseconds since midnight; what is below a nanosecond is dropped.
pub(super) fn tod(cursor: &mut Cursor) -> Option<i64> {
    let hour = part(cursor)?;
    let minute = if cursor.eat(b':') { part(cursor)? } else { return None };
    let second = if cursor.eat(b':') { part(cursor)? } else { 0 };
    let fraction = if cursor.eat(b'.') { Fraction::read(cursor)? } else { Fraction { digits: 0, scale: 1, more: false } };
    tod_ns(hour, minute, second, (fraction.digits * i128::from(SECOND_NS) / fraction.scale) as i64)
}

/// `2024-02-29-07:05:03` in nanoseconds since 1970-01-01.
pub(super) fn instant(cursor: &mut Cursor) -> Option<i64> {
    let date = date(cursor)?;
    if !cursor.eat(b'-') {
        return None;
    }
    date.checked_add(tod(cursor)?)
}

fn part(cursor: &mut Cursor) -> Option<i64> {
    i64::try_from(cursor.number(10)?).ok()
}
