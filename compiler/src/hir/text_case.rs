//! CASE of strings (§5.5): comparisons in order, the selector computed once.

use super::builder::Builder;
use super::convert::{Operand, constant_expr};
use super::model::*;
use crate::syntax::ast::{self, BinaryOp};
use std::collections::HashMap;
use takt_base::{Code, Diag, Span};

impl Builder<'_> {
    pub(super) fn case_of_text(
        &mut self,
        selector: Operand,
        arms: &[ast::CaseArm],
        otherwise: Option<&[ast::Stmt]>,
    ) -> Option<StmtKind> {
        let value = self.settle(selector);
        let (place, first) = self.kept_text(value)?;
        let mut taken = HashMap::new();
        let mut branches = Vec::new();
        for arm in arms {
            let condition = self.text_labels(&place, &arm.labels, &mut taken);
            let body = self.statements(&arm.body);
            branches.extend(condition.map(|c| (c, body)));
        }
        let otherwise = otherwise.map(|o| self.statements(o)).unwrap_or_default();
        let span = place.span;
        let choice =
            if branches.is_empty() { otherwise } else { vec![Stmt { kind: StmtKind::If { branches, otherwise }, span }] };
        let bool = self.bool();
        let always = constant_expr(Const::Int(1), bool, span);
        Some(StmtKind::If { branches: vec![(always, first.into_iter().chain(choice).collect())], otherwise: Vec::new() })
    }

    /// A variable with the value of the selector: the selector itself, if it is a plain variable, or one of the compiler's.
    fn kept_text(&mut self, value: Expr) -> Option<(Place, Option<Stmt>)> {
        if let ExprKind::Load(place) = &value.kind
            && place.path.is_empty()
        {
            return Some((place.clone(), None));
        }
        let (pou, ty, span) = (self.scope.pou?, value.ty, value.span);
        let name = ast::Name { text: "selector".to_owned(), span };
        let var = self.push_var(pou, &name, ty, Role::Temp, Storage::Local, Const::Zero);
        let target = Place { base: Base::Var(var), path: Vec::new(), ty, span };
        Some((target.clone(), Some(Stmt { kind: StmtKind::Assign { target, value }, span })))
    }

    /// `selector = first OR selector = second ..`; `None` if no label is right.
    fn text_labels(&mut self, place: &Place, labels: &[ast::CaseLabel], taken: &mut HashMap<String, Span>) -> Option<Expr> {
        let bool = self.bool();
        let mut all: Option<Expr> = None;
        for label in labels {
            let Some(value) = self.text_label(place, label, taken) else { continue };
            let span = value.span;
            let read = Expr { kind: ExprKind::Load(place.clone()), ty: place.ty, span };
            let equal = Expr { kind: ExprKind::Binary(BinaryOp::Eq, Box::new(read), Box::new(value)), ty: bool, span };
            all = Some(match all.take() {
                None => equal,
                Some(before) => {
                    Expr { kind: ExprKind::Binary(BinaryOp::OrElse, Box::new(before), Box::new(equal)), ty: bool, span }
                }
            });
        }
        all
    }

    fn text_label(&mut self, place: &Place, label: &ast::CaseLabel, taken: &mut HashMap<String, Span>) -> Option<Expr> {
        let span = label.low.span;
        if let Some(high) = &label.high {
            self.report(Diag::new(Code::BadOperand, span.to(high.span), "a range of strings").help("list the strings"));
            return None;
        }
        let value = self.value(&label.low, place.ty);
        let ExprKind::Const(c) = &value.kind else {
            if value.ty != self.error {
                self.not_constant(span);
            }
            return None;
        };
        let first = *taken.entry(format!("{c:?}")).or_insert(span);
        if first != span {
            let diag = Diag::new(Code::DuplicateCaseLabel, span, "covered again").also(first, "covered first");
            let vendor = self.profile(span).is_codesys();
            self.report(if vendor { diag.severity(takt_base::Severity::Warning) } else { diag });
            return None;
        }
        Some(value)
    }
}
