//! Operands: literals, names, direct addresses, parentheses.
//! From: IEC 61131-3 §7.3.2 (language reference §5.1).

use super::cursor::Parser;
use super::expr::{Tree, error};
use super::literal::problem_diag;
use crate::syntax::ast::{Expr, ExprKind, Literal, Name};
use crate::syntax::keyword::Kw;
use crate::syntax::lexer::Tok;
use crate::syntax::literal::address;
use takt_base::diag::{Code, Diag};

impl Parser<'_> {
    pub(super) fn primary(&mut self) -> Tree {
        if let Some(literal) = self.literal() {
            return Tree::leaf(literal);
        }
        let token = self.peek();
        match token.kind {
            Tok::Word => self.word(),
            Tok::LParen => self.parenthesised(),
            Tok::Direct => Tree::leaf(self.direct()),
            Tok::Error => {
                self.lost = true; // reported by the lexer
                self.bump();
                Tree::error(self.span_of(token))
            }
            _ => self.no_operand(),
        }
    }

    fn parenthesised(&mut self) -> Tree {
        let start = self.here();
        self.bump();
        let inner = self.binary(1);
        if self.at(Tok::Assign) {
            self.unsupported_here("an assignment inside of an expression");
            self.lost = true;
        }
        self.closing(Tok::RParen, ")", start);
        Tree { expr: Expr { span: self.since(start), ..inner.expr }, height: inner.height }
    }

    /// A direct address such as `%IX1.2`.
    fn direct(&mut self) -> Expr {
        let token = self.bump();
        let span = self.span_of(token);
        match address::direct(self.text_of(token), span) {
            Ok(address) => Expr { kind: ExprKind::Direct(address), span },
            Err(problem) => {
                self.soft(problem_diag(problem, span));
                error(span)
            }
        }
    }

    /// A name, TRUE, FALSE, or a keyword that is a function when a parenthesis follows.
    fn word(&mut self) -> Tree {
        let token = self.peek();
        let span = self.span_of(token);
        let kind = match token.kw {
            Kw::True | Kw::False => {
                self.bump();
                return Tree::leaf(Expr { kind: ExprKind::Literal(Literal::Bool(token.kw == Kw::True)), span });
            }
            Kw::Null | Kw::Ref | Kw::This | Kw::Super if !self.is_used_as_name(token.kw) => {
                self.unsupported_here(match token.kw {
                    Kw::Null | Kw::Ref => "a reference",
                    _ => "object orientation",
                });
                self.bump();
                ExprKind::Error
            }
            kw if !kw.is_reserved() || self.is_used_as_name(kw) => ExprKind::Name(self.name()),
            kw if (is_function(kw) || kw.is_type()) && self.nth(1).kind == Tok::LParen => ExprKind::Name(self.bare_name()),
            _ => return self.no_operand(),
        };
        Tree::leaf(Expr { kind, span })
    }

    /// The current word as written, without the checks for names.
    pub(super) fn bare_name(&mut self) -> Name {
        let token = self.bump();
        Name { text: self.text_of(token).to_owned(), span: self.span_of(token) }
    }

    fn no_operand(&mut self) -> Tree {
        let span = self.here();
        if self.at(Tok::Dot) && self.nth(1).kind == Tok::Int && self.nth(1).start == span.end {
            let digits = self.text_of(self.nth(1));
            let diag = Diag::new(Code::BadNumber, span.to(self.span_of(self.nth(1))), "a digit is missing before the point");
            self.soft(diag.help(format!("write 0.{digits}")));
            self.bump();
            self.bump();
            return Tree::error(self.since(span));
        }
        let diag = self.expected_diag("an expression");
        self.error(match (self.prev().kind, self.kind()) {
            (Tok::Eq, Tok::Lt) => diag.help("write <="),
            (Tok::Eq, Tok::Gt) => diag.help("write >="),
            (Tok::Gt, Tok::Lt) => diag.help("write <>"),
            _ => diag,
        });
        Tree::error(span)
    }
}

/// Keywords that are also functions: `AND(a, b)`.
fn is_function(kw: Kw) -> bool {
    matches!(kw, Kw::And | Kw::Or | Kw::Xor | Kw::Mod | Kw::Not)
}
