//! P6002: a variable of a function or method, or a VAR_TEMP, that is read where no statement can have assigned it yet: it is its
//! default there. Variables with an initial value, or of a type with one, are fine; so is a sum that a loop builds from its default 0.

use super::walk::{Event, is_followed, walk};
use crate::hir::builder::Builder;
use crate::hir::constant;
use crate::hir::model::*;
use std::collections::HashSet;
use takt_base::index::Index;
use takt_base::{Code, Diag, Span};

/// What is known of a variable so far.
#[derive(Clone, Copy, PartialEq)]
enum Seen {
    /// Of no interest.
    Fine,
    Nothing,
    /// Read here, in the outermost loop of this number (0: in none).
    Read(Span, u32),
}

/// Looks through a body.
pub(super) fn check(builder: &Builder, id: PouId, pou: &Pou, out: &mut Vec<Diag>) {
    let mut seen = interesting(builder, id, pou);
    if seen.iter().all(|s| *s == Seen::Fine) || has_labels(&pou.body) {
        return;
    }
    let (mut depth, mut number) = (0u32, 0u32);
    walk(&pou.body, &mut |event| match event {
        Event::Loop => {
            number += u32::from(depth == 0);
            depth += 1;
        }
        Event::EndLoop => depth -= 1,
        Event::Read(p) if !is_followed(p) => {
            let here = if depth > 0 { number } else { 0 };
            if let Some(s) = own(p).and_then(|v| seen.get_mut(v)).filter(|s| **s == Seen::Nothing) {
                *s = Seen::Read(p.span, here);
            }
        }
        Event::Write(p, _) | Event::Lend(p) => {
            let Some(v) = own(p) else { return };
            match seen[v] {
                // Read before, in another round of the loop behind this.
                Seen::Read(_, at) if depth > 0 && at == number => seen[v] = Seen::Fine,
                Seen::Nothing => seen[v] = Seen::Fine,
                _ => {}
            }
        }
        _ => {}
    });
    for (var, s) in pou.vars.iter().zip(seen) {
        if let Seen::Read(span, _) = s {
            let label = format!("`{}` still has the default of its type here", var.name);
            let diag = Diag::new(Code::NotYetAssigned, span, label).also(var.span, "declared");
            out.push(diag.help("assign it first; if the default is meant, say so: `:= 0` in the declaration"));
        }
    }
}

/// The variables that start anew at each call and have no initial value.
fn interesting(builder: &Builder, id: PouId, pou: &Pou) -> Vec<Seen> {
    let given: HashSet<Span> =
        super::declarations(builder, id).filter(|(_, d, _)| d.init.is_some()).map(|(_, _, n)| n.span).collect();
    let anew = |v: &Var| match v.role {
        Role::Temp => true,
        Role::Local => pou.kind.is_called_by_value() && v.storage == Storage::Local,
        _ => false,
    };
    let wanted =
        |v: &Var| anew(v) && constant::is_zero(&v.init) && !given.contains(&v.span) && builder.hir.types.storage(v.ty).is_some();
    pou.vars.iter().map(|v| if wanted(v) { Seen::Nothing } else { Seen::Fine }).collect()
}

fn own(p: &Place) -> Option<usize> {
    if let Base::Var(v) = p.base { Some(v.index()) } else { None }
}

/// A jump may lead back to where a variable is read.
fn has_labels(body: &[Stmt]) -> bool {
    let mut found = false;
    walk(body, &mut |event| {
        if let Event::Statement(s) = event {
            found |= matches!(s.kind, StmtKind::Label(_));
        }
    });
    found
}
