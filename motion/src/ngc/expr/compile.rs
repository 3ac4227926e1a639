//! Text of an expression to postfix code. A recursive descent whose depth is bounded by [`NESTING_MAX`].
//!
//! `value := number | '[' expression ']' | '#' value | '#<' name '>' | sign value | function '[' expression ']'`;
//! blanks and case do not matter (the reader has taken them out).

use super::{Binary, Function, NESTING_MAX, Op, Slice, Value};
use crate::ngc::code::Code as Arena;
use crate::ngc::param::{self, Name};
use crate::ngc::reader::cursor::{Cursor, Fault};
use nom::branch::alt;
use nom::bytes::complete::tag;
use nom::combinator::value as is;
use nom::{IResult, Parser};
use takt_base::Code;

/// Reads a value at the cursor; its code goes to `arena`.
///
/// # Errors
/// What is no value.
pub fn value(cursor: &mut Cursor, arena: &mut Arena) -> Result<Value, Fault> {
    if let Some(number) = cursor.plain_number()? {
        return Ok(Value::Number(number));
    }
    let start = arena.ops.len();
    operand(cursor, arena, 0)?;
    Ok(code_from(arena, start))
}

/// An expression in brackets, for arguments and conditions.
///
/// # Errors
/// What is no expression, or no bracket.
pub fn bracketed(cursor: &mut Cursor, arena: &mut Arena) -> Result<Value, Fault> {
    let start = arena.ops.len();
    group(cursor, arena, 0)?;
    Ok(code_from(arena, start))
}

fn code_from(arena: &mut Arena, start: usize) -> Value {
    match arena.ops[start..] {
        [Op::Number(number)] => {
            arena.ops.truncate(start);
            arena.places.truncate(start);
            Value::Number(number)
        }
        _ => Value::Code(Slice { start: start as u32, end: arena.ops.len() as u32 }),
    }
}

fn operand(cursor: &mut Cursor, arena: &mut Arena, depth: u32) -> Result<(), Fault> {
    let from = cursor.pos;
    if depth > NESTING_MAX {
        return Err(cursor.fault(Code::BadExpression, from, "nested too deep", "compute a part into a parameter first"));
    }
    match cursor.peek() {
        Some(b'[') => group(cursor, arena, depth + 1),
        Some(b'#') => parameter(cursor, arena, depth + 1),
        Some(b'0'..=b'9' | b'.') => number(cursor, arena),
        Some(b'-' | b'+') if cursor.number_follows_sign() => number(cursor, arena),
        Some(sign @ (b'-' | b'+')) => {
            cursor.pos += 1;
            operand(cursor, arena, depth + 1)?;
            if sign == b'-' {
                arena.push_op(Op::Function(Function::Negate), cursor.span(from, cursor.pos));
            }
            Ok(())
        }
        Some(b'a'..=b'z') => function(cursor, arena, depth + 1),
        _ => Err(cursor.fault(Code::BadExpression, from, "a value is missing here", VALUE)),
    }
}

const VALUE: &str = "write a number, a parameter such as #1 or #<name>, a function such as SIN[30], or an expression in brackets";

fn number(cursor: &mut Cursor, arena: &mut Arena) -> Result<(), Fault> {
    let from = cursor.pos;
    let number = cursor.number()?;
    arena.push_op(Op::Number(number), cursor.span(from, cursor.pos));
    Ok(())
}

fn group(cursor: &mut Cursor, arena: &mut Arena, depth: u32) -> Result<(), Fault> {
    let from = cursor.pos;
    if !cursor.eat(b'[') {
        return Err(cursor.fault(Code::BadExpression, from, "`[` is missing here", "put the expression in brackets"));
    }
    binary(cursor, arena, depth, 0)?;
    if !cursor.eat(b']') {
        let (label, help) = ("`]` or an operator is missing here", OPERATORS);
        let at = if cursor.peek().is_none() { from } else { cursor.pos };
        return Err(cursor.fault(Code::BadExpression, at, label, help));
    }
    Ok(())
}

const OPERATORS: &str = "operators are ** * / MOD + - EQ NE GT GE LT LE AND OR XOR; each `[` needs its `]`";

/// Operators of at least `level`, by precedence climbing.
fn binary(cursor: &mut Cursor, arena: &mut Arena, depth: u32, level: u8) -> Result<(), Fault> {
    operand(cursor, arena, depth + 1)?;
    loop {
        let from = cursor.pos;
        let Ok((rest, operator)) = operator(cursor.rest()) else { return Ok(()) };
        if operator.level() < level {
            return Ok(());
        }
        cursor.pos += cursor.rest().len() - rest.len();
        let place = cursor.span(from, cursor.pos);
        binary(cursor, arena, depth + 1, operator.level() + 1)?;
        arena.push_op(Op::Binary(operator), place);
    }
}

fn operator(input: &[u8]) -> IResult<&[u8], Binary> {
    alt((
        is(Binary::Power, tag(&b"**"[..])),
        is(Binary::Times, tag(&b"*"[..])),
        is(Binary::Divide, tag(&b"/"[..])),
        is(Binary::Plus, tag(&b"+"[..])),
        is(Binary::Minus, tag(&b"-"[..])),
        is(Binary::Modulo, tag(&b"mod"[..])),
        is(Binary::Equal, tag(&b"eq"[..])),
        is(Binary::NotEqual, tag(&b"ne"[..])),
        is(Binary::GreaterEqual, tag(&b"ge"[..])),
        is(Binary::Greater, tag(&b"gt"[..])),
        is(Binary::LessEqual, tag(&b"le"[..])),
        is(Binary::Less, tag(&b"lt"[..])),
        is(Binary::And, tag(&b"and"[..])),
        is(Binary::Or, tag(&b"or"[..])),
        is(Binary::Xor, tag(&b"xor"[..])),
    ))
    .parse(input)
}

fn function_name(input: &[u8]) -> IResult<&[u8], Function> {
    alt((
        is(Function::Abs, tag(&b"abs"[..])),
        is(Function::Acos, tag(&b"acos"[..])),
        is(Function::Asin, tag(&b"asin"[..])),
        is(Function::Cos, tag(&b"cos"[..])),
        is(Function::Exp, tag(&b"exp"[..])),
        is(Function::Fix, tag(&b"fix"[..])),
        is(Function::Fup, tag(&b"fup"[..])),
        is(Function::Ln, tag(&b"ln"[..])),
        is(Function::Round, tag(&b"round"[..])),
        is(Function::Sin, tag(&b"sin"[..])),
        is(Function::Sqrt, tag(&b"sqrt"[..])),
        is(Function::Tan, tag(&b"tan"[..])),
    ))
    .parse(input)
}

fn function(cursor: &mut Cursor, arena: &mut Arena, depth: u32) -> Result<(), Fault> {
    let from = cursor.pos;
    if cursor.rest().starts_with(b"exists[") {
        cursor.pos += 6;
        return exists(cursor, arena, depth);
    }
    if cursor.rest().starts_with(b"atan") {
        cursor.pos += 4;
        return atan(cursor, arena, depth, from);
    }
    let Ok((rest, function)) = function_name(cursor.rest()) else {
        let help = "functions are ABS ACOS ASIN ATAN COS EXISTS EXP FIX FUP LN ROUND SIN SQRT TAN";
        return Err(cursor.fault_word(Code::BadExpression, from, "no function of this name", help));
    };
    cursor.pos += cursor.rest().len() - rest.len();
    group(cursor, arena, depth)?;
    arena.push_op(Op::Function(function), cursor.span(from, cursor.pos));
    Ok(())
}

/// `ATAN[y]/[x]`.
fn atan(cursor: &mut Cursor, arena: &mut Arena, depth: u32, from: usize) -> Result<(), Fault> {
    group(cursor, arena, depth)?;
    if !cursor.eat(b'/') {
        return Err(cursor.fault(Code::BadExpression, from, "ATAN has two arguments", "write ATAN[y]/[x]"));
    }
    group(cursor, arena, depth)?;
    arena.push_op(Op::Atan, cursor.span(from, cursor.pos));
    Ok(())
}

/// `EXISTS[#<name>]` or `EXISTS[#5]`.
fn exists(cursor: &mut Cursor, arena: &mut Arena, depth: u32) -> Result<(), Fault> {
    let from = cursor.pos;
    if !(cursor.eat(b'[') && cursor.eat(b'#')) {
        return Err(cursor.fault(Code::BadExpression, from, "EXISTS asks for a parameter", "write EXISTS[#<name>]"));
    }
    let op = match name(cursor, arena)? {
        Some(name) => Op::Exists(name),
        None => {
            operand(cursor, arena, depth + 1)?;
            Op::ExistsAt
        }
    };
    arena.push_op(op, cursor.span(from, cursor.pos));
    if !cursor.eat(b']') {
        return Err(cursor.fault(Code::BadExpression, from, "`]` is missing", "write EXISTS[#<name>]"));
    }
    Ok(())
}

/// `#5`, `##5`, `#[...]`, `#<name>` as a value.
fn parameter(cursor: &mut Cursor, arena: &mut Arena, depth: u32) -> Result<(), Fault> {
    let from = cursor.pos;
    cursor.pos += 1;
    if let Some(name) = name(cursor, arena)? {
        arena.push_op(Op::Named(name), cursor.span(from, cursor.pos));
        return Ok(());
    }
    let start = arena.ops.len();
    operand(cursor, arena, depth)?;
    let place = cursor.span(from, cursor.pos);
    if let [Op::Number(number)] = arena.ops[start..]
        && let Some(index) = param::index(number)
    {
        arena.ops.truncate(start);
        arena.places.truncate(start);
        arena.push_op(Op::Parameter(index), place);
    } else {
        arena.push_op(Op::ParameterAt, place);
    }
    Ok(())
}

/// `<name>` at the cursor, if there is one.
///
/// # Errors
/// A name that is not closed.
pub fn name(cursor: &mut Cursor, arena: &mut Arena) -> Result<Option<Name>, Fault> {
    let from = cursor.pos;
    if !cursor.eat(b'<') {
        return Ok(None);
    }
    let Some(length) = cursor.rest().iter().position(|&b| b == b'>') else {
        return Err(cursor.fault(Code::BadParameter, from, "the name is not closed", "write #<name>"));
    };
    let bytes = &cursor.rest()[..length];
    if bytes.is_empty() {
        return Err(cursor.fault(Code::BadParameter, from, "the name is empty", "write #<name>"));
    }
    let text = crate::ngc::text::line(bytes);
    if arena.names.is_full() && arena.names.find(&text).is_none() {
        let help = "count with numbered parameters, such as #[100 + #1], in place of many names";
        return Err(cursor.fault(Code::ProgramTooLarge, from, "the program has too many names: 50000, or 4 MiB of them", help));
    }
    let name = arena.names.intern(&text);
    cursor.pos += length + 1;
    Ok(Some(name))
}
