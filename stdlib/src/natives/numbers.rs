//! TIME, TOD, DATE and DT as numbers: TIME and TOD in milliseconds (profile openplc: seconds), DATE and DT in seconds. Integers drop the fraction (dates round
//! down), reals keep it; out of range wraps, from reals saturates. From: library reference §2.1 rows g and j.
//! Runs: cyclic.

use super::Types;
use crate::calendar::{DAY_NS, MILLISECOND_NS, SECOND_NS, midnight_of, time_of_day};
use crate::lookup::ConversionType;
use takt_base::Profile;
use takt_image::{Elementary as E, NativeCall, Trap};

/// Nanoseconds in the unit in which the type is a number; `None` for types that have no native here.
pub(super) fn unit(ty: E) -> Option<i64> {
    match ty {
        E::Time | E::Tod => Some(MILLISECOND_NS),
        E::Date | E::Dt => Some(SECOND_NS),
        _ => None,
    }
}

/// The same for a profile.
fn unit_of(ty: E, types: Types) -> i64 {
    let seconds = matches!(ty, E::Time | E::Tod) && types.profile == Profile::OpenPlc;
    if seconds { SECOND_NS } else { unit(ty).unwrap_or(1) }
}

pub(super) fn instant_to_date(call: &mut NativeCall, _: Types) -> Result<(), Trap> {
    call.result = midnight_of(call.i64(0)) as u64;
    Ok(())
}

pub(super) fn instant_to_tod(call: &mut NativeCall, _: Types) -> Result<(), Trap> {
    call.result = time_of_day(call.i64(0)) as u64;
    Ok(())
}

pub(super) fn time_to_int(call: &mut NativeCall, types: Types) -> Result<(), Trap> {
    let (from, to) = ends(types)?;
    let (ns, unit) = (call.i64(0), unit_of(from, types));
    let number = if from.is_duration() { ns / unit } else { ns.div_euclid(unit) };
    call.result = extend(number as u64, to);
    let kept = if to.is_signed_storage() { i128::from(call.result as i64) } else { i128::from(call.result) };
    if to.is_int() && kept != i128::from(number) {
        call.fail();
    }
    Ok(())
}

pub(super) fn time_to_real(call: &mut NativeCall, types: Types) -> Result<(), Trap> {
    let (from, to) = ends(types)?;
    let number = call.i64(0) as f64 / unit_of(from, types) as f64;
    call.result = if to == E::Real { (number as f32).to_bits().into() } else { number.to_bits() };
    Ok(())
}

pub(super) fn int_to_time(call: &mut NativeCall, types: Types) -> Result<(), Trap> {
    let (from, to) = ends(types)?;
    let slot = extend(call.i64(0) as u64, from);
    let number = if from.is_signed_storage() { i128::from(slot as i64) } else { i128::from(slot) };
    let exact = number * i128::from(unit_of(to, types));
    let ns = exact as i64;
    if i128::from(ns) != exact {
        call.fail();
    }
    call.result = whole(ns, to) as u64;
    Ok(())
}

pub(super) fn real_to_time(call: &mut NativeCall, types: Types) -> Result<(), Trap> {
    let (from, to) = ends(types)?;
    let number = if from == E::Real { f64::from(call.f32(0)) } else { call.f64(0) };
    let nearest = libm::rint(number * unit_of(to, types) as f64);
    let ns = nearest as i64; // saturates, NaN gives 0
    if !(nearest.abs() < 9.3e18 && ns as f64 == nearest) {
        call.fail();
    }
    call.result = whole(ns, to) as u64;
    Ok(())
}

/// A DATE is a whole day, a TOD less than one.
fn whole(ns: i64, ty: E) -> i64 {
    match ty {
        E::Date => midnight_of(ns),
        E::Tod => ns.rem_euclid(DAY_NS),
        _ => ns,
    }
}

/// Both ends as elementary types.
fn ends(types: Types) -> Result<(E, E), Trap> {
    match (types.from, types.to) {
        (ConversionType::Elementary(from), ConversionType::Elementary(to)) => Ok((from, to)),
        _ => Err(Trap::NativePanic),
    }
}

/// The low bits that the type holds, extended to a slot as the type wants it. BOOL is 0 or 1.
pub(super) fn extend(bits: u64, ty: E) -> u64 {
    let unused = 64 - ty.bits();
    if ty.is_signed_storage() { ((bits << unused) as i64 >> unused) as u64 } else { bits << unused >> unused }
}
