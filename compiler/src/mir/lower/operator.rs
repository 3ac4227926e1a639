//! Operators on scalars, and comparison of scalars and strings. Integers wrap; division by zero traps, MOD 0 gives 0.
//! From: language reference §5.3, §5.4; library reference §4, §6.2.

use super::expr::Value;
use super::unit::Unit;
use crate::hir::model::*;
use crate::mir::model::*;
use crate::syntax::ast::BinaryOp as Operator;
use takt_image::{Elementary, Scalar, Trap};

/// A scalar with what is known about it.
#[derive(Clone, Copy)]
pub struct Operand {
    pub local: Local,
    pub e: Elementary,
    /// Can't be 0.
    pub nonzero: bool,
}

impl Unit<'_, '_> {
    /// A scalar operand.
    pub fn scalar_operand(&mut self, e: &Expr) -> Operand {
        let nonzero = self.interval(e).is_some_and(|(low, high)| low > 0 || high < 0);
        Operand { local: self.value(e), e: self.hir.elementary(e.ty).expect("a scalar"), nonzero }
    }

    /// `a op b` with a result of type `result`; both sides are evaluated.
    pub fn operator(&mut self, op: Operator, a: &Expr, b: &Expr, result: Elementary) -> Local {
        if is_comparison(op) {
            let values = self.operands(&[a, b]);
            return self.comparison(op, values[0], values[1], self.hir.elementary(a.ty));
        }
        let (x, y) = (self.scalar_operand(a), self.scalar_operand(b));
        self.arithmetic(op, x, y, result)
    }

    /// Arithmetic and bit operations.
    pub fn arithmetic(&mut self, op: Operator, x: Operand, y: Operand, result: Elementary) -> Local {
        let scaled = matches!(op, Operator::Mul | Operator::Div);
        match op {
            Operator::Power => self.power(x, y, result),
            _ if scaled && x.e.is_duration() && !y.e.is_duration() => self.scale_time(op, x.local, y),
            Operator::Mul if y.e.is_duration() && !x.e.is_duration() => self.scale_time(op, y.local, x),
            _ if matches!(result, Elementary::Tod | Elementary::Ltod) => self.time_of_day(op, x.local, y.local),
            _ if result.is_real() => self.f.binary(float_op(op), x.local, y.local),
            Operator::Div => self.divide(x, y),
            Operator::Mod => self.modulo(x, y),
            _ => self.f.binary(integer_op(op), x.local, y.local),
        }
    }

    fn divide(&mut self, x: Operand, y: Operand) -> Local {
        if !y.nonzero {
            let zero = self.f.compare_const(Compare::Eq, y.local, 0);
            self.f.trap_if(Trap::DivisionByZero, zero);
        }
        let op = if x.e.is_signed_storage() { BinaryOp::SDiv } else { BinaryOp::UDiv };
        self.f.binary(op, x.local, y.local)
    }

    /// The remainder by 1 stands in for the remainder by 0: it is 0 too.
    fn modulo(&mut self, x: Operand, y: Operand) -> Local {
        let mut divisor = y.local;
        if !y.nonzero {
            let one = self.f.int(self.f.ty(divisor), 1);
            divisor = self.f.select(divisor, divisor, one);
        }
        let op = if x.e.is_signed_storage() { BinaryOp::SRem } else { BinaryOp::URem };
        self.f.binary(op, x.local, divisor)
    }

    /// `x ** y`, in f64.
    pub fn power(&mut self, x: Operand, y: Operand, result: Elementary) -> Local {
        let args = [(self.as_f64(x), Elementary::Lreal), (self.as_f64(y), Elementary::Lreal)];
        let power = self.native_scalar("EXPT_LREAL", &args, Elementary::Lreal);
        self.narrow_f64(power, result)
    }

    /// Comparison of two values of one type; `e` is `None` for strings.
    pub fn comparison(&mut self, op: Operator, a: Value, b: Value, e: Option<Elementary>) -> Local {
        match (a, b) {
            (Value::Scalar(x), Value::Scalar(y)) => self.f.compare(compare_op(op, e.unwrap_or(Elementary::Dint)), x, y),
            (Value::Text(x), Value::Text(y)) => {
                let dst = self.f.local(Scalar::I8);
                let (a_capacity, b_capacity) = (x.capacity, y.capacity);
                self.f.emit(Op::CompareString { dst, a: x.addr, a_capacity, b: y.addr, b_capacity, unit: x.unit });
                self.f.compare_const(compare_op(op, Elementary::Sint), dst, 0)
            }
            _ => unreachable!("arrays and structures have no order"),
        }
    }

    /// Values of all operands, left to right. What lies in memory is kept safe from calls further right.
    pub fn operands(&mut self, exprs: &[&Expr]) -> Vec<Value> {
        let last_call = exprs.iter().rposition(|e| super::walk::calls(e)).unwrap_or(0);
        let keep = |(i, e): (usize, &&Expr)| {
            let value = self.operand(e);
            if i < last_call { self.snapshot(value, e.ty) } else { value }
        };
        exprs.iter().enumerate().map(keep).collect()
    }

    /// A number as f64.
    pub fn as_f64(&mut self, x: Operand) -> Local {
        match x.e {
            Elementary::Lreal => x.local,
            Elementary::Real => self.f.convert(Convert::Float, Scalar::F64, x.local),
            _ => self.integer_to_float(x.local, x.e, Scalar::F64),
        }
    }

    fn narrow_f64(&mut self, x: Local, e: Elementary) -> Local {
        match e {
            Elementary::Lreal => x,
            Elementary::Real => self.f.convert(Convert::Float, Scalar::F32, x),
            _ => self.float_to_integer(x, e),
        }
    }

    /// Integer to real, rounded once: everything up to 32 bits fits a signed 64-bit number.
    pub fn integer_to_float(&mut self, x: Local, e: Elementary, to: Scalar) -> Local {
        let unsigned64 = !e.is_signed_storage() && e.bytes() == 8;
        let wide = self.f.resize(x, Scalar::I64, e.is_signed_storage());
        self.f.convert(if unsigned64 { Convert::UnsignedToFloat } else { Convert::SignedToFloat }, to, wide)
    }

    /// Real to the nearest integer, ties to even; saturates, NaN gives 0.
    pub fn float_to_integer(&mut self, x: Local, e: Elementary) -> Local {
        let nearest = self.f.unary(UnaryOp::FNearest, x);
        self.truncate(nearest, e)
    }

    /// Real to integer toward zero; saturates, NaN gives 0.
    pub fn truncate(&mut self, x: Local, e: Elementary) -> Local {
        let how = if e.is_signed_storage() { Convert::FloatToSigned } else { Convert::FloatToUnsigned };
        self.f.convert(how, e.scalar(), x)
    }
}

/// True for the six comparisons.
pub fn is_comparison(op: Operator) -> bool {
    use Operator::{Eq, Ge, Gt, Le, Lt, Ne};
    matches!(op, Eq | Ne | Lt | Gt | Le | Ge)
}

fn float_op(op: Operator) -> BinaryOp {
    match op {
        Operator::Add => BinaryOp::FAdd,
        Operator::Sub => BinaryOp::FSub,
        Operator::Mul => BinaryOp::FMul,
        Operator::Div => BinaryOp::FDiv,
        _ => unreachable!("{} is not defined for reals", op.text()),
    }
}

fn integer_op(op: Operator) -> BinaryOp {
    match op {
        Operator::Add => BinaryOp::Add,
        Operator::Sub => BinaryOp::Sub,
        Operator::Mul => BinaryOp::Mul,
        Operator::And | Operator::AndThen => BinaryOp::And,
        Operator::Or | Operator::OrElse => BinaryOp::Or,
        Operator::Xor => BinaryOp::Xor,
        _ => unreachable!("{} is lowered elsewhere", op.text()),
    }
}

/// The machine comparison for a type: of reals, signed or unsigned.
pub fn compare_op(op: Operator, e: Elementary) -> Compare {
    use Compare::*;
    let [eq, ne, lt, le, gt, ge] = match (e.is_real(), e.is_signed_storage()) {
        (true, _) => [FEq, FNe, FLt, FLe, FGt, FGe],
        (_, true) => [Eq, Ne, SLt, SLe, SGt, SGe],
        _ => [Eq, Ne, ULt, ULe, UGt, UGe],
    };
    match op {
        Operator::Eq => eq,
        Operator::Ne => ne,
        Operator::Lt => lt,
        Operator::Le => le,
        Operator::Gt => gt,
        Operator::Ge => ge,
        _ => unreachable!("{} is no comparison", op.text()),
    }
}
