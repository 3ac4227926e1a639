//! Over rows that are not executed, to the O word that is looked for. Only rows that start with `o` are compiled.

use super::{Flow, Key, misfit};
use crate::ngc::code::Row;
use crate::ngc::fault::Fault;
use crate::ngc::lines::{Place, trimmed};
use crate::ngc::oword::{Keyword, Label, OWord};

/// Ways over rows that are remembered.
const JUMPS_MAX: usize = 32_768;
/// Errors in rows that are not executed, of one way over them.
const FOUND_MAX: usize = 10_000;

impl Flow {
    /// Goes to the next row with `key` and one of `keywords`, and reads it. `from` is the O word that asks.
    pub(super) fn skip_to(&mut self, key: Key, keywords: &[Keyword], from: (u32, u32)) -> Result<OWord, Fault> {
        let origin = (self.files.at, self.here.key());
        if let Some(&place) = self.jumps.get(&origin) {
            self.files.lines().place = place;
            if let super::Next::Row(Row { oword: Some(word), .. }) = self.next_row() {
                return Ok(word);
            }
        }
        loop {
            let mark = self.code.mark();
            let Some((word, place)) = self.next_oword()? else {
                let help = "write the O word that ends it, with the same number or name";
                return Err(misfit(from, "nothing ends this block", help));
            };
            if word.keyword == Keyword::Sub && self.key(word.label) != Some(key) {
                return Err(misfit(
                    from,
                    "another subroutine starts before this block ends",
                    "end it with its own number or name",
                ));
            }
            if keywords.contains(&word.keyword) && self.key(word.label) == Some(key) {
                self.remember(origin, place);
                self.here = place;
                return Ok(word);
            }
            self.code.truncate(mark);
        }
    }

    fn remember(&mut self, origin: (u32, u64), place: Place) {
        if self.keeps() && self.jumps.len() < JUMPS_MAX {
            self.jumps.insert(origin, place);
        }
    }

    /// The next O word, and where its row stands; `None` at the end of the text.
    fn next_oword(&mut self) -> Result<Option<(OWord, Place)>, Fault> {
        loop {
            let place = self.files.lines().place;
            let Some(piece) = self.files.next_piece()? else { return Ok(None) };
            let inside = self.files.bytes(piece.range.clone());
            if inside.trim_ascii_start().starts_with(b"%") {
                return Ok(None);
            }
            let wanted = starts_with_o(inside);
            if !wanted && !self.thorough {
                continue;
            }
            let mark = self.code.mark();
            match self.reader.read(inside, piece.range.start, piece.line, &mut self.code) {
                Ok(Row { oword: Some(word), .. }) if wanted => return Ok(Some((word, place))),
                Ok(_) => self.code.truncate(mark),
                Err(fault) if self.thorough && self.found.len() < FOUND_MAX => self.found.push(fault),
                Err(_) => {}
            }
        }
    }

    /// All subroutines and program numbers from here on.
    pub(super) fn index_subs(&mut self) -> Result<(), Fault> {
        self.pass_opening()?;
        loop {
            let mark = self.code.mark();
            let Some((word, _)) = self.next_oword()? else { return Ok(()) };
            if matches!(word.keyword, Keyword::Sub | Keyword::Program)
                && let Some(key) = self.key(word.label)
            {
                let spot = self.files.spot();
                self.add_sub(key, spot, word.place)?;
            }
            self.code.truncate(mark);
        }
    }

    /// Goes past the `%` that opens a text.
    fn pass_opening(&mut self) -> Result<(), Fault> {
        if let Some(piece) = self.files.next_piece()?
            && trimmed(self.files.bytes(piece.range)) != b"%"
        {
            self.files.lines().place = Place::default();
        }
        Ok(())
    }

    /// Key of a label that is no expression.
    pub(super) fn key(&self, label: Label) -> Option<Key> {
        match label {
            Label::Number(number) => Some(Key::Number(number)),
            Label::Name(name) => Some(Key::of(name)),
            Label::Computed(_) => None,
        }
    }
}

/// Behind blanks, `/` and a block number.
fn starts_with_o(bytes: &[u8]) -> bool {
    let blank = |b: &&u8| matches!(b, b' ' | b'\t' | b'/');
    let mut rest = bytes.iter().skip_while(blank);
    match rest.next() {
        Some(b'o' | b'O') => true,
        Some(b'n' | b'N') => {
            let mut rest = rest.skip_while(|b| b.is_ascii_digit() || matches!(b, b' ' | b'\t' | b'.'));
            matches!(rest.next(), Some(b'o' | b'O'))
        }
        _ => false,
    }
}
