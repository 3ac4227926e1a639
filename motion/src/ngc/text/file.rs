//! A file that is read at any place, and whether it is still the same.

use super::window::Trouble;
use std::fs::File;
use std::io;
use std::os::unix::fs::FileExt;
use std::time::SystemTime;

/// What tells that a file was written to.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Stamp {
    /// Bytes.
    pub len: u64,
    /// Last change; `None` where there is no such time.
    pub modified: Option<SystemTime>,
}

/// Bytes that can be read at any place.
pub trait ReadAt: Send + Sync {
    /// Fills `buffer` from byte `offset`, or a part of it; 0 at the end.
    ///
    /// # Errors
    /// It can't be read.
    fn read_at(&self, buffer: &mut [u8], offset: u64) -> io::Result<usize>;
    /// The present length and time of the last change.
    ///
    /// # Errors
    /// Nobody knows.
    fn stamp(&self) -> io::Result<Stamp>;
}

impl ReadAt for File {
    fn read_at(&self, buffer: &mut [u8], offset: u64) -> io::Result<usize> {
        FileExt::read_at(self, buffer, offset)
    }
    fn stamp(&self) -> io::Result<Stamp> {
        let about = self.metadata()?;
        Ok(Stamp { len: about.len(), modified: about.modified().ok() })
    }
}

/// A file as it was when it was opened.
pub(super) struct Stream {
    file: Box<dyn ReadAt>,
    stamp: Stamp,
}

impl Stream {
    pub(super) fn new(file: Box<dyn ReadAt>) -> io::Result<Self> {
        let stamp = file.stamp()?;
        Ok(Stream { file, stamp })
    }

    pub(super) fn len(&self) -> u64 {
        self.stamp.len
    }

    /// Fills all of `buffer`. The stamp is looked at behind it, so that what was read is what was opened; `lenient` leaves that out.
    pub(super) fn fill(&self, buffer: &mut [u8], offset: u64, lenient: bool) -> Result<(), Trouble> {
        let mut done = 0;
        while done < buffer.len() {
            match self.file.read_at(&mut buffer[done..], offset + done as u64) {
                Ok(0) => return Err(Trouble::Changed),
                Ok(n) => done = (done + n).min(buffer.len()),
                Err(e) if e.kind() == io::ErrorKind::Interrupted => {}
                Err(e) => return Err(Trouble::Unreadable(e.kind())),
            }
        }
        if lenient {
            return Ok(());
        }
        match self.file.stamp() {
            Ok(now) if now == self.stamp => Ok(()),
            Ok(_) => Err(Trouble::Changed),
            Err(e) => Err(Trouble::Unreadable(e.kind())),
        }
    }
}

impl std::fmt::Debug for Stream {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} bytes", self.stamp.len)
    }
}
