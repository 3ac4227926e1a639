//! Labels and jumps of ST (vendor, language reference §5.1). A jump leads to a label of its own list of statements or of one around it,
//! never into a statement.

use super::builder::Builder;
use super::model::{LabelId, StmtKind};
use crate::syntax::ast::{self, Name};
use std::collections::HashMap;
use takt_base::{Code, Diag, Span};

/// Labels of the unit that is being worked on.
#[derive(Default, Clone)]
pub(super) struct Labels {
    next: u32,
    /// Every label, for duplicates and for jumps that can't reach one.
    all: HashMap<String, Span>,
    /// Labels of the lists around the current statement.
    visible: Vec<HashMap<String, LabelId>>,
}

impl Labels {
    /// A new label.
    pub fn fresh(&mut self) -> LabelId {
        self.next += 1;
        LabelId(self.next - 1)
    }
}

impl Builder<'_> {
    /// Makes the labels of a list visible; false if it has none. Pairs with [`Self::close_labels`] if it gives true.
    pub(super) fn open_labels(&mut self, list: &[ast::Stmt]) -> bool {
        let mut own = HashMap::new();
        for name in list.iter().filter_map(|s| if let ast::StmtKind::Label(name) = &s.kind { Some(name) } else { None }) {
            if self.declare_label(name) {
                own.insert(name.key(), self.scope.labels.fresh());
            }
        }
        let any = !own.is_empty();
        if any {
            self.scope.labels.visible.push(own);
        }
        any
    }

    pub(super) fn close_labels(&mut self) {
        self.scope.labels.visible.pop();
    }

    /// Notes a label; false and a report if the body has it already.
    pub(super) fn declare_label(&mut self, name: &Name) -> bool {
        if let Some(&first) = self.scope.labels.all.get(&name.key()) {
            self.report(Diag::new(Code::DuplicateLabel, name.span, "stands here again").also(first, "the first one"));
            return false;
        }
        self.scope.labels.all.insert(name.key(), name.span);
        true
    }

    /// `name:`; nothing for a second one of the name, which has been reported.
    pub(super) fn label_statement(&mut self, name: &Name) -> Option<StmtKind> {
        let first = self.scope.labels.all.get(&name.key()) == Some(&name.span);
        let id = self.scope.labels.visible.last().and_then(|own| own.get(&name.key()).copied());
        id.filter(|_| first).map(StmtKind::Label)
    }

    /// `JMP name;`
    pub(super) fn jump_statement(&mut self, name: &Name) -> Option<StmtKind> {
        let found = self.scope.labels.visible.iter().rev().find_map(|own| own.get(&name.key()).copied());
        if found.is_none() {
            let inside = self.scope.labels.all.get(&name.key()).copied();
            self.unknown_label(name, inside);
        }
        found.map(StmtKind::Jump)
    }

    /// Reports a jump to nowhere; `inside`: a label of this name that can't be reached.
    pub(super) fn unknown_label(&mut self, name: &Name, inside: Option<Span>) {
        let diag = Diag::new(Code::UnknownLabel, name.span, "no such label here");
        if let Some(at) = inside {
            let help = "a jump leads to a label beside it or around it, never into a statement";
            return self.report(diag.also(at, "stands inside of another statement").help(help));
        }
        let mut known: Vec<&String> = self.scope.labels.all.keys().collect();
        known.sort();
        let near = takt_base::nearest(&name.key(), known.into_iter().map(String::as_str)).map(str::to_owned);
        self.report(match near {
            Some(near) => diag.help(format!("did you mean `{near}`?")),
            None => diag.help(format!("write `{}:` where it shall go on", name.text)),
        });
    }
}
