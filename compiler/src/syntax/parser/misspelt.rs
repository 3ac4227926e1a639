//! Misspelt keywords that shape a file (`END_FI`, `ENDPROGRAM`, `VARS`, `IFF c THEN`): reported once and understood, so that what is
//! around them keeps its shape. Only where no correct program has a name.

use super::cursor::Parser;
use crate::syntax::ast::StmtKind;
use crate::syntax::keyword::Kw;
use crate::syntax::lexer::{Tok, Token};
use takt_base::Profile;
use takt_base::diag::{Code, Diag};

const ENDS: &[Kw] = &[
    Kw::EndIf,
    Kw::EndCase,
    Kw::EndFor,
    Kw::EndWhile,
    Kw::EndRepeat,
    Kw::EndVar,
    Kw::EndType,
    Kw::EndStruct,
    Kw::EndProgram,
    Kw::EndFunction,
    Kw::EndFunctionBlock,
    Kw::EndClass,
    Kw::EndInterface,
    Kw::EndMethod,
    Kw::EndConfiguration,
    Kw::EndResource,
    Kw::EndNamespace,
];
const SECTIONS: &[Kw] = &[Kw::Var, Kw::VarInput, Kw::VarOutput, Kw::VarInOut, Kw::VarTemp, Kw::VarExternal, Kw::VarGlobal];
/// Words that open a statement, with the keyword that follows on the same line.
const OPENERS: &[(Kw, Kw)] = &[(Kw::If, Kw::Then), (Kw::While, Kw::Do), (Kw::For, Kw::Do), (Kw::Case, Kw::Of)];
/// Tokens of a line that are looked at.
const LINE: usize = 60;

impl Parser<'_> {
    /// Marks misspelt ends and sections in the whole file, before anything is parsed.
    pub(super) fn mend_keywords(&mut self) {
        for i in 0..self.tokens.list.len() {
            let token = self.tokens.list[i];
            let known = if token.kw == Kw::None { self.text_of(token).get(..3) } else { None };
            let meant = match known {
                Some(start) if start.eq_ignore_ascii_case("END") && self.stands_alone(i) => self.nearest_of(token, ENDS),
                Some(start) if start.eq_ignore_ascii_case("VAR") && self.stands_before_names(i) => {
                    self.nearest_of(token, SECTIONS)
                }
                _ => None,
            };
            if let Some(meant) = meant {
                self.report_misspelt(token, meant);
                self.tokens.list[i].kw = meant;
            }
        }
    }

    fn report_misspelt(&mut self, token: Token, meant: Kw) {
        let diag = Diag::new(Code::Expected, self.span_of(token), format!("not a keyword; {} is meant", meant.text()));
        self.report_always(diag.message(format!("expected {}", meant.text())).help(format!("write {}", meant.text())));
    }

    fn nearest_of(&self, token: Token, candidates: &[Kw]) -> Option<Kw> {
        let near = takt_base::nearest(self.text_of(token), candidates.iter().map(|kw| kw.text()))?;
        candidates.iter().copied().find(|kw| kw.text() == near)
    }

    fn token(&self, i: usize) -> Token {
        self.tokens.list[i.min(self.tokens.list.len() - 1)]
    }

    /// True if a line break or the end of the text lies between a token and the one before it.
    fn opens_line(&self, i: usize) -> bool {
        let (token, before) = (self.token(i), i.checked_sub(1).map(|b| self.token(b)));
        let between = before.map_or("\n", |b| self.text.get(b.end as usize..token.start as usize).unwrap_or(""));
        token.kind == Tok::Eof || between.contains(['\n', '\r'])
    }

    /// True if the current token is the last of its line.
    pub(super) fn next_opens_line(&self) -> bool {
        self.opens_line(self.pos + 1)
    }

    /// Behind a `;` or at the start of a line, and before a `;` or the end of a line: a statement of one word.
    fn stands_alone(&self, i: usize) -> bool {
        let behind = i == 0 || self.token(i - 1).kind == Tok::Semi || self.opens_line(i);
        let next = self.token(i + 1);
        let ends = next.kind == Tok::Semi || next.kind == Tok::Eof || next.kind == Tok::Word && self.opens_line(i + 1);
        behind && ends
    }

    /// At the start of a line, before `name :` or `name,`.
    fn stands_before_names(&self, i: usize) -> bool {
        let names = self.token(i + 1).kind == Tok::Word && matches!(self.token(i + 2).kind, Tok::Colon | Tok::Comma);
        names && self.opens_line(i) && !self.token(i + 1).kw.is_section()
    }

    /// `IFF c THEN`: a statement that a misspelt keyword opens; reported, and parsed as what is meant.
    pub(super) fn misspelt_opener(&mut self) -> Option<StmtKind> {
        let follows = matches!(self.nth(1).kind, Tok::Word | Tok::LParen);
        if self.kw() != Kw::None || !self.at(Tok::Word) || !follows || self.profile == Profile::Codesys2 {
            return None;
        }
        let near: Vec<Kw> = OPENERS.iter().filter(|o| self.line_has(o.1)).map(|o| o.0).collect();
        let meant = self.nearest_of(self.peek(), &near)?;
        self.report_misspelt(self.peek(), meant);
        Some(match meant {
            Kw::If => self.if_statement(),
            Kw::While => self.while_statement(),
            Kw::For => self.for_statement(),
            _ => self.case_statement(),
        })
    }

    /// True if the keyword comes on this line, before a `;`.
    fn line_has(&self, kw: Kw) -> bool {
        let rest = (1..LINE).take_while(|&n| self.nth(n).kind != Tok::Semi && !self.opens_line(self.pos + n));
        rest.into_iter().any(|n| self.nth(n).kw == kw)
    }
}
