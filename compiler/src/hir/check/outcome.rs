//! P6008: conditions that have only one outcome. A constant at or beyond the edge of the range of the type (`USINT < 0`), unless it has a name; a variable compared
//! with itself; and two comparisons of one variable that can't both hold (`x > 9 AND x < 1`) or one of which always does
//! (`x <> 1 OR x <> 2`). Conditions made of constants alone are fine: that is how a program is configured.

use super::walk::{Event, same, walk};
use crate::hir::builder::Builder;
use crate::hir::constant;
use crate::hir::model::*;
use crate::syntax::ast::BinaryOp;
use takt_base::{Code, Diag};
use takt_image::types::Type;

/// Whole numbers beyond this are not told apart from their neighbours.
const EXACT: f64 = 9_007_199_254_740_992.0;

/// Looks through a body.
pub(super) fn check(builder: &Builder, pou: &Pou, out: &mut Vec<Diag>) {
    walk(&pou.body, &mut |event| {
        let Event::Expr(e) = event else { return };
        let ExprKind::Binary(op, a, b) = &e.kind else { return };
        let found = match op {
            BinaryOp::And | BinaryOp::AndThen | BinaryOp::Or | BinaryOp::OrElse => pair(builder, *op, a, b),
            _ => itself(builder, *op, a, b).or_else(|| edge(builder, *op, a, b)),
        };
        if let Some((outcome, why)) = found {
            let label = format!("always {}: {why}", if outcome { "TRUE" } else { "FALSE" });
            out.push(Diag::new(Code::OneOutcome, e.span, label).help("compare with another value, or leave the condition out"));
        }
    });
}

type Found = Option<(bool, String)>;

/// `x = x`; of a real that asks whether it is a number.
fn itself(builder: &Builder, op: BinaryOp, a: &Expr, b: &Expr) -> Found {
    let (ExprKind::Load(x), ExprKind::Load(y)) = (&a.kind, &b.kind) else { return None };
    let real = builder.hir.types.storage(a.ty).is_none_or(|e| e.is_real());
    let outcome = match op {
        BinaryOp::Eq | BinaryOp::Le | BinaryOp::Ge => true,
        BinaryOp::Ne | BinaryOp::Lt | BinaryOp::Gt => false,
        _ => return None,
    };
    (!real && same(x, y)).then(|| (outcome, "both sides are the same".to_owned()))
}

/// A constant outside of what the other side can be.
fn edge(builder: &Builder, op: BinaryOp, a: &Expr, b: &Expr) -> Found {
    let (op, e, value) = match (whole(a), whole(b)) {
        (None, Some(v)) if is_literal(builder, b) => (op, a, v),
        (Some(v), None) if is_literal(builder, a) => (mirrored(op), b, v),
        _ => return None,
    };
    let (low, high) = range(builder, e)?;
    let outcome = match op {
        BinaryOp::Lt if value > high => true,
        BinaryOp::Lt if value <= low => false,
        BinaryOp::Gt if value < low => true,
        BinaryOp::Gt if value >= high => false,
        BinaryOp::Le if value >= high => true,
        BinaryOp::Le if value < low => false,
        BinaryOp::Ge if value <= low => true,
        BinaryOp::Ge if value > high => false,
        BinaryOp::Eq if value < low || value > high => false,
        BinaryOp::Ne if value < low || value > high => true,
        _ => return None,
    };
    Some((outcome, format!("the other side is {low} to {high}")))
}

/// True for `5`, `-5` and `INT#5`; a constant with a name may have another value tomorrow.
fn is_literal(builder: &Builder, e: &Expr) -> bool {
    let text = builder.sources.text(e.span);
    text.contains('#') || text.starts_with(|c: char| c.is_ascii_digit() || matches!(c, '-' | '+'))
}

fn whole(e: &Expr) -> Option<i128> {
    if let ExprKind::Const(c @ Const::Int(_)) = &e.kind { constant::int(c) } else { None }
}

/// What the expression can be, conversions that keep the value aside.
fn range(builder: &Builder, e: &Expr) -> Option<(i128, i128)> {
    let own = match builder.ty(e.ty) {
        Type::Subrange { low, high, .. } => Some((*low, *high)),
        Type::Elementary(t) if t.is_int() || t.is_bit() => t.int_range(),
        _ => None,
    };
    let ExprKind::Convert(Conversion::Integer | Conversion::Subrange, inner) = &e.kind else { return own };
    let (inner, own) = (range(builder, inner)?, own?);
    Some(if inner.0 >= own.0 && inner.1 <= own.1 { inner } else { own })
}

/// The comparison with its sides exchanged.
fn mirrored(op: BinaryOp) -> BinaryOp {
    match op {
        BinaryOp::Lt => BinaryOp::Gt,
        BinaryOp::Gt => BinaryOp::Lt,
        BinaryOp::Le => BinaryOp::Ge,
        BinaryOp::Ge => BinaryOp::Le,
        op => op,
    }
}

/// Two comparisons of one variable with constants, joined by AND or OR. Of a longer chain the neighbours are looked at.
fn pair(builder: &Builder, op: BinaryOp, a: &Expr, b: &Expr) -> Found {
    let last = match &a.kind {
        ExprKind::Binary(inner, _, right) if joins(*inner) == joins(op) => right,
        _ => a,
    };
    let and = joins(op)?;
    let ((x, first), (y, second)) = (Set::of(builder, last, !and)?, Set::of(builder, b, !and)?);
    if !same(x, y) || !first.misses(&second) {
        return None;
    }
    let why = if and { "the two can't both hold" } else { "one of the two always holds" };
    Some((!and, why.to_owned()))
}

/// True for AND, false for OR.
fn joins(op: BinaryOp) -> Option<bool> {
    match op {
        BinaryOp::And | BinaryOp::AndThen => Some(true),
        BinaryOp::Or | BinaryOp::OrElse => Some(false),
        _ => None,
    }
}

/// The values for which a comparison holds.
enum Set {
    /// Bounds, and whether they belong to it.
    Between((f64, bool), (f64, bool)),
    AllBut(f64),
}

impl Set {
    /// The variable of a comparison, and for which values it holds; `not`: for which it does not.
    fn of<'a>(builder: &Builder, e: &'a Expr, not: bool) -> Option<(&'a Place, Set)> {
        let ExprKind::Binary(op, a, b) = &e.kind else { return None };
        let (op, variable, value) = match (number(a), number(b)) {
            (None, Some(v)) => (*op, a, v),
            (Some(v), None) => (mirrored(*op), b, v),
            _ => return None,
        };
        let ExprKind::Load(place) = &variable.kind else { return None };
        let real = builder.hir.types.storage(variable.ty)?.is_real();
        let op = if not { opposite(op)? } else { op };
        // NaN makes both a comparison and its opposite FALSE.
        if real && not {
            return None;
        }
        let step = if real { 0.0 } else { 1.0 };
        let (all, none) = ((f64::NEG_INFINITY, true), (f64::INFINITY, true));
        let set = match op {
            BinaryOp::Eq => Set::Between((value, true), (value, true)),
            BinaryOp::Ne => Set::AllBut(value),
            BinaryOp::Lt => Set::Between(all, (value - step, !real)),
            BinaryOp::Le => Set::Between(all, (value, true)),
            BinaryOp::Gt => Set::Between((value + step, !real), none),
            BinaryOp::Ge => Set::Between((value, true), none),
            _ => return None,
        };
        Some((place, set))
    }

    /// True if no value belongs to both.
    fn misses(&self, other: &Set) -> bool {
        match (self, other) {
            (Set::Between(a, b), Set::Between(c, d)) => {
                let low = if a.0 >= c.0 { a } else { c };
                let high = if b.0 <= d.0 { b } else { d };
                low.0 > high.0 || low.0 == high.0 && !(a.1 && b.1 && c.1 && d.1)
            }
            (Set::AllBut(v), Set::Between(a, b)) | (Set::Between(a, b), Set::AllBut(v)) => a.0 == *v && b.0 == *v,
            (Set::AllBut(_), Set::AllBut(_)) => false,
        }
    }
}

fn number(e: &Expr) -> Option<f64> {
    let ExprKind::Const(c) = &e.kind else { return None };
    let value = match c {
        Const::Int(v) => *v as f64,
        Const::Real(v) => *v,
        _ => return None,
    };
    (value.abs() < EXACT).then_some(value)
}

fn opposite(op: BinaryOp) -> Option<BinaryOp> {
    Some(match op {
        BinaryOp::Eq => BinaryOp::Ne,
        BinaryOp::Ne => BinaryOp::Eq,
        BinaryOp::Lt => BinaryOp::Ge,
        BinaryOp::Ge => BinaryOp::Lt,
        BinaryOp::Gt => BinaryOp::Le,
        BinaryOp::Le => BinaryOp::Gt,
        _ => return None,
    })
}
