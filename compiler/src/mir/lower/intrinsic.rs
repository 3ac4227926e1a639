//! Functions that are a few instructions. From: library reference §3 to §6, §9.

use super::builder::fixed;
use super::expr::{Text, Value};
use super::operator::Operand;
use super::unit::Unit;
use crate::hir::model::*;
use crate::mir::model::*;
use crate::syntax::ast::BinaryOp as Operator;
use takt_image::{Elementary, Scalar, TypeId, header};
use takt_stdlib::catalog::Intrinsic;

impl Unit<'_, '_> {
    /// A standard function; `ty` is the type of its result.
    pub fn intrinsic(&mut self, i: Intrinsic, args: &[Expr], ty: TypeId) -> Value {
        use Intrinsic::*;
        match i {
            Sel | Mux | MuxLast | LimitLow | Max | Min | Limit | Move => self.selection(i, args, ty),
            Add => self.fold(Operator::Add, args, ty),
            Sub => self.fold(Operator::Sub, args, ty),
            Mul => self.fold(Operator::Mul, args, ty),
            Div => self.fold(Operator::Div, args, ty),
            Mod => self.fold(Operator::Mod, args, ty),
            Expt => self.fold(Operator::Power, args, ty),
            And => self.fold(Operator::And, args, ty),
            Or => self.fold(Operator::Or, args, ty),
            Xor => self.fold(Operator::Xor, args, ty),
            Gt => self.chain(Operator::Gt, args),
            Ge => self.chain(Operator::Ge, args),
            Eq => self.chain(Operator::Eq, args),
            Le => self.chain(Operator::Le, args),
            Lt => self.chain(Operator::Lt, args),
            Ne => self.chain(Operator::Ne, args),
            Shl | Shr => self.shift(i, args),
            Rol | Ror => self.rotate(i, args),
            Now => Value::Scalar(self.f.load(Scalar::I64, fixed(header::NOW))),
            Abs | Sqrt | Not | Trunc | IsValid => self.one_input(i, args, ty),
        }
    }

    fn one_input(&mut self, i: Intrinsic, args: &[Expr], ty: TypeId) -> Value {
        let x = self.scalar_operand(&args[0]);
        let target = self.hir.elementary(ty).expect("a scalar");
        Value::Scalar(match i {
            Intrinsic::Abs => self.abs(x),
            Intrinsic::Sqrt => self.f.unary(UnaryOp::FSqrt, x.local),
            Intrinsic::Not => self.complement(x.local, x.e),
            Intrinsic::Trunc => self.truncate(x.local, target),
            _ => self.is_finite(x),
        })
    }

    /// Magnitude; that of the smallest integer wraps to itself.
    fn abs(&mut self, x: Operand) -> Local {
        if x.e.is_real() {
            return self.f.unary(UnaryOp::FAbs, x.local);
        }
        if !x.e.is_signed_storage() {
            return x.local;
        }
        let minus = self.f.compare_const(Compare::SLt, x.local, 0);
        let negated = self.f.unary(UnaryOp::Neg, x.local);
        self.f.select(minus, negated, x.local)
    }

    /// `x - x` is 0 for all numbers, NaN for NaN and the infinities.
    pub fn is_finite(&mut self, x: Operand) -> Local {
        let nothing = self.f.binary(BinaryOp::FSub, x.local, x.local);
        let zero = self.f.zero(x.e.scalar());
        self.f.compare(Compare::FEq, nothing, zero)
    }

    fn fold(&mut self, op: Operator, args: &[Expr], ty: TypeId) -> Value {
        let e = self.hir.elementary(ty).expect("a scalar");
        let operands: Vec<_> = args.iter().map(|a| self.scalar_operand(a)).collect();
        let step = |x: Operand, y: &Operand| Operand { local: self.arithmetic(op, x, *y, e), e, nonzero: false };
        let result = operands[1..].iter().fold(operands[0], step);
        Value::Scalar(result.local)
    }

    /// `GT(a, b, c)` = (a > b) AND (b > c).
    fn chain(&mut self, op: Operator, args: &[Expr]) -> Value {
        let values = self.operands(&args.iter().collect::<Vec<_>>());
        let e = self.hir.elementary(args[0].ty);
        let pairs: Vec<_> = values.windows(2).map(|w| self.comparison(op, w[0], w[1], e)).collect();
        let all = pairs.into_iter().reduce(|a, b| self.f.binary(BinaryOp::And, a, b));
        Value::Scalar(all.expect("two operands at least"))
    }

    /// SHL, SHR: 0 from the width on; a negative amount changes nothing.
    fn shift(&mut self, i: Intrinsic, args: &[Expr]) -> Value {
        let (x, n) = (self.scalar_operand(&args[0]), self.scalar_operand(&args[1]));
        self.shifted(i, x, n)
    }

    /// Like [`Unit::shift`], with the operands at hand.
    pub fn shifted(&mut self, i: Intrinsic, x: Operand, n: Operand) -> Value {
        let ty = self.f.ty(x.local);
        let amount = self.f.resize(n.local, Scalar::I64, n.e.is_signed_storage());
        let below = self.f.compare_const(Compare::ULt, amount, x.e.bits() as i64);
        let none = self.f.zero(Scalar::I64);
        let safe = self.f.select(below, amount, none);
        let safe = self.f.resize(safe, ty, false);
        let op = if i == Intrinsic::Shl { BinaryOp::Shl } else { BinaryOp::LShr };
        let shifted = self.f.binary(op, x.local, safe);
        let zero = self.f.zero(ty);
        if !n.e.is_signed_storage() {
            return Value::Scalar(self.f.select(below, shifted, zero));
        }
        let negative = self.f.compare_const(Compare::SLt, amount, 0);
        let outside = self.f.select(negative, x.local, zero);
        Value::Scalar(self.f.select(below, shifted, outside))
    }

    /// ROL, ROR by N modulo the width, a power of two: the low bits of N, which turn a negative N into the other direction.
    fn rotate(&mut self, i: Intrinsic, args: &[Expr]) -> Value {
        let (x, n) = (self.scalar_operand(&args[0]), self.scalar_operand(&args[1]));
        if x.e == Elementary::Bool {
            return Value::Scalar(x.local);
        }
        let amount = self.f.resize(n.local, self.f.ty(x.local), n.e.is_signed_storage());
        let amount = self.f.binary_const(BinaryOp::And, amount, x.e.bits() as i64 - 1);
        Value::Scalar(self.f.binary(if i == Intrinsic::Rol { BinaryOp::Rotl } else { BinaryOp::Rotr }, x.local, amount))
    }

    /// Functions that hand on one of their inputs, of any type.
    fn selection(&mut self, i: Intrinsic, args: &[Expr], ty: TypeId) -> Value {
        let values = self.operands(&args.iter().collect::<Vec<_>>());
        let e = self.hir.elementary(ty);
        match i {
            Intrinsic::Sel => self.choose(scalar_of(values[0]), values[2], values[1]),
            Intrinsic::Mux => self.mux(values, &args[0], 1),
            Intrinsic::MuxLast => {
                let last = values.len() - 1;
                self.mux(values, &args[0], last)
            }
            Intrinsic::Limit => {
                let raised = self.extreme(Operator::Gt, values[1], values[0], e);
                self.extreme(Operator::Lt, raised, values[2], e)
            }
            Intrinsic::LimitLow => {
                let high = self.extreme(Operator::Lt, values[1], values[2], e);
                let above = self.comparison(Operator::Gt, values[1], values[0], e);
                self.choose(above, high, values[0])
            }
            Intrinsic::Max | Intrinsic::Min => {
                let op = if i == Intrinsic::Max { Operator::Gt } else { Operator::Lt };
                values[1..].iter().fold(values[0], |a, b| self.extreme(op, a, *b, e))
            }
            _ => values[0],
        }
    }

    /// Input number K, from 0; the one at `otherwise`, counted from 1, if there is none.
    pub fn mux(&mut self, values: Vec<Value>, k: &Expr, otherwise: usize) -> Value {
        let e = self.hir.elementary(k.ty).expect("an integer");
        let k = self.f.resize(scalar_of(values[0]), Scalar::I64, e.is_signed_storage());
        let mut chosen = values[otherwise];
        for (value, number) in values[1..].iter().zip(0..) {
            let this = self.f.compare_const(Compare::Eq, k, number);
            chosen = self.choose(this, *value, chosen);
        }
        chosen
    }

    /// `a` if `a op b` or if `b` is NaN, else `b`.
    fn extreme(&mut self, op: Operator, a: Value, b: Value, e: Option<Elementary>) -> Value {
        let mut first = self.comparison(op, a, b, e);
        if e.is_some_and(Elementary::is_real) {
            let b = scalar_of(b);
            let nan = self.f.compare(Compare::FNe, b, b);
            first = self.f.binary(BinaryOp::Or, first, nan);
        }
        self.choose(first, a, b)
    }

    fn choose(&mut self, condition: Local, then: Value, otherwise: Value) -> Value {
        let (a, b) = (self.address_of(then), self.address_of(otherwise));
        let chosen = self.f.select(condition, a, b);
        match (self.relocated(then, chosen), otherwise) {
            // Both end with a zero, so the larger capacity is right for either.
            (Value::Text(t), Value::Text(o)) => Value::Text(Text { capacity: t.capacity.max(o.capacity), ..t }),
            (value, _) => value,
        }
    }
}

fn scalar_of(value: Value) -> Local {
    match value {
        Value::Scalar(l) => l,
        _ => unreachable!("a scalar argument"),
    }
}
