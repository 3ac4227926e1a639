//! Expressions: every one gets a type; constants are folded as they are built, so a constant expression is one that ends up as
//! [`ExprKind::Const`].

mod literal;
mod logic;
mod name;
mod operator;
mod power;
mod time;
mod unify;

use super::builder::Builder;
use super::constant;
use super::convert::{Flex, Operand};
use super::model::*;
use crate::syntax::ast;
use takt_base::{Code, Diag};
use takt_image::{Elementary, TypeId};

impl Builder<'_> {
    /// Types an expression. `want` is a hint: it picks enumerators and the type of calls of literals; nothing is converted to it.
    pub fn operand(&mut self, e: &ast::Expr, want: Option<TypeId>) -> Operand {
        self.deeper(e.span, |b| b.operand_kind(e, want)).unwrap_or_else(|| self.bad(e.span))
    }

    fn operand_kind(&mut self, e: &ast::Expr, want: Option<TypeId>) -> Operand {
        match &e.kind {
            ast::ExprKind::Name(_) | ast::ExprKind::Member(..) if self.may_be_property(e) => match self.property_read(e) {
                Some(o) => self.through_reference(o),
                None => self.plain_operand(e, want),
            },
            _ => self.plain_operand(e, want),
        }
    }

    fn plain_operand(&mut self, e: &ast::Expr, want: Option<TypeId>) -> Operand {
        match &e.kind {
            ast::ExprKind::Literal(l) => self.literal(l, e.span),
            ast::ExprKind::Name(n) => self.name(n, want),
            ast::ExprKind::Enumerator { ty, value } => self.enumerator(ty, value, e.span),
            ast::ExprKind::Member(base, value) => match self.enum_member(base, value, e.span) {
                Some(o) => o,
                None => self.read(e),
            },
            ast::ExprKind::Direct(_) | ast::ExprKind::Index(..) | ast::ExprKind::Part { .. } => self.read(e),
            ast::ExprKind::Deref(_) => self.read(e),
            ast::ExprKind::Null => self.null(e.span, want),
            ast::ExprKind::Unary(op, a) => self.unary(*op, a, e.span, want),
            ast::ExprKind::Binary(op, a, b) => self.binary(*op, a, b, e.span, want),
            ast::ExprKind::Call { callee, args } => {
                let o = self.call(callee, args, e.span, want);
                self.through_reference(o)
            }
            ast::ExprKind::Assign { target, value } => self.assigned(target, value, e.span),
            ast::ExprKind::Error => self.bad(e.span),
        }
    }

    /// Types an expression and converts it to `to`.
    pub fn value(&mut self, e: &ast::Expr, to: TypeId) -> Expr {
        let o = self.operand(e, Some(to));
        self.fit(o, to)
    }

    /// A BOOL condition.
    pub fn condition(&mut self, e: &ast::Expr) -> Expr {
        let bool = self.bool();
        let o = self.operand(e, Some(bool));
        if self.is_bad(&o) || self.fits(&o, bool) {
            return self.fit(o, bool);
        }
        if let Some(truth) = self.truth_of(o.expr.clone()).filter(|_| o.flex == Flex::Fixed) {
            return truth;
        }
        let label = if o.flex == Flex::Fixed { self.show(o.expr.ty) } else { "a number".to_owned() };
        let help = "compare it: `<> 0` gives BOOL";
        self.report(Diag::new(Code::NotBool, e.span, label).help(help));
        self.bad(e.span).expr
    }

    /// An expression that has the type it has: a literal takes its default type.
    pub fn settle(&mut self, o: Operand) -> Expr {
        let to = match (o.flex, &o.expr.kind) {
            (Flex::Int { .. }, ExprKind::Const(c)) => self.default_int(constant::int(c).unwrap_or(0)),
            _ => return o.expr,
        };
        self.fit(Operand { flex: Flex::Int { based: false }, ..o }, to)
    }

    /// The smallest of DINT, LINT, ULINT that holds the value (§1.5).
    pub fn default_int(&mut self, value: i128) -> TypeId {
        let fits = |e: &Elementary| e.int_range().is_some_and(|(low, high)| (low..=high).contains(&value));
        let e = [Elementary::Dint, Elementary::Lint, Elementary::Ulint].into_iter().find(fits);
        self.elem(e.unwrap_or(Elementary::Lint))
    }

    /// The constant value of an expression of type `to`, stored as an integer.
    pub fn const_of(&mut self, e: &ast::Expr, to: TypeId) -> Option<i128> {
        let value = self.value(e, to);
        self.int_value(&value)
    }

    /// The constant value of an integer expression of any integer type.
    pub fn const_int(&mut self, e: &ast::Expr) -> Option<i128> {
        let o = self.operand(e, None);
        let o = self.decay(o);
        let integer = matches!(o.flex, Flex::Int { .. }) || self.elementary(o.expr.ty).is_some_and(Elementary::is_int);
        if !integer && !self.is_bad(&o) {
            let label = format!("{}, an integer wanted", self.show(o.expr.ty));
            self.error(Code::TypeMismatch, e.span, label);
            return None;
        }
        self.int_value(&o.expr)
    }

    /// The value of a constant; a report if it is none.
    pub fn int_value(&mut self, e: &Expr) -> Option<i128> {
        match &e.kind {
            _ if e.ty == self.error => None,
            ExprKind::Const(c) => constant::int(c),
            _ => {
                self.not_constant(e.span);
                None
            }
        }
    }

    /// Reports that the value must be known at compile time.
    pub fn not_constant(&mut self, span: takt_base::Span) {
        let help = "use literals, enumeration values and CONSTANT variables";
        self.report(Diag::new(Code::NotConstant, span, "its value is known only when the program runs").help(help));
    }
}
