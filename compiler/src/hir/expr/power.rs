//! `**` and EXPT (§5.3): a real base; an integer base is computed in LREAL, or in REAL where that is wanted. Two integers where an
//! integer is wanted give that.

use crate::hir::builder::Builder;
use crate::hir::constant;
use crate::hir::convert::{Flex, Operand};
use crate::hir::model::*;
use crate::syntax::ast::BinaryOp;
use takt_base::Span;
use takt_image::{Elementary, TypeId};
use takt_stdlib::catalog::Intrinsic;

impl Builder<'_> {
    /// `a ** b`. Two untyped integers stay an exact integer as long as there is one.
    pub fn power(&mut self, a: Operand, b: Operand, span: Span, want: Option<TypeId>) -> Operand {
        if let (Flex::Int { .. }, Flex::Int { .. }) = (a.flex, b.flex)
            && let (ExprKind::Const(x), ExprKind::Const(y)) = (&a.expr.kind, &b.expr.kind)
            && let (Some(x), Some(y)) = (constant::int(x), constant::int(y))
            && let Ok(value) = constant::exact(BinaryOp::Power, x, y)
        {
            return self.flex_int(value, false, span);
        }
        let Some(base_type) = self.power_base(&a, want) else {
            return self.bad_operand("**", a.expr.ty, span, "the base is a real number");
        };
        let whole = self.is_integer(&a) && self.is_integer(&b);
        let base = self.raise_base(a, base_type);
        let Some(exponent) = self.exponent(b, base_type) else { return self.bad(span) };
        let power = self.intrinsic(Intrinsic::Expt, vec![base, exponent], base_type, span);
        match want.filter(|w| whole && self.elementary(*w).is_some_and(Elementary::is_int)) {
            Some(wanted) => Operand::fixed(self.wrap(Conversion::RealToInt, power.expr, wanted)),
            None => power,
        }
    }

    fn is_integer(&self, o: &Operand) -> bool {
        self.elementary(o.expr.ty).is_some_and(Elementary::is_int)
    }

    fn power_base(&mut self, a: &Operand, want: Option<TypeId>) -> Option<TypeId> {
        let e = self.elementary(a.expr.ty)?;
        if e.is_real() && a.flex == Flex::Fixed {
            return Some(a.expr.ty);
        }
        if !(e.is_int() || e.is_real()) {
            return None;
        }
        let literal = a.flex != Flex::Fixed;
        let wanted = want.filter(|w| self.elementary(*w).is_some_and(|w| w.is_real() && (literal || e.widens_to(w))));
        Some(wanted.unwrap_or_else(|| self.elem(Elementary::Lreal)))
    }

    fn raise_base(&mut self, a: Operand, to: TypeId) -> Expr {
        if a.flex == Flex::Fixed && self.elementary(a.expr.ty).is_some_and(Elementary::is_int) {
            return self.wrap(Conversion::IntToReal, a.expr, to);
        }
        self.fit(a, to)
    }

    /// An integer exponent as LINT, a real one in the type of the base.
    pub fn exponent(&mut self, b: Operand, base: TypeId) -> Option<Expr> {
        let e = self.elementary(b.expr.ty);
        let lint = self.elem(Elementary::Lint);
        match (b.flex, e) {
            (Flex::Int { .. }, _) => Some(self.fit(b, lint)),
            (Flex::Real, _) => Some(self.fit(b, base)),
            (Flex::Fixed, Some(e)) if e.is_int() => Some(self.as_lint(b.expr)),
            (Flex::Fixed, Some(e)) if e.is_real() => {
                let same = b.expr.ty == base;
                Some(if same { b.expr } else { self.wrap(Conversion::Real, b.expr, base) })
            }
            _ => {
                self.bad_operand("**", b.expr.ty, b.expr.span, "the exponent is a number");
                None
            }
        }
    }

    /// An integer of any type as LINT.
    pub fn as_lint(&mut self, e: Expr) -> Expr {
        let lint = self.elem(Elementary::Lint);
        if e.ty == lint { e } else { self.wrap(Conversion::Integer, e, lint) }
    }
}
