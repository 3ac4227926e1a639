//! Calls in Instruction List (language reference §6.5): functions, instances, and the input operators of instances.

use super::flow::Out;
use super::{Cr, List};
use crate::hir::convert::{Flex, Operand};
use crate::hir::model::*;
use crate::syntax::ast::{self, Literal, Name};
use crate::syntax::il::{Arg, Value, When};
use takt_base::{Code, Diag, Span};
use takt_image::types::Type;

impl List<'_, '_> {
    /// True if the operand is an instance of a function block. What is reported here and again later is merged.
    pub(super) fn is_instance(&mut self, e: &ast::Expr) -> bool {
        let mut root = e;
        while let ast::ExprKind::Member(base, _) | ast::ExprKind::Index(base, _) = &root.kind {
            root = base;
        }
        let ast::ExprKind::Name(name) = &root.kind else { return false };
        if !self.b.names_variable(name) {
            return false;
        }
        self.b.place(e).is_some_and(|t| matches!(self.b.ty(t.place.ty), Type::Instance(_)))
    }

    /// `CU inst`: the current result into an input, and the call.
    pub(super) fn input_operator(&mut self, input: &str, e: &ast::Expr, span: Span) {
        if !self.is_instance(e) {
            if let Some(target) = self.b.place(e).filter(|t| t.place.ty != self.b.error) {
                let label = format!("{}, an instance of a function block wanted", self.b.show(target.place.ty));
                self.b.report(Diag::new(Code::NoInputOperator, e.span, label));
            }
            return;
        }
        let Some(value) = self.argument(span) else { return };
        let name = Name { text: input.to_owned(), span };
        let args = [ast::Arg::Input { name, value: Some(value) }];
        if let Some(Some(kind)) = self.b.block_call(e, &args, span) {
            self.push(kind, span);
        }
    }

    /// CAL.
    pub(super) fn call_instance(&mut self, when: When, instance: &ast::Expr, args: &[Arg], span: Span) {
        let condition = self.condition(when, span);
        let before = self.cr.clone();
        let outer = std::mem::take(&mut self.out);
        let args = self.args(args, span);
        match self.b.method_call(instance, &args, span) {
            Some(call) if self.b.is_bad(&call) => {}
            Some(call) => self.push(StmtKind::Call(call.expr), span), // an action or method
            None => match self.b.block_call(instance, &args, span) {
                Some(Some(kind)) => self.push(kind, span),
                Some(None) => {}
                None => self.not_an_instance(instance),
            },
        }
        self.cr = before;
        let inner = std::mem::replace(&mut self.out, outer);
        let list: Vec<Stmt> = inner.into_iter().filter_map(|o| if let Out::Stmt(s) = o { Some(s) } else { None }).collect();
        match (when, condition) {
            (When::Always, _) => self.out.extend(list.into_iter().map(Out::Stmt)),
            (_, Some(condition)) => {
                self.push(StmtKind::If { branches: vec![(condition, list)], otherwise: Vec::new() }, span);
            }
            _ => {}
        }
    }

    fn not_an_instance(&mut self, e: &ast::Expr) {
        let ast::ExprKind::Name(name) = &e.kind else { return };
        let known = self.b.pou(name).is_some() || takt_stdlib::lookup(&name.text).is_some();
        if known {
            let help = "declare an instance in VAR and call that; a function is called by its name, without CAL";
            return self.b.report(Diag::new(Code::NotCallable, e.span, "not an instance of a function block").help(help));
        }
        self.b.place(e);
    }

    /// The arguments as ST has them.
    fn args(&mut self, args: &[Arg], span: Span) -> Vec<ast::Arg> {
        let mut list = Vec::with_capacity(args.len());
        for arg in args {
            list.push(match arg {
                Arg::Positional(e) => ast::Arg::Positional(e.clone()),
                Arg::Output { name, negated, target } => {
                    ast::Arg::Output { name: name.clone(), negated: *negated, target: Some(target.clone()) }
                }
                Arg::Input { name, value: Value::Operand(e) } => ast::Arg::Input { name: name.clone(), value: Some(e.clone()) },
                Arg::Input { name, value: Value::List(instrs) } => {
                    let before = std::mem::replace(&mut self.cr, Cr::Undefined);
                    let value = self.nested(instrs, span).and_then(|_| self.argument(span));
                    self.cr = before;
                    let value = value.unwrap_or(ast::Expr { kind: ast::ExprKind::Error, span: name.span });
                    ast::Arg::Input { name: name.clone(), value: Some(value) }
                }
            });
        }
        list
    }

    /// A function by its name.
    pub(super) fn function(&mut self, name: &Name, args: &[Arg], formal: bool, span: Span) {
        let user = self.b.pou(name);
        if user.is_none() && takt_stdlib::lookup(&name.text).is_none() {
            self.unknown_instruction(name);
            self.cr = Cr::Bad;
            return;
        }
        if let Some(id) = user {
            self.b.ensure_pou(id, span);
        }
        let bare = user.is_some_and(|id| self.b.hir.pous[id].params.is_empty());
        let mut list = Vec::new();
        if !formal && !bare {
            let Some(first) = self.argument(span) else { return };
            list.push(ast::Arg::Positional(first));
        }
        list.append(&mut self.args(args, span));
        let callee = ast::Expr { kind: ast::ExprKind::Name(name.clone()), span: name.span };
        let o = self.b.call_any(&callee, &list, span, None);
        match &o.expr.kind {
            ExprKind::Call { pou, .. } if self.b.hir.pous[*pou].result.is_none() => {
                self.push(StmtKind::Call(o.expr), span);
            }
            _ => self.set(o, span),
        }
    }

    fn unknown_instruction(&mut self, name: &Name) {
        let diag = Diag::new(Code::UnknownInstruction, name.span, "not an operator and not a function");
        let functions = self.b.hir.pous.iter().filter(|p| p.kind == PouKind::Function).map(|p| p.name.clone());
        let known: Vec<String> = functions.collect();
        let near = crate::syntax::nearest_operator(&name.text)
            .map(str::to_owned)
            .or_else(|| takt_base::nearest(&name.text, known.iter().map(String::as_str)).map(str::to_owned));
        self.b.report(match near {
            Some(near) => diag.help(format!("did you mean {near}?")),
            None => diag.help("instances of function blocks are called with CAL"),
        });
    }

    /// The current result as an argument: a literal stays one, everything else has a name that no user can write.
    pub(super) fn argument(&mut self, span: Span) -> Option<ast::Expr> {
        let o = self.read(None, span)?;
        if let Some(literal) = literal(&o) {
            return Some(ast::Expr { kind: ast::ExprKind::Literal(literal), span });
        }
        let place = match o.expr.kind {
            ExprKind::Load(place) => place,
            _ => match self.keep(o.expr, span)?.kind {
                ExprKind::Load(place) => place,
                _ => return None,
            },
        };
        let Base::Var(id) = place.base else { return None };
        let name = Name { text: format!("?{}", id.0), span };
        self.b.scope.names.insert(name.key(), (crate::hir::scope::Local::Var(id), span));
        Some(ast::Expr { kind: ast::ExprKind::Name(name), span })
    }
}

/// A constant that has no type yet.
fn literal(o: &Operand) -> Option<Literal> {
    match (&o.expr.kind, o.flex) {
        (ExprKind::Const(Const::Int(value)), Flex::Int { based }) => Some(Literal::Int { value: *value, based }),
        (ExprKind::Const(Const::Real(value)), Flex::Real) => Some(Literal::Real(*value)),
        (ExprKind::Const(Const::String(s)), Flex::Text) => Some(Literal::String(s.clone())),
        (ExprKind::Const(Const::WString(s)), Flex::Text) => Some(Literal::WString(s.clone())),
        _ => None,
    }
}
