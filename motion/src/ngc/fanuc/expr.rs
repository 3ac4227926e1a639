//! Expressions of macro B: text to postfix code, and its value. A variable may be vacant (`None`); sums take it as 0, EQ and NE tell it
//! from 0. Runs: background. The depth of nesting is bounded.

use super::vars::{self, View};
use crate::ngc::expr::NESTING_MAX;
use crate::ngc::fault::Fault;
use crate::ngc::reader::cursor::Cursor;
use takt_base::Code;

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

/// Operands; kept between calls.
pub type Stack = Vec<Option<f64>>;

/// The number of `value`, `None` if it is that of a vacant variable.
///
/// # Errors
/// Division by zero, an argument out of range, a variable that can't be read.
pub fn eval(value: Value, ops: &Ops, view: &View, stack: &mut Stack) -> Result<Option<f64>, Fault> {
    let (start, end) = match value {
        Value::Number(number) => return Ok(Some(number)),
        Value::Code(start, end) => (start as usize, end as usize),
    };
    stack.clear();
    for i in start..end.min(ops.len()) {
        step(ops.code[i], view, stack).map_err(|(code, label, help)| {
            let (from, to) = ops.places[i];
            Fault::at(code, from, to, label, help)
        })?;
    }
    let result = stack.pop().flatten();
    if result.is_some_and(|v| !(v.abs() <= 1e15)) {
        let (from, to) = ops.places[end - 1];
        let help = "check the values that the expression uses";
        return Err(Fault::at(Code::CalculationFault, from, to, "the result is no number, or too large", help));
    }
    Ok(result)
}

type Why = (Code, String, &'static str);

fn step(op: Op, view: &View, stack: &mut Stack) -> Result<(), Why> {
    let pop = |stack: &mut Stack| stack.pop().flatten();
    let result = match op {
        Op::Number(number) => Some(number),
        Op::Variable(number) => view.get(number)?,
        Op::VariableAt => {
            let number = pop(stack).unwrap_or(0.0);
            let found = vars::number(number);
            view.get(found.ok_or_else(|| (Code::BadVariable, format!("no variable has the number {number}"), vars::NUMBERS))?)?
        }
        Op::Binary(operator) => {
            let (y, x) = (pop(stack), pop(stack));
            Some(combine(operator, x, y)?)
        }
        Op::Function(Function::RoundIncrement) => {
            let per_unit = if view.inches() { 1e4 } else { 1e3 };
            pop(stack).map(|x| (x * per_unit).round() / per_unit)
        }
        Op::Function(function) => Some(apply(function, pop(stack).unwrap_or(0.0))?),
        Op::Atan => {
            let (x, y) = (pop(stack).unwrap_or(0.0), pop(stack).unwrap_or(0.0));
            Some(libm::atan2(y, x).to_degrees())
        }
        Op::Power => {
            let (y, x) = (pop(stack).unwrap_or(0.0), pop(stack).unwrap_or(0.0));
            Some(libm::pow(x, y)).filter(|v| v.is_finite())
                .ok_or_else(|| refuse("POW has no result", "a negative number needs a whole power"))?
                .into()
        }
    };
    stack.push(result);
    Ok(())
}

fn refuse(label: &str, help: &'static str) -> Why {
    (Code::CalculationFault, label.to_owned(), help)
}

fn apply(function: Function, x: f64) -> Result<f64, Why> {
    Ok(match function {
        Function::Sin => libm::sin(x.to_radians()),
        Function::Cos => libm::cos(x.to_radians()),
        Function::Tan => libm::tan(x.to_radians()),
        Function::Asin | Function::Acos if x.abs() > 1.0 => {
            return Err(refuse("the argument is above 1", "ASIN and ACOS take -1 to 1"));
        }
        Function::Asin => libm::asin(x).to_degrees(),
        Function::Acos => libm::acos(x).to_degrees(),
        Function::Sqrt if x < 0.0 => return Err(refuse("SQRT of a negative number", "the argument is 0 or more")),
        Function::Sqrt => x.sqrt(),
        Function::Abs => x.abs(),
        Function::Round | Function::RoundIncrement => x.round(),
        Function::Fix => x.trunc(),
        Function::Fup => if x < 0.0 { x.floor() } else { x.ceil() },
        Function::Ln if x <= 0.0 => return Err(refuse("LN of zero or less", "the argument is above 0")),
        Function::Ln => libm::log(x),
        Function::Exp => libm::exp(x),
        Function::Bin => from_bcd(x).ok_or_else(|| refuse("not a number in BCD", "each four bits hold a digit from 0 to 9"))?,
        Function::Bcd => to_bcd(x).ok_or_else(|| refuse("no BCD form", "BCD takes whole numbers from 0 to 99999999"))?,
        Function::Negate => -x,
    })
}

fn from_bcd(x: f64) -> Option<f64> {
    let mut bits = whole_bits(x)?;
    let (mut value, mut weight) = (0.0, 1.0);
    while bits > 0 {
        let digit = bits & 15;
        if digit > 9 {
            return None;
        }
        value += f64::from(digit) * weight;
        weight *= 10.0;
        bits >>= 4;
    }
    Some(value)
}

fn to_bcd(x: f64) -> Option<f64> {
    let mut rest = whole_bits(x).filter(|&n| n <= 99_999_999)?;
    let (mut bits, mut shift) = (0_u32, 0);
    while rest > 0 {
        bits |= (rest % 10) << shift;
        rest /= 10;
        shift += 4;
    }
    Some(f64::from(bits))
}

fn whole_bits(x: f64) -> Option<u32> {
    let near = x.round();
    (0.0..=f64::from(u32::MAX)).contains(&near).then_some(near as u32)
}

fn combine(operator: Binary, a: Option<f64>, b: Option<f64>) -> Result<f64, Why> {
    let (x, y) = (a.unwrap_or(0.0), b.unwrap_or(0.0));
    let truth = |holds: bool| f64::from(u8::from(holds));
    let bits = |f: fn(u32, u32) -> u32| match (whole_bits(x), whole_bits(y)) {
        (Some(x), Some(y)) => Ok(f64::from(f(x, y))),
        _ => Err(refuse("AND, OR and XOR work on whole numbers", "write comparisons in brackets: [#1 EQ 1] AND [#2 EQ 2]")),
    };
    Ok(match operator {
        Binary::Plus => x + y,
        Binary::Minus => x - y,
        Binary::Times => x * y,
        Binary::Divide if y == 0.0 => return Err(refuse("division by zero", "make sure that the divisor is not 0")),
        Binary::Divide => x / y,
        Binary::Modulo if y.round() == 0.0 => return Err(refuse("MOD by zero", "make sure that the divisor is not 0")),
        Binary::Modulo => libm::fmod(x.round(), y.round()),
        Binary::And => bits(|x, y| x & y)?,
        Binary::Or => bits(|x, y| x | y)?,
        Binary::Xor => bits(|x, y| x ^ y)?,
        // A vacant variable equals a vacant one and no number.
        Binary::Equal => truth(a == b),
        Binary::NotEqual => truth(a != b),
        Binary::Greater => truth(x > y),
        Binary::GreaterEqual => truth(x >= y),
        Binary::Less => truth(x < y),
        Binary::LessEqual => truth(x <= y),
    })
}
