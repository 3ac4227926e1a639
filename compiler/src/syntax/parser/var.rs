//! Variable sections and their declarations.
//! From: IEC 61131-3 §6.5 (language reference §3).

use super::cursor::Parser;
use super::literal::problem_diag;
use crate::syntax::ast::{
    Address, AddressSize, Edge, Init, Name, RelativeAddress, SectionKind, TypeRef, TypeRefKind, VarDecl, VarSection,
};
use crate::syntax::keyword::Kw;
use crate::syntax::lexer::Tok;
use crate::syntax::literal::address;
use takt_base::Span;
use takt_base::diag::{Code, Diag};

/// The section that a keyword opens; `None` for those that this version lacks.
fn section_kind(kw: Kw) -> Option<SectionKind> {
    Some(match kw {
        Kw::Var => SectionKind::Var,
        Kw::VarInput => SectionKind::Input,
        Kw::VarOutput => SectionKind::Output,
        Kw::VarInOut => SectionKind::InOut,
        Kw::VarTemp => SectionKind::Temp,
        Kw::VarStat => SectionKind::Stat,
        Kw::VarInst => SectionKind::Inst,
        Kw::VarExternal => SectionKind::External,
        Kw::VarGlobal => SectionKind::Global,
        _ => return None,
    })
}

impl Parser<'_> {
    /// True at a keyword that opens a section, known or not.
    pub(super) fn at_section(&self) -> bool {
        let kw = self.kw();
        kw.is_section() || matches!(kw, Kw::VarStat | Kw::VarInst) && self.nth(1).kind == Tok::Word
    }

    /// A section; its keyword is the current token. `None` if this version lacks it, and for VAR_ACCESS, whose paths are collected.
    pub(super) fn var_section(&mut self) -> Option<VarSection> {
        let start = self.here();
        let kw = self.kw();
        if kw == Kw::VarAccess {
            let paths = self.var_access();
            self.access_paths.extend(paths);
            return None;
        }
        let Some(kind) = section_kind(kw) else {
            self.unsupported_here(kw.text());
            self.skip_construct(kw, Kw::EndVar);
            return None;
        };
        if matches!(kind, SectionKind::Stat | SectionKind::Inst) {
            self.codesys_form(kw.text());
        }
        let qualified_only = self.tokens.qualified_only.binary_search(&self.pos).is_ok();
        self.bump();
        let mut section = VarSection {
            kind,
            constant: false,
            retain: None,
            access: None,
            persistent: false,
            qualified_only,
            decls: Vec::new(),
            span: start,
        };
        self.qualifiers(&mut section);
        section.span = self.since(start);
        self.decls(&mut section, start, kw);
        Some(section)
    }

    fn qualifiers(&mut self, section: &mut VarSection) {
        loop {
            match self.kw() {
                Kw::Retain | Kw::NonRetain if section.retain.is_some_and(|r| r != (self.kw() == Kw::Retain)) => {
                    let diag = self.expected_diag("one of RETAIN and NON_RETAIN").help("leave one of them out");
                    self.soft(diag);
                }
                Kw::Constant => section.constant = true,
                Kw::Retain => section.retain = Some(true),
                Kw::NonRetain => section.retain = Some(false),
                Kw::Persistent if self.nth(1).kind == Tok::Word => {
                    self.codesys_form("PERSISTENT");
                    section.persistent = true;
                }
                Kw::Public | Kw::Private | Kw::Protected | Kw::Internal => section.access = super::object::access(self.kw()),
                _ => return,
            }
            self.bump();
        }
    }

    /// Declarations and END_VAR.
    fn decls(&mut self, section: &mut VarSection, opener: Span, kw: Kw) {
        while !self.at_end() && self.kw() != Kw::EndVar {
            if self.at_section() || self.kw().ends_statements() || self.is_statement() {
                break;
            }
            let before = self.pos;
            if !self.eat(Tok::Semi) {
                section.decls.extend(self.var_decl());
            }
            if self.pos == before {
                self.bump();
            }
        }
        self.close_declaration(Kw::EndVar, opener, kw.text());
    }

    /// True if a statement stands here: END_VAR is missing. `x := 1;` counts only if no END_VAR follows.
    fn is_statement(&mut self) -> bool {
        let next = self.nth(1).kind;
        if self.kw().opens_statement() {
            return !matches!(next, Tok::Colon | Tok::Comma) && self.nth(1).kw != Kw::At;
        }
        if !self.at(Tok::Word) {
            return false;
        }
        matches!(next, Tok::Dot | Tok::LBracket | Tok::LParen) || next == Tok::Assign && !self.is_closed()
    }

    /// True if END_VAR is the next keyword of a section or declaration. Looks at every token once.
    fn is_closed(&mut self) -> bool {
        let (from, to) = self.section_ahead;
        if !(from..=to).contains(&self.pos) || to == 0 {
            let ends = |kw: Kw| kw.is_section() || kw.opens_declaration() || kw.ends_declaration() && kw != Kw::EndStruct;
            let ahead = self.tokens.list.iter().skip(self.pos).take_while(|t| !ends(t.kw)).count();
            self.section_ahead = (self.pos, self.pos + ahead);
        }
        self.tokens.list.get(self.section_ahead.1).is_some_and(|t| t.kw == Kw::EndVar)
    }

    /// A declaration with its `;`. On a mistake the parser has skipped to the next one.
    pub(super) fn var_decl(&mut self) -> Option<VarDecl> {
        let decl = self.var_decl_inner();
        if self.lost {
            self.skip_declaration();
        } else if decl.is_some() && !self.eat(Tok::Semi) {
            self.missing_semicolon("this declaration");
        }
        decl
    }

    fn var_decl_inner(&mut self) -> Option<VarDecl> {
        let start = self.here();
        let names = if self.kw() == Kw::At { Vec::new() } else { self.names()? };
        let has_at = self.eat_kw(Kw::At);
        let relative = if has_at { self.relative() } else { None };
        let at = if has_at && relative.is_none() { self.located()? } else { None };
        if !self.eat(Tok::Colon) {
            // The type in front, which has been reported as a name.
            self.lost |= names.len() == 1 && names.iter().all(|n| Kw::of(&n.text).is_type()) && self.at(Tok::Word);
            self.no_colon(&names);
            if self.lost {
                return None;
            }
        }
        let ty = self.type_ref();
        let edge = self.edge();
        let arguments = self.instance_arguments(&ty);
        let init = self.optional_init();
        if matches!(ty, TypeRef { kind: TypeRefKind::Error, .. }) && names.is_empty() {
            return None;
        }
        Some(VarDecl { names, at, relative, ty, edge, arguments, init, span: self.since(start) })
    }

    /// `(a := 1)`, `(1)` behind a type (vendor): arguments of FB_init, or initial values of the inputs of an instance;
    /// `[(a := 1), (a := 2)]` behind an array of them.
    fn instance_arguments(&mut self, ty: &TypeRef) -> Option<Init> {
        let wanted = match &ty.kind {
            TypeRefKind::Named(_) => self.at(Tok::LParen),
            TypeRefKind::Array { element, .. } if matches!(element.kind, TypeRefKind::Named(_)) => {
                self.at(Tok::LParen) || self.at(Tok::LBracket)
            }
            _ => false,
        };
        if !wanted {
            return None;
        }
        self.codesys_form("an instance with arguments");
        Some(self.arguments_of_instance())
    }

    fn names(&mut self) -> Option<Vec<Name>> {
        let mut names = vec![self.declared_name("the name of a variable")?];
        while self.eat(Tok::Comma) {
            names.push(self.declared_name("the name of a variable")?);
        }
        Some(names)
    }

    /// The address behind AT; the inner `None` stands for one that was reported.
    pub(super) fn located(&mut self) -> Option<Option<Address>> {
        if !self.at(Tok::Direct) {
            self.expected("a direct address such as %IX0.0");
            return None;
        }
        let token = self.peek();
        let span = self.span_of(token);
        let address = match address::direct(self.text_of(token), span) {
            Ok(address) => Some(address),
            Err(problem) => {
                self.soft(problem_diag(problem, span));
                None
            }
        };
        self.bump();
        Some(address)
    }

    /// `%B2`, `%X3.0` behind AT: a place in a structure.
    fn relative(&mut self) -> Option<RelativeAddress> {
        let token = self.peek();
        if token.kind != Tok::Direct {
            return None;
        }
        let (text, span) = (self.text_of(token), self.span_of(token));
        let (first, bit) = text.split_once('.').map_or((text, None), |(a, b)| (a, Some(b)));
        let (size, byte) = address::partial(first).ok()?;
        let bit = bit.map_or(Some(0), |b| address::bit(b).ok())?;
        if !matches!(size, AddressSize::Bit | AddressSize::Byte) || text.contains('.') != (size == AddressSize::Bit) {
            return None;
        }
        self.bump();
        Some(RelativeAddress { size, byte, bit, span })
    }

    /// A colon is missing behind the names; not lost afterwards if a type follows.
    fn no_colon(&mut self, names: &[Name]) {
        let name = names.first().map_or("x", |n| n.text.as_str());
        let diag = self.expected_diag("`:` and a type");
        let diag = match self.kind() {
            Tok::Assign => diag.help(format!("write {name} : INT := ...; or END_VAR above if this is a statement")),
            Tok::Word if names.len() == 1 && self.kw() == Kw::None => {
                diag.help(format!("the name comes first: {} : {name};", self.text_of(self.peek())))
            }
            _ if self.starts_type() && !self.at(Tok::LParen) => {
                let ty = self.text_of(self.peek());
                return self.soft(diag.help(format!("write {name} : {ty}"))); // and goes on as if it stood there
            }
            _ => diag.help(format!("write {name} : INT;")),
        };
        self.error(diag);
    }

    fn edge(&mut self) -> Option<Edge> {
        if self.eat_kw(Kw::REdge) {
            return Some(Edge::Rising);
        }
        self.eat_kw(Kw::FEdge).then_some(Edge::Falling)
    }

    /// Sections at the start of a unit.
    pub(super) fn sections(&mut self) -> Vec<VarSection> {
        let mut list = Vec::new();
        while self.at_section() {
            list.extend(self.var_section());
        }
        list
    }

    /// A section behind the first statement: reported, and understood.
    pub(super) fn late_section(&mut self, sections: &mut Vec<VarSection>) {
        let diag = Diag::new(Code::Expected, self.here(), "a declaration behind a statement");
        self.soft(diag.message("expected a statement").help("declare all variables before the first statement"));
        sections.extend(self.var_section());
    }
}
