//! ACTION as a part of a unit: `ACTION name: body END_ACTION` in the unit, behind it, or in ACTIONS ... END_ACTIONS.
//! From: language reference §4.5, §17. An action is a method without variables of its own.

use super::cursor::Parser;
use crate::syntax::ast::{Name, Objects, Pou, PouKind};
use crate::syntax::keyword::Kw;
use crate::syntax::lexer::Tok;
use takt_base::diag::{Code, Diag};

impl Parser<'_> {
    /// True at ACTION or ACTIONS with something behind it.
    pub(super) fn starts_action(&self) -> bool {
        let next = self.nth(1);
        matches!(self.kw(), Kw::Action | Kw::Actions) && next.kind == Tok::Word
    }

    /// One action, or all of a list, if they stand here.
    pub(super) fn actions_of_unit(&mut self, kind: PouKind, unit: Option<&Name>, objects: &mut Objects) -> bool {
        if !self.starts_action() {
            return false;
        }
        if !matches!(kind, PouKind::Program | PouKind::FunctionBlock) {
            let diag = Diag::new(Code::Expected, self.here(), "an action here").message("expected a statement");
            self.soft(diag.help("actions belong to programs and function blocks"));
        }
        if self.kw() == Kw::Action {
            let action = self.action();
            objects.methods.push(action);
            return true;
        }
        self.codesys_form("ACTIONS");
        let opener = self.here();
        self.bump();
        self.list_name(unit);
        while self.kw() == Kw::Action && self.nth(1).kind == Tok::Word {
            let action = self.action();
            objects.methods.push(action);
        }
        self.close_member(Kw::EndActions, opener, "ACTIONS");
        true
    }

    /// Actions behind the END of their unit (vendor).
    pub(super) fn actions_behind(&mut self, kind: PouKind, unit: Option<&Name>, objects: &mut Objects) {
        let has_some = matches!(kind, PouKind::Program | PouKind::FunctionBlock);
        while has_some && self.starts_action() {
            if self.kw() == Kw::Action {
                self.codesys_form("an action behind its unit");
            }
            self.actions_of_unit(kind, unit, objects);
            self.found_place();
            self.unwinding = false;
        }
    }

    /// `ACTIONS name`: the unit may be named again.
    fn list_name(&mut self, unit: Option<&Name>) {
        if self.kw() == Kw::Action || self.kw() == Kw::EndActions || !self.at(Tok::Word) {
            return;
        }
        let diag = self.expected_diag("the name of the unit in front");
        let name = self.name();
        if let Some(unit) = unit.filter(|u| !u.is(&name.text)) {
            self.soft(diag.also(unit.span, "this one"));
        }
    }

    fn action(&mut self) -> Pou {
        let opener = self.here();
        self.bump();
        let name = self.declared_name("the name of the action");
        if !self.lost && !self.eat(Tok::Colon) && !self.profile.is_codesys() {
            let diag = self.expected_diag("`:` behind the name of the action");
            self.soft(diag);
        }
        if self.lost {
            self.skip_head();
        }
        let body = self.body_statements();
        self.close_member(Kw::EndAction, opener, "ACTION");
        let name = name.unwrap_or(Name { text: String::new(), span: opener.end_point() });
        let objects = Objects { action: true, ..Objects::default() };
        let (kind, span, sections, paths) = (PouKind::Method, self.since(opener), Vec::new(), Vec::new());
        Pou { kind, name, result: None, sections, paths, body, objects, external: false, inline_c: None, test: None, span }
    }
}
