//! `a := b S= c := value;` (vendor, §5.1): the right-most value goes to every target, the last one first.

use super::builder::Builder;
use super::model::*;
use crate::syntax::ast::{self, AssignOp};
use takt_base::{Code, Diag, Span};
use takt_image::TypeId;

impl Builder<'_> {
    /// The statements that a chain stands for: the value into a variable of the compiler's own, then into the targets.
    pub(super) fn chain(&mut self, targets: &[(ast::Expr, AssignOp)], value: &ast::Expr, span: Span) -> Vec<Stmt> {
        let places: Vec<_> = targets.iter().map(|(e, op)| (self.chain_target(e, *op), *op, e.span)).collect();
        let want = places.last().and_then(|(p, op, _)| if *op == AssignOp::Assign { p.as_ref() } else { None });
        let want = want.map(|p| p.ty).or_else(|| targets.iter().any(|t| t.1 != AssignOp::Assign).then(|| self.bool()));
        let value = self.operand(value, want);
        let value = match want {
            Some(ty) => self.fit(value, ty),
            None => self.settle(value),
        };
        if value.ty == self.error {
            return Vec::new();
        }
        let (kept, mut list) = self.kept(value, span);
        for (place, op, at) in places.into_iter().rev() {
            let Some(target) = place else { continue };
            let value = super::convert::Operand::fixed(kept.clone());
            let kind = match op {
                AssignOp::Assign => {
                    let value = self.fit(value, target.ty);
                    StmtKind::Assign { target, value }
                }
                AssignOp::Set | AssignOp::Reset => self.set_if(target, value.expr, op, at),
            };
            list.push(Stmt { kind, span });
        }
        list
    }

    fn chain_target(&mut self, e: &ast::Expr, op: AssignOp) -> Option<Place> {
        let place = self.writable(e).filter(|p| p.ty != self.error)?;
        if op == AssignOp::Assign || place.ty == self.bool() {
            return Some(place);
        }
        let label = format!("{}, BOOL wanted", self.show(place.ty));
        self.report(Diag::new(Code::TypeMismatch, e.span, label).help("S= and R= set and reset a BOOL variable"));
        None
    }

    /// `IF value THEN target := TRUE; END_IF`, or FALSE.
    fn set_if(&mut self, target: Place, value: Expr, op: AssignOp, span: Span) -> StmtKind {
        let bool = self.bool();
        let constant = Expr { kind: ExprKind::Const(Const::Int(i128::from(op == AssignOp::Set))), ty: bool, span };
        let set = Stmt { kind: StmtKind::Assign { target, value: constant }, span };
        StmtKind::If { branches: vec![(value, vec![set])], otherwise: Vec::new() }
    }

    /// The value in a temporary of the unit, and the statement that puts it there; a constant stays what it is.
    fn kept(&mut self, value: Expr, span: Span) -> (Expr, Vec<Stmt>) {
        if matches!(value.kind, ExprKind::Const(_)) {
            return (value, Vec::new());
        }
        let ty = value.ty;
        let Some(place) = self.temporary(ty, span) else { return (value, Vec::new()) };
        let load = Expr { kind: ExprKind::Load(place.clone()), ty, span };
        (load, vec![Stmt { kind: StmtKind::Assign { target: place, value }, span }])
    }

    /// A new variable of the running unit that lives for one call. `None` outside of a unit.
    pub(super) fn temporary(&mut self, ty: TypeId, span: Span) -> Option<Place> {
        let pou = self.scope.pou?;
        let init = Const::Zero;
        let var = Var {
            name: "?".to_owned(),
            ty,
            role: Role::Temp,
            storage: Storage::Local,
            init,
            keep: Keep::Unsaid,
            copied_back: false,
            edge: None,
            span,
        };
        let id = self.hir.pous[pou].vars.push(var);
        Some(Place { base: Base::Var(id), path: Vec::new(), ty, span })
    }
}
