//! A file and its units.
//! From: IEC 61131-3 §6.6 (language reference §3.9, §4).

use super::cursor::Parser;
use crate::syntax::ast::{File, Item, Name, Objects, Pou, PouKind, Stmt, TypeRef, TypeRefKind, VarSection};
use crate::syntax::keyword::Kw;
use crate::syntax::lexer::Tok;
use takt_base::diag::{Code, Diag};
use takt_base::{Profile, Span};

impl Parser<'_> {
    /// The whole file.
    pub(super) fn file(mut self) -> File {
        let mut items = Vec::new();
        self.mend_keywords();
        while !self.at_end() {
            let before = self.pos;
            items.extend(self.item());
            if self.pos == before {
                self.bump();
            }
        }
        self.misplaced_tests();
        File { items, silenced: std::mem::take(&mut self.tokens.silenced) }
    }

    pub(super) fn item(&mut self) -> Option<Item> {
        self.found_place();
        self.unwinding = false;
        self.open.clear();
        if self.eat(Tok::Semi) {
            return None;
        }
        match self.kw() {
            Kw::Type => Some(Item::Types(self.type_section())),
            Kw::Function => Some(Item::Pou(self.pou(PouKind::Function, Kw::EndFunction))),
            Kw::FunctionBlock => Some(Item::Pou(self.pou(PouKind::FunctionBlock, Kw::EndFunctionBlock))),
            Kw::Functionblock => {
                if self.profile != Profile::Codesys2 {
                    self.misspelt_keyword(Kw::FunctionBlock);
                }
                Some(Item::Pou(self.pou(PouKind::FunctionBlock, Kw::EndFunctionBlock)))
            }
            Kw::Program => Some(Item::Pou(self.pou(PouKind::Program, Kw::EndProgram))),
            Kw::Class => Some(Item::Pou(self.pou(PouKind::Class, Kw::EndClass))),
            Kw::Interface => Some(Item::Pou(self.pou(PouKind::Interface, Kw::EndInterface))),
            Kw::VarGlobal => self.var_section().map(Item::Globals),
            Kw::Configuration => Some(Item::Configuration(self.configuration())),
            Kw::Namespace => self.namespace(),
            Kw::Using => Some(Item::Using(self.using())),
            _ => {
                self.no_item();
                None
            }
        }
    }

    fn no_item(&mut self) {
        if self.unsupported_item() {
            return;
        }
        let diag = self.expected_diag("a declaration");
        self.error(diag.help(
            "a file holds PROGRAM, FUNCTION_BLOCK, FUNCTION, CLASS, INTERFACE, TYPE, NAMESPACE, VAR_GLOBAL and CONFIGURATION",
        ));
        self.bump();
        self.skip_to_item();
    }

    fn pou(&mut self, kind: PouKind, end: Kw) -> Pou {
        let first = self.pos;
        let external = self.tokens.external.binary_search(&self.pos).is_ok();
        let test = self.test_pragma(kind);
        let opener = self.here();
        let opener_name = self.bump().kw.text();
        let mut objects = Objects { modifiers: self.modifiers(), ..Objects::default() };
        let name = self.pou_head(&mut objects);
        let result = self.result_type();
        self.heritage(&mut objects);
        self.eat(Tok::Semi);
        let mut sections = self.sections();
        let body = self.pou_body(kind, name.as_ref(), &mut sections, &mut objects);
        self.close_pou(end, opener, opener_name);
        self.actions_behind(kind, name.as_ref(), &mut objects);
        let name = name.unwrap_or(Name { text: String::new(), span: opener.end_point() });
        let inside = |at: &&(usize, Span)| (first..=self.pos).contains(&at.0);
        let inline_c = self.tokens.inline_c.iter().find(inside).map(|c| c.1);
        let result = result.filter(|_| kind == PouKind::Function);
        let paths = std::mem::take(&mut self.access_paths);
        Pou { kind, name, result, sections, paths, body, objects, external, inline_c, test, span: self.since(opener) }
    }

    fn pou_head(&mut self, objects: &mut Objects) -> Option<Name> {
        if self.starts_member() {
            let diag = self.expected_diag("the name of the unit");
            self.soft(diag);
            return None;
        }
        let name = self.declared_name("the name of the unit");
        self.heritage(objects);
        if self.lost {
            self.skip_head();
        }
        name
    }

    /// `: INT` behind the name; `: VOID` is no result.
    pub(super) fn result_type(&mut self) -> Option<TypeRef> {
        if !self.eat(Tok::Colon) {
            return None;
        }
        if self.eat_kw(Kw::Void) {
            return None;
        }
        if self.is_first_on_line() && self.nth(1).kind == Tok::Assign {
            let diag = self.missing_diag("the type of the result");
            self.soft(diag.help("write for example : INT"));
            return Some(TypeRef { kind: TypeRefKind::Error, span: self.here() });
        }
        let ty = self.type_ref();
        if self.lost {
            self.skip_head();
        }
        Some(ty)
    }

    /// The statements of a unit, a method or an action: ST, or one statement with all instructions.
    pub(super) fn body_statements(&mut self) -> Vec<Stmt> {
        match self.instruction_list() {
            Some(list) => vec![list],
            None => self.statements(false),
        }
    }

    /// Statements up to the end of the unit, with its methods before, between and behind them.
    fn pou_body(
        &mut self,
        kind: PouKind,
        unit: Option<&Name>,
        sections: &mut Vec<VarSection>,
        objects: &mut Objects,
    ) -> Vec<Stmt> {
        let mut body = Vec::new();
        loop {
            if self.member_of_unit(kind, objects) || self.actions_of_unit(kind, unit, objects) || self.unsupported_body() {
                continue;
            }
            body.append(&mut self.body_statements());
            if self.at_section() && self.kw() != Kw::VarGlobal {
                if body.is_empty() && !objects.methods.is_empty() {
                    sections.append(&mut self.sections());
                } else {
                    self.late_section(sections);
                }
            } else if !self.starts_member() && !self.starts_action() && !self.unsupported_body() {
                return body;
            }
        }
    }

    pub(super) fn close_pou(&mut self, end: Kw, opener: Span, opener_name: &str) {
        if self.eat_kw(end) {
            self.eat(Tok::Semi);
            return;
        }
        let found = self.kw();
        let silent = self.unwinding && !found.ends_declaration();
        if !silent {
            let diag = Diag::new(Code::Expected, self.here(), self.describe(self.peek()));
            let diag = diag.message(format!("expected {}", end.text()));
            self.soft(diag.also(opener, format!("the {opener_name} is opened here")));
        }
        if found.ends_declaration() {
            self.bump();
            self.eat(Tok::Semi);
        }
    }
}
