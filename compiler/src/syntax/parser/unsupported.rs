//! Parts of the language that this version lacks: one message, then on behind their end.

use super::cursor::Parser;
use crate::syntax::ast::StmtKind;
use crate::syntax::keyword::Kw;
use crate::syntax::lexer::{Tok, is_graphic_body};
use takt_base::Profile;
use takt_base::diag::{Code, Diag};

/// Declarations by opening and closing keyword that can't stand at file level.
const CONSTRUCTS: [(Kw, Kw); 3] = [(Kw::Action, Kw::EndAction), (Kw::Actions, Kw::EndActions), (Kw::Resource, Kw::EndResource)];

impl Parser<'_> {
    pub(super) fn unsupported_diag(&self, what: &str) -> Diag {
        let diag = Diag::new(Code::NotSupportedYet, self.here(), "not in this version");
        diag.message(format!("{what} is not supported by this version"))
    }

    /// Reports that what starts at the current token is missing in this version.
    pub(super) fn unsupported_here(&mut self, what: &str) {
        let diag = self.unsupported_diag(what);
        self.soft(diag);
    }

    /// A construct of a file; false if none stands here.
    pub(super) fn unsupported_item(&mut self) -> bool {
        if self.kw() == Kw::VarConfig {
            self.var_section();
            return true;
        }
        if self.kw() == Kw::VarAccess {
            let diag = self.expected_diag("a declaration").help("VAR_ACCESS stands inside of a CONFIGURATION or a PROGRAM");
            self.soft(diag);
            self.skip_construct(Kw::VarAccess, Kw::EndVar);
            return true;
        }
        self.unsupported_construct()
    }

    fn unsupported_construct(&mut self) -> bool {
        let kw = self.kw();
        let Some(&(open, close)) = CONSTRUCTS.iter().find(|c| c.0 == kw) else { return false };
        if !kw.is_reserved() && self.nth(1).kind != Tok::Word {
            return false;
        }
        let help = match kw {
            Kw::Resource => "a RESOURCE stands inside of a CONFIGURATION",
            _ => "an action stands inside of its PROGRAM or FUNCTION_BLOCK, or directly behind it",
        };
        let diag = self.expected_diag("a declaration").help(help);
        self.soft(diag);
        self.skip_construct(open, close);
        true
    }

    /// A construct between the statements of a unit; false if none stands here.
    pub(super) fn unsupported_body(&mut self) -> bool {
        match self.kw() {
            Kw::InitialStep | Kw::Step | Kw::Transition if self.nth(1).kind == Tok::Word => {
                self.unsupported_here("Sequential Function Chart");
                self.skip_body();
                true
            }
            Kw::None if self.at(Tok::Word) && is_graphic_body(self.text_of(self.peek())) && self.profile == Profile::Codesys2 => {
                let what = format!("a graphical body ({})", self.text_of(self.peek()).trim_matches('_').replace("_BODY", ""));
                let diag = self.unsupported_diag(&what);
                self.soft(diag.help("export the unit as PLCopen XML, or rewrite its body in ST"));
                self.bump();
                true
            }
            _ => false,
        }
    }

    pub(super) fn is_word(&self, word: &str) -> bool {
        self.at(Tok::Word) && self.text_of(self.peek()).eq_ignore_ascii_case(word)
    }

    /// `__TRY .. __ENDTRY`.
    pub(super) fn try_statement(&mut self) -> StmtKind {
        let diag = self.unsupported_diag("__TRY");
        self.soft(
            diag.help(
                "a fault stops its task; test operands first, or call standard functions with ENO, which tells their errors",
            ),
        );
        while !self.at_end() && !self.kw().ends_declaration() && !self.is_word("__ENDTRY") {
            self.bump();
        }
        if self.is_word("__ENDTRY") {
            self.bump();
            self.eat(Tok::Semi);
        }
        StmtKind::Empty
    }

    /// To the end of the unit.
    fn skip_body(&mut self) {
        while !self.at_end() {
            let kw = self.kw();
            let inner = matches!(kw, Kw::EndAction | Kw::EndStep | Kw::EndTransition | Kw::EndVar);
            if kw.ends_declaration() && !inner || kw.opens_declaration() {
                break;
            }
            self.bump();
        }
        self.found_place();
    }
}
