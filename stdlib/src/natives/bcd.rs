//! Binary-coded decimal: a digit in each four bits. From: library reference §2.5, §9.
//! Runs: cyclic.

use super::numbers::extend;
use super::{Run, Types};
use crate::lookup::ConversionType;
use takt_image::{NativeCall, Trap};

/// Code by catalogue name.
pub(super) const RUNS: &[(&str, Run)] = &[
    ("BYTE_BCD_TO_USINT", |call, _| to_number(call, 2)),
    ("WORD_BCD_TO_UINT", |call, _| to_number(call, 4)),
    ("DWORD_BCD_TO_UDINT", |call, _| to_number(call, 8)),
    ("LWORD_BCD_TO_ULINT", |call, _| to_number(call, 16)),
    ("BCD_TO_USINT", |call, _| to_number(call, 2)),
    ("BCD_TO_UINT", |call, _| to_number(call, 4)),
    ("BCD_TO_UDINT", |call, _| to_number(call, 8)),
    ("BCD_TO_ULINT", |call, _| to_number(call, 16)),
    ("BCD_TO_INT", |call, _| to_number(call, 2)),
    ("WORD_BCD_TO_INT", |call, _| to_number(call, 4)),
    ("USINT_TO_BCD_BYTE", |call, _| to_digits(call, 2)),
    ("UINT_TO_BCD_WORD", |call, _| to_digits(call, 4)),
    ("UDINT_TO_BCD_DWORD", |call, _| to_digits(call, 8)),
    ("ULINT_TO_BCD_LWORD", |call, _| to_digits(call, 16)),
    ("TO_BCD_BYTE", |call, _| to_digits(call, 2)),
    ("TO_BCD_WORD", |call, _| to_digits(call, 4)),
    ("TO_BCD_DWORD", |call, _| to_digits(call, 8)),
    ("TO_BCD_LWORD", |call, _| to_digits(call, 16)),
    ("INT_TO_BCD", int_to_digits),
    ("IS_VALID_BCD", is_valid),
];

/// The number, or 0 if a digit is above 9.
fn to_number(call: &mut NativeCall, digits: u32) -> Result<(), Trap> {
    let bits = call.i64(0) as u64;
    let number = (0..digits).rev().try_fold(0, |number, i| digit(bits, i).map(|d| number * 10 + d));
    if number.is_none() {
        call.fail();
    }
    call.result = number.unwrap_or(0);
    Ok(())
}

fn digit(bits: u64, i: u32) -> Option<u64> {
    Some(bits >> (4 * i) & 0xF).filter(|&d| d <= 9)
}

/// The last `digits` digits of the number.
fn to_digits(call: &mut NativeCall, digits: u32) -> Result<(), Trap> {
    let mut number = call.i64(0) as u64;
    call.result = 0;
    for i in 0..digits {
        call.result |= (number % 10) << (4 * i);
        number /= 10;
    }
    if number != 0 {
        call.fail();
    }
    Ok(())
}

/// A negative number has no digits: 0.
fn int_to_digits(call: &mut NativeCall, _: Types) -> Result<(), Trap> {
    if call.i64(0) < 0 {
        call.fail();
        call.result = 0;
        return Ok(());
    }
    to_digits(call, 2)
}

fn is_valid(call: &mut NativeCall, types: Types) -> Result<(), Trap> {
    let ConversionType::Elementary(ty) = types.from else { return Err(Trap::NativePanic) };
    let bits = extend(call.i64(0) as u64, ty);
    call.result = u64::from((0..16).all(|i| digit(bits, i).is_some()));
    Ok(())
}
