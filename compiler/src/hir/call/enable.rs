//! EN and ENO (language reference §4.8): every call takes `EN := condition` and `ENO => variable`, declared or not.
//!
//! A call whose EN is FALSE is as if it were within an IF: nothing of it is evaluated or assigned, ENO alone becomes FALSE. Units of
//! the CODESYS profiles that declare EN or ENO keep them as ordinary parameters, and so do external ones.

use crate::hir::builder::Builder;
use crate::hir::convert::{Operand, constant_expr};
use crate::hir::model::*;
use crate::syntax::ast;
use takt_base::{Code, Diag, Span};
use takt_image::Elementary;

/// What a call says about EN and ENO.
pub(in crate::hir) struct Enable {
    pub en: Option<Expr>,
    pub eno: Option<Eno>,
    /// The other arguments.
    pub rest: Vec<ast::Arg>,
}

/// What a unit declares about EN and ENO.
#[derive(Clone, Copy, Default)]
pub(in crate::hir) struct Declared {
    pub en: Option<VarId>,
    pub eno: Option<VarId>,
    /// They are parameters like any other.
    ordinary: bool,
}

impl Builder<'_> {
    /// The declared EN and ENO of a unit; neither if they mean nothing special.
    pub(in crate::hir) fn declared_enable(&self, id: PouId) -> Declared {
        let pou = &self.hir.pous[id];
        let find = |name: &str, role| {
            let is = |v: &&VarId| {
                let var = &pou.vars[**v];
                var.role == role && var.name.eq_ignore_ascii_case(name) && self.elementary(var.ty) == Some(Elementary::Bool)
            };
            pou.params.iter().find(is).copied()
        };
        let (en, eno) = (find("EN", Role::Input), find("ENO", Role::Output));
        let ordinary = (en.is_some() || eno.is_some()) && (pou.external || self.profile(pou.end).is_codesys());
        if ordinary { Declared { en: None, eno: None, ordinary } } else { Declared { en, eno, ordinary } }
    }

    /// Takes EN, and ENO unless it is declared, out of the arguments; `None` if the call has neither.
    pub(in crate::hir) fn enable(&mut self, args: &[ast::Arg], declared: Declared) -> Option<Enable> {
        let is_en = |a: &ast::Arg| matches!(a, ast::Arg::Input { name, .. } if name.is("EN"));
        let is_eno = |a: &ast::Arg| matches!(a, ast::Arg::Output { name, .. } if name.is("ENO"));
        if declared.ordinary || !args.iter().any(|a| is_en(a) || is_eno(a)) {
            return None;
        }
        let mut enable = Enable { en: None, eno: None, rest: Vec::new() };
        let (mut ens, mut enos) = (0, 0);
        for arg in args {
            match arg {
                ast::Arg::Input { name, value } if is_en(arg) => {
                    ens += 1;
                    self.given_once(ens, name.span);
                    enable.en = value.as_ref().map(|e| self.condition(e));
                }
                ast::Arg::Output { name, negated, target } if is_eno(arg) && declared.eno.is_none() => {
                    enos += 1;
                    self.given_once(enos, name.span);
                    let place = target.as_ref().and_then(|e| self.eno_target(e));
                    enable.eno = place.map(|target| Eno { target, negated: *negated, written: false });
                }
                _ => enable.rest.push(arg.clone()),
            }
        }
        Some(enable)
    }

    fn given_once(&mut self, times: usize, span: Span) {
        if times > 1 {
            self.error(Code::WrongArgumentCount, span, "given twice");
        }
    }

    fn eno_target(&mut self, e: &ast::Expr) -> Option<Place> {
        let place = self.writable(e)?;
        if place.ty == self.error {
            return None;
        }
        if self.elementary(place.ty) != Some(Elementary::Bool) {
            let label = format!("{}, BOOL wanted", self.show(place.ty));
            self.report(Diag::new(Code::TypeMismatch, e.span, label).help("ENO is BOOL"));
            return None;
        }
        Some(place)
    }

    /// The call with what is said about it. A declared ENO is among its arguments.
    pub(in crate::hir) fn guarded(
        &mut self,
        call: Operand,
        en: Option<Expr>,
        mut eno: Option<Eno>,
        declared: Declared,
    ) -> Operand {
        if self.is_bad(&call) {
            return call;
        }
        let called = match &call.expr.kind {
            ExprKind::Call { pou, args } => Some((pou, args)),
            ExprKind::CallMethod(c) => Some((&c.method, &c.args)),
            _ => None,
        };
        if let (Some((pou, args)), Some(var)) = (called, declared.eno)
            && let Some(i) = self.hir.pous[*pou].params.iter().position(|p| *p == var)
            && let Some(Arg::Output { target, negated }) = args.get(i)
        {
            eno = Some(Eno { target: target.clone(), negated: *negated, written: true });
        }
        let (ty, span) = (call.expr.ty, call.expr.span);
        let call = self.settle(call);
        Operand::fixed(Expr { kind: ExprKind::Guarded(Box::new(Guarded { call, en, eno })), ty, span })
    }

    /// `kind` as an IF if the call in it has an EN: then the target of an assignment keeps its value.
    pub(in crate::hir) fn hoist_enable(&mut self, mut kind: StmtKind, span: Span) -> StmtKind {
        let guarded = match &mut kind {
            StmtKind::Assign { value, .. } | StmtKind::Call(value) => core(value),
            _ => None,
        };
        let Some((en, eno)) = guarded.and_then(|g| g.en.take().map(|en| (en, g.eno.clone()))) else { return kind };
        let skipped = eno.iter().map(|eno| self.set_eno(eno, false, span)).collect();
        StmtKind::If { branches: vec![(en, vec![Stmt { kind, span }])], otherwise: skipped }
    }

    /// The call of a block instance with EN and ENO.
    pub(in crate::hir) fn guarded_block(&mut self, call: StmtKind, enable: Enable, declared: Declared, span: Span) -> StmtKind {
        let StmtKind::CallBlock { instance, pou, mut inputs, outputs } = call else { return call };
        let mut eno = enable.eno;
        let own = declared.eno.and_then(|var| outputs.iter().find(|o| o.var == var));
        if let Some(o) = own {
            eno = Some(Eno { target: o.target.clone(), negated: o.negated, written: true });
        }
        let (mut after, mut skipped) = (Vec::new(), Vec::new());
        let bool = self.bool();
        if let Some(en) = declared.en {
            inputs.push((en, Arg::Value(constant_expr(Const::Int(1), bool, span))));
        }
        for var in [declared.en, declared.eno].into_iter().flatten() {
            if let Some(target) = self.own_pin(&instance, pou, var) {
                let value = constant_expr(Const::Int(0), bool, span);
                skipped.push(Stmt { kind: StmtKind::Assign { target, value }, span });
            }
        }
        if let Some(eno) = &eno {
            skipped.push(self.set_eno(eno, false, span));
            if !eno.written {
                after.push(self.set_eno(eno, true, span));
            }
        }
        let en = enable.en.unwrap_or_else(|| constant_expr(Const::Int(1), bool, span));
        let mut run = vec![Stmt { kind: StmtKind::CallBlock { instance, pou, inputs, outputs }, span }];
        run.append(&mut after);
        StmtKind::If { branches: vec![(en, run)], otherwise: skipped }
    }

    /// The condition of a call without EN of a block that declares one: what was last written there.
    pub(in crate::hir) fn own_enable(&self, instance: &Place, pou: PouId, declared: Declared, span: Span) -> Option<Expr> {
        let pin = self.own_pin(instance, pou, declared.en?)?;
        let ty = pin.ty;
        Some(Expr { kind: ExprKind::Load(pin), ty, span })
    }

    fn own_pin(&self, instance: &Place, pou: PouId, var: VarId) -> Option<Place> {
        let var = &self.hir.pous[pou].vars[var];
        let Storage::Field(i) = var.storage else { return None };
        let mut pin = instance.clone();
        pin.path.push(Step::Field(i));
        pin.ty = var.ty;
        Some(pin)
    }

    fn set_eno(&mut self, eno: &Eno, ok: bool, span: Span) -> Stmt {
        let bool = self.bool();
        let value = constant_expr(Const::Int(i128::from(ok != eno.negated)), bool, span);
        Stmt { kind: StmtKind::Assign { target: eno.target.clone(), value }, span }
    }
}

/// The call with an EN that the value is, conversions around it aside.
fn core(e: &mut Expr) -> Option<&mut Guarded> {
    match &mut e.kind {
        ExprKind::Convert(_, a) => core(a),
        ExprKind::Guarded(g) => Some(g),
        _ => None,
    }
}
