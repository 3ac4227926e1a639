//! P6003: a variable of VAR, VAR_TEMP, VAR_STAT or VAR_EXTERNAL that no text mentions. Inputs, outputs, located and PUBLIC variables are
//! seen from outside; so are the variables of types that are derived, by the types that derive from them.

use crate::hir::builder::Builder;
use crate::hir::model::*;
use crate::syntax::ast::{AccessSpec, SectionKind};
use takt_base::{Code, Diag};

/// Looks through the declarations of a unit.
pub(super) fn check(builder: &Builder, id: PouId, out: &mut Vec<Diag>) {
    for (section, decl, name) in super::declarations(builder, id) {
        let own = matches!(section.kind, SectionKind::Var | SectionKind::Temp | SectionKind::Stat | SectionKind::External);
        let public = matches!(section.access, Some(AccessSpec::Public | AccessSpec::Internal));
        if own && !public && decl.at.is_none() && !builder.used.contains(&name.span) {
            out.push(Diag::new(Code::Unused, name.span, "never mentioned").help("remove it, or use it"));
        }
    }
}
