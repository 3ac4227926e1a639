//! Messages of one file, up to a limit: a binary file read by mistake must not fill the screen or the memory.

use takt_base::diag::{Code, Diag, Severity, Sink};

/// Errors reported per file.
pub(crate) const MAX_ERRORS: usize = 200;

/// A [`Sink`] that closes after [`MAX_ERRORS`] errors.
pub(crate) struct Report<'a> {
    sink: &'a mut Sink,
    errors: usize,
}

impl<'a> Report<'a> {
    pub(crate) fn new(sink: &'a mut Sink) -> Self {
        Self { sink, errors: 0 }
    }

    pub(crate) fn push(&mut self, diag: Diag) {
        if self.errors > MAX_ERRORS {
            return;
        }
        self.errors += usize::from(diag.severity == Severity::Error);
        if self.errors > MAX_ERRORS {
            let text = format!("{MAX_ERRORS} errors were reported; what follows is not shown");
            self.sink.push(Diag::new(Code::TooMuch, diag.span, text).help("mend the first errors and check again"));
        } else {
            self.sink.push(diag);
        }
    }
}
