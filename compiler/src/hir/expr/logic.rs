//! Short circuit (§5.4): AND and OR of BOOL skip the right side when it calls nobody and may trap, so that skipping can only remove
//! faults.

use crate::hir::assert::PREFIX;
use crate::hir::builder::Builder;
use crate::hir::constant;
use crate::hir::convert::Operand;
use crate::hir::model::*;
use crate::syntax::ast::BinaryOp;
use takt_image::Elementary;
use takt_stdlib::catalog::Intrinsic;

impl Builder<'_> {
    /// Turns AND and OR of BOOL into their skipping forms where that is wanted.
    pub(super) fn short_circuit(&self, mut o: Operand) -> Operand {
        if self.elementary(o.expr.ty) == Some(Elementary::Bool)
            && let ExprKind::Binary(op @ (BinaryOp::And | BinaryOp::Or), _, right) = &mut o.expr.kind
            && !calls(right)
            && may_trap(right)
        {
            *op = if *op == BinaryOp::And { BinaryOp::AndThen } else { BinaryOp::OrElse };
        }
        o
    }
}

/// The parts of an expression that are expressions themselves.
fn parts(e: &Expr) -> Vec<&Expr> {
    match &e.kind {
        ExprKind::Const(_) => vec![],
        ExprKind::Load(place) | ExprKind::Address(place) => indices(place),
        ExprKind::Neg(a) | ExprKind::Not(a) | ExprKind::Convert(_, a) => vec![a],
        ExprKind::Binary(_, a, b) => vec![a, b],
        ExprKind::Call { args, .. } => args.iter().filter_map(|a| if let Arg::Value(e) = a { Some(e) } else { None }).collect(),
        ExprKind::CallMethod(c) => {
            let args = c.args.iter().filter_map(|a| if let Arg::Value(e) = a { Some(e) } else { None });
            match &c.receiver {
                Receiver::Reference(e) => args.chain([e]).collect(),
                Receiver::Place(p) => args.chain(indices(p)).collect(),
            }
        }
        ExprKind::AddressOf(place) => indices(place),
        ExprKind::OfClass(a, _) => vec![a],
        ExprKind::Stored(s) => indices(&s.0).into_iter().chain([&s.1]).collect(),
        ExprKind::Intrinsic(_, args) | ExprKind::Native { args, .. } => args.iter().collect(),
        ExprKind::Guarded(g) => g.en.iter().chain([&g.call]).collect(),
    }
}

fn indices(place: &Place) -> Vec<&Expr> {
    let base = if let Base::Value(e) = &place.base { Some(&**e) } else { None };
    base.into_iter().chain(place.path.iter().flat_map(step_indices)).collect()
}

fn step_indices(step: &Step) -> Vec<&Expr> {
    match step {
        Step::Index(list) => list.iter().collect(),
        Step::Character(e) => vec![e.as_ref()],
        Step::Deref | Step::Field(_) | Step::Part { .. } => vec![],
    }
}

/// True if a user's unit is called, or an assertion, which counts.
fn calls(e: &Expr) -> bool {
    let here = match &e.kind {
        ExprKind::Native { name, .. } => name.starts_with(PREFIX),
        kind => matches!(kind, ExprKind::Call { .. } | ExprKind::CallMethod(_) | ExprKind::Guarded(_) | ExprKind::Stored(_)),
    };
    here || parts(e).into_iter().any(calls)
}

/// True if evaluating it may stop the program.
fn may_trap(e: &Expr) -> bool {
    let constant = |e: &Expr| matches!(e.kind, ExprKind::Const(_));
    let divisor_unsafe = |e: &Expr| !matches!(&e.kind, ExprKind::Const(c) if !constant::is_zero(c));
    let here = match &e.kind {
        ExprKind::Load(place) | ExprKind::Address(place) => place.path.iter().any(|s| match s {
            Step::Index(list) => !list.iter().all(constant),
            Step::Deref | Step::Character(_) => true,
            Step::Field(_) | Step::Part { .. } => false,
        }),
        ExprKind::Convert(Conversion::Subrange, _) | ExprKind::Native { .. } | ExprKind::Call { .. } => true,
        ExprKind::Binary(BinaryOp::Div | BinaryOp::Mod, _, b) => divisor_unsafe(b),
        ExprKind::Intrinsic(Intrinsic::Div | Intrinsic::Mod, _) => true,
        _ => false,
    };
    here || parts(e).into_iter().any(may_trap)
}
