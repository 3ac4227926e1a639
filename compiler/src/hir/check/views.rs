//! What the units of each of several resources mean by the names of globals (§3.5): a variable of the resource, or else of the
//! configuration, declared as the unit expects it.

use super::reach;
use crate::hir::builder::Builder;
use crate::hir::model::*;
use std::collections::{BTreeMap, BTreeSet, HashMap};
use takt_base::index::Index;
use takt_base::{Code, Diag, Span};

/// Globals that a unit uses, and where first.
type Uses = BTreeMap<GlobalId, Span>;

/// Makes [`Hir::views`].
pub(super) fn check(builder: &mut Builder) {
    let called = reach::callees(builder);
    let (mut uses, mut loose): (HashMap<PouId, Uses>, bool) = (HashMap::new(), false);
    for (pou, global, span) in std::mem::take(&mut builder.uses) {
        match pou {
            Some(pou) => _ = uses.entry(pou).or_default().entry(global).or_insert(span),
            None => loose = true,
        }
    }
    for resource in 0..builder.symbols.resource_globals.len() as u32 {
        let mut entries: Vec<PouId> =
            builder.hir.tasks.iter().filter(|t| t.resource == resource).flat_map(reach::entries).collect();
        let setups = builder.hir.start.iter().flat_map(|s| &s.programs).filter(|(pou, _)| entries.contains(pou)).map(|s| s.1);
        entries.extend(setups.collect::<Vec<_>>());
        let reached = reach::reached(&called, entries);
        let renamed = renamed(builder, resource);
        let mut own = BTreeSet::new();
        for pou in &reached {
            let used = uses.get(pou).into_iter().flatten();
            for (global, span) in used {
                fits(builder, resource, *global, *span);
                if loose || renamed.contains_key(global) {
                    own.insert(*pou);
                }
            }
        }
        spread(&called, &reached, &mut own);
        if loose && !renamed.is_empty() {
            own.extend(reached);
        }
        builder.hir.views.push(View { renamed, own });
    }
}

/// Variables that are others in this resource.
fn renamed(builder: &Builder, resource: u32) -> BTreeMap<GlobalId, GlobalId> {
    let grouped = builder.symbols.grouped.iter();
    let visible = grouped.filter_map(|(id, key)| Some((*id, builder.visible(resource, key)?)));
    visible.filter(|(id, visible)| id != visible).collect()
}

/// The resource must have the variable, declared alike.
fn fits(builder: &mut Builder, resource: u32, used: GlobalId, span: Span) {
    let Some(key) = builder.symbols.grouped.get(&used).cloned() else { return };
    let wanted = &builder.hir.globals[used];
    let (ty, constant, name) = (wanted.ty, wanted.constant, wanted.name.clone());
    let place = builder.hir.resources.get(resource as usize).cloned().unwrap_or_default();
    let Some(found) = builder.visible(resource, &key) else {
        if !builder.tests {
            let label = format!("`{place}` has no `{name}`, and runs this unit");
            let help = "declare it in that resource, or in the configuration for all";
            builder.report(Diag::new(Code::ExternalMismatch, span, label).help(help));
        }
        return;
    };
    let found = &builder.hir.globals[found];
    if (found.ty, found.constant) != (ty, constant) && ty != builder.error && found.ty != builder.error {
        let constant = if found.constant { "CONSTANT " } else { "" };
        let label = format!("`{name}` of `{place}` is {constant}{}, this is not", builder.show(found.ty));
        let diag = Diag::new(Code::ExternalMismatch, span, label).also(found.span, "the global");
        builder.report(diag.help("both resources run this unit: declare the variable alike in both"));
    }
}

/// Who calls a unit that differs differs too.
fn spread(called: &[Vec<PouId>], reached: &[PouId], own: &mut BTreeSet<PouId>) {
    loop {
        let more = |p: &&PouId| !own.contains(p) && called[p.index()].iter().any(|c| own.contains(c));
        let found: Vec<PouId> = reached.iter().filter(more).copied().collect();
        if found.is_empty() {
            return;
        }
        own.extend(found);
    }
}
