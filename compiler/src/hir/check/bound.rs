//! An interface variable that is called but never assigned stays NULL (§4.4): most likely a mistake.

use crate::hir::builder::Builder;
use crate::hir::model::*;
use takt_base::{Code, Diag};

/// Reports the interface variables of programs, functions and methods: nobody but the unit itself can assign them.
pub(super) fn check(builder: &mut Builder) {
    for (id, v, span) in std::mem::take(&mut builder.objects.called) {
        let pou = &builder.hir.pous[id];
        let has_methods = builder.objects.own.contains_key(&id);
        let private = matches!(pou.kind, PouKind::Program | PouKind::Function | PouKind::Method) && !has_methods;
        let own = matches!(pou.vars[v].role, Role::Local | Role::Temp);
        if private && own && builder.objects.written.insert((id, v)) {
            let diag = Diag::new(Code::NotBound, span, "always NULL").also(pou.vars[v].span, "declared");
            builder.report(diag.help("assign an instance before the call"));
        }
    }
}
