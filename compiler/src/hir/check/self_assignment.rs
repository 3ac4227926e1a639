//! P6013: a variable that is assigned to itself.

use super::walk::{Event, same, walk};
use crate::hir::builder::Builder;
use crate::hir::model::*;
use takt_base::{Code, Diag};

/// Looks through a body.
pub(super) fn check(_: &Builder, pou: &Pou, out: &mut Vec<Diag>) {
    walk(&pou.body, &mut |event| {
        if let Event::Statement(Stmt { kind: StmtKind::Assign { target, value }, span }) = event
            && matches!(&value.kind, ExprKind::Load(p) if same(p, target))
        {
            let diag = Diag::new(Code::SelfAssignment, *span, "the variable keeps its value");
            out.push(diag.help("assign what was meant, or remove the statement"));
        }
    });
}
