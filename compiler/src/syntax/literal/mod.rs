//! Values of literals. Pure functions from the text of a token to a value or to what is wrong with it.

pub(crate) mod address;
pub(crate) mod number;
pub(crate) mod string;
pub(crate) mod time;

use super::ast::Literal;
use takt_base::diag::Code;

/// What is wrong with a literal.
#[derive(Debug, PartialEq)]
pub(crate) struct Problem {
    pub(crate) code: Code,
    /// Bytes of the token that it is about; `None` for all of it.
    pub(crate) at: Option<(usize, usize)>,
    pub(crate) label: String,
    pub(crate) help: Option<String>,
}

impl Problem {
    pub(crate) fn new(code: Code, label: impl Into<String>) -> Self {
        Self { code, at: None, label: label.into(), help: None }
    }
    pub(crate) fn at(mut self, start: usize, end: usize) -> Self {
        self.at = Some((start, end));
        self
    }
    pub(crate) fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }
}

/// A value, and what is unusual about it.
#[derive(Debug, PartialEq)]
pub(crate) struct Value {
    pub(crate) literal: Literal,
    /// Shown as a warning.
    pub(crate) warning: Option<Problem>,
}

impl From<Literal> for Value {
    fn from(literal: Literal) -> Self {
        Value { literal, warning: None }
    }
}

pub(crate) type Read = Result<Value, Problem>;
