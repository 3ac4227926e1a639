//! A row of ASCII that is written from its end to its start: that is the order in which digits come out of a number, so nothing is copied.

/// Bytes of a row: 8 numbers of the largest size and the text between.
const ROOM: usize = 8 * 330 + 100;

/// The end of a row. Kept from row to row.
#[derive(Clone, Debug)]
pub struct Back {
    text: [u8; ROOM],
    start: usize,
}

impl Default for Back {
    fn default() -> Self {
        Back { text: [0; ROOM], start: ROOM }
    }
}

impl Back {
    /// Starts a row that ends with `text`.
    pub fn end(&mut self, text: &str) {
        self.start = ROOM;
        self.text(text);
    }

    /// What is written so far.
    pub fn bytes(&self) -> &[u8] {
        &self.text[self.start..]
    }

    /// Puts `text` in front. What does not fit is left out: no row is as long.
    pub fn text(&mut self, text: &str) {
        let start = self.start.saturating_sub(text.len());
        self.text[start..self.start].copy_from_slice(&text.as_bytes()[text.len() - (self.start - start)..]);
        self.start = start;
    }

    /// Puts bytes of ASCII in front, if there is room.
    pub fn front(&mut self, bytes: &[u8]) {
        if let Some(start) = self.start.checked_sub(bytes.len()) {
            self.text[start..self.start].copy_from_slice(bytes);
            self.start = start;
        }
    }

    /// Blanks.
    pub fn padding(&mut self, n: usize) {
        for _ in 0..n {
            self.byte(b' ');
        }
    }

    fn byte(&mut self, byte: u8) {
        self.put([byte]);
    }

    fn put<const N: usize>(&mut self, bytes: [u8; N]) {
        if let Some(place) = self.text[..self.start].last_chunk_mut() {
            *place = bytes;
            self.start -= N;
        }
    }

    /// A whole number.
    pub fn digits(&mut self, mut number: u64) {
        loop {
            self.byte(b'0' + (number % 10) as u8);
            number /= 10;
            if number == 0 {
                return;
            }
        }
    }

    /// Numbers with 4 decimals and commas between them.
    pub fn numbers(&mut self, numbers: &[f64]) {
        for (i, number) in numbers.iter().enumerate().rev() {
            self.fixed4(*number);
            if i > 0 {
                self.put(*b", ");
            }
        }
    }

    /// `{:.4}`, in a quick way for numbers of usual size that are not near a tie of the rounding.
    pub fn fixed4(&mut self, value: f64) {
        if value.to_bits() == 0 {
            return self.put(*b"0.0000");
        }
        let scaled = value.abs() * 1e4;
        let near = (scaled + 0.5) as u64;
        if scaled >= 1e13 || ((scaled - near as f64).abs() - 0.5).abs() < 1e-3 || !value.is_finite() {
            return self.text(&format!("{value:.4}"));
        }
        let part = near % 10_000;
        let [high, low] = [part / 100, part % 100].map(|pair| [b'0' + (pair / 10) as u8, b'0' + (pair % 10) as u8]);
        self.put([b'.', high[0], high[1], low[0], low[1]]);
        self.digits(near / 10_000);
        if value.is_sign_negative() {
            self.byte(b'-');
        }
    }
}

/// A number that counts in decimals, at least five places wide: adding one to text is quicker than making text of a number.
#[derive(Clone, Debug)]
pub struct Count {
    text: [u8; COUNT_ROOM],
    start: usize,
}

const COUNT_ROOM: usize = 12;
const COUNT_WIDTH: usize = 5;

impl Default for Count {
    fn default() -> Self {
        let mut text = [b' '; COUNT_ROOM];
        text[COUNT_ROOM - 1] = b'0';
        Count { text, start: COUNT_ROOM - COUNT_WIDTH }
    }
}

impl Count {
    /// One more.
    pub fn next(&mut self) -> &[u8] {
        for i in (0..COUNT_ROOM).rev() {
            match self.text[i] {
                b'9' => self.text[i] = b'0',
                b' ' => {
                    self.text[i] = b'1';
                    self.start = self.start.min(i);
                    break;
                }
                _ => {
                    self.text[i] += 1;
                    break;
                }
            }
        }
        &self.text[self.start..]
    }
}

#[cfg(test)]
mod tests {
    use super::{Back, Count};

    #[test]
    fn counts() {
        let mut count = Count::default();
        for i in 1..=200_000 {
            assert_eq!(count.next(), format!("{i:5}").as_bytes());
        }
    }

    #[test]
    fn the_quick_way_prints_the_same() {
        let (mut x, mut back) = (99_u64, Back::default());
        for i in 0..200_000 {
            x = x.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            let value = match i % 4 {
                0 => f64::from_bits(x),
                1 => (x >> 40) as f64 / 100_000.0,
                2 => -((x >> 30) as f64) / 1e6,
                _ => (x >> 60) as f64 / 16.0 + 0.00005,
            };
            back.end("");
            back.fixed4(value);
            assert_eq!(back.bytes(), format!("{value:.4}").as_bytes(), "{value:?}");
        }
    }

    #[test]
    fn what_does_not_fit_is_left_out() {
        let mut back = Back::default();
        back.end("end");
        back.text(&"x".repeat(5000));
        back.digits(7);
        assert!(back.bytes().ends_with(b"xend") && back.bytes().len() < 5000);
    }
}
