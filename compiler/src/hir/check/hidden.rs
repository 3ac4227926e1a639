//! P6006: a variable of VAR or VAR_TEMP with the name of a global variable, of a function of the project, or, in a method, of a variable of its
//! type. Parameters may have such names: whoever calls sees them beside the call. (For inherited variables see P1022.)

use crate::hir::builder::Builder;
use crate::hir::model::*;
use crate::hir::symbols::Unit;
use crate::syntax::ast::{Name, SectionKind};
use std::collections::HashMap;
use takt_base::{Code, Diag, Span};

/// Names of the variables of types that have methods.
pub(super) type Members = HashMap<PouId, HashMap<String, Span>>;

/// Looks through the declarations of a unit.
pub(super) fn check(builder: &Builder, id: PouId, members: &mut Members, out: &mut Vec<Diag>) {
    for (section, _, name) in super::declarations(builder, id) {
        if matches!(section.kind, SectionKind::Var | SectionKind::Temp | SectionKind::Stat)
            && let Some((what, at)) = hides(builder, id, name, members)
        {
            let label = format!("hides {what}");
            let diag = Diag::new(Code::HidesOuter, name.span, label).also(at, "hidden here");
            out.push(diag.help("give it another name, or remove it if the other one is meant"));
        }
    }
}

fn hides(builder: &Builder, id: PouId, name: &Name, members: &mut Members) -> Option<(&'static str, Span)> {
    let key = name.key();
    if let Some(owner) = builder.hir.pous[id].owner {
        let visible = |v: &&Var| !matches!(v.role, Role::Hidden | Role::Temp);
        let names =
            || builder.hir.pous[owner].vars.iter().filter(visible).map(|v| (v.name.to_ascii_uppercase(), v.span)).collect();
        if let Some(span) = members.entry(owner).or_insert_with(names).get(&key) {
            return Some(("a variable of the type", *span));
        }
    }
    if let Some(&global) = builder.symbols.globals.get(&key) {
        let entry = &builder.symbols.global_entries[global];
        return (!entry.library && entry.decl.is_some()).then(|| ("a global variable", builder.hir.globals[global].span));
    }
    match builder.symbols.units.get(&key) {
        Some((Unit::Pou(other), span)) if builder.hir.pous[*other].kind == PouKind::Function && !builder.in_library(*span) => {
            Some(("a function", *span))
        }
        _ => None,
    }
}
