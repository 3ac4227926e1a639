//! Matching of arguments and parameters of user units: by position or by name (§4.7).

use crate::hir::builder::Builder;
use crate::hir::convert::Operand;
use crate::hir::model::*;
use crate::syntax::ast;
use takt_base::{Code, Diag, Span};

/// An argument for a parameter.
#[derive(Clone, Copy)]
pub(in crate::hir) enum Given<'t> {
    /// By position, or `name := value`.
    Value(&'t ast::Expr),
    /// `name => target`, `NOT name => target`.
    Output { target: &'t ast::Expr, negated: bool },
}

impl<'t> Given<'t> {
    /// What is written there.
    pub fn expr(self) -> &'t ast::Expr {
        match self {
            Given::Value(e) | Given::Output { target: e, .. } => e,
        }
    }
}

impl Builder<'_> {
    /// The argument of each parameter, in the order of [`Pou::params`]; `None` if a report makes the call useless.
    pub(in crate::hir) fn match_arguments<'t>(
        &mut self,
        id: PouId,
        args: &'t [ast::Arg],
        span: Span,
    ) -> Option<Vec<Option<Given<'t>>>> {
        let mut given: Vec<Option<Given<'t>>> = vec![None; self.hir.pous[id].params.len()];
        let mut fine = self.check_forms(args);
        for (position, arg) in args.iter().enumerate() {
            let (slot, value) = match arg {
                ast::Arg::Positional(e) => (self.positional(id, position, e.span, span), Some(Given::Value(e))),
                ast::Arg::Input { name, value } => (self.named(id, name, false), value.as_ref().map(Given::Value)),
                ast::Arg::Output { name, negated, target } => {
                    let output = |target| Given::Output { target, negated: *negated };
                    (self.named(id, name, true), target.as_ref().map(output))
                }
            };
            match slot {
                Some(slot) if given[slot].is_some() => {
                    let at = value.map_or(span, |g| g.expr().span);
                    self.error(Code::WrongArgumentCount, at, "given twice");
                    fine = false;
                }
                Some(slot) => given[slot] = value,
                None => {
                    fine = false;
                    if let Some(e) = super::super::body::arg_expr(arg) {
                        self.operand(e, None);
                    }
                }
            }
        }
        fine.then_some(given)
    }

    /// Positional arguments stand in front; false and a report if one stands behind a named one.
    fn check_forms(&mut self, args: &[ast::Arg]) -> bool {
        let named = args.iter().position(|a| !matches!(a, ast::Arg::Positional(_))).unwrap_or(args.len());
        let late = args[named..].iter().find_map(|a| if let ast::Arg::Positional(e) = a { Some(e) } else { None });
        if let Some(e) = late {
            let help = "name this argument too: `name := value`";
            self.report(Diag::new(Code::WrongArgumentCount, e.span, "a positional argument behind a named one").help(help));
        }
        late.is_none()
    }

    fn positional(&mut self, id: PouId, position: usize, at: Span, call: Span) -> Option<usize> {
        let own = self.declared_enable(id);
        let enables = |v: &VarId| own.en == Some(*v) || own.eno == Some(*v);
        let params = &self.hir.pous[id].params;
        let mut counted = params.iter().enumerate().filter(|(_, v)| !enables(v));
        let slot = counted.nth(position).map(|(i, _)| i);
        let count = params.iter().filter(|v| !enables(v)).count();
        if slot.is_none() {
            let label = format!("`{}` has {count} parameters", self.hir.pous[id].name);
            self.report(Diag::new(Code::WrongArgumentCount, at, label).also(call, "the call"));
            return None;
        }
        slot
    }

    /// Index of a parameter by its name; `output`: it is written with `=>`.
    fn named(&mut self, id: PouId, name: &ast::Name, output: bool) -> Option<usize> {
        let pou = &self.hir.pous[id];
        let slot = pou.params.iter().position(|v| name.is(&pou.vars[*v].name));
        let slot = slot.or_else(|| {
            let pin = self.vendor_pin(pou.instance?, name)?;
            pou.params.iter().position(|v| pou.vars[*v].name == pin)
        });
        let Some(slot) = slot else {
            self.no_parameter(id, name);
            return None;
        };
        let var = &pou.vars[pou.params[slot]];
        if output != (var.role == Role::Output) {
            let help = if output { "write `name := value`" } else { "write `name => variable`" };
            let label = if output { "an input" } else { "an output" };
            self.report(Diag::new(Code::UnknownParameter, name.span, label).also(var.span, "declared").help(help));
            return None;
        }
        Some(slot)
    }

    fn no_parameter(&mut self, id: PouId, name: &ast::Name) {
        let pou = &self.hir.pous[id];
        let known = pou.params.iter().map(|v| pou.vars[*v].name.clone()).collect();
        self.unknown(Code::UnknownParameter, name, known);
    }

    /// The value of an input.
    pub(in crate::hir) fn input(&mut self, id: PouId, var: VarId, e: &ast::Expr) -> Expr {
        let v = &self.hir.pous[id].vars[var];
        let (ty, note) = (v.ty, (v.span, format!("input `{}` is {}", v.name, self.show(v.ty))));
        if self.bound_type(ty).is_some() {
            return self.bound_value(e, ty);
        }
        let o = self.operand(e, Some(ty));
        let o = self.preset_of_timer(id, var, o);
        self.fit_for(o, ty, Some(note))
    }

    /// The variable of a VAR_IN_OUT.
    pub(in crate::hir) fn in_out(&mut self, id: PouId, var: VarId, e: &ast::Expr) -> Option<Place> {
        let v = &self.hir.pous[id].vars[var];
        let (ty, note) = (v.ty, (v.span, format!("`{}` is VAR_IN_OUT", v.name)));
        self.bindable(e, ty, note, Some((id, var)))
    }

    /// Where an output goes; the value widens if it must.
    pub(in crate::hir) fn output(&mut self, id: PouId, var: VarId, target: &ast::Expr, negated: bool) -> Option<Place> {
        let v = &self.hir.pous[id].vars[var];
        let (ty, note) = (v.ty, (v.span, format!("output `{}` is {}", v.name, self.show(v.ty))));
        let place = self.writable(target)?;
        if negated && !self.elementary(ty).is_some_and(takt_image::Elementary::is_bit) {
            self.error(Code::BadOperand, target.span, format!("NOT of {}", self.show(ty)));
            return None;
        }
        let source = Expr { kind: ExprKind::Load(place.clone()), ty, span: target.span };
        if self.splits_into(id, &source, place.ty) {
            return Some(place);
        }
        let fitted = self.fit_for(Operand::fixed(source), place.ty, Some(note));
        (fitted.ty != self.error).then_some(place)
    }

    /// Reports a VAR_IN_OUT without an argument.
    pub(in crate::hir) fn missing_in_out(&mut self, id: PouId, var: VarId, span: Span) {
        let v = &self.hir.pous[id].vars[var];
        let (name, at) = (v.name.clone(), v.span);
        let diag = Diag::new(Code::MissingInOut, span, format!("`{name}` is missing")).also(at, "declared");
        self.report(diag.help(format!("add `{name} := variable`")));
    }
}
