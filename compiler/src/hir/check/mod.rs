//! Rules about whole units and the whole program: one rule, one file.

mod advice;
mod bound;
mod equality;
mod hidden;
mod inline_c;
mod never_read;
mod outcome;
mod overwritten;
mod reach;
mod recursion;
mod result;
mod section;
mod self_assignment;
mod shift;
mod success;
mod unassigned;
mod unreachable;
mod unused;
mod unused_method;
mod views;
mod walk;
mod writers;

use super::builder::Builder;
use super::model::PouId;
use crate::syntax::ast;

/// Rules that need all bodies. Runs last.
pub(super) fn all(builder: &mut Builder) {
    bound::check(builder);
    reach::mark(builder);
    views::check(builder);
    recursion::check(builder);
    inline_c::check(builder);
    advice::give(builder);
}

/// All variables that a unit declares, with what they are declared in.
fn declarations<'a>(
    builder: &Builder<'a>,
    id: PouId,
) -> impl Iterator<Item = (&'a ast::VarSection, &'a ast::VarDecl, &'a ast::Name)> + use<'a> {
    let pairs = builder.symbols.pous[id].decl.sections.iter().flat_map(|s| s.decls.iter().map(move |d| (s, d)));
    pairs.flat_map(|(s, d)| d.names.iter().map(move |n| (s, d, n)))
}
