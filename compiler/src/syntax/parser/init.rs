//! Initial values: expressions, arrays `[1, 2(0)]`, structures `(a := 1)`.
//! From: IEC 61131-3 §6.5.1.2 (language reference §3.9).

use super::cursor::Parser;
use super::expr::error;
use crate::syntax::ast::{ArrayInit, Init};
use crate::syntax::lexer::Tok;

impl Parser<'_> {
    /// What stands behind `:=` in a declaration.
    pub(super) fn init(&mut self) -> Init {
        let start = self.here();
        if !self.enter() {
            self.leave();
            return Init::Expr(error(start));
        }
        let init = match self.kind() {
            Tok::LBracket => self.array_init(),
            Tok::LParen if self.is_struct_init() => self.struct_init(),
            _ => Init::Expr(self.expr()),
        };
        self.leave();
        init
    }

    /// `1, 2, 3(0)` (CODESYS 2): the elements of an array may stand without brackets.
    pub(super) fn init_without_brackets(&mut self) -> Init {
        let start = self.here();
        let mut list = vec![self.array_element()];
        while !self.lost && self.eat(Tok::Comma) {
            list.push(self.array_element());
        }
        match (list.pop(), list.is_empty()) {
            (Some(ArrayInit::One(init)), true) => init,
            (last, _) => {
                list.extend(last);
                Init::Array(list, self.since(start))
            }
        }
    }

    fn is_struct_init(&self) -> bool {
        let next = self.nth(1).kind;
        next == Tok::RParen || next == Tok::Word && self.nth(2).kind == Tok::Assign
    }

    /// What stands behind the type of an instance, or of an array of them.
    pub(super) fn arguments_of_instance(&mut self) -> Init {
        match self.kind() {
            Tok::LBracket => self.list(|p| ArrayInit::One(p.arguments_of_one())),
            _ => self.arguments_of_one(),
        }
    }

    fn arguments_of_one(&mut self) -> Init {
        if !self.at(Tok::LParen) || self.is_struct_init() {
            return self.init();
        }
        let start = self.here();
        self.bump();
        let list = self.exprs();
        self.closing(Tok::RParen, ")", start);
        Init::Positional(list, self.since(start))
    }

    fn array_init(&mut self) -> Init {
        self.list(Self::array_element)
    }

    /// `[element, element]`.
    fn list(&mut self, element: impl Fn(&mut Self) -> ArrayInit) -> Init {
        let start = self.here();
        self.bump();
        let mut list = Vec::new();
        while !self.at(Tok::RBracket) && !self.lost {
            list.push(element(self));
            if !self.eat(Tok::Comma) {
                break;
            }
        }
        self.closing(Tok::RBracket, "]", start);
        Init::Array(list, self.since(start))
    }

    /// One element, or `3(0, 1)`. A constant before the parenthesis looks like a call; name resolution knows better.
    fn array_element(&mut self) -> ArrayInit {
        let counts = matches!(self.kind(), Tok::Int | Tok::Based);
        if !counts || self.nth(1).kind != Tok::LParen {
            return ArrayInit::One(self.init());
        }
        let Some(count) = self.literal() else { return ArrayInit::One(self.init()) };
        let paren = self.here();
        self.bump();
        let mut list = Vec::new();
        while !self.at(Tok::RParen) && !self.lost {
            list.push(self.init());
            if !self.eat(Tok::Comma) {
                break;
            }
        }
        self.closing(Tok::RParen, ")", paren);
        ArrayInit::Repeat(count, list)
    }

    fn struct_init(&mut self) -> Init {
        let start = self.here();
        self.bump();
        let mut list = Vec::new();
        while self.at(Tok::Word) && !self.lost {
            let name = self.name();
            if self.expect(Tok::Assign, "`:=` and the value of the member") {
                list.push((name, self.init()));
            }
            if !self.eat(Tok::Comma) {
                break;
            }
        }
        self.closing(Tok::RParen, ")", start);
        Init::Struct(list, self.since(start))
    }
}
