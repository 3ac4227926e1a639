//! Shows diagnostics: text on stderr, or the JSON array of `takt check --format json`.

use serde::Serialize;
use std::io::IsTerminal;
use takt_base::diag::render;
use takt_base::{Code, Diag, Severity, Sources};

/// One object of the JSON form.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub struct JsonDiag {
    code: &'static str,
    severity: &'static str,
    message: String,
    file: String,
    line: u32,
    column: u32,
    end_line: u32,
    end_column: u32,
    help: Option<String>,
}

/// The JSON form of one message. Lines and columns count from 1; the end is exclusive.
pub fn json(diag: &Diag, sources: &Sources) -> JsonDiag {
    let (start, end) = (sources.line_col(diag.span.source, diag.span.start), sources.line_col(diag.span.source, diag.span.end));
    let label = if diag.label.is_empty() { String::new() } else { format!(": {}", diag.label) };
    JsonDiag {
        code: diag.code.text(),
        severity: if diag.severity == Severity::Error { "error" } else { "warning" },
        message: format!("{}{label}", diag.message),
        file: sources.get(diag.span.source).name.clone(),
        line: start.line,
        column: start.column,
        end_line: end.line,
        end_column: end.column,
        help: diag.help.clone(),
    }
}

/// Prints messages to stderr and a count if there are errors.
pub fn print(diags: &[Diag], sources: &Sources) {
    let mut count = Count::default();
    count.print(diags, sources);
    count.finish();
}

/// Prints messages as they come, and at the end how many were errors.
#[derive(Default)]
pub struct Count {
    errors: usize,
    first: Option<Code>,
}

impl Count {
    /// Prints messages to stderr.
    pub fn print(&mut self, diags: &[Diag], sources: &Sources) {
        for diag in diags {
            eprintln!("{}", color(&render(diag, sources), diag.severity));
        }
        let errors = || diags.iter().filter(|d| d.severity == Severity::Error);
        self.errors += errors().count();
        self.first = self.first.or_else(|| errors().next().map(|d| d.code));
    }

    /// True if one of them was an error.
    pub fn any_error(&self) -> bool {
        self.errors > 0
    }

    /// Prints the number of errors, if there were any.
    pub fn finish(&self) {
        if let Some(first) = self.first {
            let (errors, s) = (self.errors, if self.errors == 1 { "" } else { "s" });
            eprintln!("{errors} error{s}; `takt explain {}` says more", first.text());
        }
    }
}

/// Colours the first words on a terminal, unless `NO_COLOR` is set.
fn color(text: &str, severity: Severity) -> String {
    let wanted = std::io::stderr().is_terminal() && std::env::var_os("NO_COLOR").is_none_or(|v| v.is_empty());
    let (Some((head, tail)), true) = (text.split_once(':'), wanted) else { return text.to_owned() };
    let code = if severity == Severity::Error { "31" } else { "33" };
    format!("\x1b[1;{code}m{head}\x1b[0m:{tail}")
}

/// True if one of them is an error.
pub fn any_error(diags: &[Diag]) -> bool {
    diags.iter().any(|d| d.severity == Severity::Error)
}
