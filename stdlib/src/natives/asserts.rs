//! Natives behind the assertions: `ASSERT_EQ_INT`, `ASSERT_NEAR_REAL`. They compare as the operators do, keep what failed in the
//! [`AssertLog`](crate::asserts::AssertLog) and give back whether it held. Runs: binding in the background, `run` cyclic.
//!
//! Slots: expected, actual, for NEAR the tolerance, message (a STRING), file (a STRING), line I32, type I32. Result: BOOL.

use super::{push, text};
use crate::asserts::{AssertLog, Check, Compared, Failure, Text};
use crate::catalog::Pattern;
use crate::lookup::ConversionType;
use std::cmp::Ordering;
use takt_image::Scalar::{I8, I32};
use takt_image::{Elementary as E, Generic, NativeCall, NativeKind, Trap};

/// An assertion that an image has bound.
#[derive(Clone, Copy)]
pub(super) struct Assertion {
    check: Check,
    ty: ConversionType,
}

impl Assertion {
    /// By its full name.
    pub fn find(name: &str) -> Option<Self> {
        let (check, ty) = name.strip_prefix("ASSERT_")?.split_once('_')?;
        let check = Check::ALL.into_iter().find(|c| c.name() == check)?;
        Some(Self { check, ty: ConversionType::from_name(ty)? })
    }

    /// Its signature.
    pub fn kind(self) -> NativeKind {
        let mut params = Vec::new();
        let values = if self.check == Check::Near { 3 } else { 2 };
        (0..values).for_each(|_| push(&mut params, Pattern::T(Generic::Any), self.ty));
        params.extend([I32; 6]);
        NativeKind::Function { params, result: Some(I8) }
    }

    /// Slots of a value.
    fn width(self) -> usize {
        if matches!(self.ty, ConversionType::Elementary(_)) { 1 } else { 2 }
    }

    /// Compares, and notes the outcome.
    pub fn run(self, call: &mut NativeCall, log: &mut AssertLog) -> Result<(), Trap> {
        let holds = self.holds(call)?;
        call.result = u64::from(holds);
        let failure = if holds { None } else { Some(self.failure(call)?) };
        log.note(failure);
        Ok(())
    }

    fn holds(self, call: &NativeCall) -> Result<bool, Trap> {
        let order = match self.ty {
            ConversionType::Elementary(e) if self.check == Check::Near => return Ok(near(e, call)),
            ConversionType::Elementary(e) => scalars(e, call),
            _ => Some(self.texts(call)?),
        };
        Ok(match self.check {
            Check::Eq | Check::Near => order == Some(Ordering::Equal),
            Check::Ne => order != Some(Ordering::Equal),
            Check::Lt => order == Some(Ordering::Less),
            Check::Le => order.is_some_and(Ordering::is_le),
            Check::Gt => order == Some(Ordering::Greater),
            Check::Ge => order.is_some_and(Ordering::is_ge),
        })
    }

    fn texts(self, call: &NativeCall) -> Result<Ordering, Trap> {
        let width = text::width(self.ty);
        let (a, b) = (text::source(call, 0, width)?, text::source(call, 2, width)?);
        let units = |t: text::Text| (0..t.len).map(move |i| t.unit(call, i));
        Ok(units(a).cmp(units(b)))
    }

    fn failure(self, call: &NativeCall) -> Result<Failure, Trap> {
        let values = self.width() * if self.check == Check::Near { 3 } else { 2 };
        Ok(Failure {
            check: self.check,
            ty: call.u32(values + 5),
            expected: self.compared(call, 0)?,
            actual: self.compared(call, self.width())?,
            tolerance: call.i64(2) as u64,
            message: kept(call, values, ConversionType::String)?,
            file: kept(call, values + 2, ConversionType::String)?,
            line: call.u32(values + 4),
            now: call.now,
        })
    }

    fn compared(self, call: &NativeCall, slot: usize) -> Result<Compared, Trap> {
        Ok(match self.ty {
            ConversionType::Elementary(_) => Compared::Scalar(call.i64(slot) as u64),
            ty => Compared::Text(kept(call, slot, ty)?),
        })
    }
}

fn kept(call: &NativeCall, slot: usize, ty: ConversionType) -> Result<Text, Trap> {
    let text = text::source(call, slot, text::width(ty))?;
    Ok(Text::new(text.bytes(call), ty == ConversionType::WString))
}

/// `None` if one is not a number.
fn scalars(e: E, call: &NativeCall) -> Option<Ordering> {
    match e {
        E::Real => call.f32(0).partial_cmp(&call.f32(1)),
        E::Lreal => call.f64(0).partial_cmp(&call.f64(1)),
        e if e.is_signed_storage() => Some(call.i64(0).cmp(&call.i64(1))),
        _ => Some((call.i64(0) as u64).cmp(&(call.i64(1) as u64))),
    }
}

fn near(e: E, call: &NativeCall) -> bool {
    let reals = |a: f64, b: f64, tolerance: f64| a == b || (a - b).abs() <= tolerance;
    let wide = |i: usize| if e.is_signed_storage() { i128::from(call.i64(i)) } else { i128::from(call.i64(i) as u64) };
    match e {
        E::Real => reals(call.f32(0).into(), call.f32(1).into(), call.f32(2).into()),
        E::Lreal => reals(call.f64(0), call.f64(1), call.f64(2)),
        _ => (wide(0) - wide(1)).abs() <= wide(2),
    }
}
