//! A file and its units.
//! From: IEC 61131-3 §6.6 (language reference §3.9, §4).

use super::cursor::Parser;
use crate::syntax::ast::{File, Item, Name, Pou, PouKind, Stmt, TypeRef, VarSection};
use crate::syntax::keyword::Kw;
use crate::syntax::lexer::Tok;
use takt_base::diag::{Code, Diag};
use takt_base::{Profile, Span};

impl Parser<'_> {
    /// The whole file.
    pub(super) fn file(mut self) -> File {
        let mut items = Vec::new();
        while !self.at_end() {
            let before = self.pos;
            items.extend(self.item());
            if self.pos == before {
                self.bump();
            }
        }
        self.misplaced_tests();
        File { items }
    }

    fn item(&mut self) -> Option<Item> {
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
            Kw::VarGlobal => self.var_section().map(Item::Globals),
            Kw::Configuration => Some(Item::Configuration(self.configuration())),
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
        self.error(diag.help("a file holds PROGRAM, FUNCTION_BLOCK, FUNCTION, TYPE, VAR_GLOBAL and CONFIGURATION"));
        self.bump();
        self.skip_to_item();
    }

    fn pou(&mut self, kind: PouKind, end: Kw) -> Pou {
        let first = self.pos;
        let external = self.tokens.external.binary_search(&self.pos).is_ok();
        let test = self.test_pragma(kind);
        let opener = self.here();
        let opener_name = self.bump().kw.text();
        let name = self.pou_head();
        let result = self.result_type();
        self.heritage();
        self.eat(Tok::Semi);
        let mut sections = self.sections();
        let body = self.pou_body(&mut sections);
        self.close_pou(end, opener, opener_name);
        let name = name.unwrap_or(Name { text: String::new(), span: opener.end_point() });
        let inside = |at: &&(usize, Span)| (first..=self.pos).contains(&at.0);
        let inline_c = self.tokens.inline_c.iter().find(inside).map(|c| c.1);
        let result = result.filter(|_| kind == PouKind::Function);
        Pou { kind, name, result, sections, body, external, inline_c, test, span: self.since(opener) }
    }

    /// The name, and what stands around it that this version lacks.
    fn pou_head(&mut self) -> Option<Name> {
        while matches!(self.kw(), Kw::Final | Kw::Abstract | Kw::Public | Kw::Private | Kw::Protected | Kw::Internal) {
            let what = self.kw().text();
            self.unsupported_here(what);
            self.bump();
        }
        let name = self.declared_name("the name of the unit");
        self.heritage();
        if self.lost {
            self.skip_head();
        }
        name
    }

    /// EXTENDS, IMPLEMENTS and USING with their names.
    fn heritage(&mut self) {
        while matches!(self.kw(), Kw::Extends | Kw::Implements | Kw::Using) {
            let what = self.kw().text();
            self.unsupported_here(what);
            self.bump();
            while self.at(Tok::Word) && !self.kw().is_reserved() && matches!(self.nth(1).kind, Tok::Comma | Tok::Dot) {
                self.bump();
                self.bump();
            }
            if self.at(Tok::Word) && !self.kw().is_reserved() {
                self.bump();
            }
            self.eat(Tok::Semi);
        }
    }

    /// `: INT` behind the name; `: VOID` is no result.
    fn result_type(&mut self) -> Option<TypeRef> {
        if !self.eat(Tok::Colon) {
            return None;
        }
        if self.eat_kw(Kw::Void) {
            return None;
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

    /// Statements up to the end of the unit.
    fn pou_body(&mut self, sections: &mut Vec<VarSection>) -> Vec<Stmt> {
        let mut body = Vec::new();
        loop {
            if self.unsupported_body() {
                continue;
            }
            body.append(&mut self.body_statements());
            if self.at_section() && self.kw() != Kw::VarGlobal {
                self.late_section(sections);
            } else if !self.unsupported_body() {
                return body;
            }
        }
    }

    fn close_pou(&mut self, end: Kw, opener: Span, opener_name: &str) {
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
