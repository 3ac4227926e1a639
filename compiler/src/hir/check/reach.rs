//! Marks the units that a task reaches, directly or through calls.

use crate::hir::builder::Builder;
use crate::hir::model::{PouId, Task};
use takt_base::index::Index;

/// Sets [`crate::hir::model::Pou::reachable`].
pub(super) fn mark(builder: &mut Builder) {
    let called = callees(builder);
    let mut todo: Vec<PouId> = builder.hir.tasks.iter().flat_map(entries).collect();
    let everywhere = builder.calls.iter().chain(&builder.objects.dynamic_calls).filter(|c| c.0.is_none());
    todo.extend(everywhere.map(|c| c.1));
    for id in reached(&called, todo) {
        builder.hir.pous[id].reachable = true;
    }
}

/// What a task runs: programs, and function blocks of its own.
pub(super) fn entries(task: &Task) -> impl Iterator<Item = PouId> {
    task.programs.iter().map(|p| p.pou).chain(task.blocks.iter().map(|b| b.pou))
}

/// Units that each unit calls.
pub(super) fn callees(builder: &Builder) -> Vec<Vec<PouId>> {
    let mut called: Vec<Vec<PouId>> = vec![Vec::new(); builder.hir.pous.len()];
    for (from, to, _) in builder.calls.iter().chain(&builder.objects.dynamic_calls) {
        if let Some(from) = from {
            called[from.index()].push(*to);
        }
    }
    called
}

/// Everything that some units reach, themselves included.
pub(super) fn reached(called: &[Vec<PouId>], mut todo: Vec<PouId>) -> Vec<PouId> {
    let mut seen = vec![false; called.len()];
    let mut list = Vec::new();
    while let Some(id) = todo.pop() {
        if !std::mem::replace(&mut seen[id.index()], true) {
            list.push(id);
            todo.extend(&called[id.index()]);
        }
    }
    list
}
