//! A row without blanks in lower case, and where each byte stood.

pub use crate::ngc::fault::Fault;
use crate::ngc::number;
use takt_base::Code;

/// The place in a row.
#[derive(Debug)]
pub struct Cursor<'a> {
    /// Bytes without blanks, lower case.
    pub bytes: &'a [u8],
    /// Byte of the text at which each stood; one more for the end.
    pub at: &'a [u32],
    /// Next byte.
    pub pos: usize,
}

impl<'a> Cursor<'a> {
    /// What is left.
    pub fn rest(&self) -> &'a [u8] {
        &self.bytes[self.pos.min(self.bytes.len())..]
    }
    /// The next byte.
    pub fn peek(&self) -> Option<u8> {
        self.bytes.get(self.pos).copied()
    }
    /// Takes `byte` if it is next.
    pub fn eat(&mut self, byte: u8) -> bool {
        let found = self.peek() == Some(byte);
        self.pos += usize::from(found);
        found
    }
    /// Bytes of the text for a range of the row; it ends with its last byte.
    pub fn span(&self, from: usize, to: usize) -> (u32, u32) {
        let last = self.at.len() - 1;
        if to <= from {
            let at = self.at[from.min(last)];
            return (at, (at + 1).min(self.at[last]).max(at));
        }
        (self.at[from.min(last)], self.char_end(to - 1))
    }
    /// From a byte of the row up to where the next one stands.
    pub fn span_up_to(&self, from: usize, to: usize) -> (u32, u32) {
        let last = self.at.len() - 1;
        (self.at[from.min(last)], self.at[to.min(last)])
    }
    /// One past the character that holds byte `i`.
    fn char_end(&self, i: usize) -> u32 {
        let last = self.at.len() - 1;
        let i = i.min(last);
        let mut end = i + 1;
        while end < self.bytes.len() && self.bytes[end] & 0xC0 == 0x80 {
            end += 1;
        }
        if i < last { self.at[end - 1] + 1 } else { self.at[last] }
    }
    /// A fault at byte `from` of the row.
    pub fn fault(&self, code: Code, from: usize, label: &str, help: &str) -> Fault {
        let (start, end) = self.span(from, from + usize::from(from < self.bytes.len()));
        Fault::at(code, start, end, label, help)
    }
    /// A fault at the letters and digits from `from`.
    pub fn fault_word(&self, code: Code, from: usize, label: &str, help: &str) -> Fault {
        let length = self.bytes[from..].iter().take_while(|b| b.is_ascii_alphanumeric()).count().max(1);
        let (start, end) = self.span(from, (from + length).min(self.bytes.len()));
        Fault::at(code, start, end, label, help)
    }
    /// True if the sign that is next belongs to a number.
    pub fn number_follows_sign(&self) -> bool {
        matches!(self.bytes.get(self.pos + 1), Some(b'0'..=b'9' | b'.'))
    }

    /// A number, if one is next: the way of most words.
    ///
    /// # Errors
    /// A number that is too large.
    pub fn plain_number(&mut self) -> Result<Option<f64>, Fault> {
        match self.peek() {
            Some(b'0'..=b'9' | b'.') => self.number().map(Some),
            Some(b'+' | b'-') if self.number_follows_sign() => self.number().map(Some),
            _ => Ok(None),
        }
    }

    /// A number.
    ///
    /// # Errors
    /// No digit, or too large.
    pub fn number(&mut self) -> Result<f64, Fault> {
        match number::scan(self.rest()) {
            Some((value, length)) => {
                self.pos += length;
                Ok(value)
            }
            None => {
                let length = self.rest().iter().take_while(|b| matches!(b, b'0'..=b'9' | b'+' | b'-' | b'.')).count().max(1);
                let (start, end) = self.span(self.pos, (self.pos + length).min(self.bytes.len()));
                Err(Fault::at(Code::BadWord, start, end, "not a number", NUMBER))
            }
        }
    }
}

/// How numbers are written.
pub const NUMBER: &str = "write a sign, digits and one point, such as -12.5; up to 1000000000000";
