//! Tokens to the tree: recursive descent for declarations and statements, precedence climbing for expressions.
//! Never fails, never recurses without counting (see `cursor`), takes time linear in the text.
//! One mistake gives one message: after it the parser is silent until it has found its place again.

mod action;
mod call;
mod config;
mod cursor;
mod decl;
mod expr;
pub(crate) mod il;
mod init;
mod instance;
mod literal;
mod loops;
mod misspelt;
mod namespace;
mod object;
mod recover;
mod stmt;
mod test;
mod types;
mod unsupported;
mod var;

use super::ast::File;
use super::lexer::lex;
use super::report::Report;
use cursor::Parser;
use takt_base::diag::{Code, Diag, Sink};
use takt_base::{SourceId, Sources, Span};

/// Longest text of a file in bytes; spans are 32 bits wide.
const MAX_BYTES: usize = 1 << 30;

/// Parses the file `id`. What is wrong goes to `sink`; the tree marks it with error nodes.
pub fn parse(sources: &Sources, id: SourceId, sink: &mut Sink) -> File {
    let source = sources.get(id);
    let mut report = Report::new(sink);
    if source.text.len() > MAX_BYTES {
        let diag = Diag::new(Code::TooMuch, Span::new(id, 0, 0), "a file of more than 1 GiB");
        report.push(diag.help("split it, or check that it is a source file"));
        return File::default();
    }
    let tokens = lex(&source.text, id, source.profile, &mut report);
    Parser::new(source, id, tokens, report).file()
}
