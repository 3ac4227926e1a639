//! Calls in Instruction List: instances, formal lists over several lines, operands by position (language reference §6.5).

use super::{error, starts_operand};
use crate::syntax::ast::Name;
use crate::syntax::il::{Arg, InstrKind, Value, When};
use crate::syntax::keyword::Kw;
use crate::syntax::lexer::Tok;
use crate::syntax::parser::cursor::Parser;
use takt_base::Span;

impl Parser<'_> {
    /// CAL: an instance and its arguments.
    pub(super) fn call_instance(&mut self, when: When, name: &Name) -> InstrKind {
        if !self.is_same_line(0) || !self.at(Tok::Word) {
            self.no_operand_of(name);
            return InstrKind::Error;
        }
        let instance = self.operand();
        let opener = self.here();
        let has_list = self.is_same_line(0) && self.eat(Tok::LParen);
        let args = if has_list { self.il_args(opener) } else { Vec::new() };
        InstrKind::Call { when, instance, args }
    }

    /// True at a parenthesis that opens a list of named arguments.
    pub(super) fn opens_formal(&self) -> bool {
        let first = if self.nth(1).kw == Kw::Not { 2 } else { 1 };
        let named = matches!(self.nth(first + 1).kind, Tok::Assign | Tok::Arrow);
        self.at(Tok::LParen) && self.nth(first).kind == Tok::Word && named
    }

    /// True if operands separated by commas follow: a function that is also an operator, `ADD a, b`.
    pub(super) fn has_more_operands(&self) -> bool {
        let mut n = 0;
        let mut depth = 0;
        while self.is_same_line(n) && !self.at_end() {
            match self.nth(n).kind {
                Tok::LBracket => depth += 1,
                Tok::RBracket => depth -= 1,
                Tok::LParen => return false,
                Tok::Comma if depth == 0 => return true,
                _ => {}
            }
            n += 1;
        }
        false
    }

    /// Operands separated by commas.
    pub(super) fn positional(&mut self) -> Vec<Arg> {
        let mut list = vec![Arg::Positional(self.operand())];
        while !self.lost && self.eat(Tok::Comma) {
            list.push(Arg::Positional(self.operand()));
        }
        list
    }

    /// Arguments up to the closing parenthesis; the opening one, at `opener`, is taken. A comma or a line end separates them.
    pub(super) fn il_args(&mut self, opener: Span) -> Vec<Arg> {
        let mut list = Vec::new();
        while !self.eat(Tok::RParen) {
            if self.ends_list() || self.lost {
                self.closing(Tok::RParen, ")", opener);
                break;
            }
            list.push(self.il_arg());
            let separated = self.eat(Tok::Comma) || !self.is_same_line(0) || self.at(Tok::RParen);
            if !separated && !self.lost {
                self.expected("`,` or the end of the line");
            }
            if self.lost {
                self.skip_args();
                break;
            }
        }
        list
    }

    /// After a mistake: to behind the closing parenthesis if it comes before the next instruction.
    fn skip_args(&mut self) {
        let mut depth = 1;
        while depth > 0 && !self.ends_list() {
            let instruction = !self.is_same_line(0) && self.operator_at(0).is_some() && starts_operand(self.nth(1).kind);
            if instruction && self.kw() != Kw::Not {
                break;
            }
            match self.bump().kind {
                Tok::LParen => depth += 1,
                Tok::RParen => depth -= 1,
                _ => {}
            }
        }
    }

    fn il_arg(&mut self) -> Arg {
        let negated = self.kw() == Kw::Not && self.nth(2).kind == Tok::Arrow;
        if negated {
            self.bump();
        }
        match self.nth(1).kind {
            Tok::Assign if self.at(Tok::Word) => {
                let name = self.name();
                self.bump();
                Arg::Input { name, value: self.il_value() }
            }
            Tok::Arrow if self.at(Tok::Word) => {
                let name = self.name();
                self.bump();
                Arg::Output { name, negated, target: self.operand() }
            }
            _ => Arg::Positional(self.operand()),
        }
    }

    /// An operand, or instructions in parentheses.
    fn il_value(&mut self) -> Value {
        let opener = self.here();
        if !self.eat(Tok::LParen) {
            return Value::Operand(self.operand());
        }
        if !self.enter() {
            self.leave();
            return Value::Operand(error(opener));
        }
        let list = self.inner_list(opener);
        self.leave();
        Value::List(list)
    }
}
