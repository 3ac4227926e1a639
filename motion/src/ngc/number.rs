//! Numbers of RS274/NGC: sign, digits, one point, and blanks anywhere between. By hand, since `nom`'s `double` would also take
//! `1E2`, `inf` and `nan`.

/// Largest magnitude that a word may have; keeps all sums and squares finite.
pub const MAX: f64 = 1e12;

/// Value and length in bytes of the number at the start of `text`; `None` if there is no digit or the value is above [`MAX`].
pub fn scan(text: &str) -> Option<(f64, usize)> {
    let end = extent(text.as_bytes())?;
    let digits = &text[..end];
    let value: f64 = if digits.contains([' ', '\t']) {
        digits.chars().filter(|c| !matches!(c, ' ' | '\t')).collect::<String>().parse().ok()?
    } else {
        digits.parse().ok()?
    };
    (value.abs() <= MAX).then_some((value, end))
}

/// One past the last digit or point.
fn extent(bytes: &[u8]) -> Option<usize> {
    let (mut end, mut digit, mut point) = (0, false, false);
    for (i, byte) in bytes.iter().enumerate() {
        match byte {
            b' ' | b'\t' => continue,
            b'0'..=b'9' => digit = true,
            b'.' if !point => point = true,
            b'+' | b'-' if end == 0 => {}
            _ => break,
        }
        end = i + 1;
    }
    digit.then_some(end)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_the_standard() {
        let cases = [
            ("20Y30", Some((20.0, 2))),
            ("-1. 5 X", Some((-1.5, 5))),
            ("+.5", Some((0.5, 2 + 1))),
            ("1.", Some((1.0, 2))),
            ("1E2", Some((1.0, 1))),
            ("1.2.3", Some((1.2, 3))),
            (" 7", Some((7.0, 2))),
            ("-", None),
            (".", None),
            ("--1", None),
            ("inf", None),
            ("", None),
            ("9999999999999", None),
        ];
        for (text, want) in cases {
            assert_eq!(scan(text), want, "{text}");
        }
        assert_eq!(scan(&"9".repeat(400)), None);
    }
}
