//! P6007: `=` and `<>` of reals, which rounding makes unreliable. Fine are zero, which is often a mark and not a result; an integer that was
//! converted, which asks whether a value is whole; and a variable beside its own copy: `IF x <> last THEN last := x;`.

use super::walk::{Event, same, walk};
use crate::hir::builder::Builder;
use crate::hir::constant;
use crate::hir::model::*;
use crate::syntax::ast::BinaryOp;
use std::collections::HashSet;
use takt_base::{Code, Diag, Span};

/// Looks through a body.
pub(super) fn check(builder: &Builder, pou: &Pou, out: &mut Vec<Diag>) {
    let mut found: Vec<(&Expr, &Expr, BinaryOp, Span)> = Vec::new();
    walk(&pou.body, &mut |event| {
        if let Event::Expr(Expr { kind: ExprKind::Binary(op @ (BinaryOp::Eq | BinaryOp::Ne), a, b), span, .. }) = event
            && builder.elementary(a.ty).is_some_and(|e| e.is_real())
            && !is_exact(a)
            && !is_exact(b)
        {
            found.push((a, b, *op, *span));
        }
    });
    if found.is_empty() {
        return;
    }
    let copies = copies(pou);
    for (a, b, op, span) in found {
        let copied = |(x, y): (&Place, &Place)| {
            let keys = [key(x).zip(key(y)), key(y).zip(key(x))];
            same(x, y) || keys.into_iter().flatten().any(|k| copies.contains(&k))
        };
        if !loaded(a).zip(loaded(b)).is_some_and(copied) {
            let label = format!("{} {} {}", builder.show(a.ty), op.text(), builder.show(b.ty));
            out.push(Diag::new(Code::RealEquality, span, label).help("compare the distance: ABS(a - b) < tolerance"));
        }
    }
}

fn is_exact(e: &Expr) -> bool {
    match &e.kind {
        ExprKind::Const(c) => constant::is_zero(c) || constant::real(c) == Some(0.0),
        ExprKind::Convert(Conversion::IntToReal, _) => true,
        ExprKind::Convert(_, a) => is_exact(a),
        _ => false,
    }
}

/// The variable that is read, conversions aside.
fn loaded(e: &Expr) -> Option<&Place> {
    match &e.kind {
        ExprKind::Load(p) => Some(p),
        ExprKind::Convert(_, a) => loaded(a),
        _ => None,
    }
}

/// Which assignments of one variable to another there are.
fn copies(pou: &Pou) -> HashSet<(Key, Key)> {
    let mut copies = HashSet::new();
    walk(&pou.body, &mut |event| {
        if let Event::Write(target, Some(value)) = event {
            chosen(value).for_each(|p| copies.extend(key(target).zip(key(p))));
        }
    });
    copies
}

/// The variables of which an expression is one: it may choose among several.
fn chosen(e: &Expr) -> impl Iterator<Item = &Place> {
    use takt_stdlib::catalog::Intrinsic::{Limit, Max, Min, Move, Mux, Sel};
    let among = match &e.kind {
        ExprKind::Intrinsic(Sel | Max | Min | Limit | Mux | Move, args) => args.as_slice(),
        _ => std::slice::from_ref(e),
    };
    among.iter().filter_map(loaded)
}

/// A variable or element of one, indices aside.
type Key = (u8, u32, Vec<u32>);

fn key(p: &Place) -> Option<Key> {
    let (kind, number) = match p.base {
        Base::Var(v) => (0, v.0),
        Base::Global(g) => (1, g.0),
        Base::This => (2, 0),
        Base::Image(_) | Base::Value(_) => return None,
    };
    let fields = p.path.iter().filter_map(|s| if let Step::Field(i) = s { Some(*i) } else { None });
    Some((kind, number, fields.collect()))
}
