//! P6004: a variable that lives as long as one call, is assigned, and is never read. The target of an output or of a call is fine: that is how
//! a value is thrown away.

use super::walk::{Event, is_followed, walk};
use crate::hir::builder::Builder;
use crate::hir::model::*;
use takt_base::index::Index;
use takt_base::{Code, Diag, Span};

/// Looks through a body.
pub(super) fn check(builder: &Builder, pou: &Pou, out: &mut Vec<Diag>) {
    let anew =
        |v: &Var| v.role == Role::Temp || v.role == Role::Local && pou.kind.is_called_by_value() && v.storage == Storage::Local;
    if !pou.vars.iter().any(anew) {
        return;
    }
    let mut read = vec![false; pou.vars.len()];
    let mut written: Vec<Option<Span>> = vec![None; pou.vars.len()];
    walk(&pou.body, &mut |event| match event {
        Event::Read(p) | Event::Lend(p) => note(p, &mut read),
        // What lies behind a reference outlives it.
        Event::Write(p, _) if is_followed(p) => note(p, &mut read),
        Event::Write(p, None) => note(p, &mut read),
        Event::Write(p, Some(value)) if calls(value) => note(p, &mut read),
        Event::Write(p, Some(_)) => {
            if let Base::Var(v) = p.base {
                written[v.index()].get_or_insert(p.span);
            }
        }
        _ => {}
    });
    for ((var, read), at) in pou.vars.iter().zip(read).zip(written) {
        if let Some(at) = at.filter(|_| anew(var) && !read && !builder.in_library(var.span)) {
            let label = format!("nothing reads `{}` after this", var.name);
            let diag = Diag::new(Code::NeverRead, at, label).also(var.span, "declared");
            out.push(diag.help("use the value, or remove the variable"));
        }
    }
}

fn note(p: &Place, read: &mut [bool]) {
    if let Base::Var(v) = p.base {
        read[v.index()] = true;
    }
}

/// The value is that of a call, which may be made for what else it does.
fn calls(e: &Expr) -> bool {
    match &e.kind {
        ExprKind::Call { .. } | ExprKind::CallMethod(_) | ExprKind::Native { .. } | ExprKind::Guarded(_) => true,
        ExprKind::Convert(_, a) | ExprKind::Not(a) => calls(a),
        _ => false,
    }
}
