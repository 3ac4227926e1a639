//! Literals (§1.5, §1.6).

use crate::hir::builder::Builder;
use crate::hir::constant;
use crate::hir::convert::{Flex, Operand, constant_expr};
use crate::hir::model::*;
use crate::syntax::ast::Literal;
use takt_base::{Code, Span};
use takt_image::Elementary;
use takt_image::types::Type;

impl Builder<'_> {
    /// A literal; untyped numbers stay open.
    pub(super) fn literal(&mut self, l: &Literal, span: Span) -> Operand {
        match l {
            Literal::Int { value, based } => self.flex_int(*value, *based, span),
            Literal::Real(value) => self.flex_real(*value, span),
            Literal::Bool(b) => {
                let ty = self.bool();
                Operand::fixed(constant_expr(Const::Int(i128::from(*b)), ty, span))
            }
            Literal::String(s) => self.text(Const::String(s.clone()), s.len(), false, span),
            Literal::WString(s) => self.text(Const::WString(s.clone()), s.len(), true, span),
            Literal::Time { ty, nanos } => {
                let ty = self.elem(*ty);
                Operand::fixed(constant_expr(Const::Int((*nanos).into()), ty, span))
            }
            Literal::Typed { ty, value } => self.typed_literal(*ty, value, span),
        }
    }

    /// An untyped integer constant.
    pub(in crate::hir) fn flex_int(&mut self, value: i128, based: bool, span: Span) -> Operand {
        let ty = self.default_int(value);
        Operand { expr: constant_expr(Const::Int(value), ty, span), flex: Flex::Int { based } }
    }

    /// An untyped real constant.
    pub(super) fn flex_real(&mut self, value: f64, span: Span) -> Operand {
        let ty = self.elem(Elementary::Lreal);
        Operand { expr: constant_expr(Const::Real(value), ty, span), flex: Flex::Real }
    }

    fn text(&mut self, c: Const, length: usize, wide: bool, span: Span) -> Operand {
        let capacity = u32::try_from(length).unwrap_or(u32::MAX).clamp(1, super::super::types::STRING_MAX);
        if length > capacity as usize {
            self.error(Code::OutOfRange, span, format!("{length} characters"));
            return self.bad(span);
        }
        let ty = if wide { Type::WString { capacity } } else { Type::String { capacity } };
        let ty = self.hir.types.intern(ty);
        Operand { expr: constant_expr(c, ty, span), flex: Flex::Text }
    }

    fn typed_literal(&mut self, e: Elementary, value: &Literal, span: Span) -> Operand {
        let to = self.elem(e);
        let inner = match value {
            Literal::Int { value, .. } if e.is_char() => return self.code_of(e, *value, span),
            Literal::Int { value, .. } => self.flex_int(*value, true, span),
            Literal::Bool(b) if e == Elementary::Bool => self.flex_int(i128::from(*b), true, span),
            // `WCHAR#'x'` is written with single quotes too.
            Literal::String(s) if e == Elementary::Wchar && s.len() == 1 => return self.code_of(e, s[0].into(), span),
            Literal::Typed { .. } => return self.bad_literal(e, span),
            Literal::Time { nanos, .. } if e.is_duration() || e.is_date() => {
                return Operand::fixed(constant_expr(Const::Int((*nanos).into()), to, span));
            }
            other => self.literal(other, span),
        };
        if self.is_bad(&inner) {
            return inner;
        }
        let integer = matches!(inner.flex, Flex::Int { .. });
        if !self.fits(&inner, to) && !(integer && (e.is_int() || e.is_bit())) {
            return self.bad_literal(e, span);
        }
        let expr = self.fit(inner, to);
        Operand::fixed(expr)
    }

    fn code_of(&mut self, e: Elementary, code: i128, span: Span) -> Operand {
        let to = self.elem(e);
        match constant::checked(e, code) {
            Ok(c) => Operand::fixed(constant_expr(c, to, span)),
            Err(_) => {
                self.error(Code::OutOfRange, span, format!("{code} is no code of a {}", e.name()));
                self.bad(span)
            }
        }
    }

    fn bad_literal(&mut self, e: Elementary, span: Span) -> Operand {
        self.error(Code::TypeMismatch, span, format!("not a value of {}", e.name()));
        self.bad(span)
    }
}
