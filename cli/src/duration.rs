//! Durations as a person writes them: `10ms`, `1s500ms`, `2.5s`, `T#10ms`.

use takt_base::Nanos;

/// Units, longest name first so that `ms` is not read as `m`.
const UNITS: &[(&str, f64)] =
    &[("ms", 1e6), ("us", 1e3), ("µs", 1e3), ("ns", 1.0), ("d", 86_400e9), ("h", 3_600e9), ("m", 60e9), ("s", 1e9)];

/// Parses a duration; `None` if it is not one or is negative or longer than 292 years.
pub fn parse(text: &str) -> Option<Nanos> {
    let lower = text.trim().to_ascii_lowercase();
    let mut rest = ["time#", "t#"].iter().find_map(|p| lower.strip_prefix(p)).unwrap_or(&lower);
    let mut total = 0.0;
    if rest.is_empty() {
        return None;
    }
    while !rest.is_empty() {
        rest = rest.trim_start_matches('_');
        let digits = rest.find(|c: char| !c.is_ascii_digit() && c != '.')?;
        let number: f64 = rest[..digits].parse().ok()?;
        let (unit, factor) = UNITS.iter().find(|(unit, _)| rest[digits..].starts_with(unit))?;
        total += number * factor;
        rest = &rest[digits + unit.len()..];
    }
    (total < 9.2e18).then(|| Nanos(total.round() as i64))
}

/// For clap: parses or says what is wanted.
pub fn argument(text: &str) -> Result<Nanos, String> {
    parse(text).ok_or_else(|| "write a duration such as 500ms, 2s or 1m30s".to_owned())
}

/// Short form for a report: three significant digits and a fitting unit.
pub fn show(t: Nanos) -> String {
    let (value, unit) = match t.0.unsigned_abs() {
        0..1_000 => (t.0 as f64, "ns"),
        1_000..1_000_000 => (t.0 as f64 / 1e3, "µs"),
        1_000_000..1_000_000_000 => (t.0 as f64 / 1e6, "ms"),
        _ => (t.0 as f64 / 1e9, "s"),
    };
    let digits = if value.abs() >= 100.0 || unit == "ns" {
        0
    } else if value.abs() >= 10.0 {
        1
    } else {
        2
    };
    format!("{value:.digits$} {unit}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn forms() {
        for (text, want) in [
            ("10ms", Some(10_000_000)),
            ("1s500ms", Some(1_500_000_000)),
            ("T#2.5s", Some(2_500_000_000)),
            ("1m30s", Some(90_000_000_000)),
            ("100us", Some(100_000)),
            ("", None),
            ("5", None),
            ("-1s", None),
            ("1x", None),
            ("99999999999d", None),
        ] {
            assert_eq!(parse(text).map(|n| n.0), want, "{text}");
        }
        assert_eq!([show(Nanos(950)), show(Nanos(12_340)), show(Nanos(2_000_000_000))], ["950 ns", "12.3 µs", "2.00 s"]);
    }
}
