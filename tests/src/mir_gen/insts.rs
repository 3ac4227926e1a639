//! Random instructions. Some take several: masks before an address, a replacement of NaN after a float.

use super::body::Body;
use super::{DATA, SCALARS, header};
use takt_compiler::mir::model::*;
use takt_compiler::mir::ops::{BINARY, COMPARE, CONVERT, UNARY, width};
use takt_image::Scalar;

/// Bytes that an address in a local may be followed by; a masked number is below 1024.
const REACH: u32 = 1500;

const INTEGERS: [i64; 14] = [0, 1, -1, 2, 3, 7, 10, 127, -128, 32767, i32::MIN as i64, i32::MAX as i64, i64::MIN, i64::MAX];
const FLOATS: [f64; 14] = [
    0.0,
    -0.0,
    1.0,
    -1.5,
    2.5,
    0.5,
    1e10,
    -3e9,
    255.5,
    65536.0,
    9.223_372_036_854_776e18,
    f64::INFINITY,
    f64::NEG_INFINITY,
    f64::NAN,
];

impl Body<'_> {
    pub(super) fn random_inst(&mut self) {
        if self.network && !self.rng.one_in(12) {
            return self.contact();
        }
        match self.rng.below(22) {
            0 => self.int(),
            1 => self.float(),
            2 => self.copy(),
            3 | 4 => self.unary(),
            5..=8 => self.binary(),
            9 => self.compare(),
            10 | 11 => self.convert(),
            12 => self.select(),
            13 | 14 => self.load(),
            15 | 16 => self.store(),
            17 => self.address(),
            18 => self.bytes(),
            19 => self.strings(),
            20 => self.any_call(),
            _ => self.trap_if(),
        }
    }

    /// An instruction of a BOOL network.
    fn contact(&mut self) {
        let (a, b, dst) = (self.local(Scalar::I8), self.local(Scalar::I8), self.local(Scalar::I8));
        let addr = Addr { base: AddrBase::Static, offset: header::SIZE + self.rng.range(0, 200) };
        let op = match self.rng.below(6) {
            0 | 1 => Op::Load(dst, addr),
            2 => Op::Store(addr, a),
            3 => Op::Binary(BinaryOp::And, dst, a, b),
            4 => Op::Binary(BinaryOp::Or, dst, a, b),
            _ => Op::Binary(BinaryOp::Xor, dst, a, b),
        };
        self.push(op);
    }

    fn int(&mut self) {
        let dst = self.integer();
        let value = if self.rng.one_in(2) { self.rng.pick(&INTEGERS) } else { self.rng.bits() as i64 };
        self.push(Op::Int(dst, value));
    }

    fn float(&mut self) {
        let ty = self.float_type();
        let dst = self.local(ty);
        let value = if self.rng.one_in(3) { f64::from(self.rng.bits() as i32) } else { self.rng.pick(&FLOATS) };
        let exact = if ty == Scalar::F32 { f64::from(value as f32) } else { value };
        self.push(Op::Float(dst, if exact.is_nan() { 0x7ff8_0000_0000_0000 } else { exact.to_bits() }));
    }

    fn float_type(&mut self) -> Scalar {
        self.rng.pick(&SCALARS[4..])
    }

    fn type_for(&mut self, float: bool) -> Scalar {
        if float { self.float_type() } else { self.rng.pick(&SCALARS[..4]) }
    }

    fn copy(&mut self) {
        let ty = self.any_type();
        let op = Op::Copy(self.local(ty), self.local(ty));
        self.push(op);
    }

    /// Replaces a NaN in a float local by the fixed one.
    fn settle(&mut self, dst: Local) {
        let ty = self.locals[dst];
        if ty.is_float() {
            let nan = self.nan[usize::from(ty == Scalar::F64)];
            self.push(Op::Compare(Compare::FEq, self.is_number, dst, dst));
            self.push(Op::Select { dst, condition: self.is_number, then: dst, otherwise: nan });
        }
    }

    fn unary(&mut self) {
        let (_, op) = self.rng.pick(UNARY);
        let ty = self.type_for(op.is_float());
        let (dst, a) = (self.local(ty), self.local(ty));
        self.push(Op::Unary(op, dst, a));
        self.settle(dst);
    }

    fn binary(&mut self) {
        let (_, op) = self.rng.pick(BINARY);
        let ty = self.type_for(op.is_float());
        let (dst, a, mut b) = (self.local(ty), self.local(ty), self.local(ty));
        let divides = matches!(op, BinaryOp::SDiv | BinaryOp::UDiv | BinaryOp::SRem | BinaryOp::URem);
        if divides && !self.rng.one_in(40) {
            b = self.divisor(ty);
        }
        if matches!(op, BinaryOp::Shl | BinaryOp::LShr | BinaryOp::AShr | BinaryOp::Rotl | BinaryOp::Rotr) {
            b = self.amount(ty);
        }
        self.push(Op::Binary(op, dst, a, b));
        self.settle(dst);
    }

    /// A divisor that is not 0: a constant, or a local with a bit set.
    fn divisor(&mut self, ty: Scalar) -> Local {
        let (divisor, bit) = (self.locals.push(ty), self.rng.pick(&[1, -1, 2, 3, 7, 10, 16, 100, -128]));
        self.push(Op::Int(divisor, bit));
        if self.rng.one_in(2) {
            let any = self.local(ty);
            self.push(Op::Binary(BinaryOp::Or, divisor, divisor, any));
        }
        divisor
    }

    /// An amount below the width.
    fn amount(&mut self, ty: Scalar) -> Local {
        let (amount, any) = (self.locals.push(ty), self.local(ty));
        self.push(Op::Int(amount, i64::from(width(ty) - 1)));
        self.push(Op::Binary(BinaryOp::And, amount, amount, any));
        amount
    }

    fn compare(&mut self) {
        let (_, op) = self.rng.pick(COMPARE);
        let ty = self.type_for(op.is_float());
        let op = Op::Compare(op, self.local(Scalar::I8), self.local(ty), self.local(ty));
        self.push(op);
    }

    fn convert(&mut self) {
        let (_, op) = self.rng.pick(CONVERT);
        let (from, to) = loop {
            let pair = (self.rng.pick(&SCALARS), self.rng.pick(&SCALARS));
            if op.accepts(pair.0, pair.1) {
                break pair;
            }
        };
        let (dst, src) = (self.local(to), self.local(from));
        self.push(Op::Convert(op, dst, src));
        if op != Convert::Bits {
            self.settle(dst);
        }
    }

    fn select(&mut self) {
        let ty = self.any_type();
        let condition = self.integer();
        let op = Op::Select { dst: self.local(ty), condition, then: self.local(ty), otherwise: self.local(ty) };
        self.push(op);
    }

    /// A place in the data area or the frame with room for `size` bytes, of which there are at most [`REACH`].
    fn place(&mut self, size: u32) -> Addr {
        match self.rng.below(4) {
            0 if self.frame >= size => Addr { base: AddrBase::Frame, offset: self.rng.range(0, self.frame - size) },
            1 | 2 => {
                let (masked, any) = (self.masked, self.local(Scalar::I32));
                self.push(Op::Binary(BinaryOp::And, masked, any, self.limit));
                Addr { base: AddrBase::Local(masked), offset: header::SIZE + self.rng.range(0, DATA - 1024 - size) }
            }
            _ => Addr { base: AddrBase::Static, offset: header::SIZE + self.rng.range(0, DATA - size) },
        }
    }

    fn load(&mut self) {
        let ty = self.any_type();
        let (addr, dst) = (self.place(ty.bytes()), self.local(ty));
        self.push(Op::Load(dst, addr));
    }

    fn store(&mut self) {
        let ty = self.any_type();
        let (addr, src) = (self.place(ty.bytes()), self.local(ty));
        self.push(Op::Store(addr, src));
    }

    /// Takes an address and stores through it.
    fn address(&mut self) {
        let addr = self.place(8);
        let dst = self.locals.push(Scalar::I32);
        let ty = self.any_type();
        let src = self.local(ty);
        self.push(Op::Address(dst, addr));
        self.push(Op::Store(Addr { base: AddrBase::Local(dst), offset: 0 }, src));
    }

    fn bytes(&mut self) {
        let most = if self.rng.one_in(3) { REACH } else { 150 };
        let size = self.rng.range(0, most);
        let to = self.place(size);
        if self.rng.one_in(3) {
            let value = self.rng.bits() as u8;
            return self.push(Op::FillBytes { to, size, value });
        }
        // Only one base can be a masked local: the other would overwrite it.
        let from = match to.base {
            AddrBase::Local(_) if self.rng.one_in(2) => Addr { base: to.base, offset: header::SIZE + self.rng.range(0, REACH) },
            _ => Addr { base: AddrBase::Static, offset: header::SIZE + self.rng.range(0, DATA - size) },
        };
        let (to, from) = if self.rng.one_in(2) { (to, from) } else { (from, to) };
        self.push(Op::CopyBytes { to, from, size });
    }

    /// Strings lie in slots of 128 bytes, or in the frame, so that they do not overlap.
    fn strings(&mut self) {
        let unit = self.rng.range(1, 2);
        let slot = self.rng.range(0, 15);
        let other = (slot + self.rng.range(0, 15)) % 16;
        let (a, a_capacity) = self.string(slot, unit);
        let (b, b_capacity) = self.string(other, unit);
        if self.rng.one_in(2) {
            let dst = self.local(Scalar::I8);
            return self.push(Op::CompareString { dst, a, a_capacity, b, b_capacity, unit });
        }
        let to = if slot == other { b } else { a };
        self.push(Op::CopyString { to, to_capacity: a_capacity, from: b, from_capacity: b_capacity, unit });
    }

    fn string(&mut self, slot: u32, unit: u32) -> (Addr, u32) {
        let offset = header::SIZE + slot * 128 + self.rng.range(0, 3);
        (Addr { base: AddrBase::Static, offset }, self.rng.range(0, 124 / unit - 1))
    }

    fn any_call(&mut self) {
        if self.rng.one_in(2) || self.module.functions.is_empty() || self.calls_left == 0 {
            return self.call_native();
        }
        self.calls_left -= 1;
        let callee = FuncId(self.rng.below(self.module.functions.len()) as u32);
        self.call(callee);
    }

    pub(super) fn call(&mut self, function: FuncId) {
        let callee = &self.module.functions[function];
        let (types, result): (Vec<Scalar>, _) = (callee.params.iter().map(|&p| callee.locals[p]).collect(), callee.result);
        let args = types.into_iter().map(|ty| self.local(ty)).collect();
        let dst = result.filter(|_| !self.rng.one_in(5)).map(|ty| self.local(ty));
        self.push(Op::Call { dst, function, args });
    }

    fn call_native(&mut self) {
        let most = self.module.natives.len() - usize::from(!self.rng.one_in(20));
        let native = NativeId(self.rng.below(most) as u32);
        let import = self.module.natives[native].clone();
        let params = takt_compiler::mir::verify::native_params(&import).to_vec();
        let args = params.into_iter().map(|ty| NativeArg { local: self.local(ty), signed: self.rng.one_in(2) }).collect();
        let result = takt_compiler::mir::verify::native_result(&import);
        let dst = result.filter(|_| !self.rng.one_in(5)).map(|ty| self.local(ty));
        self.push(Op::CallNative { dst, native, args });
    }

    /// Traps seldom: if a number is one of many, or, now and then, for any number but 0.
    fn trap_if(&mut self) {
        let (trap, a, value) = (self.trap(), self.local(Scalar::I64), self.locals.push(Scalar::I64));
        if self.rng.one_in(40) {
            return self.push(Op::TrapIf(trap, a));
        }
        let number = self.rng.bits() as i64;
        self.push(Op::Int(value, number));
        self.push(Op::Compare(Compare::Eq, self.is_number, a, value));
        self.push(Op::TrapIf(trap, self.is_number));
    }
}
