//! Calls with EN and ENO: what may go wrong gives the value that the library states, and ENO is FALSE.
//! From: language reference §4.8; library reference §1 ("E:").

use super::builder::fixed;
use super::expr::{Text, Value};
use super::operator::Operand;
use super::shape::Shape;
use super::unit::Unit;
use crate::hir::model::*;
use crate::mir::model::*;
use crate::syntax::ast::BinaryOp as Operator;
use takt_image::{Elementary, Scalar, header};
use takt_stdlib::catalog::Intrinsic;

/// A value and whether it came about without an error; `None`: nothing can go wrong.
type Checked = (Value, Option<Local>);

impl Unit<'_, '_> {
    /// The value of the call; zero if it is not run.
    pub fn guarded(&mut self, g: &Guarded) -> Value {
        match &g.en {
            None => self.checked_call(g),
            Some(en) => self.optional_call(g, en),
        }
    }

    fn checked_call(&mut self, g: &Guarded) -> Value {
        let line = self.at_line(g.call.span);
        let (value, ok) = self.checked_value(&g.call);
        // ENO may go to a variable that the value still is.
        let value = match value {
            Value::Scalar(l) => Value::Scalar(self.f.duplicate(l)),
            value if g.eno.is_some() => self.snapshot(value, g.call.ty),
            value => value,
        };
        self.hand_eno(g, ok);
        self.f.line = line;
        value
    }

    /// Writes ENO, unless the unit declares it and did so.
    pub fn hand_eno(&mut self, g: &Guarded, ok: Option<Local>) {
        let Some(eno) = g.eno.as_ref().filter(|eno| !eno.written) else { return };
        let ok = ok.unwrap_or_else(|| self.f.int(Scalar::I8, 1));
        let ok = if eno.negated { self.complement(ok, Elementary::Bool) } else { ok };
        let to = self.place(&eno.target);
        self.store(to, ok);
    }

    fn optional_call(&mut self, g: &Guarded, en: &Expr) -> Value {
        let (run, skip, done) = (self.f.block(), self.f.block(), self.f.block());
        let ty = g.call.ty;
        let layout = self.hir.types.layout(ty);
        let shape = self.shape(ty);
        let result = match shape {
            Shape::Scalar(e) => Value::Scalar(self.f.local(e.scalar())),
            Shape::Text { capacity, unit } => Value::Text(Text { addr: self.text_temp(capacity, unit), capacity, unit }),
            Shape::Bytes => Value::Bytes(self.f.temp(layout.size, layout.align)),
        };
        self.branch_on(en, run, skip);
        self.f.enter(run);
        let value = self.checked_call(g);
        match (result, value) {
            (Value::Scalar(to), Value::Scalar(from)) => self.f.copy(to, from),
            (Value::Text(to), Value::Text(from)) => self.copy_text(to, from),
            (Value::Bytes(to), Value::Bytes(from)) => self.f.emit(Op::CopyBytes { to, from, size: layout.size }),
            _ => unreachable!("shapes of one type"),
        }
        self.f.jump(done);
        self.f.enter(skip);
        match (result, shape) {
            (Value::Scalar(to), Shape::Scalar(e)) => {
                let zero = self.f.zero(e.scalar());
                self.f.copy(to, zero);
            }
            (Value::Text(to), _) => self.f.emit(Op::FillBytes { to: to.addr, size: to.unit, value: 0 }),
            (Value::Bytes(to), _) => self.f.emit(Op::FillBytes { to, size: layout.size, value: 0 }),
            _ => unreachable!("shapes of one type"),
        }
        if let Some(eno) = &g.eno {
            let value = self.f.int(Scalar::I8, i64::from(eno.negated));
            let to = self.place(&eno.target);
            self.store(to, value);
        }
        self.f.jump(done);
        self.f.enter(done);
        result
    }

    fn checked_value(&mut self, e: &Expr) -> Checked {
        match &e.kind {
            ExprKind::Binary(op @ (Operator::Div | Operator::Mod), a, b) => self.checked_quotient(*op, a, b, e),
            ExprKind::Binary(op @ (Operator::Add | Operator::Sub), a, b) if self.is_time_of_day(e) => {
                let (x, y) = (self.scalar_operand(a), self.scalar_operand(b));
                let value = self.time_of_day(*op, x.local, y.local);
                let plain = self.f.binary(if *op == Operator::Add { BinaryOp::Add } else { BinaryOp::Sub }, x.local, y.local);
                let ok = self.f.compare(Compare::Eq, value, plain);
                (Value::Scalar(value), Some(ok))
            }
            ExprKind::Intrinsic(i, args) => self.checked_intrinsic(*i, args, e),
            ExprKind::Convert(how, a) => self.checked_conversion(*how, a, e),
            ExprKind::Native { name, args } => {
                let values = self.operands(&args.iter().collect::<Vec<_>>());
                let on = self.f.int(Scalar::I8, 1);
                self.f.store(fixed(header::ENO), on);
                let value = self.native_of(name, values, args, e.ty);
                let ok = self.f.load(Scalar::I8, fixed(header::ENO));
                (value, Some(ok))
            }
            _ => (self.operand(e), None),
        }
    }

    fn is_time_of_day(&self, e: &Expr) -> bool {
        matches!(self.hir.elementary(e.ty), Some(Elementary::Tod | Elementary::Ltod))
    }

    /// Divided by 0 it is 0; reals follow IEEE 754, but ENO tells it too.
    fn checked_quotient(&mut self, op: Operator, a: &Expr, b: &Expr, e: &Expr) -> Checked {
        let result = self.hir.elementary(e.ty).expect("a scalar");
        let (x, y) = (self.scalar_operand(a), self.scalar_operand(b));
        let ok = self.is_not_zero(y);
        if result.is_real() || x.e.is_duration() {
            let value = self.arithmetic(op, x, y, result);
            return (Value::Scalar(value), Some(ok));
        }
        let ty = self.f.ty(y.local);
        let one = self.f.int(ty, 1);
        let safe = self.f.select(ok, y.local, one);
        let value = self.arithmetic(op, x, Operand { local: safe, nonzero: true, ..y }, result);
        let zero = self.f.zero(ty);
        let value = self.f.select(ok, value, zero);
        (Value::Scalar(value), Some(ok))
    }

    fn is_not_zero(&mut self, y: Operand) -> Local {
        let zero = self.f.zero(y.e.scalar());
        self.f.compare(if y.e.is_real() { Compare::FNe } else { Compare::Ne }, y.local, zero)
    }

    fn checked_intrinsic(&mut self, i: Intrinsic, args: &[Expr], e: &Expr) -> Checked {
        match (i, args) {
            (Intrinsic::Div, [a, b]) => self.checked_quotient(Operator::Div, a, b, e),
            (Intrinsic::Mod, [a, b]) => self.checked_quotient(Operator::Mod, a, b, e),
            (Intrinsic::Sqrt | Intrinsic::Expt, _) => {
                let value = self.intrinsic(i, args, e.ty);
                let Value::Scalar(local) = value else { return (value, None) };
                let ok = self.finite_number(local, e);
                (value, Some(ok))
            }
            (Intrinsic::Shl | Intrinsic::Shr, [a, n]) => {
                let (x, n) = (self.scalar_operand(a), self.scalar_operand(n));
                let ok = n.e.is_signed_storage().then(|| self.f.compare_const(Compare::SGe, n.local, 0));
                (self.shifted(i, x, n), ok)
            }
            (Intrinsic::Mux | Intrinsic::MuxLast, [k, inputs @ ..]) => {
                let values = self.operands(&args.iter().collect::<Vec<_>>());
                let Value::Scalar(number) = values[0] else { unreachable!("K is a scalar") };
                let signed = self.hir.elementary(k.ty).is_some_and(Elementary::is_signed_storage);
                let number = self.f.resize(number, Scalar::I64, signed);
                let ok = self.f.compare_const(Compare::ULt, number, inputs.len() as i64);
                let otherwise = if i == Intrinsic::Mux { 1 } else { inputs.len() };
                (self.mux(values, k, otherwise), Some(ok))
            }
            (Intrinsic::Trunc, [a]) => {
                let x = self.scalar_operand(a);
                let target = self.hir.elementary(e.ty).expect("a scalar");
                let wide = self.as_f64(x);
                let whole = self.f.unary(UnaryOp::FTrunc, wide);
                let ok = self.within(whole, target);
                (Value::Scalar(self.truncate(x.local, target)), ok)
            }
            _ => (self.intrinsic(i, args, e.ty), None),
        }
    }

    /// Neither NaN nor infinite.
    fn finite_number(&mut self, local: Local, e: &Expr) -> Local {
        let real = self.hir.elementary(e.ty).expect("a scalar");
        self.is_finite(Operand { local, e: real, nonzero: false })
    }

    fn checked_conversion(&mut self, how: Conversion, a: &Expr, e: &Expr) -> Checked {
        let (Some(from), Some(to)) = (self.hir.elementary(a.ty), self.hir.elementary(e.ty)) else {
            return (self.operand(e), None);
        };
        if how == Conversion::Subrange {
            return (self.operand(e), None);
        }
        let x = self.scalar_operand(a);
        let value = self.convert_value(how, x.local, from, e.ty, None);
        let ok = match how {
            Conversion::Integer if from.is_int() && to.is_int() => self.same_number(x.local, from, value, to),
            Conversion::RealToIntAway => {
                let wide = self.as_f64(x);
                let whole = self.nearest_away(wide, Elementary::Lreal);
                self.within(whole, to)
            }
            Conversion::RealToInt => {
                let wide = self.as_f64(x);
                let whole = self.f.unary(UnaryOp::FNearest, wide);
                self.within(whole, to)
            }
            Conversion::Real if to == Elementary::Real => {
                let (was, is) = (self.is_finite(x), self.finite_number(value, e));
                let not = self.complement(was, Elementary::Bool);
                Some(self.f.binary(BinaryOp::Or, is, not))
            }
            _ => None,
        };
        (Value::Scalar(value), ok)
    }

    /// The converted integer is the number that it was.
    fn same_number(&mut self, x: Local, from: Elementary, y: Local, to: Elementary) -> Option<Local> {
        if from.widens_to(to) {
            return None;
        }
        let before = self.f.resize(x, Scalar::I64, from.is_signed_storage());
        let after = self.f.resize(y, Scalar::I64, to.is_signed_storage());
        let same = self.f.compare(Compare::Eq, before, after);
        if from.is_signed_storage() == to.is_signed_storage() {
            return Some(same);
        }
        let positive = self.f.compare_const(Compare::SGe, before, 0);
        Some(self.f.binary(BinaryOp::And, same, positive))
    }

    /// A whole number in f64 is in the range of an integer type; NaN is not.
    fn within(&mut self, whole: Local, to: Elementary) -> Option<Local> {
        let (low, high) = to.int_range()?;
        let (low, above) = (self.f.float(Scalar::F64, low as f64), self.f.float(Scalar::F64, (high + 1) as f64));
        let (a, b) = (self.f.compare(Compare::FGe, whole, low), self.f.compare(Compare::FLt, whole, above));
        Some(self.f.binary(BinaryOp::And, a, b))
    }
}
