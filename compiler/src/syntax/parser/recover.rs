//! Finding the place again after a mistake. Every loop here takes a token or stops: linear time.

use super::cursor::Parser;
use crate::syntax::keyword::Kw;
use crate::syntax::lexer::Tok;
use takt_base::Span;
use takt_base::diag::{Code, Diag};

impl Parser<'_> {
    /// Skips to behind the next `;`, or to a keyword where statements go on or end.
    pub(super) fn skip_statement(&mut self) {
        while !self.at_end() {
            if self.eat(Tok::Semi) {
                break;
            }
            if self.kw().ends_statements() || self.kw().opens_statement() && self.is_first_on_line() {
                break;
            }
            self.bump();
        }
        self.found_place();
    }

    /// Skips to behind the next `;` of a declaration, or to a keyword that ends or opens a section or declaration.
    pub(super) fn skip_declaration(&mut self) {
        while !self.at_end() {
            if self.eat(Tok::Semi) {
                break;
            }
            let kw = self.kw();
            if kw.is_section() || kw.opens_declaration() || kw.ends_declaration() {
                break;
            }
            self.bump();
        }
        self.found_place();
    }

    /// After a mistake in the head of a unit: skips to its sections, its end, or the next line.
    pub(super) fn skip_head(&mut self) {
        while !self.at_end() && !self.is_first_on_line() {
            if self.kw().ends_statements() || self.eat(Tok::Semi) {
                break;
            }
            self.bump();
        }
        self.found_place();
    }

    /// Skips to the next declaration of a file.
    pub(super) fn skip_to_item(&mut self) {
        while !self.at_end() && !self.kw().opens_declaration() && self.kw() != Kw::VarGlobal {
            self.bump();
        }
        self.found_place();
    }

    /// After an unfinished part of a statement (a condition, a range): takes `kw` if it comes before the statement ends.
    pub(super) fn skip_to_kw(&mut self, kw: Kw) {
        while !self.at_end() && !self.at(Tok::Semi) && self.kw() != kw {
            if self.kw().ends_statements() || self.kw().opens_statement() {
                break;
            }
            self.bump();
        }
        if self.eat_kw(kw) || !self.eat(Tok::Semi) {
            self.found_place();
            return;
        }
        self.found_place();
    }

    /// Skips to `kw` if it stands near on this line, also behind a `;`: the head of a loop as other languages write it.
    pub(super) fn skip_line_to(&mut self, kw: Kw) {
        const NEAR: usize = 40;
        let start = self.peek().start as usize;
        let is_here = |end: u32| self.text.get(start..end as usize).is_some_and(|t| !t.contains(['\n', '\r']));
        let found = (0..NEAR).find(|&n| self.nth(n).kw == kw);
        if let Some(n) = found.filter(|&n| is_here(self.nth(n).end)) {
            self.pos += n;
        }
    }

    /// The keyword between the parts of a statement (THEN, DO, OF, TO).
    pub(super) fn expect_part(&mut self, kw: Kw, opener: Span, opener_name: &str) {
        if self.lost {
            return self.skip_to_kw(kw);
        }
        if self.eat_kw(kw) {
            return;
        }
        let other = self.at(Tok::Word) && self.kw() == Kw::None && !self.is_first_on_line() && self.next_opens_line();
        if other || matches!(self.kw(), Kw::Then | Kw::Do | Kw::Of) {
            let diag = self.expected_diag(kw.text()).also(opener, format!("this {opener_name} needs it"));
            self.soft(diag.help(format!("write {}", kw.text())));
            self.bump();
            return;
        }
        let diag = if self.is_first_on_line() || self.at(Tok::Word) {
            self.missing_diag(kw.text())
        } else {
            self.expected_diag(kw.text())
        };
        let diag = diag.also(opener, format!("this {opener_name} needs it"));
        if self.is_first_on_line() || self.at(Tok::Word) || self.kw().ends_statements() {
            self.soft(diag.help(format!("write {} before the first statement inside", kw.text())));
        } else {
            self.error(diag);
            self.skip_to_kw(kw);
        }
    }

    /// The closing keyword of a statement that was opened at `opener`.
    pub(super) fn close(&mut self, want: Kw, opener: Span, opener_name: &str, help: Option<&str>) {
        self.open.pop();
        if self.eat_kw(want) {
            return;
        }
        if self.kw().meant() == Some(want) {
            self.misspelt_keyword(want);
            self.bump();
            return;
        }
        if self.unwinding {
            return;
        }
        let found = self.kw();
        let mistaken = found.ends_statement() && !self.open.contains(&found);
        let diag = self.expected_diag(want.text()).also(opener, format!("the {opener_name} is opened here"));
        self.soft(match help {
            Some(help) => diag.help(help),
            None => diag,
        });
        if mistaken {
            self.bump();
        } else {
            self.unwinding = self.at_end() || !found.ends_statement();
        }
    }

    /// `ENDIF` for `END_IF` and the like.
    pub(super) fn misspelt_keyword(&mut self, meant: Kw) {
        let diag = Diag::new(Code::Expected, self.here(), format!("not a keyword; {} is meant", meant.text()));
        self.soft(diag.message(format!("expected {}", meant.text())).help(format!("write {}", meant.text())));
    }

    /// Skips a construct with its nested ones, from its first keyword to behind `close`. Stops before what can't be inside it.
    pub(super) fn skip_construct(&mut self, open: Kw, close: Kw) {
        let mut depth = 0u32;
        while !self.at_end() {
            let kw = self.kw();
            if kw == open {
                depth += 1;
            } else if kw == close {
                depth = depth.saturating_sub(1);
                if depth == 0 {
                    self.bump();
                    self.eat(Tok::Semi);
                    break;
                }
            } else if ends_skipped(open, kw) {
                break;
            }
            self.bump();
        }
        self.found_place();
    }

    /// Skips statements to the next part or the end of the innermost open one, or to the end of the unit.
    pub(super) fn skip_nested(&mut self) {
        let mut depth = 0u32;
        while !self.at_end() {
            let kw = self.kw();
            if depth == 0 && (kw.ends_statement() || matches!(kw, Kw::Else | Kw::Elsif | Kw::Until)) {
                break;
            }
            if kw.ends_statement() {
                depth -= 1;
            } else if kw.opens_declaration() || kw.is_section() || kw.ends_declaration() {
                self.unwinding = true;
                break;
            } else if matches!(kw, Kw::If | Kw::Case | Kw::For | Kw::While | Kw::Repeat) {
                depth += 1;
            }
            self.bump();
        }
        self.unwinding |= self.at_end();
        self.found_place();
    }
}

/// True if `kw` can't stand inside of a construct that `open` opens: its end is missing.
fn ends_skipped(open: Kw, kw: Kw) -> bool {
    match open {
        Kw::Namespace => false,
        Kw::Class | Kw::Interface | Kw::Function | Kw::FunctionBlock | Kw::Program => {
            matches!(
                kw,
                Kw::Function | Kw::FunctionBlock | Kw::Program | Kw::Class | Kw::Interface | Kw::Configuration | Kw::Type
            )
        }
        Kw::Resource => {
            matches!(kw, Kw::Function | Kw::FunctionBlock | Kw::Type | Kw::Class | Kw::Interface | Kw::Configuration)
        }
        Kw::VarAccess | Kw::VarConfig | Kw::VarStat | Kw::VarInst => kw.ends_declaration() || kw.is_section(),
        _ => kw.opens_declaration() || matches!(kw, Kw::EndFunctionBlock | Kw::EndProgram | Kw::EndFunction | Kw::EndClass),
    }
}
