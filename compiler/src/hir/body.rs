//! The bodies of all units, and a walk over trees for the addresses in them.

use super::builder::Builder;
use super::model::PouId;
use crate::syntax::ast::{self, ExprKind, StmtKind};
use std::collections::HashSet;

impl Builder<'_> {
    /// Types all bodies.
    pub fn bodies(&mut self) {
        self.own_units().into_iter().for_each(|id| self.body(id));
        self.library_bodies();
    }

    /// Of a library those bodies that are called, directly or by one another.
    fn library_bodies(&mut self) {
        let mut done = HashSet::new();
        let (mut calls, mut dynamic) = (0, 0);
        loop {
            let new = self.calls[calls..].iter().chain(&self.objects.dynamic_calls[dynamic..]).map(|(_, to, _)| *to);
            let new: Vec<PouId> = new.filter(|to| self.symbols.pous[*to].library && done.insert(*to)).collect();
            (calls, dynamic) = (self.calls.len(), self.objects.dynamic_calls.len());
            if new.is_empty() {
                return;
            }
            new.into_iter().for_each(|id| self.body(id));
        }
    }

    fn body(&mut self, id: PouId) {
        let decl = self.symbols.pous[id].decl;
        let own = std::mem::take(&mut self.symbols.pous[id].scope);
        let outer = std::mem::replace(&mut self.scope, own);
        self.scope.pou = Some(id);
        if let Some(first) = decl.body.first().filter(|_| decl.external) {
            self.unsupported(
                first.span,
                "the body of an external unit",
                "leave the body empty: it is provided by the controller",
            );
        }
        let mut body = self.late_locals(id);
        body.extend(self.statements(&decl.body));
        body.extend(self.inherited_body(id, decl));
        if !self.is_signature(id) {
            self.check_result_written(id);
        }
        self.hir.pous[id].body = body;
        self.symbols.pous[id].scope = std::mem::replace(&mut self.scope, outer);
    }
}

/// Reports every direct address in statements. Keeps its own stack: trees may be deep.
pub(super) fn addresses<'t>(body: &'t [ast::Stmt], on: &mut dyn FnMut(&'t ast::Address)) {
    let mut todo: Vec<&ast::Stmt> = body.iter().collect();
    while let Some(stmt) = todo.pop() {
        let mut exprs: Vec<&ast::Expr> = Vec::new();
        match &stmt.kind {
            StmtKind::Assign { target, value } | StmtKind::Attempt { target, value } | StmtKind::Bind { target, value } => {
                exprs.extend([target, value])
            }
            StmtKind::Chain { targets, value } => exprs.extend(targets.iter().map(|t| &t.0).chain([value])),
            StmtKind::Call(e) => exprs.push(e),
            StmtKind::If { branches, otherwise } => {
                for (condition, body) in branches {
                    exprs.push(condition);
                    todo.extend(body);
                }
                todo.extend(otherwise);
            }
            StmtKind::Case { selector, arms, otherwise } => {
                exprs.push(selector);
                todo.extend(arms.iter().flat_map(|a| &a.body).chain(otherwise.iter().flatten()));
            }
            StmtKind::For { variable, from, to, by, body } => {
                exprs.extend([variable, from, to].into_iter().chain(by).map(|e| &**e));
                todo.extend(body);
            }
            StmtKind::While { condition: e, body } | StmtKind::Repeat { body, until: e } => {
                exprs.push(e);
                todo.extend(body);
            }
            StmtKind::Return(Some(e)) | StmtKind::Expression(e) => exprs.push(e),
            StmtKind::Instructions(lines) => {
                exprs.extend(lines.iter().filter_map(|l| l.instr.as_ref()).flat_map(|i| i.expressions()))
            }
            StmtKind::Label(_) | StmtKind::Jump(_) => {}
            StmtKind::Exit | StmtKind::Continue | StmtKind::Return(None) | StmtKind::Empty | StmtKind::Error => {}
        }
        expression_addresses(exprs, on);
    }
}

/// Reports every direct address in expressions.
pub(super) fn expression_addresses<'t>(mut todo: Vec<&'t ast::Expr>, on: &mut dyn FnMut(&'t ast::Address)) {
    while let Some(e) = todo.pop() {
        match &e.kind {
            ExprKind::Direct(a) => on(a),
            ExprKind::Unary(_, a) | ExprKind::Deref(a) | ExprKind::Member(a, _) | ExprKind::Part { base: a, .. } => todo.push(a),
            ExprKind::Binary(_, a, b) | ExprKind::Assign { target: a, value: b } => todo.extend([&**a, &**b]),
            ExprKind::Index(a, list) => todo.extend(list.iter().chain([&**a])),
            ExprKind::Call { callee, args } => todo.extend(args.iter().filter_map(arg_expr).chain([&**callee])),
            ExprKind::Literal(_) | ExprKind::Name(_) | ExprKind::Enumerator { .. } | ExprKind::Null | ExprKind::Error => {}
        }
    }
}

/// What stands in an argument.
pub(super) fn arg_expr(a: &ast::Arg) -> Option<&ast::Expr> {
    match a {
        ast::Arg::Positional(e) => Some(e),
        ast::Arg::Input { value, .. } => value.as_ref(),
        ast::Arg::Output { target, .. } => target.as_ref(),
    }
}
