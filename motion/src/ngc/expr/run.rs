//! Executes postfix code. Angles in degrees; comparisons of EQ and NE to within 0.0001, as LinuxCNC has them.

use super::{Binary, Function, Op, Slice, Value};
use crate::ngc::code::Code as Arena;
use crate::ngc::fault::Fault;
use crate::ngc::param;
use crate::ngc::state::State as View;
use takt_base::Code;

/// Largest difference at which EQ holds.
const EQUAL: f64 = 1e-4;

/// Operands; kept between calls, so that it does not allocate again.
pub type Stack = Vec<f64>;

/// The number of `value`.
///
/// # Errors
/// Division by zero, an argument out of range, a parameter that does not exist, a result that is no number.
pub fn value(value: Value, arena: &Arena, view: &View, stack: &mut Stack) -> Result<f64, Fault> {
    match value {
        Value::Number(number) => Ok(number),
        Value::Code(slice) => code(slice, arena, view, stack),
    }
}

fn code(slice: Slice, arena: &Arena, view: &View, stack: &mut Stack) -> Result<f64, Fault> {
    stack.clear();
    for (i, op) in arena.ops[slice.range()].iter().enumerate() {
        step(*op, arena, view, stack).map_err(|(code, label, help)| {
            let (start, end) = arena.places[slice.start as usize + i];
            Fault::at(code, start, end, label, help)
        })?;
    }
    let result = stack.pop().unwrap_or(0.0);
    if result.is_finite() {
        return Ok(result);
    }
    let (start, end) = whole(slice, arena);
    let label = if result.is_nan() { "the result is not a number" } else { "the result is infinite" };
    Err(Fault::at(Code::CalculationFault, start, end, label, "check the values that the expression uses"))
}

/// From the first to the last byte of the code.
fn whole(slice: Slice, arena: &Arena) -> (u32, u32) {
    let places = &arena.places[slice.range()];
    let start = places.iter().map(|p| p.0).min().unwrap_or(0);
    (start, places.iter().map(|p| p.1).max().unwrap_or(start))
}

type Why = (Code, &'static str, &'static str);

fn step(op: Op, arena: &Arena, view: &View, stack: &mut Stack) -> Result<(), Why> {
    match op {
        Op::Number(number) => stack.push(number),
        Op::Parameter(index) => stack.push(view.numbered(index)),
        Op::Named(name) => stack.push(view.named(name, arena).ok_or((
            Code::BadParameter,
            "no parameter of this name has a value",
            "give it a value first, such as #<name> = 1; a name without `_` is local to its subroutine",
        ))?),
        Op::Exists(name) => stack.push(f64::from(u8::from(view.exists(name, arena)))),
        Op::ParameterAt => unary(stack, |number| match param::index(number) {
            Some(index) => Ok(view.numbered(index)),
            None => Err((Code::BadParameter, "no parameter has this number", "numbers are whole, from 1 to 5601")),
        })?,
        Op::ExistsAt => unary(stack, |number| Ok(f64::from(u8::from(param::index(number).is_some()))))?,
        Op::Function(function) => unary(stack, |x| apply(function, x))?,
        Op::Binary(operator) => binary(stack, |x, y| combine(operator, x, y))?,
        Op::Atan => binary(stack, |y, x| Ok(libm::atan2(y, x).to_degrees()))?,
    }
    Ok(())
}

fn unary(stack: &mut Stack, f: impl FnOnce(f64) -> Result<f64, Why>) -> Result<(), Why> {
    if let Some(top) = stack.last_mut() {
        *top = f(*top)?;
    }
    Ok(())
}

fn binary(stack: &mut Stack, f: impl FnOnce(f64, f64) -> Result<f64, Why>) -> Result<(), Why> {
    let right = stack.pop().unwrap_or(0.0);
    unary(stack, |left| f(left, right))
}

fn apply(function: Function, x: f64) -> Result<f64, Why> {
    let refuse = |label, help| Err((Code::CalculationFault, label, help));
    Ok(match function {
        Function::Abs => x.abs(),
        Function::Negate => -x,
        Function::Acos if x.abs() > 1.0 => return refuse("ACOS of a number above 1", "the argument is from -1 to 1"),
        Function::Asin if x.abs() > 1.0 => return refuse("ASIN of a number above 1", "the argument is from -1 to 1"),
        Function::Acos => libm::acos(x).to_degrees(),
        Function::Asin => libm::asin(x).to_degrees(),
        Function::Cos => libm::cos(x.to_radians()),
        Function::Sin => libm::sin(x.to_radians()),
        Function::Tan => libm::tan(x.to_radians()),
        Function::Exp => libm::exp(x),
        Function::Fix => x.floor(),
        Function::Fup => x.ceil(),
        Function::Round => x.round(),
        Function::Ln if x <= 0.0 => return refuse("LN of zero or less", "the argument is above 0"),
        Function::Ln => libm::log(x),
        Function::Sqrt if x < 0.0 => return refuse("SQRT of a negative number", "the argument is 0 or more"),
        Function::Sqrt => x.sqrt(),
    })
}

fn combine(operator: Binary, x: f64, y: f64) -> Result<f64, Why> {
    let truth = |holds: bool| f64::from(u8::from(holds));
    let refuse = |label, help| Err((Code::CalculationFault, label, help));
    Ok(match operator {
        Binary::Plus => x + y,
        Binary::Minus => x - y,
        Binary::Times => x * y,
        Binary::Divide if y == 0.0 => return refuse("division by zero", "make sure that the divisor is not 0"),
        Binary::Divide => x / y,
        Binary::Modulo => modulo(x, y),
        Binary::Power if x < 0.0 && y.floor() != y => {
            return refuse("a negative number to a power that is not whole", "the result would not be a real number");
        }
        Binary::Power => libm::pow(x, y),
        Binary::Equal => truth((x - y).abs() < EQUAL),
        Binary::NotEqual => truth((x - y).abs() >= EQUAL),
        Binary::Greater => truth(x > y),
        Binary::GreaterEqual => truth(x >= y),
        Binary::Less => truth(x < y),
        Binary::LessEqual => truth(x <= y),
        Binary::And => truth(x != 0.0 && y != 0.0),
        Binary::Or => truth(x != 0.0 || y != 0.0),
        Binary::Xor => truth((x != 0.0) != (y != 0.0)),
    })
}

/// The remainder that is never negative.
fn modulo(x: f64, y: f64) -> f64 {
    let rest = libm::fmod(x, y);
    if rest < 0.0 { rest + y.abs() } else { rest }
}
