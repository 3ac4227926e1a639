//! The grammar of one row: `[/] [N number] (O word | (word | setting | comment)*)`, blanks anywhere, letters of either case (R1-33..R1-39).
//! Runs: background. Time is linear in the length of the row, which has no limit; the buffers are kept from row to row.

pub mod cursor;
mod oword;
pub(in crate::ngc) mod squeeze;

use super::code::{Code as Arena, Row, Setting, Target, Word};
use super::expr::{Slice, Value, compile};
use super::word;
use cursor::{Cursor, Fault};
use squeeze::Squeezed;
use takt_base::Code;

/// Reads rows; holds the buffers.
#[derive(Clone, Debug, Default)]
pub struct Reader {
    squeezed: Squeezed,
}

impl Reader {
    /// Reads the row `text`, which stands at byte `start` of its file in line `line`, into `arena`.
    ///
    /// # Errors
    /// The first thing that is no word, no setting and no comment.
    pub fn read(&mut self, text: impl AsRef<[u8]>, start: usize, line: u32, arena: &mut Arena) -> Result<Row, Fault> {
        let from = arena.mark();
        let row = self.fill(text.as_ref(), start, line, arena);
        if row.is_err() {
            arena.truncate(from);
        }
        row
    }

    fn fill(&mut self, text: &[u8], start: usize, line: u32, arena: &mut Arena) -> Result<Row, Fault> {
        let place = (start as u32, (start + text.len()) as u32);
        let [words, settings, comments] = [arena.words.len(), arena.settings.len(), arena.comments.len()];
        self.squeezed.fill(text, start, &mut arena.comments)?;
        arena.add_texts(comments, text, start);
        let mut cursor = Cursor { bytes: &self.squeezed.bytes, at: &self.squeezed.at, pos: 0 };
        let deleted = cursor.eat(b'/');
        let n = number_word(&mut cursor)?;
        let oword = if cursor.peek() == Some(b'o') { Some(oword::read(&mut cursor, arena)?) } else { None };
        while let Some(byte) = cursor.peek() {
            item(byte, &mut cursor, arena, words)?;
        }
        let slice = |start: usize, end: usize| Slice { start: start as u32, end: end as u32 };
        Ok(Row {
            place,
            line,
            deleted,
            n,
            words: slice(words, arena.words.len()),
            settings: slice(settings, arena.settings.len()),
            comments: slice(comments, arena.comments.len()),
            oword,
        })
    }
}

/// `N` and a whole number at the start of a row.
fn number_word(cursor: &mut Cursor) -> Result<Option<u32>, Fault> {
    let from = cursor.pos;
    if !cursor.eat(b'n') {
        return Ok(None);
    }
    let Some(value) = cursor.plain_number()? else { return Err(no_value(cursor, from)) };
    match word::whole(value) {
        Some(n) => Ok(Some(n)),
        None => {
            let (start, end) = cursor.span(from, cursor.pos);
            Err(Fault::at(Code::BadWord, start, end, "not a whole number", "write N and digits, up to N4294967295"))
        }
    }
}

fn item(byte: u8, cursor: &mut Cursor, arena: &mut Arena, _first: usize) -> Result<(), Fault> {
    match byte {
        b'a'..=b'z' | b'@' | b'^' => letter(byte, cursor, arena),
        b'$' if cursor.bytes.get(cursor.pos + 1).is_some_and(|b| matches!(b, b'0'..=b'9' | b'[' | b'#' | b'-')) => {
            letter(byte, cursor, arena)
        }
        b'#' => setting(cursor, arena),
        b'[' | b']' => {
            let help = "an expression stands behind a letter, such as X[1 + 2], or behind `#1 =`";
            Err(cursor.fault(Code::BadExpression, cursor.pos, "an expression that belongs to no word", help))
        }
        _ => {
            let help = "a block consists of words such as G1 and X12.5 and of comments in parentheses";
            Err(cursor.fault(Code::BadCharacter, cursor.pos, "neither a word nor a comment", help))
        }
    }
}

fn letter(byte: u8, cursor: &mut Cursor, arena: &mut Arena) -> Result<(), Fault> {
    let from = cursor.pos;
    cursor.pos += 1;
    if byte == b'n' {
        return Err(late_number(cursor, from));
    }
    if byte == b'o' {
        let (start, end) = cursor.span(from, from + 1);
        let help = "put the O word on a row of its own";
        return Err(Fault::at(Code::BadFlow, start, end, "an O word behind other words", help));
    }
    let value = match cursor.peek() {
        Some(b'0'..=b'9' | b'.') => Value::Number(word_number(cursor, from)?),
        Some(b'+' | b'-') if cursor.number_follows_sign() => Value::Number(word_number(cursor, from)?),
        Some(b'#' | b'[') => compile::value(cursor, arena)?,
        Some(b'+' | b'-') if matches!(cursor.bytes.get(cursor.pos + 1), Some(b'#' | b'[' | b'a'..=b'z' | b'+' | b'-')) => {
            sign_value(cursor, arena, from)?
        }
        Some(b'a'..=b'z') if function_follows(cursor) => compile::value(cursor, arena)?,
        _ => return Err(no_value(cursor, from)),
    };
    let letter = char::from(byte.to_ascii_uppercase());
    let action = match (letter, value) {
        ('G', Value::Number(number)) => word::g_of(number),
        ('M', Value::Number(number)) => word::m_of(number),
        _ => None,
    };
    arena.words.push(Word { letter, value, action, place: cursor.span(from, cursor.pos) });
    Ok(())
}

/// A sign before something that is no number. `--1` has always been refused as a word that is not well formed.
fn sign_value(cursor: &mut Cursor, arena: &mut Arena, from: usize) -> Result<Value, Fault> {
    if cursor.rest().iter().take_while(|b| matches!(b, b'+' | b'-')).count() > 1 {
        return Err(bad_number(cursor, from));
    }
    compile::value(cursor, arena)
}

/// A letter that starts a function name and not the next word: a bracket follows its letters.
fn function_follows(cursor: &Cursor) -> bool {
    let rest = cursor.rest();
    let letters = rest.iter().take_while(|b| b.is_ascii_lowercase()).count();
    letters >= 2 && rest.get(letters) == Some(&b'[')
}

fn word_number(cursor: &mut Cursor, from: usize) -> Result<f64, Fault> {
    match cursor.number() {
        Ok(value) => Ok(value),
        Err(_) => Err(bad_number(cursor, from)),
    }
}

fn bad_number(cursor: &Cursor, from: usize) -> Fault {
    let length = cursor.rest().iter().take_while(|b| matches!(b, b'0'..=b'9' | b'+' | b'-' | b'.')).count();
    let (start, end) = cursor.span(from, cursor.pos + length);
    Fault::at(Code::BadWord, start, end, "not a number", cursor::NUMBER)
}

fn no_value(cursor: &Cursor, from: usize) -> Fault {
    if matches!(cursor.peek(), Some(b'+' | b'-' | b'.' | b'0'..=b'9')) {
        return bad_number(cursor, from);
    }
    let (start, end) = cursor.span_up_to(from, cursor.pos);
    Fault::at(Code::BadWord, start, end, "a letter without a number", "write a number behind the letter, such as X12.5")
}

fn late_number(cursor: &mut Cursor, from: usize) -> Fault {
    if !matches!(cursor.plain_number(), Ok(Some(_))) {
        return no_value(cursor, from);
    }
    let (start, end) = cursor.span(from, cursor.pos);
    let label = "the block number stands behind other words";
    Fault::at(Code::BadWord, start, end, label, "put the N word first; a block has one")
}

/// `#5 = value`, `#<name> = value`.
fn setting(cursor: &mut Cursor, arena: &mut Arena) -> Result<(), Fault> {
    let from = cursor.pos;
    cursor.pos += 1;
    let target = match compile::name(cursor, arena)? {
        Some(name) => Target::Named(name),
        None => Target::Numbered(compile::value(cursor, arena)?),
    };
    let place = cursor.span(from, cursor.pos);
    if !cursor.eat(b'=') {
        let help = "write #1 = 5 to set a parameter, or a letter before it to use it, such as X#1";
        return Err(Fault::at(Code::BadParameter, place.0, place.1, "a parameter that belongs to no word", help));
    }
    let value = compile::value(cursor, arena)?;
    arena.settings.push(Setting { target, value, place });
    Ok(())
}

#[cfg(test)]
mod tests;
