//! The `{test}` pragma in front of a unit.

use super::cursor::Parser;
use crate::syntax::ast::PouKind;
use crate::syntax::test_pragma::TestPragma;
use takt_base::diag::{Code, Diag};

impl Parser<'_> {
    /// What the pragma before this keyword says, if there is one.
    pub(super) fn test_pragma(&mut self, kind: PouKind) -> Option<TestPragma> {
        let at = self.tokens.tests.binary_search_by_key(&self.pos, |t| t.0).ok()?;
        let (_, text, span) = self.tokens.tests.get(at)?.clone();
        let read = match kind {
            PouKind::Program => TestPragma::parse(&text),
            _ => Err("this is no PROGRAM".to_owned()),
        };
        read.map_err(|label| {
            let diag = Diag::new(Code::BadTestPragma, span, label);
            self.soft(diag.help("write `{test 'name', scans := 20, interval := T#10ms}` before a PROGRAM; each part may be left out"));
        })
        .ok()
    }
}
