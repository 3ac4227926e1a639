//! Numbers of RS274/NGC: sign, digits, one point. By hand, since `nom`'s `double` would also take `1E2`, `inf` and `nan`, and is slower.

/// Largest magnitude that a word may have; keeps all sums and squares finite.
pub const MAX: f64 = 1e12;

/// Powers of ten that a float holds exactly.
const TENS: [f64; 23] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21,
    1e22,
];

/// Value and length in bytes of the number at the start of `bytes`; `None` if there is no digit or the value is above [`MAX`].
pub fn scan(bytes: &[u8]) -> Option<(f64, usize)> {
    let (mut i, mut mantissa, mut digits, mut fraction, mut point) = (0, 0_u64, 0_u32, 0_usize, false);
    let negative = bytes.first() == Some(&b'-');
    if matches!(bytes.first(), Some(b'-' | b'+')) {
        i = 1;
    }
    let mut significant = 0_u32;
    while let Some(&byte) = bytes.get(i) {
        match byte {
            b'0'..=b'9' => {
                digits += 1;
                significant += u32::from(significant > 0 || byte != b'0');
                if significant <= 18 {
                    mantissa = mantissa * 10 + u64::from(byte - b'0');
                }
                fraction += usize::from(point);
            }
            b'.' if !point => point = true,
            _ => break,
        }
        i += 1;
    }
    if digits == 0 {
        return None;
    }
    // Both are exact, so the quotient is the nearest float: what the library's reader gives.
    let value = if significant <= 15 && fraction < TENS.len() {
        let value = mantissa as f64 / TENS[fraction];
        if negative { -value } else { value }
    } else {
        std::str::from_utf8(&bytes[..i]).ok()?.parse().ok()?
    };
    (value.abs() <= MAX).then_some((value, i))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_the_standard() {
        let cases = [
            ("20Y30", Some((20.0, 2))),
            ("-1.5X", Some((-1.5, 4))),
            ("+.5", Some((0.5, 2 + 1))),
            ("1.", Some((1.0, 2))),
            ("1E2", Some((1.0, 1))),
            ("1.2.3", Some((1.2, 3))),
            ("-", None),
            (".", None),
            ("--1", None),
            ("inf", None),
            ("", None),
            ("9999999999999", None),
        ];
        for (text, want) in cases {
            assert_eq!(scan(text.as_bytes()), want, "{text}");
        }
        assert_eq!(scan("9".repeat(400).as_bytes()), None);
    }

    #[test]
    fn the_quick_way_gives_the_nearest_float() {
        let mut x = 12_345_u64;
        for _ in 0..200_000 {
            x = x.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            let (whole, digits) = (x >> 44, (x >> 20) & 0xFF_FFFF);
            let text = format!("{}{whole}.{digits:0width$}", if x & 1 == 0 { "-" } else { "" }, width = (x >> 8) as usize % 14);
            let want: f64 = text.parse().unwrap();
            assert_eq!(scan(text.as_bytes()).map(|s| s.0.to_bits()), Some(want.to_bits()), "{text}");
        }
    }
}
