//! Inline C of MATIEC (language reference §1.4): a unit that has some can't be compiled. That is an error if a task reaches it;
//! in a library that nobody calls it is a warning.

use crate::hir::builder::Builder;
use takt_base::{Code, Diag, Severity};

/// Reports every unit with inline C.
pub(super) fn check(builder: &mut Builder) {
    for id in builder.symbols.pous.indices() {
        let entry = &builder.symbols.pous[id];
        let Some(span) = entry.decl.inline_c else { continue };
        let reachable = builder.hir.pous[id].reachable;
        let label = format!("`{}` is partly written in C", builder.hir.pous[id].name);
        let diag = Diag::new(Code::NotSupportedYet, span, label)
            .message("inline C can't be compiled")
            .help("write it in ST; the function TIME() gives the time of the task's start");
        builder.report(if reachable { diag } else { diag.severity(Severity::Warning) });
    }
}
