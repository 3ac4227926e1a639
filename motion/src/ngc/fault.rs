//! Why a row can't be read or executed: a rule, bytes of the text, what to do. Becomes a diagnostic when the file is known.

use takt_base::{Code, Diag, SourceId, Span};

/// One mistake. Boxed, so that results stay small where nothing is wrong.
#[derive(Clone, PartialEq, Debug)]
pub struct Fault(Box<Parts>);

#[derive(Clone, PartialEq, Debug)]
struct Parts {
    code: Code,
    start: u32,
    end: u32,
    label: String,
    help: String,
    message: Option<String>,
}

impl Fault {
    /// A fault at bytes `start..end`.
    pub fn at(code: Code, start: u32, end: u32, label: impl Into<String>, help: impl Into<String>) -> Self {
        Fault(Box::new(Parts { code, start, end: end.max(start), label: label.into(), help: help.into(), message: None }))
    }

    /// With a more exact sentence than the title of the code.
    pub fn message(mut self, message: impl Into<String>) -> Self {
        self.0.message = Some(message.into());
        self
    }

    /// As a diagnostic in file `source`.
    pub fn diag(self, source: SourceId) -> Diag {
        let Parts { code, start, end, label, help, message } = *self.0;
        let diag = Diag::new(code, Span { source, start, end }, label).help(help);
        match message {
            Some(message) => diag.message(message),
            None => diag,
        }
    }
}
