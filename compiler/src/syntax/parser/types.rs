//! Types where they are used, and TYPE ... END_TYPE.
//! From: IEC 61131-3 §6.4 (language reference §2, §3.9).

use super::cursor::Parser;
use crate::syntax::ast::{
    Arg, EnumDecl, Expr, ExprKind, Init, LayoutDecl, Name, TypeBody, TypeDecl, TypeRef, TypeRefKind, VarDecl,
};
use crate::syntax::keyword::Kw;
use crate::syntax::lexer::Tok;
use takt_base::diag::{Code, Diag};
use takt_base::{Profile, Span};
use takt_image::types::PointerKind;

impl Parser<'_> {
    /// TYPE ... END_TYPE; TYPE is the current token.
    pub(super) fn type_section(&mut self) -> Vec<TypeDecl> {
        let opener = self.here();
        self.bump();
        let mut list = Vec::new();
        while !self.at_end() && !self.kw().ends_declaration() && !self.kw().opens_declaration() && !self.kw().is_section() {
            if self.eat(Tok::Semi) {
                continue;
            }
            let before = self.pos;
            list.extend(self.type_decl());
            if self.lost {
                self.skip_declaration();
            }
            if self.pos == before {
                self.bump();
            }
        }
        self.close_declaration(Kw::EndType, opener, "TYPE");
        list
    }

    fn type_decl(&mut self) -> Option<TypeDecl> {
        let name = self.declared_name("the name of a type")?;
        let mut extends = self.struct_base();
        if !self.colon("the type") {
            return None;
        }
        let body = if self.kw() == Kw::Struct && self.nth(1).kw == Kw::Extends {
            let opener = self.here();
            self.bump();
            extends = self.struct_base();
            TypeBody::Struct(self.members(Kw::EndStruct, opener, "STRUCT"))
        } else {
            self.type_body()
        };
        let init = self.optional_init();
        if !self.lost && !self.eat(Tok::Semi) && !self.ends_type_decl() {
            self.missing_semicolon("this type");
        }
        Some(TypeDecl { name, extends, body, init })
    }

    /// Where the semicolon behind a type may be left out: behind END_STRUCT and END_UNION, and before END_TYPE (§3.9).
    fn ends_type_decl(&self) -> bool {
        matches!(self.prev().kw, Kw::EndStruct | Kw::EndUnion) || self.kw() == Kw::EndType
    }

    /// `EXTENDS name` of a structure (vendor).
    fn struct_base(&mut self) -> Option<Name> {
        if self.kw() != Kw::Extends {
            return None;
        }
        self.codesys_form("EXTENDS of a structure");
        self.bump();
        self.declared_name("the name of a structure")
    }

    fn type_body(&mut self) -> TypeBody {
        match self.type_ref() {
            TypeRef { kind: TypeRefKind::Enum(e), .. } => TypeBody::Enum(e),
            TypeRef { kind: TypeRefKind::Struct(members), .. } => TypeBody::Struct(members),
            other => TypeBody::Ref(other),
        }
    }

    /// A colon. Where a type follows, a missing one is reported and understood.
    pub(super) fn colon(&mut self, before: &str) -> bool {
        if self.eat(Tok::Colon) {
            return true;
        }
        let diag = self.expected_diag(&format!("`:` and {before}"));
        if self.starts_type() {
            self.soft(diag.help(format!("write : before {before}")));
            return true;
        }
        self.error(diag);
        false
    }

    /// True at what can only be a type.
    pub(super) fn starts_type(&self) -> bool {
        let kw = self.kw();
        let pointer = matches!(kw, Kw::Pointer | Kw::Reference) && self.nth(1).kw == Kw::To;
        kw.is_type() || matches!(kw, Kw::Array | Kw::Struct | Kw::RefTo) || pointer || self.at(Tok::LParen)
    }

    /// `:= value`, if it stands here.
    pub(super) fn optional_init(&mut self) -> Option<Init> {
        if self.lost {
            return None;
        }
        if self.is_word_and_equals("REF") {
            return Some(self.bound_init());
        }
        if self.at(Tok::Eq) || self.at(Tok::CEq) {
            let diag = self.expected_diag("`:=` before an initial value").help("write :=");
            self.soft(diag);
        } else if !self.at(Tok::Assign) {
            return None;
        }
        self.bump();
        let init = if self.profile == Profile::Codesys2 { self.init_without_brackets() } else { self.init() };
        if self.at(Tok::Comma) {
            let diag = self.expected_diag("`;` behind the initial value");
            self.error(diag.help("write the values of an array in brackets: [1, 2, 3]"));
        }
        Some(init)
    }

    /// `REF= v`, which is `:= REF(v)`.
    fn bound_init(&mut self) -> Init {
        let start = self.here();
        let name = Name { text: "REF".to_owned(), span: start };
        self.bump();
        self.bump();
        let value = self.expr();
        let callee = Box::new(Expr { kind: ExprKind::Name(name), span: start });
        let kind = ExprKind::Call { callee, args: vec![Arg::Positional(value)] };
        Init::Expr(Expr { kind, span: self.since(start) })
    }

    /// A type.
    pub(super) fn type_ref(&mut self) -> TypeRef {
        let start = self.here();
        if !self.enter() {
            self.leave();
            return TypeRef { kind: TypeRefKind::Error, span: start };
        }
        let kind = self.type_kind();
        self.leave();
        TypeRef { kind, span: self.since(start) }
    }

    fn type_kind(&mut self) -> TypeRefKind {
        match self.kw() {
            Kw::Array => self.array(),
            Kw::Struct => self.structure(),
            Kw::String | Kw::Wstring => self.string(),
            Kw::RefTo => self.pointer(PointerKind::RefTo),
            Kw::Pointer if self.nth(1).kw == Kw::To => self.pointer(PointerKind::Pointer),
            Kw::Reference if self.nth(1).kw == Kw::To => self.pointer(PointerKind::Reference),
            Kw::Union => self.union(),
            _ if self.at(Tok::LParen) => self.enumeration(None),
            kw if self.at(Tok::Word) && (!kw.is_reserved() || kw.is_type() || self.is_used_as_name(kw)) => self.named(),
            _ => {
                self.expected("a type");
                TypeRefKind::Error
            }
        }
    }

    fn named(&mut self) -> TypeRefKind {
        let token = self.bump();
        let name = Name { text: self.text_of(token).to_owned(), span: self.span_of(token) };
        let name = self.qualified(name);
        if !self.at(Tok::LParen) {
            return TypeRefKind::Named(name);
        }
        if !token.kw.is_type() && !self.is_range() {
            return TypeRefKind::Named(name); // arguments of an instance
        }
        let is_list = self.nth(1).kind == Tok::Word && matches!(self.nth(2).kind, Tok::Assign | Tok::Comma | Tok::RParen);
        match is_list {
            true => self.enumeration(Some(name)),
            false => self.subrange(name),
        }
    }

    /// True if `..` stands in the parentheses that open here.
    fn is_range(&self) -> bool {
        let (mut n, mut depth) = (0, 0i32);
        loop {
            match self.nth(n).kind {
                Tok::Range if depth == 1 => return true,
                Tok::LParen | Tok::LBracket => depth += 1,
                Tok::RParen | Tok::RBracket => depth -= 1,
                Tok::Semi | Tok::Eof => return false,
                _ => {}
            }
            if depth == 0 {
                return false;
            }
            n += 1;
        }
    }

    fn subrange(&mut self, base: Name) -> TypeRefKind {
        let paren = self.here();
        self.bump();
        let (low, high) = self.range();
        self.closing(Tok::RParen, ")", paren);
        TypeRefKind::Subrange { base, low: Box::new(low), high: Box::new(high) }
    }

    /// `low..high`.
    fn range(&mut self) -> (Expr, Expr) {
        let low = self.expr();
        // A type name stands for all its values (vendor).
        if matches!(low.kind, ExprKind::Name(_)) && (self.at(Tok::Comma) || self.at(Tok::RBracket)) && self.profile.is_codesys() {
            return (low.clone(), low);
        }
        if self.lost || !self.eat(Tok::Range) {
            let diag = self.expected_diag("`..` and the upper bound");
            self.error(diag.help("write both bounds, for example 0..9"));
            return (low, super::expr::error(self.here()));
        }
        (low, self.expr())
    }

    fn array(&mut self) -> TypeRefKind {
        self.bump();
        let bracket = self.here();
        if self.at(Tok::LParen) {
            let diag = self.expected_diag("`[` and the bounds of the array").help("write ARRAY [0..9] OF INT");
            self.error(diag);
            return TypeRefKind::Error;
        }
        if !self.expect(Tok::LBracket, "`[` and the bounds of the array") {
            return TypeRefKind::Error;
        }
        let (mut dims, mut open) = (Vec::new(), 0);
        loop {
            let mixed = if self.at(Tok::Star) { !dims.is_empty() } else { open > 0 };
            if mixed {
                let diag = Diag::new(Code::Expected, self.here(), "either all dimensions have bounds, or none");
                self.soft(diag.message("bounds and * in one array"));
            }
            if self.eat(Tok::Star) {
                open += 1;
            } else {
                dims.push(self.range());
            }
            if self.lost || !self.eat(Tok::Comma) {
                break;
            }
        }
        self.closing(Tok::RBracket, "]", bracket);
        if self.lost || !self.expect_word(Kw::Of, "OF and the type of the elements") {
            return TypeRefKind::Error;
        }
        let element = Box::new(self.type_ref());
        if open > 0 { TypeRefKind::OpenArray { dims: open, element } } else { TypeRefKind::Array { dims, element } }
    }

    /// Takes a keyword or reports that it is missing.
    pub(super) fn expect_word(&mut self, kw: Kw, what: &str) -> bool {
        self.eat_kw(kw) || {
            self.expected(what);
            false
        }
    }

    fn string(&mut self) -> TypeRefKind {
        let wide = self.bump().kw == Kw::Wstring;
        let opener = self.here();
        let (close, text) = match self.kind() {
            Tok::LBracket => (Tok::RBracket, "]"),
            Tok::LParen => (Tok::RParen, ")"),
            _ => return TypeRefKind::String { wide, open: false, capacity: None },
        };
        self.bump();
        if self.at(Tok::Star) {
            self.codesys_form("a string of variable length");
            self.bump();
            self.closing(close, text, opener);
            return TypeRefKind::String { wide, open: true, capacity: None };
        }
        let capacity = Some(Box::new(self.expr()));
        self.closing(close, text, opener);
        TypeRefKind::String { wide, open: false, capacity }
    }

    fn enumeration(&mut self, base: Option<Name>) -> TypeRefKind {
        let start = base.as_ref().map_or(self.here(), |b| b.span);
        let paren = self.here();
        self.bump();
        let mut values = Vec::new();
        while let Some(name) = self.declared_name("the name of a value") {
            let value = self.eat(Tok::Assign).then(|| self.expr());
            values.push((name, value));
            if self.lost || !self.eat(Tok::Comma) {
                break;
            }
        }
        self.closing(Tok::RParen, ")", paren);
        let base = match base {
            None if self.kw().is_type() && !self.lost => Some(self.plain_type_name()),
            base => base,
        };
        TypeRefKind::Enum(EnumDecl { base, values, span: self.since(start) })
    }

    fn plain_type_name(&mut self) -> Name {
        let token = self.bump();
        Name { text: self.text_of(token).to_owned(), span: self.span_of(token) }
    }

    fn structure(&mut self) -> TypeRefKind {
        let opener = self.here();
        self.bump();
        let overlap = self.eat_kw(Kw::Overlap);
        if self.kw() == Kw::Extends {
            let what = self.kw().text();
            self.unsupported_here(what);
            if self.bump().kw == Kw::Extends && self.at(Tok::Word) {
                self.bump();
            }
        }
        let members = self.members(Kw::EndStruct, opener, "STRUCT");
        if overlap || members.iter().any(|m| m.relative.is_some()) {
            return TypeRefKind::Layout(LayoutDecl { members, overlap, union: false });
        }
        TypeRefKind::Struct(members)
    }

    /// Members up to `end`.
    fn members(&mut self, end: Kw, opener: Span, opener_name: &str) -> Vec<VarDecl> {
        let mut list = Vec::new();
        while !self.at_end() && self.kw() != end {
            let kw = self.kw();
            if kw.ends_declaration() || kw.opens_declaration() || kw.is_section() {
                break;
            }
            let before = self.pos;
            if !self.eat(Tok::Semi) {
                list.extend(self.var_decl());
            }
            if self.pos == before {
                self.bump();
            }
        }
        if !self.eat_kw(end) {
            let diag = self.expected_diag(end.text()).also(opener, format!("the {opener_name} is opened here"));
            self.soft(diag);
        }
        list
    }

    fn union(&mut self) -> TypeRefKind {
        let opener = self.here();
        self.codesys_form("UNION");
        self.bump();
        let members = self.members(Kw::EndUnion, opener, "UNION");
        TypeRefKind::Layout(LayoutDecl { members, overlap: true, union: true })
    }

    /// `REF_TO T`, `POINTER TO T`, `REFERENCE TO T`.
    fn pointer(&mut self, kind: PointerKind) -> TypeRefKind {
        if kind != PointerKind::RefTo {
            self.codesys_form(kind.text());
            self.bump();
        }
        self.bump();
        TypeRefKind::Pointer { kind, target: Box::new(self.type_ref()) }
    }

    /// A `;` that a declaration lacks; what follows on the next line is another declaration.
    pub(super) fn missing_semicolon(&mut self, behind: &str) {
        let diag = self.missing_diag("`;`").message(format!("expected `;` behind {behind}"));
        if self.is_first_on_line() || self.kw().is_reserved() {
            self.soft(diag);
        } else {
            let diag = self.expected_diag(&format!("`;` behind {behind}"));
            self.error(diag);
            self.skip_declaration();
        }
    }

    /// The closing keyword of a declaration or section that was opened at `opener`; reports if another stands here.
    pub(super) fn close_declaration(&mut self, want: Kw, opener: Span, opener_name: &str) {
        if self.eat_kw(want) {
            self.eat(Tok::Semi);
            return;
        }
        let found = self.kw();
        if !(self.unwinding && self.at_end()) {
            let diag = Diag::new(Code::Expected, self.here(), self.describe(self.peek()));
            let diag = diag.message(format!("expected {}", want.text()));
            self.soft(diag.also(opener, format!("the {opener_name} is opened here")));
        }
        let is_outer = want == Kw::EndResource && found == Kw::EndConfiguration;
        if found.ends_declaration() && found != Kw::EndVar && !is_outer && is_unit_end(found) == is_unit_end(want) {
            self.bump();
            self.eat(Tok::Semi);
        }
    }
}

/// True for the end of a unit, which a section can't take for its own.
fn is_unit_end(kw: Kw) -> bool {
    matches!(kw, Kw::EndFunction | Kw::EndFunctionBlock | Kw::EndProgram | Kw::EndClass | Kw::EndInterface)
}
