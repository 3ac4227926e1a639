//! Arithmetic of durations and times of day, in nanoseconds. Integer factors are exact, quotients and real factors round half-even.
//! From: library reference §8.1.

use super::operator::Operand;
use super::unit::Unit;
use crate::mir::model::*;
use crate::syntax::ast::BinaryOp as Operator;
use takt_image::Scalar;

const DAY_NS: i64 = 86_400_000_000_000;

impl Unit<'_, '_> {
    /// Duration times or divided by a number; divided by 0 it is T#0s.
    pub fn scale_time(&mut self, op: Operator, time: Local, factor: Operand) -> Local {
        if factor.e.is_real() {
            return self.scale_by_real(op, time, factor);
        }
        let signed = factor.e.is_signed_storage();
        let number = self.f.resize(factor.local, Scalar::I64, signed);
        if op == Operator::Mul {
            return self.f.binary(BinaryOp::Mul, time, number);
        }
        self.divide_half_even(time, number, signed)
    }

    fn scale_by_real(&mut self, op: Operator, time: Local, factor: Operand) -> Local {
        let factor = self.as_f64(factor);
        let wide = self.f.convert(Convert::SignedToFloat, Scalar::F64, time);
        let scaled = self.f.binary(if op == Operator::Mul { BinaryOp::FMul } else { BinaryOp::FDiv }, wide, factor);
        let nearest = self.f.unary(UnaryOp::FNearest, scaled);
        let result = self.f.convert(Convert::FloatToSigned, Scalar::I64, nearest);
        if op == Operator::Mul {
            return result;
        }
        let zero = self.f.zero(Scalar::F64);
        let by_zero = self.f.compare(Compare::FEq, factor, zero);
        let nothing = self.f.zero(Scalar::I64);
        self.f.select(by_zero, nothing, result)
    }

    /// Quotient of magnitudes, one more if the rest is more than half the divisor, or half and the quotient odd; then the sign.
    fn divide_half_even(&mut self, time: Local, number: Local, signed: bool) -> Local {
        let (dividend, minus) = self.magnitude(time);
        let (divisor, minus) = if signed {
            let (divisor, other) = self.magnitude(number);
            (divisor, self.f.binary(BinaryOp::Xor, minus, other))
        } else {
            (number, minus)
        };
        let one = self.f.int(Scalar::I64, 1);
        let safe = self.f.select(divisor, divisor, one);
        let quotient = self.f.binary(BinaryOp::UDiv, dividend, safe);
        let rest = self.f.binary(BinaryOp::URem, dividend, safe);
        let rounded = self.round_half_even(quotient, rest, safe);
        let negated = self.f.unary(UnaryOp::Neg, rounded);
        let result = self.f.select(minus, negated, rounded);
        let nothing = self.f.zero(Scalar::I64);
        self.f.select(divisor, result, nothing)
    }

    fn round_half_even(&mut self, quotient: Local, rest: Local, divisor: Local) -> Local {
        let other = self.f.binary(BinaryOp::Sub, divisor, rest);
        let more = self.f.compare(Compare::UGt, rest, other);
        let half = self.f.compare(Compare::Eq, rest, other);
        let low = self.f.resize(quotient, Scalar::I8, false);
        let tie = self.f.binary(BinaryOp::And, half, low);
        let up = self.f.binary(BinaryOp::Or, more, tie);
        let up = self.f.resize(up, Scalar::I64, false);
        self.f.binary(BinaryOp::Add, quotient, up)
    }

    /// Magnitude (unsigned, so that of the minimum is right) and 1 if negative.
    fn magnitude(&mut self, x: Local) -> (Local, Local) {
        let minus = self.f.compare_const(Compare::SLt, x, 0);
        let negated = self.f.unary(UnaryOp::Neg, x);
        (self.f.select(minus, negated, x), minus)
    }

    /// Time of day plus or minus a duration, modulo 24 h.
    pub fn time_of_day(&mut self, op: Operator, time: Local, duration: Local) -> Local {
        let sum = self.f.binary(if op == Operator::Sub { BinaryOp::Sub } else { BinaryOp::Add }, time, duration);
        let day = self.f.int(Scalar::I64, DAY_NS);
        let rest = self.f.binary(BinaryOp::SRem, sum, day);
        let next = self.f.binary(BinaryOp::Add, rest, day);
        let before = self.f.compare_const(Compare::SLt, rest, 0);
        self.f.select(before, next, rest)
    }
}
