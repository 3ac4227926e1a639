//! Expressions: scalars become locals, everything else an address.

use super::builder::{at, fixed};
use super::data::bytes_of;
use super::place::Loc;
use super::pointer::Purpose;
use super::shape::Shape;
use super::unit::Unit;
use crate::hir::model::*;
use crate::mir::model::*;
use crate::syntax::ast::BinaryOp as Operator;
use takt_base::Span;
use takt_image::types::PointerKind;
use takt_image::{Elementary, Scalar, Type, TypeId};

/// A string in memory.
#[derive(Clone, Copy, Debug)]
pub struct Text {
    pub addr: Addr,
    /// Characters that may be there.
    pub capacity: u32,
    /// Bytes of a character.
    pub unit: u32,
}

/// A value of any shape.
#[derive(Clone, Copy, Debug)]
pub enum Value {
    Scalar(Local),
    Text(Text),
    Bytes(Addr),
}

impl Unit<'_, '_> {
    /// Any value.
    pub fn operand(&mut self, e: &Expr) -> Value {
        match self.shape(e.ty) {
            Shape::Scalar(_) => Value::Scalar(self.value(e)),
            Shape::Text { .. } => Value::Text(self.text(e)),
            Shape::Bytes => Value::Bytes(self.bytes(e)),
        }
    }

    /// A scalar. The local may be that of a variable: it is not to be written, and is stale after the statement.
    pub fn value(&mut self, e: &Expr) -> Local {
        let line = self.at_line(e.span);
        let value = self.scalar_value(e);
        self.f.line = line;
        value
    }

    fn scalar_value(&mut self, e: &Expr) -> Local {
        let elementary = self.hir.elementary(e.ty).expect("a scalar");
        match &e.kind {
            ExprKind::Const(c) => self.constant(elementary, c),
            ExprKind::Load(p) => self.read(p),
            ExprKind::Address(p) => self.address_value(p, e.ty),
            ExprKind::Neg(a) => {
                let value = self.value(a);
                self.f.unary(if elementary.is_real() { UnaryOp::FNeg } else { UnaryOp::Neg }, value)
            }
            ExprKind::Not(a) => {
                let value = self.value(a);
                self.complement(value, elementary)
            }
            ExprKind::Binary(op @ (Operator::AndThen | Operator::OrElse), a, b) => self.short_circuit(*op, a, b),
            ExprKind::Binary(op, a, b) => self.operator(*op, a, b, elementary),
            ExprKind::Convert(how, a) => self.convert(*how, a, e.ty),
            ExprKind::Call { pou, args } => match self.call(*pou, args, e.span) {
                Some(Value::Scalar(l)) => l,
                _ => unreachable!("a function with a scalar result"),
            },
            ExprKind::Guarded(g) => match self.guarded(g) {
                Value::Scalar(l) => l,
                _ => unreachable!("a call with a scalar result"),
            },
            ExprKind::CallMethod(c) => match self.call_method(c, e.span) {
                Some(Value::Scalar(l)) => l,
                _ => unreachable!("a method with a scalar result"),
            },
            ExprKind::AddressOf(p) => {
                let addr = self.memory(p, Purpose::Address);
                self.f.address(addr)
            }
            ExprKind::OfClass(a, classes) => self.of_class(a, classes),
            ExprKind::Stored(s) => {
                let to = self.place(&s.0);
                let value = self.operand(&s.1);
                self.assign(to, s.0.ty, value);
                let stored = self.load(to, s.0.ty);
                self.f.duplicate(stored)
            }
            ExprKind::Intrinsic(i, args) => match self.intrinsic(*i, args, e.ty) {
                Value::Scalar(l) => l,
                _ => unreachable!("an intrinsic with a scalar result"),
            },
            ExprKind::Native { name, args } => match self.native(name, args, e.ty) {
                Value::Scalar(l) => l,
                _ => unreachable!("a native with a scalar result"),
            },
        }
    }

    fn read(&mut self, p: &Place) -> Local {
        if let Some(counter) = self.counter(p) {
            return counter.register;
        }
        let loc = self.place_for(p, Purpose::Read);
        let value = self.load(loc, p.ty);
        let any_byte =
            self.hir.elementary(p.ty) == Some(Elementary::Bool) && !matches!(loc, Loc::Bit(..)) && self.shares_bytes(p);
        if any_byte { self.f.compare_const(Compare::Ne, value, 0) } else { value }
    }

    /// True if something else may have written the bytes of the place.
    fn shares_bytes(&self, p: &Place) -> bool {
        let mut ty = match p.base {
            Base::Var(v) => self.var(v).ty,
            Base::Global(g) => self.hir.globals[g].ty,
            Base::This => self.this_type(),
            Base::Image(_) | Base::Value(_) => return p.derefs(),
        };
        for step in &p.path {
            ty = match (step, self.hir.types.get(ty)) {
                (Step::Deref, _) => return true,
                (Step::Field(_), _) if self.hir.types.overlaps(ty) => return true,
                (Step::Field(i), Type::Struct(r) | Type::Instance(r)) => r.fields[*i as usize].ty,
                (Step::Index(_), Type::Array { element, .. } | Type::Open { element, .. }) => *element,
                _ => return false,
            };
        }
        false
    }

    /// REF and ADR.
    fn address_value(&mut self, p: &Place, ty: TypeId) -> Local {
        let checked = matches!(self.hir.types.get(ty), Type::Pointer { kind: PointerKind::RefTo, .. });
        match self.place_for(p, if checked { Purpose::Read } else { Purpose::Address }) {
            Loc::Memory(addr) => self.f.address(addr),
            _ => unreachable!("bits and registers are not referred to"),
        }
    }

    /// A constant in a register.
    pub fn constant(&mut self, e: Elementary, value: &Const) -> Local {
        let s = e.scalar();
        match value {
            Const::Int(i) if s == Scalar::F32 => self.f.float(s, *i as f32 as f64),
            Const::Int(i) if s == Scalar::F64 => self.f.float(s, *i as f64),
            Const::Int(i) => self.f.int(s, *i as i64),
            Const::Address(global, bytes) => {
                self.f.int(s, super::init::address(&self.program.view.globals, *global, *bytes).into())
            }
            Const::Real(r) if s == Scalar::F32 => self.f.float(s, *r as f32 as f64),
            Const::Real(r) => self.f.float(s, *r),
            _ => self.f.zero(s),
        }
    }

    /// NOT: of a BOOL 1 and 0 change places, of a bit string all bits.
    pub fn complement(&mut self, value: Local, e: Elementary) -> Local {
        if e == Elementary::Bool { self.f.binary_const(BinaryOp::Xor, value, 1) } else { self.f.unary(UnaryOp::Not, value) }
    }

    /// AND_THEN, OR_ELSE: the right side runs only if it decides.
    fn short_circuit(&mut self, op: Operator, a: &Expr, b: &Expr) -> Local {
        let result = self.f.local(Scalar::I8);
        let (more, done) = (self.f.block(), self.f.block());
        let first = self.value(a);
        self.f.copy(result, first);
        if op == Operator::AndThen {
            self.f.branch(first, more, done)
        } else {
            self.f.branch(first, done, more)
        }
        self.f.enter(more);
        let second = self.value(b);
        self.f.copy(result, second);
        self.f.jump(done);
        self.f.enter(done);
        result
    }

    /// Goes to `then` if the condition holds, else to `otherwise`; short circuits become jumps.
    pub fn branch_on(&mut self, condition: &Expr, then: BlockId, otherwise: BlockId) {
        match &condition.kind {
            ExprKind::Not(a) => self.branch_on(a, otherwise, then),
            ExprKind::Binary(op @ (Operator::AndThen | Operator::OrElse), a, b) => {
                let more = self.f.block();
                let (t, o) = if *op == Operator::AndThen { (more, otherwise) } else { (then, more) };
                self.branch_on(a, t, o);
                self.f.enter(more);
                self.branch_on(b, then, otherwise);
            }
            _ => {
                let value = self.value(condition);
                let line = self.at_line(condition.span);
                self.f.branch(value, then, otherwise);
                self.f.line = line;
            }
        }
    }

    /// A string.
    pub fn text(&mut self, e: &Expr) -> Text {
        let line = self.at_line(e.span);
        let text = self.text_value(e);
        self.f.line = line;
        text
    }

    fn text_value(&mut self, e: &Expr) -> Text {
        let Shape::Text { capacity, unit } = self.shape(e.ty) else { unreachable!("a string") };
        let here = |addr| Text { addr, capacity, unit };
        match &e.kind {
            ExprKind::Const(c) => here(self.pooled(e.ty, c, e.span)),
            ExprKind::Load(p) => here(self.memory(p, Purpose::Read)),
            ExprKind::Convert(Conversion::String, a) => self.string_of(a, capacity, unit),
            ExprKind::Guarded(g) => match self.guarded(g) {
                Value::Text(t) => t,
                _ => unreachable!("a call with a string result"),
            },
            ExprKind::Intrinsic(i, args) => match self.intrinsic(*i, args, e.ty) {
                Value::Text(t) => t,
                _ => unreachable!("an intrinsic with a string result"),
            },
            ExprKind::Native { name, args } => match self.native(name, args, e.ty) {
                Value::Text(t) => t,
                _ => unreachable!("a native with a string result"),
            },
            ExprKind::CallMethod(c) => match self.call_method(c, e.span) {
                Some(Value::Text(t)) => t,
                _ => unreachable!("a method with a string result"),
            },
            ExprKind::Call { pou, args } => match self.call(*pou, args, e.span) {
                Some(Value::Text(t)) => t,
                _ => unreachable!("a function with a string result"),
            },
            _ => unreachable!("strings have no operators"),
        }
    }

    /// STRING of another capacity, or a CHAR as a string.
    fn string_of(&mut self, a: &Expr, capacity: u32, unit: u32) -> Text {
        if let Shape::Text { .. } = self.shape(a.ty) {
            let text = self.text(a);
            return self.cut(text, capacity);
        }
        let c = self.value(a);
        let addr = self.f.temp(2 * unit, unit);
        self.f.store(addr, c);
        let zero = self.f.zero(self.f.ty(c));
        self.f.store(super::builder::behind(addr, unit), zero);
        Text { addr, capacity: 1, unit }
    }

    /// The string with at most `capacity` characters.
    pub fn cut(&mut self, text: Text, capacity: u32) -> Text {
        if text.capacity <= capacity {
            return text;
        }
        let addr = self.text_temp(capacity, text.unit);
        let short = Text { addr, capacity, unit: text.unit };
        self.copy_text(short, text);
        short
    }

    /// Space for a string on the frame.
    pub fn text_temp(&mut self, capacity: u32, unit: u32) -> Addr {
        self.f.temp(capacity.saturating_add(1).saturating_mul(unit), unit)
    }

    /// Copies a string, cut to what fits.
    pub fn copy_text(&mut self, to: Text, from: Text) {
        self.f.emit(Op::CopyString {
            to: to.addr,
            to_capacity: to.capacity,
            from: from.addr,
            from_capacity: from.capacity,
            unit: to.unit,
        });
    }

    /// An array or structure.
    fn bytes(&mut self, e: &Expr) -> Addr {
        let line = self.at_line(e.span);
        let addr = match &e.kind {
            ExprKind::Const(c) => self.pooled(e.ty, c, e.span),
            ExprKind::Load(p) => self.memory(p, Purpose::Read),
            ExprKind::Convert(_, a) => self.bytes(a),
            ExprKind::Guarded(g) => match self.guarded(g) {
                Value::Bytes(a) => a,
                _ => unreachable!("a call with an aggregate result"),
            },
            ExprKind::Intrinsic(i, args) => match self.intrinsic(*i, args, e.ty) {
                Value::Bytes(a) => a,
                _ => unreachable!("an intrinsic with an aggregate result"),
            },
            ExprKind::CallMethod(c) => match self.call_method(c, e.span) {
                Some(Value::Bytes(a)) => a,
                _ => unreachable!("a method with an aggregate result"),
            },
            ExprKind::Call { pou, args } => match self.call(*pou, args, e.span) {
                Some(Value::Bytes(a)) => a,
                _ => unreachable!("a function with an aggregate result"),
            },
            _ => unreachable!("aggregates have no operators"),
        };
        self.f.line = line;
        addr
    }

    /// Address of something that is in memory.
    pub fn memory(&mut self, p: &Place, purpose: Purpose) -> Addr {
        match self.place_for(p, purpose) {
            Loc::Memory(addr) => addr,
            _ => unreachable!("strings, arrays and structures are in memory"),
        }
    }

    /// Address of a constant.
    pub fn pooled(&mut self, ty: TypeId, value: &Const, span: Span) -> Addr {
        let bytes = bytes_of(self.hir, &self.program.view.globals, ty, value);
        match self.program.data.pooled(bytes) {
            Some(offset) => fixed(offset),
            None => {
                self.program.diags.push(super::data::too_large(span, "this constant"));
                fixed(0)
            }
        }
    }

    /// Copies a string or bytes; `from` and `to` are the shapes on both sides.
    pub fn copy_aggregate(&mut self, to: Addr, to_shape: Shape, from: Addr, from_shape: Shape, ty: TypeId) {
        match (to_shape, from_shape) {
            (Shape::Text { capacity, unit }, Shape::Text { capacity: from_capacity, .. }) => {
                let source = Text { addr: from, capacity: from_capacity, unit };
                self.copy_text(Text { addr: to, capacity, unit }, source);
            }
            _ => self.copy_bytes(to, from, ty),
        }
    }

    /// Assigns a value to a place of type `ty`.
    pub fn assign(&mut self, to: Loc, ty: TypeId, value: Value) {
        match (value, to, self.shape(ty)) {
            (Value::Scalar(l), loc, _) => self.store(loc, l),
            (Value::Text(t), Loc::Memory(addr), Shape::Text { capacity, unit }) => {
                self.copy_text(Text { addr, capacity, unit }, t);
            }
            (Value::Bytes(from), Loc::Memory(to), _) if from != to => {
                self.copy_bytes(to, from, ty);
            }
            _ => {}
        }
    }

    /// A copy of a value in memory that later calls can't change.
    pub fn snapshot(&mut self, value: Value, ty: TypeId) -> Value {
        let layout = self.hir.types.layout(ty);
        match value {
            Value::Scalar(_) => value,
            Value::Text(t) => {
                let addr = self.text_temp(t.capacity, t.unit);
                let copy = Text { addr, ..t };
                self.copy_text(copy, t);
                Value::Text(copy)
            }
            Value::Bytes(from) => {
                let to = self.f.temp(layout.size, layout.align);
                self.f.emit(Op::CopyBytes { to, from, size: layout.size });
                Value::Bytes(to)
            }
        }
    }

    /// The address of a value in memory, in a local.
    pub fn address_of(&mut self, value: Value) -> Local {
        match value {
            Value::Scalar(l) => l,
            Value::Text(Text { addr, .. }) | Value::Bytes(addr) => self.f.address(addr),
        }
    }

    /// The same value at an address that is in a local.
    pub fn relocated(&self, value: Value, address: Local) -> Value {
        match value {
            Value::Scalar(_) => Value::Scalar(address),
            Value::Text(t) => Value::Text(Text { addr: at(address), ..t }),
            Value::Bytes(_) => Value::Bytes(at(address)),
        }
    }
}
