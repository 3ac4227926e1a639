//! CASE, FOR, WHILE and REPEAT.
//! From: IEC 61131-3 §7.3.3.3, §7.3.3.4 (language reference §5.1).

use super::cursor::Parser;
use crate::syntax::ast::{CaseArm, CaseLabel, Expr, StmtKind};
use crate::syntax::keyword::Kw;
use crate::syntax::lexer::Tok;
use takt_base::Span;

impl Parser<'_> {
    pub(super) fn case_statement(&mut self) -> StmtKind {
        let opener = self.here();
        self.bump();
        self.open.push(Kw::EndCase);
        let selector = self.condition();
        self.expect_part(Kw::Of, opener, "CASE");
        let mut arms = self.case_arms();
        if arms.is_empty() && !self.kw().ends_statements() && !self.at_end() {
            self.unlabelled();
            self.statements(true);
            arms = self.case_arms();
        }
        let otherwise = self.eat_kw(Kw::Else).then(|| {
            self.eat(Tok::Colon); // ELSE: (vendor)
            self.statements(false)
        });
        self.close(Kw::EndCase, opener, "CASE", None);
        StmtKind::Case { selector, arms, otherwise }
    }

    fn unlabelled(&mut self) {
        let diag = self.expected_diag("a CASE label");
        self.soft(diag.help("write for example 1: or 2, 4..6: before the statements"));
    }

    /// A label is a place to go on from, whatever was wrong before it; and each arm takes something.
    fn case_arms(&mut self) -> Vec<CaseArm> {
        let mut arms = Vec::new();
        while !self.at_end() && self.is_label() {
            self.found_place();
            let before = self.pos;
            arms.push(self.case_arm());
            if self.pos == before {
                self.bump();
            }
        }
        arms
    }

    fn case_arm(&mut self) -> CaseArm {
        let mut labels = Vec::new();
        loop {
            labels.push(self.case_label());
            if self.lost || !self.eat(Tok::Comma) {
                break;
            }
        }
        if !self.lost {
            self.expect(Tok::Colon, "`:` behind the CASE label");
        }
        if self.lost {
            self.skip_label();
        }
        CaseArm { labels, body: self.statements(true) }
    }

    fn case_label(&mut self) -> CaseLabel {
        let low = self.expr();
        let high = (!self.lost && self.eat(Tok::Range)).then(|| self.expr());
        CaseLabel { low, high }
    }

    /// After a mistake in a label: to behind its colon, or the next statement.
    fn skip_label(&mut self) {
        while !self.at_end() && !self.eat(Tok::Colon) {
            if self.is_first_on_line() || self.at(Tok::Semi) || self.kw().ends_statements() || self.kw().opens_statement() {
                break;
            }
            self.bump();
        }
        self.found_place();
    }

    /// True if a CASE label stands here and no statement: a literal, or a name (with members) and what no statement has there.
    pub(super) fn is_label(&self) -> bool {
        match self.kind() {
            Tok::Int | Tok::Based | Tok::TypePrefix | Tok::Minus | Tok::Plus | Tok::LParen => true,
            Tok::String | Tok::WString | Tok::Duration | Tok::Date | Tok::Real | Tok::BadNumber => true,
            Tok::Word if matches!(self.kw(), Kw::True | Kw::False | Kw::Not) => true,
            Tok::Word if self.kw().ends_statements() || self.kw().opens_statement() => false,
            Tok::Word => self.is_name_label(),
            _ => false,
        }
    }

    fn is_name_label(&self) -> bool {
        let mut n = 1;
        while self.nth(n).kind == Tok::Dot && self.nth(n + 1).kind == Tok::Word {
            n += 2;
        }
        match self.nth(n).kind {
            Tok::Colon => self.nth(n + 1).kind != Tok::Eq,
            Tok::Comma | Tok::Range | Tok::Star | Tok::Slash => true,
            Tok::Plus | Tok::Minus => self.nth(n + 1).kind != self.nth(n).kind,
            _ => false,
        }
    }

    pub(super) fn for_statement(&mut self) -> StmtKind {
        let opener = self.here();
        self.bump();
        self.open.push(Kw::EndFor);
        let variable = Box::new(self.variable());
        let from = Box::new(self.for_start());
        let to = Box::new(self.for_bound(opener));
        let by = if !self.lost && self.eat_kw(Kw::By) { Some(Box::new(self.expr())) } else { None };
        self.expect_part(Kw::Do, opener, "FOR");
        let body = self.statements(false);
        self.close(Kw::EndFor, opener, "FOR", None);
        StmtKind::For { variable, from, to, by, body }
    }

    fn for_start(&mut self) -> Expr {
        if self.at(Tok::Eq) && !self.lost {
            let diag = self.expected_diag("`:=` and the first value");
            self.soft(diag.help("write :="));
            self.bump();
        } else if self.lost || !self.expect(Tok::Assign, "`:=` and the first value") {
            return super::expr::error(self.here());
        }
        self.expr()
    }

    fn for_bound(&mut self, opener: Span) -> Expr {
        if self.lost {
            return super::expr::error(self.here());
        }
        if !self.eat_kw(Kw::To) {
            let diag = self.expected_diag("TO and the last value").also(opener, "this FOR needs it");
            if self.kw() == Kw::Until {
                self.soft(diag.help("write TO"));
                self.bump();
                return self.expr();
            }
            if self.at(Tok::Semi) {
                self.error(diag.help("write for example FOR i := 0 TO 9 DO"));
                self.skip_line_to(Kw::Do);
            } else {
                self.error(diag);
            }
            return super::expr::error(self.here());
        }
        self.expr()
    }

    pub(super) fn while_statement(&mut self) -> StmtKind {
        let opener = self.here();
        self.bump();
        self.open.push(Kw::EndWhile);
        let condition = self.condition();
        self.expect_part(Kw::Do, opener, "WHILE");
        let body = self.statements(false);
        self.close(Kw::EndWhile, opener, "WHILE", None);
        StmtKind::While { condition, body }
    }

    pub(super) fn repeat_statement(&mut self) -> StmtKind {
        let opener = self.here();
        self.bump();
        self.open.push(Kw::EndRepeat);
        let body = self.statements(false);
        let until = self.until(opener);
        self.close(Kw::EndRepeat, opener, "REPEAT", None);
        StmtKind::Repeat { body, until }
    }

    /// UNTIL, the condition and an optional `;`.
    fn until(&mut self, opener: Span) -> Expr {
        if !self.eat_kw(Kw::Until) {
            if !self.unwinding {
                let diag = self.expected_diag("UNTIL and a condition").also(opener, "this REPEAT needs it");
                self.soft(diag);
            }
            return super::expr::error(self.here());
        }
        let condition = self.condition();
        if self.lost {
            self.skip_statement();
        }
        self.eat(Tok::Semi);
        condition
    }
}
