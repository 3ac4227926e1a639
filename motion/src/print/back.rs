//! A row of ASCII that is written from its end to its start: that is the order in which digits come out of a number, so nothing is copied.

/// Bytes of a row: 8 numbers of the largest size and the text between.
const ROOM: usize = 8 * 330 + 100;

/// The end of a row. Kept from row to row.
#[derive(Clone, Debug)]
pub struct Back {
    text: [u8; ROOM],
    start: usize,
    /// What stood last at each place: of the six axes few change from move to move.
    last: [Known; 6],
}

/// A number and its text, which ends with the array.
#[derive(Clone, Copy, Debug)]
struct Known {
    bits: u64,
    text: [u8; KNOWN_ROOM],
    length: u8,
}

/// Bytes of a number up to 999999.9999; larger ones are made anew.
const KNOWN_ROOM: usize = 12;

impl Default for Back {
    fn default() -> Self {
        let zero = Known { bits: 0, text: *b"      0.0000", length: 6 };
        Back { text: [0; ROOM], start: ROOM, last: [zero; 6] }
    }
}

impl Back {
    /// Starts a row.
    pub fn clear(&mut self) {
        self.start = ROOM;
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

    /// Counts one more and puts that in front.
    pub fn count(&mut self, count: &mut Count) {
        count.next();
        self.last_of(count.text, COUNT_ROOM - count.start);
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

    /// Puts the last bytes of an array in front. All of it is copied, since that takes one step; the rest is written over.
    fn last_of<const N: usize>(&mut self, bytes: [u8; N], length: usize) {
        self.put(bytes);
        self.start += N - length.min(N);
    }

    /// Puts bytes of ASCII in front.
    pub fn put<const N: usize>(&mut self, bytes: [u8; N]) {
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

    /// The same for the six axes.
    pub fn axes(&mut self, axes: [f64; 6]) {
        for (i, axis) in axes.into_iter().enumerate().rev() {
            let Known { bits, text, length } = self.last[i];
            if bits == axis.to_bits() {
                self.last_of(text, usize::from(length));
            } else {
                self.note(i, axis);
            }
            if i > 0 {
                self.put(*b", ");
            }
        }
    }

    fn note(&mut self, i: usize, axis: f64) {
        let end = self.start;
        self.fixed4(axis);
        let length = end - self.start;
        if length <= KNOWN_ROOM
            && let Some(text) = self.text[..end].last_chunk()
        {
            self.last[i] = Known { bits: axis.to_bits(), text: *text, length: length as u8 };
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
    fn next(&mut self) {
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
    }
}

#[cfg(test)]
mod tests {
    use super::{Back, Count};

    #[test]
    fn counts() {
        let (mut count, mut back) = (Count::default(), Back::default());
        for i in 1..=200_000 {
            back.clear();
            back.count(&mut count);
            assert_eq!(back.bytes(), format!("{i:5}").as_bytes());
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
            back.clear();
            back.fixed4(value);
            assert_eq!(back.bytes(), format!("{value:.4}").as_bytes(), "{value:?}");
        }
    }

    #[test]
    fn axes_are_remembered_and_print_the_same() {
        let (mut x, mut back) = (3_u64, Back::default());
        for _ in 0..20_000 {
            x = x.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            let axes: [f64; 6] = std::array::from_fn(|i| {
                [0.0, -0.0, 1.5, -123_456.75, 98_765.5, 1e9, -12_345.6, 1e17][(x >> (8 * i)) as usize % 8]
            });
            back.clear();
            back.put(*b")");
            back.axes(axes);
            let want = axes.map(|a| format!("{a:.4}")).join(", ") + ")";
            assert_eq!(std::str::from_utf8(back.bytes()), Ok(want.as_str()));
        }
    }

    #[test]
    fn what_does_not_fit_is_left_out() {
        let mut back = Back::default();
        back.text("end");
        back.text(&"x".repeat(5000));
        back.digits(7);
        assert!(back.bytes().ends_with(b"xend") && back.bytes().len() < 5000);
    }
}
