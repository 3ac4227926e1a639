//! A block put together by a dialect in place of a row.

use super::{Request, Word, slot};
use crate::ngc::word::Action;
use takt_base::Span;

impl Request {
    /// Becomes an empty block, for a dialect that puts its own words into it.
    pub fn reset(&mut self, span: Span, n: Option<u32>) {
        (self.span, self.n, self.motion) = (span, n, None);
        (self.has_code, self.has_letter) = (0, 0);
    }

    /// Puts a code into the block; the last one of a group counts.
    pub fn put_code(&mut self, action: Action, span: Span) {
        let group = action.group() as usize;
        self.has_code |= 1 << group;
        self.codes[group] = (action, span);
    }

    /// Puts a word into the block; the last one of a letter counts.
    pub fn put_word(&mut self, letter: char, value: f64, span: Span) {
        if let Some(i) = slot(letter) {
            self.has_letter |= 1 << i;
            self.letters[i] = Word { letter, value, span };
        }
    }
}
