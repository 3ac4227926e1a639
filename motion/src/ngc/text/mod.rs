//! Texts of part programs: a small file is held whole, of a large one the block that is being read and an index of lines.
//!
//! Runs: background. Invariant: however long a file is, a reader of it holds one [`Window`] of [`window::BLOCK`] bytes, and all its readers
//! share four bytes for each [`MARK_LINES`] lines. Places are bytes of the file, in 32 bits.

pub mod file;
mod scan;
pub mod window;

pub use file::{ReadAt, Stamp};
pub use window::{Trouble, View, Window};

use file::Stream;
use std::borrow::Cow;
use std::io::{self, Read};
use std::path::Path;
use std::sync::{Arc, Mutex, PoisonError};
use takt_base::source::Excerpt;

/// Files up to this many bytes are read whole: nobody can change them any more.
pub const WHOLE_MAX: u64 = 1 << 20;
/// Lines between two entries of the index.
pub const MARK_LINES: u32 = 1024;
/// Bytes that places can count.
const BYTES_MAX: u64 = u32::MAX as u64;

/// A text, shared by its clones.
#[derive(Clone, Debug)]
pub struct Text {
    kind: Kind,
    marks: Arc<Mutex<Vec<u32>>>,
}

#[derive(Clone, Debug)]
enum Kind {
    Whole(Arc<str>),
    Streamed(Arc<Stream>),
}

impl Text {
    /// The text of a file. One above [`WHOLE_MAX`] bytes stays open and is read as it is needed.
    ///
    /// # Errors
    /// It can't be opened or read, or has more than 4 GiB.
    pub fn open(path: &Path) -> io::Result<Self> {
        let file = std::fs::File::open(path)?;
        let about = file.metadata()?;
        if about.is_file() && about.len() > WHOLE_MAX {
            return Text::streamed(file);
        }
        // A pipe or a device does not say how much will come.
        let mut bytes = Vec::new();
        (&file).take(BYTES_MAX + 1).read_to_end(&mut bytes)?;
        if bytes.len() as u64 > BYTES_MAX {
            return Err(too_large());
        }
        Ok(decoded(&bytes).into())
    }

    /// A text that is read as it is needed.
    ///
    /// # Errors
    /// It does not say how long it is, or has more than 4 GiB.
    pub fn streamed(file: impl ReadAt + 'static) -> io::Result<Self> {
        let stream = Stream::new(Box::new(file))?;
        if stream.len() > BYTES_MAX {
            return Err(too_large());
        }
        Ok(Text::new(Kind::Streamed(Arc::new(stream))))
    }

    fn new(kind: Kind) -> Self {
        Text { kind, marks: Arc::default() }
    }

    /// The whole text, if it is held.
    pub fn whole(&self) -> Option<&str> {
        match &self.kind {
            Kind::Whole(text) => Some(text),
            Kind::Streamed(_) => None,
        }
    }

    /// The whole text, read now if it is not held: for those who can't do with rows.
    ///
    /// # Errors
    /// The file can't be read.
    pub fn to_whole(&self) -> Result<Arc<str>, Trouble> {
        match &self.kind {
            Kind::Whole(text) => Ok(text.clone()),
            Kind::Streamed(stream) => {
                let mut bytes = vec![0; self.len()];
                stream.fill(&mut bytes, 0, false)?;
                Ok(decoded(&bytes).into())
            }
        }
    }

    /// Its length in bytes.
    pub fn len(&self) -> usize {
        match &self.kind {
            Kind::Whole(text) => text.len(),
            Kind::Streamed(stream) => stream.len() as usize,
        }
    }

    /// True if it has no bytes.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Number of its lines. Reads a streamed file once.
    ///
    /// # Errors
    /// The file can't be read.
    pub fn lines(&self) -> Result<u32, Trouble> {
        let mut window = Window::default();
        let mut view = View { text: self, file: 0, window: &mut window };
        let (mut line, mut at) = self.mark_of(<[u32]>::len);
        while let Some((_, next)) = view.line(at)? {
            line += 1;
            at = next;
            self.mark(line, at);
        }
        Ok(line)
    }

    /// Where line `line` (from 1) starts; `None` if there are fewer. Takes no longer than [`MARK_LINES`] lines once the index is that far.
    ///
    /// # Errors
    /// The file can't be read.
    pub fn start_of(&self, line: u32) -> Result<Option<usize>, Trouble> {
        let mut window = Window::default();
        let mut view = View { text: self, file: 0, window: &mut window };
        let (mut before, mut at) = self.mark_of(|marks| marks.len().min((line.saturating_sub(1) / MARK_LINES) as usize));
        while before + 1 < line {
            let Some((_, next)) = view.line(at)? else { return Ok(None) };
            before += 1;
            at = next;
            self.mark(before, at);
        }
        Ok((at < self.len() || line == 1).then_some(at))
    }

    /// The line around a byte, for a message, even if the file has changed; `None` if it can't be read.
    pub fn excerpt(&self, offset: u32) -> Option<Excerpt> {
        let mut window = Window::default();
        window.lenient = true;
        let mut view = View { text: self, file: 0, window: &mut window };
        let offset = (offset as usize).min(self.len().saturating_sub(1));
        let (mut before, mut at) = self.mark_of(|marks| marks.partition_point(|&start| start as usize <= offset));
        loop {
            let (range, next) = view.line(at).ok()??;
            if next > offset {
                let bytes = view.bytes(range.clone());
                let latin1 = std::str::from_utf8(bytes).is_err();
                return Some(Excerpt { start: range.start as u32, line: before + 1, text: decoded(bytes), latin1 });
            }
            before += 1;
            at = next;
            self.mark(before, at);
        }
    }

    /// Notes that `lines` lines end before byte `next`.
    pub fn mark(&self, lines: u32, next: usize) {
        if !lines.is_multiple_of(MARK_LINES) {
            return;
        }
        let mut marks = self.marks.lock().unwrap_or_else(PoisonError::into_inner);
        if marks.len() + 1 == (lines / MARK_LINES) as usize {
            if marks.is_empty() {
                // Lines are of much the same length: all the room at once, up to a thousandth of a file of ten bytes a line.
                marks.reserve((self.len() / next.max(1)).min(self.len() / 10_240) + 8);
            }
            marks.push(next as u32);
        }
    }

    /// The entry that `choose` takes, as a number of entries: lines before it, and where the next one starts.
    fn mark_of(&self, choose: impl FnOnce(&[u32]) -> usize) -> (u32, usize) {
        let marks = self.marks.lock().unwrap_or_else(PoisonError::into_inner);
        let n = choose(&marks);
        let start = n.checked_sub(1).and_then(|i| marks.get(i)).map_or(0, |&m| m as usize);
        (n as u32 * MARK_LINES, start)
    }
}

fn too_large() -> io::Error {
    io::Error::new(io::ErrorKind::FileTooLarge, "it has more than 4 GiB; split it into programs that call each other")
}

/// UTF-8, or else Latin-1; without a byte order mark.
pub fn decoded(bytes: &[u8]) -> String {
    let text = line(bytes);
    match text.strip_prefix('\u{feff}') {
        Some(rest) => rest.to_owned(),
        None => text.into_owned(),
    }
}

/// A piece of a row: UTF-8, or else Latin-1.
pub fn line(bytes: &[u8]) -> Cow<'_, str> {
    match std::str::from_utf8(bytes) {
        Ok(text) => Cow::Borrowed(text),
        Err(_) => Cow::Owned(bytes.iter().map(|&b| char::from(b)).collect()),
    }
}

impl From<Arc<str>> for Text {
    fn from(text: Arc<str>) -> Self {
        Text::new(Kind::Whole(text))
    }
}

impl From<&str> for Text {
    fn from(text: &str) -> Self {
        Arc::<str>::from(text).into()
    }
}

impl From<String> for Text {
    fn from(text: String) -> Self {
        Arc::<str>::from(text).into()
    }
}

impl From<&String> for Text {
    fn from(text: &String) -> Self {
        text.as_str().into()
    }
}
