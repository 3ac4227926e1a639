//! The texts of a program: its own, and those of subroutines in files of their own.

use crate::ngc::fault::Fault;
use crate::ngc::lines::{Lines, Piece, Place, Style};
use crate::ngc::text::{Text, View, Window};
use std::ops::Range;
use takt_base::SourceId;

/// A place in one of the texts.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Spot {
    /// Which text.
    pub file: u32,
    /// Where in it.
    pub place: Place,
}

/// Texts that one program may use.
const FILES_MAX: usize = 10_000;

#[derive(Clone, Debug)]
struct File {
    source: SourceId,
    text: Text,
    lines: Lines,
    indexed: bool,
}

/// All texts, and the one at hand.
#[derive(Clone, Debug)]
pub struct Files {
    all: Vec<File>,
    /// The text at hand.
    pub at: u32,
    style: Style,
    window: Window,
    /// A file could not be read on: the program is at its end.
    pub broken: bool,
}

impl Files {
    /// With the text of the main program.
    pub fn new(source: SourceId, text: Text, style: Style) -> Self {
        let mut files = Files { all: Vec::new(), at: 0, style, window: Window::default(), broken: false };
        files.add(source, text);
        files
    }

    /// Adds a text; `None` if there are too many.
    pub fn add(&mut self, source: SourceId, text: Text) -> Option<u32> {
        if self.all.len() >= FILES_MAX {
            return None;
        }
        let mut view = View { text: &text, file: self.all.len() as u32, window: &mut self.window };
        let lines = Lines::new(&mut view, self.style);
        self.all.push(File { source, text, lines, indexed: false });
        Some(self.all.len() as u32 - 1)
    }

    /// The place in the text at hand.
    pub fn lines(&mut self) -> &mut Lines {
        &mut self.all[self.at as usize].lines
    }

    /// The next piece of the text at hand; its bytes are held until the next one is read.
    ///
    /// # Errors
    /// The file can't be read on.
    pub fn next_piece(&mut self) -> Result<Option<Piece>, Fault> {
        let file = &mut self.all[self.at as usize];
        let mut view = View { text: &file.text, file: self.at, window: &mut self.window };
        let piece = file.lines.next(&mut view);
        piece.map_err(|trouble| {
            self.broken = true;
            trouble.fault(file.lines.place.next())
        })
    }

    /// Bytes of the piece that was read last.
    pub fn bytes(&self, range: Range<usize>) -> &[u8] {
        let file = &self.all[self.at as usize];
        self.window.bytes(&file.text, self.at, range)
    }

    /// Byte at which the text at hand ends.
    pub fn end(&self) -> usize {
        self.all[self.at as usize].text.len()
    }

    /// Goes to a line (from 1) of the main program. False if there are fewer.
    ///
    /// # Errors
    /// The file can't be read.
    pub fn seek(&mut self, line: u32) -> Result<bool, Fault> {
        self.at = 0;
        let found = self.all[0].text.start_of(line).map_err(|trouble| trouble.fault(0))?;
        self.lines().place = Place::at_line(line, found.unwrap_or(0));
        Ok(found.is_some())
    }

    /// Its file in diagnostics.
    pub fn source(&self) -> SourceId {
        self.all[self.at as usize].source
    }

    /// The place at hand.
    pub fn spot(&mut self) -> Spot {
        Spot { file: self.at, place: self.lines().place }
    }

    /// Goes to a place.
    pub fn go(&mut self, spot: Spot) {
        self.at = spot.file;
        self.lines().place = spot.place;
    }

    /// True once for each text: its subroutines have to be looked for.
    pub fn index_now(&mut self, file: u32) -> bool {
        self.all.get_mut(file as usize).is_some_and(|f| !std::mem::replace(&mut f.indexed, true))
    }
}
