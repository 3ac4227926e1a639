//! Who calls whom.

use super::walk::{self, Event};
use crate::hir::model::*;
use takt_base::index::{Index, IndexVec};

/// Units that can reach themselves through calls.
pub fn recursive(hir: &Hir) -> IndexVec<PouId, bool> {
    let callees: IndexVec<PouId, Vec<PouId>> = hir.pous.iter().map(|p| with_derived(hir, callees(p))).collect();
    hir.pous.indices().map(|p| reaches(&callees, p)).collect()
}

fn callees(pou: &Pou) -> Vec<PouId> {
    let mut found = Vec::new();
    walk::statements(&pou.body, &mut |event| {
        if let Event::Call(p) = event {
            found.push(p);
        }
    });
    found.sort();
    found.dedup();
    found
}

/// The body of a function block may be that of one that extends it.
fn with_derived(hir: &Hir, mut list: Vec<PouId>) -> Vec<PouId> {
    let all = hir.pous.enumerate().filter(|(_, p)| p.base.is_some());
    let derived: Vec<PouId> = all.map(|(id, _)| id).filter(|id| list.iter().any(|l| l != id && hir.extends(*id, *l))).collect();
    list.extend(derived);
    list
}

fn reaches(callees: &IndexVec<PouId, Vec<PouId>>, unit: PouId) -> bool {
    let mut seen = vec![false; callees.len()];
    let mut todo = callees[unit].clone();
    while let Some(p) = todo.pop() {
        if p == unit {
            return true;
        }
        if !std::mem::replace(&mut seen[p.index()], true) {
            todo.extend(&callees[p]);
        }
    }
    false
}
