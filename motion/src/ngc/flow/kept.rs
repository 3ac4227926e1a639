//! Compiled rows of loops and subroutines. Bounded: rows beyond it are read again.

use super::Quick;
use crate::ngc::code::{Code as Arena, Row};
use crate::ngc::lines::Place;
use std::collections::HashMap;

/// Rows that are kept.
const ROWS_MAX: usize = 32_768;
/// Bytes of their words and expressions.
const BYTES_MAX: usize = 6 << 20;

/// Where a row stands: file and place.
pub type Key = (u32, u64);

#[derive(Clone, Copy, Debug)]
struct Kept {
    key: Key,
    row: Row,
    /// Where the row behind it stands.
    next: Place,
}

/// All that are kept, in the order in which they were first executed.
#[derive(Clone, Debug, Default)]
pub struct Rows {
    all: Vec<Kept>,
    index: HashMap<Key, u32, Quick>,
    /// The row behind the one that was asked for last: most often that is asked for next.
    next: usize,
}

impl Rows {
    /// The row at a place, and where the next one stands.
    pub fn get(&mut self, key: Key) -> Option<(&Row, Place)> {
        let i = match self.all.get(self.next) {
            Some(kept) if kept.key == key => self.next,
            _ => *self.index.get(&key)? as usize,
        };
        self.next = i + 1;
        self.all.get(i).map(|kept| (&kept.row, kept.next))
    }

    /// Keeps a row, if there is room; false if not.
    pub fn keep(&mut self, key: Key, row: &Row, next: Place, code: &Arena) -> bool {
        if self.all.len() >= ROWS_MAX || code.size() > BYTES_MAX {
            return false;
        }
        self.index.insert(key, self.all.len() as u32);
        self.all.push(Kept { key, row: *row, next });
        self.next = self.all.len();
        true
    }
}
