//! Actions (§4.5): methods without variables of their own, which use those of their unit: VAR_TEMP and VAR_IN_OUT too.

use crate::hir::builder::Builder;
use crate::hir::model::*;
use crate::hir::scope::Local;
use crate::syntax::ast;
use takt_base::{Code, Diag, Span};

impl Builder<'_> {
    /// True for a method that was written as ACTION.
    pub(in crate::hir) fn is_action(&self, id: PouId) -> bool {
        self.hir.pous[id].kind == PouKind::Method && self.symbols.pous[id].decl.objects.action
    }

    /// Makes a VAR_IN_OUT of the unit known to one of its actions: both find what it is bound to in the instance.
    pub(super) fn borrow_in_out(&mut self, id: PouId, owner: PouId, name: &str, v: VarId) {
        let var = self.hir.pous[owner].vars[v].clone();
        let span = var.span;
        let own = self.hir.pous[id].vars.push(var);
        self.scope.names.insert(name.to_owned(), (Local::Var(own), span));
        for unit in self.line(owner) {
            self.hir.pous[unit].unbinds = true;
        }
    }

    /// Reports an input with an edge, which only the body itself sees.
    pub(super) fn edge_in_action(&mut self, var: VarId, at: Span) -> bool {
        let Some(owner) = self.scope.pou.filter(|id| self.is_action(*id)).and_then(|id| self.hir.pous[id].owner) else {
            return false;
        };
        let var = &self.hir.pous[owner].vars[var];
        if var.edge.is_none() {
            return false;
        }
        let declared = var.span;
        let diag = Diag::new(Code::NotSupportedYet, at, "an input with an edge").also(declared, "declared");
        let diag = diag.message("R_EDGE and F_EDGE inputs can't be used in an action: only the body sees the edge");
        self.report(diag.help("assign it to a variable in the body, and use that"));
        true
    }
}

/// True if the unit has actions.
pub(in crate::hir) fn has_actions(decl: &ast::Pou) -> bool {
    decl.objects.methods.iter().any(|m| m.objects.action)
}
