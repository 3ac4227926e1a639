//! Constant values: what is zero, how many parts there are, and exact arithmetic on them (i128 and f64; REAL rounds to f32).

use super::model::Const;
use crate::syntax::ast::BinaryOp;
use std::cmp::Ordering;
use takt_image::Elementary;

/// True if all bytes of the value are zero.
pub(super) fn is_zero(c: &Const) -> bool {
    match c {
        Const::Zero | Const::Int(0) => true,
        Const::Int(_) | Const::Address(..) => false,
        Const::Real(r) => r.to_bits() == 0,
        Const::String(s) => s.is_empty(),
        Const::WString(s) => s.is_empty(),
        Const::Aggregate(parts) => parts.iter().all(is_zero),
    }
}

/// The value, or `Zero` if it is that.
pub(super) fn normal(c: Const) -> Const {
    if is_zero(&c) { Const::Zero } else { c }
}

/// Elements or members as one value.
pub(super) fn aggregate(parts: Vec<Const>) -> Const {
    normal(Const::Aggregate(parts))
}

/// Number of scalars and strings that are stored one by one.
pub(super) fn leaves(c: &Const) -> usize {
    match c {
        Const::Aggregate(parts) => parts.iter().map(leaves).sum(),
        _ => 1,
    }
}

/// Why a constant expression has no value.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum FoldError {
    DivisionByZero,
    Overflow,
}

type Folded = Result<Const, FoldError>;

/// To the precision of the type.
pub(super) fn round(e: Elementary, value: f64) -> f64 {
    if e == Elementary::Real { f64::from(value as f32) } else { value }
}

/// An integer of the type, or an overflow.
pub(super) fn checked(e: Elementary, value: i128) -> Folded {
    let (low, high) = e.int_range().unwrap_or((i128::MIN, i128::MAX));
    if (low..=high).contains(&value) { Ok(Const::Int(value)) } else { Err(FoldError::Overflow) }
}

/// `a op b`, both of storage type `e`; `None` if these are not constants that fold.
pub(super) fn binary(op: BinaryOp, a: &Const, b: &Const, e: Elementary) -> Option<Folded> {
    if let Some((a, b)) = ints(a, b).filter(|_| !e.is_real()) {
        return Some(comparison(op, a.cmp(&b)).map(bool).map_or_else(|| exact(op, a, b).and_then(|v| checked(e, v)), Ok));
    }
    let (a, b) = (real(a)?, real(b)?);
    if let Some(holds) = real_comparison(op, a, b) {
        return Some(Ok(bool(holds)));
    }
    Some(real_arithmetic(op, a, b)?.map(|v| Const::Real(round(e, v))))
}

/// Comparison of two strings.
pub(super) fn strings(op: BinaryOp, a: &Const, b: &Const) -> Option<Const> {
    let order = match (a, b) {
        (Const::String(a), Const::String(b)) => a.cmp(b),
        (Const::WString(a), Const::WString(b)) => a.cmp(b),
        _ => return None,
    };
    comparison(op, order).map(bool)
}

fn bool(b: bool) -> Const {
    Const::Int(i128::from(b))
}

/// The value as an integer; zero counts.
pub(super) fn int(c: &Const) -> Option<i128> {
    match c {
        Const::Int(v) => Some(*v),
        Const::Zero => Some(0),
        _ => None,
    }
}

/// The value as a real; zero counts.
pub(super) fn real(c: &Const) -> Option<f64> {
    match c {
        Const::Real(v) => Some(*v),
        Const::Zero => Some(0.0),
        _ => None,
    }
}

fn ints(a: &Const, b: &Const) -> Option<(i128, i128)> {
    Some((int(a)?, int(b)?))
}

/// Exact integer arithmetic.
pub(super) fn exact(op: BinaryOp, a: i128, b: i128) -> Result<i128, FoldError> {
    use BinaryOp::*;
    if matches!(op, Div | Mod) && b == 0 {
        return Err(FoldError::DivisionByZero);
    }
    let value = match op {
        Add => a.checked_add(b),
        Sub => a.checked_sub(b),
        Mul => a.checked_mul(b),
        Div => a.checked_div(b),
        Mod => a.checked_rem(b),
        Power => u32::try_from(b).ok().and_then(|b| a.checked_pow(b)),
        And | AndThen => Some(a & b),
        Or | OrElse => Some(a | b),
        Xor => Some(a ^ b),
        Eq | Ne | Lt | Gt | Le | Ge => comparison(op, a.cmp(&b)).map(i128::from),
    };
    value.ok_or(FoldError::Overflow)
}

fn comparison(op: BinaryOp, order: Ordering) -> Option<bool> {
    Some(match op {
        BinaryOp::Eq => order.is_eq(),
        BinaryOp::Ne => order.is_ne(),
        BinaryOp::Lt => order.is_lt(),
        BinaryOp::Gt => order.is_gt(),
        BinaryOp::Le => order.is_le(),
        BinaryOp::Ge => order.is_ge(),
        _ => return None,
    })
}

/// With NaN only `<>` holds.
fn real_comparison(op: BinaryOp, a: f64, b: f64) -> Option<bool> {
    match a.partial_cmp(&b) {
        Some(order) => comparison(op, order),
        None => comparison(op, Ordering::Equal).map(|_| op == BinaryOp::Ne),
    }
}

fn real_arithmetic(op: BinaryOp, a: f64, b: f64) -> Option<Result<f64, FoldError>> {
    Some(match op {
        BinaryOp::Add => Ok(a + b),
        BinaryOp::Sub => Ok(a - b),
        BinaryOp::Mul => Ok(a * b),
        BinaryOp::Div if b == 0.0 => Err(FoldError::DivisionByZero),
        BinaryOp::Div => Ok(a / b),
        _ => return None,
    })
}

/// The value of the bits that the type stores.
pub(super) fn low_bits(value: i128, e: Elementary) -> i128 {
    let shift = 128 - e.bits();
    if e.is_signed_storage() { (value << shift) >> shift } else { (((value as u128) << shift) >> shift) as i128 }
}
