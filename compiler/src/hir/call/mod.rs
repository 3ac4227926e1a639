//! Calls in expressions (§4.7): user functions, standard functions, conversions. Function blocks are called by statements, see
//! [`super::block`].

mod arguments;
mod conversion;
mod dialect;
mod enable;
mod fold;
mod generic;
mod standard;
mod user;

pub(super) use arguments::Given;
pub(super) use enable::Enable;

use super::builder::Builder;
use super::convert::Operand;
use super::model::*;
use super::scope::Local;
use super::symbols::Unit;
use crate::syntax::ast;
use takt_base::{Code, Diag, Span};
use takt_image::TypeId;

impl Builder<'_> {
    /// A call whose value is used.
    pub fn call(&mut self, callee: &ast::Expr, args: &[ast::Arg], span: Span, want: Option<TypeId>) -> Operand {
        let full = self.qualified_callee(callee);
        let callee = full.as_ref().unwrap_or(callee);
        let o = match self.method_call(callee, args, span) {
            Some(o) => o,
            None => self.call_any(callee, args, span, want),
        };
        let called = match plain(&o.expr) {
            ExprKind::Call { pou, .. } => Some(*pou),
            ExprKind::CallMethod(c) => Some(c.method),
            _ => None,
        };
        if let Some(pou) = &called
            && self.hir.pous[*pou].result.is_none()
        {
            let label = format!("`{}` has no result", self.hir.pous[*pou].name);
            self.report(Diag::new(Code::NotCallable, span, label).help("call it as a statement of its own"));
            return self.bad(span);
        }
        o
    }

    /// A call whose value may be missing: a procedure counts as BOOL.
    pub fn call_any(&mut self, callee: &ast::Expr, args: &[ast::Arg], span: Span, want: Option<TypeId>) -> Operand {
        let ast::ExprKind::Name(name) = &callee.kind else {
            if self.place(callee).is_some() {
                self.not_callable(callee.span, "a variable");
            }
            return self.bad_call(args, span);
        };
        if let Some(o) = self.special_call(name, args, span) {
            return o;
        }
        if let Some(o) = self.assert_call(name, args, span) {
            return o;
        }
        if !self.names_function(name) {
            self.not_a_function(name);
            return self.bad_call(args, span);
        }
        match self.pou(name) {
            Some(id) => {
                self.check_unit_use(name);
                self.call_with_enable(id, args, span)
            }
            None => match takt_stdlib::lookup(&name.text) {
                Some(found) => match self.enable(args, enable::Declared::default()) {
                    None => self.call_standard(found, name, args, span, want),
                    Some(enable) => {
                        self.guards_next = true;
                        let call = self.call_standard(found, name, &enable.rest, span, want);
                        self.guarded(call, enable.en, enable.eno, enable::Declared::default())
                    }
                },
                None => self.bad_call(args, span),
            },
        }
    }

    fn call_with_enable(&mut self, id: PouId, args: &[ast::Arg], span: Span) -> Operand {
        self.ensure_pou(id, span);
        let declared = self.declared_enable(id);
        match self.enable(args, declared) {
            None => self.call_user(id, args, span),
            Some(enable) => {
                let call = self.call_user(id, &enable.rest, span);
                self.guarded(call, enable.en, enable.eno, declared)
            }
        }
    }

    /// True if a call of this name is one of a function. The result variable of a function shares its name.
    fn names_function(&self, name: &ast::Name) -> bool {
        let free = match (self.local(&name.key()), self.scope.pou) {
            (Some(Local::Var(v)), Some(p)) => self.hir.pous[p].result == Some(v) || self.is_data(p, v),
            (Some(_), _) => false,
            (None, _) => true,
        };
        free && self.knows_function(name)
    }

    fn knows_function(&self, name: &ast::Name) -> bool {
        match self.unit(name) {
            Some((Unit::Pou(id), _)) => self.hir.pous[id].kind == PouKind::Function,
            Some((Unit::Type(_), _)) => false,
            None => takt_stdlib::lookup(&name.text).is_some(),
        }
    }

    /// Numbers and texts can't be called, so that a variable `limit` and LIMIT() go together.
    fn is_data(&self, pou: PouId, var: VarId) -> bool {
        let ty = self.hir.pous[pou].vars[var].ty;
        self.hir.types.storage(ty).is_some() && self.pointee(ty).is_none() || self.is_string(ty)
    }

    /// True if a function is called although a local variable has its name.
    pub(in crate::hir) fn calls_function_beside(&self, name: &ast::Name, pou: PouId, var: VarId) -> bool {
        self.is_data(pou, var) && self.knows_function(name)
    }

    fn not_a_function(&mut self, name: &ast::Name) {
        let what = match (self.local(&name.key()), self.unit(name)) {
            (Some(_), _) => "a variable",
            (None, Some((Unit::Pou(id), _))) if self.hir.pous[id].kind == PouKind::FunctionBlock => "a function block",
            (None, Some((Unit::Pou(_), _))) => "a program",
            (None, Some((Unit::Type(_), _))) => "a type",
            (None, None) if self.global_id(name).is_some() => "a variable",
            (None, None) => {
                let functions = self.hir.pous.iter().filter(|p| p.kind == PouKind::Function).map(|p| p.name.clone());
                let standard = takt_stdlib::catalog::functions().map(|f| f.name.to_owned());
                let known = functions.chain(standard).chain(super::assert::names()).collect();
                return self.unknown(Code::UnknownName, name, known);
            }
        };
        self.not_callable(name.span, what);
    }

    fn not_callable(&mut self, span: Span, what: &str) {
        let help = match what {
            "a function block" => "declare an instance in VAR and call that, in a statement of its own",
            "a program" => "programs are run by tasks; use a function block",
            _ => "only functions and instances of function blocks can be called",
        };
        self.report(Diag::new(Code::NotCallable, span, what).help(help));
    }

    /// Looks at the arguments of a call that is wrong, so that what is wrong in them is said too.
    pub(super) fn bad_call(&mut self, args: &[ast::Arg], span: Span) -> Operand {
        for e in args.iter().filter_map(super::body::arg_expr) {
            self.operand(e, None);
        }
        self.bad(span)
    }

    /// Remembers who calls whom.
    pub(super) fn note_call(&mut self, to: PouId, span: Span) {
        self.calls.push((self.scope.pou, to, span));
    }
}

/// What is called, EN and ENO aside.
fn plain(e: &Expr) -> &ExprKind {
    match &e.kind {
        ExprKind::Guarded(g) => &g.call.kind,
        kind => kind,
    }
}
