//! Diagnostics: what is wrong, where, and what to write instead.
//! A message is data until it is shown; [`render`] makes text of it, the command line makes JSON.

pub mod codes;
mod render;

pub use codes::Code;
pub use render::render;

use crate::source::Span;

/// How bad it is.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Severity {
    /// Worth knowing; the program runs.
    Warning,
    /// The program can't be built.
    Error,
}

/// One message.
#[derive(Clone, Debug, PartialEq)]
pub struct Diag {
    /// Which rule.
    pub code: Code,
    /// Error or warning.
    pub severity: Severity,
    /// The sentence after the code. Starts as the code's title; [`Diag::message`] makes it specific.
    pub message: String,
    /// Where.
    pub span: Span,
    /// What stands there; shown behind the carets.
    pub label: String,
    /// Other places that matter, each with its note.
    pub related: Vec<(Span, String)>,
    /// What to do.
    pub help: Option<String>,
}

impl Diag {
    /// An error (or what the code's default severity says) at `span`; `label` says what stands there.
    pub fn new(code: Code, span: Span, label: impl Into<String>) -> Self {
        Self {
            code,
            severity: code.severity(),
            message: code.title().to_owned(),
            span,
            label: label.into(),
            related: Vec::new(),
            help: None,
        }
    }
    /// Replaces the code's title by a more exact sentence.
    pub fn message(mut self, message: impl Into<String>) -> Self {
        self.message = message.into();
        self
    }
    /// Adds another place that matters.
    pub fn also(mut self, span: Span, note: impl Into<String>) -> Self {
        self.related.push((span, note.into()));
        self
    }
    /// Says what to do.
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }
    /// Overrides the severity.
    pub fn severity(mut self, severity: Severity) -> Self {
        self.severity = severity;
        self
    }
}

/// Collects messages; a stage goes on after reporting.
#[derive(Clone, Debug, Default)]
pub struct Sink {
    /// All messages, in the order reported.
    pub diags: Vec<Diag>,
    errors: usize,
}

impl Sink {
    /// An empty sink.
    pub fn new() -> Self {
        Self::default()
    }
    /// Reports.
    pub fn push(&mut self, diag: Diag) {
        self.errors += usize::from(diag.severity == Severity::Error);
        self.diags.push(diag);
    }
    /// True if an error was reported.
    pub fn has_errors(&self) -> bool {
        self.errors > 0
    }
    /// Messages sorted by place, identical ones merged.
    pub fn into_sorted(mut self) -> Vec<Diag> {
        self.diags.sort_by_key(|d| (d.span.source, d.span.start, d.code.text()));
        self.diags.dedup_by(|a, b| a.code == b.code && a.span == b.span && a.label == b.label);
        self.diags
    }
}
