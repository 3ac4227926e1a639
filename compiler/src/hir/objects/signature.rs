//! Two methods of one name must look alike: the same parameters in the same order, the same result.

use crate::hir::builder::Builder;
use crate::hir::model::*;
use takt_base::{Code, Diag};

impl Builder<'_> {
    /// Reports how a method differs from the one that it stands for.
    pub(super) fn compare_signatures(&mut self, new: PouId, old: PouId) {
        for id in [new, old] {
            let span = self.symbols.pous[id].decl.name.span;
            self.ensure_pou(id, span);
        }
        let Some((span, label)) = self.difference(new, old) else { return };
        let at = self.symbols.pous[old].decl.name.span;
        let note = format!("`{}` is declared", self.hir.pous[old].name);
        let help = "repeat the parameters and the result exactly";
        self.report(Diag::new(Code::SignatureMismatch, span, label).also(at, note).help(help));
    }

    fn difference(&self, new: PouId, old: PouId) -> Option<(takt_base::Span, String)> {
        let at = self.symbols.pous[new].decl.name.span;
        let (a, b) = (&self.hir.pous[new], &self.hir.pous[old]);
        let result = |p: &Pou| p.result.map(|r| p.vars[r].ty);
        let differ = |x, y| x != y && x != self.error && y != self.error;
        match (result(a), result(b)) {
            (Some(x), Some(y)) if differ(x, y) => {
                return Some((at, format!("gives {}, there {}", self.show(x), self.show(y))));
            }
            (Some(x), None) => return Some((at, format!("gives {}, there nothing", self.show(x)))),
            (None, Some(y)) => return Some((at, format!("gives nothing, there {}", self.show(y)))),
            _ => {}
        }
        for (x, y) in a.params.iter().map(|v| &a.vars[*v]).zip(b.params.iter().map(|v| &b.vars[*v])) {
            if !x.name.eq_ignore_ascii_case(&y.name) {
                return Some((x.span, format!("`{}`, there `{}`", x.name, y.name)));
            }
            if x.role != y.role {
                return Some((x.span, format!("{}, there {}", section(x.role), section(y.role))));
            }
            if differ(x.ty, y.ty) {
                return Some((x.span, format!("{}, there {}", self.show(x.ty), self.show(y.ty))));
            }
        }
        let (x, y) = (a.params.len(), b.params.len());
        (x != y).then(|| (at, format!("{x} parameters, there {y}")))
    }
}

fn section(role: Role) -> &'static str {
    match role {
        Role::Output => "VAR_OUTPUT",
        Role::InOut => "VAR_IN_OUT",
        _ => "VAR_INPUT",
    }
}
