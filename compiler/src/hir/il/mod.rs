//! Instruction List becomes statements (language reference §6): each current result is a temporary of its own, or a constant that is
//! still a literal. What ST has too (operators, calls) is checked by the same code.

mod call;
mod flow;

use super::builder::Builder;
use super::convert::{Flex, Operand, constant_expr};
use super::model::*;
use crate::syntax::ast;
use crate::syntax::il::{Instr, InstrKind, Line, Op, When};
use flow::{Block, Edge, Out};
use std::collections::HashMap;
use takt_base::{Code, Diag, Profile, Span};
use takt_image::types::Type;

/// The current result.
#[derive(Clone, Debug)]
pub(super) enum Cr {
    Undefined,
    /// Something wrong that has been reported.
    Bad,
    /// A constant or a temporary.
    Value(Operand),
    /// What the ways to this block bring.
    Entry(usize),
}

/// A body that is being checked.
pub(super) struct List<'b, 'a> {
    b: &'b mut Builder<'a>,
    cr: Cr,
    /// The current instruction can be reached.
    open: bool,
    out: Vec<Out>,
    blocks: Vec<Block>,
    edges: Vec<Edge>,
    todo: Vec<usize>,
    labels: HashMap<String, (usize, LabelId)>,
    entries: Vec<Option<Place>>,
}

impl Builder<'_> {
    /// A body in Instruction List as statements.
    pub(super) fn instructions(&mut self, lines: &[Line], span: Span) -> Vec<Stmt> {
        let mut list = List {
            b: self,
            cr: Cr::Undefined,
            open: true,
            out: Vec::new(),
            blocks: Vec::new(),
            edges: Vec::new(),
            todo: Vec::new(),
            labels: HashMap::new(),
            entries: Vec::new(),
        };
        list.split(lines, span);
        list.blocks(lines);
        list.finish()
    }
}

impl List<'_, '_> {
    /// Checks an instruction.
    fn instr(&mut self, instr: &Instr) {
        let span = instr.span;
        match &instr.kind {
            InstrKind::Simple { op, negated, operand } => self.simple(op, *negated, operand.as_ref(), span),
            InstrKind::Deferred { op, negated, list } => self.deferred(op, *negated, list, span),
            InstrKind::Jump { when, label } => self.jump(*when, label, span),
            InstrKind::Call { when, instance, args } => self.call_instance(*when, instance, args, span),
            InstrKind::Return(when) => self.leave(*when, span),
            InstrKind::Function { name, args, formal } => self.function(name, args, *formal, span),
            InstrKind::Error => self.cr = Cr::Bad,
        }
    }

    fn simple(&mut self, op: &Op, negated: bool, operand: Option<&ast::Expr>, span: Span) {
        let Some(e) = operand else {
            return match op {
                Op::Not => self.not(span),
                _ => self.cr = Cr::Bad,
            };
        };
        let input = match op {
            Op::Input(name) => Some(name.text.as_str()),
            Op::Load if !negated => Some("LD"),
            Op::Set => Some("S"),
            Op::Reset => Some("R"),
            _ => None,
        };
        if let Some(input) = input
            && (matches!(op, Op::Input(_)) || self.is_instance(e))
        {
            return self.input_operator(input, e, span);
        }
        match op {
            Op::Load => {
                let o = self.b.operand(e, None);
                let o = if negated { self.b.complement(o, span, None) } else { o };
                self.set(o, span);
            }
            Op::Store => self.store(e, negated, span),
            Op::Attempt => {
                let kind = self.argument(span).and_then(|value| self.b.attempt(e, &value));
                kind.into_iter().for_each(|kind| self.push(kind, span));
            }
            Op::Set | Op::Reset => self.set_or_reset(e, *op == Op::Set, span),
            Op::Binary(op) => {
                let hint = if let Cr::Value(Operand { flex: Flex::Fixed, expr }) = &self.cr { Some(expr.ty) } else { None };
                let operand = self.b.operand(e, hint);
                self.apply(*op, negated, operand, span);
            }
            Op::Not | Op::Input(_) => {}
        }
    }

    /// CR := CR op operand.
    fn apply(&mut self, op: ast::BinaryOp, negated: bool, operand: Operand, span: Span) {
        let want = if operand.flex == Flex::Fixed { Some(operand.expr.ty) } else { None };
        let Some(cr) = self.read(want, span) else { return };
        self.combine(op, negated, cr, operand, span);
    }

    fn combine(&mut self, op: ast::BinaryOp, negated: bool, cr: Operand, operand: Operand, span: Span) {
        let want = if cr.flex == Flex::Fixed { Some(cr.expr.ty) } else { None };
        let operand = if negated { self.b.complement(operand, span, want) } else { operand };
        let o = self.b.combine(op, cr, operand, span, None);
        self.set(o, span);
    }

    fn deferred(&mut self, op: &Op, negated: bool, list: &[Instr], span: Span) {
        let (Op::Binary(op), before) = (op, self.read(None, span)) else { return };
        let inner = self.nested(list, span);
        match (before, inner) {
            (Some(cr), Some(inner)) => self.combine(*op, negated, cr, inner, span),
            _ => self.cr = Cr::Bad,
        }
    }

    /// The result of instructions in parentheses, which begin without one.
    fn nested(&mut self, list: &[Instr], span: Span) -> Option<Operand> {
        self.cr = Cr::Undefined;
        let done = self.b.depth_enter(span);
        if done {
            list.iter().for_each(|i| self.instr(i));
            self.b.depth_leave();
        } else {
            self.cr = Cr::Bad;
        }
        self.read(None, span)
    }

    fn not(&mut self, span: Span) {
        if let Some(o) = self.read(None, span) {
            let bool = self.b.bool();
            let want = (o.flex != Flex::Fixed && self.b.fits(&o, bool)).then_some(bool);
            let o = self.b.decay(o);
            let o = self.b.complement(o, span, want);
            self.set(o, span);
        }
    }

    fn store(&mut self, e: &ast::Expr, negated: bool, span: Span) {
        let target = self.b.writable(e);
        let want = target.as_ref().map(|t| t.ty);
        let Some(cr) = self.read(want, span) else { return };
        let cr = if negated { self.b.complement(cr, span, want) } else { cr };
        let Some(target) = target else { return };
        let mut value = Operand { flex: cr.flex, expr: Expr { span, ..cr.expr } };
        if let Cr::Value(o) = &self.cr
            && o.flex != Flex::Fixed
        {
            value.flex = o.flex;
        }
        let value = self.b.fit(value, target.ty);
        if value.ty != self.b.error && target.ty != self.b.error {
            self.push(StmtKind::Assign { target, value }, span);
        }
    }

    /// S and R of a variable. In profile openplc an integer becomes 1 or 0.
    fn set_or_reset(&mut self, e: &ast::Expr, set: bool, span: Span) {
        let target = self.b.writable(e);
        let Some(condition) = self.condition(When::True, span) else { return };
        let Some(target) = target.filter(|t| t.ty != self.b.error) else { return };
        let kind = self.b.elementary(target.ty);
        let counts = self.b.profile(span) == Profile::OpenPlc && kind.is_some_and(takt_image::Elementary::is_int);
        if !counts && kind != Some(takt_image::Elementary::Bool) {
            let label = format!("{}, BOOL wanted", self.b.show(target.ty));
            return self.b.report(Diag::new(Code::TypeMismatch, e.span, label).help("S and R set and reset a BOOL variable"));
        }
        let value = constant_expr(Const::Int(i128::from(set)), target.ty, span);
        let assign = Stmt { kind: StmtKind::Assign { target, value }, span };
        self.push(StmtKind::If { branches: vec![(condition, vec![assign])], otherwise: Vec::new() }, span);
    }

    fn leave(&mut self, when: When, span: Span) {
        let Some(condition) = self.condition(when, span) else { return };
        let leave = StmtKind::Return;
        match when {
            When::Always => self.push(leave, span),
            _ => {
                let branches = vec![(condition, vec![Stmt { kind: leave, span }])];
                self.push(StmtKind::If { branches, otherwise: Vec::new() }, span);
            }
        }
        self.stop(when);
    }

    /// The current result as a condition; TRUE without one.
    fn condition(&mut self, when: When, span: Span) -> Option<Expr> {
        let bool = self.b.bool();
        if when == When::Always {
            return Some(constant_expr(Const::Int(1), bool, span));
        }
        let o = self.read(Some(bool), span)?;
        if !self.b.fits(&o, bool) {
            let label = if o.flex == Flex::Fixed { self.b.show(o.expr.ty) } else { "a number".to_owned() };
            self.b.report(
                Diag::new(Code::NotBool, span, format!("the current result is {label}"))
                    .help("compare it first, for example NE 0"),
            );
            return None;
        }
        let expr = self.b.fit(o, bool);
        let o = if when == When::False { self.b.complement(Operand::fixed(expr), span, None) } else { Operand::fixed(expr) };
        Some(o.expr)
    }

    fn push(&mut self, kind: StmtKind, span: Span) {
        self.out.push(Out::Stmt(Stmt { kind, span }));
    }

    /// Makes this the current result.
    fn set(&mut self, o: Operand, span: Span) {
        self.cr = match &o.expr.kind {
            _ if self.b.is_bad(&o) => Cr::Bad,
            ExprKind::Const(_) => Cr::Value(o),
            _ => match self.keep(o.expr, span) {
                Some(load) => Cr::Value(Operand::fixed(load)),
                None => Cr::Bad,
            },
        };
    }

    /// A value in a temporary of its own.
    fn keep(&mut self, value: Expr, span: Span) -> Option<Expr> {
        let ty = value.ty;
        if matches!(self.b.ty(ty), Type::Instance(_)) {
            let label = format!("{} is a function block, not a value", self.b.show(ty));
            self.b.report(Diag::new(Code::NotAVariable, span, label).help("load one of its outputs, such as inst.Q"));
            return None;
        }
        let place = self.b.temporary(ty, span)?;
        self.push(StmtKind::Assign { target: place.clone(), value }, span);
        Some(Expr { kind: ExprKind::Load(place), ty, span })
    }

    /// The current result; a report if there is none. `want` settles literals that come from several ways.
    fn read(&mut self, want: Option<takt_image::TypeId>, span: Span) -> Option<Operand> {
        let found = match &self.cr {
            Cr::Value(o) => return Some(o.clone()),
            Cr::Bad => return None,
            Cr::Undefined => None,
            Cr::Entry(block) => {
                let block = *block;
                self.entry(block, want)
            }
        };
        if found.is_none() {
            let diag = Diag::new(Code::ResultUndefined, span, "needs a current result");
            self.b.report(diag.help("load one with LD first: there is none at the start, behind JMP and RET, and behind ("));
            self.cr = Cr::Bad;
        }
        found
    }
}
