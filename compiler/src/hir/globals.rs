//! Lists of global variables (vendor, §3.5): a VAR_GLOBAL section of a file is the list of the file's name, `GVL.x` is a variable of it.
//! What several lists declare, or one with `{attribute 'qualified_only'}`, needs the name of the list.

use super::builder::Builder;
use super::model::*;
use crate::syntax::ast;
use takt_base::{Code, Diag, Span};

impl Builder<'_> {
    /// The name of the list that a section of this file belongs to.
    pub(super) fn list_name(&self, span: Span) -> Option<String> {
        let source = self.sources.get(span.source);
        let file = source.name.rsplit(['/', '\\']).next().unwrap_or_default();
        let stem = file.split('.').next().unwrap_or_default();
        (source.profile.is_codesys() && !stem.is_empty()).then(|| stem.to_owned())
    }

    /// Enters a global under its own name and that of its list.
    pub(super) fn enter_global(&mut self, id: GlobalId, name: &ast::Name, list: Option<&str>, qualified_only: bool) {
        let full = self.full_name(name);
        let Some(list) = list else { return self.enter_key(id, full.key(), name) };
        let qualified = format!("{list}.{}", full.text);
        self.symbols.spaces.add_head(list.to_ascii_uppercase());
        self.enter_key(id, qualified.to_ascii_uppercase(), name);
        match self.symbols.globals.get(&full.key()).copied() {
            _ if qualified_only => self.hir.globals[id].name = qualified,
            None => self.enter_key(id, full.key(), name),
            Some(_) => {
                self.symbols.shared_globals.entry(full.key()).or_insert(id);
                self.hir.globals[id].name = qualified;
            }
        }
    }

    fn enter_key(&mut self, id: GlobalId, key: String, name: &ast::Name) {
        let first = *self.symbols.globals.entry(key).or_insert(id);
        if first != id {
            let span = self.hir.globals[first].span;
            self.report(Diag::new(Code::DuplicateName, name.span, "declared again").also(span, "first declared"));
        }
    }

    /// Reports a name that several lists declare.
    pub(super) fn check_global_use(&mut self, name: &ast::Name, id: GlobalId) {
        let key = name.key();
        let Some(&other) = self.symbols.shared_globals.get(key.trim_start_matches('.')) else { return };
        let places = [self.hir.globals[id].span, self.hir.globals[other].span];
        let help = format!("write which one is meant, for example {}", self.hir.globals[other].name);
        let diag = Diag::new(Code::AmbiguousName, name.span, "found in more than one list");
        self.report(diag.also(places[0], "one").also(places[1], "another").help(help));
    }

    /// Reports a global that needs the name of its list; false if there is none of this name.
    pub(super) fn needs_list(&mut self, name: &ast::Name) -> bool {
        let last = |g: &Global| g.name.rsplit_once('.').is_some_and(|(_, last)| name.is(last));
        let Some(global) = self.hir.globals.iter().find(|g| last(g)) else { return false };
        let help = format!("write {}", global.name);
        let diag = Diag::new(Code::QualifiedOnly, name.span, "needs the name in front of it").also(global.span, "declared");
        self.report(diag.help(help));
        true
    }
}
