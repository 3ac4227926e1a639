//! Arithmetic of the interpreter. A register is a `u64` whose bits above the type's width are zero; floats are their bits.

use crate::mir::model::{BinaryOp, Compare, Convert, UnaryOp};
use crate::mir::ops::{mask, signed, width};
use takt_image::{Scalar, Trap};

/// `op a`.
pub(super) fn unary(op: UnaryOp, ty: Scalar, a: u64) -> u64 {
    match op {
        UnaryOp::Neg => mask(ty, a.wrapping_neg()),
        UnaryOp::Not => mask(ty, !a),
        UnaryOp::SwapBytes => a.swap_bytes() >> (64 - width(ty)),
        UnaryOp::FNeg => a ^ (1 << (width(ty) - 1)),
        UnaryOp::FAbs => a & !(1 << (width(ty) - 1)),
        _ if ty == Scalar::F32 => u64::from(unary_f32(op, f32::from_bits(a as u32)).to_bits()),
        _ => unary_f64(op, f64::from_bits(a)).to_bits(),
    }
}

fn unary_f32(op: UnaryOp, a: f32) -> f32 {
    match op {
        UnaryOp::FSqrt => a.sqrt(),
        UnaryOp::FNearest => a.round_ties_even(),
        UnaryOp::FTrunc => a.trunc(),
        UnaryOp::FFloor => a.floor(),
        UnaryOp::FCeil => a.ceil(),
        _ => a,
    }
}

fn unary_f64(op: UnaryOp, a: f64) -> f64 {
    match op {
        UnaryOp::FSqrt => a.sqrt(),
        UnaryOp::FNearest => a.round_ties_even(),
        UnaryOp::FTrunc => a.trunc(),
        UnaryOp::FFloor => a.floor(),
        UnaryOp::FCeil => a.ceil(),
        _ => a,
    }
}

/// `a op b`. Traps on division by zero.
pub(super) fn binary(op: BinaryOp, ty: Scalar, a: u64, b: u64) -> Result<u64, Trap> {
    if op.is_float() {
        return Ok(match ty {
            Scalar::F32 => u64::from(binary_f32(op, f32::from_bits(a as u32), f32::from_bits(b as u32)).to_bits()),
            _ => binary_f64(op, f64::from_bits(a), f64::from_bits(b)).to_bits(),
        });
    }
    if b == 0 && matches!(op, BinaryOp::SDiv | BinaryOp::UDiv | BinaryOp::SRem | BinaryOp::URem) {
        return Err(Trap::DivisionByZero);
    }
    Ok(mask(ty, integer(op, ty, a, b)))
}

fn binary_f32(op: BinaryOp, a: f32, b: f32) -> f32 {
    match op {
        BinaryOp::FAdd => a + b,
        BinaryOp::FSub => a - b,
        BinaryOp::FMul => a * b,
        _ => a / b,
    }
}

fn binary_f64(op: BinaryOp, a: f64, b: f64) -> f64 {
    match op {
        BinaryOp::FAdd => a + b,
        BinaryOp::FSub => a - b,
        BinaryOp::FMul => a * b,
        _ => a / b,
    }
}

/// Integer operation; bits above the width are still to be cleared. The divisor is not 0.
fn integer(op: BinaryOp, ty: Scalar, a: u64, b: u64) -> u64 {
    let (sa, sb) = (signed(ty, a), signed(ty, b));
    let amount = (b as u32) & (width(ty) - 1);
    match op {
        BinaryOp::Add => a.wrapping_add(b),
        BinaryOp::Sub => a.wrapping_sub(b),
        BinaryOp::Mul => a.wrapping_mul(b),
        BinaryOp::SDiv => sa.wrapping_div(sb) as u64,
        BinaryOp::UDiv => a.checked_div(b).unwrap_or(0),
        BinaryOp::SRem => sa.wrapping_rem(sb) as u64,
        BinaryOp::URem => a.checked_rem(b).unwrap_or(0),
        BinaryOp::And => a & b,
        BinaryOp::Or => a | b,
        BinaryOp::Xor => a ^ b,
        BinaryOp::Shl => a << amount,
        BinaryOp::LShr => a >> amount,
        BinaryOp::AShr => (sa >> amount) as u64,
        BinaryOp::Rotl => rotate_left(ty, a, amount),
        BinaryOp::Rotr => rotate_left(ty, a, (width(ty) - amount) & (width(ty) - 1)),
        BinaryOp::FAdd | BinaryOp::FSub | BinaryOp::FMul | BinaryOp::FDiv => a,
    }
}

fn rotate_left(ty: Scalar, a: u64, amount: u32) -> u64 {
    if amount == 0 { a } else { a << amount | a >> (width(ty) - amount) }
}

/// `a cmp b`.
pub(super) fn compare(op: Compare, ty: Scalar, a: u64, b: u64) -> bool {
    let (sa, sb) = (signed(ty, a), signed(ty, b));
    match op {
        Compare::Eq => a == b,
        Compare::Ne => a != b,
        Compare::SLt => sa < sb,
        Compare::SLe => sa <= sb,
        Compare::SGt => sa > sb,
        Compare::SGe => sa >= sb,
        Compare::ULt => a < b,
        Compare::ULe => a <= b,
        Compare::UGt => a > b,
        Compare::UGe => a >= b,
        Compare::FEq | Compare::FNe | Compare::FLt | Compare::FLe | Compare::FGt | Compare::FGe => {
            compare_floats(op, float(ty, a), float(ty, b))
        }
    }
}

fn compare_floats(op: Compare, a: f64, b: f64) -> bool {
    match op {
        Compare::FEq => a == b,
        Compare::FNe => a != b,
        Compare::FLt => a < b,
        Compare::FLe => a <= b,
        Compare::FGt => a > b,
        _ => a >= b,
    }
}

/// The value of a float register; widening is exact.
fn float(ty: Scalar, a: u64) -> f64 {
    if ty == Scalar::F32 { f64::from(f32::from_bits(a as u32)) } else { f64::from_bits(a) }
}

/// Converts a register of type `from` to type `to`.
pub(super) fn convert(op: Convert, from: Scalar, to: Scalar, a: u64) -> u64 {
    match op {
        Convert::SignExtend => mask(to, signed(from, a) as u64),
        Convert::ZeroExtend | Convert::Bits => a,
        Convert::Truncate => mask(to, a),
        Convert::SignedToFloat if to == Scalar::F32 => u64::from((signed(from, a) as f32).to_bits()),
        Convert::SignedToFloat => (signed(from, a) as f64).to_bits(),
        Convert::UnsignedToFloat if to == Scalar::F32 => u64::from((a as f32).to_bits()),
        Convert::UnsignedToFloat => (a as f64).to_bits(),
        Convert::FloatToSigned => mask(to, to_signed(to, float(from, a)) as u64),
        Convert::FloatToUnsigned => to_unsigned(to, float(from, a)),
        Convert::Float if to == Scalar::F32 => u64::from((f64::from_bits(a) as f32).to_bits()),
        Convert::Float => f64::from(f32::from_bits(a as u32)).to_bits(),
    }
}

/// `as` saturates and takes NaN to 0, as wanted.
fn to_signed(to: Scalar, value: f64) -> i64 {
    match to {
        Scalar::I8 => i64::from(value as i8),
        Scalar::I16 => i64::from(value as i16),
        Scalar::I32 => i64::from(value as i32),
        _ => value as i64,
    }
}

fn to_unsigned(to: Scalar, value: f64) -> u64 {
    match to {
        Scalar::I8 => u64::from(value as u8),
        Scalar::I16 => u64::from(value as u16),
        Scalar::I32 => u64::from(value as u32),
        _ => value as u64,
    }
}
