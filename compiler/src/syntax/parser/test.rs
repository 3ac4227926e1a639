//! The `{test}` pragma in front of a unit.

use super::cursor::Parser;
use crate::syntax::ast::PouKind;
use crate::syntax::keyword::Kw;
use crate::syntax::test_pragma::TestPragma;
use takt_base::diag::{Code, Diag};

const HELP: &str = "write `{test 'name', scans := 20, interval := T#10ms}` before a PROGRAM; each part may be left out";

impl Parser<'_> {
    /// What the pragma before this keyword says, if there is one.
    pub(super) fn test_pragma(&mut self, kind: PouKind) -> Option<TestPragma> {
        let at = self.tokens.tests.binary_search_by_key(&self.pos, |t| t.0).ok()?;
        let (_, text, span) = self.tokens.tests.get(at)?.clone();
        if kind != PouKind::Program {
            return None; // `misplaced_tests` says it
        }
        let read = TestPragma::parse(&text);
        read.map_err(|label| {
            self.soft(Diag::new(Code::BadTestPragma, span, label).help(HELP));
        })
        .ok()
    }

    /// Reports the pragmas that stand before something else.
    pub(super) fn misplaced_tests(&mut self) {
        let program = |at: &usize| self.tokens.list.get(*at).is_some_and(|t| t.kw == Kw::Program);
        let misplaced: Vec<_> = self.tokens.tests.iter().filter(|t| !program(&t.0)).map(|t| t.2).collect();
        for span in misplaced {
            self.soft(Diag::new(Code::BadTestPragma, span, "no PROGRAM begins here").help(HELP));
        }
    }
}
