//! Natives behind inline functions whose arithmetic is not a few instructions:
//!
//! | native | slots | for |
//! |---|---|---|
//! | `EXPT_REAL`, `EXPT_LREAL` | base, exponent, both of T | EXPT and `**` |
//! | `MUL_TIME_LINT`, `DIV_TIME_LINT` | I64 ns, I64 | TIME or LTIME times or by an integer; wraps, by zero is zero |
//! | `MUL_TIME_LREAL`, `DIV_TIME_LREAL` | I64 ns, F64 | the same with a real, to the nearest nanosecond, saturating; NaN is zero |
//!
//! `MUL_TIME_LREAL_CODESYS`, `DIV_TIME_LINT_CODESYS` and `DIV_TIME_LREAL_CODESYS` count whole milliseconds, and divide toward zero.
//! Quotients are rounded to the nearest nanosecond, ties to even. From: library reference §4, §8.1.

use super::{Native, Run, Types, math};
use crate::calendar::MILLISECOND_NS;
use crate::lookup::ConversionType;
use takt_image::Elementary as E;
use takt_image::Scalar::{self, F32, F64, I64};
use takt_image::{NativeCall, Trap};

/// Name, type of both slots T, slots and result.
type Helper = (&'static str, E, [Scalar; 2], Run);

const HELPERS: &[Helper] = &[
    ("EXPT_REAL", E::Real, [F32, F32], |call, types| math::binary(call, types, libm::pow)),
    ("EXPT_LREAL", E::Lreal, [F64, F64], |call, types| math::binary(call, types, libm::pow)),
    ("MUL_TIME_LINT", E::Time, [I64, I64], |call, _| {
        call.result = call.i64(0).wrapping_mul(call.i64(1)) as u64;
        Ok(())
    }),
    ("DIV_TIME_LINT", E::Time, [I64, I64], |call, _| {
        call.result = divide(call.i64(0), call.i64(1)) as u64;
        Ok(())
    }),
    ("MUL_TIME_LREAL", E::Time, [I64, F64], |call, _| {
        call.result = libm::rint(call.i64(0) as f64 * call.f64(1)) as i64 as u64;
        Ok(())
    }),
    ("MUL_TIME_LREAL_CODESYS", E::Time, [I64, F64], |call, _| {
        let (product, unit) = (call.i64(0) as f64 * call.f64(1), MILLISECOND_NS as f64);
        whole(call, libm::rint(product / unit) * unit)
    }),
    ("DIV_TIME_LINT_CODESYS", E::Time, [I64, I64], |call, _| {
        let quotient = call.i64(0).checked_div(call.i64(1));
        if quotient.is_none() {
            call.fail();
        }
        call.result = (quotient.unwrap_or(0) / MILLISECOND_NS * MILLISECOND_NS) as u64;
        Ok(())
    }),
    ("DIV_TIME_LREAL_CODESYS", E::Time, [I64, F64], |call, _| {
        let (quotient, unit) = (call.i64(0) as f64 / call.f64(1), MILLISECOND_NS as f64);
        whole(call, libm::trunc(quotient / unit) * unit)
    }),
    ("DIV_TIME_LREAL", E::Time, [I64, F64], |call, _| {
        let divisor = call.f64(1);
        call.result = if divisor == 0.0 { 0 } else { libm::rint(call.i64(0) as f64 / divisor) as i64 as u64 };
        Ok(())
    }),
];

/// A number of nanoseconds; infinite and NaN give T#0s.
fn whole(call: &mut NativeCall, ns: f64) -> Result<(), Trap> {
    if !ns.is_finite() {
        call.fail();
    }
    call.result = if ns.is_finite() { ns as i64 as u64 } else { 0 };
    Ok(())
}

/// The helper of this name.
pub(super) fn find(name: &str) -> Option<Native> {
    let &(_, ty, slots, run) = HELPERS.iter().find(|helper| helper.0 == name)?;
    let types = Types::both(ConversionType::Elementary(ty));
    Some(Native { params: slots.to_vec(), result: Some(slots[0]), extensible: false, run, types })
}

/// Nearest quotient, ties to even; 0 if the divisor is.
pub fn divide(a: i64, b: i64) -> i64 {
    if b == 0 {
        return 0;
    }
    let (a, b) = (i128::from(a), i128::from(b));
    let (floor, rest) = (a.div_euclid(b), a.rem_euclid(b));
    // With a negative divisor `div_euclid` rounds up, and the other neighbour is below.
    let other = floor + b.signum();
    let nearest = match (2 * rest).cmp(&b.abs()) {
        std::cmp::Ordering::Less => floor,
        std::cmp::Ordering::Greater => other,
        std::cmp::Ordering::Equal if floor % 2 == 0 => floor,
        std::cmp::Ordering::Equal => other,
    };
    nearest as i64
}
