//! Operators (§5.3, §5.4): which operands they take, what type they give.

use super::super::constant::FoldError;
use crate::hir::builder::Builder;
use crate::hir::constant;
use crate::hir::convert::{Flex, Operand, constant_expr};
use crate::hir::model::*;
use crate::syntax::ast::{self, BinaryOp, UnaryOp};
use takt_base::{Code, Diag, Span};
use takt_image::types::Type;
use takt_image::{Elementary, TypeId};

/// True for `= <> < > <= >=`.
pub(super) fn is_comparison(op: BinaryOp) -> bool {
    use BinaryOp::*;
    matches!(op, Eq | Ne | Lt | Gt | Le | Ge)
}

fn is_logic(op: BinaryOp) -> bool {
    use BinaryOp::*;
    matches!(op, And | Or | Xor | AndThen | OrElse)
}

impl Builder<'_> {
    /// `a op b` as written between its operands.
    pub(super) fn binary(&mut self, op: BinaryOp, l: &ast::Expr, r: &ast::Expr, span: Span, want: Option<TypeId>) -> Operand {
        let hint = if is_comparison(op) { None } else { want };
        let waits = |b: &Self, e: &ast::Expr| b.is_enumerator(e) || matches!(e.kind, ast::ExprKind::Null);
        let (a, b) = if waits(self, l) && !waits(self, r) {
            let b = self.operand(r, hint);
            (self.operand(l, Some(b.expr.ty)), b)
        } else {
            let a = self.operand(l, hint);
            let beside = if a.flex == Flex::Fixed { Some(a.expr.ty) } else { hint };
            let b = self.operand(r, beside);
            (a, b)
        };
        let o = self.combine(op, a, b, span, want);
        self.short_circuit(o)
    }

    /// `a op b` of two typed operands.
    pub fn combine(&mut self, op: BinaryOp, a: Operand, b: Operand, span: Span, want: Option<TypeId>) -> Operand {
        if self.is_bad(&a) || self.is_bad(&b) {
            return self.bad(span);
        }
        if let Some(o) = self.compare_references(op, &a, &b, span) {
            return o;
        }
        let same_enum = is_comparison(op) && a.expr.ty == b.expr.ty;
        let (a, b) = if same_enum { (a, b) } else { (self.decay(a), self.decay(b)) };
        if let Some(o) = self.pointer_operator(op, &a, &b, span) {
            return o;
        }
        if op == BinaryOp::Power {
            return self.power(a, b, span, want);
        }
        if let Some(o) = self.time_operator(op, &a, &b, span) {
            return o;
        }
        let (ta, tb) = (a.expr.ty, b.expr.ty);
        let Some((a, b)) = self.unify(a, b, want) else { return self.no_common(op, ta, tb, span) };
        if self.is_bad(&a) || self.is_bad(&b) {
            return self.bad(span);
        }
        match a.flex {
            Flex::Int { .. } => self.exact(op, a, b, span),
            Flex::Real => self.exact_real(op, a, b, span),
            _ => self.typed(op, a.expr, b.expr, span),
        }
    }

    fn no_common(&mut self, op: BinaryOp, a: TypeId, b: TypeId, span: Span) -> Operand {
        let label = format!("{} {} {}", self.show(a), op.text(), self.show(b));
        let help = "convert one side with a conversion function such as INT_TO_UINT";
        self.report(Diag::new(Code::NoCommonType, span, label).help(help));
        self.bad(span)
    }

    /// Reports an operator that the type does not have.
    pub(super) fn bad_operand(&mut self, op: &str, ty: TypeId, span: Span, help: &str) -> Operand {
        let label = format!("{op} of {}", self.show(ty));
        let diag = Diag::new(Code::BadOperand, span, label);
        self.report(if help.is_empty() { diag } else { diag.help(help) });
        self.bad(span)
    }

    /// Reports why a constant expression has no value.
    pub fn fold_error(&mut self, why: FoldError, span: Span) -> Operand {
        self.report(match why {
            FoldError::DivisionByZero => Diag::new(Code::DivisionByZeroConstant, span, "the divisor is 0"),
            FoldError::Overflow => Diag::new(Code::OutOfRange, span, "the result is outside of the range of its type")
                .message("this constant expression overflows")
                .help("compute it in a wider type"),
        });
        self.bad(span)
    }

    /// Two untyped integers.
    fn exact(&mut self, op: BinaryOp, a: Operand, b: Operand, span: Span) -> Operand {
        let (Flex::Int { based: x }, Flex::Int { based: y }) = (a.flex, b.flex) else { return self.bad(span) };
        let (ExprKind::Const(ca), ExprKind::Const(cb)) = (&a.expr.kind, &b.expr.kind) else { return self.bad(span) };
        let (va, vb) = (constant::int(ca).unwrap_or(0), constant::int(cb).unwrap_or(0));
        if is_logic(op) && !(x && y) && !self.profile(span).mixes_bits_and_integers() {
            return self.bad_operand(op.text(), a.expr.ty, span, "write bit strings as WORD#5 or 16#05");
        }
        match constant::exact(op, va, vb) {
            Ok(v) if is_comparison(op) => self.truth(v != 0, span),
            Ok(v) => self.flex_int(v, x && y, span),
            Err(why) => self.fold_error(why, span),
        }
    }

    fn truth(&mut self, value: bool, span: Span) -> Operand {
        let ty = self.bool();
        Operand::fixed(constant_expr(Const::Int(i128::from(value)), ty, span))
    }

    /// Two untyped reals.
    fn exact_real(&mut self, op: BinaryOp, a: Operand, b: Operand, span: Span) -> Operand {
        let (ExprKind::Const(ca), ExprKind::Const(cb)) = (&a.expr.kind, &b.expr.kind) else { return self.bad(span) };
        match constant::binary(op, ca, cb, Elementary::Lreal) {
            Some(Ok(Const::Real(v))) => self.flex_real(v, span),
            Some(Ok(c)) => self.truth(!constant::is_zero(&c), span),
            Some(Err(why)) => self.fold_error(why, span),
            None => self.bad_operand(op.text(), a.expr.ty, span, ""),
        }
    }

    /// Two operands of one type.
    fn typed(&mut self, op: BinaryOp, a: Expr, b: Expr, span: Span) -> Operand {
        let (a, b) = self.promoted(op, a, b);
        if !self.has_operator(op, a.ty, span) {
            return self.bad_operand(op.text(), a.ty, span, operator_help(op, self.ty(a.ty)));
        }
        let ty = if is_comparison(op) { self.bool() } else { a.ty };
        if let (ExprKind::Const(ca), ExprKind::Const(cb)) = (&a.kind, &b.kind)
            && !self.unfolded
            && let Some(folded) = self.fold_binary(op, ca, cb, a.ty)
        {
            return match folded {
                Ok(c) => Operand::fixed(constant_expr(c, ty, span)),
                Err(why) => self.fold_error(why, span),
            };
        }
        if !self.unfolded && self.divides_by_zero(op, &b) {
            return self.fold_error(FoldError::DivisionByZero, span);
        }
        Operand::fixed(Expr { kind: ExprKind::Binary(op, Box::new(a), Box::new(b)), ty, span })
    }

    fn fold_binary(&self, op: BinaryOp, a: &Const, b: &Const, ty: TypeId) -> Option<Result<Const, FoldError>> {
        match self.hir.types.storage(ty) {
            Some(e) => constant::binary(op, a, b, e),
            None => constant::strings(op, a, b).map(Ok),
        }
    }

    fn divides_by_zero(&self, op: BinaryOp, b: &Expr) -> bool {
        let integer = self.elementary(b.ty).is_some_and(|e| e.is_int() || e.is_bit());
        matches!(op, BinaryOp::Div | BinaryOp::Mod) && integer && matches!(&b.kind, ExprKind::Const(c) if constant::is_zero(c))
    }

    fn has_operator(&mut self, op: BinaryOp, ty: TypeId, span: Span) -> bool {
        use BinaryOp::*;
        let Some(e) = self.elementary(ty) else {
            return match self.ty(ty) {
                Type::String { .. } | Type::WString { .. } | Type::Subrange { .. } => is_comparison(op),
                Type::Pointer { .. } => matches!(op, Eq | Ne),
                Type::Enum { .. } if matches!(op, Eq | Ne) || !is_comparison(op) => is_comparison(op),
                Type::Enum { .. } => {
                    if !self.named_values.contains(&ty) {
                        self.codesys_form(span, "the order of two values of an enumeration");
                    }
                    true
                }
                _ => false,
            };
        };
        // Bit strings compute as unsigned integers, and integers have logic (vendor).
        let mixes = self.profile(span).mixes_bits_and_integers() && e != Elementary::Bool;
        let number = e.is_int() || e.is_bit() && mixes;
        match op {
            Add | Sub => number || e.is_real() || e.is_duration(),
            Mul | Div => number || e.is_real(),
            Mod => number,
            And | Or | Xor => e.is_bit() || e.is_int() && mixes,
            AndThen | OrElse => e == Elementary::Bool,
            Eq | Ne | Lt | Gt | Le | Ge => true,
            Power => e.is_real(),
        }
    }

    /// `-a`, `+a`, `NOT a`.
    pub(super) fn unary(&mut self, op: UnaryOp, a: &ast::Expr, span: Span, want: Option<TypeId>) -> Operand {
        let o = self.operand(a, want);
        let o = self.decay(o);
        if self.is_bad(&o) {
            return self.bad(span);
        }
        match op {
            UnaryOp::Not => self.complement(o, span, want),
            UnaryOp::Neg | UnaryOp::Plus => self.sign(op, o, span),
        }
    }

    fn sign(&mut self, op: UnaryOp, o: Operand, span: Span) -> Operand {
        let o = match o.flex {
            Flex::Fixed if op == UnaryOp::Neg => Operand::fixed(self.signed(o.expr)),
            _ => o,
        };
        let e = self.elementary(o.expr.ty);
        if !e.is_some_and(|e| e.is_int() || e.is_real() || e.is_duration()) || o.flex == Flex::Text {
            return self.bad_operand(
                if op == UnaryOp::Neg { "-" } else { "+" },
                o.expr.ty,
                span,
                "a sign needs a number or a duration",
            );
        }
        if op == UnaryOp::Plus {
            return o;
        }
        let ty = o.expr.ty;
        match (&o.expr.kind, o.flex, e) {
            (ExprKind::Const(c), Flex::Int { .. }, _) => match constant::int(c).and_then(i128::checked_neg) {
                Some(v) => self.flex_int(v, false, span),
                None => self.fold_error(FoldError::Overflow, span),
            },
            (ExprKind::Const(c), flex, Some(e)) if e.is_real() => match constant::real(c) {
                Some(v) => Operand { expr: constant_expr(Const::Real(-v), ty, span), flex },
                None => self.bad(span),
            },
            (ExprKind::Const(c), _, Some(e)) => match constant::checked(e, -constant::int(c).unwrap_or(0)) {
                Ok(c) => Operand::fixed(constant_expr(c, ty, span)),
                Err(why) => self.fold_error(why, span),
            },
            _ => Operand::fixed(Expr { kind: ExprKind::Neg(Box::new(o.expr)), ty, span }),
        }
    }

    /// NOT: complement within the width.
    pub fn complement(&mut self, o: Operand, span: Span, want: Option<TypeId>) -> Operand {
        let wanted = want.filter(|w| self.elementary(*w).is_some_and(Elementary::is_bit) && o.flex != Flex::Fixed);
        let o = match wanted {
            Some(to) => Operand::fixed(self.fit(o, to)),
            None => o,
        };
        if self.is_bad(&o) {
            return self.bad(span);
        }
        let ty = o.expr.ty;
        let mixes = self.profile(span).mixes_bits_and_integers();
        let bits = |e: &Elementary| e.is_bit() || e.is_int() && mixes;
        let Some(e) = self.elementary(ty).filter(|e| bits(e) && o.flex == Flex::Fixed) else {
            return self.bad_operand("NOT", ty, span, "NOT needs BOOL or a bit string");
        };
        match &o.expr.kind {
            ExprKind::Const(c) => {
                let value = constant::low_bits(!constant::int(c).unwrap_or(0), e);
                Operand::fixed(constant_expr(Const::Int(value), ty, span))
            }
            _ => Operand::fixed(Expr { kind: ExprKind::Not(Box::new(o.expr)), ty, span }),
        }
    }
}

fn operator_help(op: BinaryOp, ty: &Type) -> &'static str {
    match ty {
        Type::String { .. } | Type::WString { .. } if op == BinaryOp::Add => "write CONCAT(a, b)",
        Type::Elementary(e) if e.is_bit() && !is_logic(op) => "convert the bit string first, for example with WORD_TO_UINT",
        Type::Elementary(e) if !e.is_bit() && is_logic(op) => {
            "logic needs BOOL or bit strings; convert first, for example with INT_TO_WORD"
        }
        Type::Enum { .. } => "values of an enumeration only compare with = and <>",
        Type::Struct(_) | Type::Instance(_) | Type::Array { .. } => "compare the members one by one",
        _ => "",
    }
}
