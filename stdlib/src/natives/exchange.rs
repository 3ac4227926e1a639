//! Byte order. From: library reference §9.
//! Runs: cyclic.

use super::numbers::extend;
use super::{Run, Types, text};
use crate::lookup::ConversionType;
use takt_image::{NativeCall, Trap};

/// Code by catalogue name.
pub(super) const RUNS: &[(&str, Run)] = &[("TO_BIG_ENDIAN", swap), ("FROM_BIG_ENDIAN", swap)];

/// The bytes of a number or of every character in reverse.
fn swap(call: &mut NativeCall, types: Types) -> Result<(), Trap> {
    let ConversionType::Elementary(ty) = types.from else { return text::swap_bytes(call, types) };
    let bits = call.i64(0) as u64;
    let swapped = bits.swap_bytes() >> (64 - 8 * ty.bytes());
    call.result = if ty.bytes() == 1 { bits } else { extend(swapped, ty) };
    Ok(())
}
