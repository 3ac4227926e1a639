//! P6009: SHL and SHR by a constant that is not less than the width of the operand: the result is always zero.

use super::walk::{Event, walk};
use crate::hir::builder::Builder;
use crate::hir::constant;
use crate::hir::model::*;
use takt_base::{Code, Diag};
use takt_stdlib::catalog::Intrinsic;

/// Looks through a body.
pub(super) fn check(builder: &Builder, pou: &Pou, out: &mut Vec<Diag>) {
    walk(&pou.body, &mut |event| {
        let Event::Expr(e) = event else { return };
        let ExprKind::Intrinsic(Intrinsic::Shl | Intrinsic::Shr, args) = &e.kind else { return };
        let [operand, Expr { kind: ExprKind::Const(by), .. }] = args.as_slice() else { return };
        let (Some(by), Some(of)) = (constant::int(by), builder.hir.types.storage(operand.ty)) else { return };
        let width = of.bits();
        if by >= width.into() {
            let label = format!("by {by}, and {} has {width} bits", builder.show(operand.ty));
            out.push(Diag::new(Code::ShiftTooFar, e.span, label).help("shift by less, or widen the operand first"));
        }
    });
}
