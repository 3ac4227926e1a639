//! The block of a streamed file that is being read. A text in memory needs none.

use super::scan::line_end;
use super::{Kind, Text};
use crate::ngc::fault::Fault;
use std::io::ErrorKind;
use std::ops::Range;
use takt_base::Code;

/// Bytes of a block.
pub const BLOCK: usize = 1 << 17;
/// Longest row of a streamed file in bytes: what is longer is no part program.
pub const ROW_MAX: usize = 1 << 16;

const BYTE_ORDER_MARK: &[u8] = "\u{feff}".as_bytes();

/// Why a text can't be read on.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Trouble {
    /// The file is no longer what was opened.
    Changed,
    /// The system can't read it.
    Unreadable(ErrorKind),
    /// A row above [`ROW_MAX`].
    RowTooLong,
}

impl Trouble {
    /// As a fault at byte `at`.
    pub fn fault(self, at: usize) -> Fault {
        let (start, end) = (at as u32, (at as u32).saturating_add(1));
        match self {
            Trouble::Changed => Fault::at(
                Code::FileChanged,
                start,
                end,
                "it was written to before this row was read",
                "load the program anew; save to a new name while the old one runs",
            ),
            Trouble::Unreadable(kind) => Fault::at(
                Code::FileUnreadable,
                start,
                end,
                format!("{kind} from here on"),
                "check the disk or the network, or copy the file to this machine first",
            ),
            Trouble::RowTooLong => Fault::at(
                Code::RowTooLong,
                start,
                end,
                format!("more than {ROW_MAX} bytes without a line end"),
                "check that the file is a part program, with a block in each line",
            ),
        }
    }
}

/// Holds a block; kept from row to row and from file to file.
#[derive(Clone, Debug, Default)]
pub struct Window {
    block: Vec<u8>,
    /// Byte of the file at which the block starts.
    base: usize,
    /// Whose block it is.
    file: u32,
    /// Whether the file has changed does not matter.
    pub lenient: bool,
}

/// A text seen through a window.
#[derive(Debug)]
pub struct View<'a> {
    /// The text.
    pub text: &'a Text,
    /// Its number among those that use the window.
    pub file: u32,
    /// Where its block is.
    pub window: &'a mut Window,
}

impl Window {
    /// What is held of a text, and the byte of it at which that starts.
    fn held<'a>(&'a self, text: &'a Text, file: u32) -> (usize, &'a [u8]) {
        match &text.kind {
            Kind::Whole(text) => (0, text.as_bytes()),
            Kind::Streamed(_) if self.file == file => (self.base, &self.block),
            Kind::Streamed(_) => (0, &[]),
        }
    }

    /// Bytes of the line that was read last, or of what [`View::hold`] brought; empty if they are not held.
    pub fn bytes<'a>(&'a self, text: &'a Text, file: u32, range: Range<usize>) -> &'a [u8] {
        let (base, held) = self.held(text, file);
        held.get(range.start.wrapping_sub(base)..range.end.wrapping_sub(base)).unwrap_or(&[])
    }
}

impl View<'_> {
    /// See [`Window::bytes`].
    pub fn bytes(&self, range: Range<usize>) -> &[u8] {
        self.window.bytes(self.text, self.file, range)
    }

    /// Brings bytes within a line into the window.
    ///
    /// # Errors
    /// The file can't be read on.
    pub fn hold(&mut self, range: Range<usize>) -> Result<(), Trouble> {
        if self.bytes(range.clone()).len() == range.len() { Ok(()) } else { self.refill(range.start) }
    }

    /// The line that starts at `start`, without its end (LF, CRLF or a lone CR), and where the next one starts; `None` at the end.
    ///
    /// # Errors
    /// The file can't be read on.
    pub fn line(&mut self, start: usize) -> Result<Option<(Range<usize>, usize)>, Trouble> {
        if start >= self.text.len() {
            return Ok(None);
        }
        loop {
            if let Some((range, next)) = self.find(start) {
                let too_long = range.len() > ROW_MAX && matches!(self.text.kind, Kind::Streamed(_));
                return if too_long { Err(Trouble::RowTooLong) } else { Ok(Some((range, next))) };
            }
            self.refill(start)?;
        }
    }

    /// The line, if its end is held.
    fn find(&self, start: usize) -> Option<(Range<usize>, usize)> {
        let (base, held) = self.window.held(self.text, self.file);
        let inside = held.get(start.checked_sub(base)?..)?;
        let last = base + held.len() >= self.text.len();
        let skipped = if start == 0 && inside.starts_with(BYTE_ORDER_MARK) { BYTE_ORDER_MARK.len() } else { 0 };
        let Some(n) = line_end(inside) else {
            let end = start + inside.len();
            return last.then_some((start + skipped..end, end));
        };
        let mut behind = n + 1;
        if inside[n] == b'\r' {
            match inside.get(behind) {
                Some(b'\n') => behind += 1,
                None if !last => return None,
                _ => {}
            }
        }
        Some((start + skipped..start + n, start + behind))
    }

    /// Reads a block that starts at `start`; what is held of it is kept.
    fn refill(&mut self, start: usize) -> Result<(), Trouble> {
        let Kind::Streamed(stream) = &self.text.kind else { return Ok(()) };
        let window = &mut *self.window;
        if window.file != self.file || !(window.base..=window.base + window.block.len()).contains(&start) {
            window.block.clear();
            (window.file, window.base) = (self.file, start);
        }
        let passed = start - window.base;
        if passed == 0 && window.block.len() >= BLOCK {
            return Err(Trouble::RowTooLong);
        }
        window.block.drain(..passed);
        window.base = start;
        let (old, new) = (window.block.len(), BLOCK.min(self.text.len().saturating_sub(start)));
        window.block.resize(new.max(old), 0);
        let filled = stream.fill(&mut window.block[old..], (start + old) as u64, window.lenient);
        if filled.is_err() {
            window.block.truncate(old);
        }
        filled
    }
}
