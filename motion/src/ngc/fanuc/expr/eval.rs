//! The value of an expression: postfix code on a stack of numbers and vacant places.

use super::super::vars::{self, View};
use super::{Binary, Function, Op, Ops, Value};
use crate::ngc::fault::Fault;
use takt_base::Code;

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
    if result.is_some_and(|v| v.is_nan() || v.abs() > 1e15) {
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
            Some(libm::pow(x, y))
                .filter(|v| v.is_finite())
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
        Function::Fup => {
            if x < 0.0 {
                x.floor()
            } else {
                x.ceil()
            }
        }
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
