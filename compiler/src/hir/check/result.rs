//! A function that never assigns its result returns the default value of the type (§11): most likely a mistake.

use crate::hir::builder::Builder;
use crate::hir::model::PouId;
use takt_base::{Code, Diag};

impl Builder<'_> {
    /// Runs when the body of the current unit is done.
    pub fn check_result_written(&mut self, id: PouId) {
        let pou = &self.hir.pous[id];
        let Some(result) = pou.result.filter(|_| !pou.external && !self.scope.result_written) else { return };
        let var = &pou.vars[result];
        if ["FB_INIT", "FB_REINIT", "FB_EXIT"].iter().any(|n| var.name.eq_ignore_ascii_case(n)) {
            return; // nobody looks at it
        }
        let label = format!("`{}` is not assigned", var.name);
        let help = format!("write `{} := ...;` before the end", var.name);
        let diag = Diag::new(Code::ResultNeverAssigned, var.span, label).help(help);
        self.report(diag);
    }
}
