//! Advice (P6 codes): what is allowed and most likely a mistake. Given about the user's files, and only about a program without errors:
//! what is wrong has been left out of it, so that more would seem unused than is.

use super::{
    equality, hidden, never_read, outcome, overwritten, self_assignment, shift, success, unassigned, unreachable, unused,
};
use super::{unused_method, writers};
use crate::hir::builder::Builder;
use crate::hir::model::PouId;
use takt_base::Diag;

/// Runs all rules.
pub(super) fn give(builder: &mut Builder) {
    if builder.sink.has_errors() {
        return;
    }
    let mut found = about_units(builder);
    found.extend(unused_method::check(builder));
    found.extend(writers::check(builder));
    found.into_iter().for_each(|d| builder.report(d));
}

fn about_units(builder: &Builder) -> Vec<Diag> {
    let mut out = Vec::new();
    let (mut members, mut failing) = (hidden::Members::new(), success::Failing::new());
    // Of a unit that is partly or wholly written elsewhere too little is known; one without a text is made by the compiler.
    let known = |id: PouId| {
        let entry = builder.symbols.pous.get(id);
        entry.is_some_and(|e| !e.library && !e.decl.external && e.decl.inline_c.is_none())
    };
    for (id, pou) in builder.hir.pous.enumerate().filter(|(id, _)| known(*id)) {
        unused::check(builder, id, &mut out);
        hidden::check(builder, id, &mut members, &mut out);
        for rule in [equality::check, never_read::check, outcome::check, overwritten::check] {
            rule(builder, pou, &mut out);
        }
        for rule in [self_assignment::check, shift::check, unreachable::check] {
            rule(builder, pou, &mut out);
        }
        unassigned::check(builder, id, pou, &mut out);
        success::check(builder, pou, &mut failing, &mut out);
    }
    out
}
