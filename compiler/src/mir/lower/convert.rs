//! Conversions between scalar types. From: library reference §2.

use super::interval::Interval;
use super::unit::Unit;
use crate::hir::model::*;
use crate::mir::model::*;
use takt_image::{Elementary, Trap, Type, TypeId};

impl Unit<'_, '_> {
    /// `a` as a value of type `to`.
    pub fn convert(&mut self, how: Conversion, a: &Expr, to: TypeId) -> Local {
        let from = self.hir.elementary(a.ty).expect("a scalar");
        let known = self.interval(a);
        let value = self.value(a);
        self.convert_value(how, value, from, to, known)
    }

    /// Like [`Unit::convert`], for a value at hand.
    pub fn convert_value(&mut self, how: Conversion, x: Local, from: Elementary, to: TypeId, known: Option<Interval>) -> Local {
        let target = self.hir.elementary(to).expect("a scalar");
        match how {
            Conversion::Integer => self.integer(x, from, target),
            Conversion::ZeroExtend => self.f.resize(x, target.scalar(), false),
            Conversion::NonZero => self.non_zero(x, from),
            Conversion::LowBit => {
                let byte = self.f.resize(x, Elementary::Bool.scalar(), false);
                self.f.binary_const(BinaryOp::And, byte, 1)
            }
            Conversion::IntToReal => self.integer_to_float(x, from, target.scalar()),
            Conversion::RealToInt => self.float_to_integer(x, target),
            Conversion::RealToIntAway => {
                let nearest = self.nearest_away(x, from);
                self.truncate(nearest, target)
            }
            Conversion::Real if from == target => x,
            Conversion::Real => self.f.convert(Convert::Float, target.scalar(), x),
            Conversion::Bits => self.f.convert(Convert::Bits, target.scalar(), x),
            Conversion::Subrange => {
                self.check_subrange(x, from, to, known);
                self.integer(x, from, target)
            }
            Conversion::String => unreachable!("strings are no scalars"),
        }
    }

    fn integer(&mut self, x: Local, from: Elementary, to: Elementary) -> Local {
        let resized = self.f.resize(x, to.scalar(), from.is_signed_storage());
        let may_be_more = to == Elementary::Bool && from != Elementary::Bool;
        if may_be_more { self.f.binary_const(BinaryOp::And, resized, 1) } else { resized }
    }

    /// Nearest whole number, halves away from zero. Adding a half first would be wrong just below 0.5.
    pub fn nearest_away(&mut self, x: Local, e: Elementary) -> Local {
        let s = e.scalar();
        let whole = self.f.unary(UnaryOp::FTrunc, x);
        let rest = self.f.binary(BinaryOp::FSub, x, whole);
        let distance = self.f.unary(UnaryOp::FAbs, rest);
        let (half, zero) = (self.f.float(s, 0.5), self.f.zero(s));
        let (one, minus_one) = (self.f.float(s, 1.0), self.f.float(s, -1.0));
        let negative = self.f.compare(Compare::FLt, x, zero);
        let step = self.f.select(negative, minus_one, one);
        let next = self.f.binary(BinaryOp::FAdd, whole, step);
        let up = self.f.compare(Compare::FGe, distance, half);
        self.f.select(up, next, whole)
    }

    fn non_zero(&mut self, x: Local, from: Elementary) -> Local {
        let zero = self.f.zero(from.scalar());
        self.f.compare(if from.is_real() { Compare::FNe } else { Compare::Ne }, x, zero)
    }

    /// Traps (Range) if a value of type `from` is not in the subrange `to`. One comparison: distance from the lower bound, unsigned.
    pub fn check_subrange(&mut self, x: Local, from: Elementary, to: TypeId, known: Option<Interval>) {
        let (Type::Subrange { low, high, .. }, Some(all)) = (self.hir.types.get(to), from.int_range()) else { return };
        let (low, high) = ((*low).max(all.0), (*high).min(all.1));
        if known.is_some_and(|(i, j)| low <= i && j <= high) {
            return;
        }
        if low > high {
            let always = self.f.int(Elementary::Bool.scalar(), 1);
            return self.f.trap_if(Trap::Range, always);
        }
        let distance = self.f.binary_const(BinaryOp::Sub, x, low as i64);
        let outside = self.f.compare_const(Compare::UGt, distance, (high - low) as i64);
        self.f.trap_if(Trap::Range, outside);
    }

    /// The implicit conversion from one type to a wider one, or the check of a subrange.
    pub fn widen(&mut self, x: Local, from: TypeId, to: TypeId) -> Local {
        let (Some(source), Some(target)) = (self.hir.elementary(from), self.hir.elementary(to)) else { return x };
        let how = match (source.is_real(), target.is_real()) {
            (true, true) => Conversion::Real,
            (false, true) => Conversion::IntToReal,
            (true, false) => Conversion::RealToInt,
            (false, false) => Conversion::Subrange,
        };
        self.convert_value(how, x, source, to, None)
    }
}
