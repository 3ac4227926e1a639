//! Methods, properties, and the words in front of and behind the names of types.
//! From: IEC 61131-3 §6.6.5 to §6.6.7 (language reference §4.2 to §4.4).

use super::cursor::Parser;
use crate::syntax::ast::*;
use crate::syntax::keyword::Kw;
use crate::syntax::lexer::Tok;
use takt_base::Span;
use takt_base::diag::{Code, Diag};

/// The access that a keyword gives.
pub(super) fn access(kw: Kw) -> Option<AccessSpec> {
    Some(match kw {
        Kw::Public => AccessSpec::Public,
        Kw::Protected => AccessSpec::Protected,
        Kw::Private => AccessSpec::Private,
        Kw::Internal => AccessSpec::Internal,
        _ => return None,
    })
}

impl Parser<'_> {
    /// PUBLIC, ABSTRACT and the like, in any order.
    pub(super) fn modifiers(&mut self) -> Modifiers {
        let mut found = Modifiers::default();
        loop {
            let (kw, span) = (self.kw(), self.here());
            match kw {
                Kw::Abstract => found.is_abstract = Some(span),
                Kw::Final => found.is_final = Some(span),
                Kw::Override => found.is_override = Some(span),
                _ => match access(kw) {
                    Some(access) => found.access = Some((access, span)),
                    None => return found,
                },
            }
            self.bump();
        }
    }

    /// EXTENDS, IMPLEMENTS and USING with their names.
    pub(super) fn heritage(&mut self, objects: &mut Objects) {
        loop {
            match self.kw() {
                Kw::Extends => {
                    self.bump();
                    self.type_names(&mut objects.extends);
                }
                Kw::Implements => {
                    self.bump();
                    self.type_names(&mut objects.implements);
                }
                Kw::Using => objects.usings.append(&mut self.using()),
                _ => return,
            }
        }
    }

    pub(super) fn type_names(&mut self, list: &mut Vec<Name>) {
        loop {
            if !self.at(Tok::Word) || self.kw().is_reserved() {
                return self.expected("the name of a type");
            }
            let name = self.name();
            list.push(self.qualified(name));
            if !self.eat(Tok::Comma) {
                return;
            }
        }
    }

    /// True at a method or property of a unit.
    pub(super) fn starts_member(&self) -> bool {
        let named = self.nth(1).kind == Tok::Word;
        named && matches!(self.kw(), Kw::Method | Kw::Property | Kw::PropertyGet | Kw::PropertySet)
    }

    /// A method or property, if one stands here.
    pub(super) fn member_of_unit(&mut self, kind: PouKind, objects: &mut Objects) -> bool {
        if !self.starts_member() {
            return false;
        }
        if kind == PouKind::Function {
            let diag = Diag::new(Code::Expected, self.here(), "a function has no methods");
            self.soft(diag.message("expected a statement").help("methods belong to function blocks, classes and programs"));
        }
        match self.kw() {
            Kw::Method => {
                let method = self.method(kind);
                objects.methods.push(method);
            }
            Kw::Property => self.property(kind, objects),
            kw => {
                let accessor = if kw == Kw::PropertyGet { Accessor::Get } else { Accessor::Set };
                let opener = self.here();
                let head = self.property_head();
                let pou = self.accessor(kind, accessor, &head, opener, Kw::EndProperty, kw.text());
                objects.methods.push(pou);
            }
        }
        true
    }

    fn method(&mut self, owner: PouKind) -> Pou {
        let opener = self.here();
        self.bump();
        let modifiers = self.modifiers();
        let name = self.declared_name("the name of the method");
        if self.lost {
            self.skip_head();
        }
        let result = self.result_type();
        self.eat(Tok::Semi);
        let (sections, body) = self.method_body(owner);
        self.close_member(Kw::EndMethod, opener, "METHOD");
        let name = name.unwrap_or(Name { text: String::new(), span: opener.end_point() });
        let objects = Objects { modifiers, ..Objects::default() };
        Pou {
            kind: PouKind::Method,
            name,
            result,
            sections,
            paths: Vec::new(),
            body,
            objects,
            external: false,
            inline_c: None,
            test: None,
            span: self.since(opener),
        }
    }

    fn method_body(&mut self, owner: PouKind) -> (Vec<VarSection>, Vec<Stmt>) {
        let mut sections = self.sections();
        let first = self.here();
        let mut body = self.body_statements();
        while self.at_section() && self.kw() != Kw::VarGlobal {
            self.late_section(&mut sections);
            body.append(&mut self.body_statements());
        }
        if owner == PouKind::Interface && !body.is_empty() {
            let diag = Diag::new(Code::Expected, first, "a statement in an interface").message("expected END_METHOD");
            self.soft(diag.help("an interface lists methods; types that implement it have their bodies"));
            body.clear();
        }
        (sections, body)
    }

    /// The end of a method or accessor; another keyword is left for those who want it.
    pub(super) fn close_member(&mut self, want: Kw, opener: Span, opener_name: &str) {
        if matches!(self.kw(), Kw::EndVar) || !self.kw().ends_declaration() || self.kw() == want {
            return self.close_pou(want, opener, opener_name);
        }
        let diag = Diag::new(Code::Expected, self.here(), self.describe(self.peek()));
        let diag = diag.message(format!("expected {}", want.text()));
        self.soft(diag.also(opener, format!("the {opener_name} is opened here")));
    }

    /// `PROPERTY access name : type`.
    fn property_head(&mut self) -> Head {
        self.bump();
        let modifiers = self.modifiers();
        let name = self.declared_name("the name of the property");
        let name = name.unwrap_or(Name { text: String::new(), span: self.here() });
        let ty = if !self.lost && self.colon("the type of the property") {
            self.type_ref()
        } else {
            TypeRef { kind: TypeRefKind::Error, span: name.span }
        };
        if self.lost {
            self.skip_head();
        }
        self.eat(Tok::Semi);
        Head { modifiers, name, ty }
    }

    fn property(&mut self, kind: PouKind, objects: &mut Objects) {
        let opener = self.here();
        let head = self.property_head();
        loop {
            let start = self.here();
            let word = self.text_of(self.peek()).to_ascii_uppercase();
            let (accessor, end) = match word.as_str() {
                "GET" => (Accessor::Get, Kw::EndGet),
                "SET" => (Accessor::Set, Kw::EndSet),
                _ => break,
            };
            self.bump();
            self.eat(Tok::Semi);
            let pou = self.accessor(kind, accessor, &head, start, end, &word);
            objects.methods.push(pou);
        }
        self.close_member(Kw::EndProperty, opener, "PROPERTY");
    }

    /// The rest of GET or SET: a method whose result or only input has the name of the property.
    fn accessor(&mut self, owner: PouKind, accessor: Accessor, head: &Head, opener: Span, end: Kw, opener_name: &str) -> Pou {
        let modifiers = Modifiers { ..head.modifiers.clone() };
        let (mut sections, body) = self.method_body(owner);
        self.close_member(end, opener, opener_name);
        let result = (accessor == Accessor::Get).then(|| head.ty.clone());
        if accessor == Accessor::Set {
            let span = head.name.span;
            let decl = VarDecl {
                names: vec![head.name.clone()],
                at: None,
                relative: None,
                ty: head.ty.clone(),
                edge: None,
                arguments: None,
                init: None,
                span,
            };
            let kind = SectionKind::Input;
            sections.insert(
                0,
                VarSection {
                    kind,
                    constant: false,
                    retain: None,
                    access: None,
                    persistent: false,
                    qualified_only: false,
                    decls: vec![decl],
                    span,
                },
            );
        }
        let objects = Objects { modifiers, accessor: Some(accessor), ..Objects::default() };
        let (kind, name) = (PouKind::Method, head.name.clone());
        let (span, paths) = (self.since(opener), Vec::new());
        Pou { kind, name, result, sections, paths, body, objects, external: false, inline_c: None, test: None, span }
    }
}

/// What GET and SET of a property share.
struct Head {
    modifiers: Modifiers,
    name: Name,
    ty: TypeRef,
}
