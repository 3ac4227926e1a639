//! Expressions that assign (vendor): `(a := b)`, __QUERYINTERFACE, __QUERYPOINTER; and the functions of CODESYS that are not here.

use super::builder::Builder;
use super::convert::{Operand, constant_expr};
use super::model::*;
use crate::syntax::ast::{self, BinaryOp};
use takt_base::{Code, Diag, Span};
use takt_image::types::{PointerKind, Type};

/// Functions that this version lacks, and what to do instead.
const LACKING: [(&str, &str); 5] = [
    ("__NEW", "declare the instances in VAR, or an array of them: all memory is fixed when the program starts"),
    ("__DELETE", "instances last as long as the program: declare them in VAR"),
    ("INI", "assign the initial values, or start the controller anew; `takt run --cold` resets retained variables"),
    ("BITADR", "the bit %QXb.i has the number 8 * b + i: write that as a constant"),
    ("INDEXOF", "units have no numbers here: choose with CASE, or call a method of an interface"),
];

impl Builder<'_> {
    /// `(target := value)`: a scalar, as it is stored.
    pub(super) fn assigned(&mut self, target: &ast::Expr, value: &ast::Expr, span: Span) -> Operand {
        let Some(place) = self.writable(target) else {
            self.operand(value, None);
            return self.bad(span);
        };
        let value = self.value(value, place.ty);
        if value.ty == self.error || place.ty == self.error {
            return self.bad(span);
        }
        if self.hir.types.storage(place.ty).is_none() {
            let what = format!("an assignment of {} inside of an expression", self.show(place.ty));
            self.unsupported(span, &what, "assign in a statement of its own");
            return self.bad(span);
        }
        let ty = place.ty;
        Operand::fixed(Expr { kind: ExprKind::Stored(Box::new((place, value))), ty, span })
    }

    /// __QUERYINTERFACE and __QUERYPOINTER, and what there is not.
    pub(super) fn query_call(&mut self, key: &str, args: &[ast::Arg], name: Span, span: Span) -> Option<Operand> {
        if let Some((_, help)) = LACKING.iter().find(|l| l.0 == key) {
            let vendor = self.profile(name).is_codesys() || key.starts_with("__");
            return vendor.then(|| {
                let diag = Diag::new(Code::NotSupportedYet, span, "not in this version");
                self.report(diag.message(format!("{key} is not supported by this version")).help(*help));
                self.bad(span)
            });
        }
        if !matches!(key, "__QUERYINTERFACE" | "__QUERYPOINTER") {
            return None;
        }
        self.codesys_form(name, key);
        let [ast::Arg::Positional(from), ast::Arg::Positional(to)] = args else {
            self.error(
                Code::WrongArgumentCount,
                span,
                format!("{key} has two arguments: what is asked, and where the answer goes"),
            );
            return Some(self.bad(span));
        };
        let stored = if key == "__QUERYPOINTER" { self.queried_pointer(from, to) } else { self.queried_interface(from, to) };
        Some(match stored {
            Some(stored) => self.is_not_null(stored, span),
            None => self.bad(span),
        })
    }

    fn queried_interface(&mut self, from: &ast::Expr, to: &ast::Expr) -> Option<(Place, Expr)> {
        let place = self.writable(to)?;
        match self.attempt_object(&place, to.span, from) {
            Some(Some(StmtKind::Assign { target, value })) => Some((target, value)),
            Some(_) => None,
            None => {
                let label = format!("{}, an interface wanted", self.show(place.ty));
                self.error(Code::TypeMismatch, to.span, label);
                None
            }
        }
    }

    fn queried_pointer(&mut self, from: &ast::Expr, to: &ast::Expr) -> Option<(Place, Expr)> {
        let place = self.writable(to)?;
        let o = self.operand(from, None);
        if self.is_bad(&o) {
            return None;
        }
        let pointer = matches!(self.pointee(place.ty), Some((_, PointerKind::Pointer)));
        if !pointer || !matches!(self.ty(o.expr.ty), Type::Reference { .. }) {
            let label = format!("{} and {}", self.show(o.expr.ty), self.show(place.ty));
            self.report(Diag::new(Code::TypeMismatch, from.span.to(to.span), label).help("give an interface and a pointer"));
            return None;
        }
        let value = Expr { ty: place.ty, ..o.expr };
        Some((place, value))
    }

    fn is_not_null(&mut self, (place, value): (Place, Expr), span: Span) -> Operand {
        let ty = place.ty;
        let stored = Expr { kind: ExprKind::Stored(Box::new((place, value))), ty, span };
        let null = constant_expr(Const::Int(0), ty, span);
        let bool = self.bool();
        Operand::fixed(Expr { kind: ExprKind::Binary(BinaryOp::Ne, Box::new(stored), Box::new(null)), ty: bool, span })
    }
}
