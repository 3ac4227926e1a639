//! VAR_CONFIG and VAR_ACCESS of a configuration, and their instance paths.
//! From: IEC 61131-3 §6.8.2 (language reference §3.7, §3.8).

use super::cursor::Parser;
use super::literal::problem_diag;
use crate::syntax::ast::{AccessDecl, Address, ConfigDecl, InstancePath, PathPart};
use crate::syntax::keyword::Kw;
use crate::syntax::lexer::Tok;
use crate::syntax::literal::address;

impl Parser<'_> {
    /// VAR_CONFIG ... END_VAR; the keyword is the current token.
    pub(super) fn var_config(&mut self) -> Vec<ConfigDecl> {
        self.entries("VAR_CONFIG", Self::config_decl)
    }

    /// VAR_ACCESS ... END_VAR; the keyword is the current token.
    pub(super) fn var_access(&mut self) -> Vec<AccessDecl> {
        self.entries("VAR_ACCESS", Self::access_decl)
    }

    fn entries<T>(&mut self, section: &str, one: fn(&mut Self) -> Option<T>) -> Vec<T> {
        let opener = self.here();
        self.bump();
        let mut list = Vec::new();
        while !self.at_end() && self.kw() != Kw::EndVar && !self.kw().ends_statements() {
            let before = self.pos;
            if !self.eat(Tok::Semi) {
                list.extend(self.entry(one));
            }
            if self.pos == before {
                self.bump();
            }
        }
        self.close_declaration(Kw::EndVar, opener, section);
        list
    }

    fn entry<T>(&mut self, one: fn(&mut Self) -> Option<T>) -> Option<T> {
        let entry = one(self);
        if self.lost {
            self.skip_declaration();
        } else if entry.is_some() && !self.eat(Tok::Semi) {
            self.missing_semicolon("this declaration");
        }
        entry
    }

    fn config_decl(&mut self) -> Option<ConfigDecl> {
        let path = self.instance_path()?;
        let at = if self.eat_kw(Kw::At) { self.located()? } else { None };
        if !self.colon("the type of the variable") {
            return None;
        }
        let ty = self.type_ref();
        let init = self.optional_init();
        Some(ConfigDecl { path, at, ty, init })
    }

    fn access_decl(&mut self) -> Option<AccessDecl> {
        let name = self.declared_name("the name of the access path")?;
        if !self.colon("the path of the variable") {
            return None;
        }
        let path = self.instance_path()?;
        if !self.colon("the type of the variable") {
            return None;
        }
        let ty = self.type_ref();
        let writable = self.eat_kw(Kw::ReadWrite);
        if !writable {
            self.eat_kw(Kw::ReadOnly);
        }
        Some(AccessDecl { name, path, ty, writable })
    }

    /// `Res.Prog.block[2].x`, `Res.%IX1.1`, `%IX1.1`.
    fn instance_path(&mut self) -> Option<InstancePath> {
        let start = self.here();
        let mut parts = vec![self.path_part()?];
        loop {
            if self.at(Tok::LBracket) {
                parts.push(self.path_index()?);
            } else if self.eat(Tok::Dot) {
                parts.push(self.path_part()?);
            } else {
                return Some(InstancePath { parts, span: self.since(start) });
            }
        }
    }

    fn path_part(&mut self) -> Option<PathPart> {
        if self.at(Tok::Direct) {
            return self.path_address().map(PathPart::Direct);
        }
        self.declared_name("the path of a variable, for example Res.Prog.x").map(PathPart::Name)
    }

    fn path_address(&mut self) -> Option<Address> {
        let token = self.peek();
        let span = self.span_of(token);
        let address = address::direct(self.text_of(token), span);
        self.bump();
        address.map_err(|problem| self.soft(problem_diag(problem, span))).ok()
    }

    fn path_index(&mut self) -> Option<PathPart> {
        let open = self.here();
        self.bump();
        let list = self.exprs();
        self.closing(Tok::RBracket, "]", open);
        (!self.lost).then(|| PathPart::Index(list, self.since(open)))
    }
}
