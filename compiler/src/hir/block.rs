//! Calls of function block instances as statements (§4.2, §4.7): inputs that are not given keep their values.

use super::builder::Builder;
use super::call::{Enable, Given};
use super::model::*;
use super::place::Access;
use super::scope::Local;
use super::symbols::Unit;
use crate::syntax::ast;
use takt_base::{Code, Diag, Span};
use takt_image::types::Type;

impl Builder<'_> {
    /// A call of an instance; `None` if the callee is no variable, so that it is the call of a function. `Some(None)`: reported.
    pub fn block_call(&mut self, callee: &ast::Expr, args: &[ast::Arg], span: Span) -> Option<Option<StmtKind>> {
        if let ast::ExprKind::Name(name) = &callee.kind
            && !self.names_variable(name)
        {
            return None;
        }
        Some(self.instance_call(callee, args, span))
    }

    /// True if a call of this name is one of a variable: an instance, or a mistake.
    pub fn names_variable(&self, name: &ast::Name) -> bool {
        match (self.local(&name.key()), self.scope.pou) {
            (Some(Local::Var(v)), Some(p)) => self.hir.pous[p].result != Some(v) && !self.calls_function_beside(name, p, v),
            (Some(_), _) => true,
            (None, _) if self.is_this(name) => true,
            (None, _) => {
                let function = matches!(self.unit(name), Some((Unit::Pou(_), _)));
                self.named_program(name).is_some() || !function && self.global_id(name).is_some()
            }
        }
    }

    fn instance_call(&mut self, callee: &ast::Expr, args: &[ast::Arg], span: Span) -> Option<StmtKind> {
        let target = self.place(callee);
        let pou = target.as_ref().and_then(|t| self.block_of(&t.place));
        let (Some(target), Some(id)) = (target.clone(), pou) else {
            if let Some(t) = target.filter(|t| t.place.ty != self.error) {
                let label = format!("{}, not a function block", self.show(t.place.ty));
                let help = "functions and instances of function blocks are called; of a class its methods";
                self.report(Diag::new(Code::NotCallable, callee.span, label).help(help));
            }
            args.iter().filter_map(super::body::arg_expr).for_each(|e| drop(self.operand(e, None)));
            return None;
        };
        if let Access::OwnInput(at) = target.access {
            let help = "pass the instance as VAR_IN_OUT to call it";
            self.report(Diag::new(Code::NotCallable, callee.span, "an input of this unit").also(at, "declared").help(help));
            return None;
        }
        self.note_call(id, span);
        self.note_bodies(&target.place, id, span);
        let declared = self.declared_enable(id);
        let enable = self.enable(args, declared);
        let rest = enable.as_ref().map_or(args, |e| &e.rest);
        let given = self.match_arguments(id, rest, span)?;
        let informal = rest.iter().any(|a| matches!(a, ast::Arg::Positional(_)));
        if informal && !self.profile(span).is_vendor() && !self.all_inputs_given(id, &given, span) {
            return None;
        }
        let own = self.own_enable(&target.place, id, declared, span);
        let call = self.block_arguments(target.place, id, given, span)?;
        Some(match (enable, own) {
            (None, None) => call,
            (Some(e), own) => self.guarded_block(call, Enable { en: e.en.or(own), ..e }, declared, span),
            (None, en) => self.guarded_block(call, Enable { en, eno: None, rest: Vec::new() }, declared, span),
        })
    }

    /// The function block that the place is an instance of.
    pub(super) fn block_of(&self, place: &Place) -> Option<PouId> {
        if !matches!(self.ty(place.ty), Type::Instance(_)) {
            return None;
        }
        let called = |id: &PouId| matches!(self.hir.pous[*id].kind, PouKind::FunctionBlock | PouKind::Program);
        self.objects.types.get(&place.ty).copied().filter(called)
    }

    fn block_arguments(&mut self, instance: Place, id: PouId, given: Vec<Option<Given>>, span: Span) -> Option<StmtKind> {
        let params = self.hir.pous[id].params.clone();
        let (mut inputs, mut outputs, mut fine) = (Vec::new(), Vec::new(), true);
        for (var, given) in params.into_iter().zip(given) {
            let role = self.hir.pous[id].vars[var].role;
            match (role, given) {
                (Role::InOut, None) => {
                    self.missing_in_out(id, var, span);
                    fine = false;
                }
                (_, None) => {}
                (Role::Input, Some(g)) if self.hir.pous[id].vars[var].copied_back => match self.in_out(id, var, g.expr()) {
                    Some(target) => {
                        let value = Expr { kind: ExprKind::Load(target.clone()), ty: target.ty, span: target.span };
                        inputs.push((var, Arg::Value(value)));
                        outputs.push(Output { var, target, negated: false, convert: None });
                    }
                    None => fine = false,
                },
                (Role::Input, Some(g)) => inputs.push((var, Arg::Value(self.input(id, var, g.expr())))),
                (Role::InOut, Some(g)) => match self.in_out(id, var, g.expr()) {
                    Some(place) => inputs.push((var, Arg::Reference(place))),
                    None => fine = false,
                },
                (_, Some(g)) => match self.block_output(id, var, g) {
                    Some(output) => outputs.push(output),
                    None => fine = false,
                },
            }
        }
        fine.then_some(StmtKind::CallBlock { instance, pou: id, inputs, outputs })
    }

    fn block_output(&mut self, id: PouId, var: VarId, given: Given) -> Option<Output> {
        let negated = matches!(given, Given::Output { negated: true, .. });
        let target = self.output(id, var, given.expr(), negated)?;
        let from = self.hir.pous[id].vars[var].ty;
        let convert = (target.ty != from).then_some((from, target.ty));
        Some(Output { var, target, negated, convert })
    }
}
