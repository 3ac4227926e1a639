//! Expressions of macro B: text to postfix code, and its value. A variable may be vacant (`None`); sums take it as 0, EQ and NE tell it
//! from 0. Runs: background. The depth of nesting is bounded.

use super::vars;
use crate::ngc::expr::NESTING_MAX;
use crate::ngc::fault::Fault;
use crate::ngc::reader::cursor::Cursor;
use takt_base::Code;

mod eval;

pub use eval::{Stack, eval};

/// Operators; those of a higher level bind first: `* / AND MOD`, `+ - OR XOR`, comparisons.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[allow(missing_docs)]
pub enum Binary {
    Times,
    Divide,
    Modulo,
    And,
    Plus,
    Minus,
    Or,
    Xor,
    Equal,
    NotEqual,
    Greater,
    GreaterEqual,
    Less,
    LessEqual,
}

impl Binary {
    const fn level(self) -> u8 {
        match self {
            Binary::Times | Binary::Divide | Binary::Modulo | Binary::And => 3,
            Binary::Plus | Binary::Minus | Binary::Or | Binary::Xor => 2,
            _ => 1,
        }
    }
}

const OPERATORS: [(&[u8], Binary); 14] = [
    (b"*", Binary::Times),
    (b"/", Binary::Divide),
    (b"+", Binary::Plus),
    (b"-", Binary::Minus),
    (b"mod", Binary::Modulo),
    (b"and", Binary::And),
    (b"xor", Binary::Xor),
    (b"or", Binary::Or),
    (b"eq", Binary::Equal),
    (b"ne", Binary::NotEqual),
    (b"ge", Binary::GreaterEqual),
    (b"gt", Binary::Greater),
    (b"le", Binary::LessEqual),
    (b"lt", Binary::Less),
];

/// Functions of one argument; angles in degrees.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[allow(missing_docs)]
pub enum Function {
    Sin,
    Cos,
    Tan,
    Asin,
    Acos,
    Sqrt,
    Abs,
    Round,
    /// ROUND in the value of an address: to the least input increment.
    RoundIncrement,
    Fix,
    Fup,
    Ln,
    Exp,
    Bin,
    Bcd,
    Negate,
}

/// Names, longer ones before their beginnings; some have a short form.
const FUNCTIONS: [(&[u8], Function); 20] = [
    (b"sin[", Function::Sin),
    (b"cos[", Function::Cos),
    (b"tan[", Function::Tan),
    (b"asin[", Function::Asin),
    (b"asn[", Function::Asin),
    (b"acos[", Function::Acos),
    (b"acs[", Function::Acos),
    (b"sqrt[", Function::Sqrt),
    (b"sqr[", Function::Sqrt),
    (b"abs[", Function::Abs),
    (b"round[", Function::Round),
    (b"rnd[", Function::Round),
    (b"fix[", Function::Fix),
    (b"fup[", Function::Fup),
    (b"ln[", Function::Ln),
    (b"exp[", Function::Exp),
    (b"bin[", Function::Bin),
    (b"bcd[", Function::Bcd),
    (b"adp[", Function::Abs),
    (b"prm[", Function::Abs),
];

/// One step of postfix code.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Op {
    /// Push a number.
    Number(f64),
    /// Push a variable.
    Variable(u32),
    /// Replace the top by the variable of this number.
    VariableAt,
    /// Two operands to one.
    Binary(Binary),
    /// One operand to one.
    Function(Function),
    /// `ATAN[y]/[x]` or `ATAN[y, x]`.
    Atan,
    /// `POW[x, y]`.
    Power,
}

/// A number, or the postfix code that computes it.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Value {
    /// Known when the row is read.
    Number(f64),
    /// A range of [`Ops`].
    Code(u32, u32),
}

/// Postfix code of a row.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Ops {
    code: Vec<Op>,
    places: Vec<(u32, u32)>,
}

impl Ops {
    /// Forgets all.
    pub fn clear(&mut self) {
        self.code.clear();
        self.places.clear();
    }

    /// Number of ops.
    pub fn len(&self) -> usize {
        self.code.len()
    }

    /// No ops.
    pub fn is_empty(&self) -> bool {
        self.code.is_empty()
    }

    fn push(&mut self, op: Op, place: (u32, u32)) {
        self.code.push(op);
        self.places.push(place);
    }
}

/// Reads a value at the cursor: a number, a variable, a bracket, a function, each with signs before it.
///
/// # Errors
/// What is no value.
pub fn value(cursor: &mut Cursor, ops: &mut Ops, address: bool) -> Result<Value, Fault> {
    if let Some(number) = cursor.plain_number()? {
        return Ok(Value::Number(number));
    }
    let start = ops.len();
    operand(cursor, ops, 0, address)?;
    Ok(code_from(ops, start))
}

/// A whole expression without brackets around it, as behind `#1 =`.
///
/// # Errors
/// What is no expression.
pub fn expression(cursor: &mut Cursor, ops: &mut Ops) -> Result<Value, Fault> {
    let start = ops.len();
    binary(cursor, ops, 0, 0, false)?;
    Ok(code_from(ops, start))
}

/// An expression in brackets, as a condition.
///
/// # Errors
/// What is none.
pub fn condition(cursor: &mut Cursor, ops: &mut Ops) -> Result<Value, Fault> {
    let start = ops.len();
    group(cursor, ops, 0, false)?;
    Ok(code_from(ops, start))
}

fn code_from(ops: &mut Ops, start: usize) -> Value {
    match ops.code[start..] {
        [Op::Number(number)] => {
            ops.code.truncate(start);
            ops.places.truncate(start);
            Value::Number(number)
        }
        _ => Value::Code(start as u32, ops.len() as u32),
    }
}

fn bad(cursor: &Cursor, at: usize, label: &str) -> Fault {
    cursor.fault(Code::BadExpression, at, label, HELP)
}

const HELP: &str = "write numbers, #1, [..] and functions (SIN COS TAN ASIN ACOS ATAN SQRT ABS ROUND FIX FUP LN EXP POW BIN BCD) with \
* / MOD AND + - OR XOR EQ NE GT GE LT LE between them";

fn operand(cursor: &mut Cursor, ops: &mut Ops, depth: u32, address: bool) -> Result<(), Fault> {
    let from = cursor.pos;
    if depth > NESTING_MAX {
        return Err(cursor.fault(Code::BadExpression, from, "nested too deep", "compute a part into a variable first"));
    }
    match cursor.peek() {
        Some(b'[') => group(cursor, ops, depth + 1, address),
        Some(b'#') => variable(cursor, ops, depth + 1),
        Some(b'0'..=b'9' | b'.') => {
            let number = cursor.number()?;
            ops.push(Op::Number(number), cursor.span(from, cursor.pos));
            Ok(())
        }
        Some(sign @ (b'-' | b'+')) => {
            cursor.pos += 1;
            operand(cursor, ops, depth + 1, address)?;
            if sign == b'-' {
                ops.push(Op::Function(Function::Negate), cursor.span(from, cursor.pos));
            }
            Ok(())
        }
        Some(b'a'..=b'z') => function(cursor, ops, depth + 1, address),
        _ => Err(bad(cursor, from, "a value is missing here")),
    }
}

fn variable(cursor: &mut Cursor, ops: &mut Ops, depth: u32) -> Result<(), Fault> {
    let from = cursor.pos;
    cursor.pos += 1;
    let start = ops.len();
    operand(cursor, ops, depth, false)?;
    let place = cursor.span(from, cursor.pos);
    match ops.code[start..] {
        [Op::Number(number)] if vars::number(number).is_some() => {
            ops.code.truncate(start);
            ops.places.truncate(start);
            ops.push(Op::Variable(vars::number(number).unwrap_or(0)), place);
        }
        _ => ops.push(Op::VariableAt, place),
    }
    Ok(())
}

fn group(cursor: &mut Cursor, ops: &mut Ops, depth: u32, address: bool) -> Result<(), Fault> {
    let from = cursor.pos;
    if !cursor.eat(b'[') {
        return Err(bad(cursor, from, "`[` is missing here"));
    }
    binary(cursor, ops, depth, 0, address)?;
    close(cursor, from)
}

fn close(cursor: &mut Cursor, from: usize) -> Result<(), Fault> {
    if cursor.eat(b']') {
        return Ok(());
    }
    let at = if cursor.peek().is_none() { from } else { cursor.pos };
    Err(bad(cursor, at, "`]` or an operator is missing here"))
}

fn binary(cursor: &mut Cursor, ops: &mut Ops, depth: u32, level: u8, address: bool) -> Result<(), Fault> {
    operand(cursor, ops, depth + 1, address)?;
    loop {
        let from = cursor.pos;
        let rest = cursor.rest();
        let Some(&(text, operator)) = OPERATORS.iter().find(|(text, _)| rest.starts_with(text)) else { return Ok(()) };
        if operator.level() < level {
            return Ok(());
        }
        cursor.pos += text.len();
        let place = cursor.span(from, cursor.pos);
        binary(cursor, ops, depth + 1, operator.level() + 1, address)?;
        ops.push(Op::Binary(operator), place);
    }
}

fn function(cursor: &mut Cursor, ops: &mut Ops, depth: u32, address: bool) -> Result<(), Fault> {
    let from = cursor.pos;
    let rest = cursor.rest();
    for (name, op) in [(&b"atan"[..], Op::Atan), (&b"atn"[..], Op::Atan), (&b"pow"[..], Op::Power)] {
        if rest.starts_with(name) && rest.get(name.len()) == Some(&b'[') {
            cursor.pos += name.len() + 1;
            return two_arguments(cursor, ops, depth, op, from);
        }
    }
    let Some(&(name, function)) = FUNCTIONS.iter().find(|(name, _)| rest.starts_with(name)) else {
        return Err(cursor.fault_word(Code::BadExpression, from, "no function of this name", HELP));
    };
    if matches!(name, b"adp[" | b"prm[") {
        let help = "write the number itself; there are no control parameters here";
        return Err(cursor.fault_word(Code::NotOfThisControl, from, "ADP and PRM read the control's own parameters", help));
    }
    cursor.pos += name.len() - 1;
    group(cursor, ops, depth, false)?;
    let function = if address && function == Function::Round { Function::RoundIncrement } else { function };
    ops.push(Op::Function(function), cursor.span(from, cursor.pos));
    Ok(())
}

/// `[a, b]` or `[a]/[b]`; the bracket is open. ATAN with one argument is the plain arc tangent.
fn two_arguments(cursor: &mut Cursor, ops: &mut Ops, depth: u32, op: Op, from: usize) -> Result<(), Fault> {
    binary(cursor, ops, depth, 0, false)?;
    if cursor.eat(b',') {
        binary(cursor, ops, depth, 0, false)?;
        close(cursor, from)?;
    } else {
        close(cursor, from)?;
        let divided = op == Op::Atan && cursor.peek() == Some(b'/') && cursor.bytes.get(cursor.pos + 1) == Some(&b'[');
        if divided {
            cursor.pos += 1;
            group(cursor, ops, depth, false)?;
        } else if op == Op::Atan {
            ops.push(Op::Number(1.0), cursor.span(from, cursor.pos));
        } else {
            return Err(bad(cursor, from, "POW has two arguments: POW[#1,2]"));
        }
    }
    ops.push(op, cursor.span(from, cursor.pos));
    Ok(())
}
