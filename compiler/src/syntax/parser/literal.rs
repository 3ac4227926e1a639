//! Literals in expressions: values of tokens, type prefixes, range of typed literals, sign.
//! From: IEC 61131-3 §6.3 (language reference §1.5 to §1.7).

use super::cursor::Parser;
use crate::syntax::ast::{Expr, ExprKind, Literal, Name, UnaryOp};
use crate::syntax::keyword::Kw;
use crate::syntax::lexer::{Tok, Token};
use crate::syntax::literal::{Problem, Read, number, string, time};
use takt_base::Span;
use takt_base::diag::{Code, Diag};
use takt_image::Elementary;

impl Parser<'_> {
    /// How this file's strings are read.
    fn narrow(&self) -> fn(&str) -> Read {
        if self.latin1 { string::latin1 } else { string::narrow }
    }

    /// Takes a literal token; `None` if the current token is none.
    pub(super) fn literal(&mut self) -> Option<Expr> {
        let token = self.peek();
        let read: fn(&str) -> Read = match token.kind {
            Tok::Int => number::integer,
            Tok::Real => number::real,
            Tok::Based => number::based,
            Tok::String => self.narrow(),
            Tok::WString => string::wide,
            Tok::Duration => time::duration,
            Tok::Date => time::date,
            Tok::BadNumber => |text| Err(number::explain_bad(text)),
            Tok::TypePrefix => return Some(self.prefixed()),
            _ => return None,
        };
        let value = self.value(token, read);
        self.bump();
        Some(Expr { kind: value.map_or(ExprKind::Error, ExprKind::Literal), span: self.span_of(token) })
    }

    /// Reads a token's value; reports and gives `None` if it has none.
    fn value(&mut self, token: Token, read: fn(&str) -> Read) -> Option<Literal> {
        match read(self.text_of(token)) {
            Ok(value) => {
                if let Some(problem) = value.warning {
                    self.warn(problem_diag(problem, self.span_of(token)));
                }
                Some(value.literal)
            }
            Err(problem) => {
                self.soft(problem_diag(problem, self.span_of(token)));
                None
            }
        }
    }

    /// `INT#5`, `BOOL#TRUE`, `STRING#'x'`, `Color#Red`.
    fn prefixed(&mut self) -> Expr {
        let prefix = self.bump();
        let start = self.span_of(prefix);
        let text = self.text_of(prefix).trim_end_matches('#');
        let ty = Name { text: text.to_owned(), span: Span { end: start.end - 1, ..start } };
        if !self.is_adjacent() {
            let diag = Diag::new(Code::BadTypedLiteral, start, "nothing behind the #");
            self.soft(diag.help("write the value directly behind it, without a blank"));
            return Expr { kind: ExprKind::Error, span: start };
        }
        if let Some(elementary) = Elementary::from_name(text) {
            return self.typed(elementary, start);
        }
        match (Kw::of(text), self.kind()) {
            (Kw::String | Kw::Wstring, Tok::String | Tok::WString) => self.typed_string(Kw::of(text) == Kw::Wstring),
            (_, Tok::Word) => {
                let value = self.name();
                Expr { span: self.since(start), kind: ExprKind::Enumerator { ty, value } }
            }
            _ => self.bad_prefix(start),
        }
    }

    fn typed_string(&mut self, wide: bool) -> Expr {
        let token = self.peek();
        let value = self.value(token, if wide { string::wide } else { self.narrow() });
        self.bump();
        Expr { kind: value.map_or(ExprKind::Error, ExprKind::Literal), span: self.span_of(token) }
    }

    /// A prefix of a type that has no literals of this shape.
    fn bad_prefix(&mut self, start: Span) -> Expr {
        let diag = Diag::new(Code::BadTypedLiteral, start, "only elementary types and enumerations stand before #");
        self.soft(diag.help("write the value without the prefix"));
        let _ = self.eat(Tok::Minus) || self.eat(Tok::Plus);
        if self.literal_follows() {
            self.bump();
        }
        Expr { kind: ExprKind::Error, span: self.since(start) }
    }

    fn literal_follows(&self) -> bool {
        matches!(self.kind(), Tok::Int | Tok::Real | Tok::Based | Tok::BadNumber | Tok::String | Tok::WString)
    }

    /// The value behind the prefix of an elementary type.
    fn typed(&mut self, ty: Elementary, start: Span) -> Expr {
        let negative = self.at(Tok::Minus);
        if negative || self.at(Tok::Plus) {
            self.bump();
        }
        let token = self.peek();
        let value = match (token.kind, token.kw) {
            (Tok::Word, Kw::True | Kw::False) => Some(Literal::Bool(token.kw == Kw::True)),
            (Tok::Int, _) => self.value(token, number::integer),
            (Tok::Based, _) if !negative => self.value(token, number::based),
            (Tok::Real, _) => self.value(token, number::real),
            (Tok::String, _) if ty == Elementary::Wchar => self.value(token, string::wide),
            (Tok::String, _) => self.value(token, self.narrow()),
            (Tok::WString, _) => self.value(token, string::wide),
            (Tok::BadNumber, _) => self.value(token, |text| Err(number::explain_bad(text))),
            _ => return self.no_value(ty, start),
        };
        self.bump();
        let span = self.since(start);
        let Some(value) = value else { return Expr { kind: ExprKind::Error, span } };
        match fit(ty, if negative { negate(value) } else { value }) {
            Ok(value) => Expr { kind: ExprKind::Literal(Literal::Typed { ty, value: Box::new(value) }), span },
            Err(problem) => {
                self.soft(problem_diag(problem, span));
                Expr { kind: ExprKind::Error, span }
            }
        }
    }

    fn no_value(&mut self, ty: Elementary, start: Span) -> Expr {
        let label = match self.kind() {
            Tok::Word => format!("{}# needs a literal, not a name", ty.name()),
            _ => format!("{}# needs a literal", ty.name()),
        };
        let span = if self.at(Tok::Word) { start.to(self.here()) } else { start };
        if self.at(Tok::Word) {
            self.bump();
        }
        self.soft(Diag::new(Code::BadTypedLiteral, span, label));
        Expr { kind: ExprKind::Error, span }
    }
}

/// A sign directly before an untyped number is part of it, so that the smallest integer can be written.
pub(super) fn fold_sign(op: UnaryOp, operand: &Expr) -> Option<Literal> {
    let ExprKind::Literal(literal) = &operand.kind else { return None };
    let is_unsigned = match literal {
        Literal::Int { value, .. } => *value >= 0,
        Literal::Real(value) => value.is_sign_positive(),
        _ => false,
    };
    match op {
        UnaryOp::Neg if is_unsigned => Some(negate(literal.clone())),
        UnaryOp::Plus if is_unsigned => Some(literal.clone()),
        _ => None,
    }
}

fn negate(literal: Literal) -> Literal {
    match literal {
        Literal::Int { value, .. } => Literal::Int { value: -value, based: false },
        Literal::Real(value) => Literal::Real(-value),
        other => other,
    }
}

/// Checks that a value is one of the type; an integer for REAL becomes a real, 0 and 1 for BOOL become truth values.
fn fit(ty: Elementary, value: Literal) -> Result<Literal, Problem> {
    let bad = |label: String| Problem::new(Code::BadTypedLiteral, label);
    match value {
        Literal::Bool(b) if ty == Elementary::Bool => Ok(Literal::Bool(b)),
        Literal::Int { value, .. } if ty.is_real() => fit(ty, Literal::Real(value as f64)),
        Literal::Int { value, based } if ty.is_int() || ty.is_bit() || ty.is_char() => {
            let (low, high) = ty.int_range().unwrap_or((0, 0));
            if value < low || value > high {
                let help =
                    if based && ty.is_signed_int() { "a based literal is not negative: write the decimal value" } else { "" };
                let problem = bad(format!("{} holds {low} to {high}", ty.name()));
                return Err(if help.is_empty() { problem } else { problem.help(help) });
            }
            Ok(if ty == Elementary::Bool { Literal::Bool(value == 1) } else { Literal::Int { value, based } })
        }
        Literal::Real(v) if ty == Elementary::Lreal || ty == Elementary::Real && (v as f32).is_finite() => Ok(Literal::Real(v)),
        Literal::Real(_) if ty == Elementary::Real => Err(bad("larger than the largest REAL, 3.4E38".to_owned())),
        Literal::String(s) if ty == Elementary::Char => one_char(s.len() == 1, Literal::String(s)),
        Literal::WString(s) if ty == Elementary::Wchar => one_char(s.len() == 1, Literal::WString(s)),
        _ => Err(bad(format!("not a value of {}", ty.name()))),
    }
}

fn one_char(is_one: bool, value: Literal) -> Result<Literal, Problem> {
    if is_one { Ok(value) } else { Err(Problem::new(Code::BadTypedLiteral, "not exactly one character")) }
}

/// A problem of the token at `span`, as a message.
pub(super) fn problem_diag(problem: Problem, span: Span) -> Diag {
    let span = match problem.at {
        Some((start, end)) => Span { start: span.start + start as u32, end: span.start + end as u32, ..span },
        None => span,
    };
    let diag = Diag::new(problem.code, span, problem.label);
    match problem.help {
        Some(help) => diag.help(help),
        None => diag,
    }
}
