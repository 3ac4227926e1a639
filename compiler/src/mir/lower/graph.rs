//! Who calls whom.

use super::walk::{self, Event};
use crate::hir::model::*;
use takt_base::index::{Index, IndexVec};

/// Units that can reach themselves through calls.
pub fn recursive(hir: &Hir) -> IndexVec<PouId, bool> {
    let callees: IndexVec<PouId, Vec<PouId>> = hir.pous.iter().map(callees).collect();
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
