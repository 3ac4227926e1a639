//! Values of interface types: NULL or an instance that implements the interface; assignment, comparison, assignment attempt.

use crate::hir::builder::Builder;
use crate::hir::convert::{Operand, constant_expr};
use crate::hir::model::*;
use crate::syntax::ast::{self, BinaryOp};
use takt_base::{Code, Diag, Span};
use takt_image::TypeId;
use takt_image::types::Type;

impl Builder<'_> {
    /// The type of NULL beside interfaces.
    pub(in crate::hir) fn null_type(&mut self) -> TypeId {
        let target = self.error;
        self.hir.types.intern(Type::Reference { target })
    }

    /// An instance or a reference as a value of the interface type `to`; `None` if this is no matter of interfaces.
    pub(in crate::hir) fn interface_value(&mut self, e: &Expr, to: TypeId) -> Option<Expr> {
        if !matches!(self.ty(to), Type::Reference { .. }) {
            return None;
        }
        if e.ty == self.null_type() {
            return Some(constant_expr(Const::Int(0), to, e.span));
        }
        let (from, wanted) = (self.type_unit(e.ty)?, self.type_unit(to)?);
        if !self.conforms(from, wanted) {
            self.does_not_implement(from, wanted, e.span);
            return Some(self.bad(e.span).expr);
        }
        self.reference_to(e, to)
    }

    fn does_not_implement(&mut self, from: PouId, wanted: PouId, span: Span) {
        let at = self.symbols.pous[from].decl.name.span;
        let (from_name, wanted_name) = (self.hir.pous[from].name.clone(), self.hir.pous[wanted].name.clone());
        let help = if self.hir.pous[from].kind == PouKind::Interface {
            "use ?= to try: the result is NULL if the instance does not fit".to_owned()
        } else {
            format!("add IMPLEMENTS {wanted_name} and its methods to `{from_name}`")
        };
        let label = format!("`{from_name}`, not a `{wanted_name}`");
        self.report(Diag::new(Code::NotImplementedBy, span, label).also(at, "declared").help(help));
    }

    /// The reference itself, or the offset of an instance.
    fn reference_to(&mut self, e: &Expr, to: TypeId) -> Option<Expr> {
        if matches!(self.ty(e.ty), Type::Reference { .. }) {
            return Some(Expr { ty: to, ..e.clone() });
        }
        let ExprKind::Load(place) = &e.kind else { return None };
        if let Base::Var(v) = place.base
            && let Some(pou) = self.scope.pou
            && self.hir.pous[pou].vars[v].storage == Storage::Local
            && self.hir.pous[pou].vars[v].role != Role::InOut
        {
            let help = "pass the instance as VAR_IN_OUT";
            self.report(Diag::new(Code::NotAVariable, e.span, "lives for this call only").help(help));
            return Some(self.bad(e.span).expr);
        }
        Some(Expr { kind: ExprKind::AddressOf(place.clone()), ty: to, span: e.span })
    }

    /// `=` and `<>` of references and NULL; `None` for other operands.
    pub(in crate::hir) fn compare_references(&mut self, op: BinaryOp, a: &Operand, b: &Operand, span: Span) -> Option<Operand> {
        let is_reference = |x: &Self, ty| matches!(x.ty(ty), Type::Reference { .. });
        let (ra, rb) = (is_reference(self, a.expr.ty), is_reference(self, b.expr.ty));
        if !ra && !rb {
            return None;
        }
        if !matches!(op, BinaryOp::Eq | BinaryOp::Ne) {
            let label = format!("{} of references", op.text());
            self.report(Diag::new(Code::BadOperand, span, label).help("references can be compared with = and <> only"));
            return Some(self.bad(span));
        }
        let null = self.null_type();
        let ty = if ra && a.expr.ty != null { a.expr.ty } else { b.expr.ty };
        let zero = |x: &Self, o: &Operand| {
            let is_zero = matches!(&o.expr.kind, ExprKind::Const(Const::Int(0) | Const::Zero));
            is_zero && x.profile(span).is_codesys() // `itf = 0` (vendor)
        };
        let side = |x: &mut Self, o: &Operand| match is_reference(x, o.expr.ty) {
            true => Some(Expr { ty, ..o.expr.clone() }),
            false if zero(x, o) => Some(constant_expr(Const::Int(0), ty, o.expr.span)),
            false if matches!(x.ty(o.expr.ty), Type::Instance(_)) && x.type_unit(ty).is_some() => x.interface_value(&o.expr, ty),
            false => None,
        };
        let (Some(a), Some(b)) = (side(self, a), side(self, b)) else {
            let label = format!("{} and {}", self.show(a.expr.ty), self.show(b.expr.ty));
            self.report(Diag::new(Code::NoCommonType, span, label).help("compare a reference with NULL or another reference"));
            return Some(self.bad(span));
        };
        if a.ty == self.error || b.ty == self.error {
            return Some(self.bad(span));
        }
        let bool = self.bool();
        Some(Operand::fixed(Expr { kind: ExprKind::Binary(op, Box::new(a), Box::new(b)), ty: bool, span }))
    }

    /// `target ?= value`: the value if its instance fits, else NULL. `None` if the target is no matter of objects.
    pub(in crate::hir) fn attempt_object(&mut self, place: &Place, at: Span, value: &ast::Expr) -> Option<Option<StmtKind>> {
        let wanted = match (self.ty(place.ty), self.pointee(place.ty)) {
            (Type::Reference { .. }, _) => self.type_unit(place.ty)?,
            (_, Some((target, _))) => self.objects.types.get(&target).copied().filter(|id| self.hir.pous[*id].class.is_some())?,
            _ => return None,
        };
        let o = self.operand(value, Some(place.ty));
        if self.is_bad(&o) {
            return Some(None);
        }
        Some(self.tried(place, wanted, o, at.to(value.span)))
    }

    fn tried(&mut self, place: &Place, wanted: PouId, o: Operand, span: Span) -> Option<StmtKind> {
        let (ty, target) = (place.ty, place.clone());
        if o.expr.ty == self.null_type() || matches!(o.expr.kind, ExprKind::Const(Const::Int(0))) {
            let value = constant_expr(Const::Int(0), ty, o.expr.span);
            return Some(StmtKind::Assign { target, value });
        }
        let from = self.pointee(o.expr.ty).map_or(o.expr.ty, |p| p.0);
        let numbered = self
            .type_unit(from)
            .is_some_and(|id| self.hir.pous[id].class.is_some() || self.hir.pous[id].kind == PouKind::Interface);
        if !numbered {
            let label = format!("{} ?= {}", self.show(ty), self.show(o.expr.ty));
            let help = "?= assigns a reference to an instance, if that is of the wanted type";
            self.report(Diag::new(Code::TypeMismatch, span, label).help(help));
            return None;
        }
        let is_pointer = self.pointee(o.expr.ty).is_some();
        let tried = if is_pointer { Expr { ty, ..o.expr } } else { self.reference_to(&o.expr, ty)? };
        if tried.ty == self.error {
            return None;
        }
        let classes = self.classes_of(wanted).into_iter().map(|c| c.0).collect();
        let (ty, span) = (place.ty, tried.span);
        let value = Expr { kind: ExprKind::OfClass(Box::new(tried), classes), ty, span };
        Some(StmtKind::Assign { target, value })
    }
}
