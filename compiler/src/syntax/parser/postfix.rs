//! What follows an operand: members, parts, subscripts, calls with their arguments.
//! From: IEC 61131-3 §6.5.5, §6.6.1.4 (language reference §2.11, §4.7).

use super::cursor::Parser;
use super::expr::Tree;
use super::literal::problem_diag;
use crate::syntax::ast::{AddressSize, Arg, Expr, ExprKind};
use crate::syntax::keyword::Kw;
use crate::syntax::lexer::{Tok, Token};
use crate::syntax::literal::address;
use takt_base::Span;
use takt_base::diag::{Code, Diag};

impl Parser<'_> {
    pub(super) fn postfix(&mut self) -> Tree {
        let mut tree = self.primary();
        let callable = !matches!(tree.expr.kind, ExprKind::Literal(_));
        while !self.lost && callable {
            tree = match self.kind() {
                Tok::Dot => self.member(tree),
                Tok::LBracket => self.index(tree),
                Tok::LParen => self.call(tree),
                Tok::Caret => {
                    if !matches!(tree.expr.kind, ExprKind::Error) {
                        self.unsupported_here("dereferencing (^)");
                    }
                    self.bump();
                    Tree::error(self.since(tree.expr.span))
                }
                _ => break,
            };
        }
        tree
    }

    /// `.name`, `.3`, `.%X3`; the dot is the current token.
    fn member(&mut self, base: Tree) -> Tree {
        self.bump();
        let start = base.expr.span;
        let token = self.peek();
        let kind = match token.kind {
            Tok::Word => {
                let name = self.name();
                ExprKind::Member(Box::new(base.expr), name)
            }
            Tok::Int => {
                self.bump();
                match self.text_of(token).parse() {
                    Ok(index) => ExprKind::Part { base: Box::new(base.expr), size: AddressSize::Bit, index },
                    Err(_) => self.bad_part(token),
                }
            }
            Tok::Direct => {
                self.bump();
                match address::partial(self.text_of(token)) {
                    Ok((size, index)) => ExprKind::Part { base: Box::new(base.expr), size, index },
                    Err(problem) => {
                        self.soft(problem_diag(problem, self.span_of(token)));
                        ExprKind::Error
                    }
                }
            }
            _ => {
                self.expected("the name of a member, or the number of a bit, behind the point");
                return Tree::error(start);
            }
        };
        let span = self.since(start);
        self.grown(Expr { kind, span }, base.height)
    }

    fn bad_part(&mut self, token: Token) -> ExprKind {
        self.soft(Diag::new(Code::BadAddress, self.span_of(token), "not the number of a bit"));
        ExprKind::Error
    }

    fn index(&mut self, base: Tree) -> Tree {
        let bracket = self.here();
        self.bump();
        let start = base.expr.span;
        let (mut list, mut height) = (Vec::new(), base.height);
        loop {
            let tree = self.binary(1);
            height = height.max(tree.height);
            list.push(tree.expr);
            if !self.eat(Tok::Comma) {
                break;
            }
        }
        self.closing(Tok::RBracket, "]", bracket);
        let span = self.since(start);
        self.grown(Expr { kind: ExprKind::Index(Box::new(base.expr), list), span }, height)
    }

    fn call(&mut self, callee: Tree) -> Tree {
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

    /// The arguments of a program in a resource; the opening parenthesis is the current token.
    pub(super) fn connections(&mut self) -> Vec<Arg> {
        let paren = self.here();
        self.bump();
        self.args(paren).0
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
                Arg::Positional(self.expr())
            }
            _ => {
                let tree = self.binary(1);
                *height = tree.height.max(*height);
                Arg::Positional(tree.expr)
            }
        }
    }

    /// The value of a named argument, which may be left out (vendor).
    fn arg_value(&mut self, height: &mut u32) -> Option<Expr> {
        if self.at(Tok::Comma) || self.at(Tok::RParen) {
            return None;
        }
        let tree = self.binary(1);
        *height = tree.height.max(*height);
        Some(tree.expr)
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
