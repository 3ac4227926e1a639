//! IEC literals of numbers and strings, both ways (IEC 61131-3 reference §1.5, §1.6). Times are in [`crate::literal_time`].

/// An integer: `-5`, `1_000`, `16#FF`, `-16#FF`.
pub fn parse_int(text: &str) -> Option<i128> {
    let (negative, body) = match text.strip_prefix(['-', '+']) {
        Some(body) => (text.starts_with('-'), body),
        None => (false, text),
    };
    let value = match body.split_once('#') {
        None => digits(body)?,
        Some((base, body)) => based(base.parse().ok().filter(|b| matches!(b, 2 | 8 | 10 | 16))?, body)?,
    };
    Some(if negative { -value } else { value })
}

fn based(base: u32, body: &str) -> Option<i128> {
    let plain = !body.starts_with(['_', '+', '-']) && !body.ends_with('_');
    if plain { i128::from_str_radix(&body.replace('_', ""), base).ok() } else { None }
}

/// A real number: `1`, `1.5`, `1E3`, `-0.25e-3`, and `NaN`, `Infinity`, `-Infinity` as they are printed.
pub fn parse_real(text: &str) -> Option<f64> {
    real_text(text)?.parse().ok()
}

/// Checks the form and takes the underscores out; Rust's own parser then rounds correctly.
pub(crate) fn real_text(text: &str) -> Option<String> {
    let body = text.strip_prefix(['-', '+']).unwrap_or(text);
    let special = ["nan", "infinity", "inf"].iter().any(|s| body.eq_ignore_ascii_case(s));
    let numeric =
        body.starts_with(|c: char| c.is_ascii_digit()) && body.bytes().all(|b| b.is_ascii_digit() || b"_.eE+-".contains(&b));
    (special || numeric).then(|| text.replace('_', ""))
}

/// Shortest text that reads back as the same LREAL, with a decimal point or exponent so that it is a real literal;
/// `NaN`, `Infinity`, `-Infinity` for what is not a number.
pub fn format_lreal(v: f64) -> String {
    if v.is_finite() { format!("{v:?}") } else { not_finite(v).into() }
}

/// Shortest text that reads back as the same REAL; see [`format_lreal`].
pub fn format_real(v: f32) -> String {
    if v.is_finite() { format!("{v:?}") } else { not_finite(v.into()).into() }
}

fn not_finite(v: f64) -> &'static str {
    if v.is_nan() {
        "NaN"
    } else if v > 0.0 {
        "Infinity"
    } else {
        "-Infinity"
    }
}

/// Contents of a string literal in quotes of either kind, as code units: bytes as written in UTF-8, or UTF-16 if `wide`.
/// `None` if a quote is missing or an escape does not exist.
pub fn parse_string(text: &str, wide: bool) -> Option<Vec<u16>> {
    let quote = text.chars().next().filter(|&c| c == '\'' || c == '"')?;
    let mut rest = text.strip_prefix(quote)?.strip_suffix(quote)?.chars();
    let mut units = Vec::new();
    while let Some(c) = rest.next() {
        match c {
            '$' => units.push(escape(&mut rest, wide)?),
            c if c == quote || c.is_control() => return None,
            c if wide => units.extend(c.encode_utf16(&mut [0; 2]).iter()),
            c => units.extend(c.encode_utf8(&mut [0; 4]).bytes().map(u16::from)),
        }
    }
    Some(units)
}

/// What follows a `$`.
fn escape(rest: &mut std::str::Chars, wide: bool) -> Option<u16> {
    let unit = |c: char| c as u16;
    match rest.clone().next()?.to_ascii_uppercase() {
        c @ ('$' | '\'' | '"') => rest.next().map(|_| unit(c)),
        'L' | 'N' => rest.next().map(|_| unit('\n')),
        'P' => rest.next().map(|_| 0x0C),
        'R' => rest.next().map(|_| unit('\r')),
        'T' => rest.next().map(|_| unit('\t')),
        _ => {
            let hex: String = rest.by_ref().take(if wide { 4 } else { 2 }).collect();
            let whole = hex.len() == if wide { 4 } else { 2 } && hex.bytes().all(|b| b.is_ascii_hexdigit());
            if whole { u16::from_str_radix(&hex, 16).ok() } else { None }
        }
    }
}

/// Decimal digits, with underscores between them.
pub(crate) fn digits(text: &str) -> Option<i128> {
    let plain = !text.starts_with('_') && !text.ends_with('_') && text.bytes().all(|b| b.is_ascii_digit() || b == b'_');
    if plain { text.replace('_', "").parse().ok() } else { None }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers() {
        for (text, want) in [
            ("-5", Some(-5)),
            ("1_000", Some(1000)),
            ("16#fF", Some(255)),
            ("2#1111_0000", Some(240)),
            ("-16#1", Some(-1)),
            ("1__0", Some(10)),
            ("3#1", None),
            ("16#", None),
            ("16#-1", None),
            ("", None),
            ("_1", None),
            ("99999999999999999999999999999999999999999", None),
        ] {
            assert_eq!(parse_int(text), want, "{text}");
        }
        for (text, want) in [("1.5E3", Some(1500.0)), ("-0.25e-3", Some(-0.00025)), ("-Infinity", Some(f64::NEG_INFINITY))] {
            assert_eq!(parse_real(text), want);
        }
        assert!(["", ".5", "1..2", "0x10", "e5", "1e", "infinite"].iter().all(|t| parse_real(t).is_none()));
        assert_eq!(
            [format_real(0.1), format_lreal(1e300), format_lreal(-0.0), format_real(f32::NAN)],
            ["0.1", "1e300", "-0.0", "NaN"]
        );
    }

    #[test]
    fn strings() {
        let narrow = |t| parse_string(t, false).map(|u| u.iter().map(|&u| u as u8).collect::<Vec<_>>());
        assert_eq!(narrow("'it$'s $24 $N'"), Some(b"it's $ \n".to_vec()));
        assert_eq!(narrow("'ä'"), Some("ä".into()));
        assert_eq!(parse_string("\"$20AC€\"", true), Some(vec![0x20AC, 0x20AC]));
        for bad in ["abc", "'abc", "'", "'a'b'", "'$x'", "'$2'", "'$é9'", "'a\nb'"] {
            assert_eq!(parse_string(bad, false), None, "{bad}");
        }
    }
}
