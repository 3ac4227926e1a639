//! Transcendental functions. REAL is computed in f64 and rounded once; every NaN is the same NaN, so results agree bit for bit
//! between machines and engines. From: library reference §3.
//! Runs: cyclic.

use super::{Run, Types};
use crate::lookup::ConversionType;
use takt_image::{Elementary, NativeCall, Trap};

/// Code by catalogue name.
pub(super) const RUNS: &[(&str, Run)] = &[
    ("LN", |call, types| unary(call, types, libm::log)),
    ("LOG", |call, types| unary(call, types, libm::log10)),
    ("EXP", |call, types| unary(call, types, libm::exp)),
    ("SIN", |call, types| unary(call, types, libm::sin)),
    ("COS", |call, types| unary(call, types, libm::cos)),
    ("TAN", |call, types| unary(call, types, libm::tan)),
    ("ASIN", |call, types| unary(call, types, libm::asin)),
    ("ACOS", |call, types| unary(call, types, libm::acos)),
    ("ATAN", |call, types| unary(call, types, libm::atan)),
    ("ATAN2", |call, types| binary(call, types, libm::atan2)),
];

fn unary(call: &mut NativeCall, types: Types, f: fn(f64) -> f64) -> Result<(), Trap> {
    let x = number(call, types, 0);
    give(call, types, f(x))
}

/// Slots: two numbers of type T.
pub(super) fn binary(call: &mut NativeCall, types: Types, f: fn(f64, f64) -> f64) -> Result<(), Trap> {
    let (a, b) = (number(call, types, 0), number(call, types, 1));
    give(call, types, f(a, b))
}

fn is_real(types: Types) -> bool {
    types.to == ConversionType::Elementary(Elementary::Real)
}

fn number(call: &NativeCall, types: Types, slot: usize) -> f64 {
    if is_real(types) { f64::from(call.f32(slot)) } else { call.f64(slot) }
}

fn give(call: &mut NativeCall, types: Types, value: f64) -> Result<(), Trap> {
    let value = if value.is_nan() { f64::NAN } else { value };
    if !value.is_finite() || (is_real(types) && (value as f32).is_infinite()) {
        call.fail();
    }
    call.result = if is_real(types) { u64::from((value as f32).to_bits()) } else { value.to_bits() };
    Ok(())
}
