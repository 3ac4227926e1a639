//! Units that call themselves, directly or through others (§4): a warning, since the run-time guard stops endless ones.

use crate::hir::builder::Builder;
use crate::hir::model::PouId;
use takt_base::index::Index;
use takt_base::{Code, Diag, Span};

/// Reports each unit on a cycle of calls once, at the first call that leads back to it.
pub(super) fn check(builder: &mut Builder) {
    let mut called: Vec<Vec<(PouId, Span)>> = vec![Vec::new(); builder.hir.pous.len()];
    for &(from, to, span) in &builder.calls {
        if let Some(from) = from {
            called[from.index()].push((to, span));
        }
    }
    let components = components(&called);
    for id in builder.hir.pous.indices() {
        let mine = components[id.index()];
        let back = called[id.index()].iter().find(|(to, _)| components[to.index()] == mine);
        if let Some(&(to, span)) = back {
            let name = builder.hir.pous[id].name.clone();
            let label = if to == id { format!("`{name}` calls itself") } else { format!("leads back to `{name}`") };
            let help = "make sure that it ends: calls nested too deep stop the program";
            builder.report(Diag::new(Code::Recursion, span, label).help(help));
        }
    }
}

/// Number of the strongly connected component of each unit (Tarjan, without recursion).
fn components(called: &[Vec<(PouId, Span)>]) -> Vec<usize> {
    let count = called.len();
    let mut search = Search {
        order: vec![usize::MAX; count],
        low: vec![0; count],
        component: vec![usize::MAX; count],
        stack: Vec::new(),
        next: 0,
    };
    for root in 0..count {
        if search.order[root] == usize::MAX {
            search.visit(root, called);
        }
    }
    search.component
}

struct Search {
    order: Vec<usize>,
    low: Vec<usize>,
    component: Vec<usize>,
    stack: Vec<usize>,
    next: usize,
}

impl Search {
    fn visit(&mut self, root: usize, called: &[Vec<(PouId, Span)>]) {
        let mut path = vec![(root, 0)];
        self.enter(root);
        while let Some((node, edge)) = path.pop() {
            match called[node].get(edge) {
                Some((to, _)) => {
                    path.push((node, edge + 1));
                    let to = to.index();
                    if self.order[to] == usize::MAX {
                        self.enter(to);
                        path.push((to, 0));
                    } else if self.component[to] == usize::MAX {
                        self.low[node] = self.low[node].min(self.order[to]);
                    }
                }
                None => self.leave(node, path.last().map(|p| p.0)),
            }
        }
    }

    fn enter(&mut self, node: usize) {
        self.order[node] = self.next;
        self.low[node] = self.next;
        self.next += 1;
        self.stack.push(node);
    }

    fn leave(&mut self, node: usize, parent: Option<usize>) {
        if let Some(parent) = parent {
            self.low[parent] = self.low[parent].min(self.low[node]);
        }
        if self.low[node] == self.order[node] {
            while let Some(member) = self.stack.pop() {
                self.component[member] = node;
                if member == node {
                    break;
                }
            }
        }
    }
}
