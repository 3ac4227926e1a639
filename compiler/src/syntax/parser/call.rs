//! Calls and their arguments: formal, informal, `=>`, `NOT =>`.
//! From: IEC 61131-3 §6.6.1.7 (language reference §4.7).

use super::cursor::Parser;
use super::expr::Tree;
use crate::syntax::ast::{Arg, Expr, ExprKind};
use crate::syntax::keyword::Kw;
use crate::syntax::lexer::Tok;
use takt_base::Span;

impl Parser<'_> {
    /// A call of `callee`; the opening parenthesis is the current token.
    pub(super) fn call(&mut self, callee: Tree) -> Tree {
        let paren = self.here();
        self.bump();
        let start = callee.expr.span;
        let (args, height) = self.args(paren);
        let span = self.since(start);
        let kind = ExprKind::Call { callee: Box::new(callee.expr), args };
        self.grown(Expr { kind, span }, height.max(callee.height))
    }

    /// Arguments and the closing parenthesis; the opening one, at `paren`, is taken. With the height of the highest.
    fn args(&mut self, paren: Span) -> (Vec<Arg>, u32) {
        let (mut args, mut height) = (Vec::new(), 0);
        if self.eat(Tok::RParen) {
            return (args, height);
        }
        loop {
            args.push(self.arg(&mut height));
            if self.lost || !self.eat(Tok::Comma) {
                break;
            }
        }
        self.closing(Tok::RParen, ")", paren);
        (args, height)
    }

    /// A connection of a program in a resource.
    pub(super) fn connection(&mut self) -> Arg {
        self.arg(&mut 0)
    }

    fn arg(&mut self, height: &mut u32) -> Arg {
        let negated = self.kw() == Kw::Not && self.nth(1).kind == Tok::Word && self.nth(2).kind == Tok::Arrow;
        if negated {
            self.bump();
        }
        let is_word = self.at(Tok::Word);
        match self.nth(1).kind {
            Tok::Assign if is_word => {
                let name = self.name();
                self.bump();
                Arg::Input { name, value: self.arg_value(height) }
            }
            Tok::Arrow if is_word => {
                let name = self.name();
                self.bump();
                Arg::Output { name, negated, target: self.arg_value(height) }
            }
            Tok::RefAssign if is_word => {
                self.bump();
                self.unsupported_here("assignment attempt (?=)");
                self.bump();
                Arg::Positional(self.measured(height))
            }
            _ => Arg::Positional(self.measured(height)),
        }
    }

    /// The value of a named argument, which may be left out (vendor).
    fn arg_value(&mut self, height: &mut u32) -> Option<Expr> {
        if self.at(Tok::Comma) || self.at(Tok::RParen) {
            return None;
        }
        Some(self.measured(height))
    }

    /// An expression; `height` grows to that of its tree.
    fn measured(&mut self, height: &mut u32) -> Expr {
        let tree = self.binary(1);
        *height = tree.height.max(*height);
        tree.expr
    }

    /// The closing bracket of the one at `opener`.
    pub(super) fn closing(&mut self, kind: Tok, text: &str, opener: Span) {
        if self.eat(kind) || self.lost {
            return;
        }
        let what = format!("`{text}`");
        let fits = matches!(self.kind(), Tok::Semi | Tok::Eof) || self.is_first_on_line() || self.kw().is_reserved();
        let diag = if fits { self.missing_diag(&what) } else { self.expected_diag(&what) };
        let diag = diag.also(opener, "the bracket is opened here");
        if fits && !self.at_end() {
            self.soft(diag);
        } else {
            self.error(diag);
        }
    }
}
