//! Marks the units that a task reaches, directly or through calls.

use crate::hir::builder::Builder;
use crate::hir::model::PouId;
use takt_base::index::Index;

/// Sets [`crate::hir::model::Pou::reachable`].
pub(super) fn mark(builder: &mut Builder) {
    let mut called: Vec<Vec<PouId>> = vec![Vec::new(); builder.hir.pous.len()];
    let programs = builder.hir.tasks.iter().flat_map(|t| &t.programs);
    let mut todo: Vec<PouId> = programs.map(|p| p.pou).collect();
    for (from, to, _) in builder.calls.iter().chain(&builder.objects.dynamic_calls) {
        match from {
            Some(from) => called[from.index()].push(*to),
            None => todo.push(*to),
        }
    }
    while let Some(id) = todo.pop() {
        let pou = &mut builder.hir.pous[id];
        if !std::mem::replace(&mut pou.reachable, true) {
            todo.extend(&called[id.index()]);
        }
    }
}
