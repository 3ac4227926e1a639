//! One row of a Fanuc-style program: `[/n] [O n | : n] [N n] (word | ,C ,R ,A | #1 = .. | IF WHILE DO END GOTO)*`, blanks anywhere.
//! Runs: background. Time is linear in the row; the buffers of a row are used again.

use super::expr::{self, Ops, Value};
use crate::ngc::code::Comment;
use crate::ngc::expr::Slice;
use crate::ngc::fault::Fault;
use crate::ngc::reader::cursor::Cursor;
use crate::ngc::reader::squeeze::Squeezed;
use crate::ngc::word;
use takt_base::Code;

/// A letter and its value.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Word {
    /// Upper case; `c`, `r` and `a` stand for `,C`, `,R` and `,A`.
    pub letter: u8,
    /// Its value.
    pub value: Value,
    /// A point, a variable or an expression: never counts increments.
    pub exact: bool,
    /// Bytes of the text.
    pub place: (u32, u32),
}

/// `#target = value`.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Setting {
    /// Number of the variable.
    pub target: Value,
    /// What it becomes.
    pub value: Value,
    /// Bytes of the target.
    pub place: (u32, u32),
}

/// A statement of the macro language.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub enum Control {
    /// None.
    #[default]
    None,
    /// `IF[..]THEN`: the settings behind it count if it holds.
    Then(Value),
    /// `IF[..]GOTO n`, `GOTO n`.
    Goto(Option<Value>, Value),
    /// `WHILE[..]DO m`, `DO m`.
    Do(Option<Value>, u32),
    /// `END m`.
    End(u32),
}

/// A row as read.
#[derive(Clone, Debug, Default)]
pub struct Row {
    /// Bytes of the text.
    pub place: (u32, u32),
    /// Source line, from 1.
    pub line: u32,
    /// `/` or `/1` .. `/9`.
    pub skip: bool,
    /// Program number.
    pub program: Option<u32>,
    /// Sequence number.
    pub n: Option<u32>,
    /// Words in their order.
    pub words: Vec<Word>,
    /// Settings.
    pub settings: Vec<Setting>,
    /// Statement.
    pub control: Control,
    /// Postfix code of all values.
    pub ops: Ops,
    /// Comments.
    pub comments: Vec<Comment>,
    /// Their texts.
    pub texts: String,
}

impl Row {
    fn clear(&mut self) {
        self.words.clear();
        self.settings.clear();
        self.ops.clear();
        self.comments.clear();
        self.texts.clear();
        (self.skip, self.program, self.n, self.control) = (false, None, None, Control::None);
    }

    /// Nothing but comments.
    pub fn is_empty(&self) -> bool {
        self.words.is_empty() && self.settings.is_empty() && self.control == Control::None
    }
}

/// Reads rows; holds the buffer.
#[derive(Clone, Debug, Default)]
pub struct Reader {
    squeezed: Squeezed,
}

impl Reader {
    /// Reads the row `text`, which stands at byte `start` in line `line`, into `row`.
    ///
    /// # Errors
    /// The first thing that belongs to no block.
    pub fn read(&mut self, text: &str, start: usize, line: u32, row: &mut Row) -> Result<(), Fault> {
        row.clear();
        (row.place, row.line) = ((start as u32, (start + text.len()) as u32), line);
        self.squeezed.fill(text, start, &mut row.comments)?;
        for comment in &mut row.comments {
            let (from, to) = (comment.place.0 as usize - start, comment.place.1 as usize - start);
            let first = row.texts.len() as u32;
            row.texts.push_str(text.get(from..to).unwrap_or(""));
            comment.text = Slice { start: first, end: row.texts.len() as u32 };
        }
        let mut cursor = Cursor { bytes: &self.squeezed.bytes, at: &self.squeezed.at, pos: 0 };
        head(&mut cursor, row)?;
        while let Some(byte) = cursor.peek() {
            item(byte, &mut cursor, row)?;
        }
        Ok(())
    }
}

/// Skip mark, program and sequence number.
fn head(cursor: &mut Cursor, row: &mut Row) -> Result<(), Fault> {
    if cursor.eat(b'/') {
        row.skip = true;
        if matches!(cursor.peek(), Some(b'1'..=b'9')) {
            cursor.pos += 1;
        }
    }
    if matches!(cursor.peek(), Some(b'o' | b':')) {
        let from = cursor.pos;
        cursor.pos += 1;
        row.program = Some(whole(cursor, from, "a program number such as O1234")?);
    }
    Ok(())
}

fn whole(cursor: &mut Cursor, from: usize, what: &str) -> Result<u32, Fault> {
    let digits = cursor.rest().iter().take_while(|b| b.is_ascii_digit()).count();
    let value = if digits > 0 { cursor.plain_number()?.and_then(word::whole) } else { None };
    value.ok_or_else(|| {
        let (start, end) = cursor.span(from, cursor.pos.max(from + 1));
        Fault::at(Code::BadWord, start, end, "no whole number", format!("write {what}"))
    })
}

fn item(byte: u8, cursor: &mut Cursor, row: &mut Row) -> Result<(), Fault> {
    let rest = cursor.rest();
    // A letter with a number behind it starts no statement: most words.
    let letters = rest.get(1).is_some_and(u8::is_ascii_lowercase);
    let starts = |text: &[u8]| letters && rest.starts_with(text);
    match byte {
        b'#' => setting(cursor, row),
        b',' => comma(cursor, row),
        _ if starts(b"if[") || starts(b"while[") || starts(b"goto") || starts(b"do") || starts(b"end") => control(cursor, row),
        _ if starts(b"dprnt[") || starts(b"bprnt[") || starts(b"popen") || starts(b"pclos") || starts(b"setvn[") => {
            let help = "there is no such port here: leave the statement out, or write a comment";
            Err(cursor.fault_word(Code::NotOfThisControl, cursor.pos, "output to a port of the control", help))
        }
        b'n' => {
            let from = cursor.pos;
            cursor.pos += 1;
            let n = whole(cursor, from, "N and digits")?;
            if row.n.replace(n).is_some() {
                let (start, end) = cursor.span(from, cursor.pos);
                return Err(Fault::at(Code::DuplicateWord, start, end, "a second N word", "a block has one number"));
            }
            Ok(())
        }
        b'a'..=b'z' => letter(byte, cursor, row),
        b'[' | b']' => {
            let help = "an expression stands behind a letter, such as X[#1+2], or behind `#1=`";
            Err(cursor.fault(Code::BadExpression, cursor.pos, "an expression that belongs to no word", help))
        }
        _ => {
            let help = "a block consists of words such as G1 and X12.5, of macro statements and of comments in parentheses";
            Err(cursor.fault(Code::BadCharacter, cursor.pos, "neither a word nor a comment", help))
        }
    }
}

fn letter(byte: u8, cursor: &mut Cursor, row: &mut Row) -> Result<(), Fault> {
    let from = cursor.pos;
    cursor.pos += 1;
    if byte == b'o' {
        let (start, end) = cursor.span(from, from + 1);
        let help = "a program number stands at the start of its row";
        return Err(Fault::at(Code::BadWord, start, end, "a program number behind other words", help));
    }
    word_value(byte.to_ascii_uppercase(), from, cursor, row)
}

/// `,C2.`, `,R2.`, `,A30.`.
fn comma(cursor: &mut Cursor, row: &mut Row) -> Result<(), Fault> {
    let from = cursor.pos;
    cursor.pos += 1;
    match cursor.peek() {
        Some(letter @ (b'c' | b'r' | b'a')) => {
            cursor.pos += 1;
            word_value(letter, from, cursor, row)
        }
        _ => Err(cursor.fault(Code::BadWord, from, "a comma with nothing behind it", "write ,C or ,R for a chamfer or a corner")),
    }
}

fn word_value(letter: u8, from: usize, cursor: &mut Cursor, row: &mut Row) -> Result<(), Fault> {
    let value_at = cursor.pos;
    let starts = match cursor.peek() {
        Some(b'0'..=b'9' | b'.' | b'#' | b'[') => true,
        Some(b'+' | b'-') => matches!(cursor.bytes.get(cursor.pos + 1), Some(b'0'..=b'9' | b'.' | b'#' | b'[')),
        _ => false,
    };
    if !starts {
        let (start, end) = cursor.span(from, cursor.pos);
        return Err(Fault::at(Code::BadWord, start, end, "a letter without a number", "write a number behind it, such as X12.5"));
    }
    let value = expr::value(cursor, &mut row.ops, true)?;
    let exact = !matches!(value, Value::Number(_)) || cursor.bytes[value_at..cursor.pos].contains(&b'.');
    row.words.push(Word { letter, value, exact, place: cursor.span(from, cursor.pos) });
    Ok(())
}

/// `#5=..`, `#[..]=..`, `##5=..`.
fn setting(cursor: &mut Cursor, row: &mut Row) -> Result<(), Fault> {
    let from = cursor.pos;
    cursor.pos += 1;
    let target = expr::value(cursor, &mut row.ops, false)?;
    let place = cursor.span(from, cursor.pos);
    if !cursor.eat(b'=') {
        let help = "write #1=5 to set a variable, or a letter before it to use it, such as X#1";
        return Err(Fault::at(Code::BadMacro, place.0, place.1, "a variable that belongs to no word", help));
    }
    let value = expr::expression(cursor, &mut row.ops)?;
    row.settings.push(Setting { target, value, place });
    Ok(())
}

const FORMS: &str = "write IF[#1 GT 0]GOTO 10, IF[#1 EQ 0]THEN #2=1, GOTO 10, WHILE[#1 LT 5]DO1 or END1";

fn control(cursor: &mut Cursor, row: &mut Row) -> Result<(), Fault> {
    let from = cursor.pos;
    if row.control != Control::None || !row.words.is_empty() || !row.settings.is_empty() {
        return Err(cursor.fault_word(Code::BadMacro, from, "a statement behind other words", "put it on a row of its own"));
    }
    row.control = statement(cursor, row)?;
    if cursor.peek().is_some() && !matches!(row.control, Control::Then(_)) {
        return Err(cursor.fault_word(Code::BadMacro, cursor.pos, "words behind a statement", "put them on a row of their own"));
    }
    Ok(())
}

fn statement(cursor: &mut Cursor, row: &mut Row) -> Result<Control, Fault> {
    let from = cursor.pos;
    if eat(cursor, b"if") {
        let holds = expr::condition(cursor, &mut row.ops)?;
        if eat(cursor, b"then") {
            if cursor.peek() != Some(b'#') {
                return Err(cursor.fault(Code::BadMacro, from, "THEN without a setting", FORMS));
            }
            return Ok(Control::Then(holds));
        }
        if !eat(cursor, b"goto") {
            return Err(cursor.fault_word(Code::BadMacro, from, "IF without GOTO or THEN", FORMS));
        }
        return Ok(Control::Goto(Some(holds), expr::value(cursor, &mut row.ops, false)?));
    }
    if eat(cursor, b"goto") {
        return Ok(Control::Goto(None, expr::value(cursor, &mut row.ops, false)?));
    }
    let holds = if eat(cursor, b"while") { Some(expr::condition(cursor, &mut row.ops)?) } else { None };
    if holds.is_none() && eat(cursor, b"end") {
        return Ok(Control::End(whole(cursor, from, "END and the number of its DO: END1")?));
    }
    if !eat(cursor, b"do") {
        return Err(cursor.fault_word(Code::BadMacro, from, "WHILE without DO", FORMS));
    }
    Ok(Control::Do(holds, whole(cursor, from, "DO and a number: DO1")?))
}

fn eat(cursor: &mut Cursor, text: &[u8]) -> bool {
    let found = cursor.rest().starts_with(text);
    cursor.pos += if found { text.len() } else { 0 };
    found
}
