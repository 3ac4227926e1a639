//! P6010: a call whose success nobody looks at though it matters. Either the call has an EN and stands within an expression: not run, its
//! value is zero, and the expression goes on with that. Or the function says by ENO that it failed, and the call leaves ENO out. A call
//! with EN whose value is assigned as it is needs no ENO: not run, the target keeps its value.

use super::walk::{Event, walk};
use crate::hir::builder::Builder;
use crate::hir::constant;
use crate::hir::model::*;
use std::collections::HashMap;
use takt_base::index::Index;
use takt_base::{Code, Diag};

/// The functions that may fail, with the position of ENO among their parameters.
pub(super) type Failing = HashMap<PouId, Option<usize>>;

/// Looks through a body.
pub(super) fn check(builder: &Builder, pou: &Pou, failing: &mut Failing, out: &mut Vec<Diag>) {
    walk(&pou.body, &mut |event| {
        let Event::Expr(e) = event else { return };
        match &e.kind {
            ExprKind::Guarded(g) if g.eno.is_none() && g.en.as_ref().is_some_and(|en| !matches!(en.kind, ExprKind::Const(_))) => {
                let diag = Diag::new(Code::SuccessIgnored, e.span, "zero if its EN is FALSE, and used all the same");
                out.push(diag.help("assign the call alone, which then keeps the old value; or take ENO => and look at it"));
            }
            ExprKind::Call { pou: called, args } => {
                let eno = *failing.entry(*called).or_insert_with(|| fails(builder, *called));
                if eno.is_some_and(|i| matches!(args.get(i), Some(Arg::Unused))) {
                    let label = format!("`{}` can fail, and says so by ENO", builder.hir.pous[*called].name);
                    out.push(Diag::new(Code::SuccessIgnored, e.span, label).help("take ENO => and look at it"));
                }
            }
            _ => {}
        }
    });
}

/// Position of the ENO that the body of a function sets to something else than TRUE.
fn fails(builder: &Builder, id: PouId) -> Option<usize> {
    let eno = builder.declared_enable(id).eno?;
    let pou = &builder.hir.pous[id];
    let mut fails = false;
    walk(&pou.body, &mut |event| {
        if let Event::Write(p, value) = event
            && matches!(p.base, Base::Var(v) if v.index() == eno.index())
        {
            fails |= !value.is_some_and(|v| matches!(&v.kind, ExprKind::Const(c) if !constant::is_zero(c)));
        }
    });
    pou.params.iter().position(|p| *p == eno).filter(|_| fails)
}
