//! Arithmetic, comparisons and conversions.

use super::function::Translator;
use crate::mir::model::{BinaryOp, Compare, Convert, Local, UnaryOp};
use cranelift_codegen::ir::condcodes::{FloatCC, IntCC};
use cranelift_codegen::ir::{InstBuilder, MemFlagsData, Type, Value, types};

impl Translator<'_, '_> {
    pub(super) fn unary(&mut self, op: UnaryOp, dst: Local, a: Local) {
        let a = self.get(a);
        let ins = self.b.ins();
        let value = match op {
            UnaryOp::Neg => ins.ineg(a),
            UnaryOp::Not => ins.bnot(a),
            UnaryOp::FNeg => ins.fneg(a),
            UnaryOp::FAbs => ins.fabs(a),
            UnaryOp::FSqrt => ins.sqrt(a),
            UnaryOp::FNearest => ins.nearest(a),
            UnaryOp::FTrunc => ins.trunc(a),
            UnaryOp::FFloor => ins.floor(a),
            UnaryOp::FCeil => ins.ceil(a),
            UnaryOp::SwapBytes if self.ty(dst) == types::I8 => a,
            UnaryOp::SwapBytes => self.b.ins().bswap(a),
        };
        self.set(dst, value);
    }

    pub(super) fn binary(&mut self, op: BinaryOp, dst: Local, a: Local, b: Local) {
        let (a, b) = (self.get(a), self.get(b));
        let ins = self.b.ins();
        let value = match op {
            BinaryOp::Add => ins.iadd(a, b),
            BinaryOp::Sub => ins.isub(a, b),
            BinaryOp::Mul => ins.imul(a, b),
            BinaryOp::SDiv => self.signed_division(a, b),
            BinaryOp::UDiv => ins.udiv(a, b),
            BinaryOp::SRem => ins.srem(a, b),
            BinaryOp::URem => ins.urem(a, b),
            BinaryOp::And => ins.band(a, b),
            BinaryOp::Or => ins.bor(a, b),
            BinaryOp::Xor => ins.bxor(a, b),
            BinaryOp::Shl => ins.ishl(a, b),
            BinaryOp::LShr => ins.ushr(a, b),
            BinaryOp::AShr => ins.sshr(a, b),
            BinaryOp::Rotl => ins.rotl(a, b),
            BinaryOp::Rotr => ins.rotr(a, b),
            BinaryOp::FAdd => ins.fadd(a, b),
            BinaryOp::FSub => ins.fsub(a, b),
            BinaryOp::FMul => ins.fmul(a, b),
            BinaryOp::FDiv => ins.fdiv(a, b),
        };
        self.set(dst, value);
    }

    /// The processor faults on min / -1. So a divisor of -1 becomes 1, and the result is negated, which wraps; a constant divisor
    /// leaves the division alone.
    fn signed_division(&mut self, a: Value, b: Value) -> Value {
        let ty = self.b.func.dfg.value_type(b);
        let minus_one = self.b.ins().icmp_imm_s(IntCC::Equal, b, -1);
        let one = self.b.ins().iconst(ty, 1);
        let divisor = self.b.ins().select(minus_one, one, b);
        let quotient = self.b.ins().sdiv(a, divisor);
        let negated = self.b.ins().ineg(quotient);
        self.b.ins().select(minus_one, negated, quotient)
    }

    pub(super) fn compare(&mut self, op: Compare, dst: Local, a: Local, b: Local) {
        let (a, b) = (self.get(a), self.get(b));
        let value = match condition(op) {
            Condition::Int(condition) => self.b.ins().icmp(condition, a, b),
            Condition::Float(condition) => self.b.ins().fcmp(condition, a, b),
        };
        self.set(dst, value);
    }

    pub(super) fn convert(&mut self, op: Convert, dst: Local, src: Local) {
        let (to, value) = (self.ty(dst), self.get(src));
        let value = match op {
            Convert::SignExtend => self.b.ins().sextend(to, value),
            Convert::ZeroExtend => self.b.ins().uextend(to, value),
            Convert::Truncate => self.b.ins().ireduce(to, value),
            Convert::SignedToFloat => {
                let wide = self.widen(value, types::I32, true);
                self.b.ins().fcvt_from_sint(to, wide)
            }
            Convert::UnsignedToFloat => self.unsigned_to_float(to, value),
            Convert::FloatToSigned => self.float_to_signed(to, value),
            Convert::FloatToUnsigned => self.float_to_unsigned(to, value),
            Convert::Float if to == types::F64 => self.b.ins().fpromote(to, value),
            Convert::Float => self.b.ins().fdemote(to, value),
            Convert::Bits => self.b.ins().bitcast(to, MemFlagsData::new(), value),
        };
        self.set(dst, value);
    }

    /// At least as wide as `least`.
    fn widen(&mut self, value: Value, least: Type, signed: bool) -> Value {
        if self.b.func.dfg.value_type(value).bits() >= least.bits() {
            value
        } else if signed {
            self.b.ins().sextend(least, value)
        } else {
            self.b.ins().uextend(least, value)
        }
    }

    /// Narrower numbers are exact as signed 64-bit ones, which the processor converts.
    fn unsigned_to_float(&mut self, to: Type, value: Value) -> Value {
        if self.b.func.dfg.value_type(value) == types::I64 {
            return self.b.ins().fcvt_from_uint(to, value);
        }
        let wide = self.widen(value, types::I64, false);
        self.b.ins().fcvt_from_sint(to, wide)
    }

    fn float_to_signed(&mut self, to: Type, value: Value) -> Value {
        if to.bits() >= 32 {
            return self.b.ins().fcvt_to_sint_sat(to, value);
        }
        let wide = self.b.ins().fcvt_to_sint_sat(types::I32, value);
        let high = (1i64 << (to.bits() - 1)) - 1;
        let high_value = self.b.ins().iconst(types::I32, high);
        let clamped = self.b.ins().smin(wide, high_value);
        let low_value = self.b.ins().iconst(types::I32, i64::from((-high - 1) as u32));
        let clamped = self.b.ins().smax(clamped, low_value);
        self.b.ins().ireduce(to, clamped)
    }

    fn float_to_unsigned(&mut self, to: Type, value: Value) -> Value {
        if to.bits() >= 32 {
            return self.b.ins().fcvt_to_uint_sat(to, value);
        }
        let wide = self.b.ins().fcvt_to_uint_sat(types::I32, value);
        let high = self.b.ins().iconst(types::I32, (1i64 << to.bits()) - 1);
        let clamped = self.b.ins().umin(wide, high);
        self.b.ins().ireduce(to, clamped)
    }
}

enum Condition {
    Int(IntCC),
    Float(FloatCC),
}

fn condition(op: Compare) -> Condition {
    use Condition::{Float, Int};
    match op {
        Compare::Eq => Int(IntCC::Equal),
        Compare::Ne => Int(IntCC::NotEqual),
        Compare::SLt => Int(IntCC::SignedLessThan),
        Compare::SLe => Int(IntCC::SignedLessThanOrEqual),
        Compare::SGt => Int(IntCC::SignedGreaterThan),
        Compare::SGe => Int(IntCC::SignedGreaterThanOrEqual),
        Compare::ULt => Int(IntCC::UnsignedLessThan),
        Compare::ULe => Int(IntCC::UnsignedLessThanOrEqual),
        Compare::UGt => Int(IntCC::UnsignedGreaterThan),
        Compare::UGe => Int(IntCC::UnsignedGreaterThanOrEqual),
        Compare::FEq => Float(FloatCC::Equal),
        Compare::FNe => Float(FloatCC::NotEqual),
        Compare::FLt => Float(FloatCC::LessThan),
        Compare::FLe => Float(FloatCC::LessThanOrEqual),
        Compare::FGt => Float(FloatCC::GreaterThan),
        Compare::FGe => Float(FloatCC::GreaterThanOrEqual),
    }
}
