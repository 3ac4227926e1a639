//! One instruction of MIR.

use super::function::{Translator, clif_type, trap_code};
use crate::mir::model::*;
use crate::mir::ops::{float32, mask};
use cranelift_codegen::ir::immediates::{Ieee32, Ieee64};
use cranelift_codegen::ir::{InstBuilder, Value};
use takt_image::Scalar;

impl Translator<'_, '_> {
    pub(super) fn op(&mut self, op: &Op) {
        match *op {
            Op::Int(dst, value) => self.int(dst, value),
            Op::Float(dst, bits) => self.float(dst, bits),
            Op::Copy(dst, src) => {
                let value = self.get(src);
                self.set(dst, value);
            }
            Op::Unary(op, dst, a) => self.unary(op, dst, a),
            Op::Binary(op, dst, a, b) => self.binary(op, dst, a, b),
            Op::Compare(op, dst, a, b) => self.compare(op, dst, a, b),
            Op::Convert(op, dst, src) => self.convert(op, dst, src),
            Op::Select { dst, condition, then, otherwise } => {
                let (condition, then, otherwise) = (self.get(condition), self.get(then), self.get(otherwise));
                let value = self.b.ins().select(condition, then, otherwise);
                self.set(dst, value);
            }
            Op::Load(dst, addr) => {
                let place = self.place(addr);
                let value = self.load(self.ty(dst), place);
                self.set(dst, value);
            }
            Op::Store(addr, src) => {
                let (place, value) = (self.place(addr), self.get(src));
                self.store(value, place);
            }
            Op::Address(dst, addr) => self.address(dst, addr),
            Op::CopyBytes { to, from, size } => self.copy_bytes(to, from, size),
            Op::FillBytes { to, size, value } => self.fill_bytes(to, size, value),
            Op::CopyString { to, to_capacity, from, from_capacity, unit } => {
                self.copy_string((to, to_capacity), (from, from_capacity), unit);
            }
            Op::CompareString { dst, a, a_capacity, b, b_capacity, unit } => {
                self.compare_string(dst, (a, a_capacity), (b, b_capacity), unit);
            }
            Op::Call { dst, function, ref args } => self.call(dst, function, args),
            Op::CallNative { dst, native, ref args } => self.call_native(dst, native, args),
            Op::TrapIf(trap, condition) => {
                let condition = self.get(condition);
                self.b.ins().trapnz(condition, trap_code(trap));
            }
        }
    }

    fn int(&mut self, dst: Local, value: i64) {
        let ty = self.function.locals[dst];
        let value = self.b.ins().iconst(clif_type(ty), mask(ty, value as u64) as i64);
        self.set(dst, value);
    }

    fn float(&mut self, dst: Local, bits: u64) {
        let value: Value = match self.function.locals[dst] {
            Scalar::F32 => self.b.ins().f32const(Ieee32::with_bits(float32(bits).to_bits())),
            _ => self.b.ins().f64const(Ieee64::with_bits(bits)),
        };
        self.set(dst, value);
    }
}
