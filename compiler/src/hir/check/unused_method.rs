//! P6005: a PRIVATE method that its type never calls.

use crate::hir::builder::Builder;
use crate::hir::model::*;
use crate::syntax::ast::AccessSpec;
use std::collections::HashSet;
use takt_base::{Code, Diag};

/// Looks at all methods; calls by itself don't count.
pub(super) fn check(builder: &Builder) -> Vec<Diag> {
    let calls = builder.calls.iter().chain(&builder.objects.dynamic_calls);
    let called: HashSet<PouId> = calls.filter(|c| c.0 != Some(c.1)).map(|c| c.1).collect();
    let mut out = Vec::new();
    for (id, entry) in builder.symbols.pous.enumerate() {
        let objects = &entry.decl.objects;
        let private = objects.modifiers.access.is_some_and(|a| a.0 == AccessSpec::Private) && objects.accessor.is_none();
        if builder.hir.pous[id].kind == PouKind::Method && private && !called.contains(&id) {
            let diag = Diag::new(Code::UnusedMethod, entry.decl.name.span, "only its own type could call it");
            out.push(diag.help("remove it, call it, or make it PUBLIC"));
        }
    }
    out
}
