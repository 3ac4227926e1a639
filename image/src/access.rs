//! Why a variable can't be found, read or written: what the command line and the stimulus file tell the user.

use takt_base::Code;

/// A path or a value that does not work.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct AccessError {
    /// Which rule.
    pub code: Code,
    /// What is wrong, with the text that the user gave.
    pub message: String,
    /// What to do.
    pub help: Option<String>,
}

impl AccessError {
    /// No variable has this path.
    pub(crate) fn path(message: impl Into<String>) -> Self {
        Self { code: Code::UnknownPath, message: message.into(), help: None }
    }
    /// The text is not a value of the type.
    pub(crate) fn value(message: impl Into<String>) -> Self {
        Self { code: Code::BadValueText, message: message.into(), help: None }
    }
    /// The path may be read alone.
    pub(crate) fn read_only(path: &str) -> Self {
        let message = format!("`{path}` can't be written: VAR_ACCESS declares it READ_ONLY");
        Self { code: Code::ReadOnlyPath, message, help: None }
    }
    /// Says what to do.
    pub(crate) fn help(self, help: impl Into<String>) -> Self {
        Self { help: Some(help.into()), ..self }
    }
}

impl std::fmt::Display for AccessError {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for AccessError {}
