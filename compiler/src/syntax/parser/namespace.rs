//! NAMESPACE, USING and names with points.
//! From: IEC 61131-3 §6.9 (language reference §4.6).

use super::cursor::Parser;
use super::expr::Tree;
use crate::syntax::ast::{Expr, ExprKind, Item, Name, Namespace};
use crate::syntax::keyword::Kw;
use crate::syntax::lexer::Tok;

impl Parser<'_> {
    /// NAMESPACE ... END_NAMESPACE; NAMESPACE is the current token.
    pub(super) fn namespace(&mut self) -> Option<Item> {
        let opener = self.here();
        if !self.enter() {
            self.leave();
            self.skip_construct(Kw::Namespace, Kw::EndNamespace);
            return None;
        }
        self.bump();
        let internal = self.eat_kw(Kw::Internal);
        let name = self.declared_name("the name of the namespace");
        let name = name.map(|n| self.qualified(n));
        self.eat(Tok::Semi);
        let mut usings = Vec::new();
        while self.kw() == Kw::Using {
            usings.append(&mut self.using());
        }
        let mut items = Vec::new();
        while !self.at_end() && self.kw() != Kw::EndNamespace {
            let before = self.pos;
            items.extend(self.item());
            if self.pos == before {
                self.bump();
            }
        }
        self.found_place();
        self.close_declaration(Kw::EndNamespace, opener, "NAMESPACE");
        self.leave();
        let name = name?;
        Some(Item::Namespace(Namespace { name, internal, usings, items, span: self.since(opener) }))
    }

    /// `USING a.b, c;`; USING is the current token.
    pub(super) fn using(&mut self) -> Vec<Name> {
        let mut names = Vec::new();
        self.bump();
        self.type_names(&mut names);
        if !self.lost && !self.eat(Tok::Semi) {
            self.missing_semicolon("USING");
        }
        names
    }

    /// The rest of a name with points, behind its first part.
    pub(super) fn qualified(&mut self, mut name: Name) -> Name {
        while self.at(Tok::Dot) && self.nth(1).kind == Tok::Word {
            self.bump();
            let part = self.name();
            name.text = name.text + "." + &part.text;
            name.span = name.span.to(part.span);
        }
        name
    }

    /// `T#V` behind `a.b.`: a value of an enumeration in a namespace.
    pub(super) fn qualified_value(&mut self, base: &Expr) -> ExprKind {
        let value = self.literal().map(|e| e.kind);
        match (path(base), value) {
            (Some(mut path), Some(ExprKind::Enumerator { ty, value })) => {
                path.text = path.text + "." + &ty.text;
                path.span = path.span.to(ty.span);
                ExprKind::Enumerator { ty: path, value }
            }
            (_, Some(ExprKind::Error)) => ExprKind::Error,
            _ => {
                self.expected("the name of an enumeration in front of the #");
                ExprKind::Error
            }
        }
    }

    /// `.x` (vendor): the global, whatever hides it.
    pub(super) fn global_name(&mut self) -> Tree {
        let start = self.here();
        self.codesys_form("a point in front of the name of a global variable");
        self.bump();
        let name = self.name();
        let name = Name { text: format!(".{}", name.text), span: start.to(name.span) };
        Tree::leaf(Expr { span: name.span, kind: ExprKind::Name(name) })
    }
}

/// The names of `a.b`.
fn path(e: &Expr) -> Option<Name> {
    let mut parts = Vec::new();
    let mut root = e;
    while let ExprKind::Member(base, name) = &root.kind {
        parts.push(name);
        root = base;
    }
    let ExprKind::Name(first) = &root.kind else { return None };
    let text = parts.iter().rev().fold(first.text.clone(), |text, part| text + "." + &part.text);
    Some(Name { text, span: e.span })
}
