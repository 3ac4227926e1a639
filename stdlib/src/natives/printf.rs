//! Reals as C's `printf` writes them. From: C17, 7.21.6.1, conversion `g`.
//! Runs: cyclic.

use std::fmt::{self, Write};

/// Longest scientific form that is made: sign, digits, point, exponent.
const FORM_MAX: usize = 40;

/// `%.<digits>g`: trailing zeros and a point at the end are left out.
pub(super) fn write_g(out: &mut impl Write, value: f64, digits: usize) -> fmt::Result {
    if !value.is_finite() {
        let text = if value.is_nan() { "nan" } else { "inf" };
        return write!(out, "{}{text}", if value.is_sign_negative() && !value.is_nan() { "-" } else { "" });
    }
    let mut form = Form { bytes: [0; FORM_MAX], len: 0 };
    write!(form, "{value:.*e}", digits.saturating_sub(1))?;
    let Some((mantissa, exponent)) = form.text().split_once('e') else { return Ok(()) };
    let exponent: i32 = exponent.parse().unwrap_or(0);
    let precision = digits as i32;
    if (-4..precision).contains(&exponent) {
        let mut plain = Form { bytes: [0; FORM_MAX], len: 0 };
        write!(plain, "{value:.*}", usize::try_from(precision - 1 - exponent).unwrap_or(0))?;
        return out.write_str(without_zeros(plain.text()));
    }
    let sign = if exponent < 0 { '-' } else { '+' };
    write!(out, "{}e{sign}{:02}", without_zeros(mantissa), exponent.unsigned_abs())
}

fn without_zeros(text: &str) -> &str {
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { text }
}

/// Text on the stack; what passes the end is dropped.
struct Form {
    bytes: [u8; FORM_MAX],
    len: usize,
}

impl Form {
    fn text(&self) -> &str {
        self.bytes.get(..self.len).and_then(|b| std::str::from_utf8(b).ok()).unwrap_or("")
    }
}

impl Write for Form {
    fn write_str(&mut self, s: &str) -> fmt::Result {
        for (place, &byte) in self.bytes.iter_mut().skip(self.len).zip(s.as_bytes()) {
            *place = byte;
            self.len += 1;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn as_in_c() {
        for (value, want) in [
            (0.0, "0"),
            (100.0, "100"),
            (1.5, "1.5"),
            (-0.1, "-0.1"),
            (f64::from(0.1f32), "0.1000000015"),
            (1e20, "1e+20"),
            (1.25e-7, "1.25e-07"),
            (0.0001, "0.0001"),
            (9_999_999_999.0, "9999999999"),
            (99_999_999_999.0, "1e+11"),
            (-1.0e100, "-1e+100"),
            (f64::INFINITY, "inf"),
            (f64::NEG_INFINITY, "-inf"),
            (f64::NAN, "nan"),
        ] {
            let mut out = String::new();
            write_g(&mut out, value, 10).unwrap();
            assert_eq!(out, want);
        }
    }
}
