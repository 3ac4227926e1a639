//! `o100 sub`, `o<name> call [1] [2]`, `o[#1] call`, `O100`.

use super::cursor::{Cursor, Fault};
use crate::ngc::code::Code as Arena;
use crate::ngc::expr::{Slice, Value, compile};
use crate::ngc::oword::{Keyword, Label, OWord};
use crate::ngc::word::whole;
use takt_base::Code;

/// Reads the O word at the cursor, with its arguments. Nothing but comments may follow.
pub fn read(cursor: &mut Cursor, arena: &mut Arena) -> Result<OWord, Fault> {
    let from = cursor.pos;
    cursor.pos += 1;
    let label = label(cursor, arena, from)?;
    let keyword = keyword(cursor, from, label)?;
    let place = cursor.span(from, cursor.pos);
    if matches!(label, Label::Computed(_)) && keyword != Keyword::Call {
        let help = "only a call can compute its number";
        return Err(Fault::at(Code::BadFlow, place.0, place.1, "a computed label", help));
    }
    let start = arena.args.len();
    read_args(cursor, arena, keyword, place)?;
    Ok(OWord { label, keyword, args: Slice { start: start as u32, end: arena.args.len() as u32 }, place })
}

fn label(cursor: &mut Cursor, arena: &mut Arena, from: usize) -> Result<Label, Fault> {
    if let Some(name) = compile::name(cursor, arena)? {
        return Ok(Label::Name(name));
    }
    match cursor.peek() {
        Some(b'0'..=b'9' | b'[' | b'#') => {}
        _ => return Err(bad_label(cursor, from)),
    }
    match compile::value(cursor, arena)? {
        Value::Number(number) => whole(number).map(Label::Number).ok_or_else(|| bad_label(cursor, from)),
        value => Ok(Label::Computed(value)),
    }
}

fn bad_label(cursor: &Cursor, from: usize) -> Fault {
    let (start, end) = cursor.span(from, cursor.pos.max(from + 1));
    let help = "write a whole number, a name or a computed number: o100 call, o<name> call, o[#1] call";
    Fault::at(Code::BadFlow, start, end, "an O word without a number or name", help)
}

fn keyword(cursor: &mut Cursor, from: usize, label: Label) -> Result<Keyword, Fault> {
    if cursor.peek().is_none() && matches!(label, Label::Number(_) | Label::Name(_)) {
        return Ok(Keyword::Program);
    }
    let rest = cursor.rest();
    let found = Keyword::ALL.into_iter().find(|k| rest.starts_with(k.text().as_bytes()));
    let Some(keyword) = found else {
        let help =
            "write sub, endsub, call, return, if, elseif, else, endif, while, endwhile, do, repeat, endrepeat, break or continue";
        let (start, end) = cursor.span(from, cursor.bytes.len());
        return Err(Fault::at(Code::BadFlow, start, end, "no such O word", help));
    };
    cursor.pos += keyword.text().len();
    Ok(keyword)
}

fn read_args(cursor: &mut Cursor, arena: &mut Arena, keyword: Keyword, place: (u32, u32)) -> Result<(), Fault> {
    let mut count = 0;
    while cursor.peek() == Some(b'[') && count < *keyword.arguments().end() {
        let value = compile::bracketed(cursor, arena)?;
        arena.args.push(value);
        count += 1;
    }
    if count < *keyword.arguments().start() {
        let label = format!("{} needs an expression", keyword.text());
        return Err(Fault::at(Code::BadFlow, place.0, place.1, label, "write it in brackets, such as o1 if [#1 GT 0]"));
    }
    if cursor.peek().is_some() {
        let (start, end) = cursor.span(cursor.pos, cursor.bytes.len());
        let help = "an O word stands alone on its row; move the other words to the next one";
        return Err(Fault::at(Code::BadFlow, start, end, "words behind an O word", help));
    }
    Ok(())
}
