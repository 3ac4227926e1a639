//! Tests of text to tree: cases are texts, trees are printed as s-expressions.

mod declarations;
mod expressions;
mod fuzz;
mod limits;
mod literals;
mod mistakes;
mod pages;
mod print;
mod recovery;
mod smoke;
mod statements;
mod unsupported;

use super::ast::{File, Item};
use takt_base::Sources;
use takt_base::diag::{Code, Diag, Severity, Sink, render};

/// Parses a text named `a.st`.
fn parse(text: &str) -> (File, Vec<Diag>, Sources) {
    let mut sources = Sources::new();
    let id = sources.add("a.st", text);
    let mut sink = Sink::new();
    let file = super::parse(&sources, id, &mut sink);
    (file, sink.diags, sources)
}

/// The tree of a file without mistakes.
fn tree(text: &str) -> String {
    let (file, diags, sources) = parse(text);
    let messages: String = diags.iter().map(|d| render(d, &sources)).collect();
    assert!(diags.is_empty(), "{text}\n{messages}");
    print::file(&file)
}

/// Codes and places of all messages, `P0010 3:7`.
fn codes(text: &str) -> Vec<String> {
    let (_, diags, sources) = parse(text);
    let place = |d: &Diag| sources.line_col(d.span.source, d.span.start);
    diags.iter().map(|d| format!("{} {}:{}", d.code.text(), place(d).line, place(d).column)).collect()
}

/// The first statement of a program with this body, without mistakes.
fn stmt(body: &str) -> String {
    let printed = tree(&format!("PROGRAM p\n{body}\nEND_PROGRAM"));
    printed.strip_prefix("(program p ").and_then(|s| s.strip_suffix(')')).unwrap_or(&printed).to_owned()
}

/// An expression without mistakes.
fn expr(text: &str) -> String {
    let printed = stmt(&format!("x := {text};"));
    printed.strip_prefix("(:= x ").and_then(|s| s.strip_suffix(')')).unwrap_or(&printed).to_owned()
}
